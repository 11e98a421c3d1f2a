//! Reading `[question]` and `[cost]`.

use hexbench_core::files::{Dimension, Fault, Item, KeyUnit, TomlSection};
use hexbench_design::Budget;

use crate::calibration::Fate;
use crate::sweep::axes::Axes;
use crate::sweep::cells::{TOLERANCE_SCALE, place};
use crate::sweep::question::Question;
use crate::sweep::results::Counted;
use crate::sweep::study::SweepTask;

const QUESTION: &[KeyUnit] = &KeyUnit::all_plain(["see", "name", "error_percent", "index"]);
const UNTIL: &[KeyUnit] = &KeyUnit::all_plain(["half_width"]);
const COST: &[KeyUnit] = &[
    KeyUnit::with_unit("reading", Dimension::Time, "s"),
    KeyUnit::with_unit("load_change", Dimension::Time, "s"),
    KeyUnit::with_unit("pose_change", Dimension::Time, "s"),
];

/// What is asked; none without `[question]`. `hides` is true where an effect is hidden.
pub(super) fn question(
    top: &TomlSection<'_>,
    task: SweepTask,
    hides: bool,
) -> Result<Option<Question>, Fault> {
    let Some(item) = top.get("question") else { return Ok(None) };
    let t = item.section("[question]", QUESTION)?;
    let mut asked = QUESTION.iter().filter_map(|key| Some((key.name(), t.get(key.name())?)));
    let Some((key, value)) = asked.next() else {
        return Err(item.breaks("the question is missing", "Write for example see = 0.9."));
    };
    if let Some((_, other)) = asked.next() {
        return Err(other.breaks("a study has one question", "Move it to a separate study."));
    }
    let needs = if matches!(key, "see" | "name") { SweepTask::Diagnose } else { SweepTask::Springs };
    if task != needs {
        let next = format!("Write task = \"{}\", or choose another question.", needs.name());
        return Err(value.breaks(format!("task = \"{}\" cannot answer this question", task.name()), next));
    }
    Ok(Some(match key {
        "see" => Question::Share(Counted::Seen, wanted(value, hides)?),
        "name" => Question::Share(Counted::Of(Fate::Right), wanted(value, hides)?),
        "error_percent" => Question::Error(value.positive("an error")?),
        _ => index(value)?,
    }))
}

/// What is given in a question has a few values: the answer is one sentence for each.
pub(super) fn refuse_ranges<G, P>(top: &TomlSection<'_>, axes: &Axes<G, P>) -> Result<(), Fault> {
    let Some(item) = top.get("question") else { return Ok(()) };
    let given = [
        (place::SIZE, axes.size.name()),
        (place::NOISE, axes.noise.name()),
        (place::TOLERANCE, TOLERANCE_SCALE),
    ];
    match given.into_iter().find(|(axis, _)| axes.is_ranged(*axis)) {
        None => Ok(()),
        Some((_, name)) => {
            let next = format!(
                "Write a list of values for {name}, or remove [question]: poses and repeats may be ranges."
            );
            Err(item.breaks(format!("each value of {name} gets an answer, so it cannot be a range"), next))
        }
    }
}

/// A share of trials with a hidden effect.
fn wanted(item: &Item<'_>, hides: bool) -> Result<f64, Fault> {
    let share = item.number()?;
    if !(share > 0.0 && share < 1.0) {
        return Err(item.breaks("a share lies between 0 and 1", "Write for example 0.9."));
    }
    if !hides {
        let next = "Add effect to [axes], for example effect = [\"base-compliance\"].";
        return Err(item.breaks("no effect is hidden that could be detected", next));
    }
    Ok(share)
}

fn index(item: &Item<'_>) -> Result<Question, Fault> {
    match item.string()? {
        "error" => Ok(Question::Index),
        _ => Err(item.breaks("an index can only predict the stiffness error", "Write index = \"error\".")),
    }
}

/// Half width at which a cell stops; none without `until`.
pub(super) fn until(
    top: &TomlSection<'_>,
    question: Option<Question>,
    trials: &Item<'_>,
    task: SweepTask,
) -> Result<Option<f64>, Fault> {
    let Some(item) = top.get("until") else { return Ok(None) };
    let half_width = item.section("until", UNTIL)?.require("half_width")?.positive("a half width")?;
    if !matches!(question, Some(Question::Share(..) | Question::Error(_))) {
        let next = "Add [question] with see, name or error_percent.";
        return Err(item.breaks("cells stop when the question is decided, but there is no question", next));
    }
    let (most, shard) = (trials.whole(1)?, task.trials_of_a_shard());
    if most % shard != 0 {
        let next = format!("Write {}.", most.div_ceil(shard) * shard);
        return Err(trials.breaks(format!("with until, trials must be a multiple of {shard}"), next));
    }
    Ok(Some(half_width))
}

/// What the parts of a plan cost; none without `[cost]`.
pub(super) fn cost(top: &TomlSection<'_>) -> Result<Option<Budget>, Fault> {
    let Some(item) = top.get("cost") else { return Ok(None) };
    let t = item.section("[cost]", COST)?;
    let seconds = |name: &str| t.get(name).map_or(Ok(0.0), |item| item.positive("a time"));
    Ok(Some(Budget {
        limit: None,
        reading: seconds("reading")?,
        load_change: seconds("load_change")?,
        pose_change: seconds("pose_change")?,
    }))
}
