//! Machine or measurement? Examines the readings before they are used to judge the machine.
//!
//! A laboratory writes down wrong numbers, states its noise too small, or reads one reference for many loads. Taken as
//! exact, each of these looks like physics outside the catalogue. Every campaign is therefore examined for them, in
//! competition with everything the catalogue could explain; faults are reported, and the machine is judged without them.

mod blunders;
mod dead_band;
mod doubt;
mod finding;
mod gross;
mod in_words;
mod input_findings;
mod instead;
mod instrument;
mod kept;
mod of_conditions;
mod remainder;
mod resolution;
mod restricted;
mod scatter;
mod scattered_loads;
mod slopes;
mod tolerance;

use hexbench_core::{Dataset, Hexapod, Matrix6, Measurand, Observation, Sensor, Tolerances, Vector6};

use self::blunders::{Fault, worst};
pub(crate) use self::dead_band::DeadBand;
use self::dead_band::FoundBand;
pub use self::doubt::Doubt;
pub use self::finding::{Finding, FindingKind, is_misread};
pub(crate) use self::gross::{ends_of_range, is_at_end, name_and_range, not_entered, states_nothing_of};
pub use self::gross::{gross_readings, states_no_load};
use self::in_words::finding;
use self::input_findings::{errors_of_inputs, scaled_loads, sensor_otherwise};
use self::instead::instead_of_effects;
pub(crate) use self::instrument::Instrument;
use self::instrument::{rescale, weight_in_tails, whole_of_tails};
use self::remainder::{Beside, Remainder};
use self::resolution::Resolution;
use self::scatter::{Kind, Statement, Statements, statements};
pub(crate) use self::scattered_loads::examine_loads;
use self::slopes::Slopes;
use self::tolerance::{Doubted, Tolerance, inexact_inputs};
use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, row_sigma};
use crate::estimation::fit::{fit, fit_baseline};
use crate::estimation::linearization::Linearization;
use crate::estimation::noise::{Noise, NoiseSource, Structure, Symmetric6};
use crate::estimation::tolerances::{InputKind, within_tolerances};
use crate::inference::diagnosis::RankedSets;
use crate::inference::verdict::NAMED;

/// Evidence over the noise as stated beyond which another statement is believed, nats.
const BELIEVED: f64 = 8.0;
/// The same for errors of joints and loads, nats: every machine is built and loaded to a tolerance, so odds of 20 to 1 are enough.
const LIKELY: f64 = 3.0;
/// Share of the variance common to repeats below which it changes no standard deviation by more than a percent or two.
const LEAST_SHARED: f64 = 0.02;
/// Columns of a reading.
pub(crate) const READINGS: [&str; 6] = Measurand::DeflectionEuler.names();
/// One reading in so many may be left out; beyond it something else is wrong.
const MOST_LEFT_OUT: usize = 10;
/// The same of one pose of few: it is written down once, and is one mistake.
const ONE_POSE: usize = 7;
/// Sensors that are tried where they were found.
const MOST_SENSORS: usize = 3;
/// Faults of a file that are looked for: where there are more, something else is wrong, and each costs a search.
const MOST_FAULTS: usize = 16;

/// Readings without their faults.
#[derive(Debug, Clone)]
pub struct Examined {
    /// Those that remain.
    pub data: Dataset,
    /// Their noise.
    pub noise: Noise,
    /// What was found.
    pub findings: Vec<Finding>,
    /// What they leave open between a fault of the data and something outside the catalogue.
    pub doubt: Option<Doubt>,
    /// What the inputs are worth.
    tolerances: Tolerances,
    /// A sensor as it was found, and its place among the sensors.
    otherwise: Option<(usize, Sensor)>,
    /// What was found of the instrument.
    pub(crate) instrument: Instrument,
}

impl Examined {
    /// The campaign of these readings.
    ///
    /// # Errors
    /// As [`Campaign::with_noise`].
    pub fn campaign(&self, hexapod: &Hexapod) -> Result<Campaign, ModelError> {
        self.campaign_of(hexapod, &self.data)
    }

