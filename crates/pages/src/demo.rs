//! The story of the demo, step by step.

use hexbench_core::Observation;
use hexbench_model::error::ModelError;

use super::conclusion::{error_statement, lacks};
use super::ladder::multiple;
use super::subject::{Subject, describe};
use super::{confidence, ladder, leg_space, size, stiffness};
use crate::text::{Ink, Paper};

/// From measurements to the named effect.
///
/// # Errors
/// As the linearisation of the model.
pub fn demo(subject: &Subject<'_>, ink: Ink) -> Result<String, ModelError> {
    let mut paper = Paper::new(ink);
    measurements(&mut paper, subject);
    springs(&mut paper, subject);
    where_it_fails(&mut paper, subject)?;
    diagnosis(&mut paper, subject);
    end(&mut paper, subject);
    Ok(paper.into_text())
}

fn measurements(paper: &mut Paper, subject: &Subject<'_>) {
    paper.heading("1. What was measured", "");
    paper.paragraph(
        2,
        "A hexapod stands on a table and is loaded with forces and moments. Every reading is how far the platform \
         moved between a reference load and the load: three translations, three rotations. The numbers were made by \
         MuJoCo, a program that shares nothing with this model; what it hides is not told to the diagnosis.",
    );
    paper.hanging("  data", LABEL, &describe(subject.data));
    if let Some(holdout) = subject.holdout {
        paper.hanging("  held out", LABEL, &format!("{}; never used in a fit", describe(holdout)));
    }
    if let Some(row) = subject.data.observations.first() {
        paper.hanging("  first row", LABEL, &reading(row));
    }
}

const LABEL: usize = 13;

fn reading(row: &Observation) -> String {
    let moved: Vec<String> = row.measured.iter().map(|x| format!("{:.1}", x * 1e6)).collect();
    let change = row.wrench.force.z - row.reference.force.z;
    format!(
        "{change:.0} N along z moved the platform by ({}) um and turned it by ({}) urad",
        moved[..3].join(", "),
        moved[3..].join(", ")
    )
}

fn springs(paper: &mut Paper, subject: &Subject<'_>) {
    paper.heading("2. One spring per leg", "the usual model");
    let Some(step) = subject.study.diagnosis.steps.first() else { return };
    let fitted = multiple(step.fitted.chi2_reduced.sqrt());
    let held = step.holdout.map_or("-".to_owned(), |h| multiple(h.chi2_reduced.sqrt()));
    paper.paragraph(
        2,
        &format!(
            "Six stiffnesses are fitted to the data. If six springs were all there is, the error would be the noise. \
             It is {fitted} times the noise on the fitted readings and {held} times on the held-out poses: the model \
             lacks something."
        ),
    );
}

fn where_it_fails(paper: &mut Paper, subject: &Subject<'_>) -> Result<(), ModelError> {
    paper.heading("3. Where it fails", "elongation of each leg left unexplained, um, root mean square");
    paper.paragraph(
        2,
        "Six legs measure six degrees of freedom, so what is left of a reading can be written as six leg elongations. \
         Some loads are explained less well than others:",
    );
    leg_space::section(paper, subject)
}

fn diagnosis(paper: &mut Paper, subject: &Subject<'_>) {
    let d = &subject.study.diagnosis;
    paper.heading("4. Which effect is missing", "");
    let tested = hexbench_model::terms::catalogue().len() - d.untestable.len();
    paper.paragraph(
        2,
        &format!(
            "{tested} physical effects of the catalogue can be tested with these data, and patterns outside it. Each \
             is weighed by how well it predicts the readings, given sizes that make physical sense."
        ),
    );
    confidence::section(paper, d);
    ladder::section(paper, d);
    size::section(paper, d, false);
    stiffness::section(paper, subject.hexapod, d, false);
}

fn end(paper: &mut Paper, subject: &Subject<'_>) {
    let d = &subject.study.diagnosis;
    paper.heading("Verdict", "");
    paper.paragraph(2, &format!("{} {}", lacks(&d.added), error_statement(&d.steps)));
    paper.heading("Try next", "");
    paper.line("  hexbench workbench");
    paper.line("  hexbench diagnose hexapod.toml measurements.csv --holdout holdout.csv");
    paper.line(&format!("  hexbench terms {}", d.added.first().map_or("", String::as_str)));
}
