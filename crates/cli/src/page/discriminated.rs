//! The page of `hexbench discriminate`.

use hexbench_core::{Observation, StatedTolerances};
use hexbench_design::discriminate::Distance;
use hexbench_model::results::next::Separation;
use hexbench_report::number::{percent, significant};
use hexbench_report::words::next::{self, settings, way};
use hexbench_report::{Block, Definition, Page, Section};
use serde::Serialize;
use serde_json::{Value, json};

/// Decimal logarithms of odds beyond which a number says no more.
const OVERWHELMING: f64 = 4.0;

/// Name of a parameter, its value, its unit.
pub(crate) type Size = (&'static str, f64, &'static str);

/// Readings that separate rivals, and what they promise.
pub(crate) struct Discriminated {
    /// `discrimination/1`.
    pub(crate) format: &'static str,
    /// The measurements in hand.
    pub(crate) data: Option<String>,
    /// The readings.
    pub(crate) readings: Vec<Planned>,
    /// Every pair of rivals.
    pub(crate) pairs: Vec<Pair>,
    /// Sizes in which the rivals count, by their ids.
    pub(crate) sizes: Vec<(String, Vec<Size>)>,
    /// What shows each rival.
    pub(crate) breakers: Vec<(String, String)>,
    /// Readings chosen from.
    pub(crate) candidates: usize,
    /// How well inputs are assumed to be known; none where they count as exact.
    pub(crate) tolerances: Option<StatedTolerances>,
    /// By which sensors everything is read, where the machine has some.
    pub(crate) read_by: Option<String>,
    /// Seed of the candidate poses.
    pub(crate) seed: u32,
}

/// One reading.
pub(crate) struct Planned {
    /// What to set.
    pub(crate) observation: Observation,
    /// How often to read it.
    pub(crate) repeats: usize,
    /// What sort of reading it is.
    pub(crate) words: String,
}

/// Two rivals.
#[derive(Debug, Serialize)]
pub(crate) struct Pair {
    /// Which.
    pub(crate) between: [String; 2],
    /// Decimal logarithm of the odds of the first against the second by the data in hand.
    #[serde(rename = "log10_odds_in_hand")]
    pub(crate) in_hand: Option<f64>,
    /// By the plan compared with.
    pub(crate) before: Option<Promise>,
    /// By the readings chosen.
    pub(crate) after: Promise,
    /// Readings after which the wrong one is on average excluded at 20:1.
    pub(crate) readings_needed: Option<usize>,
}

/// What readings promise for two rivals.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Promise {
    /// Expected decimal logarithm of the Bayes factor for the truth, when the first is true and when the second is.
    pub(crate) log10_bayes_factor: [f64; 2],
    /// Chance that the readings favor the truth.
    pub(crate) right: f64,
    /// Distance of each from the best fit of the other, standard deviations of the noise.
    pub(crate) distance: Option<[f64; 2]>,
}

impl Promise {
    /// From what is expected beside data.
    pub(crate) fn of(s: &Separation) -> Self {
        let log10_bayes_factor = s.log_bayes_factor.map(|x| x / std::f64::consts::LN_10);
        Self { log10_bayes_factor, right: s.right, distance: None }
    }

    /// From the distance of each from the best fit of the other.
    pub(crate) fn of_distances(distances: [Distance; 2]) -> Self {
        Self {
            log10_bayes_factor: distances.map(|d| d.log_likelihood_ratio() / std::f64::consts::LN_10),
            right: f64::midpoint(distances[0].right(), distances[1].right()),
            distance: Some(distances.map(|d| d.value)),
        }
    }
}

impl Discriminated {
    /// The result for programs.
    pub(crate) fn json(&self) -> serde_json::Value {
        let sizes = |(id, parameters): &(String, Vec<Size>)| {
            let one = |(name, value, unit): &Size| json!({"name": name, "value": value, "unit": unit});
            json!({"term": id, "parameters": parameters.iter().map(one).collect::<Vec<_>>()})
        };
        json!({
            "format": self.format,
            "data": self.data,
            "readings": self.readings.iter().map(Planned::value).collect::<Vec<_>>(),
            "pairs": self.pairs,
            "sizes": self.sizes.iter().map(sizes).collect::<Vec<_>>(),
            "tolerances": self.tolerances,
            "seed": self.seed,
        })
    }

    fn count(&self) -> usize {
        self.readings.iter().map(|r| r.repeats).sum()
    }
}

impl Planned {
    fn value(&self) -> Value {
        let o = &self.observation;
        json!({
            "pose": settings(o),
            "wrench": o.wrench.to_array(),
            "reference": o.reference.to_array(),
            "approach": o.approach,
            "elapsed_s": o.elapsed,
            "delta_T_K": o.delta_t,
            "repeats": self.repeats,
            "text": self.words,
        })
    }
}

/// The page.
pub(crate) fn discriminated(found: &Discriminated) -> Page {
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
        Definition::new("in hand", format!("odds 10^{odds:.1} for {first} against {second}"))
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

/// `expected odds 10^1.2 and 10^0.8, right in 85 %`.
fn promise(p: &Promise) -> String {
    let one = |x: f64| {
        if x > OVERWHELMING { format!("beyond 10^{OVERWHELMING}") } else { format!("10^{x:.1}") }
    };
    let [a, b] = p.log10_bayes_factor.map(one);
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
