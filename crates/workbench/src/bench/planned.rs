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
    Effort, Proposal, ProposedReadings, RivalExplanation, candidate_readings, choose_readings,
    detectable_after, forecasts, propose,
};

use super::digits::short;
use super::refusal::Refusal;
use super::{LoadedCampaign, files, run_sheet};
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

    fn chosen(&self, choice: &ReadingChoice) -> Result<ProposedReadings, ModelError> {
        let Some(number) = choice.number else { return Ok(self.proposed.clone()) };
        let candidates = candidate_readings(&self.campaign, &self.rivals)?;
        propose(&self.campaign, &self.rivals, &candidates, Effort::Exactly(number))
    }

    /// How many readings can be taken in a time, s, the most useful ones first.
    fn fitting(&self, pace: &MeasuringPace, seconds: f64) -> Result<usize, ModelError> {
        let candidates = candidate_readings(&self.campaign, &self.rivals)?;
        let effort = Effort::Exactly(MOST_READINGS);
        let readings = choose_readings(&self.campaign, &self.rivals, &candidates, effort)?;
        let fits = |number: &usize| time(&readings[..*number], pace).1 <= seconds;
        Ok((1..=readings.len()).take_while(fits).last().unwrap_or(0))
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
        let readings = one_by_one(&proposed);
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
        if self.visible_now.get().is_none() {
            // Another request may have been faster; both found the same.
            let _ = self.visible_now.set(after(&[])?);
        }
        let now = self.visible_now.get().map_or(&[][..], Vec::as_slice);
        let readings = one_by_one(proposed);
        let planned = if readings.is_empty() { now.to_vec() } else { after(&readings)? };
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

/// Every reading as often as it is taken.
fn one_by_one(proposed: &ProposedReadings) -> Vec<Observation> {
    let each = |p: &Proposal| std::iter::repeat_n(p.observation, p.repeats);
    proposed.proposals.iter().flat_map(each).collect()
}

/// Poses of the readings taken, and the time that these take, s.
fn time(readings: &[Observation], pace: &MeasuringPace) -> (usize, f64) {
    let poses: HashSet<[u64; 6]> =
        readings.iter().map(|o| o.pose.to_array().map(|x| (x + 0.0).to_bits())).collect();
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
        let ask = Ask { own: asked.own.clone(), exclude: asked.exclude.clone() };
        let doubt = self.doubt(&ask)?;
        let proposed = match asked.hours {
            Some(hours) => self.within(&doubt, asked, hours)?,
            None => self.proposed(&doubt, &asked.choice)?,
        };
        checked(&asked.pace)?;
        let visible = doubt.visible(&proposed).map_err(|cause| self.refused(&cause))?;
        let (poses, seconds) = time(&one_by_one(&proposed), &asked.pace);
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
            let study = self.study(&ask.own, &ask.exclude)?;
            Ok(Doubt::of(study, files::terms_with(&ask.own, &self.limits)?))
        })
    }

    fn proposed(&self, doubt: &Doubt, choice: &ReadingChoice) -> Result<ProposedReadings, Refusal> {
        let all = choice.number.unwrap_or(0).max(choice.repeats.iter().fold(0, |a, &b| a.saturating_add(b)));
        if all > MOST_READINGS || choice.number == Some(0) {
            let rule = format!("a plan of {all} readings; from 1 to {MOST_READINGS} are accepted");
            return Err(Refusal::bad_input(rule, "Choose another number."));
        }
        let proposed = doubt.chosen(choice).map_err(|cause| self.refused(&cause))?;
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

    /// As many readings as fit in a time.
    fn within(&self, doubt: &Doubt, asked: &PlanReadings, hours: f64) -> Result<ProposedReadings, Refusal> {
        checked(&asked.pace)?;
        if asked.choice != ReadingChoice::default() {
            let rule = "a number of readings and hours for them";
            return Err(Refusal::bad_input(rule, "Ask for one of the two."));
        }
        if !(hours > 0.0 && hours <= MOST_HOURS) {
            let rule = format!("a plan for {hours} hours");
            return Err(Refusal::bad_input(rule, "Enter the hours available, for example 2."));
        }
        let number = doubt.fitting(&asked.pace, hours * 3600.0).map_err(|cause| self.refused(&cause))?;
        if number == 0 && doubt.rivals.len() > 1 {
            let rule = format!("{hours} hours are too short for one reading");
            return Err(Refusal::bad_input(rule, "Enter more hours, or shorter times of a reading."));
        }
        let choice = ReadingChoice { number: Some(number).filter(|n| *n > 0), repeats: Vec::new() };
        self.proposed(doubt, &choice)
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

/// Refuses times that are none.
fn checked(pace: &MeasuringPace) -> Result<(), Refusal> {
    let times = [pace.reading_s, pace.load_change_s, pace.pose_change_s];
    if times.iter().all(|seconds| (0.0..=MOST_HOURS * 3600.0).contains(seconds)) {
        return Ok(());
    }
    let rule = format!("times of {times:?} s for a reading, a change of load and a change of pose");
    Err(Refusal::bad_input(rule, "Enter times in seconds, 0 or more."))
}