    /// A campaign of readings with the noise and the tolerances found.
    fn campaign_of(&self, hexapod: &Hexapod, data: &Dataset) -> Result<Campaign, ModelError> {
        let mut hexapod = Hexapod { tolerances: self.tolerances, ..hexapod.clone() };
        if let Some((index, found)) = &self.otherwise {
            hexapod.sensors[*index] = found.clone();
        }
        Ok(within_tolerances(Campaign::with_noise(&hexapod, data, self.noise)?))
    }
}

/// Examines readings beside an explanation of them. `noise`: as stated, or as repeats and residuals show it.
///
/// # Errors
/// As [`Campaign::with_noise`] and [`Linearization::at`](crate::estimation::linearization::Linearization::at).
pub fn examine(
    hexapod: &Hexapod,
    data: &Dataset,
    noise: Noise,
    outcome: &RankedSets,
) -> Result<Examined, ModelError> {
    let (whole, shared) = as_rounded(hexapod, data, noise);
    let mut examined = examined(hexapod, &whole, outcome)?;
    let is_free = matches!(examined.noise.structure, Structure::Independent);
    if is_free && shared > LEAST_SHARED {
        examined.noise.structure = Structure::Setup { share: shared };
    }
    Ok(examined)
}

/// Readings examined for anything but their rounding.
fn examined(hexapod: &Hexapod, whole: &Examined, outcome: &RankedSets) -> Result<Examined, ModelError> {
    let cleaned = without_faults(hexapod, whole.clone(), outcome)?;
    let first = cleaned.first.as_ref().unwrap_or(&cleaned.last);
    // What falls short by the same amount looks like tails, noise, blunders, a sensor that stands elsewhere, and an outlandish law.
    let inputs = cleaned.last.inputs.first().into_iter().chain(&cleaned.last.instead);
    let rivals = inputs.map(|input| input.evidence).fold(cleaned.gain.max(BELIEVED), f64::max);
    if let Some(found) = first.dead_band.as_ref().filter(|found| found.evidence > rivals) {
        return examined(hexapod, &found.taken_out(hexapod, whole), outcome);
    }
    // Many errors that are far off are tails, or loads that scatter; one or two are blunders.
    let of_all = first.statements.first().filter(|s| s.kind != Kind::Law);
    if let Some(&fault) = of_all.filter(|s| s.evidence - first.stated > cleaned.gain) {
        return Ok(settled(whole.clone(), whole, first, &fault));
    }
    let is_overrun = cleaned.first.is_some() && cleaned.last.has_more;
    if let Some(best) = first.best_on_the_whole().filter(|_| is_overrun) {
        return Ok(contradictory(whole, &cleaned.examined, first, &best));
    }
    let best = match cleaned.first {
        Some(_) => cleaned.last.statements.first().copied(),
        None => cleaned.last.best_on_the_whole(),
    };
    let Some(best) = best else { return Ok(cleaned.examined) };
    let rivals = best.evidence - cleaned.last.stated;
    // Noise of another kind explains what joints and loads do not; a sensor that stands elsewhere looks like such noise.
    let is_likely = |input: &&Tolerance| {
        input.evidence > if input.doubted.is_of_sensor() { LIKELY } else { LIKELY.max(rivals) }
    };
    let instead = cleaned.last.instead.as_ref().filter(is_likely);
    let inputs = cleaned.last.inputs.first().filter(|inputs| inputs.evidence > LIKELY.max(rivals));
    let found = instead.or(inputs).or_else(|| sensor_as_found(&cleaned, hexapod, outcome, rivals));
    if let Some(found) = found.cloned() {
        return Ok(loosened(cleaned.examined, &found, hexapod));
    }
    Ok(settled(cleaned.examined, whole, &cleaned.last, &best))
}

