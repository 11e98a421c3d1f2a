//! The smallest effects that a campaign would show after some more readings.

use std::borrow::Cow;
use std::sync::Arc;

use hexbench_core::Observation;

use super::belief::as_plan;
use crate::effects::term::Term;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::Fit;
use crate::estimation::linearization::{Active, Linearization, ModelPoint};
use crate::estimation::tolerances::within_tolerances_of;
use crate::inference::candidates::Candidate;
use crate::inference::diagnosis::visible;
use crate::inference::evidence::{Gram, Variant};
use crate::inference::power::{Detectable, detectable};

/// The smallest effects that the readings in hand and these further ones would show, beside the effects of a fit. A reading that is listed
/// twice is read twice; what it will measure matters in second order only.
///
/// # Errors
/// [`ModelError::SingularPose`].
pub fn detectable_after(
    campaign: &Campaign,
    fit: &Fit,
    terms: &[Arc<dyn Term>],
    readings: &[Observation],
) -> Result<Vec<Detectable>, ModelError> {
    let mut all = Cow::Borrowed(campaign);
    if !readings.is_empty() {
        let both = campaign.followed_by(&foreseen(as_plan(campaign, readings)?, &fit.point)?);
        // Inputs that are off are off by the same in all readings.
        all = Cow::Owned(within_tolerances_of(campaign, both));
    }
    let (gram, candidates, _) = visible(&all, fit, terms)?;
    let beside = fit.point.active.iter().filter_map(|active| widest(active, &gram, &candidates));
    Ok(detectable(&gram, &candidates, &beside.collect::<Vec<_>>()))
}

/// Readings as a model foresees them: scans for periods look at what it leaves.
fn foreseen(mut plan: Campaign, point: &ModelPoint) -> Result<Campaign, ModelError> {
    let lin = Linearization::at(&plan, point)?;
    for (i, group) in plan.groups.iter_mut().enumerate() {
        let missed = -lin.conditions[i].weights.numbers(lin.residual(i));
        group.mean.measured = plan.axes.moved(&group.mean.measured, &missed.into());
    }
    Ok(plan)
}

/// The form of an effect nearest to its shape in a model, as wide as can be.
fn widest(active: &Active, gram: &Gram, candidates: &[Candidate]) -> Option<Variant> {
    let candidate = candidates.iter().find(|c| c.id() == Some(active.id()))?;
    let off = |block: usize| (gram.blocks[block].shape / active.shape).ln().abs();
    let block = candidate.blocks.iter().copied().min_by(|&a, &b| off(a).total_cmp(&off(b)))?;
    (!gram.blocks[block].widths.is_empty()).then_some(Variant { block, width: 0 })
}
