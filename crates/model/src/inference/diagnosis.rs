//! Diagnosis: linearize, search, fit, linearize again at the best set, until the best set stays.

use std::collections::BTreeSet;
use std::sync::Arc;

use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::effects::sizes::sizes;
use crate::effects::term::{Natural, Need, Rich, Term, all_versions};
use crate::effects::untestable::{Reason, Untestable, why_untestable};
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Fit, TermSpec, fit, fit_baseline};
use crate::estimation::linearization::{Linearization, ModelPoint};
use crate::inference::alone::best_alone;
use crate::inference::candidates::{Candidate, CandidateKind, Collector, forms_of, with_fitted_shapes};
use crate::inference::discovery::LawTerm;
use crate::inference::evidence::Gram;
use crate::inference::pattern::{Course, LegPattern, Pattern, PatternVariable};
use crate::inference::rivals::Rivals;
use crate::inference::scan::{SCANNED_CONDITIONS, Scanner};
use crate::inference::search::{Set, Sets, TermSearch};

/// Rounds of linearization and search.
const MOST_ROUNDS: usize = 6;
/// The same where the best set stays far off.
const HOPELESS_ROUNDS: usize = 3;
/// Shape grids longer than this are scanned beside the best set instead of searched.
const LONG_GRID: usize = 24;
/// Prior width of a fit relative to the width the evidence prefers.
const FIT_WIDTH: f64 = 3.0;
/// Prior weight of all patterns together, relative to one term of the catalogue.
const WEIGHT_OF_PATTERNS: f64 = 2.0;
/// Axes of loads that no column states: of a mass, of any force.
const UNSTATED_LOADS: [&[usize]; 2] = [&[2], &[0, 1, 2]];
/// Coordinates along which a frame moves when it grows warm, and the share of each: what moves in height alone looks like legs that
/// lengthen alike, which are more probable.
const WARM_FRAMES: [(&[usize], f64); 2] = [(&[0, 1, 2, 3, 4, 5], 0.8), (&[2], 0.2)];
/// Chance of larger residuals below which patterns outside the catalogue are scanned for.
const DOUBTFUL_CHANCE: f64 = 0.1;
/// Error over the noise that springs alone leave, beyond which they may be far from the machine.
const FAR: f64 = 10.0;
/// Chance of larger residuals below which the best set does not fit.
const MISFIT_CHANCE: f64 = 1e-4;
/// Term parameters up to which no scan is needed for imitation.
const FEW_PARAMETERS: usize = 3;
/// Error over the noise of deflections, of the best set, beyond which no rival is near the truth either: the file is not what it says.
const FAR_OFF: f64 = 30.0;
/// Best sets of the whole search whose members are weighed again on a part of the campaign.
const SETS_SEARCHED_ANEW: usize = 12;
/// Most effects in a set.
const MOST_EFFECTS: usize = 4;

/// Outcome of the search: sets with probabilities, and the fit of the best one.
#[derive(Clone)]
pub struct RankedSets {
    /// Campaign's testable terms and patterns.
    pub candidates: Vec<Candidate>,
    /// Terms that this file cannot test.
    pub untestable: Vec<Untestable>,
    /// All sets looked at.
    pub sets: Sets,
    /// Normal equations of the last round.
    pub gram: Gram,
    /// Fit of the springs alone.
    pub baseline: Fit,
    /// Fit of the terms of the best set.
    pub best: Fit,
    /// Natural sizes.
    pub natural: Natural,
    /// Linearization at the best fit.
    pub lin: Linearization,
    /// Rounds of linearization and search made.
    pub rounds: usize,
}

impl RankedSets {
    /// The terms of a set as a fit wants them.
    pub fn wanted(&self, set: &Set) -> Vec<TermSpec> {
        wanted(set, &self.gram, &self.candidates, &self.natural)
    }
}

/// Search the best explanation of a campaign among `terms` and patterns.
///
/// # Errors
/// As [`fit`].
pub fn explain(campaign: &Campaign, terms: &[Arc<dyn Term>]) -> Result<RankedSets, ModelError> {
    explain_with_laws(campaign, terms, &[])
}

