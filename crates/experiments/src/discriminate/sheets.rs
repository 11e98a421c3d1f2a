//! Tables of the study.

use super::{DiscriminateRecord, Discrimination};
use hexbench_core::statistics::{Proportion, mean};
use hexbench_report::Table;

use crate::pages::by_columns;
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
    records.iter().filter(|r| is_open(r))
}

fn is_open(record: &DiscriminateRecord) -> bool {
    record.readings > 0
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
    compared(study, ("open answers", is_open), |r| r.readings, |r| r.proposed, |r| r.proposed_random)
}

/// After readings chosen for the pair, beside as many at random.
pub fn asked(study: &Discrimination) -> Table {
    compared(study, ("trials", |_| true), |r| r.asked_readings, |r| r.asked, |r| r.asked_random)
}

/// Mean number of readings; zero of no trials.
pub(super) fn mean_readings(
    records: &[&DiscriminateRecord],
    readings: fn(&DiscriminateRecord) -> usize,
) -> f64 {
    mean(records.iter().map(|r| readings(r) as f64)).unwrap_or(0.0)
}

/// What became of every pair, then of all together, in the trials that count.
fn compared(
    study: &Discrimination,
    (trials, counts): (&str, fn(&DiscriminateRecord) -> bool),
    readings: fn(&DiscriminateRecord) -> usize,
    chosen: Stage,
    random: Stage,
) -> Table {
    type Row<'a> = (String, Vec<&'a DiscriminateRecord>);
    let all = study.records();
    let pairs = study.pairs.iter().map(|(pair, records)| (pair.name(), &records[..]));
    let named = pairs.chain([("all".to_owned(), &all[..])]);
    let rows = named.map(|(name, records)| (name, records.iter().filter(|r| counts(r)).collect()));
    let of = |row: &Row<'_>, stage: Stage, wanted| rounded(share(row.1.iter().copied(), stage, wanted));
    by_columns(
        rows,
        &[
            ("effects", &|row: &Row<'_>| row.0.clone()),
            (trials, &|row| row.1.len().to_string()),
            ("readings", &|row| format!("{:.1}", mean_readings(&row.1, readings))),
            ("right before", &|row| of(row, |r| r.before, Outcome::Right)),
            ("right after chosen", &|row| of(row, chosen, Outcome::Right)),
            ("right after random", &|row| of(row, random, Outcome::Right)),
            ("wrong after chosen", &|row| of(row, chosen, Outcome::Wrong)),
            ("wrong after random", &|row| of(row, random, Outcome::Wrong)),
        ],
    )
}

/// `91 % (85 .. 95)`.
pub fn rounded(p: Proportion) -> String {
    if p.of == 0 {
        return "-".to_owned();
    }
    let [low, high] = p.interval().map(|x| (100.0 * x).round());
    format!("{:.0} % ({low} .. {high})", 100.0 * p.rate())
}
