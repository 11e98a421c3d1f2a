//! All limits of a suite.

use hexbench_model::verdict::Verdict;
use hexbench_truth::campaign::Kind;

use super::answered::Answered;
use super::distance::Distance;
use super::fitted::Fitted;
use super::limit::{Group, Limit, Test, Unit};
use super::suite::Suite;
use super::trials::{OfSubject, Trials};
use crate::calibration::{Fate, Record, is_well_visible};
use crate::recovery::noiseless::{Bounded, Noiseless};
use crate::recovery::scene::Subject;

/// Least standard deviation of logarithms: counts that happen to be all the same in a baseline need not always be.
const ROUGH: f64 = 0.1;
/// The same of chi-square per number.
const FINE: f64 = 0.02;
/// Relative errors: from rounding to nonsense.
const ERRORS: Test = Test::Size { range: [1e-9, 10.0], least: ROUGH, unit: Unit::Percent };
/// Chi-square per number of models that are right: it hardly leaves 1; what does counts as a misfit elsewhere.
const CHI2: Test = Test::Size { range: [0.6, 1.7], least: FINE, unit: Unit::Plain };
/// Counts of work.
const COUNTS: Test = Test::Size { range: [1.0, 1e6], least: ROUGH, unit: Unit::Plain };
/// Nats between a stated probability and the truth: from 99.9 % to what no search weighs.
const NATS: Test = Test::Size { range: [1e-3, 14.0], least: ROUGH, unit: Unit::Plain };
/// Stated probability from which an answer counts as sure.
const SURE: f64 = 0.9;

/// The limits of a suite, in the order of the pages.
pub fn limits(suite: &Suite) -> Vec<Limit> {
    let mut all = accuracy();
    all.extend(suite.subjects.iter().filter(|s| !s.effects.is_empty()).map(|&s| effect_error(s)));
    all.extend(honesty());
    all.extend(suite.subjects.iter().map(|&s| pulls_of(s)));
    all.extend(diagnosis());
    all.extend(probabilities());
    all.extend(suite.subjects.iter().flat_map(|&s| without_noise(s)));
    all.push(all_bounds());
    all.extend(effort());
    all
}

fn fits(t: &Trials, value: impl Fn(&Fitted) -> Option<f64>) -> Vec<f64> {
    t.fitted().filter_map(|(_, f)| value(f)).collect()
}

fn fits_of(t: &Trials, subject: Subject, value: impl Fn(&Fitted) -> Option<f64>) -> Vec<f64> {
    t.fitted().filter(|(s, _)| **s == subject).filter_map(|(_, f)| value(f)).collect()
}

fn share(bad: bool) -> Option<f64> {
    Some(f64::from(u8::from(bad)))
}

fn accuracy() -> Vec<Limit> {
    let group = Group::Accuracy;
    vec![
        Limit::new(
            ("stiffness-error", group),
            "leg stiffness: relative error",
            "Leg stiffness is what everything else is for.",
            ERRORS,
            |t| fits(t, |f| f.stiffness_error),
        ),
        Limit::new(
            ("holdout", group),
            "held-out chi-square of the right model",
            "A right model predicts readings it has not seen as well as the noise allows.",
            CHI2,
            |t| fits(t, |f| Some(f.holdout)),
        ),
        Limit::new(
            ("holdout-after-diagnosis", group),
            "held-out chi-square of the diagnosed model where the answer is right",
            "What is named must also predict.",
            CHI2,
            |t| answers(t, |r| (r.fate == Fate::Right && !r.is_outside()).then_some(r.holdout[1]).flatten()),
        ),
        Limit::new(
            ("left-open", group),
            "campaigns in which numbers are left open by the data",
            "A number that is no longer determined has no error and no interval: it would leave all other limits unseen.",
            Test::Share,
            |t| fits(t, |f| share(f.open > 0)),
        ),
        Limit::new(
            ("without-answer", group),
            "campaigns without an answer",
            "A campaign that cannot be made, fitted or diagnosed would leave all other limits unseen.",
            Test::Share,
            |t| {
                let fits = t.fits.iter().map(|f| f.found.is_none());
                fits.chain(t.answers.iter().map(Option::is_none)).filter_map(share).collect()
            },
        ),
    ]
}

