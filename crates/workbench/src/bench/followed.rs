//! The residuals of a model and what they follow: the leading panels.

use std::time::Instant;

use hexbench_model::estimation::campaign::Condition;
use hexbench_model::results::compare::JudgedModel;
use hexbench_model::results::compare::association::associations;
use hexbench_model::results::compare::story::{StoryPanel, story};

use super::LoadedCampaign;
use super::counted::Counted;
use super::digits::short;
use super::refusal::Refusal;
use crate::wire::{Followed, FollowedPanel, Selection};

impl LoadedCampaign {
    /// What the residuals of springs with the selected terms follow, the most significant first.
    ///
    /// # Errors
    /// [`Refusal`] for a term that is unknown, and for a model that cannot be fitted.
    pub fn followed(&self, selection: &Selection) -> Result<Followed, Refusal> {
        let since = Instant::now();
        let counted = Counted::of(self, &selection.exclude)?;
        let task = counted.task();
        let fit = &self.judged(&counted, selection)?.fit;
        let judged = JudgedModel::of(task.campaign, task.data, &fit.point, true)
            .map_err(|cause| self.refused(&cause))?;
        let seen = judged.space.is_complete();
        let found = if seen { story(&judged, &associations(&judged)) } else { Vec::new() };
        let all = counted.all_beside(fit)?;
        let conditions = all.as_ref().map_or(&judged.lin.conditions, |(_, lin)| &lin.conditions);
        let shown: Vec<&Condition> = self.shown.iter().map(|&i| &conditions[i]).collect();
        Ok(Followed {
            panels: found.iter().map(|panel| told(panel, &shown)).collect(),
            seen,
            milliseconds: since.elapsed().as_secs_f64() * 1e3,
        })
    }
}

fn told(panel: &StoryPanel, shown: &[&Condition]) -> FollowedPanel {
    let places =
        |at: &&Condition| std::array::from_fn(|leg| panel.place(at, leg).map(|place| place.map(short)));
    FollowedPanel {
        association: panel.association.clone(),
        title: panel.title,
        unit: panel.unit,
        places: shown.iter().map(places).collect(),
        bins: panel.bins.iter().map(|b| [b.x, b.mean, b.std].map(short)).collect(),
        course: panel.course.iter().map(|point| point.map(short)).collect(),
    }
}
