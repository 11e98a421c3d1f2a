//! Diagnosis from files to verdict: search, held-out errors, numbers, and what to do next.

mod averaged;
mod context;
mod next;
mod notes;
mod report;

use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod};

use self::averaged::averaged_springs;
use self::context::Context;
use self::notes::{outside, suspects, warnings};
pub use self::report::{
    AbsorbedReport, CandidateReport, Diagnosis, NextReport, NoiseReport, OutsideReport, SeparationReport,
    StepReport, SuspiciousReading,
};
use crate::effects::term::Term;
use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, same_frames};
use crate::estimation::estimate::estimates_with;
use crate::estimation::fit::{Fit, TermSpec, fit};
use crate::estimation::linearization::Linearization;
use crate::estimation::noise::{Noise, NoiseSource, Structure};
use crate::estimation::residuals::{residuals, summarise};
use crate::estimation::tolerances::within_tolerances;
use crate::inference::candidates::Candidate;
use crate::inference::diagnosis::{RankedSets, explain, wanted};
use crate::inference::examination::{Finding, examine};
use crate::inference::explanation::Explanation;
use crate::inference::power::detectable;
use crate::inference::search::Set;
use crate::inference::selection::{HeldOut, same_kind};
use crate::inference::verdict::{Judgement, Verdict, judge};

/// Cosine beyond which two signatures count as indistinguishable.
const LOOK_ALIKE: f64 = 0.95;

/// Rounds of explaining and examining.
const MOST_EXAMINATIONS: usize = 3;

/// Everything behind a diagnosis, for plots and reports.
pub struct DiagnosisStudy {
    /// What people read.
    pub diagnosis: Diagnosis,
    /// The search behind it.
    pub outcome: RankedSets,
    /// The readings it rests on: those of the file without the ones left out.
    pub data: Dataset,
    /// They averaged.
    pub campaign: Campaign,
    /// Fits of the steps.
    pub fits: Vec<Fit>,
}

/// Diagnose a dataset; held-out poses come from `holdout`, else poses are left out in turn.
///
/// # Errors
/// As [`fit`]; [`ModelError::Mismatch`] when the holdout is of another kind, [`ModelError::Astray`] when it was read in other frames.
pub fn diagnose(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    terms: &[Arc<dyn Term>],
) -> Result<DiagnosisStudy, ModelError> {
    if let Some(held) = holdout {
        same_kind(data, held)?;
        same_frames(hexapod, data, held)?;
    }
    let Judged { data, campaign, outcome, findings } = judged(hexapod, data, terms)?;
    let data = &data;
    let mut judgement = judge(&outcome.sets, &outcome.candidates);
    let context = Context { hexapod, data, holdout, campaign: &campaign, outcome: &outcome };
    let best = outcome.sets.sets.first();
    let order = best.map(|s| addition_order(s, &outcome)).unwrap_or_default();
    let (fits, steps) = context.steps(&order)?;
    demote_what_does_not_survive(&mut judgement, &steps);
    let last = fits.last().unwrap_or(&outcome.baseline);
    context.face_holdout(&mut judgement, last);
    if judgement.verdict == Verdict::Adequate && !findings.is_empty() {
        judgement.verdict = Verdict::Measurement;
    }
    let rows = residuals(&campaign, &data.observations, &Linearization::at(&campaign, &last.point)?);
    let added: Vec<String> = match judgement.verdict {
        Verdict::Named | Verdict::Ambiguous => order
            .iter()
            .map(|w| w.term.info().id.to_owned())
            .filter(|id| judgement.sure.contains(id))
            .collect(),
        _ => Vec::new(),
    };
    let model: Vec<String> = order.iter().map(|w| w.term.info().id.to_owned()).collect();
    let richer = order.iter().filter(|w| w.rich).map(|w| w.term.info().id.to_owned()).collect();
    let numbers = estimates_with(&averaged_springs(&outcome, last), last);
    let next = context.next(&judgement);
    let diagnosis = Diagnosis {
        format: "diagnosis/1",
        verdict: judgement.verdict,
        added,
        model,
        richer,
        candidates: candidates(&judgement, &outcome),
        present: judgement.present.clone(),
        credible_set: judgement.credible.clone(),
        steps,
        holdout: if holdout.is_some() { HeldOut::File } else { HeldOut::PosesInTurn },
        noise: NoiseReport {
            translation_um: campaign.noise.translation * 1e6,
            rotation_urad: campaign.noise.rotation * 1e6,
            source: campaign.noise.source,
        },
        parameters: numbers.determined,
        not_determined: numbers.not_determined,
        untestable: outcome.untestable.clone(),
        detectable: detectable(
            &outcome.gram,
            &outcome.candidates,
            &best.map(|s| s.variants.clone()).unwrap_or_default(),
        ),
        next: next.readings,
        separation: next.separation,
        absorbed: context.absorbed(&order, &judgement),
        suspects: suspects(&rows, data),
        outside: outside(&judgement, &outcome),
        warnings: warnings(&campaign, data, last, &judgement),
        findings,
    };
    Ok(DiagnosisStudy { diagnosis, outcome, data: data.clone(), campaign, fits })
}

