//! Results of a trial: names, units, meaning.

use hexbench_design::Criterion;
use hexbench_model::inference::explanation::Explanation;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::terms::catalogue;

use crate::calibration::Fate;
use crate::sized::SizeUnit;
use crate::sweep::indices::PREFIX;
use crate::sweep::study::{SweepStudy, SweepTask};
use crate::sweep::task::diagnose::in_the_catalogue;

/// What became of a trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// It has an answer.
    Done = 0,
    /// The readings do not determine all stiffnesses.
    NotDetermined = 1,
    /// The effect cannot be as visible or as large as asked for and still be what its name says.
    NotVisible = 2,
    /// The machine has no state of rest at a pose, or cannot reach it.
    NoRest = 3,
    /// No pose keeps the limits of the space.
    NoPlan = 4,
    /// The model cannot be computed.
    NoFit = 5,
}

impl Status {
    /// Names, in the order of the numbers.
    pub const NAMES: [&str; 6] =
        ["done", "not determined", "effect not visible", "no state of rest", "no plan", "no fit"];
}

/// Kind of the values of a column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ColumnKind {
    /// A number, NaN for none.
    Number,
    /// A small count, 255 for none.
    Count,
    /// One of these words, 255 for none.
    Word(Vec<String>),
}

/// A result of every trial.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TrialColumn {
    /// Name with its unit.
    pub name: String,
    /// Unit, empty for none.
    pub unit: &'static str,
    /// One sentence.
    pub meaning: &'static str,
    /// Kind of its values.
    pub kind: ColumnKind,
}

fn number(name: &str, unit: &'static str, meaning: &'static str) -> TrialColumn {
    TrialColumn { name: name.to_owned(), unit, meaning, kind: ColumnKind::Number }
}

fn count(name: &str, meaning: &'static str) -> TrialColumn {
    TrialColumn { name: name.to_owned(), unit: "1", meaning, kind: ColumnKind::Count }
}

fn word(name: &str, meaning: &'static str, words: impl IntoIterator<Item = String>) -> TrialColumn {
    TrialColumn {
        name: name.to_owned(),
        unit: "",
        meaning,
        kind: ColumnKind::Word(words.into_iter().collect()),
    }
}

/// Results of a trial of a study, in order.
pub fn columns(study: &SweepStudy) -> Vec<TrialColumn> {
    let mut all = after_status(match study.task {
        SweepTask::Springs => springs(),
        SweepTask::Diagnose => diagnose(study),
    });
    if study.indices {
        let meaning = "index of the plan for the six leg springs of the drawing, rows weighted by the noise; larger is better";
        all.extend(Criterion::ALL.map(|c| number(&format!("{PREFIX}{}", c.name()), "1", meaning)));
    }
    all
}

fn after_status(results: Vec<TrialColumn>) -> Vec<TrialColumn> {
    let names = Status::NAMES.map(str::to_owned);
    let meaning = "what became of the trial; without \"done\" the other results are empty";
    std::iter::once(word("status", meaning, names)).chain(results).collect()
}

/// Results of a fit of six stiffnesses.
#[cfg(test)]
pub(crate) fn of_springs() -> Vec<TrialColumn> {
    after_status(springs())
}

fn springs() -> Vec<TrialColumn> {
    let leg = |n: usize| {
        number(
            &format!("leg_{n}_stiffness_error_percent"),
            "%",
            "estimated minus true stiffness of the leg, relative to the true one",
        )
    };
    let mut all: Vec<TrialColumn> = (1..=6).map(leg).collect();
    all.push(count("legs_covered", "legs whose 95 % interval holds the true stiffness, of six"));
    all.push(number(
        "holdout_error_um",
        "um",
        "root mean square error of predicted translations, held-out readings without noise",
    ));
    all.push(number(
        "holdout_error_urad",
        "urad",
        "root mean square error of predicted rotations, held-out readings without noise",
    ));
    all.push(number(
        "holdout_error_over_noise",
        "1",
        "root mean square error of the predicted numbers over the standard deviation of each",
    ));
    all
}

/// What is said beside the name of one effect, in the order of the codes after those of [`names`].
pub const OTHER_ANSWERS: [&str; 6] =
    ["nothing", "several effects", "ambiguous", "outside the catalogue", "the measurement", "undecided"];

/// What a diagnosis can answer: an effect by name, one of [`OTHER_ANSWERS`], or exactly the effects that a study hides together.
pub fn answers(study: &SweepStudy) -> Vec<String> {
    let terms = catalogue();
    let names = terms.iter().map(|t| t.info().id).chain(OTHER_ANSWERS).map(str::to_owned);
    names.chain(hidden_sets(study).iter().map(|set| set.join("+"))).collect()
}

/// Effects that a study hides together, as the catalogue calls them.
pub fn hidden_sets(study: &SweepStudy) -> Vec<Vec<&'static str>> {
    let mut sets: Vec<Vec<&'static str>> = Vec::new();
    for set in study.axes.effect.iter().filter(|set| set.len() > 1) {
        let ids = set.iter().map(|effect| in_the_catalogue(effect.id)).collect();
        // In other sizes they are the same answer.
        if !sets.contains(&ids) {
            sets.push(ids);
        }
    }
    sets
}

/// The unit in which all effects of a study have their size; none where they differ.
fn size_unit(study: &SweepStudy) -> Option<SizeUnit> {
    let mut units = study.axes.effect.iter().flatten().map(|effect| SizeUnit::of(effect.id));
    let first = units.next()??;
    units.all(|unit| unit == Some(first)).then_some(first)
}

/// Name of a column of sizes, with the unit where there is one for all effects.
fn sizes(of: &str, unit: Option<SizeUnit>, meaning: &'static str) -> TrialColumn {
    let key = unit.map_or("size", |unit| unit.key);
    number(&format!("{of}_{key}"), unit.map_or("", |unit| unit.unit), meaning)
}

/// What can be named first.
pub fn names() -> Vec<String> {
    let terms = catalogue().iter().map(|t| t.info().id.to_owned()).collect::<Vec<_>>();
    terms.into_iter().chain(Explanation::SPECIAL.map(String::from)).collect()
}

fn diagnose(study: &SweepStudy) -> Vec<TrialColumn> {
    let size = size_unit(study);
    vec![
        word(
            "outcome",
            "right: exactly the truth; honest: ambiguous without excluding it; undecided: ambiguous without it; missed: \
             nothing is said to be hidden; incomplete: not all that is hidden; false outside, false name: not the truth",
            Fate::ALL.map(|fate| fate.word().to_owned()),
        ),
        word("verdict", "what the diagnosis says", Verdict::ALL.map(|verdict| verdict.word().to_owned())),
        word("answer", "the effect that is named, or what is said instead", answers(study)),
        sizes(
            "true",
            size,
            "size of the hidden effect, in the unit of its kind; empty outside the catalogue, and where several are hidden",
        ),
        sizes(
            "estimated",
            size,
            "size that the final model finds for the hidden effect; empty where it is not in that model",
        ),
        word("first", "the first candidate", names()),
        number("first_probability", "1", "its probability"),
        count("terms_added", "terms added to the springs"),
        number(
            "holdout_chi2_springs",
            "1",
            "held-out chi-square per number with springs alone, readings with noise",
        ),
        number("holdout_chi2_final", "1", "the same with the final model"),
    ]
}
