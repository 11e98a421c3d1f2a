//! What to measure next when the answer is open.

use hexbench_core::{Approach, Observation};
use hexbench_model::inference::explanation::Explanation;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{Diagnosis, NextReport, SeparationReport};
use hexbench_model::results::discover::Discovery;
use hexbench_model::terms::catalogue;

use super::conclusion::in_words;
use crate::number::{percent, significant};
use crate::page::{Block, Definition, Section};

/// Odds beyond which a number says no more than "overwhelming".
const OVERWHELMING: f64 = 1e4;
/// Expected logarithm of a Bayes factor below which a reading says nothing: odds that shift by a twentieth.
const LEAST_GAIN: f64 = 0.05;

/// Readings that separate the rivals; else what makes each of them visible.
pub(super) fn section(d: &Diagnosis) -> Option<Section> {
    if d.verdict != Verdict::Ambiguous {
        return None;
    }
    let section = Section::new("What to measure next").id("next");
    let Some(first) = d.next.first() else { return Some(in_general(section, d)) };
    if d.next.iter().all(|reading| reading.gain < LEAST_GAIN) {
        let text = format!(
            "No pose and load within the range of these readings separates {}: in the form found here, both move the platform alike.",
            rivals(&first.separates, "from")
        );
        return Some(in_general(section.paragraph(text), d));
    }
    Some(proposed(section, first, &d.next, &d.separation))
}

/// Readings that tell a law from those that look like it.
pub(super) fn between_laws(d: &Discovery) -> Option<Section> {
    let first = d.next.first()?;
    Some(proposed(Section::new("What to measure next").id("measure"), first, &d.next, &d.separation))
}

fn proposed(
    section: Section,
    first: &NextReport,
    next: &[NextReport],
    separation: &[SeparationReport],
) -> Section {
    let others = if next.iter().all(|r| r.separates == first.separates) { "" } else { ", and others" };
    let frames = "Wrench on the platform at the mobile origin, fixed axes; loaded minus reference. Each reading is \
                  chosen assuming that those above it are taken.";
    let readings = next.iter().enumerate();
    section
        .remark(format!("to separate {}{others}", rivals(&first.separates, "from")))
        .with_all(readings.map(|(k, r)| Block::numbered(k + 1, proposal(k + 1, r, first))))
        .with(Block::entries([
            Definition::new("expected", promise(next, separation)),
            Definition::new("frames", frames),
        ]))
}

fn proposal(number: usize, reading: &NextReport, first: &NextReport) -> Vec<Definition> {
    let NextReport { approach, elapsed_s, delta_t_k, repeats, .. } = *reading;
    let without = reading.reference.iter().all(|x| *x == 0.0);
    let other = number == 1 || differ(&reading.reference, &first.reference);
    let separates = if reading.separates == first.separates {
        "the two".to_owned()
    } else {
        rivals(&reading.separates, "and")
    };
    let words = (!reading.text.is_empty()).then(|| Definition::new("in words", &reading.text));
    let reference = (!without && other).then(|| Definition::new("reference", load(&reading.reference)));
    words
        .into_iter()
        .chain([Definition::new("pose", pose(&reading.pose)), Definition::new("load", load(&reading.wrench))])
        .chain(reference)
        .chain([
            Definition::new("how", way(approach, elapsed_s, delta_t_k, repeats)),
            Definition::new("gain", gain(reading.gain, &separates)),
        ])
        .collect()
}

fn differ(a: &[f64; 6], b: &[f64; 6]) -> bool {
    a.map(f64::to_bits) != b.map(f64::to_bits)
}

/// `base-compliance from leg-coupling`; `creep or nothing more`, beside what both have.
pub fn rivals(pair: &[String; 2], word: &str) -> String {
    match pair.each_ref().map(|name| Explanation::from(name.as_str())) {
        [Explanation::Nothing, more] | [more, Explanation::Nothing] => format!("{more} {word} nothing more"),
        [a, b] => format!("{} {word} {}", in_words(&a), in_words(&b)),
    }
}

