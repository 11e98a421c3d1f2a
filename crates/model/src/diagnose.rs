//! The diagnosis as people and programs receive it.

use std::collections::BTreeMap;
use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod};
use serde::Serialize;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::campaign::Campaign;
use crate::candidates::{Candidate, Kind};
use crate::diagnosis::{Outcome, explain, wanted};
use crate::error::ModelError;
use crate::estimate::{Estimate, estimates};
use crate::fit::{Fit, Wanted, average_over_shapes, fit};
use crate::linearization::Linearization;
use crate::next::separate;
use crate::noise::{Noise, NoiseSource, scatter};
use crate::pattern::Course;
use crate::power::{Detectable, detectable};
use crate::residuals::{
    ErrorSummary, Residual, leave_poses_out, prediction_errors, residuals, summarise, survival,
};
use crate::search::Set;
use crate::term::Term;
use crate::verdict::{Judgement, NONE, OUTSIDE, Verdict, judge};

/// Cosine beyond which two signatures count as indistinguishable.
const LOOK_ALIKE: f64 = 0.95;
/// Chance that a clean file of any size has a suspect reading.
const SUSPECT_CHANCE: f64 = 0.01;
/// Chance that repeats contradict a true noise statement.
const CONTRADICTION_CHANCE: f64 = 1e-4;
/// A model that predicts the holdout file worse than this chance allows is refuted.
const REFUTED_CHANCE: f64 = 1e-5;
/// A rival that predicts the holdout file at least this well is credible.
const SURVIVAL_CHANCE: f64 = 1e-3;
/// Sets faced with the holdout file once the best one is refuted.
const SETS_FACED: usize = 40;
/// Candidates whose absorbed bias is worth a fit of their own.
const CANDIDATES_FITTED: usize = 4;

/// Result of `diagnose`.
#[derive(Debug, Clone, Serialize)]
pub struct Diagnosis {
    /// `diagnosis/1`.
    pub format: &'static str,
    /// The verdict.
    pub verdict: Verdict,
    /// Effects named, in the order in which they were added.
    pub added: Vec<String>,
    /// Terms of the fitted model the numbers below belong to; equals `added` for a named verdict.
    pub model: Vec<String>,
    /// Terms of the model that needed their richer form.
    pub richer: Vec<String>,
    /// Probability of every first addition, of `outside` and of `none`.
    pub candidates: Vec<CandidateReport>,
    /// Probability that an effect is present at all, alone or beside others.
    pub present: BTreeMap<String, f64>,
    /// Smallest set of effects that holds 95 % of the probability.
    pub credible_set: Vec<String>,
    /// Error per step of the model, springs alone first.
    pub steps: Vec<StepReport>,
    /// How the held-out error was obtained.
    pub holdout: &'static str,
    /// The noise level used.
    pub noise: NoiseReport,
    /// Numbers of the fitted model.
    pub parameters: Vec<Estimate>,
    /// Names of parameters that the data do not determine.
    pub not_determined: Vec<String>,
    /// Terms that the file cannot test.
    pub untestable: Vec<UntestableReport>,
    /// Smallest sizes this campaign would show.
    pub detectable: Vec<Detectable>,
    /// Readings that would separate the rivals.
    pub next: Vec<NextReport>,
    /// What an effect does to the leg stiffnesses when it is left out.
    pub absorbed: Vec<AbsorbedReport>,
    /// Readings far from every prediction.
    pub suspects: Vec<Suspect>,
    /// The unexplained pattern.
    pub outside: Option<OutsideReport>,
    /// Things to know before trusting the numbers.
    pub warnings: Vec<String>,
}

/// One candidate.
#[derive(Debug, Clone, Serialize)]
pub struct CandidateReport {
    /// Id of the term, `outside` or `none`.
    pub term: String,
    /// Probability as the first addition.
    pub probability: f64,
    /// Terms whose signature is the same in these data.
    pub indistinguishable: Vec<String>,
}

/// One step of the model.
#[derive(Debug, Clone, Serialize)]
pub struct StepReport {
    /// Terms beside the springs.
    pub terms: Vec<String>,
    /// Error on the readings fitted.
    #[serde(flatten)]
    pub fitted: ErrorSummary,
    /// Error on held-out poses.
    pub holdout: Option<ErrorSummary>,
}

/// Noise of one reading.
#[derive(Debug, Clone, Serialize)]
pub struct NoiseReport {
    /// Of a translation, um.
    pub translation_um: f64,
    /// Of a rotation, urad.
    pub rotation_urad: f64,
    /// Where it comes from.
    pub source: &'static str,
}

