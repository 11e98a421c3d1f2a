//! Residuals in the space of the legs: the elongation each leg would need to explain what is left.
//!
//! `e = L H^-1 r` with `r` the residual of the averaged readings, `H` the observer (measured coordinates from twist) and
//! `L` the geometric leg Jacobian; the covariance of `e` follows from that of the reading. Six numbers of sensors determine it as those of
//! a pose do, where `H` has an inverse.

use hexbench_core::statistics::root_mean_square;
use hexbench_core::{Channel, Matrix6, Vector6};
use serde::Serialize;

use super::JudgedModel;
use crate::estimation::campaign::{Campaign, Condition, ConditionReadings};
use crate::estimation::linearization::Linearization;

/// Least share of the best seen motion of the legs that the worst seen one has where all of them are determined: beyond it, rounding
/// takes the digits that people read.
const DETERMINED: f64 = 1e-9;

/// Residual elongation of one leg, um.
#[derive(Debug, Clone, Serialize)]
pub struct LegResidual {
    /// Leg from 1.
    pub leg: usize,
    /// Root mean square over the averaged readings.
    pub rms_um: f64,
    /// What noise alone would give.
    pub noise_um: f64,
}

/// Residual elongations of all conditions, m, and their standard deviations by noise alone.
#[derive(Debug, Clone)]
pub struct LegSpace {
    /// One per condition.
    pub elongation: Vec<Vector6>,
    /// The same order.
    pub sigma: Vec<Vector6>,
}

/// Map the residuals of a linearised campaign to the legs.
pub fn leg_space(campaign: &Campaign, lin: &Linearization) -> LegSpace {
    let mut space = LegSpace { elongation: Vec::new(), sigma: Vec::new() };
    for (i, (c, group)) in lin.conditions.iter().zip(&campaign.groups).enumerate() {
        if !determines_legs(c, group) {
            space.elongation.push(Vector6::zeros());
            space.sigma.push(Vector6::repeat(f64::INFINITY));
            continue;
        }
        let whitened = c.legs_of_reading(group);
        space.elongation.push(whitened * lin.residual(i));
        space.sigma.push(Vector6::from_fn(|leg, _| whitened.row(leg).norm().max(f64::MIN_POSITIVE)));
    }
    space
}

/// True where the six numbers of a reading tell the elongation of every leg.
fn determines_legs(c: &Condition, group: &ConditionReadings) -> bool {
    if group.numbers() < 6 {
        return false;
    }
    // A pose does; only at beta = +-90 deg it says nothing of two rotations.
    group.channels == Channel::POSE || {
        let seen = Matrix6::from_diagonal(&c.weight) * c.observer * c.legs.platform_jacobian;
        let shares = seen.singular_values();
        shares.min() > DETERMINED * shares.max()
    }
}

impl LegSpace {
    /// True where the readings of a condition determine the elongation of every leg.
    pub fn is_determined(&self, condition: usize) -> bool {
        self.sigma[condition].iter().all(|s| s.is_finite())
    }

    /// True where those of every condition do.
    pub fn is_complete(&self) -> bool {
        (0..self.sigma.len()).all(|condition| self.is_determined(condition))
    }
}

/// Root mean square of every leg.
pub fn summaries(judged: &JudgedModel<'_>) -> Vec<LegResidual> {
    let rms = |all: &[Vector6], leg: usize| 1e6 * root_mean_square(all.iter().map(|e| e[leg])).unwrap_or(0.0);
    let one = |leg: usize| LegResidual {
        leg: leg + 1,
        rms_um: rms(&judged.space.elongation, leg),
        noise_um: rms(&judged.space.sigma, leg),
    };
    (0..6).map(one).collect()
}
