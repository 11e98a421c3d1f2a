//! Fitting terms a user asks for by name, and refusing what the data do not determine.

use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

use hexbench_core::Vector6;
use hexbench_core::files::nearest;
use hexbench_core::words::{joined, to_digits};

use crate::effects::sizes::{WIDEST, sizes};
use crate::effects::term::{Natural, Rich, Term, all_versions, version_named};
use crate::effects::untestable::why_untestable;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::estimate::{LegCompliances, estimates};
use crate::estimation::fit::{Fit, TermSpec, fit, fit_baseline};
use crate::estimation::linearization::{Active, Linearization};
use crate::estimation::parameters::leg_of_stiffness;
use crate::estimation::starts::{Left, ManyReadings, PromisingShape, Starts, Unexplained, some_of};
use crate::estimation::unobservable::unobservable;

/// Prior width of an asked-for parameter relative to its widest sensible size: it only speaks where the data are silent.
const PRIOR_WIDTH: f64 = 3.0;
/// Shape of a term before a scan has chosen its starts.
const FIRST_SHAPE: f64 = 1.0;
/// How much more a version may explain when it is fitted than at the best place of its grid of shapes.
const BETWEEN_PLACES: f64 = 2.0;
/// Conditions up to which the campaign at the springs alone is kept: tens of megabytes.
const MOST_CONDITIONS_KEPT: usize = 10_000;
/// Correlation beyond which two parameters are named as look-alikes.
const LOOK_ALIKE: f64 = 0.9;

/// The term with an id.
///
/// # Errors
/// [`ModelError::UnknownTerm`] with the nearest id.
pub fn term_named(id: &str, terms: &[Arc<dyn Term>]) -> Result<Arc<dyn Term>, ModelError> {
    let found = terms.iter().find(|t| t.info().id == id).map(Arc::clone);
    found.ok_or_else(|| {
        let near = nearest(id, terms.iter().map(|t| t.info().id));
        ModelError::UnknownTerm { id: id.to_owned(), nearest: near.map(str::to_owned) }
    })
}

/// Behind the id of a term: its richer form is wanted.
const RICHER: &str = ":richer";
/// Behind the id of a term: its usual version is wanted, whatever the readings would choose.
const IDEAL: &str = ":ideal";

/// How this form of a term is asked for.
pub fn asked_as(id: &str, richer: bool) -> String {
    if richer { format!("{id}{RICHER}") } else { id.to_owned() }
}

/// The id of a term by how it is asked for, and whether its richer form is.
pub fn form_asked(text: &str) -> (&str, bool) {
    text.strip_suffix(RICHER).map_or((text, false), |id| (id, true))
}

/// Effects in the words of a sentence, from how they are asked for.
pub fn effects(asked: &[String]) -> String {
    let said = |(id, richer): (&str, bool)| format!("{id}{}", if richer { " (richer form)" } else { "" });
    joined(&asked.iter().map(|one| said(form_asked(one))).collect::<Vec<_>>())
}

/// A term somebody asks for, in its ideal or its richer form, or in a version that the readings do not choose.
#[derive(Clone)]
pub struct Added {
    /// The effect; one of its versions where that was asked for by its word.
    pub term: Arc<dyn Term>,
    /// True for the richer form.
    pub richer: bool,
    /// True when the readings choose among its versions.
    is_open: bool,
}

impl Added {
    /// What `id`, `id:richer`, `id:version` or, for the usual version, `id:ideal` asks for.
    ///
    /// # Errors
    /// [`ModelError::UnknownTerm`] with the nearest id; [`ModelError::Selection`] for a term without a richer form.
    pub fn named(text: &str, terms: &[Arc<dyn Term>]) -> Result<Self, ModelError> {
        let (id, richer) = form_asked(text);
        if let Some(term) = id
            .split_once(':')
            .and_then(|(id, word)| version_named(terms.iter().find(|t| t.info().id == id)?, word))
        {
            return Ok(Self { term, richer, is_open: false });
        }
        if let Some(id) = id.strip_suffix(IDEAL).filter(|_| !richer) {
            return Ok(Self::ideal(term_named(id, terms)?));
        }
        let term = term_named(id, terms)?;
        if richer && term.info().rich == Rich::None {
            return Err(ModelError::Selection(format!("`{id}` has no richer form")));
        }
        Ok(Self { term, richer, is_open: !richer })
    }