/// The same with laws that no catalogue lists among what competes; patterns without a name then do not.
///
/// # Errors
/// As [`fit`].
pub fn explain_with_laws(
    campaign: &Campaign,
    terms: &[Arc<dyn Term>],
    laws: &[LawTerm],
) -> Result<RankedSets, ModelError> {
    let baseline = fit_baseline(campaign)?;
    let mut best = baseline.clone();
    let mut lin = Linearization::at(campaign, &best.point)?;
    let natural = baseline.natural(&lin);
    let mut effort = Effort { rich: false, scan: false };
    let mut history: Vec<Vec<String>> = Vec::new();
    let mut is_restarted = false;
    loop {
        let (testable, mut untestable) = split(terms, campaign, &lin);
        let competitors = Competitors { terms: &testable, laws };
        let (gram, candidates) = collect(campaign, &best, &lin, competitors, natural, effort);
        let (candidates, faint) = noticeable(candidates, &gram);
        untestable.extend(faint);
        let sets = TermSearch::new(&gram, &candidates, campaign.noise.allows_verdict()).run(MOST_EFFECTS);
        let top = sets.sets.first().cloned();
        let wanted = top.as_ref().map(|s| wanted(s, &gram, &candidates, &natural)).unwrap_or_default();
        let next = fit(campaign, &wanted, Some(&best.point)).or_else(|_| fit(campaign, &wanted, None))?;
        lin = Linearization::at(campaign, &next.point)?;
        best = next;
        let names = top.map(|s| names(&s, &candidates)).unwrap_or_default();
        let scan = effort.scan || !campaign.noise.allows_verdict() || is_doubtful(&best);
        let settled = history.last() == Some(&names) && scan == effort.scan;
        history.push(names);
        let is_hopeless = !campaign.is_absolute() && is_far_off(&best);
        let is_over = settled || history.len() >= if is_hopeless { HOPELESS_ROUNDS } else { MOST_ROUNDS };
        if is_over && !is_restarted {
            is_restarted = true;
            if let Some(alone) = better_start(campaign, &testable, &natural, [&baseline, &best]) {
                lin = Linearization::at(campaign, &alone.point)?;
                best = alone;
                history.clear();
                continue;
            }
        }
        if is_over {
            let rounds = history.len();
            let rivals = Rivals {
                campaign,
                gram: &gram,
                candidates: &candidates,
                natural: &natural,
                best: &best,
                all: does_not_fit(&best),
            };
            let (sets, better) = if is_hopeless { (sets, None) } else { rivals.weighed(sets) };
            if let Some(better) = better {
                lin = Linearization::at(campaign, &better.point)?;
                best = better;
            }
            return Ok(RankedSets {
                candidates,
                untestable,
                sets,
                gram,
                baseline,
                best,
                natural,
                lin,
                rounds,
            });
        }
        effort = Effort { rich: true, scan };
    }
}

/// A campaign explained by its springs and nothing else, where a search for effects would be beside the point.
///
/// # Errors
/// As [`fit`].
pub fn springs_alone(campaign: &Campaign) -> Result<RankedSets, ModelError> {
    let baseline = fit_baseline(campaign)?;
    let lin = Linearization::at(campaign, &baseline.point)?;
    let natural = baseline.natural(&lin);
    let (gram, candidates) = Collector::new(&lin, natural).finish(campaign, &baseline.point);
    let sets = TermSearch::new(&gram, &candidates, false).run(0);
    let best = baseline.clone();
    Ok(RankedSets { candidates, untestable: Vec::new(), sets, gram, baseline, best, natural, lin, rounds: 0 })
}

/// What a campaign could show beside its springs: every effect in its ideal form, and those the file cannot test.
///
/// # Errors
/// As [`Linearization::at`].
pub fn visible(
    campaign: &Campaign,
    springs: &Fit,
    terms: &[Arc<dyn Term>],
) -> Result<(Gram, Vec<Candidate>, Vec<Untestable>), ModelError> {
    let lin = Linearization::at(campaign, &springs.point)?;
    let (testable, mut untestable) = split(terms, campaign, &lin);
    let effort = Effort { rich: false, scan: false };
    let competitors = Competitors { terms: &testable, laws: &[] };
    let (gram, candidates) = collect(campaign, springs, &lin, competitors, springs.natural(&lin), effort);
    let (candidates, faint) = noticeable(candidates, &gram);
    untestable.extend(faint);
    Ok((gram, candidates, untestable))
}

