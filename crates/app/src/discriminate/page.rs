//! What readings that separate effects are and promise, as a page.

use hexbench_report::number::{odds as odds_of, percent, significant};
use hexbench_report::words::next::{self, settings, way};
use hexbench_report::{Block, Definition, Page, Section};

use super::{Discriminated, Pair, Planned, Promise, Size};

/// The page.
pub(super) fn page(found: &Discriminated) -> Page {
    let breakers = found.breakers.iter().map(|(id, breaker)| Definition::new(id, breaker));
    Page::default()
        .with(readings(found))
        .with(separation(found))
        .with(Section::new("What shows each effect").with(Block::entries(breakers)))
        .with(assumptions(found))
}

fn readings(found: &Discriminated) -> Section {
    let section = match &found.data {
        None => Section::new("Plan").remark("readings that separate the effects"),
        Some(data) => Section::new("Next readings").remark(format!("beside {data}")),
    };
    let none = "No reading of this space separates these effects better than the data in hand.";
    let frames = "Wrench on the platform at the mobile origin, fixed axes; loaded minus reference.";
    let all = found.readings.iter().enumerate();
    section
        .with_all(
            all.map(|(k, reading)| Block::numbered(k + 1, planned(reading, k == 0 || differs(found, k)))),
        )
        .with(found.readings.is_empty().then(|| Block::paragraph(none)))
        .with(Block::entries([Definition::new("frames", frames)]))
}

fn differs(found: &Discriminated, k: usize) -> bool {
    found.readings[k].observation.reference != found.readings[0].observation.reference
}

fn planned(reading: &Planned, with_reference: bool) -> Vec<Definition> {
    let o = &reading.observation;
    let words = (!reading.words.is_empty()).then(|| Definition::new("in words", &reading.words));
    let reference = with_reference && o.reference.to_array().iter().any(|x| *x != 0.0);
    let reference = reference.then(|| Definition::new("reference", next::load(&o.reference.to_array())));
    let pose = Definition::new("pose", next::pose(&settings(o)));
    let load = Definition::new("load", next::load(&o.wrench.to_array()));
    let way = Definition::new("how", way(o.approach, o.elapsed, o.delta_t, reading.repeats));
    words.into_iter().chain([pose, load]).chain(reference).chain([way]).collect()
}

fn separation(found: &Discriminated) -> Section {
    let words = if found.data.is_some() {
        "Odds by the data in hand; expected odds for the truth by the readings chosen, if the first is true and if the second is; \
         chance that they favor the truth."
    } else {
        "Expected likelihood ratio in favor of the true effect, if the first is true and if the second is, with the wrong effect and \
         the springs fitted as well as possible; chance that it favors the truth."
    };
    Section::new("How well they separate")
        .remark(format!("{} readings", found.count()))
        .with_all(found.pairs.iter().map(|p| Block::entries(pair(p))))
        .paragraph(words)
}

fn pair(p: &Pair) -> Vec<Definition> {
    let [a, b] = &p.between;
    let in_hand = p.in_hand.map(|odds| {
        let (odds, first, second) = if odds < 0.0 { (-odds, b, a) } else { (odds, a, b) };
        Definition::new("in hand", format!("odds {} for {first} against {second}", odds_of(odds)))
    });
    let needed = match p.readings_needed {
        Some(1) => "20:1 after the first reading".to_owned(),
        Some(n) => format!("20:1 after {n} such readings"),
        None => "20:1 only after more readings".to_owned(),
    };
    std::iter::once(Definition::new("between", p.between.join(" or ")))
        .chain(in_hand)
        .chain(p.before.as_ref().map(|before| Definition::new("before", promise(before))))
        .chain([Definition::new("chosen", format!("{}; {needed}", promise(&p.after)))])
        .collect()
}

/// `expected odds 16 : 1 and 6.3 : 1, right in 85 %`.
fn promise(p: &Promise) -> String {
    let [a, b] = p.log10_bayes_factor.map(odds_of);
    let both = if a == b { a } else { format!("{a} and {b}") };
    format!("expected odds {both}, right in {}", percent(p.right))
}

fn assumptions(found: &Discriminated) -> Section {
    let tolerances = found.tolerances.map(|assumed| {
        format!(" Tolerances: {assumed}; differences within them do not count as separation.")
    });
    let chosen = format!(
        "Chosen from {} readings (seed {}).{}{}",
        found.candidates,
        found.seed,
        tolerances.unwrap_or_default(),
        found.read_by.as_ref().map_or(String::new(), |sensors| format!(" {sensors}"))
    );
    if found.sizes.is_empty() {
        return Section::new("How it was chosen").paragraph(chosen);
    }
    let entry = |(id, parameters): &(String, Vec<Size>)| {
        let one = |(name, value, unit): &Size| format!("{name} {} {unit}", significant(*value, 2));
        Definition::new(id, parameters.iter().map(one).collect::<Vec<_>>().join(", "))
    };
    Section::new("Sizes assumed")
        .remark("as detected by readings spread evenly over the space, with free springs")
        .with(Block::entries(found.sizes.iter().map(entry)))
        .paragraph(format!("Larger effects are easier to separate. {chosen}"))
}
