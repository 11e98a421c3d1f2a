//! The story in one picture for a page on a screen: as the report draws it, with its numbers in words.

use hexbench_model::inference::selection::{FitWithErrors, JudgedTask};
use serde::Serialize;

use super::data::Data;
use super::machine::{ChartedMachine, ErrorSteps};
use super::{ReportError, tells_a_story};
use crate::number::with_micro;
use crate::render::themed;
use crate::words::ReportSubject;

/// A picture in the colors of the page it stands in: CSS variables (`--ink`, `--grey`, `--grid`, `--paper`, `--blue`, `--red`).
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct StoryChart {
    /// Its heading.
    pub title: String,
    /// SVG: the machine, and bars on its right.
    pub wide: String,
    /// SVG for a narrow window: the bars below the machine.
    pub narrow: String,
    /// What it shows.
    pub caption: String,
    /// Its bars in words, a sentence for each group.
    pub words: Vec<String>,
}

/// The story of a diagnosis, of misread files what the springs alone miss as in its report; none where the springs are sufficient, and for
/// readings that do not determine the motion of the platform.
///
/// # Errors
/// [`ReportError`] when it cannot be drawn.
pub fn story(subject: &ReportSubject<'_>) -> Result<Option<StoryChart>, ReportError> {
    let found = &subject.study.diagnosis;
    if !tells_a_story(found) {
        return Ok(None);
    }
    let errors = (!found.is_misread()).then(|| ErrorSteps::of(found));
    let data = Data::of_study(subject)?;
    ChartedMachine::of(&data, errors.as_ref())
        .filter(|charted| charted.shrinks)
        .as_ref()
        .map(pictured)
        .transpose()
}

/// The story of springs with terms beside the springs alone, fitted to the same readings; `name`: of what was added, empty for nothing.
///
/// # Errors
/// [`ReportError`] when it cannot be drawn.
pub fn story_of_fits(
    task: &JudgedTask<'_>,
    springs: &FitWithErrors,
    model: &FitWithErrors,
    name: String,
) -> Result<Option<StoryChart>, ReportError> {
    let data = Data::of_fits(task, [&springs.fit.point, &model.fit.point])?;
    ChartedMachine::of(&data, Some(&ErrorSteps::of_fits(springs, model, name)))
        .as_ref()
        .map(pictured)
        .transpose()
}

fn pictured(charted: &ChartedMachine) -> Result<StoryChart, ReportError> {
    let [wide, narrow] = charted.laid_out()?;
    Ok(StoryChart {
        title: charted.title.to_owned(),
        wide: themed(&wide, &charted.caption),
        narrow: themed(&narrow, &charted.caption),
        words: charted.bars.words().iter().map(|words| with_micro(words)).collect(),
        caption: with_micro(&charted.caption),
    })
}