fn effect_error(s: Subject) -> Limit {
    Limit::new(
        (format!("error:{}", slug(s.name)), Group::Accuracy),
        format!("{}: relative error of its numbers", s.name),
        "The sizes and shapes of an effect are told to people: they must be right.",
        ERRORS,
        move |t| fits_of(t, s, |f| f.effect_error),
    )
}

/// A name as one word.
fn slug(name: &str) -> String {
    name.replace([',', '(', ')'], "").replace(' ', "-")
}

fn outside(distance: Option<Distance>) -> Option<f64> {
    share(distance?.is_outside())
}

fn honesty() -> Vec<Limit> {
    let group = Group::Honesty;
    let per_number = |d: Option<Distance>| d.map(|d| d.per_number());
    vec![
        Limit::new(
            ("stiffness-pulls", group),
            "leg stiffness: mean squared pull of six legs in their covariance",
            "An honest covariance gives 1; a factor 1.5 on it gives 1.5.",
            Test::Spread,
            move |t| fits(t, |f| per_number(f.springs)),
        ),
        Limit::new(
            ("all-pulls", group),
            "all numbers: mean squared pull in their covariance",
            "Leg stiffness and effects together: what is wrong with every uncertainty shows here first.",
            Test::Spread,
            |t| fits(t, both),
        ),
        Limit::new(
            ("stiffness-coverage", group),
            "leg stiffness: truth outside the 95 % region of six legs",
            "A region that claims 95 % must hold the truth in 95 % of the campaigns.",
            Test::Share,
            |t| fits(t, |f| outside(f.springs)),
        ),
        Limit::new(
            ("effect-pulls", group),
            "effects: mean squared pull in their covariance",
            "The same for the numbers of effects.",
            Test::Spread,
            move |t| fits(t, |f| per_number(f.effect)),
        ),
        Limit::new(
            ("effect-coverage", group),
            "effects: truth outside the 95 % region of their numbers",
            "The same for the numbers of effects.",
            Test::Share,
            |t| fits(t, |f| outside(f.effect)),
        ),
        Limit::new(
            ("prediction-coverage", group),
            "predictions: held-out readings outside their 95 % region",
            "Noise and uncertainty of the model together must say how far off a prediction can be.",
            Test::Share,
            |t| fits(t, |f| share(f.prediction_missed)),
        ),
        Limit::new(
            ("fit-chi2", group),
            "chi-square of the right model on what it was fitted to",
            "A solver that stops early, or a term that is slightly wrong, leaves more than the noise.",
            CHI2,
            |t| fits(t, |f| Some(f.chi2_reduced)),
        ),
        Limit::new(
            ("misfits", group),
            "campaigns that the right model does not fit",
            "A misfit has no uncertainties; it would leave the other limits of honesty unseen.",
            Test::Share,
            |t| fits(t, |f| share(f.misfit)),
        ),
        Limit::new(
            ("stiffness-pulls-after-diagnosis", group),
            "leg stiffness after a right diagnosis: mean squared pull",
            "What people read comes from the diagnosis, averaged over shapes and chosen by the search.",
            Test::Spread,
            |t| answers(t, |r| (r.fate == Fate::Right).then(|| mean_square(r)).flatten()),
        ),
    ]
}

fn mean_square(r: &Record) -> Option<f64> {
    let all: Vec<f64> = r.stiffness_z.iter().flatten().map(|z| z * z).collect();
    (!all.is_empty() && !r.is_outside()).then(|| all.iter().sum::<f64>() / all.len() as f64)
}

