//! Every experiment, stopped in the middle, goes on where it was and ends with the same results, on any number of threads.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use hexbench_design::power::PowerSettings;
use hexbench_experiments::ExperimentError;
use hexbench_experiments::calibration;
use hexbench_experiments::discovery::DiscoveryProtocol;
use hexbench_experiments::discriminate::{self, CONFUSIONS};
use hexbench_experiments::harness::{self, Field, Gathered, Progress, Protocol, Sharded, Silent, compute};
use hexbench_experiments::interactions::InteractionsProtocol;
use hexbench_experiments::journal::{Identity, Journal};
use hexbench_experiments::misread::MisreadProtocol;
use hexbench_experiments::paper::Again;
use hexbench_experiments::power::{Campaigns, Simulation, plan_of};
use hexbench_experiments::recovery::protocol::Recovery;
use hexbench_experiments::recovery::study::RecoverySettings;
use hexbench_experiments::regress::suite::RegressSuite;
use hexbench_experiments::regress::trials::SuiteRuns;
use hexbench_experiments::robustness;
use hexbench_experiments::sensors::{AlikeProtocol, SensorProtocol};
use hexbench_experiments::sweep::{Runner, results};
use hexbench_model::terms::catalogue;
use hexbench_truth::Scene;

use crate::sweep::support::study;

/// A study of three shards.
const SWEEP: &str = "trials = 1100\ntask = \"springs\"\nredraw = 50\n[axes]\ngeometry = [\"ring_a\"]\nplan = [\"random\"]\n\
                     poses = [3]\nnoise_scale = [1, 2]\n";

/// Stops an experiment after some trials, and remembers what it heard.
#[derive(Default)]
pub(crate) struct StopAfter {
    pub(crate) trials: u64,
    pub(crate) done: AtomicU64,
    pub(crate) known: AtomicU64,
    pub(crate) damaged: AtomicU64,
}

impl StopAfter {
    pub(crate) fn new(trials: u64) -> Self {
        Self { trials, ..Self::default() }
    }
}

impl Progress for StopAfter {
    fn begin(&self, _: u64, known: u64) {
        self.known.store(known, Ordering::Relaxed);
    }

    fn damaged(&self, records: u64) {
        self.damaged.store(records, Ordering::Relaxed);
    }

    fn advance(&self, trials: u64) {
        self.done.fetch_add(trials, Ordering::Relaxed);
    }

    fn is_stopped(&self) -> bool {
        self.done.load(Ordering::Relaxed) >= self.trials
    }
}

/// All that was gathered, to the last bit.
fn bits<P: Protocol>(gathered: &Gathered<P::Record>) -> Vec<u8> {
    postcard::to_stdvec(&gathered.answers).unwrap()
}

fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(work)
}

fn shards(folder: &Path) -> Vec<PathBuf> {
    let all = fs::read_dir(folder.join("journal")).unwrap().map(|entry| entry.unwrap().path());
    let mut shards: Vec<PathBuf> = all.filter(|p| p.extension().is_some_and(|e| e == "shard")).collect();
    shards.sort();
    shards
}

/// Four trials of a protocol, from all over it, each a shard.
struct Few<'a, P>(&'a P);

impl<P: Protocol> Few<'_, P> {
    const TRIALS: usize = 4;
}

fn trials<P: Protocol>(protocol: &P) -> u64 {
    protocol.jobs().len() as u64
}

impl<P: Protocol> Protocol for Few<'_, P> {
    type Job = P::Job;
    type Record = P::Record;
    type Error = P::Error;

    fn identity(&self) -> Identity {
        self.0.identity()
    }

    fn jobs(&self) -> Vec<P::Job> {
        let all = self.0.jobs();
        let (count, kept) = (all.len(), Self::TRIALS.min(all.len()));
        let chosen: Vec<usize> = (0..kept).map(|number| number * count / kept).collect();
        all.into_iter()
            .enumerate()
            .filter(|(number, _)| chosen.contains(number))
            .map(|(_, job)| job)
            .collect()
    }

    fn trial(&self, job: &P::Job) -> Result<Self::Record, Self::Error> {
        self.0.trial(job)
    }

    fn name(&self, job: &P::Job) -> String {
        self.0.name(job)
    }

    fn fields(&self) -> Vec<Field<Self::Record>> {
        self.0.fields()
    }

    fn trials_of_a_shard(&self) -> u64 {
        1
    }
}

