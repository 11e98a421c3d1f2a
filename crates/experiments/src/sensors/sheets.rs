//! Summary tables.

use hexbench_core::statistics::Proportion;
use hexbench_report::Table;
use hexbench_report::number::hundredths;
use hexbench_truth::campaign::{AlikeReadings, SensorFault, SensorSet};

use super::{AlikeAnswer, AlikeRecord, AlikeStudy, SHOWN, SensorRecord, SensorStudy};
use crate::pages::by_columns;
use crate::shares::{counted, percent};

/// One line for each way of reading.
pub fn ways(study: &SensorStudy) -> Table {
    let is_right = |r: &&SensorRecord| r.of.is_right();
    let is_open = |r: &&SensorRecord| !is_right(r) && r.of.answer.hidden.iter().all(|id| contains(r, id));
    let of = |row: &Row<'_>, is_clean: bool, is_so: &dyn Fn(&&SensorRecord) -> bool| {
        let among = row.1.iter().copied().filter(|r| r.of.is_clean() == is_clean);
        counted(Proportion::count(among, is_so))
    };
    by_columns(
        SensorSet::ALL.map(|set| (set.word(), study.of_group(set.word()))),
        &[
            ("read", &|row| row.0.to_owned()),
            ("clean right", &|row| of(row, true, &is_right)),
            ("effect first", &|row| of(row, false, &is_right)),
            ("effect open", &|row| of(row, false, &is_open)),
            ("named falsely", &named_falsely),
            ("told", &|row| counted(Proportion::count(row.1.iter(), |r| !r.of.findings.is_empty()))),
            ("stiffness in 95 %", &stiffness),
        ],
    )
}

/// One line for each fault of a sensor.
pub fn faults(study: &SensorStudy) -> Table {
    let named = |row: &Row<'_>, shown: bool| {
        counted(Proportion::count(row.1.iter().filter(|r| r.shows_fault() == shown), |r| r.is_named()))
    };
    let shown = |row: &Row<'_>| row.1.iter().filter(|r| r.shows_fault()).count();
    by_columns(
        SensorFault::ALL.map(|fault| (fault.word(), study.of_group(fault.word()))),
        &[
            ("fault", &|row| row.0.to_owned()),
            ("shown by the readings", &|row| format!("{} of {}", shown(row), row.1.len())),
            ("of these named", &|row| named(row, true)),
            ("of the others named", &|row| named(row, false)),
            ("effect named falsely", &named_falsely),
            ("stiffness in 95 %", &stiffness),
        ],
    )
}

/// Name of a group and its trials.
type Row<'a> = (&'static str, Vec<&'a SensorRecord>);

fn named_falsely((_, records): &Row<'_>) -> String {
    counted(Proportion::count(records.iter(), |r| r.of.names_falsely()))
}

fn stiffness((_, records): &Row<'_>) -> String {
    percent(records.iter().map(|r| r.of.stiffness_coverage()).sum())
}

/// Bounds of the chi-square that a fault adds: three, six, ten standard deviations.
const BANDS: [f64; 5] = [f64::NEG_INFINITY, 9.0, SHOWN, 100.0, f64::INFINITY];

/// How often a fault is named, by how much of it the readings show.
pub fn shown(study: &SensorStudy, fault: SensorFault) -> Table {
    let mut table = Table::named(["chi-square of the fault", "campaigns", "named", "effect named falsely"]);
    let records = study.of_group(fault.word());
    for band in BANDS.windows(2) {
        let within = |r: &&&SensorRecord| r.information.is_some_and(|chi2| chi2 > band[0] && chi2 <= band[1]);
        let here: Vec<_> = records.iter().filter(within).collect();
        let words = match (band[0].is_finite(), band[1].is_finite()) {
            (false, _) => format!("to {}", band[1]),
            (_, false) => format!("above {}", band[0]),
            _ => format!("{} to {}", band[0], band[1]),
        };
        table.row([
            words,
            here.len().to_string(),
            counted(Proportion::count(here.iter(), |r| r.is_named())),
            counted(Proportion::count(here.iter(), |r| r.of.names_falsely())),
        ]);
    }
    table
}

/// True when an effect is among the explanations that hold 95 % of the probability.
fn contains(record: &SensorRecord, id: &str) -> bool {
    record.of.answer.credible.iter().any(|e| e.is_term(id))
}

/// One line for each way of reading that tells the same.
pub fn alike(study: &AlikeStudy) -> Table {
    let mut table = Table::named([
        "read as",
        "same answer as the pose",
        "stiffness apart, std: median, worst",
        "std apart, %: worst",
        "effect or its absence right",
        "stiffness in 95 %",
        "with a fifth empty: right",
        "stiffness in 95 %",
        "intervals wider by",
    ]);
    for (k, way) in AlikeReadings::ALL.into_iter().enumerate() {
        let all = &study.records;
        let same = || all.iter().filter(|r| r.whole[0].says_the_same(&r.whole[k]));
        let apart = sorted(same().map(|r| r.apart(k)));
        let std_apart = same().map(|r| r.std_apart(k)).fold(0.0, f64::max);
        let right = |answer: fn(&AlikeRecord) -> &[AlikeAnswer; 3]| {
            counted(Proportion::count(all.iter(), |r| answer(r)[k].outcome == crate::trial::Outcome::Right))
        };
        let covered = |answer: fn(&AlikeRecord) -> &[AlikeAnswer; 3]| {
            percent(all.iter().map(|r| r.coverage(&answer(r)[k])).sum())
        };
        let widened = sorted(all.iter().flat_map(|r| r.widened(k)));
        table.row([
            way.words().to_owned(),
            counted(Proportion::count(all.iter(), |r| r.whole[0].says_the_same(&r.whole[k]))),
            format!("{:.1e}, {:.1e}", middle(&apart), apart.last().copied().unwrap_or(0.0)),
            format!("{:.1e}", 100.0 * std_apart),
            right(|r| &r.whole),
            covered(|r| &r.whole),
            right(|r| &r.with_gaps),
            covered(|r| &r.with_gaps),
            format!("{} %", hundredths(middle(&widened) - 1.0)),
        ]);
    }
    table
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut all: Vec<f64> = values.collect();
    all.sort_by(f64::total_cmp);
    all
}

fn middle(sorted: &[f64]) -> f64 {
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}