/// Leg compliances and the numbers of the effect.
fn both(f: &Fitted) -> Option<f64> {
    match (f.springs, f.effect) {
        (Some(a), Some(b)) => Some(a.and(b).per_number()),
        (a, b) => a.or(b).map(|d| d.per_number()),
    }
}

fn pulls_of(s: Subject) -> Limit {
    Limit::new(
        (format!("pulls:{}", slug(s.name)), Group::Honesty),
        format!("{}: mean squared pull of all numbers", s.name),
        "Each effect has columns of its own: their uncertainties can be wrong for one effect alone.",
        Test::Spread,
        move |t| fits_of(t, s, both),
    )
}

fn answers(t: &Trials, value: impl Fn(&Record) -> Option<f64>) -> Vec<f64> {
    t.answered().filter_map(|a| value(&a.record)).collect()
}

/// Share of bad answers among some of the records.
fn bad(
    (id, title, why): (&str, &str, &str),
    among: fn(&Record) -> bool,
    is_bad: fn(&Record) -> bool,
) -> Limit {
    Limit::new((id, Group::Diagnosis), title, why, Test::Share, move |t| {
        answers(t, |r| share(is_bad(r)).filter(|_| among(r)))
    })
}

fn diagnosis() -> Vec<Limit> {
    vec![
        bad(
            ("false-names", "effects named that are not there", "Sends people to repair what is not broken."),
            |_| true,
            |r| r.fate == Fate::FalseName,
        ),
        bad(
            (
                "false-outside",
                "\"outside\" said wrongly",
                "Sends people to look for physics that is not there.",
            ),
            |r| !r.is_outside(),
            |r| r.verdict == Verdict::Outside,
        ),
        bad(
            ("false-statements", "answers that state something false", "Ambiguous is honest, wrong is not."),
            |_| true,
            |r| r.fate >= Fate::Incomplete,
        ),
        bad(
            (
                "not-right",
                "answers other than exactly the truth",
                "The usefulness of the diagnosis in one figure.",
            ),
            |_| true,
            |r| r.fate != Fate::Right,
        ),
        bad(
            ("single-not-named", "one well visible effect, not named", "The plainest case."),
            |r| r.kind == Kind::Single && is_well_visible(r),
            |r| r.fate != Fate::Right,
        ),
        bad(
            ("pair-not-named", "two well visible effects, not both named", "Effects hide each other."),
            |r| r.kind == Kind::Pair && is_well_visible(r),
            |r| r.fate != Fate::Right,
        ),
        bad(
            (
                "outside-not-noticed",
                "something well visible outside the catalogue, not noticed",
                "\"It is none of the effects I know\" must be a possible answer.",
            ),
            |r| r.is_outside() && is_well_visible(r),
            |r| r.fate != Fate::Right,
        ),
        bad(
            ("clean-not-adequate", "nothing hidden, but not called adequate", "A sound machine must pass."),
            |r| r.hidden.is_empty(),
            |r| r.fate != Fate::Right,
        ),
        bad(
            (
                "missed",
                "springs called adequate although an effect is well visible",
                "A clean bill of health for a machine that is not sound.",
            ),
            |r| !r.hidden.is_empty() && is_well_visible(r),
            |r| r.fate == Fate::Missed,
        ),
        bad(
            (
                "undecided",
                "ambiguous without the truth among what is kept",
                "Ambiguous must still hold the truth.",
            ),
            |_| true,
            |r| r.fate == Fate::Undecided,
        ),
    ]
}

