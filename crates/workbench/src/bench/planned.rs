//! The readings to take next, as many and as often as somebody wants, what they promise and how long they take.

use std::collections::HashSet;
use std::sync::{Arc, OnceLock};
use std::time::Instant;

use hexbench_core::Observation;
use hexbench_design::Budget;
use hexbench_design::space::{Loading, Setting};
use hexbench_model::effects::term::Term;
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::Fit;
use hexbench_model::inference::power::Detectable;
use hexbench_model::results::diagnose::{DiagnosisStudy, NextReadings, NextReport};
use hexbench_model::results::next::{
    Effort, ProposedReadings, RivalExplanation, candidate_readings, detectable_after, forecasts, propose,
};
use hexbench_report::table::run_sheet;

use super::digits::short;
use super::refusal::Refusal;
use super::{LoadedCampaign, files};
use crate::wire::{Ask, MeasuringPace, PlanReadings, PlannedReadings, ReadingChoice, VisibleSize};

/// Readings of a plan at most, with their repeats: a day at the machine.
const MOST_READINGS: usize = 60;
/// Longest time that anybody measures, h.
const MOST_HOURS: f64 = 1e4;

/// The explanations that a diagnosis leaves, and the readings it proposes to separate them.
pub(super) struct Doubt {
    campaign: Campaign,
    rivals: Vec<RivalExplanation>,
    proposed: ProposedReadings,
    /// The last model, and the effects that may show beside it.
    fit: Fit,
    terms: Vec<Arc<dyn Term>>,
    /// What the measurements alone show, once somebody has asked.
    visible_now: OnceLock<Vec<Detectable>>,
}

impl Doubt {
    /// What a diagnosis with these terms leaves.
    pub(super) fn of(study: DiagnosisStudy, terms: Vec<Arc<dyn Term>>) -> Self {
        let DiagnosisStudy { campaign, rivals, proposed, mut fits, outcome, .. } = study;
        let fit = fits.pop().unwrap_or(outcome.baseline);
        Self { campaign, rivals, proposed, fit, terms, visible_now: OnceLock::new() }
    }

    fn chosen(&self, effort: Effort<'_>) -> Result<ProposedReadings, ModelError> {
        let candidates = candidate_readings(&self.campaign, &self.rivals)?;
        propose(&self.campaign, &self.rivals, &candidates, effort)
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
        let readings = proposed.one_by_one();
        proposed.forecasts = if readings.is_empty() {
            Vec::new()
        } else {
            forecasts(&self.campaign, &self.rivals, &readings)?
        };
        Ok(proposed)
    }

    /// The smallest effects that show now and with these readings.
    fn visible(&self, proposed: &ProposedReadings) -> Result<Vec<VisibleSize>, ModelError> {
        let after =
            |readings: &[Observation]| detectable_after(&self.campaign, &self.fit, &self.terms, readings);
        let now = if let Some(known) = self.visible_now.get() {
            known
        } else {
            let found = after(&[])?;
            self.visible_now.get_or_init(|| found)
        };
        let readings = proposed.one_by_one();
        let planned = if readings.is_empty() { now.clone() } else { after(&readings)? };
        let before = |of: &Detectable| {
            let same = now.iter().find(|old| old.term == of.term && old.parameter == of.parameter);
            same.and_then(|old| old.size_at_90_percent_power)
        };
        let size = |of: Detectable| VisibleSize {
            now: before(&of),
            planned: of.size_at_90_percent_power,
            term: of.term,
            parameter: of.parameter,
            unit: of.unit,
        };
        Ok(planned.into_iter().map(size).collect())
    }
}

/// Poses of the readings taken, and the time that these take, s.
fn time(readings: &[Observation], pace: &MeasuringPace) -> (usize, f64) {
    let poses: HashSet<[u64; 6]> = readings.iter().map(|o| o.pose.bits()).collect();
    let settings: Vec<Setting> = readings.iter().map(setting).collect();
    let &MeasuringPace { reading_s: reading, load_change_s: load_change, pose_change_s: pose_change } = pace;
    let budget = Budget { limit: None, reading, load_change, pose_change };
    (poses.len(), budget.time(poses.len(), &settings))
}

fn setting(o: &Observation) -> Setting {
    let loading = Loading { reference: o.reference, load: o.wrench };
    Setting { loading, approach: o.approach, delta_t: o.delta_t, elapsed: o.elapsed }
}

