//! The diagnosis is asked what is hidden.

use crate::{Outcome, Trial};
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{StepReport, diagnose};
use hexbench_model::terms::catalogue;

use super::blocks;
use crate::sweep::bench::BlockSetup;
use crate::sweep::cells::GridCell;
use crate::sweep::columns::{Status, names};
use crate::sweep::draw::{SweepPurpose, drawn};
use crate::sweep::runner::Runner;
use crate::sweep::shard::{Shard, Value};

/// Runs the trials of a shard.
pub fn run(runner: &Runner, shard: &mut Shard) {
    let seed = runner.study().seed;
    let names = names();
    blocks(
        runner,
        shard,
        |bench, _| Ok(bench),
        |bench, cell, trial, shard| match values(bench, cell, seed, trial, &names) {
            Some(values) => shard.push(values),
            None => shard.push_failed(Status::NoFit),
        },
    );
}

fn values(
    bench: &BlockSetup,
    cell: &GridCell<'_>,
    seed: u64,
    trial: u64,
    names: &[String],
) -> Option<[Value; 7]> {
    let mut rng = drawn(seed, SweepPurpose::Noise, cell.index, trial);
    let measurements = bench.training.dataset("measurements.csv", Some(&mut rng));
    let holdout = bench.holdout.dataset("holdout.csv", Some(&mut rng));
    let study = diagnose(&bench.hexapod, &measurements, Some(&holdout), &catalogue()).ok()?;
    let hidden = bench.hidden.map(in_the_catalogue).into_iter().collect();
    let trial = Trial { hidden, study };
    let d = &trial.study.diagnosis;
    let first = d.candidates.first();
    let chi2 = |step: Option<&StepReport>| {
        Value::Number(step.and_then(|s| s.holdout).map_or(f64::NAN, |h| h.chi2_reduced))
    };
    let named = |term: &str| names.iter().position(|n| n == term);
    Some([
        Value::Code(outcome(trial.outcome())),
        Value::Code(verdict(d.verdict)),
        code(first.and_then(|c| named(c.term.word()))),
        Value::Number(first.map_or(f64::NAN, |c| c.probability)),
        code(Some(d.added.len())),
        chi2(d.steps.first()),
        chi2(d.steps.last()),
    ])
}

/// Bending plates and bases are effects of the catalogue, of a form richer than its own.
fn in_the_catalogue(id: &'static str) -> &'static str {
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

fn outcome(outcome: Outcome) -> u8 {
    match outcome {
        Outcome::Right => 0,
        Outcome::Honest => 1,
        Outcome::Wrong => 2,
    }
}

fn verdict(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Adequate => 0,
        Verdict::Named => 1,
        Verdict::Ambiguous => 2,
        Verdict::Outside => 3,
        Verdict::Measurement => 4,
        Verdict::Undecided => 5,
    }
}