/// A campaign without the faults of its data, explained.
#[derive(Clone)]
struct Judged {
    data: Dataset,
    campaign: Campaign,
    outcome: RankedSets,
    findings: Vec<Finding>,
}

/// Explains a campaign and examines its readings in turn, until nothing more is found.
fn judged(hexapod: &Hexapod, data: &Dataset, terms: &[Arc<dyn Term>]) -> Result<Judged, ModelError> {
    let campaign = prepare(hexapod, data)?;
    let noise = campaign.noise;
    let outcome = explain(&campaign, terms)?;
    let as_stated = Judged { data: data.clone(), campaign, outcome, findings: Vec::new() };
    let mut judged = as_stated.clone();
    for _ in 0..MOST_EXAMINATIONS {
        let examined = examine(hexapod, data, noise, &judged.outcome)?;
        let same = |a: &Finding, b: &Finding| a.kind == b.kind && a.rows == b.rows;
        let known = examined.findings.len() == judged.findings.len()
            && examined.findings.iter().zip(&judged.findings).all(|(a, b)| same(a, b));
        if known {
            break;
        }
        let campaign = examined.campaign(hexapod)?;
        let outcome = explain(&campaign, terms)?;
        judged = Judged { data: examined.data, campaign, outcome, findings: examined.findings };
    }
    // A law without a name shows in some conditions as a wrong load or pose would, but those do not leave it behind.
    let is_outside = judge(&judged.outcome.sets, &judged.outcome.candidates).verdict == Verdict::Outside;
    let of_conditions = judged.findings.iter().any(|f| f.kind.is_of_conditions());
    Ok(if is_outside && of_conditions { as_stated } else { judged })
}

/// Campaign with its noise level: stated, from repeats, or, failing both, from the residuals of the springs.
///
/// # Errors
/// As [`fit`].
pub fn prepare(hexapod: &Hexapod, data: &Dataset) -> Result<Campaign, ModelError> {
    let campaign = Campaign::new(hexapod, data)?;
    if campaign.noise.source != NoiseSource::Residuals {
        return Ok(within_tolerances(campaign));
    }
    let first = fit(&campaign, &[], None)?;
    let rows = residuals(&campaign, &data.observations, &Linearization::at(&campaign, &first.point)?);
    let rms = summarise(&rows, None).rms;
    let inflate = (6.0 * rows.len() as f64 / first.dof.max(1.0)).sqrt();
    let noise = Noise {
        translation: (rms.translation_um * 1e-6 * inflate).max(1e-12),
        rotation: (rms.rotation_urad * 1e-6 * inflate).max(1e-12),
        source: NoiseSource::Residuals,
        dof: 0.0,
        structure: Structure::Independent,
    };
    Ok(within_tolerances(Campaign::with_noise(hexapod, data, noise)?))
}

