//! The readings of a fit where it ended: what is kept of conditions of which some are made at a time.

use std::ops::Range;

use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::equations::{Equations, PartOfEquations};
use crate::estimation::linearization::{Linearization, ModelPoint};
use crate::inference::discrepancy::{LegDiscrepancy, LegReadings};

/// Equations of a campaign at a point, and what its readings of the legs hang on there.
pub(crate) struct SeenReadings {
    pub(crate) equations: Equations,
    /// None where what is left of the legs cannot be told from the noise.
    legs: Vec<LegReadings>,
}

type Part = (PartOfEquations, Vec<LegReadings>);

impl SeenReadings {
    /// Of a campaign; nothing is kept of the conditions.
    ///
    /// # Errors
    /// As [`Linearization::at`].
    pub(crate) fn at(campaign: &Campaign, point: &ModelPoint) -> Result<Self, ModelError> {
        let mut seen = Self::awaited(campaign, point);
        Linearization::in_parts(campaign, point, part_of(campaign, point), |part| seen.put(part))?;
        Ok(seen)
    }

    /// The same with the model there, without what columns of other terms need.
    ///
    /// # Errors
    /// As [`Linearization::at`].
    pub(crate) fn with_model(
        campaign: &Campaign,
        point: &ModelPoint,
    ) -> Result<(Self, Linearization), ModelError> {
        let mut seen = Self::awaited(campaign, point);
        let lin = Linearization::at_fit(campaign, point, part_of(campaign, point), |part| seen.put(part))?;
        Ok((seen, lin))
    }

    fn awaited(campaign: &Campaign, point: &ModelPoint) -> Self {
        Self { equations: Equations::awaited(campaign, point), legs: Vec::new() }
    }

    fn put(&mut self, (equations, legs): Part) {
        self.equations.put(equations);
        self.legs.extend(legs);
    }

    /// What a fit that ended there leaves of the legs beyond the noise.
    pub(crate) fn left(&self, campaign: &Campaign, dof: f64) -> LegDiscrepancy {
        if self.legs.is_empty() {
            return LegDiscrepancy::default();
        }
        LegDiscrepancy::in_legs(campaign, &self.legs, &self.equations.residuals(), dof)
    }
}

/// What is made of some of the conditions.
fn part_of(
    campaign: &Campaign,
    point: &ModelPoint,
) -> impl Fn(&Linearization, Range<usize>) -> Part + Sync + Send {
    let are_known = LegDiscrepancy::is_known(campaign);
    move |lin, range| {
        let legs = if are_known { LegReadings::of(&lin.conditions) } else { Vec::new() };
        (PartOfEquations::of(lin, &range, point), legs)
    }
}