    /// This version of a term, whatever the readings would choose.
    pub fn ideal(term: Arc<dyn Term>) -> Self {
        Self { term, richer: false, is_open: false }
    }

    /// Versions among which the readings choose, with their prior shares.
    fn versions(&self) -> Vec<(f64, Arc<dyn Term>)> {
        if self.is_open { all_versions(&self.term) } else { vec![(1.0, Arc::clone(&self.term))] }
    }

    /// As it is asked for.
    pub fn name(&self) -> String {
        let id = self.term.info().id;
        match self.term.version() {
            _ if self.richer => asked_as(id, true),
            Some(word) => format!("{id}:{word}"),
            None if !self.is_open && !self.term.versions().is_empty() => format!("{id}{IDEAL}"),
            None => id.to_owned(),
        }
    }
}

impl From<Arc<dyn Term>> for Added {
    fn from(term: Arc<dyn Term>) -> Self {
        Self { is_open: term.version().is_none(), term, richer: false }
    }
}

/// Fit springs (and frames) with these terms in these versions, added one after the other.
///
/// # Errors
/// As [`fit`]; [`ModelError::Untestable`] for a term whose columns are missing; [`ModelError::Selection`] for a term asked
/// for twice.
pub fn fit_named(campaign: &Campaign, added: &[Arc<dyn Term>]) -> Result<Fit, ModelError> {
    let ideal: Vec<Added> = added.iter().cloned().map(Added::ideal).collect();
    Ok(fit_wanted(campaign, &ideal)?.1)
}

/// The same of terms whose versions may be open, and what was fitted, to ask again of other readings.
///
/// # Errors
/// As [`fit_named`].
pub fn fit_wanted(campaign: &Campaign, added: &[Added]) -> Result<(Vec<TermSpec>, Fit), ModelError> {
    refuse_twice(added)?;
    fit_wanted_from(campaign, added, &SpringsAlone::fitted(campaign)?)
}

/// Springs (and frames) alone, fitted to a campaign: where fits with terms start.
#[derive(Debug)]
pub struct SpringsAlone {
    fit: Fit,
    /// The campaign there, and what is left of it, once a term was asked for; not kept of many conditions, of which each takes kilobytes.
    lin: OnceLock<Linearization>,
    left: OnceLock<Left>,
    /// Some of the readings, by which starts are tried.
    some: OnceLock<Option<Campaign>>,
}

impl SpringsAlone {
    /// Fits them.
    ///
    /// # Errors
    /// As [`fit`].
    pub fn fitted(campaign: &Campaign) -> Result<Self, ModelError> {
        let fit = fit_baseline(campaign)?;
        Ok(Self { fit, lin: OnceLock::new(), left: OnceLock::new(), some: OnceLock::new() })
    }

    /// The campaign that they were fitted to, linearized there.
    fn linearized(&self, campaign: &Campaign) -> Result<Cow<'_, Linearization>, ModelError> {
        if let Some(known) = self.lin.get() {
            return Ok(Cow::Borrowed(known));
        }
        let lin = Linearization::at(campaign, &self.fit.point)?;
        let is_kept = campaign.groups.len() <= MOST_CONDITIONS_KEPT;
        Ok(if is_kept { Cow::Borrowed(self.lin.get_or_init(|| lin)) } else { Cow::Owned(lin) })
    }

    /// That campaign, and some of its readings where they are many.
    fn readings<'a>(&'a self, campaign: &'a Campaign) -> ManyReadings<'a> {
        let some = self.some.get().unwrap_or_else(|| {
            let found = some_of(campaign);
            self.some.get_or_init(|| found)
        });
        ManyReadings { all: campaign, some: some.as_ref() }
    }
}

