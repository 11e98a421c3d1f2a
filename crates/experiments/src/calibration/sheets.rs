//! The tables of the study.

use hexbench_core::statistics::Proportion;
use hexbench_model::inference::verdict::Verdict;
use hexbench_report::Table;
use hexbench_report::number::hundredths;
use hexbench_truth::campaign::CaseKind;

use super::trust::{HeldOutQuantiles, credible_coverage, prediction_coverage, stiffness_coverage};
use super::{CalibrationRecord, Claims, ConfusionMatrix, Curve, Fate, Mix, bins, is_well_visible, scores};
use crate::pages::groups;
use crate::shares::bounds;

/// Most groups of wrong answers that get a line.
const MOST_GROUPS: usize = 20;
/// Effects of the joints, which relieve the legs of everything that stands beside them.
const JOINT_EFFECTS: [(&str, &str); 2] = [
    ("joint-rotation-stiffness beside others", "joint-rotation-stiffness"),
    ("bracket-compliance beside others", "bracket-compliance"),
];
/// Trials named for each group.
const EXAMPLES: usize = 3;

/// What became of the truths of each kind.
pub fn fates(records: &[CalibrationRecord]) -> Table {
    let words = Fate::ALL.map(Fate::word);
    let mut table = Table::named(["kind", "trials"].into_iter().chain(words));
    for (title, of) in by_kind(records) {
        let count = |fate| of.iter().filter(|r| r.fate == fate).count().to_string();
        table.row([title.to_owned(), of.len().to_string()].into_iter().chain(Fate::ALL.map(count)));
    }
    table
}

/// Hidden effect against answer, counts; well-visible effects in plans made to see them.
pub fn confusion(records: &[CalibrationRecord]) -> Table {
    let confusion = visible_confusion(records);
    let answers: Vec<&str> = confusion.answers.iter().map(String::as_str).collect();
    let mut table = Table::named(std::iter::once("hidden").chain(answers));
    for (hidden, counts) in confusion.hidden.iter().zip(&confusion.counts) {
        table.row(std::iter::once(hidden.clone()).chain(counts.iter().map(ToString::to_string)));
    }
    table
}

/// The confusion behind [`confusion`].
pub fn visible_confusion(records: &[CalibrationRecord]) -> ConfusionMatrix {
    const KINDS: [CaseKind; 4] = [CaseKind::Single, CaseKind::RichForm, CaseKind::Outside, CaseKind::Clean];
    ConfusionMatrix::of(records.iter().filter(|r| KINDS.contains(&r.kind) && is_well_visible(r)))
}

/// Scores of each kind of claim, with truths as drawn and as the diagnosis expects them.
pub fn all_scores(records: &[CalibrationRecord]) -> Table {
    let mut table = Table::named(SCORES).words_in(1);
    for (name, mix) in [("as drawn", Mix::as_drawn()), ("as expected", Mix::as_expected(records))] {
        for claims in Claims::ALL {
            if let Some(row) = score_row(claims, name, records.iter(), &mix) {
                table.row(row);
            }
        }
    }
    table
}

/// Scores of the verdicts and of presence by kind of campaign, as drawn.
pub fn scores_by_kind(records: &[CalibrationRecord]) -> Table {
    let mut table = Table::named(SCORES).words_in(1);
    for claims in [Claims::Named, Claims::Verdict, Claims::Presence] {
        for kind in CaseKind::ALL {
            if let Some(row) = score_row(claims, kind.name(), of_kind(records, kind), &Mix::as_drawn()) {
                table.row(row);
            }
        }
    }
    table
}

const SCORES: [&str; 8] =
    ["claim", "truths", "claims", "stated", "observed", "Brier", "log score", "calibration error"];

fn score_row<'a>(
    claims: Claims,
    truths: &str,
    records: impl Iterator<Item = &'a CalibrationRecord>,
    mix: &Mix,
) -> Option<Vec<String>> {
    let s = scores(&claims.of(records, mix))?;
    let mut row = vec![claims.title().to_owned(), truths.to_owned(), s.claims.to_string()];
    row.extend([s.stated, s.observed, s.brier, s.log, s.calibration_error].map(|x| format!("{x:.3}")));
    Some(row)
}