fn probabilities() -> Vec<Limit> {
    let group = Group::Probabilities;
    let wrong_though_sure =
        |r: &Record| r.confidence.filter(|p| *p >= SURE).and_then(|_| share(r.fate != Fate::Right));
    vec![
        Limit::new(
            ("sure-but-wrong", group),
            "answers stated with 90 % or more that are not the truth",
            "A stated probability is a promise.",
            Test::Share,
            move |t| answers(t, wrong_though_sure),
        ),
        Limit::new(
            ("credible-sets", group),
            "credible sets of 95 % without the truth, where it is well visible",
            "People keep the set and rule out the rest.",
            Test::Share,
            |t| answers(t, |r| share(!r.is_covered()).filter(|_| is_well_visible(r))),
        ),
        Limit::new(
            ("log-score", group),
            "nats between the probability stated for the truth and certainty",
            "The logarithmic score punishes both wrong certainty and needless doubt.",
            NATS,
            |t| answers(t, |r| Some(-r.truth.max(f64::MIN_POSITIVE).ln())),
        ),
    ]
}

fn machines(t: &Trials, subject: Subject) -> impl Iterator<Item = Option<&Noiseless>> {
    t.machines.iter().filter(move |m| m.subject == subject).map(|m: &OfSubject<Noiseless>| m.found.as_ref())
}

/// What is found without noise, against the baseline; poses closed exactly by both worlds have rounding only, and its bound.
fn without_noise(s: Subject) -> Vec<Limit> {
    let group = Group::NoiseFree;
    let of = |what: &str, id: &str, pick: fn(&Noiseless) -> Option<Bounded>| {
        let why = if s.absolute {
            "World and model close a pose alike: only rounding may remain, and its bound is derived."
        } else {
            "What remains is the linearisation of the model on this machine: it has no reason to change."
        };
        let value = move |b: Bounded| if s.absolute { b.error / b.bound } else { b.error };
        let values = move |t: &Trials| {
            machines(t, s).map(|m| m.and_then(pick).map_or(f64::INFINITY, value)).collect::<Vec<_>>()
        };
        let title = if s.absolute {
            format!("{}: {what} without noise, error over bound", s.name)
        } else {
            format!("{}: {what} without noise, relative error", s.name)
        };
        let test = if s.absolute { Test::Bound } else { Test::Exact };
        Limit::new((format!("{id}:{}", slug(s.name)), group), title, why, test, values)
    };
    let mut both = vec![of("leg stiffness", "exact-stiffness", |m| m.stiffness)];
    if !s.effects.is_empty() {
        both.push(of("its numbers", "exact-effect", |m| m.effect));
    }
    both
}

fn all_bounds() -> Limit {
    Limit::new(
        ("exact-bounds", Group::NoiseFree),
        "errors without noise over the bounds derived from the linearisation",
        "An error beyond what the model leaves out by construction has another cause, whatever the baseline says.",
        Test::Bound,
        |t| {
            let found = t.machines.iter().filter(|m| !m.subject.absolute).filter_map(|m| m.found);
            found.flat_map(|m| [m.stiffness, m.effect]).flatten().map(|b| b.error / b.bound).collect()
        },
    )
}

fn effort() -> Vec<Limit> {
    let limit = |id: &str, title: &str, value: fn(&Fitted) -> Option<f64>, test: Test| {
        let why = "Work is counted, not timed: the count is the same on every computer.";
        Limit::new((id, Group::Effort), title, why, test, move |t: &Trials| fits(t, value))
    };
    let search = |id: &str, title: &str, value: fn(&Answered) -> usize| {
        let why = "The search decides how long a diagnosis takes.";
        Limit::new((id, Group::Effort), title, why, COUNTS, move |t: &Trials| {
            t.answered().map(|a| value(a) as f64).collect()
        })
    };
    vec![
        limit("iterations", "Gauss-Newton iterations of a fit", |f| Some(f.iterations as f64), COUNTS),
        limit("linearisations", "linearisations of a fit", |f| Some(f.tried as f64), COUNTS),
        limit("not-settled", "fits that ran out of iterations", |f| share(!f.settled), Test::Share),
        search("sets", "sets of effects weighed by a diagnosis", |a| a.sets),
        search("rounds", "rounds of linearisation and search of a diagnosis", |a| a.rounds),
    ]
}
