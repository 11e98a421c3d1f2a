//! The trials of a suite: every campaign on its own stream of random numbers.

use hexbench_core::streams::{Purpose, derived_seed};
use hexbench_truth::campaign::{CaseKind, SimulatedCase};
use hexbench_truth::laboratory;
use serde::{Deserialize, Serialize};

use super::answered::Answered;
use super::fitted::Fitted;
use super::suite::{DISTANCES, MACHINES_SEED, RegressSuite};
use crate::TrialError;
use crate::calibration::CalibrationRecord;
use crate::harness::{Field, Gathered, Protocol, TrialResult};
use crate::journal::Identity;
use crate::misread::{MisreadJob, MisreadProtocol, MisreadRecord};
use crate::recovery::noiseless::{Noiseless, recover};
use crate::recovery::scene::{HiddenSubject, RecoveryCampaign};
use crate::robustness::{RobustnessJob, RobustnessRecord};
use crate::trial::clean_or_single;

/// A campaign of a subject: what it gave, or nothing.
#[derive(Debug, Clone)]
pub struct OfSubject<T> {
    /// What was hidden.
    pub subject: HiddenSubject,
    /// `None` without an answer.
    pub found: Option<T>,
}

/// What one run of a suite gave.
#[derive(Debug, Clone, Default)]
pub struct SuiteTrials {
    /// Noisy campaigns fitted by the right model.
    pub fits: Vec<OfSubject<Fitted>>,
    /// Campaigns without noise.
    pub machines: Vec<OfSubject<Noiseless>>,
    /// Campaigns diagnosed.
    pub answers: Vec<Option<Answered>>,
    /// Campaigns of laboratories that do something wrong, diagnosed.
    pub laboratories: Vec<Option<RobustnessRecord>>,
    /// Campaigns whose files do not say what is meant, and sound ones, diagnosed.
    pub files: Vec<Option<MisreadRecord>>,
    /// Why campaigns gave no answer.
    pub failures: Vec<String>,
}

/// A campaign, and what becomes of it.
#[derive(Debug, Clone)]
pub enum RegressJob {
    /// Fitted without noise.
    Machine(HiddenSubject, usize),
    /// Fitted by the right model.
    Fit(HiddenSubject, usize),
    /// Diagnosed.
    Diagnose(CaseKind, usize),
    /// Diagnosed, of a laboratory that does something wrong.
    Laboratory(RobustnessJob),
    /// Diagnosed, from files that do not say what is meant or sound ones.
    Files(MisreadJob),
}

/// What is known of one campaign.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub enum RegressRecord {
    /// Without noise.
    Machine(Noiseless),
    /// Fitted by the right model.
    Fit(Fitted),
    /// Diagnosed.
    Answer(Box<Answered>),
    /// Diagnosed, of a laboratory that does something wrong.
    Laboratory(Box<RobustnessRecord>),
    /// Diagnosed, from files that do not say what is meant or sound ones.
    Files(Box<MisreadRecord>),
}

/// Runs of a suite, one for each seed. Campaigns without noise are the same in all: the first run has them.
pub struct SuiteRuns {
    suite: RegressSuite,
    /// Seed of the first run; the others follow.
    seed: u64,
    count: usize,
}

impl SuiteRuns {
    /// So many runs with seeds that follow each other.
    pub fn new(suite: &RegressSuite, seed: u64, count: usize) -> Self {
        Self { suite: suite.clone(), seed, count }
    }

    /// The seeds in order.
    pub fn seeds(&self) -> impl Iterator<Item = u64> {
        (0..self.count as u64).map(|run| self.seed.wrapping_add(run))
    }

    /// What each run gave; only the first has campaigns without noise.
    pub fn of_each(&self, gathered: Gathered<RegressRecord>) -> Vec<SuiteTrials> {
        let mut runs: Vec<SuiteTrials> = vec![SuiteTrials::default(); self.count];
        for ((run, job), answer) in self.jobs().into_iter().zip(gathered.answers) {
            runs[run].add(&job, answer);
        }
        runs
    }
}

/// A column of the table of trials.
type Column = Field<RegressRecord>;

impl Protocol for SuiteRuns {
    /// Number of the run, and what is done in it.
    type Job = (usize, RegressJob);
    type Record = RegressRecord;
    type Error = TrialError;

    /// Not how many runs: more of them go on where fewer have ended.
    fn identity(&self) -> Identity {
        let suite = format!("{} {}", self.suite.name, self.suite.version);
        Identity::new("regress", "regress-trials/2", [("suite", suite), ("seed", self.seed.to_string())])
    }

    fn jobs(&self) -> Vec<(usize, RegressJob)> {
        let later = self.suite.without_machines();
        let of_run =
            |run| jobs(if run == 0 { &self.suite } else { &later }).into_iter().map(move |job| (run, job));
        (0..self.count).flat_map(of_run).collect()
    }

    fn trial(&self, (run, job): &Self::Job) -> Result<RegressRecord, TrialError> {
        job.run(self.seed.wrapping_add(*run as u64))
    }

    fn name(&self, (run, job): &Self::Job) -> String {
        format!("{run}: {}", job.name())
    }

    fn fields(&self) -> Vec<Column> {
        let fitted = |name: &str, meaning, value: fn(&Fitted) -> Option<f64>| {
            Column::number(name, meaning, move |r| {
                if let RegressRecord::Fit(fitted) = r { value(fitted) } else { None }
            })
        };
        vec![
            fitted("stiffness_error", "relative error of the leg stiffnesses", |f| f.stiffness_error),
            fitted("effect_error", "relative error of the numbers of the effect", |f| f.effect_error),
            fitted("chi2", "chi-square per degree of freedom", |f| Some(f.chi2_reduced)),
            fitted("holdout", "chi-square per number of held-out readings", |f| Some(f.holdout)),
            Column::text("answer", "what the diagnosis said", |r| {
                answered(r).map_or(String::new(), CalibrationRecord::answer)
            }),
            Column::text("fate", "what became of the truth", |r| {
                answered(r).map_or("", |found| found.fate.word())
            }),
        ]
    }
}