/// The sensor that explains more as it was found than any statement about the noise: a turn of many degrees is not linear, and what it
/// leaves looks like noise.
fn sensor_as_found<'a>(
    cleaned: &'a Cleaned,
    hexapod: &Hexapod,
    outcome: &RankedSets,
    rivals: f64,
) -> Option<&'a Tolerance> {
    let is_doubted = |found: &&Tolerance| found.doubted.is_of_sensor() && found.evidence > LIKELY;
    let doubted: Vec<&Tolerance> = cleaned.last.inputs.iter().filter(is_doubted).take(MOST_SENSORS).collect();
    if doubted.is_empty() {
        return None;
    }
    let terms = outcome.sets.sets.first().map_or_else(Vec::new, |best| outcome.wanted(best));
    let stated = fit(&cleaned.examined.campaign(hexapod).ok()?, &terms, None).ok()?;
    let gain = |found: &Tolerance| {
        let campaign = loosened(cleaned.examined.clone(), found, hexapod).campaign(hexapod).ok()?;
        Some(0.5 * (stated.lack_of_fit - fit_baseline(&campaign).ok()?.lack_of_fit))
    };
    let gains = doubted.into_iter().filter_map(|found| Some((found, gain(found)?)));
    let explains = gains.filter(|(_, gain)| *gain > LIKELY.max(rivals));
    explains.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(found, _)| found)
}

/// Readings whose inputs are worse than stated.
fn loosened(mut examined: Examined, found: &Tolerance, hexapod: &Hexapod) -> Examined {
    match found.doubted {
        Doubted::Inputs(kind) => {
            examined.findings.push(errors_of_inputs(found, kind));
            kind.set(&mut examined.tolerances, found.size);
        }
        Doubted::Gain(_) | Doubted::Moments => {
            examined.findings.push(scaled_loads(found));
            InputKind::LoadGain.set(&mut examined.tolerances, found.size);
        }
        Doubted::Sensor(index, input) => {
            let stated = &hexapod.sensors[index];
            examined.findings.push(sensor_otherwise(found, input, stated));
            // Put to where it was found, since a turn of degrees is not linear, and known from there to a wider tolerance.
            let mut sensor = stated.clone();
            sensor.put_off(input, &found.errors);
            sensor.loosen(input, found.factor);
            examined.otherwise = Some((index, sensor));
        }
    }
    examined
}

/// All readings, with what their rounding adds to the noise, and the share of the variance that repeats have in common by it.
fn as_rounded(hexapod: &Hexapod, data: &Dataset, noise: Noise) -> (Examined, f64) {
    let (mut data, mut noise, mut findings) = (data.clone(), noise.independent(), Vec::new());
    let mut shared = 0.0;
    if let Some(resolution) = Resolution::of(&data, &noise) {
        findings.push(resolution.finding());
        resolution.apply(&mut data, &mut noise);
        shared = resolution.shared;
    }
    let tolerances = hexapod.tolerances;
    let instrument = Instrument::as_stated();
    (Examined { data, noise, findings, doubt: None, tolerances, otherwise: None, instrument }, shared)
}

/// Readings looked at.
struct Look {
    /// Statements about their noise, best first.
    statements: Vec<Statement>,
    /// A law far larger than their noise.
    wide_law: Statement,
    /// Evidence of the noise as stated.
    stated: f64,
    /// Evidence of physics without a name.
    physics: f64,
    /// Probability that a search gives to something outside the catalogue that follows no pattern.
    outside: f64,
    /// What is left of every row.
    rows: Vec<Vector6>,
    /// Names of the numbers of the first.
    names: [String; 6],
    /// What their noise is compared with.
    noise: &'static str,
    /// What they tell of the inputs, once no fault is left; the most evident errors first.
    inputs: Vec<Tolerance>,
    /// What an effect of the explanation may be taken for: a sensor that stands elsewhere, a load cell that is off; likewise.
    instead: Option<Tolerance>,
    /// What the instrument does not show; none where that was taken out, and where faults were left out before.
    dead_band: Option<FoundBand>,
    /// True when there are more faults than are left out.
    has_more: bool,
    /// True for absolute poses.
    is_absolute: bool,
    /// False where too few numbers were read to take out what effects of any size could explain.
    is_complete: bool,
}

