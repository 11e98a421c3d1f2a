//! Rows of the tables of a plan's power.

use hexbench_core::statistics::Proportion;
use hexbench_design::power::{Alike, EffectPower, NOTHING, Range};
use hexbench_report::number::significant;

use super::{PowerCheck, Simulated};
use crate::shares::{dash, or_dash};

/// Header of [`sizes`].
pub(super) const SIZES: [&str; 7] = ["effect", "usual", "chance %", "smallest", "unit", "x usual", "x exact"];
/// Header of [`springs`].
pub(super) const SPRINGS: [&str; 4] = ["effect", "absorbed", "bias at usual size", "bias at smallest"];
/// Header of [`taken_for`].
pub(super) const TAKEN_FOR: [&str; 5] = ["effect", "itself", "nothing", "others", "mostly"];
/// Header of [`check`].
pub(super) const CHECK: [&str; 6] = ["effect", "size", "computed", "world", "simulated", "false alarms"];
/// Header of [`answers`].
pub(super) const ANSWERS: [&str; 7] =
    ["effect", "right", "among", "adequate", "wrong", "other", "wrong names"];
/// Header of [`parameters`].
pub(super) const PARAMETERS: [&str; 3] = ["parameter", "smallest", "unit"];

/// Usual size, chance to see it, smallest size that is seen, and how that compares with exact inputs.
pub(super) fn sizes(e: &EffectPower) -> Vec<String> {
    vec![
        e.term.to_owned(),
        significant(e.usual_size, 2),
        percent_range(&e.power_at_usual_size),
        e.size_seen().map_or("never".to_owned(), |s| significant(s, 2)),
        e.unit.to_owned(),
        multiples(&e.seen_at),
        or_dash(e.seen_at_with_exact_inputs.filter(|_| e.shows()), |exact| {
            significant(e.seen_at.middle / exact, 3)
        }),
    ]
}

/// What springs absorb and how far they go astray.
pub(super) fn springs(e: &EffectPower) -> Vec<String> {
    let bias = |b: &[f64; 6]| format!("{} %", significant(largest(b), 2));
    vec![
        e.term.to_owned(),
        chance(e.absorbed),
        bias(&e.bias_at_usual_size_percent),
        or_dash(e.bias_when_seen_percent.as_ref(), bias),
    ]
}

/// What the effect is taken for.
pub(super) fn taken_for(alike: &Alike, row: usize, e: &EffectPower) -> Vec<String> {
    let own = alike.taken_for[row].get(row).copied().unwrap_or(0.0);
    let mistaken = alike.mistaken(row);
    let nothing = mistaken.iter().find(|(name, _)| *name == NOTHING).map_or(0.0, |m| m.1);
    let top = mistaken.iter().find(|(name, _)| *name != NOTHING);
    vec![
        e.term.to_owned(),
        number(own),
        number(nothing),
        number((1.0 - own - nothing).max(0.0)),
        or_dash(top.filter(|(_, share)| *share >= 0.01), |(name, share)| {
            format!("{name} {}", number(*share))
        }),
    ]
}

/// Computed and simulated chance, at the usual size and at the size that is seen.
pub(super) fn check(e: &EffectPower, check: &PowerCheck, wanted: f64) -> Vec<Vec<String>> {
    let alarms = or_dash(check.false_alarms, bounded);
    let row = |name: &str, size: &str, computed: f64, s: &Simulated, alarms: String| {
        vec![
            name.to_owned(),
            size.to_owned(),
            number(computed),
            number(s.chance_by_the_world),
            bounded(s.seen),
            alarms,
        ]
    };
    let usual = check.usual.as_ref().map(|s| row(e.term, "usual", e.power_at_usual_size.middle, s, alarms));
    let seen = check.when_seen.as_ref().map(|s| row("", "smallest", wanted, s, String::new()));
    usual.into_iter().chain(seen).collect()
}

/// What the diagnosis says, when it was asked.
pub(super) fn answers(e: &EffectPower, check: &PowerCheck) -> Option<Vec<String>> {
    let a = check.when_seen.as_ref()?.answers.as_ref()?;
    let share = |n: usize| number(n as f64 / a.of().max(1) as f64);
    let mut wrong: Vec<(&String, &usize)> = a
        .said
        .iter()
        .filter(|(name, _)| !["adequate", "ambiguous", e.term].contains(&name.as_str()))
        .collect();
    wrong.sort_by(|a, b| b.1.cmp(a.1));
    let names: Vec<&str> = wrong.iter().take(2).map(|w| w.0.as_str()).collect();
    let counts = [a.right, a.honest, a.adequate, a.wrong, a.other].map(share);
    let start = std::iter::once(e.term.to_owned()).chain(counts);
    Some(start.chain([if names.is_empty() { dash() } else { names.join(", ") }]).collect())
}

/// Every parameter of an effect with several.
pub(super) fn parameters(e: &EffectPower) -> Vec<Vec<String>> {
    let row = |p: &hexbench_design::power::ParameterReach| {
        let size = p.size.map_or("never".to_owned(), |s| significant(s, 2));
        vec![format!("{}.{}", e.term, p.name), size, p.unit.to_owned()]
    };
    e.parameters.iter().map(row).collect()
}

/// The largest of six numbers by amount.
pub(super) fn largest(six: &[f64; 6]) -> f64 {
    six.iter().copied().fold(0.0, |m: f64, x| if x.abs() > m.abs() { x } else { m })
}

/// `3 %`; a chance is never certain, a count of none is none.
pub(super) fn chance(share: f64) -> String {
    format!("{} %", number(share))
}

/// A share in percent without the sign.
fn number(share: f64) -> String {
    match 100.0 * share {
        p if p <= 0.0 => "0".to_owned(),
        p if p < 0.95 => "< 1".to_owned(),
        p if p > 99.5 && share < 1.0 => "> 99".to_owned(),
        p => format!("{p:.0}"),
    }
}

/// `15`, or `7 (3..12)` where directions or shapes differ.
fn percent_range(r: &Range) -> String {
    let [low, middle, high] = [r.least, r.middle, r.most].map(number);
    if low == high { middle } else { format!("{middle} ({low}..{high})") }
}

/// `2.5`, or `1.9..3.1` where directions or shapes differ.
fn multiples(r: &Range) -> String {
    let word = |x: f64| if x.is_finite() { significant(x, 2) } else { "never".to_owned() };
    let [low, high] = [r.least, r.most].map(word);
    if low == high { low } else { format!("{low}..{high}") }
}

/// `92 (85..96)`.
fn bounded(p: Proportion) -> String {
    let [low, high] = p.interval().map(|x| format!("{:.0}", 100.0 * x));
    format!("{} ({low}..{high})", number(p.rate()))
}