/// What a round looks at beyond the ideal forms.
#[derive(Clone, Copy)]
struct Effort {
    /// Richer forms of the terms of the best set.
    rich: bool,
    /// Waves, courses and steps outside the catalogue.
    scan: bool,
}

/// Where to search again, when springs alone led far from the machine: the one effect that explains more than what was found from there.
fn better_start(
    campaign: &Campaign,
    terms: &[Arc<dyn Term>],
    natural: &Natural,
    [baseline, best]: [&Fit; 2],
) -> Option<Fit> {
    let level = baseline.lack_of_fit / baseline.lack_of_fit_dof.max(1.0);
    let may_be_astray = campaign.noise.allows_verdict() && level > FAR.powi(2) && does_not_fit(best);
    let alone = may_be_astray.then(|| best_alone(campaign, terms, natural)).flatten()?;
    (alone.lack_of_fit < best.lack_of_fit).then_some(alone)
}

/// True when something may be left unexplained: the residuals exceed the noise, or many parameters may imitate a
/// simple pattern. A noise level taken from the residuals cannot tell.
fn is_doubtful(fit: &Fit) -> bool {
    let parameters: usize = fit.point.active.iter().map(|a| a.values.len()).sum();
    let Ok(law) = ChiSquared::new(fit.lack_of_fit_dof.max(1.0)) else { return true };
    parameters > FEW_PARAMETERS || law.sf(fit.lack_of_fit) < DOUBTFUL_CHANCE
}

/// True when no explanation is near the truth: the file is not what it says.
pub(crate) fn is_far_off(best: &Fit) -> bool {
    best.lack_of_fit > FAR_OFF.powi(2) * best.lack_of_fit_dof.max(1.0)
}

/// True when the residuals exceed a noise that is known: the best set is not good enough.
pub(crate) fn does_not_fit(fit: &Fit) -> bool {
    let Ok(law) = ChiSquared::new(fit.lack_of_fit_dof.max(1.0)) else { return false };
    law.sf(fit.lack_of_fit) < MISFIT_CHANCE
}

/// Leave out terms of which no physically sensible size would show.
fn noticeable(candidates: Vec<Candidate>, gram: &Gram) -> (Vec<Candidate>, Vec<Untestable>) {
    let (kept, faint): (Vec<_>, Vec<_>) =
        candidates.into_iter().partition(|c| c.blocks.iter().any(|&b| gram.blocks[b].noticeable));
    let faint = faint.iter().filter_map(Candidate::id).map(|term| Untestable { term, why: Reason::TooFaint });
    (kept, faint.collect())
}

fn names(set: &Set, candidates: &[Candidate]) -> Vec<String> {
    set.members.iter().map(|&m| label(&candidates[m])).collect()
}

/// Id of a term or description of a pattern.
pub fn label(candidate: &Candidate) -> String {
    match &candidate.kind {
        CandidateKind::Term(t) => t.info().id.to_owned(),
        CandidateKind::Pattern(p) => p.text(),
    }
}

fn split(
    terms: &[Arc<dyn Term>],
    campaign: &Campaign,
    lin: &Linearization,
) -> (Vec<Arc<dyn Term>>, Vec<Untestable>) {
    let (mut testable, mut untestable) = (Vec::new(), Vec::new());
    for term in terms {
        match why_untestable(term.as_ref(), campaign, lin) {
            None => testable.push(Arc::clone(term)),
            Some(why) => untestable.push(Untestable::new(term.as_ref(), why)),
        }
    }
    (testable, untestable)
}

/// What competes.
#[derive(Clone, Copy)]
struct Competitors<'a> {
    terms: &'a [Arc<dyn Term>],
    laws: &'a [LawTerm],
}

