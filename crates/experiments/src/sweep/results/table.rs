//! `cells.csv`.

use hexbench_core::statistics::{Welford, mean};
use hexbench_core::words::to_digits;
use hexbench_design::Criterion;
use hexbench_report::Table;
use hexbench_report::table::csv;

use crate::sweep::columns::Status;
use crate::sweep::indices::PREFIX;
use crate::sweep::results::{CellStatistics, SHARES};
use crate::sweep::study::{SweepStudy, SweepTask};

/// One row per cell; units are in the names.
pub fn cells_csv(study: &SweepStudy, cells: &[CellStatistics]) -> String {
    let levels = study.axes.levels();
    let axes = levels.iter().map(|axis| axis.name);
    let counts = ["trials", "done", "not_determined", "failed"];
    let results = match study.task {
        SweepTask::Springs => SPRINGS.map(str::to_owned).to_vec(),
        SweepTask::Diagnose => diagnose_names(),
    };
    let indices: Vec<String> = study.indices.then(index_names).into_iter().flatten().collect();
    let header = std::iter::once("cell").chain(axes).chain(SIGMAS).chain(counts);
    let mut table = Table::named(header.chain(results.iter().chain(&indices).map(String::as_str)));
    for found in cells {
        let cell = study.axes.cell(found.cell);
        let at = levels.iter().zip(cell.position).map(|(axis, k)| axis.levels[k].text());
        let sigmas = cell.sigmas_um_urad().map(number);
        let values = match study.task {
            SweepTask::Springs => springs(found),
            SweepTask::Diagnose => diagnose(found),
        };
        let row = std::iter::once(found.cell.to_string()).chain(at).chain(sigmas).chain(counted(found));
        let indices = (0..indices.len()).map(|k| mean_index(found, k));
        table.row(row.chain(values.into_iter().chain(indices).map(number)));
    }
    csv::text(&table)
}

const SIGMAS: [&str; 2] = ["sigma_translation_um", "sigma_rotation_urad"];
const SPRINGS: [&str; 9] = [
    "stiffness_error_mean_percent",
    "stiffness_error_std_percent",
    "stiffness_error_rms_percent",
    "coverage",
    "coverage_low",
    "coverage_high",
    "holdout_error_rms_um",
    "holdout_error_rms_urad",
    "holdout_error_over_noise",
];
/// Names of the shares, with their bounds, then the rest.
fn diagnose_names() -> Vec<String> {
    let bounded = |name: String| [name.clone(), format!("{name}_low"), format!("{name}_high")];
    let shares = SHARES.iter().map(|of| of.word().replace(' ', "_")).flat_map(bounded);
    shares.chain(["holdout_chi2_springs_mean", "holdout_chi2_final_mean"].map(str::to_owned)).collect()
}

fn index_names() -> impl Iterator<Item = String> {
    Criterion::ALL.into_iter().map(|criterion| format!("{PREFIX}{}_mean", criterion.name()))
}

/// Mean of an index over the plans of a cell.
fn mean_index(found: &CellStatistics, index: usize) -> f64 {
    mean(found.plans.iter().map(|plan| plan.indices[index])).unwrap_or(f64::NAN)
}

fn counted(found: &CellStatistics) -> [String; 4] {
    let open = found.by_status[Status::NotDetermined as usize];
    let failed = found.trials() - found.done() - open;
    [found.trials(), found.done(), open, failed].map(|n| n.to_string())
}

fn springs(found: &CellStatistics) -> Vec<f64> {
    let s = &found.springs;
    let mut all = vec![s.errors.mean(), s.errors.std(), s.errors.rms()];
    all.extend(found.coverage());
    all.extend(s.holdout.iter().map(Welford::rms));
    all
}

fn diagnose(found: &CellStatistics) -> Vec<f64> {
    let mut all: Vec<f64> = SHARES.iter().flat_map(|of| found.share(*of)).collect();
    all.extend(found.answers.holdout.iter().map(Welford::mean));
    all
}

/// Nine significant digits; empty for none.
fn number(x: f64) -> String {
    if !x.is_finite() {
        return String::new();
    }
    // Through the decimal text, so that 0.1 stays 0.1.
    to_digits(x, 9).to_string()
}
