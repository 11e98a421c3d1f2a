//! Explaining a campaign and examining its readings in turn; the same with every reading kept.

use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod, Observation};

use super::lone_fault::lone_fault;
use crate::effects::term::Term;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::fit;
use crate::estimation::fit_named::Added;
use crate::estimation::noise::{Noise, NoiseSource, Structure, scatter_beside};
use crate::estimation::residuals::{residuals_at, summarise};
use crate::estimation::tolerances::{places_joints, within_tolerances};
use crate::inference::diagnosis::{RankedSets, explain, is_far_off};
use crate::inference::examination::{
    Examined, Finding, FindingKind, Instrument, ends_of_range, examine, examine_loads, is_at_end,
    states_no_load,
};
use crate::inference::misread::copies;
use crate::inference::verdict::{Verdict, judge};

/// Rounds of explaining and examining.
const MOST_EXAMINATIONS: usize = 3;
/// Change of a noise level, relative, that changes no answer.
const SAME_NOISE: f64 = 0.02;
/// Probability of a fault of the data beyond which it is told beside something outside the catalogue.
const LEAST_RIVAL: f64 = 0.05;

/// A campaign, explained, and what was found wrong with its data.
#[derive(Clone)]
pub(super) struct Judged {
    pub(super) data: Dataset,
    pub(super) campaign: Campaign,
    pub(super) outcome: RankedSets,
    pub(super) findings: Vec<Finding>,
    /// A fault that explains what may be outside the catalogue, and is not found for it.
    pub(super) rival: Option<Finding>,
    /// What was found of the instrument.
    pub(super) instrument: Instrument,
}

impl Judged {
    pub(super) fn of(data: Dataset, campaign: Campaign, outcome: RankedSets, findings: Vec<Finding>) -> Self {
        let instrument = Instrument::as_stated();
        Self { data, campaign, outcome, findings, rival: None, instrument }
    }

    /// Readings held out, of the same instrument.
    pub(super) fn read_alike(&self, held: &Dataset) -> Dataset {
        self.instrument.read_alike(held, &self.campaign.noise)
    }
}

/// A campaign as it is to be answered, and the other way: with all its readings, or without those that were found wrong.
pub(super) struct BothWays {
    pub(super) answer: Judged,
    /// None where nothing was found that leaves a reading out.
    pub(super) other: Option<Result<Judged, ModelError>>,
}

impl BothWays {
    /// `explained`: the readings as stated, where that is done already; `gross`: those that are left out before anything is fitted;
    /// `keep_all`: the answer has all readings.
    pub(super) fn of(
        hexapod: &Hexapod,
        data: &Dataset,
        terms: &[Arc<dyn Term>],
        explained: Option<Box<(Campaign, RankedSets)>>,
        gross: Vec<Finding>,
        keep_all: bool,
    ) -> Result<Self, ModelError> {
        let mut evident: Vec<Finding> = copies(data).into_iter().chain(gross).collect();
        let (mut cleaned, mut kept) = if evident.is_empty() {
            judged(hexapod, data, terms, explained)?
        } else {
            without_evident(hexapod, data, terms, explained, &evident)?
        };
        if let Some(lone) = lone_fault(hexapod, &without_rows(data, &evident), &cleaned) {
            evident.push(lone);
            (cleaned, kept) = without_evident(hexapod, data, terms, None, &evident)?;
        }
        Ok(match kept {
            Some(kept) if keep_all => Self { answer: kept?, other: Some(Ok(cleaned)) },
            other => Self { answer: cleaned, other },
        })
    }
}

type Kept = Option<Result<Judged, ModelError>>;

/// The same without rows that are evidently wrong before anything is fitted, and with all rows.
fn without_evident(
    hexapod: &Hexapod,
    data: &Dataset,
    terms: &[Arc<dyn Term>],
    explained: Option<Box<(Campaign, RankedSets)>>,
    evident: &[Finding],
) -> Result<(Judged, Kept), ModelError> {
    let mut answer = judged(hexapod, &without_rows(data, evident), terms, None)?.0;
    let of_all = judged(hexapod, data, terms, explained);
    let mut kept = of_all.and_then(|(cleaned, kept)| kept.unwrap_or(Ok(cleaned)));
    for judged in std::iter::once(&mut answer).chain(kept.as_mut().ok()) {
        judged.findings.splice(0..0, evident.iter().cloned());
    }
    Ok((answer, Some(kept)))
}

/// Readings without those of some findings.
pub(super) fn without_rows(data: &Dataset, findings: &[Finding]) -> Dataset {
    let is_left_out = |line: u64| findings.iter().any(|finding| finding.rows.contains(&line));
    let observations = data.observations.iter().filter(|o| !is_left_out(o.line)).copied().collect();
    Dataset { observations, ..data.clone() }
}

