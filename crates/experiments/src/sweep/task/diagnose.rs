//! The diagnosis is asked what is hidden.

use crate::Trial;
use crate::calibration::Fate;
use hexbench_core::Dataset;
use hexbench_core::statistics::root_mean_square;
use hexbench_model::inference::explanation::Explanation;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{StepReport, diagnose};
use hexbench_model::terms::catalogue;

use rand_pcg::Pcg64;

use super::blocks;
use crate::sized::SizeUnit;
use crate::sweep::bench::BlockSetup;
use crate::sweep::cells::GridCell;
use crate::sweep::columns::{OTHER_ANSWERS, Status, hidden_sets, names};
use crate::sweep::draw::{SweepPurpose, generator};
use crate::sweep::ideal::Ideal;
use crate::sweep::runner::Runner;
use crate::sweep::shard::{Shard, Value};
use crate::trial::reported;

/// Runs the trials of a shard.
pub fn run(runner: &Runner, shard: &mut Shard) {
    let seed = runner.study().seed;
    let words = Words { names: names(), sets: hidden_sets(runner.study()) };
    blocks(
        runner,
        shard,
        |bench, _| Ok(bench),
        |bench, cell, trial, shard| match values(bench, cell, seed, trial, &words) {
            Some(values) => shard.push(values.into_iter().chain(bench.index_values())),
            None => shard.push_failed(Status::NoFit),
        },
    );
}

fn values(
    bench: &BlockSetup,
    cell: &GridCell<'_>,
    seed: u64,
    trial: u64,
    words: &Words,
) -> Option<[Value; 10]> {
    let mut rng = generator(seed, SweepPurpose::Noise, cell.index, trial);
    let [measurements, holdout] =
        measured(bench, &mut rng, |purpose| generator(seed, purpose, cell.position[0], trial));
    let study = diagnose(&bench.hexapod, &measurements, Some(&holdout), &catalogue()).ok()?;
    let hidden = bench.hidden.iter().copied().map(in_the_catalogue).collect();
    let trial = Trial { hidden, study };
    let d = &trial.study.diagnosis;
    let first = d.candidates.first();
    let chi2 = |step: Option<&StepReport>| {
        Value::Number(step.and_then(|s| s.holdout).map_or(f64::NAN, |h| h.chi2_reduced))
    };
    let named = |term: &str| words.names.iter().position(|n| n == term);
    Some([
        code(Fate::ALL.iter().position(|fate| *fate == Fate::of(&trial))),
        code(Verdict::ALL.iter().position(|verdict| *verdict == d.verdict)),
        code(words.answer(&trial)),
        Value::Number(bench.true_size.unwrap_or(f64::NAN)),
        Value::Number(estimated_size(&trial).unwrap_or(f64::NAN)),
        code(first.and_then(|c| named(c.term.word()))),
        Value::Number(first.map_or(f64::NAN, |c| c.probability)),
        code(Some(d.added.len())),
        chi2(d.steps.first()),
        chi2(d.steps.last()),
    ])
}

/// Readings to learn from and to judge by, as the laboratory takes and writes them.
pub(super) fn measured(
    bench: &BlockSetup,
    noise: &mut Pcg64,
    stream: impl Fn(SweepPurpose) -> Pcg64,
) -> [Dataset; 2] {
    let (laboratory, fault) = (bench.laboratory, bench.laboratory.fault);
    let mut of_part = |ideal: &Ideal, source, errors| {
        let mut data = ideal.dataset_of(source, noise, laboratory, &mut stream(errors));
        // The same stream for both parts: they come from the same hands.
        fault.write(&mut data, &mut stream(SweepPurpose::LaboratoryWriting));
        data
    };
    let mut measurements = of_part(&bench.training, "measurements.csv", SweepPurpose::LaboratoryErrors);
    let holdout = of_part(&bench.holdout, "holdout.csv", SweepPurpose::LaboratoryHoldout);
    fault.slip(&mut measurements, &bench.noise.sigma(), &mut stream(SweepPurpose::LaboratorySlips));
    [measurements, holdout]
}

/// Bending plates and bases are effects of the catalogue, of a form richer than its own.
pub(crate) fn in_the_catalogue(id: &'static str) -> &'static str {
    match id {
        "out:base-bending" => "base-compliance",
        "out:plate-bending" => "platform-compliance",
        _ => id,
    }
}

/// A number below 255; no value else.
fn code(number: Option<usize>) -> Value {
    number.and_then(|n| u8::try_from(n).ok()).map_or(Value::Number(0.0), Value::Code)
}

/// What answers are called.
struct Words {
    /// What can be named first.
    names: Vec<String>,
    /// Effects that are hidden together somewhere in the study.
    sets: Vec<Vec<&'static str>>,
}

impl Words {
    /// Place of the answer among [`answers`](crate::sweep::columns::answers).
    fn answer(&self, trial: &Trial) -> Option<usize> {
        let d = &trial.study.diagnosis;
        let effects = self.names.len() - Explanation::SPECIAL.len();
        let other = |k: usize| Some(effects + k);
        match (d.verdict, reported(d).as_slice()) {
            (Verdict::Adequate, []) => other(0),
            (Verdict::Adequate | Verdict::Named, [one]) => self.names.iter().position(|name| name == one),
            (Verdict::Adequate | Verdict::Named, several) => match self.set(several) {
                Some(k) => other(OTHER_ANSWERS.len() + k),
                None => other(1),
            },
            (Verdict::Ambiguous, _) => other(2),
            (Verdict::Outside, _) => other(3),
            (Verdict::Measurement, _) => other(4),
            (Verdict::Undecided, _) => other(5),
        }
    }

    /// Place of exactly these effects among the sets.
    fn set(&self, named: &[String]) -> Option<usize> {
        let same =
            |set: &Vec<&str>| set.len() == named.len() && named.iter().all(|id| set.contains(&id.as_str()));
        self.sets.iter().position(same)
    }
}

/// Size of the one hidden effect in the final model: root mean square of its parameters in the unit of its kind; none where one of them is
/// not determined, which would leave its share out.
fn estimated_size(trial: &Trial) -> Option<f64> {
    let [hidden] = trial.hidden[..] else { return None };
    let d = &trial.study.diagnosis;
    let unit = SizeUnit::of(hidden)?.unit;
    let own = |name: &str| name.strip_prefix(hidden).is_some_and(|rest| rest.starts_with('.'));
    if d.richer.iter().any(|id| id == hidden) || d.not_determined.iter().any(|name| own(name)) {
        return None;
    }
    let found = d.parameters.iter().filter(|p| p.unit == unit && own(&p.name));
    root_mean_square(found.map(|p| p.value))
}