/// Stops some trials of `protocol` in the middle, damages a shard, goes on on another number of threads; `other` is the same with other
/// settings.
fn survives<P: Protocol>(protocol: &P, other: &P) {
    survives_whole(&Few(protocol), &Few(other));
}

fn survives_whole<P: Protocol>(protocol: &P, other: &P) {
    let folder = tempfile::tempdir().unwrap();
    let unbroken = on_threads(1, || harness::run(protocol, None, &Silent)).unwrap();
    assert!(unbroken.records().count() > 0, "nothing has an answer");

    let half = StopAfter::new(trials(protocol) / 2);
    let stopped = on_threads(1, || harness::run(protocol, Some(folder.path()), &half).err().unwrap());
    assert!(matches!(stopped, ExperimentError::Stopped), "{stopped}");
    let kept = shards(folder.path());
    assert!(!kept.is_empty(), "nothing was kept");
    let torn = fs::read(&kept[0]).unwrap();
    fs::write(&kept[0], &torn[..torn.len() - 1]).unwrap();

    let rest = StopAfter::new(u64::MAX);
    let resumed = on_threads(3, || harness::run(protocol, Some(folder.path()), &rest)).unwrap();
    assert_eq!(bits::<P>(&unbroken), bits::<P>(&resumed));
    let csv = |gathered| {
        let mut text = Vec::new();
        harness::table(protocol, gathered)
            .write(hexbench_report::table::TableFormat::Csv, &mut text)
            .unwrap();
        String::from_utf8(text).unwrap()
    };
    assert_eq!(csv(&unbroken), csv(&resumed));
    assert_eq!(csv(&resumed).lines().count() as u64, 1 + trials(protocol));
    assert_eq!(rest.damaged.into_inner(), 1);
    assert_eq!(rest.known.into_inner() + rest.done.into_inner(), trials(protocol));
    assert_eq!(torn, fs::read(&kept[0]).unwrap(), "the shard that was damaged is another one now");

    let again = StopAfter::new(u64::MAX);
    let known = harness::run(protocol, Some(folder.path()), &again).unwrap();
    assert_eq!((bits::<P>(&known), again.done.into_inner()), (bits::<P>(&unbroken), 0));
    let refused = harness::run(other, Some(folder.path()), &Silent).err().unwrap();
    assert!(matches!(refused, ExperimentError::Foreign { .. }), "{refused}");
    assert!(
        refused.to_string().contains("there seed is") || refused.to_string().contains("settings"),
        "{refused}"
    );
}

#[test]
fn recovery_goes_on_where_it_was_stopped() {
    let protocol = |seed| Recovery::new(RecoverySettings { campaigns: 1, diagnoses: 1, seed });
    survives(&protocol(3), &protocol(4));
}

#[test]
fn calibration_goes_on_where_it_was_stopped() {
    let protocol = |seed| calibration::CalibrationProtocol::default().with_trials(14).with_seed(seed);
    survives(&protocol(3), &protocol(4));
}

#[test]
fn robustness_goes_on_where_it_was_stopped() {
    let protocol = |seed| {
        robustness::RobustnessProtocol { seed, trials: 4, ..Default::default() }
            .with_faults(&["drift-1", "joints-0.2mm"])
    };
    survives(&protocol(3), &protocol(4));
}

#[test]
fn a_study_of_sensors_goes_on_where_it_was_stopped() {
    let protocol = |seed| SensorProtocol { seed, trials: 1 };
    survives(&protocol(3), &protocol(4));
    let protocol = |seed| AlikeProtocol { seed, campaigns: 2 };
    survives(&protocol(3), &protocol(4));
}

#[test]
fn a_study_of_misread_files_goes_on_where_it_was_stopped() {
    let protocol = |seed| {
        MisreadProtocol { seed, trials: 2, sound: 4, ..Default::default() }
            .with_misstatements(&["wrench-negated", "holdout-is-training"])
    };
    survives(&protocol(3), &protocol(4));
}

#[test]
fn a_study_of_laws_goes_on_where_it_was_stopped() {
    let protocol = |seed| DiscoveryProtocol { seed, outside: 2, listed: 2, clean: 6 };
    survives(&protocol(3), &protocol(4));
}

