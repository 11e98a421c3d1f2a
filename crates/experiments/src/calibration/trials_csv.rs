//! Every trial as a line of a table.

use hexbench_core::files::CsvText;
use hexbench_model::inference::explanation::Explanation;

use super::CalibrationRecord;

const HEADER: &str = "trial,kind,hidden,family,plan,distance,total_distance,verdict,fate,added,model,best,\
best_probability,truth_probability,outside_probability,none_probability,confidence,credible_set,present,\
holdout_chi2_springs,holdout_chi2,z_leg_1,z_leg_2,z_leg_3,z_leg_4,z_leg_5,z_leg_6,behind_truth,seed";

/// Probability of presence below which an effect is left out of its cell.
const WORTH_WRITING: f64 = 1e-3;

/// The table of all records; lists within a cell are joined by `+`.
pub fn trials_csv(records: &[CalibrationRecord]) -> String {
    let mut text = CsvText::new(HEADER.split(','));
    for record in records {
        text.row(cells(record));
    }
    text.into_text()
}

fn cells(r: &CalibrationRecord) -> Vec<String> {
    let mut cells: Vec<String> =
        [&r.id, r.kind.name(), &r.hidden_words(), r.family, r.plan.name()].map(str::to_owned).to_vec();
    cells.extend([maybe(r.distance), number(r.total_distance)]);
    cells.extend([
        r.verdict.word().to_owned(),
        r.fate.word().to_owned(),
        r.added.join("+"),
        r.model.join("+"),
    ]);
    cells.extend([
        r.best.0.to_string(),
        number(r.best.1),
        number(r.truth),
        number(r.outside),
        number(r.none),
    ]);
    cells.extend([maybe(r.confidence), words(r), present(r)]);
    cells.extend(r.holdout.iter().chain(&r.stiffness_z).map(|&x| maybe(x)));
    cells.push(maybe(r.behind_truth));
    cells.push(r.seed.to_string());
    cells
}

fn words(r: &CalibrationRecord) -> String {
    r.credible.iter().map(Explanation::word).collect::<Vec<_>>().join("+")
}

fn present(r: &CalibrationRecord) -> String {
    let present = r.present.iter().filter(|(_, p)| **p >= WORTH_WRITING);
    present.map(|(id, p)| format!("{id}:{}", number(*p))).collect::<Vec<_>>().join("+")
}

fn maybe(x: Option<f64>) -> String {
    x.map(number).unwrap_or_default()
}

/// Six decimals, or six digits where the number is small.
fn number(x: f64) -> String {
    if x != 0.0 && x.abs() < 1e-3 { format!("{x:.5e}") } else { format!("{x:.6}") }
}
