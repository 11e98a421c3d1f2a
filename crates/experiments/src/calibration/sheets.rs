//! The tables of the study.

use hexbench_truth::campaign::Kind;

use super::trust::{HeldOut, credible_coverage, stiffness_coverage};
use super::{Claims, Confusion, Curve, Fate, Mix, Record, bins, is_well_visible, mistakes, scores};
use crate::proportion::Proportion;
use crate::sheet::Sheet;

/// Most groups of wrong answers that get a line.
const MOST_GROUPS: usize = 20;
/// Trials named for each group.
const EXAMPLES: usize = 3;

/// What became of the truths of each kind.
pub fn fates(records: &[Record]) -> Sheet {
    let words = Fate::ALL.map(Fate::word);
    let mut sheet = Sheet::new(&[&["kind", "trials"], &words[..]].concat());
    let mut line = |title: &str, of: Vec<&Record>| {
        let count = |fate| of.iter().filter(|r| r.fate == fate).count().to_string();
        sheet.row([title.to_owned(), of.len().to_string()].into_iter().chain(Fate::ALL.map(count)));
    };
    for kind in Kind::ALL {
        line(kind.name(), of_kind(records, kind).collect());
    }
    line("all", records.iter().collect());
    sheet
}

/// Hidden effect against answer, counts; well-visible effects in plans made to see them.
pub fn confusion(records: &[Record]) -> Sheet {
    let confusion = visible_confusion(records);
    let answers: Vec<&str> = confusion.answers.iter().map(String::as_str).collect();
    let mut sheet = Sheet::new(&[&["hidden"], &answers[..]].concat());
    for (hidden, counts) in confusion.hidden.iter().zip(&confusion.counts) {
        sheet.row(std::iter::once(hidden.clone()).chain(counts.iter().map(ToString::to_string)));
    }
    sheet
}

/// The confusion behind [`confusion`].
pub fn visible_confusion(records: &[Record]) -> Confusion {
    const KINDS: [Kind; 4] = [Kind::Single, Kind::RichForm, Kind::Outside, Kind::Clean];
    Confusion::of(records.iter().filter(|r| KINDS.contains(&r.kind) && is_well_visible(r)))
}

/// Scores of each kind of claim, with truths as drawn and as the diagnosis expects them.
pub fn all_scores(records: &[Record]) -> Sheet {
    let mut sheet = Sheet::new(&SCORES);
    for (name, mix) in [("as drawn", Mix::as_drawn()), ("as expected", Mix::as_expected(records))] {
        for claims in Claims::ALL {
            sheet.rows.extend(score_row(claims, name, records.iter(), &mix));
        }
    }
    sheet
}

/// Scores of the verdicts and of presence by kind of campaign, as drawn.
pub fn scores_by_kind(records: &[Record]) -> Sheet {
    let mut sheet = Sheet::new(&SCORES);
    for claims in [Claims::Named, Claims::Verdict, Claims::Presence] {
        for kind in Kind::ALL {
            sheet.rows.extend(score_row(claims, kind.name(), of_kind(records, kind), &Mix::as_drawn()));
        }
    }
    sheet
}

const SCORES: [&str; 8] =
    ["claim", "truths", "claims", "stated", "observed", "Brier", "log score", "calibration error"];

fn score_row<'a>(
    claims: Claims,
    truths: &str,
    records: impl Iterator<Item = &'a Record>,
    mix: &Mix,
) -> Option<Vec<String>> {
    let s = scores(&claims.of(records, mix))?;
    let mut row = vec![claims.title().to_owned(), truths.to_owned(), s.claims.to_string()];
    row.extend([s.stated, s.observed, s.brier, s.log, s.calibration_error].map(|x| format!("{x:.3}")));
    Some(row)
}

/// Stated probability against observed share, bin by bin, from a stated probability on; as drawn.
pub fn reliability(records: &[Record], from: f64) -> Sheet {
    let header = ["claim", "bin", "claims", "came true", "stated %", "observed %", "95 % bounds"];
    let mut sheet = Sheet::new(&header);
    for claims in Claims::ALL {
        let bins = bins(&claims.of(records, &Mix::as_drawn()));
        for bin in bins.iter().filter(|b| b.range[0] >= from) {
            let Proportion { hits, of } = bin.came_true;
            let range = format!("{:.0} .. {:.0} %", 100.0 * bin.range[0], 100.0 * bin.range[1]);
            let mut row = vec![claims.title().to_owned(), range, of.to_string(), hits.to_string()];
            row.extend([percent(bin.stated), percent(bin.came_true.rate()), bounds(bin.came_true)]);
            sheet.row(row);
        }
    }
    sheet
}