/// As many decimals as the number has, at most three.
pub(super) fn round(x: f64) -> String {
    const FINEST: f64 = 1e3;
    format!("{}", (x * FINEST).round() / FINEST + 0.0)
}

/// A pose from mm and deg.
pub fn pose(x: &[f64; 6]) -> String {
    let [a, b, c, alpha, beta, gamma] = x.map(round);
    format!("({a}, {b}, {c}) mm, ({alpha}, {beta}, {gamma}) deg")
}

/// Pose of a reading, mm and deg.
pub fn settings(o: &Observation) -> [f64; 6] {
    let pose = o.pose.to_array();
    std::array::from_fn(|k| if k < 3 { pose[k] * 1e3 } else { pose[k].to_degrees() })
}

/// A wrench in N and N m.
pub fn load(w: &[f64; 6]) -> String {
    let [fx, fy, fz, mx, my, mz] = w.map(|x| significant(x, 3).parse().map_or(String::new(), round));
    format!("F ({fx}, {fy}, {fz}) N, M ({mx}, {my}, {mz}) N m")
}

/// How a reading is taken.
pub fn way(approach: Approach, elapsed_s: f64, delta_t_k: f64, repeats: usize) -> String {
    let side = match approach {
        Approach::Direct => "load from below (approach +1)",
        Approach::Overloaded => "exceed the change of load by 40 %, then return (approach -1)",
    };
    let mut parts = vec![side.to_owned()];
    parts.extend(circumstances(elapsed_s, delta_t_k));
    if repeats > 1 {
        parts.push(format!("{repeats} times"));
    }
    parts.join("; ")
}

/// Time and temperature of a reading, each unless it is that of the reference.
pub(crate) fn circumstances(elapsed_s: f64, delta_t_k: f64) -> Vec<String> {
    let time = (elapsed_s > 0.0).then(|| format!("read {} s after the reference", significant(elapsed_s, 2)));
    let sort = if delta_t_k > 0.0 { "warmer" } else { "colder" };
    let temperature = (delta_t_k != 0.0)
        .then(|| format!("{} K {sort} than at the reference", significant(delta_t_k.abs(), 2)));
    time.into_iter().chain(temperature).collect()
}

/// Expected logarithm of the Bayes factor as odds.
fn gain(nats: f64, between: &str) -> String {
    let odds = nats.exp();
    let odds = if odds > OVERWHELMING {
        "more than 10 000".to_owned()
    } else {
        format!("about {}", significant(odds, 2))
    };
    format!("shifts the odds between {between} by a factor of {odds}")
}

/// What all the readings together promise.
pub(super) fn promise(next: &[NextReport], separation: &[SeparationReport]) -> String {
    let readings: usize = next.iter().map(|r| r.repeats).sum();
    let of = |s: &SeparationReport| {
        let pair = rivals(&s.between, "or");
        let chance = percent(s.right);
        match s.readings_needed {
            Some(1) => format!(
                "{pair}: the first reading is expected to give odds of 20:1 against the wrong one (right in {chance} of cases)."
            ),
            Some(n) => format!(
                "{pair}: after {n} readings the expected odds are 20:1 against the wrong one (right in {chance} of cases)."
            ),
            None => format!(
                "{pair}: {readings} readings give the right answer in {chance} of cases, too few for odds of 20:1 against the wrong one; repeat them."
            ),
        }
    };
    separation.iter().map(of).collect::<Vec<_>>().join(" ")
}

const MEASURE_AGAIN: &str = "Measure the same poses and loads once more, in another order: residuals that stay with the poses come from the machine, residuals \
                             that do not come from the measurement.";

fn in_general(section: Section, d: &Diagnosis) -> Section {
    let terms = catalogue();
    let open = terms.iter().map(|t| t.info()).filter(|i| d.credible_set.iter().any(|e| e.is_term(i.id)));
    let entries: Vec<_> = open.map(|info| Definition::new(info.id, info.how_to_isolate)).collect();
    if entries.is_empty() {
        return section.paragraph(MEASURE_AGAIN);
    }
    section.remark("how to make each candidate visible").with(Block::entries(entries))
}