#[test]
fn effects_that_act_together_go_on_where_they_were_stopped() {
    let protocol = |seed| {
        let all = InteractionsProtocol::new(seed, 0);
        InteractionsProtocol { sets: all.sets[..5].to_vec(), ..all }
    };
    survives(&protocol(3), &protocol(4));
}

#[test]
fn discrimination_goes_on_where_it_was_stopped() {
    let protocol = |seed| discriminate::PairTrials {
        protocol: discriminate::DiscriminateProtocol { seed, trials: 5 },
        confusions: &CONFUSIONS[3..5],
    };
    survives(&protocol(3), &protocol(4));
}

#[test]
fn power_goes_on_where_it_was_stopped() {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/paper-rich");
    let plan = plan_of(&Scene::read(&scene).unwrap()).unwrap();
    let terms: Vec<_> = catalogue().into_iter().filter(|t| t.info().id == "leg-coupling").collect();
    let protocol = |seed| {
        let settings = PowerSettings { draws: 20, seed, ..PowerSettings::default() };
        Campaigns::new(&plan, &terms, settings, Simulation { campaigns: 6, diagnoses: true }, &[]).unwrap()
    };
    survives(&protocol(3), &protocol(4));
}

#[test]
fn a_run_of_the_regression_goes_on_where_it_was_stopped() {
    let suite = RegressSuite::quick();
    survives(&SuiteRuns::new(&suite, 3, 2), &SuiteRuns::new(&suite, 4, 2));
}

#[test]
fn a_regression_of_more_runs_goes_on_where_one_of_fewer_ended() {
    let (suite, folder) = (RegressSuite::quick(), tempfile::tempdir().unwrap());
    let (one, two) = (SuiteRuns::new(&suite, 3, 1), SuiteRuns::new(&suite, 3, 2));
    let first = harness::run(&one, Some(folder.path()), &Silent).unwrap();
    let heard = StopAfter::new(u64::MAX);
    let both = harness::run(&two, Some(folder.path()), &heard).unwrap();
    assert!(heard.known.into_inner() + 4 > trials(&one) && heard.damaged.into_inner() == 0);
    let beginning = Gathered { answers: both.answers[..first.answers.len()].to_vec() };
    assert_eq!(bits::<SuiteRuns>(&first), bits::<SuiteRuns>(&beginning));
}

#[test]
fn the_papers_plan_under_other_noise_goes_on_where_it_was_stopped() {
    let protocol = |seed| Again { seed, support_motion: [2e-6, 2e-6, -2e-6] };
    survives(&protocol(3), &protocol(4));
}

#[test]
fn the_journal_of_another_experiment_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let again = Again { seed: 1, support_motion: [2e-6, 2e-6, -2e-6] };
    let stopped = harness::run(&again, Some(folder.path()), &StopAfter::new(0));
    assert!(matches!(stopped, Err(ExperimentError::Stopped)));
    let suite = RegressSuite::quick();
    let refused = harness::run(&SuiteRuns::new(&suite, 1, 1), Some(folder.path()), &Silent).err().unwrap();
    assert!(refused.to_string().contains("another experiment"), "{refused}");
}

#[test]
fn a_sweep_goes_on_where_it_was_stopped() {
    let (folder, whole) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let runner = Runner::new(study(SWEEP)).unwrap();
    let work = |folder: &Path, progress: &dyn Progress| {
        let journal = Journal::open(folder, runner.identity(), runner.shards())?;
        let pending = journal.state()?.pending;
        compute(&journal, &runner, &pending, progress)?;
        results::write(&runner, &journal, &|| ())?;
        Ok(pending.len())
    };
    let stopped = on_threads(1, || work(folder.path(), &StopAfter::new(1)));
    assert!(matches!(stopped, Err(ExperimentError::Stopped)));
    assert_eq!(shards(folder.path()).len(), 1);
    assert_eq!(on_threads(3, || work(folder.path(), &Silent)).unwrap(), 2);
    assert_eq!(on_threads(1, || work(whole.path(), &Silent)).unwrap(), 3);
    for name in [results::TRIALS, results::CELLS] {
        let [resumed, unbroken] = [&folder, &whole].map(|f| fs::read(f.path().join(name)).unwrap());
        assert!(resumed == unbroken, "{name} differs");
    }
}
