//! `hexbench discriminate`: readings that separate effects, as a new plan or beside measurements in hand.

mod page;

use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod, Observation, StatedTolerances};
use hexbench_design::discriminate::{Contest, Distance, SeparatingPlan, candidate_readings};
use hexbench_design::{Space, noise_to_come, nominal};
use hexbench_model::effects::term::Term;
use hexbench_model::estimation::fit_named::term_named;
use hexbench_model::estimation::noise::Noise;
use hexbench_model::results::diagnose::prepare;
use hexbench_model::results::next::{
    EXCLUDED_ODDS, Effort, PairForecast, Separation, Suspects, propose, suspects,
};
use hexbench_report::Page;
use hexbench_report::words::next::settings;
use hexbench_report::words::notes::read_by;
use serde::Serialize;
use serde_json::{Value, json};

use crate::Failure;
use crate::design::StartedSearch;

/// Readings of a new plan, and further ones beside data, unless asked otherwise.
const USUAL_READINGS: [u16; 2] = [12, 6];

/// What somebody wants of readings that separate effects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeparationWish {
    /// Readings to choose; 12 of a new plan and 6 beside measurements unless said.
    pub readings: Option<u16>,
    /// How far each effect of a new plan would stand out in readings spread evenly, in standard deviations.
    pub visible: f64,
    /// Seed of the candidate poses.
    pub seed: u32,
}

/// Name of a parameter, its value, its unit.
type Size = (&'static str, f64, &'static str);

/// Readings that separate rivals, and what they promise.
pub struct Discriminated {
    /// The measurements in hand.
    data: Option<String>,
    /// The readings.
    readings: Vec<Planned>,
    /// Every pair of rivals.
    pairs: Vec<Pair>,
    /// Sizes in which the rivals count, by their ids.
    sizes: Vec<(String, Vec<Size>)>,
    /// What shows each rival.
    breakers: Vec<(String, String)>,
    /// Readings chosen from.
    candidates: usize,
    /// How well inputs are assumed to be known; none where they count as exact.
    tolerances: Option<StatedTolerances>,
    /// By which sensors everything is read, where the machine has some.
    read_by: Option<String>,
    /// Seed of the candidate poses.
    seed: u32,
}

/// One reading.
struct Planned {
    /// What to set.
    observation: Observation,
    /// How often to read it.
    repeats: usize,
    /// What sort of reading it is.
    words: String,
}

/// Two rivals.
#[derive(Debug, Serialize)]
struct Pair {
    /// Which.
    between: [String; 2],
    /// Decimal logarithm of the odds of the first against the second by the data in hand.
    #[serde(rename = "log10_odds_in_hand")]
    in_hand: Option<f64>,
    /// By the plan compared with.
    before: Option<Promise>,
    /// By the readings chosen.
    after: Promise,
    /// Readings after which the wrong one is on average excluded at 20:1.
    readings_needed: Option<usize>,
}

/// What readings promise for two rivals.
#[derive(Debug, Clone, Copy, Serialize)]
struct Promise {
    /// Expected decimal logarithm of the Bayes factor for the truth, when the first is true and when the second is.
    log10_bayes_factor: [f64; 2],
    /// Chance that the readings favor the truth.
    right: f64,
    /// Distance of each from the best fit of the other, standard deviations of the noise.
    distance: Option<[f64; 2]>,
}

impl Promise {
    /// From what is expected beside data.
    fn of(s: &Separation) -> Self {
        let log10_bayes_factor = s.log_bayes_factor.map(|x| x / std::f64::consts::LN_10);
        Self { log10_bayes_factor, right: s.right, distance: None }
    }

    /// From the distance of each from the best fit of the other.
    fn of_distances(distances: [Distance; 2]) -> Self {
        Self {
            log10_bayes_factor: distances.map(|d| d.log_likelihood_ratio() / std::f64::consts::LN_10),
            right: f64::midpoint(distances[0].right(), distances[1].right()),
            distance: Some(distances.map(|d| d.value)),
        }
    }
}