impl Look {
    /// The best statement, a law far larger than the noise among them: where single faults have not led the fit astray.
    fn best_on_the_whole(&self) -> Option<Statement> {
        let usual = *self.statements.first()?;
        Some(if self.wide_law.evidence > usual.evidence { self.wide_law } else { usual })
    }
}

/// The worst fault of readings, of at most so many rows, and the statements about their noise. `slopes`: of more of the readings, where
/// they were looked at before; `beside`: what is taken out of them.
fn look(
    hexapod: &Hexapod,
    examined: &Examined,
    outcome: &RankedSets,
    most: MostRows,
    slopes: &mut Option<Slopes>,
    beside: &mut Beside,
) -> Result<(Option<Fault>, Look), ModelError> {
    let campaign = Campaign::with_noise(hexapod, &examined.data, examined.noise)?;
    let may_stick =
        slopes.is_none() && *beside == Beside::Catalogue && examined.instrument.dead_band.is_none();
    let known = Slopes::of(&examined.data, &campaign, &outcome.best.point, slopes.take())?;
    let slopes: &Slopes = slopes.insert(known);
    let lin = Linearization::at(&campaign, &outcome.best.point)?;
    let beside_of = |what: Beside| Remainder::new(&examined.data, &campaign, outcome, slopes, &lin, what);
    let mut rest = beside_of(*beside);
    let worst_of = |rest: &Remainder<'_>| worst(rest, most.any.max(most.of_one_pose));
    let mut worst = worst_of(&rest);
    if worst.is_none() && rest.is_complete && campaign.is_absolute() {
        // A pose is read under a load or two, of which one that is wrong looks like much that the catalogue has.
        let found = beside_of(Beside::Explanation);
        let of_condition = worst_of(&found).filter(Fault::is_evident_of_conditions);
        if of_condition.is_some() {
            (rest, worst, *beside) = (found, of_condition, Beside::Explanation);
        }
    }
    let Statements { all: statements, wide_law, physics, stated } =
        statements(&rest, rest.evidence_of_patterns(outcome));
    let is_too_much = |fault: &Fault| fault.rows.len() > most.of(fault);
    let has_more = worst.as_ref().is_some_and(is_too_much);
    let fault = worst.filter(|fault| !is_too_much(fault));
    let inputs = if fault.is_none() { inexact_inputs(&rest) } else { Vec::new() };
    let instead = if fault.is_none() { instead_of_effects(&rest, &outcome.natural) } else { None };
    let dead_band = if may_stick { DeadBand::of(&rest, outcome) } else { None };
    let names = std::array::from_fn(|k| campaign.name_of(0, k));
    let noise = match campaign.noise.source {
        NoiseSource::Repeats => "the noise of all repeats",
        NoiseSource::Residuals => "the average noise",
        _ => "the stated noise",
    };
    let (rows, is_complete) = (rest.rows, rest.is_complete);
    let outside = outcome.sets.outside();
    let look = Look {
        statements,
        wide_law,
        stated,
        physics,
        outside,
        rows,
        names,
        noise,
        inputs,
        instead,
        dead_band,
        has_more,
        is_absolute: campaign.is_absolute(),
        is_complete,
    };
    Ok((fault, look))
}

/// Rows of which a fault may be.
#[derive(Clone, Copy, Default)]
struct MostRows {
    any: usize,
    of_one_pose: usize,
}

impl MostRows {
    fn among(rows: usize) -> Self {
        Self { any: rows / MOST_LEFT_OUT, of_one_pose: rows / ONE_POSE }
    }

    fn of(self, fault: &Fault) -> usize {
        if fault.of_pose { self.any.max(self.of_one_pose) } else { self.any }
    }

    /// For what else is wrong.
    fn without(self, fault: &Fault) -> Self {
        Self { any: self.any.saturating_sub(fault.rows.len()), of_one_pose: 0 }
    }
}

/// Readings without single faults.
struct Cleaned {
    examined: Examined,
    /// With all their faults, when there are any.
    first: Option<Look>,
    last: Look,
    /// Evidence for the faults and for the best statement about what remains, over readings as stated.
    gain: f64,
}