/// What was said, where a diagnosis was asked.
fn answered(r: &RegressRecord) -> Option<&CalibrationRecord> {
    match r {
        RegressRecord::Answer(found) => Some(&found.record),
        RegressRecord::Laboratory(found) => Some(&found.answer),
        RegressRecord::Machine(_) | RegressRecord::Fit(_) | RegressRecord::Files(_) => None,
    }
}

/// Campaigns of laboratories, every one another machine, so that none counts twice.
fn laboratories(suite: &RegressSuite) -> impl Iterator<Item = RegressJob> {
    let faults = suite.faults.iter().filter_map(|id| laboratory::entry(id));
    let each = suite.laboratory;
    (0..).zip(faults).flat_map(move |(number, fault)| {
        (number * each..(number + 1) * each).map(move |campaign| {
            let (kind, index) = clean_or_single(campaign);
            RegressJob::Laboratory(RobustnessJob { fault, kind, index })
        })
    })
}

/// Campaigns whose files do not say what is meant, and sound ones.
fn files(suite: &RegressSuite) -> impl Iterator<Item = RegressJob> {
    let protocol = MisreadProtocol {
        trials: suite.misread,
        sound: suite.sound,
        misstatements: suite.misstatements.clone(),
        ..MisreadProtocol::default()
    };
    protocol.jobs().into_iter().map(RegressJob::Files)
}

/// The longest first: no thread is left alone with one of them at the end. The campaigns without noise last.
fn jobs(suite: &RegressSuite) -> Vec<RegressJob> {
    let diagnosed =
        suite.portions.iter().flat_map(|p| (0..p.trials).map(|i| RegressJob::Diagnose(p.kind, i)));
    let of_each = |count: usize, job: fn(HiddenSubject, usize) -> RegressJob| {
        suite.subjects.iter().flat_map(move |&s| (0..count).map(move |i| job(s, i)))
    };
    diagnosed
        .chain(laboratories(suite))
        .chain(files(suite))
        .chain(of_each(suite.fits, RegressJob::Fit))
        .chain(of_each(suite.machines, RegressJob::Machine))
        .collect()
}

impl RegressJob {
    fn run(&self, seed: u64) -> Result<RegressRecord, TrialError> {
        match self {
            Self::Machine(s, i) => Ok(RegressRecord::Machine(machine(s, *i)?)),
            Self::Fit(s, i) => {
                Ok(RegressRecord::Fit(Fitted::run(s, *i, derived_seed(seed, Purpose::RegressFits, []))?))
            }
            Self::Diagnose(kind, i) => {
                let case = SimulatedCase::draw(
                    *kind,
                    *i,
                    derived_seed(seed, Purpose::RegressDiagnoses, []),
                    Some(DISTANCES),
                )?;
                Ok(RegressRecord::Answer(Box::new(Answered::to(&case)?)))
            }
            Self::Laboratory(job) => {
                let seed = derived_seed(seed, Purpose::RegressLaboratories, []);
                Ok(RegressRecord::Laboratory(Box::new(RobustnessRecord::of(*job, seed)?)))
            }
            Self::Files(job) => {
                let seed = derived_seed(seed, Purpose::RegressFiles, []);
                Ok(RegressRecord::Files(Box::new(MisreadRecord::of(job, seed)?)))
            }
        }
    }

    fn name(&self) -> String {
        match self {
            Self::Machine(s, _) => format!("{} without noise", s.name),
            Self::Fit(s, _) => s.name.to_owned(),
            Self::Diagnose(kind, _) => kind.name().to_owned(),
            Self::Laboratory(job) => job.name(),
            Self::Files(job) => job.name(),
        }
    }
}

fn machine(subject: &HiddenSubject, index: usize) -> Result<Noiseless, TrialError> {
    recover(subject, &RecoveryCampaign::draw(subject, index, MACHINES_SEED, None)?)
}

impl SuiteTrials {
    fn add(&mut self, job: &RegressJob, answer: TrialResult<RegressRecord>) {
        let record = answer.map_err(|why| self.failures.push(format!("{}: {why}", job.name()))).ok();
        macro_rules! found {
            ($kind:ident) => {
                record.and_then(|r| if let RegressRecord::$kind(found) = r { Some(found) } else { None })
            };
        }
        match *job {
            RegressJob::Machine(subject, _) => {
                self.machines.push(OfSubject { subject, found: found!(Machine) });
            }
            RegressJob::Fit(subject, _) => self.fits.push(OfSubject { subject, found: found!(Fit) }),
            RegressJob::Diagnose(..) => self.answers.push(found!(Answer).map(|found| *found)),
            RegressJob::Laboratory(_) => self.laboratories.push(found!(Laboratory).map(|found| *found)),
            RegressJob::Files(_) => self.files.push(found!(Files).map(|found| *found)),
        }
    }

    /// Campaigns fitted by the right model that gave an answer.
    pub fn fitted(&self) -> impl Iterator<Item = (&HiddenSubject, &Fitted)> {
        self.fits.iter().filter_map(|f| Some((&f.subject, f.found.as_ref()?)))
    }

    /// Campaigns diagnosed that gave an answer.
    pub fn answered(&self) -> impl Iterator<Item = &Answered> {
        self.answers.iter().flatten()
    }
}
