//! The second half: one campaign read in ways that tell the same, whole and with empty cells.

use hexbench_core::statistics::Proportion;
use hexbench_model::inference::verdict::Verdict;
use hexbench_truth::campaign::{AlikeReadings, CaseKind, SimulatedCase};
use serde::{Deserialize, Serialize};

use crate::calibration::COVERED;
use crate::harness::words::{self, Word};
use crate::harness::{self, Field, Study};
use crate::journal::Identity;
use crate::robustness::distances;
use crate::trial::{Outcome, Trial, TrialError};

/// Campaigns of the committed figures, each read in every way, whole and with empty cells.
pub const ALIKE: u32 = 200;
/// One campaign in so many has an effect.
const WITH_EFFECT: u64 = 4;

/// What is run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AlikeProtocol {
    /// Decides everything that is drawn.
    pub seed: u64,
    /// Campaigns: three on clean machines, then one with an effect.
    pub campaigns: u64,
}

/// Kind of a campaign, and number within the kind.
type AlikeJob = (CaseKind, usize);

/// What was said of a campaign read in one way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AlikeAnswer {
    /// The verdict.
    pub verdict: Verdict,
    /// Effects named.
    pub added: Vec<String>,
    /// Right, honest or wrong about the machine.
    pub outcome: Outcome,
    /// Leg stiffnesses and their standard deviations, N/um; none where they are not determined.
    pub stiffness: [Option<[f64; 2]>; 6],
}

/// A campaign and what was said of it, read in every way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AlikeRecord {
    /// The hidden effect.
    #[serde(with = "words::list")]
    pub hidden: Vec<Word>,
    /// Leg stiffnesses as they are, N/um.
    pub true_stiffness: [f64; 6],
    /// Read whole, in the order of [`AlikeReadings::ALL`].
    pub whole: [AlikeAnswer; 3],
    /// Read with a fifth of the cells empty.
    pub with_gaps: [AlikeAnswer; 3],
}

impl AlikeAnswer {
    fn of(case: &SimulatedCase) -> Result<Self, TrialError> {
        let trial = Trial::run(case)?;
        let d = &trial.study.diagnosis;
        let stiffness = |leg: usize| {
            let estimate = d.stiffness(leg)?;
            (estimate.std > 0.0).then_some([estimate.value, estimate.std])
        };
        Ok(Self {
            verdict: d.verdict,
            added: d.added.clone(),
            outcome: trial.outcome(),
            stiffness: std::array::from_fn(stiffness),
        })
    }

    /// True when the same is said of the machine.
    pub fn says_the_same(&self, other: &Self) -> bool {
        self.verdict == other.verdict && self.added == other.added
    }

    /// Stiffnesses in both answers: value and standard deviation here and there.
    fn beside<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = [[f64; 2]; 2]> + 'a {
        self.stiffness.iter().zip(&other.stiffness).filter_map(|(a, b)| Some([(*a)?, (*b)?]))
    }
}

impl AlikeRecord {
    fn of(protocol: &AlikeProtocol, job: AlikeJob) -> Result<Self, TrialError> {
        let answer = |way, gaps| AlikeAnswer::of(&protocol.read(job, way, gaps)?);
        let all = |gaps| -> Result<[AlikeAnswer; 3], TrialError> {
            let [a, b, c] = AlikeReadings::ALL;
            Ok([answer(a, gaps)?, answer(b, gaps)?, answer(c, gaps)?])
        };
        let case = protocol.sampled(job)?;
        Ok(Self {
            hidden: case.spec.hidden_effects(),
            true_stiffness: case.campaign.world.leg_stiffness_n_per_um(),
            whole: all(false)?,
            with_gaps: all(true)?,
        })
    }

    /// Largest difference of a stiffness from that of the pose, in standard deviations.
    pub fn apart(&self, way: usize) -> f64 {
        let [pose, other] = [&self.whole[0], &self.whole[way]];
        pose.beside(other).map(|[a, b]| (a[0] - b[0]).abs() / a[1]).fold(0.0, f64::max)
    }

    /// Largest relative difference of a standard deviation from that of the pose.
    pub fn std_apart(&self, way: usize) -> f64 {
        let [pose, other] = [&self.whole[0], &self.whole[way]];
        pose.beside(other).map(|[a, b]| (b[1] / a[1] - 1.0).abs()).fold(0.0, f64::max)
    }