/// Share right, and right or honest, of every effect at every size.
pub fn power(curves: &[Curve]) -> Sheet {
    let mut sheet = Sheet::new(&["hidden", "distance", "trials", "right %", "right or honest %", "missed %"]);
    for curve in curves {
        for step in &curve.steps {
            let share = |fates: &[Fate]| percent(step.share(fates).rate());
            let range = format!("{} .. {}", step.range[0], step.range[1]);
            let of = step.share(&[]).of.to_string();
            let shares = [share(&[Fate::Right]), share(&[Fate::Right, Fate::Honest]), share(&[Fate::Missed])];
            sheet.row([curve.title.clone(), range, of].into_iter().chain(shares));
        }
    }
    sheet
}

/// Share right at every size, one line for each effect: percent of the trials there.
pub fn right_by_size(curves: &[Curve]) -> Sheet {
    let ranges = super::SIZES.windows(2).map(|s| format!("{} .. {}", s[0], s[1]));
    let mut sheet =
        Sheet { header: std::iter::once("distance".to_owned()).chain(ranges).collect(), rows: Vec::new() };
    for curve in curves {
        let cell = |s: &super::Step| {
            let right = s.share(&[Fate::Right]);
            if right.of == 0 { "-".to_owned() } else { format!("{:.0}", 100.0 * right.rate()) }
        };
        sheet.row(std::iter::once(curve.title.clone()).chain(curve.steps.iter().map(cell)));
    }
    sheet
}

/// Whether credible sets hold the truth, by kind.
pub fn coverage(records: &[Record]) -> Sheet {
    let mut sheet = Sheet::new(&[
        "kind",
        "credible sets",
        "hold the truth %",
        "95 % bounds",
        "of them well visible",
        "hold the truth %",
    ]);
    let mut line = |title: &str, of: Vec<&Record>| {
        let all = credible_coverage(of.iter().copied());
        let visible = credible_coverage(of.iter().copied().filter(|r| is_well_visible(r)));
        let cells = [percent(all.rate()), bounds(all), visible.of.to_string(), percent(visible.rate())];
        sheet.row([title.to_owned(), all.of.to_string()].into_iter().chain(cells));
    };
    for kind in Kind::ALL {
        line(kind.name(), of_kind(records, kind).collect());
    }
    line("all", records.iter().collect());
    sheet
}

/// Numbers of the final model, by what became of the truth: held-out chi-square and leg stiffnesses.
pub fn numbers(records: &[Record]) -> Sheet {
    let mut sheet = Sheet::new(&[
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
        let Some(held) = HeldOut::of(of()) else { continue };
        let stiffness = stiffness_coverage(of());
        let chi2 = [held.springs_median, held.median, held.high].map(|x| format!("{x:.2}"));
        let row = [fate.word().to_owned(), held.trials.to_string()].into_iter().chain(chi2);
        sheet.row(row.chain([stiffness.of.to_string(), percent(stiffness.rate()), bounds(stiffness)]));
    }
    sheet
}

/// The largest groups of answers that state something false.
pub fn mistakes_sheet(records: &[Record]) -> Sheet {
    let mut sheet = Sheet::new(&[
        "hidden",
        "answer",
        "trials",
        "highest probability stated",
        "examples: distance, plan, machine",
    ]);
    for group in mistakes(records).iter().take(MOST_GROUPS) {
        let confidence = group.trials.first().and_then(|r| r.confidence).unwrap_or(0.0);
        let examples: Vec<String> = group.trials.iter().take(EXAMPLES).map(|r| example(r)).collect();
        let cells = [group.trials.len().to_string(), format!("{confidence:.3}"), examples.join("; ")];
        sheet.row([group.hidden.clone(), group.answer.clone()].into_iter().chain(cells));
    }
    sheet
}

fn example(r: &Record) -> String {
    let distance = r.distance.unwrap_or(r.total_distance);
    let pair =
        if r.kind == Kind::Pair { format!(" {} -> {}", r.hidden_words(), r.answer()) } else { String::new() };
    format!("{}{pair} ({distance:.0}, {}, {})", r.id, r.plan.name(), r.family)
}

fn of_kind(records: &[Record], kind: Kind) -> impl Iterator<Item = &Record> {
    records.iter().filter(move |r| r.kind == kind)
}

pub(super) fn percent(share: f64) -> String {
    if share.is_finite() { format!("{:.1}", 100.0 * share) } else { "-".to_owned() }
}

pub(super) fn bounds(p: Proportion) -> String {
    let [low, high] = p.interval();
    format!("{} .. {}", percent(low), percent(high))
}
