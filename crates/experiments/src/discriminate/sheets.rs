//! Tables of the study.

use super::{ConfusedPair, DiscriminateRecord, Discrimination};
use hexbench_core::statistics::{Proportion, mean};
use hexbench_report::Table;

use crate::trial::Outcome;

/// What was said at one stage of a trial.
pub type Stage = fn(&DiscriminateRecord) -> Outcome;

/// Share of trials with an outcome at a stage.
pub fn share<'a>(
    records: impl IntoIterator<Item = &'a DiscriminateRecord>,
    stage: Stage,
    wanted: Outcome,
) -> Proportion {
    Proportion::count(records, |r| stage(r) == wanted)
}

/// The trials to which the diagnosis proposed readings.
pub fn open(records: &[DiscriminateRecord]) -> impl Iterator<Item = &DiscriminateRecord> {
    records.iter().filter(|r| r.readings > 0)
}

/// By the confusing plans alone.
pub fn before(study: &Discrimination) -> Table {
    let mut table = Table::named(["effects", "plan", "trials", "right", "honest", "wrong"]).words_in(1);
    for (confusion, records) in &study.pairs {
        let of = |o| rounded(share(records, |r| r.before, o));
        let start = [confusion.name(), confusion.plan.to_owned(), records.len().to_string()];
        table.row(start.into_iter().chain([Outcome::Right, Outcome::Honest, Outcome::Wrong].map(of)));
    }
    table
}

/// After the readings that the diagnosis proposes, where it proposes any, beside as many at random.
pub fn proposed(study: &Discrimination) -> Table {
    let mut table = compared("open answers");
    for_each(study, |name, records| {
        let records: Vec<&DiscriminateRecord> = open(records).collect();
        table.row(row(name, &records, |r| r.readings, |r| r.proposed, |r| r.proposed_random));
    });
    table
}

/// After readings chosen for the pair, beside as many at random.
pub fn asked(study: &Discrimination) -> Table {
    let mut table = compared("trials");
    for_each(study, |name, records| {
        let records: Vec<&DiscriminateRecord> = records.iter().collect();
        table.row(row(name, &records, |r| r.asked_readings, |r| r.asked, |r| r.asked_random));
    });
    table
}

/// Mean number of readings; zero of no trials.
pub(super) fn mean_readings(
    records: &[&DiscriminateRecord],
    readings: fn(&DiscriminateRecord) -> usize,
) -> f64 {
    mean(records.iter().map(|r| readings(r) as f64)).unwrap_or(0.0)
}

fn compared(trials: &str) -> Table {
    Table::named([
        "effects",
        trials,
        "readings",
        "right before",
        "right after chosen",
        "right after random",
        "wrong after chosen",
        "wrong after random",
    ])
}

/// Every pair, then all together.
fn for_each(study: &Discrimination, mut f: impl FnMut(String, &[DiscriminateRecord])) {
    let name = |c: &ConfusedPair| c.name();
    study.pairs.iter().for_each(|(c, records)| f(name(c), records));
    f("all".to_owned(), &study.records());
}

fn row(
    name: String,
    records: &[&DiscriminateRecord],
    readings: fn(&DiscriminateRecord) -> usize,
    chosen: Stage,
    random: Stage,
) -> [String; 8] {
    let of = |stage: Stage, o: Outcome| rounded(share(records.iter().copied(), stage, o));
    [
        name,
        records.len().to_string(),
        format!("{:.1}", mean_readings(records, readings)),
        of(|r| r.before, Outcome::Right),
        of(chosen, Outcome::Right),
        of(random, Outcome::Right),
        of(chosen, Outcome::Wrong),
        of(random, Outcome::Wrong),
    ]
}

/// `91 % (85 .. 95)`.
pub fn rounded(p: Proportion) -> String {
    if p.of == 0 {
        return "-".to_owned();
    }
    let [low, high] = p.interval().map(|x| (100.0 * x).round());
    format!("{:.0} % ({low} .. {high})", 100.0 * p.rate())
}