/// Terms of a set, the one that explains most alone first.
fn addition_order(set: &Set, outcome: &RankedSets) -> Vec<TermSpec> {
    let all = wanted(set, &outcome.gram, &outcome.candidates, &outcome.natural);
    let alone = |id: &str| {
        let single = |s: &&Set| s.members.len() == 1 && outcome.candidates[s.members[0]].id() == Some(id);
        outcome.sets.sets.iter().find(single).map_or(f64::NEG_INFINITY, |s| s.log_weight)
    };
    let mut order = all;
    order.sort_by(|a, b| alone(b.term.info().id).total_cmp(&alone(a.term.info().id)));
    order
}

/// An effect whose addition does not make held-out readings better predicted is not named.
fn demote_what_does_not_survive(judgement: &mut Judgement, steps: &[StepReport]) {
    for pair in steps.windows(2) {
        let Some(newest) = pair[1].terms.last() else { continue };
        let better = match (&pair[0], &pair[1]) {
            (StepReport { log_density: Some(before), .. }, StepReport { log_density: Some(after), .. }) => {
                after > before
            }
            (StepReport { holdout: Some(before), .. }, StepReport { holdout: Some(after), .. }) => {
                after.chi2_reduced < before.chi2_reduced
            }
            _ => continue,
        };
        if !better && judgement.sure.contains(newest) {
            judgement.sure.retain(|id| id != newest);
            if judgement.verdict == Verdict::Named {
                judgement.verdict = Verdict::Ambiguous;
            }
        }
    }
}

fn candidates(judgement: &Judgement, outcome: &RankedSets) -> Vec<CandidateReport> {
    let report = |(term, probability): &(Explanation, f64)| CandidateReport {
        term: term.clone(),
        // A sum of shares may pass one by its rounding.
        probability: probability.min(1.0),
        indistinguishable: term.term().map_or(Vec::new(), |id| look_alikes(id, outcome)),
    };
    let mut reports: Vec<CandidateReport> = judgement.first.iter().map(report).collect();
    // Looking alike has no direction: what imitates is imitated.
    for k in 0..reports.len() {
        let Some(name) = reports[k].term.term().map(str::to_owned) else { continue };
        for other in reports[k].indistinguishable.clone() {
            let twin = reports.iter_mut().find(|r| r.term.is_term(&other));
            if let Some(twin) = twin.filter(|t| !t.indistinguishable.contains(&name)) {
                twin.indistinguishable.push(name.clone());
            }
        }
    }
    reports
}

/// Terms that imitate the signature a term has in these data, beside the rest of the best set.
fn look_alikes(term: &str, outcome: &RankedSets) -> Vec<String> {
    let index = |c: &Candidate| c.id() == Some(term);
    let Some(own) = outcome.candidates.iter().position(index) else { return Vec::new() };
    let best = outcome.sets.sets.first();
    let others: Vec<_> = best.map_or(Vec::new(), |s| {
        let kept = s.members.iter().zip(&s.variants).filter(|(m, _)| **m != own);
        kept.map(|(_, v)| *v).collect()
    });
    let profile = outcome.gram.profile(&others, &outcome.candidates[own].blocks);
    let Some(&(variant, _)) = profile.first() else { return Vec::new() };
    let mut set = others.clone();
    set.push(variant);
    let Some(posterior) = outcome.gram.posterior(&set, 1.0) else { return Vec::new() };
    let width = outcome.gram.blocks[variant.block].width();
    let values: Vec<f64> = posterior.mean.iter().skip(posterior.mean.len() - width).copied().collect();
    let imitates = |c: &&Candidate| {
        let known = |b: &usize| outcome.gram.imitation(&others, variant.block, &values, *b) > LOOK_ALIKE;
        c.id().is_some_and(|id| id != term) && c.blocks.iter().any(known)
    };
    let in_best = |c: &&Candidate| !others.iter().any(|v| c.blocks.contains(&v.block));
    let like = outcome.candidates.iter().filter(in_best).filter(imitates);
    like.filter_map(|c| c.id().map(str::to_owned)).collect()
}