/// Stated probability against observed share, bin by bin, from a stated probability on; as drawn.
pub fn reliability(records: &[CalibrationRecord], from: f64) -> Table {
    let header = ["claim", "bin", "claims", "came true", "stated %", "observed %", "95 % bounds"];
    let mut table = Table::named(header).words_in(1);
    for claims in Claims::ALL {
        let bins = bins(&claims.of(records, &Mix::as_drawn()));
        for bin in bins.iter().filter(|b| b.range[0] >= from) {
            let Proportion { hits, of } = bin.came_true;
            let range = format!("{:.0} .. {:.0} %", 100.0 * bin.range[0], 100.0 * bin.range[1]);
            let mut row = vec![claims.title().to_owned(), range, of.to_string(), hits.to_string()];
            row.extend([hundredths(bin.stated), hundredths(bin.came_true.rate()), bounds(bin.came_true)]);
            table.row(row);
        }
    }
    table
}

/// Share right, and right or honest, of every effect at every size.
pub fn power(curves: &[Curve]) -> Table {
    let mut table =
        Table::named(["hidden", "distance", "trials", "right %", "right or honest %", "missed %"]);
    for curve in curves {
        for step in &curve.steps {
            let share = |fates: &[Fate]| hundredths(step.share(fates).rate());
            let range = format!("{} .. {}", step.range[0], step.range[1]);
            let of = step.share(&[]).of.to_string();
            let shares = [share(&[Fate::Right]), share(&[Fate::Right, Fate::Honest]), share(&[Fate::Missed])];
            table.row([curve.title.clone(), range, of].into_iter().chain(shares));
        }
    }
    table
}

/// Share right at every size, one line for each effect: percent of the trials there.
pub fn right_by_size(curves: &[Curve]) -> Table {
    let ranges = super::SIZES.windows(2).map(|s| format!("{} .. {}", s[0], s[1]));
    let mut table = Table::named(std::iter::once("distance".to_owned()).chain(ranges));
    for curve in curves {
        let cell = |s: &super::DistanceRange| {
            let right = s.share(&[Fate::Right]);
            if right.of == 0 { "-".to_owned() } else { format!("{:.0}", 100.0 * right.rate()) }
        };
        table.row(std::iter::once(curve.title.clone()).chain(curve.steps.iter().map(cell)));
    }
    table
}

/// Whether credible sets hold the truth, by kind.
pub fn coverage(records: &[CalibrationRecord]) -> Table {
    let mut table = Table::named([
        "kind",
        "credible sets",
        "hold the truth %",
        "95 % bounds",
        "of them well visible",
        "hold the truth %",
    ]);
    for (title, of) in by_kind(records) {
        let all = credible_coverage(of.iter().copied());
        let visible = credible_coverage(of.iter().copied().filter(|r| is_well_visible(r)));
        let cells = [hundredths(all.rate()), bounds(all), visible.of.to_string(), hundredths(visible.rate())];
        table.row([title.to_owned(), all.of.to_string()].into_iter().chain(cells));
    }
    table
}

/// Numbers of the final model, by what became of the truth: held-out chi-square and leg stiffnesses.
pub fn numbers(records: &[CalibrationRecord]) -> Table {
    let mut table = Table::named([
        "fate",
        "trials",
        "held-out chi2, springs: median",
        "final model: median",
        "95 % below",
        "stiffnesses",
        "within 1.96 std %",
        "95 % bounds",
    ]);
    for fate in Fate::ALL {
        let of = || records.iter().filter(move |r| r.fate == fate);
        let Some(held) = HeldOutQuantiles::of(of()) else { continue };
        let stiffness = stiffness_coverage(of().filter(|r| r.verdict != Verdict::Outside));
        let chi2 = [held.springs_median, held.median, held.high].map(|x| format!("{x:.2}"));
        let row = [fate.word().to_owned(), held.trials.to_string()].into_iter().chain(chi2);
        table.row(row.chain([stiffness.of.to_string(), hundredths(stiffness.rate()), bounds(stiffness)]));
    }
    table
}

