//! What a reader should know beside the verdict: patterns, warnings, what could not be tested.

use hexbench_core::Dataset;
use hexbench_core::words::{lower_first, to_digits};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::report::OutsideReport;
use crate::effects::term::Natural;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::Fit;
use crate::estimation::linearization::Active;
use crate::estimation::noise::{Noise, NoiseSource, scatter};
use crate::inference::diagnosis::RankedSets;
use crate::inference::examination::Finding;
use crate::inference::pattern::{Course, LegPattern, Pattern, PatternVariable};
use crate::inference::verdict::{Judgement, Verdict};

/// Chance that repeats contradict a true noise statement.
const CONTRADICTION_CHANCE: f64 = 1e-4;

/// Standard deviations by which a value is clearly negative, or clearly large.
const CLEARLY: f64 = 4.0;
/// So many times its plausible size no effect is taken for granted: twice the widest prior.
const HUGE: f64 = 4.0;

/// `rival`: a fault of the data that may be behind it.
pub(super) fn outside(
    judgement: &Judgement,
    outcome: &RankedSets,
    rival: Option<&Finding>,
) -> Option<OutsideReport> {
    if judgement.verdict != Verdict::Outside && !judgement.outside_is_small {
        return None;
    }
    Some(match (outcome.simplest_pattern(), rival) {
        (Some(pattern), _) => known_pattern(pattern),
        (None, None) => unknown_pattern(),
        (None, Some(rival)) => {
            let unknown = unknown_pattern();
            let text = format!(
                "{}; a fault of the data may be behind them instead ({})",
                unknown.text,
                in_short(rival)
            );
            OutsideReport { text, ..unknown }
        }
    })
}

/// `noise of the loads, 1.02 N and 0.096 N m: 42 %`.
fn in_short(fault: &Finding) -> String {
    format!("{}, {}: {:.0} %", lower_first(fault.kind.title()), fault.size, 100.0 * fault.probability)
}

/// A fault of the data that is not sure enough to be found; `noise` is what it would change.
fn open_fault(fault: &Finding, noise: &Noise) -> String {
    let noise = if noise.is_stated() { "the noise as stated" } else { "the noise" };
    format!(
        "a fault of the data may be behind what {noise} leaves unexplained ({}); to make sure, {}",
        in_short(fault),
        fault.next
    )
}

fn known_pattern(of_pattern: &Pattern) -> OutsideReport {
    let (leg, period) = match of_pattern {
        Pattern::Leg(LegPattern { leg, course: Course::Periodic(period), .. }) => (*leg, Some(period * 1e3)),
        Pattern::Leg(LegPattern { leg, .. }) => (*leg, None),
        _ => (None, None),
    };
    let variable = of_pattern.variable().map(PatternVariable::name);
    let leg = leg.map(|l| l + 1);
    OutsideReport { leg, variable, pattern: Some(of_pattern.word()), period, text: of_pattern.text() }
}

pub(super) fn unknown_pattern() -> OutsideReport {
    let text = "the residuals are larger than the noise, but follow neither a term of the catalogue nor a simple pattern";
    OutsideReport { leg: None, variable: None, pattern: None, period: None, text: text.to_owned() }
}

pub(super) fn warnings(
    campaign: &Campaign,
    data: &Dataset,
    fit: &Fit,
    judgement: &Judgement,
    natural: &Natural,
    rival: Option<&Finding>,
) -> Vec<String> {
    let mut all = Vec::new();
    if judgement.refuted {
        all.push(
            "the best explanation of the fitted data does not predict the held-out poses to within noise and uncertainty: \
             compare the noise and the loads of both files"
                .to_owned(),
        );
    }
    if !fit.is_settled() {
        all.push("the fit did not converge; treat its numbers as provisional, and check units, axes and angles of the file".to_owned());
    }
    if !campaign.noise.allows_verdict() {
        all.push(
            "no noise level is stated and there are too few repeats: it was taken from the residuals, so nothing can be \
             said about whether the model is adequate; state [metrology] in the hexapod file"
                .to_owned(),
        );
    }
    all.extend(contradiction(campaign, data));
    all.extend(odd_signs(fit));
    all.extend(odd_sizes(fit, natural));
    all.extend(rival.map(|fault| open_fault(fault, &campaign.noise)));
    all
}

/// What to check where a value is negative that rarely is.
fn odd_signs(fit: &Fit) -> Vec<String> {
    let of_term = |(term, active): (usize, &Active)| {
        let (columns, info) = (fit.parameters.values_of_term(term), active.term.info());
        let all = columns.zip(&active.values).zip(info.parameters);
        let odd = all.filter(|((column, value), _)| **value < -CLEARLY * fit.std(*column));
        let odd = odd.filter_map(|(_, parameter)| Some((parameter.name, parameter.if_negative?)));
        odd.map(|(name, check)| format!("{}.{name} is negative: {check}", info.id)).collect::<Vec<_>>()
    };
    fit.point.active.iter().enumerate().flat_map(of_term).collect()
}

/// The largest number of an effect where it is far beyond what is plausible.
fn odd_sizes(fit: &Fit, natural: &Natural) -> Vec<String> {
    let of_term = |(term, active): (usize, &Active)| {
        let (columns, info) = (fit.parameters.values_of_term(term), active.term.info());
        let sizes = active.term.natural_sizes(natural, active.shape);
        let clear = columns.zip(&active.values).zip(info.parameters.iter().zip(sizes));
        let clear = clear.filter(|((column, value), _)| value.abs() > CLEARLY * fit.std(*column));
        let times = clear.map(|((_, value), (p, size))| (p.name, value.abs() / size));
        let (name, times) = times.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, times)| *times > HUGE)?;
        Some(format!(
            "{}.{name} is {} times its plausible size: check the units of loads, readings and joints before you look for it",
            info.id,
            to_digits(times, 2)
        ))
    };
    fit.point.active.iter().enumerate().filter_map(of_term).collect()
}

/// Repeats that scatter more or less than the stated noise.
pub(super) fn contradiction(campaign: &Campaign, data: &Dataset) -> Option<String> {
    // A finding that has changed the noise has said how repeats scatter.
    if campaign.noise.source != NoiseSource::Metrology || campaign.has_adjusted_noise() {
        return None;
    }
    let s = scatter(data, &campaign.axes);
    let chi2 = ChiSquared::new(s.dof).ok()?;
    let check = |variance: f64, stated: f64, what: &str, unit: &str| {
        let p = chi2.cdf(s.dof * variance / (stated * stated));
        let off = !(CONTRADICTION_CHANCE..=1.0 - CONTRADICTION_CHANCE).contains(&p);
        off.then(|| {
            format!(
                "repeats scatter by {} {unit} in {what}, but [metrology] states {} {unit}: every probability here \
                 rests on the stated value; correct it, or look for what disturbs single readings",
                to_digits(variance.sqrt() * 1e6, 3),
                to_digits(stated * 1e6, 3)
            )
        })
    };
    check(s.variance_translation, campaign.noise.translation, "translation", "um")
        .or_else(|| check(s.variance_rotation, campaign.noise.rotation, "rotation", "urad"))
}
