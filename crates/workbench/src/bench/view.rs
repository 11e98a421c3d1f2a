//! The fit of springs and selected terms: errors, parameters, residuals.

use std::sync::Arc;
use std::time::Instant;

use hexbench_core::Hexapod;
use hexbench_model::effects::term::Term;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::estimate::{Estimates, stiffness_of};
use hexbench_model::estimation::fit::Fit;
use hexbench_model::estimation::fit_named::{Added, look_alikes};
use hexbench_model::estimation::foreseen::held_campaign;
use hexbench_model::estimation::linearization::Linearization;
use hexbench_model::estimation::parameters::leg_of_stiffness;
use hexbench_model::estimation::scatter::ResidualScatter;
use hexbench_model::inference::selection::{FitInDetail, FitWithErrors, JudgedTask};
use hexbench_model::results::compare::legs::leg_space;

use super::conditions::{motion, shown};
use super::counted::Counted;
use super::digits::{all_short, short};
use super::refusal::Refusal;
use super::{LoadedCampaign, files};
use crate::wire::{self, HeldOutReadings, Leg, LookAlike, Selection, View};

/// Correlation from which two numbers are told to look alike.
const TOLD: f64 = 0.9;
/// Most pairs told.
const MOST_TOLD: usize = 12;

/// The terms of these ids.
pub(super) fn selected(ids: &[String], all: &[Arc<dyn Term>], data: &str) -> Result<Vec<Added>, Refusal> {
    let named = |id: &String| Added::named(id, all).map_err(|cause| Refusal::model(&cause, data));
    ids.iter().map(named).collect()
}

impl LoadedCampaign {
    /// The terms of a selection.
    pub(super) fn chosen(&self, selection: &Selection) -> Result<Vec<Added>, Refusal> {
        let terms = files::terms_with(&selection.own, &self.limits)?;
        selected(&selection.terms, &terms, &self.contents.data.source)
    }
}

/// Readings of the holdout file in the frames of a fit, linearized there; none without such a file.
pub(super) fn held_out(task: &JudgedTask<'_>, fit: &Fit) -> Option<(Campaign, Linearization)> {
    let held = held_campaign(task.campaign, task.holdout?, &fit.point).ok()?;
    let lin = Linearization::at(&held, &fit.point).ok()?;
    Some((held, lin))
}

fn held_out_readings(task: &JudgedTask<'_>, fit: &Fit) -> Option<HeldOutReadings> {
    let (held, lin) = held_out(task, fit)?;
    let legs = leg_space(&held, &lin);
    let mut all = HeldOutReadings::default();
    for i in shown(lin.conditions.len()) {
        all.residual_um.push(all_short(legs.elongation[i] * 1e6));
        all.predicted.push(all_short(lin.predicted(i) * 1e6));
        all.measured.push(all_short(lin.conditions[i].reading * 1e6));
    }
    Some(all)
}

/// What is seen of a fit; `since` the question was asked.
pub(super) fn view(
    counted: &Counted<'_>,
    asked: &Selection,
    fitted: &FitInDetail,
    of: &[usize],
    since: Instant,
) -> Result<View, Refusal> {
    let (task, judged) = (&counted.task(), &fitted.judged);
    let all = counted.all_beside(&judged.fit)?;
    let (campaign, lin) = all.as_ref().map_or((task.campaign, &fitted.linearization), |(c, lin)| (c, lin));
    let legs = leg_space(campaign, lin);
    let error = judged.error();
    let numbers = judged.estimates();
    let predictions: Vec<_> = of.iter().map(|&i| lin.predicted(i)).collect();
    let scatter = ResidualScatter::of(&judged.residuals);
    Ok(View {
        terms: asked.terms.clone(),
        fitted: judged.fitted,
        holdout: judged.held_out.as_ref().map(|held_out| held_out.summary),
        held_out: task.held_out(),
        times_noise: error.times_noise(),
        band: error.band(),
        chance: judged.held_out.as_ref().and_then(|held_out| held_out.chance),
        at_the_noise: judged.is_at_the_noise(),
        by_tolerances: judged.is_at_the_noise() && !error.is_at_the_noise(),
        legs: of_legs(&numbers, task.hexapod),
        parameters: numbers.determined.into_iter().filter(|e| leg_of_stiffness(&e.name).is_none()).collect(),
        not_determined: numbers.not_determined,
        look_alikes: alike(judged),
        residual_um: of.iter().map(|&i| all_short(legs.elongation[i] * 1e6)).collect(),
        predicted: predictions.iter().map(|p| all_short(p * 1e6)).collect(),
        predicted_motion: of.iter().zip(&predictions).map(|(&i, p)| motion(&lin.conditions[i], p)).collect(),
        held_out_readings: held_out_readings(task, &judged.fit),
        scatter: wire::ReadingResiduals {
            histogram: points(scatter.histogram()),
            quantiles: points(scatter.quantiles()),
            extremes: counted.extremes(&judged.residuals, of),
        },
        milliseconds: since.elapsed().as_secs_f64() * 1e3,
    })
}

fn points(all: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    all.into_iter().map(|point| point.map(short)).collect()
}

fn of_legs(numbers: &Estimates, hexapod: &Hexapod) -> [Leg; 6] {
    std::array::from_fn(|leg| {
        let known = stiffness_of(&numbers.determined, leg);
        Leg {
            stiffness: known.map(|e| e.value),
            std: known.map(|e| e.std),
            nominal: hexapod.nominal_stiffness.map(|k| 1e-6 * k[leg]),
        }
    })
}

fn alike(judged: &FitWithErrors) -> Vec<LookAlike> {
    let pairs = look_alikes(&judged.fit, TOLD).into_iter().filter(|(.., r)| r.is_finite());
    pairs.take(MOST_TOLD).map(|(a, b, correlation)| LookAlike { a, b, correlation }).collect()
}