fn collect(
    campaign: &Campaign,
    fit: &Fit,
    lin: &Linearization,
    competitors: Competitors<'_>,
    natural: Natural,
    effort: Effort,
) -> (Gram, Vec<Candidate>) {
    let (point, mut collector) = (&fit.point, Collector::new(lin, natural));
    // Scans only choose what to weigh; the weighing itself uses every condition.
    let scanned = lin.thinned(SCANNED_CONDITIONS);
    for term in competitors.terms {
        add_term(&mut collector, term, &scanned, fit, rich_shape(term.as_ref(), point, effort));
    }
    for law in competitors.laws {
        add_law(&mut collector, law, &scanned, fit);
    }
    if !competitors.laws.is_empty() {
        return collector.finish(campaign, point);
    }
    for (pattern, log_weight) in patterns(campaign, &scanned, point, effort.scan) {
        collector.add_pattern(pattern, log_weight);
    }
    collector.finish(campaign, point)
}

/// Adds a law: with the period that its scan found, or to which a fit has carried it since, else as any other term.
fn add_law(collector: &mut Collector<'_>, law: &LawTerm, scanned: &Linearization, fit: &Fit) {
    let trials = law.term.shape_grid(&scanned.conditions).len();
    match law.period(&fit.point).filter(|_| trials > LONG_GRID) {
        Some(period) => collector.add_term(&law.term, &[period], trials, None),
        None => add_term(collector, &law.term, scanned, fit, None),
    }
}

/// Adds a term in all its versions and their shapes, of which a long grid leaves the best one; not at all where none is sensible.
fn add_term(
    collector: &mut Collector<'_>,
    term: &Arc<dyn Term>,
    scanned: &Linearization,
    fit: &Fit,
    rich: Option<f64>,
) {
    let tried: Vec<_> = all_versions(term)
        .into_iter()
        .filter_map(|(share, version)| Some((share, shapes(&version, scanned, &fit.point)?, version)))
        .collect();
    let whole: f64 = tried.iter().map(|(share, ..)| share).sum();
    let forms = tried.iter().enumerate().flat_map(|(k, (share, (shapes, trials), version))| {
        forms_of(version, shapes, *trials, rich.filter(|_| k == 0), share / whole)
    });
    let forms: Vec<_> = forms.collect();
    if !forms.is_empty() {
        collector.add_forms(term, with_fitted_shapes(forms, fit));
    }
}

/// Shapes in which a version of a term competes, and out of how many; none where no shape is sensible.
fn shapes(version: &Arc<dyn Term>, scanned: &Linearization, point: &ModelPoint) -> Option<(Vec<f64>, usize)> {
    if version.info().shape.is_none() {
        return Some((vec![1.0], 1));
    }
    let grid = version.shape_grid(&scanned.conditions);
    let trials = grid.len();
    let shapes = if trials > LONG_GRID {
        vec![Scanner::new(scanned, point, Some(version.info().id)).best_shape(version.as_ref(), &grid)]
    } else {
        grid
    };
    (trials > 0).then_some((shapes, trials))
}

/// Terms of the best set of part of a campaign, searched anew among the members of the best sets of the whole of it; `lin`: of the
/// part, where the whole search ended.
pub(crate) fn chosen_anew(part: &Campaign, lin: &Linearization, whole: &RankedSets) -> Vec<TermSpec> {
    let point = &whole.best.point;
    let mut collector = Collector::new(lin, whole.natural);
    let scanned = lin.thinned(SCANNED_CONDITIONS);
    for candidate in whole.best_members(SETS_SEARCHED_ANEW) {
        match &candidate.kind {
            CandidateKind::Term(term) => {
                let blocks = candidate.blocks.iter().map(|&b| &whole.gram.blocks[b]);
                let rich = blocks.clone().find(|b| b.rich).map(|b| b.shape);
                add_term(&mut collector, term, &scanned, &whole.best, rich);
            }
            CandidateKind::Pattern(pattern) => collector.add_pattern(*pattern, candidate.log_weight),
        }
    }
    let (gram, candidates) = collector.finish(part, point);
    let search = TermSearch::new(&gram, &candidates, part.noise.allows_verdict());
    let sets = search.among(&whole.candidates).run(MOST_EFFECTS);
    sets.sets.first().map(|s| wanted(s, &gram, &candidates, &whole.natural)).unwrap_or_default()
}