/// Whether the intervals of the final model hold what they claim, by what was hidden and rightly said.
pub fn intervals(records: &[CalibrationRecord]) -> Table {
    let mut table = Table::named([
        "right answer",
        "trials",
        "stiffnesses",
        "within 1.96 std %",
        "95 % bounds",
        "held-out numbers",
        "within 1.96 std %",
    ]);
    let right = || records.iter().filter(|r| r.fate == Fate::Right);
    let mut line = |title: &str, of: Vec<&CalibrationRecord>| {
        let stiffness = stiffness_coverage(of.iter().copied());
        let predicted = prediction_coverage(of.iter().copied());
        let cells = [stiffness.of.to_string(), hundredths(stiffness.rate()), bounds(stiffness)];
        let cells = cells.into_iter().chain([predicted.of.to_string(), hundredths(predicted.rate())]);
        table.row([title.to_owned(), of.len().to_string()].into_iter().chain(cells));
    };
    for (title, effects) in
        [("nothing hidden", 0), ("one effect", 1), ("two effects", 2), ("three effects", 3)]
    {
        line(title, right().filter(|r| !r.is_outside() && r.hidden.len() == effects).collect());
    }
    for (title, id) in JOINT_EFFECTS {
        let several = right().filter(|r| r.hidden.len() > 1);
        line(title, several.filter(|r| r.contains(id)).collect());
    }
    line("something outside", right().filter(|r| r.is_outside()).collect());
    table
}

/// Answers that state something false (a false name, a false "outside", some of several effects taken for all), in groups, the largest
/// first; the most confident of each come first.
pub fn mistakes_table(records: &[CalibrationRecord]) -> Table {
    let mut table = Table::named([
        "hidden",
        "answer",
        "trials",
        "highest probability stated",
        "examples: distance, plan, machine",
    ])
    .words_in(1)
    .words_in(4);
    let false_answers = records.iter().filter(|r| r.fate >= Fate::Incomplete);
    let confidence = |r: &CalibrationRecord| r.confidence.unwrap_or(0.0);
    for ((hidden, answer), mut trials) in groups(false_answers, mistake).into_iter().take(MOST_GROUPS) {
        trials.sort_by(|a, b| confidence(b).total_cmp(&confidence(a)));
        let highest = trials.first().map_or(0.0, |r| confidence(r));
        let examples: Vec<String> = trials.iter().take(EXAMPLES).map(|r| example(r)).collect();
        let cells = [trials.len().to_string(), format!("{highest:.3}"), examples.join("; ")];
        table.row([hidden, answer].into_iter().chain(cells));
    }
    table
}

/// What was hidden and what was said; of several effects the sort of mistake stands for the answer.
fn mistake(r: &CalibrationRecord) -> (String, String) {
    match r.kind {
        CaseKind::Pair => ("two effects".to_owned(), r.fate.word().to_owned()),
        CaseKind::Triple => ("three effects".to_owned(), r.fate.word().to_owned()),
        CaseKind::SeedProtocol => (format!("{} (paper plan)", r.hidden_words()), r.answer()),
        CaseKind::RichForm => (format!("{} (richer form)", r.hidden_words()), r.answer()),
        _ => (r.hidden_words(), r.answer()),
    }
}

fn example(r: &CalibrationRecord) -> String {
    let distance = r.distance.unwrap_or(r.total_distance);
    let pair = if matches!(r.kind, CaseKind::Pair | CaseKind::Triple) {
        format!(" {} -> {}", r.hidden_words(), r.answer())
    } else {
        String::new()
    };
    format!("{}{pair} ({distance:.0}, {}, {})", r.id, r.plan.name(), r.family)
}

/// The trials of each kind, then all.
fn by_kind(records: &[CalibrationRecord]) -> Vec<(&'static str, Vec<&CalibrationRecord>)> {
    let own = CaseKind::ALL.map(|kind| (kind.name(), of_kind(records, kind).collect()));
    own.into_iter().chain([("all", records.iter().collect())]).collect()
}

fn of_kind(records: &[CalibrationRecord], kind: CaseKind) -> impl Iterator<Item = &CalibrationRecord> {
    records.iter().filter(move |r| r.kind == kind)
}