/// A term that cannot be tested.
#[derive(Debug, Clone, Serialize)]
pub struct UntestableReport {
    /// Its id.
    pub term: String,
    /// The reason.
    pub why: String,
}

/// A proposed reading.
#[derive(Debug, Clone, Serialize)]
pub struct NextReport {
    /// `[a, b, c]` in mm, `[alpha, beta, gamma]` in deg.
    pub pose: [f64; 6],
    /// `[fx, fy, fz]` in N, `[mx, my, mz]` in N m.
    pub wrench: [f64; 6],
    /// Reference wrench, same units.
    pub reference: [f64; 6],
    /// +1 or -1.
    pub approach: f64,
    /// Wait before the loaded reading, s.
    pub elapsed_s: f64,
    /// The rivals it separates.
    pub separates: [String; 2],
    /// Expected logarithm of the Bayes factor, nats.
    pub gain: f64,
    /// Why, in words.
    pub text: String,
}

/// Bias of the leg stiffnesses without a term.
#[derive(Debug, Clone, Serialize)]
pub struct AbsorbedReport {
    /// The term.
    pub term: String,
    /// Stiffness without it over stiffness with it, minus one, percent; absent where not determined.
    pub bias_of_leg_stiffness_percent: [Option<f64>; 6],
}

/// A suspicious reading.
#[derive(Debug, Clone, Serialize)]
pub struct Suspect {
    /// Line of the file.
    pub row: u64,
    /// Largest whitened residual.
    pub z: f64,
}

/// An unexplained pattern.
#[derive(Debug, Clone, Serialize)]
pub struct OutsideReport {
    /// Leg from 1; absent when all legs follow it.
    pub leg: Option<usize>,
    /// What it follows.
    pub variable: Option<&'static str>,
    /// `linear`, `quadratic`, `step`, `periodic`.
    pub pattern: Option<&'static str>,
    /// Period in mm.
    pub period: Option<f64>,
    /// A sentence.
    pub text: String,
}

/// Everything behind a diagnosis, for plots and reports.
pub struct Study {
    /// What people read.
    pub diagnosis: Diagnosis,
    /// The search behind it.
    pub outcome: Outcome,
    /// The campaign.
    pub campaign: Campaign,
    /// Fits of the steps.
    pub fits: Vec<Fit>,
}

/// Diagnose a dataset; held-out poses come from `holdout`, else poses are left out in turn.
///
/// # Errors
/// As [`fit`]; [`ModelError::Mismatch`] when the holdout is of another kind.
pub fn diagnose(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    terms: &[Arc<dyn Term>],
) -> Result<Study, ModelError> {
    if let Some(h) = holdout.filter(|h| h.is_absolute() != data.is_absolute()) {
        let what =
            format!("{} and {} are of different kinds (deflections, absolute poses)", data.source, h.source);
        return Err(ModelError::Mismatch(what));
    }
    let campaign = prepare(hexapod, data)?;
    let outcome = explain(&campaign, terms)?;
    let mut judgement = judge(&outcome.sets, &outcome.candidates);
    let context = Context { hexapod, data, holdout, campaign: &campaign, outcome: &outcome };
    let best = outcome.sets.sets.first();
    let order = best.map(|s| addition_order(s, &outcome)).unwrap_or_default();
    let (fits, steps) = context.steps(&order)?;
    demote_what_does_not_survive(&mut judgement, &steps);
    let last = fits.last().unwrap_or(&outcome.baseline);
    context.face_holdout(&mut judgement, last);
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
    let numbers = estimates(last);
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
        holdout: if holdout.is_some() { "holdout file" } else { "poses left out in turn" },
        noise: NoiseReport {
            translation_um: campaign.noise.translation * 1e6,
            rotation_urad: campaign.noise.rotation * 1e6,
            source: campaign.noise.source.word(),
        },
        parameters: numbers.determined,
        not_determined: numbers.not_determined,
        untestable: untestable(&outcome),
        detectable: detectable(
            &outcome.gram,
            &outcome.candidates,
            &best.map(|s| s.variants.clone()).unwrap_or_default(),
        ),
        next: context.next(&judgement),
        absorbed: context.absorbed(&order, &judgement),
        suspects: suspects(&rows, data),
        outside: outside(&judgement, &outcome),
        warnings: warnings(&campaign, data, last, &judgement),
    };
    Ok(Study { diagnosis, outcome, campaign, fits })
}

/// Campaign with its noise level: stated, from repeats, or, failing both, from the residuals of the springs.
///
/// # Errors
/// As [`fit`].
pub fn prepare(hexapod: &Hexapod, data: &Dataset) -> Result<Campaign, ModelError> {
    let campaign = Campaign::new(hexapod, data)?;
    if campaign.noise.source != NoiseSource::Residuals {
        return Ok(campaign);
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
    };
    Campaign::with_noise(hexapod, data, noise)
}

