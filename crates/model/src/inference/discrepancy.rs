//! What a fitted model leaves of the legs beyond the noise: how far each leg is from the springs and effects it is taken for.
//!
//! Whitened residuals become elongations of the legs, `e = W r` with the variance `v` of each by noise and tolerances. Of a leg,
//!
//! ```text
//! a^2 = (S - expected S) / sum (c phi)^2 / v,   S = sum e^2 / v
//! ```
//!
//! with the compliance `c` of its spring and the change `phi` of its force: the square of what is left relative to what the spring gives,
//! weighed alike. `S` is that of all readings, or of their means over ranges of a variable, which show a systematic part far below
//! the noise of one reading. A law that leaves the share `a` behind moves the compliance itself by about as much, so `a c` is part of its
//! standard uncertainty.

use hexbench_core::{Matrix6, Vector6};
use nalgebra::DVector;

use crate::estimation::campaign::{Campaign, Condition};
use crate::estimation::foreseen::Misfit;
use crate::estimation::linearization::Linearization;
use crate::estimation::noise::NoiseLevel;
use crate::estimation::parallel::{map, map_through};
use crate::inference::pattern::PatternVariable;

/// Chance by noise, over all questions asked, below which something is left.
const LEFT_CHANCE: f64 = 1e-3;
/// Ranges of a variable.
const RANGES: usize = 8;
/// What the means over ranges are asked about.
const VARIABLES: [PatternVariable; 4] = [
    PatternVariable::LegLength,
    PatternVariable::LegForce,
    PatternVariable::Elapsed,
    PatternVariable::DeltaT,
];

/// What is left of every leg, root mean square; zero where noise explains it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LegDiscrepancy {
    /// Elongation, m.
    pub elongation: Vector6,
    /// The same relative to the elongation of the leg's spring.
    pub share: Vector6,
}

impl LegDiscrepancy {
    /// True where anything is left.
    pub fn is_any(&self) -> bool {
        self.share.amax() > 0.0
    }

    /// That of a model at its fit to a campaign, which left so many degrees of freedom; nothing where full poses were not read or the
    /// noise is known from the residuals only.
    pub fn of(campaign: &Campaign, lin: &Linearization, dof: f64) -> Self {
        if !Self::is_known(campaign) {
            return Self::default();
        }
        Self::in_legs(campaign, &LegReadings::of(&lin.conditions), &lin.residuals(), dof)
    }

    /// True where what is left of the legs can be told from the noise.
    pub(crate) fn is_known(campaign: &Campaign) -> bool {
        campaign.reads_poses && campaign.noise.allows_verdict() && !campaign.is_absolute()
    }

    /// The same by whitened residuals, six per condition.
    pub(crate) fn in_legs(
        campaign: &Campaign,
        readings: &[LegReadings],
        residuals: &DVector<f64>,
        dof: f64,
    ) -> Self {
        let level = campaign.noise_level();
        let kept = dof / campaign.averaged_numbers();
        let legs = points(readings, residuals);
        let squares = map_through(&legs, readings.len(), |points| {
            let excess = excess(points, kept, level);
            let weight: f64 = points.iter().map(|p| p.weight).sum();
            let spring: f64 = points.iter().map(|p| p.weight * p.spring * p.spring).sum();
            if spring > 0.0 { (excess / weight, excess / spring) } else { (0.0, 0.0) }
        });
        Self {
            elongation: Vector6::from_fn(|leg, _| squares[leg].0.sqrt()),
            share: Vector6::from_fn(|leg, _| squares[leg].1.sqrt()),
        }
    }
}

/// One reading of one leg.
struct Point {
    /// What is left of its elongation, m.
    left: f64,
    /// 1 / variance of it by noise and tolerances, 1/m^2.
    weight: f64,
    /// Elongation of its spring, m.
    spring: f64,
    /// The variables.
    values: [f64; VARIABLES.len()],
}