/// Readings held out without those that show nothing of the machine: those that state no load, where such readings of the measurements
/// move as under one, and those at the end of the range of the instrument.
pub(super) fn sound_alone(held: &Dataset, data: &Dataset, gross: &[Finding]) -> Option<Dataset> {
    if gross.is_empty() {
        return None;
    }
    let is_unloaded = gross.iter().any(|finding| finding.kind == FindingKind::Load);
    let ends = ends_of_range(data);
    let is_sound = |row: &&Observation| !(is_unloaded && states_no_load(row) || is_at_end(held, row, &ends));
    let observations: Vec<_> = held.observations.iter().filter(is_sound).copied().collect();
    (!observations.is_empty()).then(|| Dataset { observations, ..held.clone() })
}

/// Explains a campaign and examines its readings in turn, until nothing more is found; and with the readings left out put back.
fn judged(
    hexapod: &Hexapod,
    data: &Dataset,
    terms: &[Arc<dyn Term>],
    explained: Option<Box<(Campaign, RankedSets)>>,
) -> Result<(Judged, Kept), ModelError> {
    let (campaign, outcome) = if let Some(known) = explained {
        *known
    } else {
        let campaign = prepare(hexapod, data)?;
        let outcome = explain(&campaign, terms)?;
        (campaign, outcome)
    };
    let (campaign, outcome) = with_noise_beside(hexapod, data, terms, (campaign, outcome))?;
    let noise = campaign.noise;
    let as_stated = Judged::of(data.clone(), campaign, outcome, Vec::new());
    // None while nothing is found: with the model at every condition, an answer is most of what is kept.
    let mut anew: Option<(Judged, Examined)> = None;
    let mut doubt = None;
    for _ in 0..MOST_EXAMINATIONS {
        let judged = anew.as_ref().map_or(&as_stated, |(judged, _)| judged);
        let mut examined = examine(hexapod, data, noise, &judged.outcome)?;
        doubt = examined.doubt.take();
        let same = |a: &Finding, b: &Finding| a.kind == b.kind && a.rows == b.rows;
        let known = examined.findings.len() == judged.findings.len()
            && examined.findings.iter().zip(&judged.findings).all(|(a, b)| same(a, b))
            && examined.noise.structure.weighs_like(judged.campaign.noise.structure)
            && examined.instrument.sticks_like(&judged.instrument);
        if known {
            break;
        }
        let campaign = examined.campaign(hexapod)?;
        let outcome = explain(&campaign, terms)?;
        let findings = examined.findings.clone();
        let (data, instrument) = (examined.data.clone(), examined.instrument.clone());
        let judged = Judged { data, campaign, outcome, findings, rival: None, instrument };
        anew = Some((judged, examined));
    }
    let last = anew.as_ref().map_or(&as_stated, |(judged, _)| judged);
    // A law without a name shows in some conditions as a wrong load or pose would, but those do not leave it behind.
    let is_outside = judge(&last.outcome.sets, &last.outcome.candidates).verdict == Verdict::Outside;
    if is_outside && let Some(scattered) = by_scattered_loads(hexapod, &as_stated, noise, terms)? {
        return Ok((scattered, None));
    }
    let of_conditions = last.findings.iter().any(|f| f.kind.is_of_conditions());
    if is_outside && of_conditions {
        return Ok((as_stated, None));
    }
    let is_far_off = is_far_off(&as_stated.outcome.best);
    let leaves_out = |examined: &Examined| examined.findings.iter().any(Finding::excludes);
    let (mut judged, kept) = match anew {
        Some((judged, examined)) => {
            let kept = leaves_out(&examined).then(|| all_kept(hexapod, as_stated, &examined, terms));
            (judged, kept)
        }
        None => (as_stated, None),
    };
    // A law without a name contradicts itself in some readings too, but not by tens of noises.
    if is_far_off {
        judged.findings = judged.findings.into_iter().map(Finding::nothing_explains).collect();
    }
    let rival = doubt.and_then(|doubt| doubt.weigh(&mut judged.outcome.sets));
    judged.rival = rival.filter(|fault| fault.probability > LEAST_RIVAL);
    Ok((judged, kept))
}

