//! Files of machines with sensors: other signs, factors and axes of a sensor, other loads, other joints.
//!
//! The numbers of such a file are not six to a row, so what springs leave of it is found by fitting them as any model is fitted, to
//! part of the rows of a long file. A sensor a little beside its place is no mistake of the file: the examination finds it, beside effects.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use hexbench_core::{Dataset, Hexapod, Sensor, Vector3};
use nalgebra::Rotation3;
use rayon::prelude::*;

use super::change::{Change, Group, ReferencePoint, Signed, Target};
use super::{AsMeant, GAIN, MOST_WAYS, Readings, SOUND_LEVEL, Way, charge, hypotheses, sort};
use crate::effects::intern;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::fit;

/// Lines of a file that are looked at.
const MOST_LINES: usize = 120;
/// Ratios in which the numbers of a gauge may be written: inches, powers of ten, a lever of two.
const OF_LENGTHS: [f64; 5] = [25.4, 10.0, 1e3, 100.0, 2.0];
/// The same of a level: seconds of arc, thousandths, degrees, millimetres on a metre.
const OF_ANGLES: [f64; 4] = [PI / 0.648, 1e3, PI * 1e6 / 180.0, 2.0];
/// A compliance this many standard deviations below zero is no spring.
const NEGATIVE_SIGMAS: f64 = 3.0;

/// Other ways to read such a file that springs alone do not explain as it is written.
pub(super) fn other_readings(hexapod: &Hexapod, data: &Dataset) -> Option<Readings> {
    let bench = Bench::new(hexapod, data);
    let written = bench.springs(&[]);
    if written.as_ref().is_some_and(|w| w.level < SOUND_LEVEL && w.negative == 0) {
        return None;
    }
    let mut all: Vec<Change> = hexapod.sensors.iter().flat_map(of_sensor).collect();
    all.extend(
        hypotheses::singles(hexapod, data)
            .into_iter()
            .filter(concerns_no_pose_number)
            .filter(is_likely_order),
    );
    let mut ways: Vec<Way> =
        all.into_par_iter().filter_map(|change| bench.way(change, written.as_ref())).collect();
    sort(&mut ways);
    let is_negative = written.as_ref().is_some_and(|w| w.negative > 0);
    ways.retain(|way| way.gain > GAIN || is_negative);
    if ways.is_empty() {
        return None;
    }
    ways.truncate(MOST_WAYS);
    Some(Readings { level: written.map(|w| w.level), is_negative, ways })
}

/// What may be wrong with one sensor.
fn of_sensor(sensor: &Sensor) -> Vec<Change> {
    let name = intern::text(&sensor.name);
    let factors: &[f64] = if sensor.kind.is_angle() { &OF_ANGLES } else { &OF_LENGTHS };
    let mut all = vec![Change::SensorReversed(name)];
    all.extend(factors.iter().flat_map(|f| [*f, f.recip()]).map(|f| Change::SensorScaled(name, f)));
    if let Some(along) = sensor.kind.direction() {
        let axes = (0..3).map(|k| Vector3::ith(k, 1.0));
        let turns =
            axes.filter_map(|axis| Rotation3::rotation_between(along, &axis)).map(|turn| turn.scaled_axis());
        all.extend(turns.filter(|turn| turn.norm() > 0.1).map(|turn| Change::SensorTurned(name, turn)));
    }
    all
}

/// True for what speaks of loads, poses and joints, not of six measured numbers.
fn concerns_no_pose_number(change: &Change) -> bool {
    match change {
        Change::Reversed(signed) => {
            matches!(
                signed,
                Signed::Wrench | Signed::Forces | Signed::Moments | Signed::Load(_) | Signed::Reference
            )
        }
        Change::Scaled(group, _) => !matches!(
            group,
            Group::Translations | Group::Rotations | Group::Readings | Group::Reading(_) | Group::Noise
        ),
        Change::Renamed(target, _) | Change::Turned(target, _) => {
            !matches!(target, Target::Readings | Target::ReadingColumns)
        }
        Change::Origin(origin, _) => !matches!(origin, ReferencePoint::ReadingsMobile),
        Change::DeflectionMobile | Change::OtherRotations | Change::Angles(_) | Change::Rows(_) => false,
        _ => true,
    }
}

/// Of all orders of legs, those that a table can get by one slip: started elsewhere, written backwards, two lines exchanged.
fn is_likely_order(change: &Change) -> bool {
    let Change::LegOrder(order) = change else { return true };
    let moved = order.iter().enumerate().filter(|(k, leg)| *k != usize::from(**leg)).count();
    let follows = |step: u8| order.windows(2).all(|pair| (pair[0] + step) % 6 == pair[1]);
    moved == 2 || follows(1) || follows(5)
}

/// Springs fitted to a file read in some way.
struct Fitted {
    /// Twice the negative log-likelihood, to a constant of the file.
    cost: f64,
    level: f64,
    negative: usize,
}

/// A file to be read in many ways.
struct Bench<'a> {
    hexapod: &'a Hexapod,
    data: Dataset,
    /// Rows of the file for one that is looked at.
    stands_for: f64,
}

impl<'a> Bench<'a> {
    fn new(hexapod: &'a Hexapod, data: &Dataset) -> Self {
        let lines: BTreeSet<u64> = data.observations.iter().map(|o| o.line).collect();
        let stride = lines.len().div_ceil(MOST_LINES).max(1);
        let kept: BTreeSet<u64> = lines.into_iter().step_by(stride).collect();
        let observations = data.observations.iter().filter(|o| kept.contains(&o.line)).copied().collect();
        Self { hexapod, data: Dataset { observations, ..data.clone() }, stands_for: stride as f64 }
    }

    fn springs(&self, changes: &[Change]) -> Option<Fitted> {
        let meant = AsMeant::of(self.hexapod, &self.data, None, changes);
        let campaign = Campaign::new(&meant.hexapod, &meant.data).ok()?;
        let fit = fit(&campaign, &[], None).ok()?;
        let numbers = campaign.numbers as f64;
        let variance = fit.chi2_reduced();
        let at_least = variance.max(1.0);
        let spread = numbers * (at_least.ln() + variance / at_least);
        let cost = self.stands_for * (spread - 2.0 * self.log_scale(changes));
        let negative =
            (0..6).filter(|&leg| fit.point.compliances[leg] < -NEGATIVE_SIGMAS * fit.std(leg)).count();
        cost.is_finite().then(|| Fitted { cost, level: variance.sqrt(), negative })
    }

    /// Numbers that are scaled have another density.
    fn log_scale(&self, changes: &[Change]) -> f64 {
        let of = |change: &Change| match change {
            Change::SensorScaled(name, factor) => {
                let Some(sensor) = self.hexapod.sensors.iter().position(|s| s.name == **name) else {
                    return 0.0;
                };
                self.data.numbers_of(sensor) as f64 * factor.ln()
            }
            _ => 0.0,
        };
        changes.iter().map(of).sum()
    }

    fn way(&self, change: Change, written: Option<&Fitted>) -> Option<Way> {
        let changes = vec![change];
        let springs = self.springs(&changes).filter(|s| s.negative == 0)?;
        let cost = springs.cost + charge(&changes);
        let gain = written.map_or(f64::INFINITY, |w| w.cost - cost);
        Some(Way { gain, level: springs.level, cost, beside_springs: cost - springs.cost, changes })
    }
}