fn without_faults(
    hexapod: &Hexapod,
    mut examined: Examined,
    outcome: &RankedSets,
) -> Result<Cleaned, ModelError> {
    let mut most = MostRows::among(examined.data.observations.len());
    let mut gain = 0.0;
    let (mut first, mut before, mut slopes, mut beside) = (None, None, None, Beside::Catalogue);
    loop {
        let (fault, last) = look(hexapod, &examined, outcome, most, &mut slopes, &mut beside)?;
        gain += before.map_or(0.0, |stated: f64| last.stated - stated);
        let Some(fault) = fault else {
            gain += last.statements.first().map_or(0.0, |best| best.evidence - last.stated).max(0.0);
            return Ok(Cleaned { examined, first, last, gain });
        };
        most = if examined.findings.len() < MOST_FAULTS { most.without(&fault) } else { MostRows::default() };
        gain -= fault.cost;
        before = Some(last.stated);
        first.get_or_insert(last);
        examined.findings.push(fault.finding);
        let mut row = 0;
        examined.data.observations.retain(|_| {
            row += 1;
            !fault.rows.contains(&(row - 1))
        });
    }
}

/// Readings of which more are wrong than a record gets wrong by itself: none is left out, and what they may have in common is asked for.
/// `cleaned`: without the worst of them; `look`: at all of them, of which `best` says most.
fn contradictory(whole: &Examined, cleaned: &Examined, look: &Look, best: &Statement) -> Examined {
    let mut all = settled(whole.clone(), whole, look, best);
    let faults = &cleaned.findings[whole.findings.len()..];
    let mut rows: Vec<u64> = faults.iter().flat_map(|f| f.rows.iter().copied()).collect();
    rows.sort_unstable();
    let first = rows.first().copied().unwrap_or(0);
    let readings = if rows.len() == 1 { "1 reading".to_owned() } else { format!("{} readings", rows.len()) };
    all.findings.push(Finding {
        probability: faults.iter().map(|f| f.probability).fold(1.0, f64::min),
        rows,
        size: format!("{readings} and more"),
        text: format!(
            "{readings}, the first in line {first}, and others near are incompatible with the rest, too many for single mistakes: all \
             are kept"
        ),
        next: "look for what these lines have in common: a sign, a unit or a setup that changed during the measurement".to_owned(),
        ..Finding::of(FindingKind::Contradiction)
    });
    all
}

/// What remains is judged by the best statement about it; `whole`: with all readings.
fn settled(mut examined: Examined, whole: &Examined, look: &Look, best: &Statement) -> Examined {
    let from_data = matches!(examined.noise.source, NoiseSource::Repeats | NoiseSource::Residuals);
    let is_fault = |s: &&Statement| s.kind != Kind::Law && !(s.kind == Kind::Level && from_data);
    let faults: Vec<Statement> = look.statements.iter().filter(is_fault).copied().collect();
    let is_law = best.kind == Kind::Law;
    let fault = if is_law { faults.first() } else { Some(best).filter(is_fault) };
    let gain = |statement: &Statement| statement.evidence - look.stated;
    let doubt = faults.first().map(|fault| Doubt::open(look, &faults, finding(fault, gain(fault), look)));
    let is_rather = || doubt.as_ref().is_some_and(|doubt| doubt.of_fault(look.outside) >= NAMED);
    if let Some(fault) = fault.filter(|fault| gain(fault) >= BELIEVED && (!is_law || is_rather())) {
        let doubt = Doubt::believed(look, finding(fault, gain(fault), look));
        examined.findings.push(doubt.fault.clone());
        examined.findings.extend(level_beside(fault, look, examined.tolerances.noise).filter(|_| !from_data));
        examined.doubt = Some(doubt);
        apply(&mut examined, &look.rows, fault);
        return examined;
    }
    // Physics without a name: what it does to a condition is no fault of its load or pose.
    if is_law && gain(best) > BELIEVED && examined.findings.iter().any(|f| f.kind.is_of_conditions()) {
        return whole.clone();
    }
    examined.doubt = doubt;
    examined
}