impl Discriminated {
    /// The result for programs.
    pub fn json(&self) -> Value {
        let sizes = |(id, parameters): &(String, Vec<Size>)| {
            let one = |(name, value, unit): &Size| json!({"name": name, "value": value, "unit": unit});
            json!({"term": id, "parameters": parameters.iter().map(one).collect::<Vec<_>>()})
        };
        json!({
            "format": "discrimination/1",
            "data": self.data,
            "readings": self.readings.iter().map(Planned::value).collect::<Vec<_>>(),
            "pairs": self.pairs,
            "sizes": self.sizes.iter().map(sizes).collect::<Vec<_>>(),
            "tolerances": self.tolerances,
            "seed": self.seed,
        })
    }

    /// The page.
    pub fn page(&self) -> Page {
        page::page(self)
    }

    /// The readings, each repeat in a row of its own.
    pub fn readings_to_take(&self) -> Dataset {
        let repeated = (1..).zip(&self.readings).flat_map(|(pose_id, r)| {
            (1..).take(r.repeats).map(move |repeat| Observation { pose_id, repeat, ..r.observation })
        });
        Dataset::of_deflections("", repeated.collect())
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

/// The effects to be separated, by their ids.
///
/// # Errors
/// [`Failure::Usage`] unless they are two different ones or more, [`Failure::Model`] for a name that is none.
pub fn rivals(ids: &[String], known: &[Arc<dyn Term>]) -> Result<Vec<Arc<dyn Term>>, Failure> {
    let twice = (1..ids.len()).any(|i| ids[..i].contains(&ids[i]));
    if ids.len() < 2 || twice {
        return Err(Failure::usage(
            "separating effects needs two different ones",
            "Add --between TERM twice; `hexbench terms` lists the terms.",
        ));
    }
    ids.iter().map(|id| term_named(id, known).map_err(Failure::of_name)).collect()
}

/// A new plan; `against`: a plan to compare it with, `begun` hears of the number of steps and gives what hears of each.
///
/// # Errors
/// [`Failure::Cause`], [`Failure::Usage`] for a machine that states no noise.
pub fn new_plan(
    hexapod: &Hexapod,
    space: &Space,
    terms: &[Arc<dyn Term>],
    wish: &SeparationWish,
    against: Option<&Dataset>,
    begun: &StartedSearch<'_>,
) -> Result<Discriminated, Failure> {
    let candidate_readings = candidate_readings(space, hexapod, terms, wish.seed)?;
    let count = usize::from(wish.readings.unwrap_or(USUAL_READINGS[0]));
    let contest = Contest::new(
        hexapod,
        nominal::compliance(hexapod),
        noise(hexapod)?,
        terms,
        &candidate_readings,
        count,
        wish.visible,
    )?;
    let step = begun(count as u64);
    let plan = SeparatingPlan::search(&contest, space, hexapod, &candidate_readings, count, &*step)?;
    let before = against.map(|plan| distances(&contest, plan)).transpose()?;
    let names = names(terms);
    let promise = |distances: &[Distance], [a, b]: [usize; 2]| {
        let of = |pair: [usize; 2]| distances.iter().find(|d| d.of == pair).copied();
        of([a, b]).zip(of([b, a])).map(|(x, y)| Promise::of_distances([x, y]))
    };
    let pair = |between: [usize; 2]| {
        Some(Pair {
            between: between.map(|k| names[k].clone()),
            in_hand: None,
            before: before.as_ref().and_then(|d| promise(d, between)),
            after: promise(&plan.distances, between)?,
            readings_needed: needed(&plan.distances, between, count),
        })
    };
    let sizes = (0..contest.rivals()).map(|k| (names[k].clone(), contest.assumed(k)));
    Ok(Discriminated {
        data: None,
        readings: plan
            .readings
            .into_iter()
            .map(|r| Planned { observation: r.observation, repeats: r.repeats, words: r.words })
            .collect(),
        pairs: pairs(terms.len()).filter_map(pair).collect(),
        sizes: sizes.collect(),
        breakers: breakers(terms),
        candidates: candidate_readings.len(),
        tolerances: contest.tolerances(),
        read_by: read_by(&hexapod.sensors),
        seed: wish.seed,
    })
}

/// Further readings beside measurements; `source` names those.
///
/// # Errors
/// [`Failure::Model`], [`Failure::Cause`].
pub fn next_readings(
    hexapod: &Hexapod,
    space: &Space,
    terms: &[Arc<dyn Term>],
    wish: &SeparationWish,
    (data, source): (&Dataset, &str),
) -> Result<Discriminated, Failure> {
    let of_model = Failure::of_model(source);
    let campaign = prepare(hexapod, data).map_err(of_model)?;
    let Suspects { rivals, log_evidence } = suspects(&campaign, terms).map_err(of_model)?;
    let as_read = |o: Observation| {
        let measured = if data.is_absolute() { o.pose.to_array() } else { [0.0; 6] };
        Observation { measured, ..o }
    };
    let candidate_readings: Vec<Observation> =
        candidate_readings(space, hexapod, terms, wish.seed)?.into_iter().map(as_read).collect();
    let count = usize::from(wish.readings.unwrap_or(USUAL_READINGS[1]));
    let proposed =
        propose(&campaign, &rivals, &candidate_readings, Effort::Exactly(count)).map_err(of_model)?;
    let names = names(terms);
    let pair = |o: &PairForecast| {
        let [a, b] = o.between;
        let odds = log_evidence[a].zip(log_evidence[b]).map(|(a, b)| (a - b) / std::f64::consts::LN_10);
        Pair {
            between: o.between.map(|k| names[k].clone()),
            in_hand: odds,
            before: None,
            after: Promise::of(&o.separation),
            readings_needed: o.readings_needed,
        }
    };
    Ok(Discriminated {
        data: Some(source.to_owned()),
        pairs: proposed.forecasts.iter().map(pair).collect(),
        readings: proposed
            .proposals
            .into_iter()
            .map(|p| Planned { observation: p.observation, repeats: p.repeats, words: p.words })
            .collect(),
        sizes: Vec::new(),
        breakers: breakers(terms),
        candidates: candidate_readings.len(),
        tolerances: campaign.assumed_tolerances(),
        read_by: None,
        seed: wish.seed,
    })
}

fn names(terms: &[Arc<dyn Term>]) -> Vec<String> {
    terms.iter().map(|t| t.info().id.to_owned()).collect()
}

/// Readings like those of the plan after which the wrong one of a pair is on average excluded: information grows with their number.
fn needed(distances: &[Distance], pair: [usize; 2], count: usize) -> Option<usize> {
    const MOST: usize = 10_000;
    let own = distances.iter().filter(|d| d.of.iter().all(|k| pair.contains(k)));
    let least = own.map(Distance::log_likelihood_ratio).fold(f64::INFINITY, f64::min);
    let each = least / count as f64;
    (1..=MOST).find(|&n| n as f64 * each >= EXCLUDED_ODDS.ln())
}

fn pairs(rivals: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..rivals).flat_map(move |a| (a + 1..rivals).map(move |b| [a, b]))
}

fn breakers(terms: &[Arc<dyn Term>]) -> Vec<(String, String)> {
    terms.iter().map(|t| (t.info().id.to_owned(), t.info().how_to_isolate.to_owned())).collect()
}

/// Distances by a plan.
fn distances(contest: &Contest<'_>, plan: &Dataset) -> Result<Vec<Distance>, Failure> {
    let informations = contest.informations(&plan.observations)?;
    let total = informations.iter().skip(1).fold(informations[0].clone(), |sum, m| sum + m);
    Ok(contest.distances(&total))
}

fn noise(hexapod: &Hexapod) -> Result<Noise, Failure> {
    noise_to_come(hexapod).ok_or_else(|| Failure::usage("how well readings separate effects depends on their noise, which the hexapod file does not state", "Add [metrology] with sigma_translation_um and sigma_rotation_urad."))
}