/// The same where springs (and frames) alone have been fitted to the campaign already.
///
/// # Errors
/// As [`fit_named`].
pub fn fit_wanted_from(
    campaign: &Campaign,
    added: &[Added],
    springs: &SpringsAlone,
) -> Result<(Vec<TermSpec>, Fit), ModelError> {
    refuse_twice(added)?;
    let chosen = one_by_one(campaign, added, springs)?;
    let is_usual =
        chosen.0.iter().zip(added).all(|(spec, one)| !one.is_open || spec.term.version().is_none());
    if added.len() < 2 || is_usual {
        return Ok(chosen);
    }
    // A version chosen while an effect was still missing may have stood for that effect, and lead to another optimum.
    let in_usual = |one: &Added| Added { is_open: false, ..one.clone() };
    let usual = added.iter().map(in_usual).collect::<Vec<_>>();
    let Ok(usual) = one_by_one(campaign, &usual, springs) else { return Ok(chosen) };
    Ok(if cost(campaign, added, &usual) < cost(campaign, added, &chosen) { usual } else { chosen })
}

/// What a fit leaves, and the price of its versions.
fn cost(campaign: &Campaign, added: &[Added], (wanted, fitted): &(Vec<TermSpec>, Fit)) -> f64 {
    let of = |(one, spec): (&Added, &TermSpec)| {
        let same = |(_, version): &(f64, Arc<dyn Term>)| version.version() == spec.term.version();
        let share = one.versions().into_iter().find(same).map_or(1.0, |(share, _)| share);
        price(campaign, share, spec.term.as_ref())
    };
    fitted.chi2 + added.iter().zip(wanted).map(of).sum::<f64>()
}

/// What a version has to explain to be worth its values and its shape (Schwarz) and its prior share of the effect, as a drop of
/// chi-square.
fn price(campaign: &Campaign, share: f64, version: &dyn Term) -> f64 {
    let numbers = version.info().parameters.len() + usize::from(version.info().shape.is_some());
    numbers as f64 * (campaign.numbers as f64).ln() - 2.0 * share.ln()
}

/// Terms added to the springs one after the other, those that are open in the version that the readings ask for at that point.
fn one_by_one(
    campaign: &Campaign,
    added: &[Added],
    springs: &SpringsAlone,
) -> Result<(Vec<TermSpec>, Fit), ModelError> {
    let mut fitted = springs.fit.clone();
    if added.is_empty() {
        return Ok((Vec::new(), fitted));
    }
    let mut lin = springs.linearized(campaign)?;
    let (natural, readings) = (fitted.natural(&lin), springs.readings(campaign));
    let mut wanted: Vec<TermSpec> = Vec::new();
    for one @ Added { term, richer, .. } in added {
        if !wanted.is_empty() {
            lin = Cow::Owned(Linearization::at(campaign, &fitted.point)?);
        }
        if let Some(why) = why_untestable(term.as_ref(), campaign, &lin) {
            return Err(ModelError::Untestable { id: term.info().id.to_owned(), why });
        }
        let own = OnceLock::new();
        let is_kept = matches!(lin, Cow::Borrowed(_));
        let unexplained = Unexplained::by(&fitted, &lin, if is_kept { &springs.left } else { &own });
        let spec = |version: Arc<dyn Term>| {
            let prior = prior(version.as_ref(), *richer, &natural);
            TermSpec { term: version, rich: *richer, shape: FIRST_SHAPE, prior }
        };
        let versions: Vec<_> = one
            .versions()
            .into_iter()
            .map(|(share, version)| (price(campaign, share, version.as_ref()), spec(version)))
            .collect();
        (wanted, fitted) = best_version(readings, &wanted, &versions, &unexplained)?;
    }
    let fitted = together(campaign, &wanted, fitted);
    reshaped(readings, wanted, fitted)
}

