//! Residuals in the space of the legs: the elongation each leg would need to explain what is left.
//!
//! `e = L H^-1 r` with `r` the residual of the averaged readings, `H` the observer (measured coordinates from twist) and
//! `L` the geometric leg Jacobian; the covariance of `e` follows from that of the reading. Six numbers of sensors determine it as those of
//! a pose do, where `H` has an inverse. More numbers of one condition stand in several blocks: they tell of the legs together, by least
//! squares.

use std::collections::HashMap;

use hexbench_core::statistics::root_mean_square;
use hexbench_core::{Matrix6, Vector6};
use serde::Serialize;

use super::JudgedModel;
use crate::estimation::campaign::Campaign;
use crate::estimation::linearization::Linearization;
use crate::estimation::parallel::map;

/// Least share of the largest eigenvalue of the normal equations of more than six numbers that the smallest one has where they tell
/// of every leg.
const TOLD_BY_MORE: f64 = 1e-12;

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

/// Residual elongations of all conditions, m, and their standard deviations by noise alone: infinite where they are not determined.
#[derive(Debug, Clone)]
pub struct LegSpace {
    /// One per condition.
    pub elongation: Vec<Vector6>,
    /// The same order.
    pub sigma: Vec<Vector6>,
    /// False for the further blocks of a condition, told with its first.
    is_first: Vec<bool>,
}

/// Map the residuals of a linearized campaign to the legs.
pub fn leg_space(campaign: &Campaign, lin: &Linearization) -> LegSpace {
    let count = lin.conditions.len();
    let mut space = LegSpace {
        elongation: vec![Vector6::zeros(); count],
        sigma: vec![Vector6::repeat(f64::INFINITY); count],
        is_first: vec![false; count],
    };
    let blocks = blocks(campaign);
    let found =
        map(&blocks, |blocks| if blocks.len() > 1 { of_blocks(lin, blocks) } else { of_six(lin, blocks[0]) });
    for (first, found) in blocks.iter().map(|blocks| blocks[0]).zip(found) {
        space.is_first[first] = true;
        if let Some([elongation, sigma]) = found {
            space.elongation[first] = elongation;
            space.sigma[first] = sigma;
        }
    }
    space
}

/// Conditions of a campaign that are blocks of one condition of the file, the first block first.
fn blocks(campaign: &Campaign) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = Vec::new();
    let mut places = HashMap::new();
    for (i, group) in campaign.groups.iter().enumerate() {
        if campaign.blocks.len() < 2 {
            all.push(vec![i]);
            continue;
        }
        let place = *places.entry(group.mean.line).or_insert(all.len());
        if place == all.len() {
            all.push(Vec::new());
        }
        all[place].push(i);
    }
    all
}

/// Elongations by six numbers, and their standard deviations.
fn of_six(lin: &Linearization, i: usize) -> Option<[Vector6; 2]> {
    let c = &lin.conditions[i];
    c.tells_motion().then(|| {
        let whitened = c.legs_of_reading();
        let sigma = Vector6::from_fn(|leg, _| whitened.row(leg).norm().max(f64::MIN_POSITIVE));
        [whitened * lin.residual(i), sigma]
    })
}

/// The same by all numbers of several blocks.
fn of_blocks(lin: &Linearization, blocks: &[usize]) -> Option<[Vector6; 2]> {
    let (mut normal, mut right) = (Matrix6::zeros(), Vector6::zeros());
    for &i in blocks {
        let seen = lin.conditions[i].seen();
        normal += seen.tr_mul(&seen);
        right += seen.tr_mul(&lin.residual(i));
    }
    let eigenvalues = normal.symmetric_eigenvalues();
    if eigenvalues.min() <= TOLD_BY_MORE * eigenvalues.max() {
        return None;
    }
    let factor = normal.cholesky()?;
    Some([factor.solve(&right), factor.inverse().diagonal().map(f64::sqrt)])
}

impl LegSpace {
    /// True where the readings of a condition determine the elongation of every leg.
    pub fn is_determined(&self, condition: usize) -> bool {
        self.sigma[condition].iter().all(|s| s.is_finite())
    }

    /// The conditions whose readings do.
    pub fn determined(&self) -> Vec<usize> {
        (0..self.sigma.len()).filter(|&condition| self.is_determined(condition)).collect()
    }

    /// True where those of every condition do.
    pub fn is_complete(&self) -> bool {
        (0..self.sigma.len()).all(|condition| !self.is_first[condition] || self.is_determined(condition))
    }
}

/// Root mean square of every leg.
pub fn summaries(judged: &JudgedModel<'_>) -> Vec<LegResidual> {
    let determined = judged.space.determined();
    let rms = |all: &[Vector6], leg: usize| {
        1e6 * root_mean_square(determined.iter().map(|&i| all[i][leg])).unwrap_or(0.0)
    };
    let one = |leg: usize| LegResidual {
        leg: leg + 1,
        rms_um: rms(&judged.space.elongation, leg),
        noise_um: rms(&judged.space.sigma, leg),
    };
    (0..6).map(one).collect()
}
