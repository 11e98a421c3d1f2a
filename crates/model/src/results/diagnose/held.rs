//! Readings held out, as the measurements and the other readings held out leave them.

use hexbench_core::Dataset;

use super::judged::Judged;
use crate::estimation::foreseen::held_out_residuals;
use crate::estimation::residuals::{Residual, typical_square};
use crate::inference::examination::{Finding, FindingKind};
use crate::inference::verdict::DOUBT;

/// A number farther from what is foreseen, in standard deviations of a reading, is none that can have been read.
const IMPOSSIBLE: f64 = 10.0;
/// Where the other numbers of its row are no farther, it is a mistake and not something that the model lacks.
const USUAL: f64 = 4.0;
/// Square of how far most readings may be, over that of the noise: farther, and the model lacks something.
const EXPLAINED: f64 = 2.0;
/// One row in so many may be wrong.
const MOST_WRONG: usize = 10;

impl Judged {
    /// Readings held out, of the instrument as it was found, and what is wrong with some of them, which are left out.
    pub(super) fn soundly_held(&self, held: &Dataset) -> (Dataset, Option<Finding>) {
        let alike = self.read_alike(held);
        let foreseen = held_out_residuals(&self.campaign, &alike, &self.outcome.best.point);
        // What follows a pattern that no effect has is not foreseen either, and may show in one number alone.
        let lacks = self.outcome.sets.outside() >= DOUBT || self.outcome.simplest_pattern().is_some();
        let may_judge = !lacks && self.campaign.noise.allows_verdict();
        let Some(left) = foreseen.ok().filter(|_| may_judge) else { return (alike, None) };
        let wrong: Vec<&Residual> = left.iter().filter(|row| is_mistake(row)).collect();
        let are_few = (1..=left.len() / MOST_WRONG).contains(&wrong.len());
        if self.instrument.tails.is_some() || !are_few || typical_square(&left) > EXPLAINED {
            return (self.instrument.weighed(alike, &self.campaign.noise, &left), None);
        }
        let finding = mistaken(&alike, &wrong);
        let is_sound = |row: &usize| wrong.iter().all(|wrong| wrong.row != *row);
        let observations = (0..alike.observations.len()).filter(is_sound).map(|row| alike.observations[row]);
        (Dataset { observations: observations.collect(), ..alike.clone() }, Some(finding))
    }
}

/// True where one number of a row is off, and no other.
fn is_mistake(row: &Residual) -> bool {
    let beyond = |least: f64| row.whitened.iter().filter(|z| z.abs() > least).count();
    beyond(IMPOSSIBLE) == 1 && beyond(USUAL) == 1 && row.numbers() > 1
}

/// What is said of mistakes.
fn mistaken(held: &Dataset, wrong: &[&Residual]) -> Finding {
    let lines: Vec<String> = wrong.iter().map(|row| held.observations[row.row].line.to_string()).collect();
    let farthest = wrong.iter().map(|row| row.farthest().abs()).fold(0.0, f64::max);
    let size = format!("{farthest:.0} sigma");
    let off = "from what the measurements foresee, and no other number";
    Finding {
        text: match lines.as_slice() {
            [line] => format!(
                "one number in line {line} of the held-out file is {size} {off} of this line is: the line is left out"
            ),
            _ => format!(
                "one number in each of lines {} of the held-out file is up to {size} {off} of these lines is: they are left out",
                lines.join(", ")
            ),
        },
        size,
        next: "check the record of what is left out".to_owned(),
        ..Finding::of(FindingKind::Holdout)
    }
}