/// Terms of a set, the one that explains most alone first.
fn addition_order(set: &Set, outcome: &Outcome) -> Vec<Wanted> {
    let all = wanted(set, &outcome.gram, &outcome.candidates, &outcome.natural);
    let alone = |id: &str| {
        let single = |s: &&Set| s.members.len() == 1 && outcome.candidates[s.members[0]].id() == Some(id);
        outcome.sets.sets.iter().find(single).map_or(f64::NEG_INFINITY, |s| s.log_weight)
    };
    let mut order = all;
    order.sort_by(|a, b| alone(b.term.info().id).total_cmp(&alone(a.term.info().id)));
    order
}

/// An effect whose addition does not lower the held-out error is not named.
fn demote_what_does_not_survive(judgement: &mut Judgement, steps: &[StepReport]) {
    for pair in steps.windows(2) {
        let (Some(before), Some(after)) = (pair[0].holdout, pair[1].holdout) else { continue };
        let Some(newest) = pair[1].terms.last() else { continue };
        if after.chi2_reduced >= before.chi2_reduced && judgement.sure.contains(newest) {
            judgement.sure.retain(|id| id != newest);
            if judgement.verdict == Verdict::Named {
                judgement.verdict = Verdict::Ambiguous;
            }
        }
    }
}

struct Context<'a> {
    hexapod: &'a Hexapod,
    data: &'a Dataset,
    holdout: Option<&'a Dataset>,
    campaign: &'a Campaign,
    outcome: &'a Outcome,
}

