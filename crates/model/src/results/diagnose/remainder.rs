//! What the fitted model leaves beyond the noise: how much, in which legs, and what it follows.

use hexbench_core::Dataset;
use serde::Serialize;

use super::report::StepReport;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::Fit;
use crate::estimation::linearization::Linearization;
use crate::inference::discrepancy::LegDiscrepancy;
use crate::results::compare::JudgedModel;
use crate::results::compare::association::{Association, associations};

/// Associations told.
const TOLD: usize = 3;

/// What remains.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct RemainderReport {
    /// Error on held-out poses (else on the readings fitted) without what the noise gives, over the noise.
    pub times_noise: f64,
    /// Legs in which something remains, the largest share first.
    pub legs: Vec<LegRemainder>,
    /// What it follows, the surest first.
    pub follows: Vec<Association>,
}

/// What remains of one leg, root mean square.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct LegRemainder {
    /// Leg from 1.
    pub leg: usize,
    /// Elongation that nothing in the model explains, um.
    pub elongation_um: f64,
    /// The same relative to the elongation of the leg's spring, percent; as large a part of the stiffness is open.
    pub percent_of_spring: f64,
}

impl RemainderReport {
    /// Of the last fit, at which the campaign is linearized; none where noise explains what it leaves.
    pub(super) fn of(
        left: &LegDiscrepancy,
        (last, lin): (&Fit, Linearization),
        step: Option<&StepReport>,
        campaign: &Campaign,
        data: &Dataset,
    ) -> Option<Self> {
        if !left.is_any() {
            return None;
        }
        let mut follows = associations(&JudgedModel::linearized(campaign, data, &last.point, lin, true));
        follows.truncate(TOLD);
        let times_noise = step.map_or(0.0, |s| s.error().beyond_noise());
        Some(Self { times_noise, legs: LegRemainder::all(left), follows })
    }
}

impl LegRemainder {
    /// Those of the legs in which something remains, the largest share first.
    pub fn all(left: &LegDiscrepancy) -> Vec<Self> {
        let leg = |leg: usize| Self {
            leg: leg + 1,
            elongation_um: left.elongation[leg] * 1e6,
            percent_of_spring: left.share[leg] * 100.0,
        };
        let mut legs: Vec<Self> = (0..6).filter(|&k| left.share[k] > 0.0).map(leg).collect();
        legs.sort_by(|a, b| b.percent_of_spring.total_cmp(&a.percent_of_spring));
        legs
    }
}
