//! The readings to take next, as many and as often as somebody wants, and what they promise.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use hexbench_core::Observation;
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::results::diagnose::{DiagnosisStudy, NextReadings, NextReport};
use hexbench_model::results::next::{
    Effort, Proposal, ProposedReadings, RivalExplanation, candidate_readings, forecasts, propose,
};

use super::digits::short;
use super::refusal::Refusal;
use super::{LoadedCampaign, run_sheet};
use crate::wire::{Ask, PlanReadings, PlannedReadings, ReadingChoice};

/// Readings of a plan at most, with their repeats: a day at the machine.
const MOST_READINGS: usize = 60;

/// The explanations that a diagnosis leaves, and the readings it proposes to separate them.
#[derive(Debug)]
pub(super) struct Doubt {
    campaign: Campaign,
    rivals: Vec<RivalExplanation>,
    proposed: ProposedReadings,
}

/// That of the last diagnosis, so that a change of the plan weighs nothing again.
#[derive(Debug, Default)]
pub(super) struct LastDoubt(Mutex<Option<(Ask, Arc<Doubt>)>>);

impl LastDoubt {
    /// Keeps that of a diagnosis.
    pub(super) fn keep(&self, ask: &Ask, doubt: Doubt) -> Arc<Doubt> {
        let doubt = Arc::new(doubt);
        *self.lock() = Some((ask.clone(), Arc::clone(&doubt)));
        doubt
    }

    fn of(&self, ask: &Ask) -> Option<Arc<Doubt>> {
        self.lock().as_ref().filter(|(of, _)| of == ask).map(|(_, doubt)| Arc::clone(doubt))
    }

    fn lock(&self) -> MutexGuard<'_, Option<(Ask, Arc<Doubt>)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Doubt {
    /// What a diagnosis leaves.
    pub(super) fn of(study: DiagnosisStudy) -> Self {
        let DiagnosisStudy { campaign, rivals, proposed, .. } = study;
        Self { campaign, rivals, proposed }
    }

    fn chosen(&self, choice: &ReadingChoice) -> Result<ProposedReadings, ModelError> {
        let Some(number) = choice.number else { return Ok(self.proposed.clone()) };
        let candidates = candidate_readings(&self.campaign, &self.rivals)?;
        propose(&self.campaign, &self.rivals, &candidates, Effort::Exactly(number))
    }

    /// The same readings, each so often.
    fn repeated(
        &self,
        mut proposed: ProposedReadings,
        repeats: &[usize],
    ) -> Result<ProposedReadings, ModelError> {
        for (proposal, &repeats) in proposed.proposals.iter_mut().zip(repeats) {
            proposal.repeats = repeats;
        }
        let each = |p: &Proposal| std::iter::repeat_n(p.observation, p.repeats);
        let readings: Vec<Observation> = proposed.proposals.iter().flat_map(each).collect();
        proposed.forecasts = if readings.is_empty() {
            Vec::new()
        } else {
            forecasts(&self.campaign, &self.rivals, &readings)?
        };
        Ok(proposed)
    }
}

impl LoadedCampaign {
    /// The readings to take next, and what they promise of the explanations that remain.
    ///
    /// # Errors
    /// [`Refusal`] for more readings than a plan may have, and for repeats of other readings than are proposed.
    pub fn plan(&self, asked: &PlanReadings) -> Result<PlannedReadings, Refusal> {
        let since = Instant::now();
        let ask = Ask { own: asked.own.clone(), exclude: asked.exclude.clone() };
        let next = self.next(&ask, &asked.choice)?;
        Ok(PlannedReadings {
            platform_joints_mm: next.readings.iter().map(|reading| self.joints_mm(reading)).collect(),
            next: next.readings,
            separation: next.separation,
            milliseconds: since.elapsed().as_secs_f64() * 1e3,
        })
    }

    /// The readings chosen, those left out with no repeats.
    pub(super) fn next(&self, ask: &Ask, choice: &ReadingChoice) -> Result<NextReadings, Refusal> {
        let all = choice.number.unwrap_or(0).max(choice.repeats.iter().fold(0, |a, &b| a.saturating_add(b)));
        if all > MOST_READINGS || choice.number == Some(0) {
            let rule = format!("a plan of {all} readings; from 1 to {MOST_READINGS} are accepted");
            return Err(Refusal::bad_input(rule, "Choose another number."));
        }
        let doubt = match self.doubts.of(ask) {
            Some(doubt) => doubt,
            None => self.doubts.keep(ask, Doubt::of(self.study(&ask.own, &ask.exclude)?)),
        };
        let refused = |cause| Refusal::model(&cause, &self.contents.data.source);
        let mut proposed = doubt.chosen(choice).map_err(refused)?;
        if !choice.repeats.is_empty() {
            let (proposals, repeats) = (proposed.proposals.len(), choice.repeats.len());
            if proposals != repeats {
                let rule = format!("repeats of {repeats} readings, but {proposals} are proposed");
                return Err(Refusal::bad_input(rule, "Ask for the plan first, then change its repeats."));
            }
            proposed = doubt.repeated(proposed, &choice.repeats).map_err(refused)?;
        }
        Ok(NextReadings::of(&proposed, &doubt.rivals))
    }

    /// Platform joints at a reading, before the load.
    fn joints_mm(&self, reading: &NextReport) -> [[f64; 3]; 6] {
        let pose = run_sheet::pose(reading);
        let (rotation, [x, y, z, ..]) = (pose.rotation(), pose.to_array());
        self.contents.hexapod.platform_joints.map(|joint| {
            let turned = rotation * joint;
            [turned.x + x, turned.y + y, turned.z + z].map(|along| short(along * 1e3))
        })
    }
}