impl Context<'_> {
    /// Fit and errors of every prefix of the additions.
    fn steps(&self, order: &[Wanted]) -> Result<(Vec<Fit>, Vec<StepReport>), ModelError> {
        let (mut fits, mut steps) = (Vec::new(), Vec::new());
        for n in 0..=order.len() {
            let fitted = if n == 0 {
                self.outcome.baseline.clone()
            } else {
                let mut fitted = fit(self.campaign, &order[..n], Some(&self.outcome.best.point))?;
                average_over_shapes(self.campaign, &order[..n], &mut fitted)?;
                fitted
            };
            let rows = residuals(
                self.campaign,
                &self.data.observations,
                &Linearization::at(self.campaign, &fitted.point)?,
            );
            steps.push(StepReport {
                terms: order[..n].iter().map(|w| w.term.info().id.to_owned()).collect(),
                fitted: summarise(&rows, Some(fitted.dof)),
                holdout: self.held_out(&order[..n], &fitted).map(|r| summarise(&r, None)),
            });
            fits.push(fitted);
        }
        Ok((fits, steps))
    }

    /// A sure answer whose predictions fail on the holdout file is not sure: everything that does survive there becomes
    /// credible.
    fn face_holdout(&self, judgement: &mut Judgement, last: &Fit) {
        let Some(holdout) = self.holdout.filter(|_| judgement.verdict != Verdict::Outside) else { return };
        let noise = self.campaign.noise;
        if !noise.allows_verdict() {
            return;
        }
        let survives =
            |fit: &Fit, chance: f64| survival(self.hexapod, holdout, noise, fit).is_ok_and(|p| p > chance);
        if survives(last, REFUTED_CHANCE) {
            return;
        }
        judgement.verdict = Verdict::Ambiguous;
        judgement.refuted = true;
        let start = &self.outcome.baseline.point;
        for set in self.outcome.sets.sets.iter().take(SETS_FACED) {
            let terms = wanted(set, &self.outcome.gram, &self.outcome.candidates, &self.outcome.natural);
            if fit(self.campaign, &terms, Some(start)).is_ok_and(|f| survives(&f, SURVIVAL_CHANCE)) {
                for id in terms.iter().map(|w| w.term.info().id) {
                    if !judgement.credible.iter().any(|c| c == id) {
                        judgement.credible.push(id.to_owned());
                    }
                }
            }
        }
    }

    fn held_out(&self, terms: &[Wanted], fitted: &Fit) -> Option<Vec<Residual>> {
        let noise = self.campaign.noise;
        match self.holdout {
            Some(holdout) => prediction_errors(self.hexapod, holdout, noise, &fitted.point).ok(),
            None => leave_poses_out(self.hexapod, self.data, noise, terms, &fitted.point).ok(),
        }
    }

    /// Readings that separate the two most probable explanations, when none is sure.
    fn next(&self, judgement: &Judgement) -> Vec<NextReport> {
        if judgement.verdict != Verdict::Ambiguous {
            return Vec::new();
        }
        let Some((a, b)) = self.rivals() else { return Vec::new() };
        let fitted = |s: &Set| {
            let terms = wanted(s, &self.outcome.gram, &self.outcome.candidates, &self.outcome.natural);
            fit(self.campaign, &terms, Some(&self.outcome.best.point))
        };
        let (Ok(fit_a), Ok(fit_b)) = (fitted(a), fitted(b)) else { return Vec::new() };
        let names = [self.name(a, b), self.name(b, a)];
        let proposals = separate(self.campaign, &fit_a, &fit_b).unwrap_or_default();
        proposals.iter().map(|p| next_report(p, &names, self.breaker(a, b))).collect()
    }

    /// The best set and the best set that is not merely the same plus something more.
    fn rivals(&self) -> Option<(&Set, &Set)> {
        let sets = &self.outcome.sets.sets;
        let best = sets.first()?;
        let contains = |big: &Set, small: &Set| small.members.iter().all(|m| big.members.contains(m));
        let rival = sets.iter().skip(1).find(|s| !contains(s, best) && !contains(best, s));
        Some((best, rival.or_else(|| sets.get(1))?))
    }

    /// What a set has that the other has not.
    fn name(&self, set: &Set, other: &Set) -> String {
        let own = set.members.iter().filter(|m| !other.members.contains(m));
        let names: Vec<&str> = own.map(|&m| self.outcome.candidates[m].id().unwrap_or(OUTSIDE)).collect();
        if names.is_empty() { NONE.to_owned() } else { names.join(" + ") }
    }

    fn breaker(&self, a: &Set, b: &Set) -> String {
        let own = a.members.iter().filter(|m| !b.members.contains(m));
        let terms = own.filter_map(|&m| match &self.outcome.candidates[m].kind {
            Kind::Term(t) => Some(t.info().breaker),
            Kind::Pattern(_) => None,
        });
        terms.collect::<Vec<_>>().join("; ")
    }

    /// Bias of the stiffnesses without each added term, and without the strongest other candidates.
    fn absorbed(&self, order: &[Wanted], judgement: &Judgement) -> Vec<AbsorbedReport> {
        let mut all = Vec::new();
        let with = &self.outcome.best;
        for (k, w) in order.iter().enumerate() {
            let mut others = order.to_vec();
            others.remove(k);
            if let Ok(without) = fit(self.campaign, &others, Some(&with.point)) {
                all.push(absorbed(w.term.info().id, &without, with));
            }
        }
        let known: Vec<String> = all.iter().map(|a| a.term.clone()).collect();
        let rest = judgement.first.iter().filter(|(id, p)| *p > 0.01 && !known.contains(id));
        for (id, _) in rest.take(CANDIDATES_FITTED) {
            let single =
                |s: &&Set| s.members.len() == 1 && self.outcome.candidates[s.members[0]].id() == Some(id);
            let Some(set) = self.outcome.sets.sets.iter().find(single) else { continue };
            let terms = wanted(set, &self.outcome.gram, &self.outcome.candidates, &self.outcome.natural);
            if let Ok(with) = fit(self.campaign, &terms, Some(&self.outcome.baseline.point)) {
                all.push(absorbed(id, &self.outcome.baseline, &with));
            }
        }
        all
    }
}

fn absorbed(id: &str, without: &Fit, with: &Fit) -> AbsorbedReport {
    let bias = |leg: usize| {
        let determined = with.is_determined(leg) && without.is_determined(leg);
        let ratio = with.point.springs[leg] / without.point.springs[leg];
        (determined && ratio.is_finite()).then_some(100.0 * (ratio - 1.0))
    };
    AbsorbedReport { term: id.to_owned(), bias_of_leg_stiffness_percent: std::array::from_fn(bias) }
}

fn next_report(p: &crate::next::Proposal, separates: &[String; 2], breaker: String) -> NextReport {
    let o = &p.observation;
    let pose = o.pose.to_array();
    NextReport {
        pose: std::array::from_fn(|k| if k < 3 { pose[k] * 1e3 } else { pose[k].to_degrees() }),
        wrench: o.wrench.to_array(),
        reference: o.reference.to_array(),
        approach: o.approach,
        elapsed_s: o.elapsed,
        separates: separates.clone(),
        gain: p.gain,
        text: breaker,
    }
}

fn candidates(judgement: &Judgement, outcome: &Outcome) -> Vec<CandidateReport> {
    let report = |(term, probability): &(String, f64)| CandidateReport {
        term: term.clone(),
        probability: *probability,
        indistinguishable: look_alikes(term, outcome),
    };
    judgement.first.iter().map(report).collect()
}