    /// Standard deviations with empty cells over those without, where both say the same.
    pub fn widened(&self, way: usize) -> Vec<f64> {
        let [whole, gaps] = [&self.whole[way], &self.with_gaps[way]];
        if !whole.says_the_same(gaps) {
            return Vec::new();
        }
        whole.beside(gaps).map(|[a, b]| b[1] / a[1]).collect()
    }

    /// Leg stiffnesses within 1.96 of their standard deviations.
    pub fn coverage(&self, answer: &AlikeAnswer) -> Proportion {
        let stated = answer.stiffness.iter().zip(&self.true_stiffness);
        let z = stated.filter_map(|(s, truth)| s.map(|[value, std]| (value - truth) / std));
        Proportion::count(z, |z| z.abs() <= COVERED)
    }
}

impl AlikeProtocol {
    /// Three campaigns on clean machines, then one with an effect.
    fn job(number: u64) -> AlikeJob {
        let with_effect = number % WITH_EFFECT == WITH_EFFECT - 1;
        let before = number / WITH_EFFECT;
        let [kind, index] = if with_effect { [1, before] } else { [0, number - before] };
        let kind = if kind == 1 { CaseKind::Single } else { CaseKind::Clean };
        (kind, usize::try_from(index).unwrap_or(usize::MAX))
    }

    /// A campaign in full poses.
    fn sampled(&self, (kind, index): AlikeJob) -> Result<SimulatedCase, TrialError> {
        Ok(SimulatedCase::draw(kind, index, self.seed, distances(kind))?)
    }

    /// The same read in one of the ways, whole or with empty cells.
    fn read(&self, job: AlikeJob, way: AlikeReadings, gaps: bool) -> Result<SimulatedCase, TrialError> {
        let mut case = self.sampled(job)?;
        case.read_alike(way, gaps)?;
        Ok(case)
    }

    /// The campaign of one trial by its name, such as `alike/clean-0003`, as its files are written in every way in which it is read, each
    /// with a name of its own, such as `six-distances-gaps`; none of a name that is no trial.
    pub fn cases(&self, name: &str) -> Option<Result<Vec<(String, SimulatedCase)>, TrialError>> {
        let job =
            (0..self.campaigns).map(Self::job).find(|job| harness::Protocol::name(self, job) == name)?;
        let ways = [(false, ""), (true, "-gaps")]
            .into_iter()
            .flat_map(|gaps| AlikeReadings::ALL.map(|way| (way, gaps)));
        let read = |(way, (gaps, end)): (AlikeReadings, (bool, &str))| {
            let name = format!("{}{end}", way.words().replace(' ', "-"));
            Ok((name, self.read(job, way, gaps)?))
        };
        Some(ways.map(read).collect())
    }
}

/// A column of the table of trials.
type Column = Field<AlikeRecord>;

impl harness::Protocol for AlikeProtocol {
    type Job = AlikeJob;
    type Record = AlikeRecord;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let settings = [("campaigns", self.campaigns.to_string()), ("seed", self.seed.to_string())];
        Identity::new("sensors-alike", "sensor-alike-trials/1", settings)
    }

    fn jobs(&self) -> Vec<AlikeJob> {
        (0..self.campaigns).map(Self::job).collect()
    }

    fn trial(&self, job: &AlikeJob) -> Result<AlikeRecord, TrialError> {
        AlikeRecord::of(self, *job)
    }

    fn name(&self, (kind, index): &AlikeJob) -> String {
        format!("alike/{}-{index:04}", kind.name())
    }

    fn fields(&self) -> Vec<Column> {
        let hidden = Column::text("hidden", "hidden effect", |r| r.hidden.join("+"));
        let of_way = |(k, way): (usize, AlikeReadings)| {
            let name = move |what: &str| format!("{}_{what}", way.words().replace(' ', "_"));
            [
                Column::text(&name("verdict"), "the verdict", move |r| r.whole[k].verdict.word()),
                Column::text(&name("added"), "effects named", move |r| r.whole[k].added.join("+")),
                Column::text(&name("gaps_added"), "the same with empty cells", move |r| {
                    r.with_gaps[k].added.join("+")
                }),
                Column::number(
                    name("apart"),
                    "largest difference of a stiffness from that of the pose over its standard deviation",
                    move |r| r.apart(k),
                ),
            ]
        };
        std::iter::once(hidden).chain(AlikeReadings::ALL.into_iter().enumerate().flat_map(of_way)).collect()
    }

    fn trials_of_a_shard(&self) -> u64 {
        1
    }
}

/// All campaigns of a protocol, each with an answer in every way.
pub type AlikeStudy = Study<AlikeProtocol>;