/// What a reading of all legs hangs on, without the residuals.
pub(crate) struct LegReadings {
    /// Elongations of the legs, m, per weighted number.
    to_legs: Matrix6,
    /// Elongations of the springs, m.
    springs: Vector6,
    /// The variables of every leg.
    values: [[f64; VARIABLES.len()]; 6],
}

impl LegReadings {
    /// Of every condition.
    pub(crate) fn of(conditions: &[Condition]) -> Vec<Self> {
        map(conditions, |at| Self {
            to_legs: at.legs_of_reading(),
            springs: at.compliances.component_mul(&at.spring_change()),
            values: std::array::from_fn(|leg| VARIABLES.map(|v| v.value(at, leg))),
        })
    }
}

fn points(readings: &[LegReadings], residuals: &DVector<f64>) -> [Vec<Point>; 6] {
    let mut legs: [Vec<Point>; 6] = std::array::from_fn(|_| Vec::with_capacity(readings.len()));
    for (i, LegReadings { to_legs, springs, values }) in readings.iter().enumerate() {
        let left = to_legs * residuals.fixed_rows::<6>(6 * i);
        for (leg, points) in legs.iter_mut().enumerate() {
            points.push(Point {
                left: left[leg],
                weight: to_legs.row(leg).norm_squared().max(f64::MIN_POSITIVE).recip(),
                spring: springs[leg],
                values: values[leg],
            });
        }
    }
    legs
}

/// The largest part of `S` that noise does not explain, of all readings or of their means over ranges; zero when it explains all.
fn excess(points: &[Point], kept: f64, level: NoiseLevel) -> f64 {
    let square = points.iter().map(|p| p.left * p.left * p.weight).sum();
    let all = Misfit { chi2: square, numbers: kept * points.len() as f64 };
    let of_ranges = (0..VARIABLES.len()).flat_map(|v| {
        let ranges = ranges(points, v);
        [false, true].map(|compliance| of_means(&ranges, compliance))
    });
    let sums: Vec<Misfit> = std::iter::once(all).chain(of_ranges).collect();
    let asked = 6.0 * sums.len() as f64;
    let beyond = |sum: &&Misfit| sum.chance(level).is_ok_and(|chance| chance * asked < LEFT_CHANCE);
    sums.iter().filter(beyond).map(|sum| sum.chi2 - sum.numbers).fold(0.0, f64::max)
}

/// Points in the order of a variable, cut into ranges; equal values stay together.
fn ranges(points: &[Point], variable: usize) -> Vec<Vec<&Point>> {
    let mut order: Vec<(f64, usize)> = points.iter().map(|p| p.values[variable]).zip(0..).collect();
    order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let length = order.len().div_ceil(RANGES).max(1);
    let mut ranges: Vec<Vec<&Point>> = Vec::with_capacity(RANGES);
    for point in order.into_iter().map(|(_, i)| &points[i]) {
        let is_same =
            |last: &Vec<&Point>| last.last().is_some_and(|p| p.values[variable] >= point.values[variable]);
        match ranges.last_mut().filter(|last| last.len() < length || is_same(last)) {
            Some(last) => last.push(point),
            None => ranges.push(vec![point]),
        }
    }
    ranges
}

/// `S` of the mean elongation of every range, or of the mean compliance.
fn of_means(ranges: &[Vec<&Point>], compliance: bool) -> Misfit {
    let carrier = |p: &Point| if compliance { p.spring } else { 1.0 };
    let square = |range: &Vec<&Point>| {
        let along: f64 = range.iter().map(|p| p.weight * carrier(p) * p.left).sum();
        let length: f64 = range.iter().map(|p| p.weight * carrier(p).powi(2)).sum();
        if length > 0.0 { along * along / length } else { 0.0 }
    };
    Misfit { chi2: ranges.iter().map(square).sum(), numbers: ranges.len() as f64 }
}