/// Terms that imitate the signature a term has in these data, beside the rest of the best set.
fn look_alikes(term: &str, outcome: &Outcome) -> Vec<String> {
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

fn untestable(outcome: &Outcome) -> Vec<UntestableReport> {
    let report =
        |u: &crate::candidates::Untestable| UntestableReport { term: u.term.to_owned(), why: u.why.clone() };
    outcome.untestable.iter().map(report).collect()
}

/// Readings whose chi-square over six coordinates is beyond chance for a file of this size.
fn suspects(rows: &[Residual], data: &Dataset) -> Vec<Suspect> {
    let Ok(chi2) = ChiSquared::new(6.0) else { return Vec::new() };
    let limit = chi2.inverse_cdf(1.0 - SUSPECT_CHANCE / rows.len().max(1) as f64);
    let scale = typical_square(rows).max(1.0);
    let far = rows.iter().filter(|r| r.whitened.norm_squared() > limit * scale);
    far.map(|r| Suspect { row: data.observations[r.row].line, z: r.whitened.amax() }).collect()
}

/// Median of the squared length of whitened residuals over what noise alone would give, so that a bad model does not
/// make every reading suspect.
fn typical_square(rows: &[Residual]) -> f64 {
    const MEDIAN_OF_SIX: f64 = 5.348;
    let mut squares: Vec<f64> = rows.iter().map(|r| r.whitened.norm_squared()).collect();
    squares.sort_by(f64::total_cmp);
    squares.get(squares.len() / 2).copied().unwrap_or(0.0) / MEDIAN_OF_SIX
}

fn outside(judgement: &Judgement, outcome: &Outcome) -> Option<OutsideReport> {
    if judgement.verdict != Verdict::Outside {
        return None;
    }
    let best = outcome.sets.sets.first()?;
    let patterns = best.members.iter().filter_map(|&m| match &outcome.candidates[m].kind {
        Kind::Pattern(p) => Some(p),
        Kind::Term(_) => None,
    });
    let strongest = patterns.min_by_key(|p| (p.width(), p.leg));
    Some(strongest.map_or_else(unknown_pattern, |p| OutsideReport {
        leg: p.leg.map(|l| l + 1),
        variable: Some(p.variable.name()),
        pattern: Some(p.course.word()),
        period: if let Course::Periodic(period) = p.course { Some(period * 1e3) } else { None },
        text: p.text(),
    }))
}

fn unknown_pattern() -> OutsideReport {
    let text = "the residuals are larger than the noise, and follow neither a term of the catalogue nor a simple pattern";
    OutsideReport { leg: None, variable: None, pattern: None, period: None, text: text.to_owned() }
}

fn warnings(campaign: &Campaign, data: &Dataset, fit: &Fit, judgement: &Judgement) -> Vec<String> {
    let mut all = Vec::new();
    if judgement.refuted {
        all.push(
            "the best explanation of the fitted data does not predict the held-out poses to within noise and uncertainty: \
             the credible set also lists what does"
                .to_owned(),
        );
    }
    if !fit.settled {
        all.push("the fit did not settle; treat its numbers as provisional".to_owned());
    }
    if !campaign.noise.allows_verdict() {
        all.push(
            "no noise level is stated and there are too few repeats: it was taken from the residuals, so nothing can be \
             said about whether the model is adequate; state [metrology] in the hexapod file"
                .to_owned(),
        );
    }
    all.extend(contradiction(campaign, data));
    all
}

/// Repeats that scatter more or less than the stated noise.
fn contradiction(campaign: &Campaign, data: &Dataset) -> Option<String> {
    if campaign.noise.source != NoiseSource::Metrology {
        return None;
    }
    let s = scatter(&data.observations);
    let chi2 = ChiSquared::new(s.dof).ok()?;
    let check = |variance: f64, stated: f64, what: &str, unit: &str| {
        let p = chi2.cdf(s.dof * variance / (stated * stated));
        let off = !(CONTRADICTION_CHANCE..=1.0 - CONTRADICTION_CHANCE).contains(&p);
        off.then(|| {
            format!(
                "repeats scatter by {:.3} {unit} in {what}, but [metrology] states {:.3} {unit}: every probability here \
                 rests on the stated value",
                variance.sqrt() * 1e6,
                stated * 1e6
            )
        })
    };
    check(s.variance_translation, campaign.noise.translation, "translation", "um")
        .or_else(|| check(s.variance_rotation, campaign.noise.rotation, "rotation", "urad"))
}
