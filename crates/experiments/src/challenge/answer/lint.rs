//! Everything there is to say about one answer, before it is scored.

use std::fs;
use std::path::Path;

use hexbench_core::Measurand;
use hexbench_core::files::{instead_of, read_conditions};
use hexbench_model::estimation::parameters::stiffness_name;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::terms::catalogue;

use super::{AnswerFault, CaseAnswer, Number, StatedDiagnosis};
use crate::challenge::ChallengeError;
use crate::challenge::folder::{ANSWER, DIAGNOSIS, MEASUREMENTS, PARAMETERS, PREDICT, PREDICTIONS};
use crate::error::ExperimentError;

/// What a case asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AskedCase {
    /// Rows to predict.
    pub rows: usize,
    /// What a row of them is.
    pub measurand: Measurand,
}

impl AskedCase {
    /// What the public files of a case ask for.
    ///
    /// # Errors
    /// [`ChallengeError::File`], [`ExperimentError::Read`].
    pub fn read(case: &Path) -> Result<Self, ChallengeError> {
        let rows = read_conditions(&case.join(PREDICT))?.dataset.observations.len();
        let path = case.join(MEASUREMENTS);
        let text = fs::read_to_string(&path).map_err(ExperimentError::reading(&path))?;
        Ok(Self { rows, measurand: measurand_of(&text, "measured_a_mm") })
    }
}

/// By the names of the columns.
fn measurand_of(table: &str, pose: &str) -> Measurand {
    let header = table.lines().next().unwrap_or_default();
    let has = |name: &str| header.split(',').any(|column| column.trim() == name);
    match () {
        () if has(pose) => Measurand::AbsolutePose,
        () if has("drx_urad") => Measurand::DeflectionRotationVector,
        () => Measurand::DeflectionEuler,
    }
}

/// What there is to say about an answer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lint {
    /// What makes the case count as failed.
    pub faults: Vec<AnswerFault>,
    /// What is allowed and probably not meant.
    pub notes: Vec<AnswerFault>,
}

/// Looks at the answer in a folder; without the case, rows and columns are taken as the answer has them.
pub fn lint(folder: &Path, case: Option<AskedCase>) -> Lint {
    let own = || {
        let text = fs::read_to_string(folder.join(PREDICTIONS)).unwrap_or_default();
        measurand_of(text.trim_start_matches('\u{feff}'), "predicted_a_mm")
    };
    let measurand = case.map_or_else(own, |case| case.measurand);
    match CaseAnswer::read_all(folder, case.map(|case| case.rows), measurand) {
        Ok(answer) => Lint { faults: Vec::new(), notes: notes(folder, &answer) },
        Err(faults) => Lint { faults, notes: strangers(folder) },
    }
}

fn notes(folder: &Path, answer: &CaseAnswer) -> Vec<AnswerFault> {
    let mut notes = strangers(folder);
    if answer.predictions.iter().any(|p| p.sigma.is_none()) {
        let rule = "no standard uncertainties: intervals are not scored, and the CRPS is the absolute error";
        notes.push(
            AnswerFault::new(PREDICTIONS, "", rule)
                .then("Write the six columns sigma_..., if they are known."),
        );
    }
    if answer.predictions.iter().all(|p| p.value.iter().all(|v| *v == 0.0)) {
        let rule = "every prediction is zero";
        notes.push(AnswerFault::new(PREDICTIONS, "", rule).then("Check that the program read the case."));
    }
    notes.extend(of_parameters(&answer.parameters));
    notes.extend(of_diagnosis(answer.said.as_ref()));
    notes
}

/// Files that nobody reads.
fn strangers(folder: &Path) -> Vec<AnswerFault> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    // What a run keeps beside the answer.
    let kept = ["run.json", "stdout.txt", "stderr.txt"];
    let mut names: Vec<String> =
        entries.flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    names.retain(|name| !ANSWER.contains(&name.as_str()) && !kept.contains(&name.as_str()));
    names.sort_unstable();
    let note = |name: String| {
        let nearest = instead_of(&name, &ANSWER);
        AnswerFault::new("the folder", &name, "this file is not a part of an answer, and is not read")
            .then(nearest)
    };
    names.into_iter().map(note).collect()
}

fn of_parameters(numbers: &[Number]) -> Vec<AnswerFault> {
    let names: Vec<String> = (0..6).map(stiffness_name).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let stated = numbers.iter().filter(|n| names.contains(&n.name.as_str())).count();
    let mut notes = Vec::new();
    if stated == 0 {
        let rule = "no leg stiffness is stated: none is scored";
        notes.push(
            AnswerFault::new(PARAMETERS, "", rule).then(format!("State {} to {}.", names[0], names[5])),
        );
    } else if stated < names.len() {
        let rule = format!("{stated} of 6 leg stiffnesses are stated: the CRPS needs all of them");
        notes.push(AnswerFault::new(PARAMETERS, "", &rule).then("State the others too."));
    }
    for number in numbers {
        let near = hexbench_core::files::nearest(&number.name, names.iter().copied());
        if let Some(near) = near.filter(|near| *near != number.name) {
            let rule = "this name is not scored";
            notes.push(AnswerFault::new(PARAMETERS, &number.name, rule).then(format!("Write \"{near}\".")));
        }
        if names.contains(&number.name.as_str()) && number.value <= 0.0 {
            let rule = format!("{}: a stiffness is positive", number.value);
            notes.push(
                AnswerFault::new(PARAMETERS, &number.name, &rule).then("Check the sign of force or motion."),
            );
        }
    }
    notes
}

fn of_diagnosis(said: Option<&StatedDiagnosis>) -> Vec<AnswerFault> {
    let Some(said) = said else {
        let rule = "no diagnosis: neither right nor wrong is counted, and no probabilities are scored";
        return vec![
            AnswerFault::new(DIAGNOSIS, "", rule).then("Write the file, if anything is to be said."),
        ];
    };
    let mut notes = Vec::new();
    let mut note = |place: &str, rule: &str, next: String| {
        notes.push(AnswerFault::new(DIAGNOSIS, place, rule).then(next));
    };
    let terms = catalogue();
    let ids: Vec<&str> = terms.iter().map(|t| t.info().id).collect();
    for id in said.added.iter().filter(|id| !ids.contains(&id.as_str())) {
        note(
            "added",
            &format!("\"{id}\" is no effect of the catalogue: it is never right"),
            instead_of(id, &ids),
        );
    }
    for candidate in &said.candidates {
        let word = candidate.term.word();
        if !ids.contains(&word) && !["outside", "none"].contains(&word) {
            let next = instead_of(word, &ids);
            note("candidates", &format!("\"{word}\" is no effect of the catalogue: it is never true"), next);
        }
    }
    if said.verdict == Verdict::Named && said.added.is_empty() {
        note(
            "added",
            "the verdict is named, and nothing is",
            "Name the effects, or write another verdict.".to_owned(),
        );
    }
    if said.verdict == Verdict::Adequate && !said.added.is_empty() {
        note(
            "verdict",
            "adequate says that springs are enough, and effects are named",
            "Write \"named\".".to_owned(),
        );
    }
    if said.verdict == Verdict::Ambiguous && said.credible_set.is_empty() {
        note(
            "credible_set",
            "the verdict is ambiguous, and nothing is kept",
            "List what is not excluded.".to_owned(),
        );
    }
    if said.candidates.is_empty() {
        let rule = "no probabilities: a wrong diagnosis counts as a confident one, and neither log nor Brier score is given";
        note("candidates", rule, "State them, with \"outside\" and \"none\".".to_owned());
    }
    notes
}