/// The fit with one more term in the version that costs least, of versions with their prices, the usual one first. Shapes on a grid are
/// too coarse to compare laws by: every version that may come to be the best is fitted.
fn best_version(
    readings: ManyReadings<'_>,
    others: &[TermSpec],
    versions: &[(f64, TermSpec)],
    unexplained: &Unexplained<'_>,
) -> Result<(Vec<TermSpec>, Fit), ModelError> {
    let fitted = unexplained.fitted;
    let starts = |next: &TermSpec, shapes: &[PromisingShape]| {
        Starts::at(readings, others, (others.len(), next), shapes, fitted)
    };
    let (usual_price, usual) = &versions[0];
    if versions.len() == 1 {
        return starts(usual, &unexplained.starts(usual)).best(fitted);
    }
    let scan = unexplained.scan(usual);
    let worth = scan.gain() - usual_price;
    let of_usual = starts(usual, &scan.starts());
    let mut best = of_usual.best(fitted)?;
    let mut least = best.1.chi2 + usual_price;
    for (price, version) in &versions[1..] {
        let scan = unexplained.scan(version);
        if BETWEEN_PLACES * scan.gain() - price <= worth {
            continue;
        }
        let next = starts(version, &scan.starts());
        let next =
            if next.may_beat(*price, (&of_usual, *usual_price)) { next.best(fitted).ok() } else { None };
        if let Some(next) = next.filter(|(_, fitted)| fitted.chi2 + price < least) {
            least = next.1.chi2 + price;
            best = next;
        }
    }
    Ok(best)
}

/// The best fit when every shape is chosen once more beside all other terms: while one of them was missing, another shape may have
/// made up for it.
fn reshaped(
    readings: ManyReadings<'_>,
    mut wanted: Vec<TermSpec>,
    mut fitted: Fit,
) -> Result<(Vec<TermSpec>, Fit), ModelError> {
    for place in 0..wanted.len() {
        if wanted.len() < 2 || wanted[place].term.info().shape.is_none() {
            continue;
        }
        let mut others = wanted.clone();
        let next = others.remove(place);
        let without = fit(readings.all, &others, Some(&fitted.point))?;
        let (lin, left) = (Linearization::at(readings.all, &without.point)?, OnceLock::new());
        let shapes = Unexplained::by(&without, &lin, &left).starts(&next);
        let (again, better) =
            Starts::at(readings, &others, (place, &next), &shapes, &without).best(&without)?;
        if better.chi2 < fitted.chi2 {
            (wanted, fitted) = (again, better);
        }
    }
    Ok((wanted, fitted))
}

/// Prior widths: wide for the ideal form, and no wider than sensible for what the richer one adds, so that it shrinks.
fn prior(term: &dyn Term, richer: bool, natural: &Natural) -> Vec<f64> {
    let ideal = term.info().parameters.len();
    let widened = |(k, size): (usize, f64)| if k < ideal { PRIOR_WIDTH * WIDEST * size } else { size };
    sizes(term, richer, FIRST_SHAPE, natural).into_iter().enumerate().map(widened).collect()
}

/// The better of a fit reached term by term and one that starts with all terms at once: while a term is still missing, the
/// others may go far astray to make up for it, too far to come back.
fn together(campaign: &Campaign, wanted: &[TermSpec], fitted: Fit) -> Fit {
    if wanted.len() < 2 {
        return fitted;
    }
    let fresh = fit(campaign, wanted, None).ok().filter(|f| f.chi2 < fitted.chi2);
    fresh.unwrap_or(fitted)
}

fn refuse_twice(added: &[Added]) -> Result<(), ModelError> {
    let id = |a: &Added| a.term.info().id;
    let twice = (1..added.len()).find(|&i| added[..i].iter().any(|t| id(t) == id(&added[i])));
    twice.map_or(Ok(()), |i| {
        Err(ModelError::Selection(format!("the term `{}` is requested twice", id(&added[i]))))
    })
}

