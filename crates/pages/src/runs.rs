//! Two results beside each other.

use hexbench_model::runs::{Changed, ParameterChange, Run, Runs};
use hexbench_report::number::{percent, significant, with_uncertainty};

use crate::comparison::chance;
use crate::conclusion::{in_words, joined, word};
use crate::ladder::multiple;
use crate::text::{Ink, Paper, Table};

/// Least probability that gets a line.
const WORTH_A_LINE: f64 = 0.03;

/// The whole page.
pub fn page(runs: &Runs, ink: Ink) -> String {
    let mut paper = Paper::new(ink);
    head(&mut paper, runs);
    answers(&mut paper, runs);
    errors(&mut paper, runs);
    parameters(&mut paper, runs);
    paper.into_text()
}

fn head(paper: &mut Paper, runs: &Runs) {
    let machine = runs.a.origin.as_ref().or(runs.b.origin.as_ref()).map_or("", |o| &o.machine);
    paper.heading(&format!("Two runs: {machine}"), "");
    paper.hanging("  A", 4, &runs.a.file);
    paper.hanging("  B", 4, &runs.b.file);
    for warning in &runs.warnings {
        paper.hanging("  -", 4, warning);
    }
}

/// `named: base-compliance`.
pub(crate) fn answer(run: &Run) -> String {
    let added = joined(&run.added, "and");
    match run.verdict {
        Some(verdict) if run.added.is_empty() => word(verdict).to_owned(),
        Some(verdict) => format!("{}: {added}", word(verdict)),
        None if run.added.is_empty() => "springs alone".to_owned(),
        None => format!("springs + {added}"),
    }
}

/// True when the answers differ.
pub(crate) fn other_answer(runs: &Runs) -> bool {
    runs.a.verdict != runs.b.verdict || runs.a.added != runs.b.added
}

/// True when anything differs beyond chance: the answer, the error, a number.
pub fn changed(runs: &Runs) -> bool {
    let error = runs.error.is_some_and(|e| e.changed == Changed::Yes);
    other_answer(runs) || error || runs.parameters.iter().any(|p| p.changed == Changed::Yes)
}

/// Probabilities worth a line.
pub(crate) fn probabilities(runs: &Runs) -> impl Iterator<Item = &(String, [f64; 2])> {
    runs.probabilities.iter().filter(|(_, [a, b])| a.max(*b) >= WORTH_A_LINE)
}

fn answers(paper: &mut Paper, runs: &Runs) {
    let title = if runs.a.verdict.is_some() { "Verdict" } else { "Model" };
    paper.heading(title, if other_answer(runs) { "changed" } else { "the same" });
    paper.hanging("  A", 4, &answer(&runs.a));
    paper.hanging("  B", 4, &answer(&runs.b));
    let mut table = Table::default();
    table.row(["at work, alone or with others", "A", "B"]);
    for (id, [a, b]) in probabilities(runs) {
        table.row([in_words(id).to_owned(), percent(*a), percent(*b)]);
    }
    if !runs.probabilities.is_empty() {
        table.lines().iter().for_each(|line| paper.line(line));
    }
}

/// Name, errors of every step of both, A first: times the noise, um, urad.
pub(crate) fn rungs(runs: &Runs) -> Vec<[String; 4]> {
    let of = |name: &'static str, run: &Run| {
        let mut all: Vec<[String; 4]> = Vec::new();
        for step in &run.steps {
            let with = if step.terms.is_empty() {
                "springs alone".to_owned()
            } else {
                format!("+ {}", step.terms.join(" + "))
            };
            let e = step.error();
            let (t, r) = (significant(e.rms.translation_um, 3), significant(e.rms.rotation_urad, 3));
            all.push([format!("{name}  {with}"), multiple(e.chi2_reduced.sqrt()), t, r]);
        }
        let (t, r) = (significant(run.noise_translation_um, 3), significant(run.noise_rotation_urad, 3));
        all.push([format!("{name}  noise ({})", run.noise_source), multiple(1.0), t, r]);
        all
    };
    of("A", &runs.a).into_iter().chain(of("B", &runs.b)).collect()
}

/// What became of the error, in a sentence.
pub(crate) fn error_sentence(runs: &Runs) -> String {
    let noise = if runs.noise_changed {
        " The noise is another one: multiples of it are not comparable."
    } else {
        ""
    };
    let Some(e) = runs.error else {
        return format!(
            "Only one of the two has a file of held-out readings: their errors are not compared.{noise}"
        );
    };
    let times = significant(e.ratio.sqrt(), 3);
    let p = chance(e.p);
    match e.changed {
        Changed::Yes => format!("The error of B is {times} times that of A, beyond chance ({p}).{noise}"),
        _ => format!("The error of B is {times} times that of A: chance explains it ({p}).{noise}"),
    }
}

fn errors(paper: &mut Paper, runs: &Runs) {
    paper.heading("The error", "held-out readings where there are some");
    let mut table = Table::default();
    table.row(["", "x noise", "um", "urad"]);
    for row in rungs(runs) {
        table.row(row);
    }
    table.lines().iter().for_each(|line| paper.line(line));
    paper.paragraph(2, &error_sentence(runs));
}

/// Value with its uncertainty, or a dash.
pub(crate) fn number(x: Option<[f64; 2]>) -> String {
    x.map_or("-".to_owned(), |[value, std]| with_uncertainty(value, std).join(" +- "))
}

/// Difference in combined uncertainties, starred when beyond chance.
pub(crate) fn difference(p: &ParameterChange) -> String {
    let star = if p.changed == Changed::Yes { " *" } else { "" };
    p.sigmas.map_or("-".to_owned(), |s| format!("{s:+.1}{star}"))
}

/// What the stars mean.
pub(crate) fn legend(runs: &Runs) -> String {
    let count = runs.parameters.iter().filter(|p| p.changed == Changed::Yes).count();
    let verb = if count == 1 { "differs" } else { "differ" };
    format!(
        "{count} of {} parameters {verb} beyond chance (*: more than {} combined standard uncertainties, which noise reaches anywhere in the \
         list once in a hundred).",
        runs.parameters.len(),
        significant(runs.sigmas_beyond_chance, 2)
    )
}

fn parameters(paper: &mut Paper, runs: &Runs) {
    if runs.parameters.is_empty() {
        return;
    }
    paper.heading("Parameters", "+- standard uncertainty (k = 1); B - A in combined uncertainties");
    let mut table = Table::default();
    table.row(["", "A", "B", "unit", "B - A"]);
    let mut told = "";
    for p in &runs.parameters {
        let (of, name) = p.name.split_once('.').unwrap_or(("", &p.name));
        let is_leg = name == "stiffness" && of.starts_with("leg-");
        if !is_leg && of != told {
            table.row([of]);
            told = of;
        }
        let name = if is_leg { p.name.clone() } else { format!("  {name}") };
        table.row([name, number(p.a), number(p.b), p.unit.clone(), difference(p)]);
    }
    table.left(3).lines().iter().for_each(|line| paper.line(line));
    paper.paragraph(2, &legend(runs));
}