impl RankedSets {
    /// The best set, and the same without patterns that no effect has, where both were weighed.
    fn with_and_without_patterns(&self) -> Option<(&Set, &Set)> {
        let best = self.sets.sets.first()?;
        let is_effect = |m: &&usize| matches!(self.candidates[**m].kind, CandidateKind::Term(_));
        let effects: Vec<usize> = best.members.iter().filter(is_effect).copied().collect();
        Some((best, self.sets.sets.iter().find(|set| set.members == effects)?))
    }

    /// The pattern of fewest numbers in the best set, of all legs rather than of one.
    pub(crate) fn simplest_pattern(&self) -> Option<&Pattern> {
        let members = &self.sets.sets.first()?.members;
        let patterns = members.iter().filter_map(|&m| match &self.candidates[m].kind {
            CandidateKind::Pattern(pattern) => Some(pattern),
            CandidateKind::Term(_) => None,
        });
        patterns.min_by_key(|p| (p.width(), if let Pattern::Leg(p) = p { p.leg } else { None }))
    }

    /// What patterns that no effect has add to the best effects, in twice the logarithm of the evidence.
    pub(crate) fn gain_of_patterns(&self) -> f64 {
        self.with_and_without_patterns()
            .map_or(0.0, |(best, effects)| 2.0 * (best.log_weight - effects.log_weight))
    }

    /// Drop of chi-square by them.
    pub(crate) fn drop_by_patterns(&self) -> f64 {
        self.with_and_without_patterns().map_or(0.0, |(best, effects)| best.drop - effects.drop)
    }

    /// Candidates that are in one of so many best sets, in their order.
    fn best_members(&self, sets: usize) -> impl Iterator<Item = &Candidate> {
        let best: BTreeSet<usize> =
            self.sets.sets.iter().take(sets).flat_map(|s| s.members.iter().copied()).collect();
        best.into_iter().map(|m| &self.candidates[m])
    }
}

/// Shape at which the richer form of a term competes: that of a term in the model; and bodies that yield in any way, and single brackets
/// that do, always compete while something is left unexplained, since their ideal form may not even enter the model.
fn rich_shape(term: &dyn Term, point: &ModelPoint, effort: Effort) -> Option<f64> {
    let info = term.info();
    // Another version has a shape of its own.
    let active = point.active.iter().find(|a| std::ptr::eq(a.term.info(), info)).map(|a| a.shape);
    let any_part = info.rich == Rich::Full || info.needs.contains(&Need::Brackets);
    active.or((effort.scan && any_part).then_some(1.0)).filter(|_| effort.rich)
}

/// Patterns worth weighing; those found by scanning carry the number of trials in their prior.
fn patterns(
    campaign: &Campaign,
    scanned: &Linearization,
    point: &ModelPoint,
    scan: bool,
) -> Vec<(Pattern, f64)> {
    let unstated = UNSTATED_LOADS.map(|axes| (Pattern::Load(axes), (0.1 * WEIGHT_OF_PATTERNS / 2.0).ln()));
    let mut all = unstated.to_vec();
    if campaign.columns.elapsed {
        let drift = |leg| {
            let (variable, course) = (PatternVariable::Elapsed, Course::Linear);
            Pattern::Leg(LegPattern { leg, variable, course, compliance: false })
        };
        let legs = std::iter::once(None).chain((0..6).map(Some));
        all.extend(legs.map(|leg| (drift(leg), (0.2 * WEIGHT_OF_PATTERNS / 7.0).ln())));
    }
    if scan {
        let weighed = |(p, trials)| (p, (0.1 * WEIGHT_OF_PATTERNS / trials as f64).ln());
        all.extend(Scanner::new(scanned, point, None).patterns(campaign).into_iter().map(weighed));
        all.push((Pattern::Beside, (0.1 * WEIGHT_OF_PATTERNS).ln()));
        let others =
            (1..6).map(|further| (Pattern::OtherLeg(further), (0.05 * WEIGHT_OF_PATTERNS / 5.0).ln()));
        all.extend(others);
        let every =
            |variable, course| (Pattern::EveryLeg(variable, course), (0.05 * WEIGHT_OF_PATTERNS).ln());
        if campaign.columns.approach {
            all.push(every(PatternVariable::Approach, Course::Linear));
        }
        if campaign.columns.delta_t {
            all.push(every(PatternVariable::DeltaT, Course::Quadratic));
            let warm = |(axes, share): (_, f64)| {
                (Pattern::WarmFrame(axes), (0.05 * share * WEIGHT_OF_PATTERNS).ln())
            };
            all.extend(WARM_FRAMES.map(warm));
        }
    }
    all
}

