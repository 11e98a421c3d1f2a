//! The verdict in a sentence or two.

use hexbench_model::diagnose::{Diagnosis, StepReport};
use hexbench_model::terms::catalogue;
use hexbench_model::verdict::Verdict;

use crate::text::{Ink, Paper};

/// Least excess of the held-out chi-square that counts as above the noise.
const LEAST_EXCESS: f64 = 0.2;
/// Standard deviations of a reduced chi-square that chance allows.
const CHANCE: f64 = 3.1;

/// One word for a verdict, as in the files.
pub fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Adequate => "adequate",
        Verdict::Named => "named",
        Verdict::Ambiguous => "ambiguous",
        Verdict::Outside => "outside",
    }
}

/// The verdict.
pub fn section(paper: &mut Paper, d: &Diagnosis) {
    paper.heading("Verdict", "");
    let painted = paint(paper.ink(), d.verdict);
    paper.line(&format!("  {painted}"));
    for sentence in sentences(d) {
        paper.paragraph(2, &sentence);
    }
}

fn paint(ink: Ink, verdict: Verdict) -> String {
    let word = word(verdict).to_uppercase();
    match verdict {
        Verdict::Adequate | Verdict::Named => ink.good(&word),
        Verdict::Ambiguous => ink.doubtful(&word),
        Verdict::Outside => ink.bad(&word),
    }
}

/// The verdict in a sentence or two.
pub fn sentences(d: &Diagnosis) -> Vec<String> {
    match d.verdict {
        Verdict::Adequate => vec![
            "The springs alone explain these measurements: nothing is missing that these data could show. What \
             they could not show is listed below."
                .to_owned(),
        ],
        Verdict::Named => vec![lacks(&d.added), error_statement(&d.steps)],
        Verdict::Ambiguous => ambiguous(d),
        Verdict::Outside => outside(d),
    }
}

/// `The model lacks one effect: the foundation yields (base-compliance).`
pub fn lacks(ids: &[String]) -> String {
    let names: Vec<String> = ids.iter().map(|id| described(id)).collect();
    match ids.len() {
        1 => format!("The model lacks one effect: {}.", names[0]),
        n => format!("The model lacks {n} effects: {}.", joined(&names, "and")),
    }
}

/// `the foundation yields (base-compliance)`.
pub fn described(id: &str) -> String {
    let terms = catalogue();
    let title = terms.iter().find(|t| t.info().id == id).map(|t| t.info().title);
    title.map_or_else(|| id.to_owned(), |title| format!("{} ({id})", lower_first(title)))
}

fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|c| c.to_lowercase().chain(letters).collect()).unwrap_or_default()
}

/// `a, b and c`.
pub fn joined<S: AsRef<str>>(parts: &[S], last: &str) -> String {
    match parts {
        [] => String::new(),
        [one] => one.as_ref().to_owned(),
        [head @ .., tail] => {
            let head: Vec<&str> = head.iter().map(AsRef::as_ref).collect();
            format!("{} {last} {}", head.join(", "), tail.as_ref())
        }
    }
}

/// How the held-out error falls, in multiples of the noise.
pub fn error_statement(steps: &[StepReport]) -> String {
    let ends = || Some((steps.first()?.holdout?, steps.last()?.holdout?));
    let Some((before, after)) = ends() else { return "No poses could be held out.".to_owned() };
    let multiple = |chi2: f64| super::ladder::multiple(chi2.sqrt());
    let where_to = if at_the_noise(after.chi2_reduced, after.count) {
        ": it is at the noise"
    } else {
        ", still above the noise"
    };
    format!(
        "Adding {} brings the error on held-out poses from {} to {} times the noise{where_to}.",
        if steps.len() > 2 { "them" } else { "it" },
        multiple(before.chi2_reduced),
        multiple(after.chi2_reduced)
    )
}

/// True when a reduced chi-square over `count` numbers is what the noise gives, a little model uncertainty included.
pub fn at_the_noise(chi2_reduced: f64, count: usize) -> bool {
    let spread = CHANCE * (2.0 / count.max(1) as f64).sqrt();
    chi2_reduced < 1.0 + spread.max(LEAST_EXCESS)
}

fn ambiguous(d: &Diagnosis) -> Vec<String> {
    let open: Vec<&String> = d.credible_set.iter().filter(|id| !d.added.contains(id)).collect();
    let named: Vec<&str> = open.iter().map(|id| in_words(id)).collect();
    let sure = (!d.added.is_empty()).then(|| lacks(&d.added));
    let undecided = match (named.len(), d.added.is_empty()) {
        (0, _) => "The data do not settle what is missing.".to_owned(),
        (1, true) => format!("The data point to {}, but not surely enough to name it.", named[0]),
        (1, false) => format!("Whether {} is at work as well is open.", named[0]),
        (_, true) => format!("These data cannot tell what is missing: it may be {}.", joined(&named, "or")),
        (_, false) => format!("Beyond that it may be {}: these data cannot tell.", joined(&named, "or")),
    };
    sure.into_iter().chain([undecided]).collect()
}

/// A credible explanation in words.
pub fn in_words(id: &str) -> &str {
    match id {
        "none" => "nothing beyond the springs",
        "outside" => "something outside the catalogue",
        id => id,
    }
}

fn outside(d: &Diagnosis) -> Vec<String> {
    let text = d.outside.as_ref().map_or("no simple pattern describes it", |o| o.text.as_str());
    let mut all = vec!["Something is missing that none of the effects in the catalogue explains.".to_owned()];
    if !d.model.is_empty() {
        all.push(format!("It is there beside {}.", joined(&d.model, "and")));
    }
    all.push(format!("What the measurements show: {text}."));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_read_as_sentences() {
        assert_eq!(joined(&["a"], "or"), "a");
        assert_eq!(joined(&["a", "b", "c"], "or"), "a, b or c");
    }

    #[test]
    fn few_held_out_numbers_allow_more_scatter() {
        assert!(at_the_noise(1.3, 180) && !at_the_noise(1.4, 180));
        assert!(at_the_noise(1.5, 60) && !at_the_noise(1.3, 100_000));
    }
}