impl LoadedCampaign {
    /// The readings to take next, what they promise of the explanations that remain, which effects they show, and how long they take.
    ///
    /// # Errors
    /// [`Refusal`] for more readings than a plan may have, for repeats of other readings than are proposed, and for times that are none
    /// or too short for one reading.
    pub fn plan(&self, asked: &PlanReadings) -> Result<PlannedReadings, Refusal> {
        let since = Instant::now();
        checked(asked)?;
        let ask = Ask { own: asked.own.clone(), exclude: asked.exclude.clone() };
        let doubt = self.doubt(&ask)?;
        let proposed = match asked.hours {
            Some(hours) => self.within(&doubt, &asked.pace, hours)?,
            None => self.proposed(&doubt, &asked.choice)?,
        };
        let visible = doubt.visible(&proposed).map_err(|cause| self.refused(&cause))?;
        let (poses, seconds) = time(&proposed.one_by_one(), &asked.pace);
        let next = NextReadings::of(&proposed, &doubt.rivals);
        Ok(PlannedReadings {
            platform_joints_mm: next.readings.iter().map(|reading| self.joints_mm(reading)).collect(),
            next: next.readings,
            separation: next.separation,
            visible,
            poses,
            seconds,
            milliseconds: since.elapsed().as_secs_f64() * 1e3,
        })
    }

    /// The readings chosen, those left out with no repeats.
    pub(super) fn next(&self, ask: &Ask, choice: &ReadingChoice) -> Result<NextReadings, Refusal> {
        let doubt = self.doubt(ask)?;
        Ok(NextReadings::of(&self.proposed(&doubt, choice)?, &doubt.rivals))
    }

    fn doubt(&self, ask: &Ask) -> Result<Arc<Doubt>, Refusal> {
        self.doubts.answer(ask, || {
            let terms = files::terms_with(&ask.own, &self.limits)?;
            Ok(Doubt::of(self.study(&terms, &ask.exclude)?, terms))
        })
    }

    fn proposed(&self, doubt: &Doubt, choice: &ReadingChoice) -> Result<ProposedReadings, Refusal> {
        let all = choice.number.unwrap_or(0).max(choice.repeats.iter().fold(0, |a, &b| a.saturating_add(b)));
        if all > MOST_READINGS || choice.number == Some(0) {
            let rule = format!("a plan of {all} readings; from 1 to {MOST_READINGS} are accepted");
            return Err(Refusal::bad_input(rule, "Choose another number."));
        }
        let proposed = match choice.number {
            Some(number) => doubt.chosen(Effort::Exactly(number)).map_err(|cause| self.refused(&cause))?,
            None => doubt.proposed.clone(),
        };
        if choice.repeats.is_empty() {
            return Ok(proposed);
        }
        let (proposals, repeats) = (proposed.proposals.len(), choice.repeats.len());
        if proposals != repeats {
            let rule = format!("repeats of {repeats} readings, but {proposals} are proposed");
            return Err(Refusal::bad_input(rule, "Ask for the plan first, then change its repeats."));
        }
        doubt.repeated(proposed, &choice.repeats).map_err(|cause| self.refused(&cause))
    }

    /// As many readings as fit in a time, the most useful ones first.
    fn within(&self, doubt: &Doubt, pace: &MeasuringPace, hours: f64) -> Result<ProposedReadings, Refusal> {
        let fits = |readings: &[Observation]| time(readings, pace).1 <= hours * 3600.0;
        let proposed =
            doubt.chosen(Effort::Within(MOST_READINGS, &fits)).map_err(|cause| self.refused(&cause))?;
        if proposed.proposals.is_empty() && doubt.rivals.len() > 1 {
            let rule = format!("{hours} hours are too short for one reading");
            return Err(Refusal::bad_input(rule, "Enter more hours, or shorter times of a reading."));
        }
        Ok(proposed)
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

/// Refuses times that are none, and hours beside a choice.
fn checked(asked: &PlanReadings) -> Result<(), Refusal> {
    let &MeasuringPace { reading_s, load_change_s, pose_change_s } = &asked.pace;
    let times = [reading_s, load_change_s, pose_change_s];
    if !times.iter().all(|seconds| (0.0..=MOST_HOURS * 3600.0).contains(seconds)) {
        let rule = format!("times of {times:?} s for a reading, a change of load and a change of pose");
        return Err(Refusal::bad_input(rule, "Enter times in seconds, 0 or more."));
    }
    let Some(hours) = asked.hours else { return Ok(()) };
    if asked.choice != ReadingChoice::default() {
        let rule = "a number of readings and hours for them";
        return Err(Refusal::bad_input(rule, "Ask for one of the two."));
    }
    if !(hours > 0.0 && hours <= MOST_HOURS) {
        let rule = format!("a plan for {hours} hours");
        return Err(Refusal::bad_input(rule, "Enter the hours available, for example 2."));
    }
    Ok(())
}