/// The terms of a set as a fit wants them.
pub(crate) fn wanted(set: &Set, gram: &Gram, candidates: &[Candidate], natural: &Natural) -> Vec<TermSpec> {
    let mut all = Vec::new();
    for (&m, v) in set.members.iter().zip(&set.variants) {
        let Some(term) = candidates[m].version(v.block) else { continue };
        let block = &gram.blocks[v.block];
        let width = FIT_WIDTH * block.widths[v.width];
        let prior =
            sizes(term.as_ref(), block.rich, block.shape, natural).iter().map(|s| s * width).collect();
        all.push(TermSpec { term: Arc::clone(term), rich: block.rich, shape: block.shape, prior });
    }
    all
}

#[cfg(test)]
mod tests {
    use hexbench_core::{Hexapod, Measurand, Metrology};

    use super::*;
    use crate::inference::evidence::Variant;
    use crate::terms::catalogue;
    use crate::test_machine::readings;

    fn campaign() -> Campaign {
        let (machine, data) = readings(Measurand::DeflectionRotationVector, Vec::new());
        let metrology = Some(Metrology { sigma_translation: 0.3e-6, sigma_rotation: 2e-6 });
        Campaign::new(&Hexapod { metrology, ..machine }, &data).unwrap()
    }

    #[test]
    fn a_fit_is_doubtful_does_not_fit_and_is_far_off_by_what_it_leaves() {
        let baseline = fit_baseline(&campaign()).unwrap();
        let told = |lack_of_fit: f64| {
            let fit = Fit { lack_of_fit, lack_of_fit_dof: 48.0, ..baseline.clone() };
            [is_doubtful(&fit), does_not_fit(&fit), is_far_off(&fit)]
        };
        // Chi-square with 48 degrees of freedom is above 60.9 in one of ten cases, above 93.2 in one of 10 000.
        for (left, expected) in [
            (59.0, [false, false, false]),
            (62.0, [true, false, false]),
            (92.0, [true, false, false]),
            (95.0, [true, true, false]),
            (48.0 * 899.0, [true, true, false]),
            (48.0 * 901.0, [true, true, true]),
        ] {
            assert_eq!(told(left), expected, "{left}");
        }
    }

    #[test]
    fn patterns_share_the_weight_of_two_terms() {
        let mut campaign = campaign();
        let point = fit_baseline(&campaign).unwrap().point;
        let lin = Linearization::at(&campaign, &point).unwrap();
        let mut weights = |elapsed| -> Vec<f64> {
            campaign.columns.elapsed = elapsed;
            patterns(&campaign, &lin, &point, false).iter().map(|(_, log_weight)| log_weight.exp()).collect()
        };
        let (loads, all) = (weights(false), weights(true));
        assert_eq!((loads.len(), all.len()), (2, 9));
        assert!((loads.iter().sum::<f64>() - 0.2).abs() < 1e-12, "loads that are not stated: {loads:?}");
        assert!((all[2..].iter().sum::<f64>() - 0.4).abs() < 1e-12, "drifts of six legs and of all: {all:?}");
    }

    #[test]
    fn a_fit_has_three_times_the_prior_width_that_the_evidence_prefers() {
        let natural = Natural { compliance: 2e-8, force: 100.0, radius: 0.1, length: 0.5, elapsed: 10.0 };
        let term = catalogue().remove(0);
        let mut set = Set::of_weights(&[0], 0.0, 0.0);
        set.variants.push(Variant { block: 0, width: 0 });
        let gram = Gram::unseen(1);
        let asked = wanted(&set, &gram, &[Candidate::of_block(&term, 0)], &natural);
        let size = sizes(term.as_ref(), false, 1.0, &natural)[0];
        assert!((asked[0].prior[0] / (3.0 * gram.blocks[0].widths[0] * size) - 1.0).abs() < 1e-12);
    }
}
