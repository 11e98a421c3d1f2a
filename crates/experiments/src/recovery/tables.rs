//! The study as tables of text, for the screen and for the document.

use hexbench_report::{Section, Table};

use super::noiseless::Bounded;
use super::study::{RecoveryRow, RecoveryStudy};
use super::tally::Coverage;
use crate::shares::{dash, or_dash};

/// Without noise, intervals, effects named, sums.
pub fn tables(study: &RecoveryStudy) -> [Section; 4] {
    [noiseless(study), intervals(study), naming(study), sums(study)]
}

fn noiseless(study: &RecoveryStudy) -> Section {
    let cells = |row: &RecoveryRow| {
        let both = [row.noiseless_stiffness, row.noiseless_effect];
        named(row, both.into_iter().flat_map(error_and_bound))
    };
    Section::new("Without noise")
        .remark("relative error closest to its bound; the bound follows from what the model linearizes")
        .table(
            Table::named(["hidden", "stiffness", "bound", "effect", "bound"])
                .rows(study.rows.iter().map(cells)),
        )
}

fn error_and_bound(bounded: Option<Bounded>) -> [String; 2] {
    bounded.map_or([dash(), dash()], |b| [format!("{:.1e}", b.error), format!("{:.1e}", b.bound)])
}

fn intervals(study: &RecoveryStudy) -> Section {
    let cells = |row: &RecoveryRow| {
        let pulled = [row.stiffness, row.sizes].into_iter().flat_map(share_and_pull);
        named(row, pulled.chain([share(row.shapes)]))
    };
    Section::new("95 % intervals")
        .remark(
            "share that covers the truth, mean and standard deviation of (estimate - truth) / uncertainty",
        )
        .table(
            Table::named(["hidden", "stiffness", "mean/sd", "effect", "mean/sd", "shape"])
                .rows(study.rows.iter().map(cells)),
        )
}

fn share_and_pull(coverage: Option<Coverage>) -> [String; 2] {
    let pull = or_dash(coverage, |c| format!("{:+.2}/{:.2}", c.mean_pull, c.sd_pull));
    [share(coverage), pull]
}

fn share(coverage: Option<Coverage>) -> String {
    or_dash(coverage, |c| format!("{:.3}", c.share))
}

fn naming(study: &RecoveryStudy) -> Section {
    let cells = |row: &RecoveryRow| {
        let [right, honest, wrong] = row.named;
        let number = |x: f64| format!("{x:.2}");
        named(
            row,
            [
                format!("{right}/{honest}/{wrong}"),
                number(row.holdout_before),
                number(row.holdout_after),
                or_dash(row.holdout_wrong, number),
                format!("{}/{}/{}", row.wrong_wins_evidence, row.wrong_wins_holdout, row.compared),
                share(row.predicted),
            ],
        )
    };
    Section::new("Named, and held out")
        .remark("answers right/honest/wrong; median held-out chi-square per number; how often the best wrong terms win by \
                 evidence/by prediction/of; share of held-out sets within their 95 % region")
        .table(Table::named(["hidden", "named", "springs", "right", "wrong", "wrong wins", "predicted"]).rows(study.rows.iter().map(cells)))
}

fn sums(study: &RecoveryStudy) -> Section {
    let kinds = [
        ("leg stiffness", study.stiffness),
        ("sizes of effects", study.sizes),
        ("shapes of effects", study.shapes),
        ("noise level from repeats", study.noise_by_repeats),
        ("noise level from residuals", study.noise_by_residuals),
        ("stiffness, noise from repeats", study.stiffness_by_repeats),
        ("stiffness after search", study.stiffness_after_search),
        ("stiffness after right search", study.stiffness_after_right_search),
    ];
    let row = |(what, c): (&str, Coverage)| {
        let allowed = format!("{:.4} to {:.4}", c.low, c.high);
        vec![
            what.to_owned(),
            format!("{:.4}", c.share),
            allowed,
            c.campaigns.to_string(),
            c.intervals.to_string(),
        ]
    };
    Section::new("All together")
        .remark("share of 95 % intervals that cover the truth, and what chance allows")
        .table(
            Table::named(["intervals of", "cover", "allowed", "campaigns", "intervals"])
                .rows(kinds.into_iter().filter_map(|(what, c)| c.map(|c| row((what, c))))),
        )
}

fn named(row: &RecoveryRow, cells: impl IntoIterator<Item = String>) -> Vec<String> {
    std::iter::once(row.subject.to_owned()).chain(cells).collect()
}

/// One line: what was run and which bounds hold.
pub fn summary(study: &RecoveryStudy) -> String {
    let s = &study.settings;
    let [sure, wrong] = study.sure;
    format!(
        "{} campaigns and {} diagnoses, seed {}: {} of {} bounds hold; {wrong} of {sure} sure answers are wrong.",
        s.per_subject() * study.rows.len(),
        s.diagnoses * study.rows.len(),
        s.seed,
        study.bounds - study.broken.len(),
        study.bounds,
    )
}