/// Refuse a fit whose leg stiffnesses, or all parameters of one term, the data leave open.
///
/// # Errors
/// [`ModelError::NotDetermined`] with the combinations in words.
pub fn refuse_undetermined(fitted: &Fit) -> Result<(), ModelError> {
    let open = estimates(fitted).not_determined;
    let legs: Vec<String> = open.iter().filter(|n| leg_of_stiffness(n).is_some()).cloned().collect();
    let silent = |term: &usize| fitted.parameters.values_of_term(*term).all(|k| !fitted.is_determined(k));
    let terms: Vec<&Active> =
        (0..fitted.point.active.len()).filter(silent).map(|term| &fitted.point.active[term]).collect();
    if legs.is_empty() && terms.is_empty() {
        return Ok(());
    }
    if let Some(alike) = acts_as_springs(fitted).filter(|_| legs.len() == 6) {
        let what =
            format!("{alike} acts like other leg springs in these readings, so that no stiffness is known");
        return Err(ModelError::NotDetermined { what });
    }
    let mut what: Vec<String> = terms.iter().map(|a| format!("`{}` is not visible", a.id())).collect();
    if !legs.is_empty() {
        what.push(format!("{} {} open", joined(&legs), if legs.len() == 1 { "is" } else { "are" }));
    }
    what.extend(reasons(fitted));
    Err(ModelError::NotDetermined { what: what.join("; ") })
}

/// The term, with its shape, that leaves the springs open: they are known once its numbers are. None where the readings leave them open
/// by themselves.
fn acts_as_springs(fitted: &Fit) -> Option<String> {
    let frees = |term: &usize| springs_beside(fitted, *term).is_some_and(|springs| springs.are_known());
    let term = (0..fitted.point.active.len()).find(frees)?;
    let active = &fitted.point.active[term];
    let shape = active.term.info().shape.filter(|_| fitted.parameters.shape_of_term(term).is_some());
    let shape =
        shape.map(|s| format!(" with a {} of {} {}", s.name, to_digits(active.shape * s.per_si, 2), s.unit));
    Some(format!("`{}`{}", active.id(), shape.unwrap_or_default()))
}

/// The springs where the numbers of a term are known.
fn springs_beside(fitted: &Fit, term: usize) -> Option<LegCompliances> {
    let (columns, all) = (fitted.parameters.of_term(term), &fitted.covariance);
    let own = all.view((columns.start, columns.start), (columns.len(), columns.len())).into_owned();
    let along = all.view((columns.start, 0), (columns.len(), 6)).into_owned();
    let told = along.tr_mul(&own.cholesky()?.solve(&along));
    let springs = LegCompliances::of(fitted);
    let variance = Vector6::from_fn(|leg, _| (springs.variance[leg] - told[(leg, leg)]).max(0.0));
    Some(LegCompliances { variance, ..springs })
}

/// Undetermined combinations in words, else the strongest look-alikes.
fn reasons(fitted: &Fit) -> Vec<String> {
    let words = unobservable(&fitted.solution.null_space, &fitted.parameters);
    if !words.is_empty() {
        return words;
    }
    let likes = look_alikes(fitted, LOOK_ALIKE);
    let told = likes
        .iter()
        .take(3)
        .map(|(a, b, r)| format!("{a} and {b} can barely be separated (correlation {r:.3})"));
    told.collect()
}

/// Pairs of columns whose estimates are correlated by more than `limit` in size, strongest first.
pub fn look_alikes(fitted: &Fit, limit: f64) -> Vec<(String, String, f64)> {
    let n = fitted.parameters.len();
    let mut pairs: Vec<(usize, usize, f64)> = (0..n)
        .flat_map(|i| (0..i).map(move |j| (j, i)))
        .map(|(j, i)| (j, i, fitted.covariance[(i, j)] / (fitted.std(i) * fitted.std(j))))
        .filter(|(.., r)| r.abs() > limit)
        .collect();
    pairs.sort_by(|a, b| b.2.abs().total_cmp(&a.2.abs()));
    let name = |k: usize| fitted.parameters[k].name.clone();
    pairs.into_iter().map(|(j, i, r)| (name(j), name(i), r)).collect()
}