/// A campaign whose noise comes from repeats, with what they scatter beside its explanation: an effect that tells one temperature or time
/// from another is in their scatter until it is known.
fn with_noise_beside(
    hexapod: &Hexapod,
    data: &Dataset,
    terms: &[Arc<dyn Term>],
    (mut campaign, mut outcome): (Campaign, RankedSets),
) -> Result<(Campaign, RankedSets), ModelError> {
    if campaign.noise.source != NoiseSource::Repeats {
        return Ok((campaign, outcome));
    }
    for _ in 0..MOST_EXAMINATIONS {
        let left = residuals_at(&campaign, &data.observations, &outcome.best.point)?;
        let Some(noise) = scatter_beside(data, &left).noise() else { break };
        let change = |a: f64, b: f64| (a / b - 1.0).abs();
        let known = campaign.noise;
        if change(noise.translation, known.translation).max(change(noise.rotation, known.rotation))
            < SAME_NOISE
        {
            break;
        }
        campaign = within_tolerances(Campaign::with_noise(hexapod, data, noise)?);
        outcome = explain(&campaign, terms)?;
    }
    Ok((campaign, outcome))
}

/// The campaign of loads that scatter about what the file states, where that leaves nothing unknown. What the whole catalogue could
/// explain hides it where forces that are written and never act have effects of their own.
fn by_scattered_loads(
    hexapod: &Hexapod,
    as_stated: &Judged,
    noise: Noise,
    terms: &[Arc<dyn Term>],
) -> Result<Option<Judged>, ModelError> {
    let Some(mut examined) = examine_loads(hexapod, &as_stated.data, noise, &as_stated.outcome)? else {
        return Ok(None);
    };
    let campaign = examined.campaign(hexapod)?;
    let mut outcome = explain(&campaign, terms)?;
    if judge(&outcome.sets, &outcome.candidates).verdict == Verdict::Outside {
        return Ok(None);
    }
    let rival = examined.doubt.take().and_then(|doubt| doubt.weigh(&mut outcome.sets));
    let Examined { data, findings, instrument, .. } = examined;
    Ok(Some(Judged { data, campaign, outcome, findings, rival, instrument }))
}

/// The same findings with the readings of all rows.
fn all_kept(
    hexapod: &Hexapod,
    as_stated: Judged,
    examined: &Examined,
    terms: &[Arc<dyn Term>],
) -> Result<Judged, ModelError> {
    let findings = examined.findings.clone();
    if findings.iter().all(Finding::excludes) {
        return Ok(Judged { findings, ..as_stated });
    }
    let (data, campaign) = examined.with_all_rows(hexapod, &as_stated.data, as_stated.campaign.noise)?;
    let outcome = explain(&campaign, terms)?;
    let instrument = examined.instrument.clone();
    Ok(Judged { data, campaign, outcome, findings, rival: None, instrument })
}

/// A campaign to which certain terms are fitted. Where they leave the joints of absolute poses where they are drawn, the errors of joints
/// leave far more than loads can do; the tolerances of the loads would then be spent on those errors, and loads count as exact.
///
/// # Errors
/// As [`prepare`].
pub fn prepare_to_fit(hexapod: &Hexapod, data: &Dataset, added: &[Added]) -> Result<Campaign, ModelError> {
    let campaign = with_noise_level(hexapod, data)?;
    let joints_are_fitted = added.iter().any(|one| places_joints(one.term.as_ref()));
    let is_exact = campaign.is_absolute() && !joints_are_fitted;
    Ok(if is_exact { campaign } else { within_tolerances(campaign) })
}

/// Campaign with inputs as good as their tolerances and with its noise level: stated, from repeats, or, failing both, from the residuals
/// of the springs.
///
/// # Errors
/// As [`fit`].
pub fn prepare(hexapod: &Hexapod, data: &Dataset) -> Result<Campaign, ModelError> {
    with_noise_level(hexapod, data).map(within_tolerances)
}

/// The same with inputs that count as exact.
fn with_noise_level(hexapod: &Hexapod, data: &Dataset) -> Result<Campaign, ModelError> {
    let campaign = Campaign::new(hexapod, data)?;
    if campaign.noise.source != NoiseSource::Residuals {
        return Ok(campaign);
    }
    let first = fit(&campaign, &[], None)?;
    let rows = residuals_at(&campaign, &data.observations, &first.point)?;
    let rms = summarise(&rows, None).rms;
    let inflate = (campaign.numbers as f64 / first.dof.max(1.0)).sqrt();
    let level = |rms: Option<f64>| (rms.unwrap_or_default() * 1e-6 * inflate).max(1e-12);
    let noise = Noise {
        translation: level(rms.translation_um),
        rotation: level(rms.rotation_urad),
        source: NoiseSource::Residuals,
        dof: 0.0,
        structure: Structure::Independent,
    };
    Campaign::with_noise(hexapod, data, noise)
}