/// The level of the noise, where it is wrong beside what errors have in common. `tolerance`: of a stated one.
fn level_beside(fault: &Statement, look: &Look, tolerance: f64) -> Option<Finding> {
    let of_all = look.statements.iter().find(|s| s.kind == Kind::Level)?;
    let (gain, own) = (of_all.evidence - look.stated, fault.own_level()?);
    let level = Statement { level: own, ..*of_all };
    (gain >= BELIEVED && own > 1.0 + tolerance).then(|| finding(&level, gain, look))
}

/// Weighs the readings as the statement says.
fn apply(examined: &mut Examined, remainder: &[Vector6], best: &Statement) {
    let (noise, found) = (&mut examined.noise, &mut examined.instrument.scales);
    match best.kind {
        Kind::Tails(freedom) => {
            let mut left = remainder.iter();
            of_rows(&mut examined.data, noise, |_, sigma| {
                let z = left.next().map_or_else(Vector6::zeros, |left| left / best.level);
                Vector6::from_fn(|k, _| sigma[k] * best.level * weight_in_tails(freedom, z[k]))
            });
            // Readings still to come scatter by the whole of it.
            let whole = whole_of_tails(freedom);
            noise.translation *= whole;
            noise.rotation *= whole;
            *found *= whole * best.level;
            examined.instrument.tails = Some(freedom);
        }
        Kind::Level | Kind::Common(_) => {
            rescale(&mut examined.data, &Vector6::repeat(best.level));
            *found *= best.level;
        }
        Kind::Levels(levels) => {
            let scales = levels.of_numbers();
            of_rows(&mut examined.data, noise, |_, sigma| Vector6::from(sigma).component_mul(&scales));
            scale_noise(noise, &scales);
            found.component_mul_assign(&scales);
        }
        Kind::Proportional(share) => {
            let mut squares = Vector6::zeros();
            let rows = examined.data.observations.len().max(1) as f64;
            of_rows(&mut examined.data, noise, |row, sigma| {
                let widened = Vector6::from_fn(|k, _| (share * row.measured[k]).hypot(best.level * sigma[k]));
                squares += widened.component_div(&Vector6::from(sigma)).map(|ratio| ratio * ratio) / rows;
                widened
            });
            let scales = squares.map(f64::sqrt);
            scale_noise(noise, &scales);
            found.component_mul_assign(&scales);
            return;
        }
        Kind::Law => return,
    }
    noise.translation *= best.level;
    noise.rotation *= best.level;
    if let Kind::Common(structure) = best.kind {
        noise.structure = structure;
    }
    if let Structure::Axes { covariance } = noise.structure {
        // Standard deviations as stated stay those of translations and rotations on the whole.
        let read = covariance.matrix();
        let whole = |k: usize| ((0..3).map(|i| read[(k + i, k + i)]).sum::<f64>() / 3.0).sqrt();
        let scale = Vector6::from_fn(|k, _| if k < 3 { whole(0) } else { whole(3) });
        let relative = Matrix6::from_fn(|i, j| read[(i, j)] / (scale[i] * scale[j]));
        noise.structure = Structure::Axes { covariance: Symmetric6::new(&relative) };
        scale_noise(noise, &scale);
        rescale(&mut examined.data, &scale);
        found.component_mul_assign(&scale);
    }
}

/// Every row states its own standard deviations from now on, of those that it had.
fn of_rows(data: &mut Dataset, noise: &Noise, mut widened: impl FnMut(&Observation, [f64; 6]) -> Vector6) {
    for row in &mut data.observations {
        row.sigma = Some(widened(row, row_sigma(row, noise)).into());
    }
}

/// Scales the noise of readings still to come: on the whole of the translations, and of the rotations.
fn scale_noise(noise: &mut Noise, scales: &Vector6) {
    let whole = |first: usize| (scales.fixed_rows::<3>(first).norm_squared() / 3.0).sqrt();
    noise.translation *= whole(0);
    noise.rotation *= whole(3);
}
