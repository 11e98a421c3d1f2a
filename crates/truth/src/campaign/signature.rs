//! How visible an effect is.
//!
//! The signature of an effect is what it adds to the readings, divided by their noise. Part of it six leg springs of other
//! stiffness would explain (in absolute mode, also other frames of the instrument); the length of the rest is the
//! *distance*: the square root of the noncentrality of a chi-square test for the effect.

use hexbench_core::statistics::root_mean_square;
use hexbench_core::{Measurand, Pose, Vector6};

use super::{PlanRow, SimulatedCampaign, absolute};
use crate::{Mechanism, TruthError, World};

/// Measures the distance of effects for one campaign without effects and one plan.
#[derive(Debug)]
pub struct Yardstick<'a> {
    campaign: &'a SimulatedCampaign,
    rows: &'a [PlanRow],
    measurand: Measurand,
    baseline: Vec<Vector6>,
    /// What sensors read, where they do; else the six numbers count.
    sensed: Option<Vec<f64>>,
    explained: Vec<Vec<f64>>,
}

impl<'a> Yardstick<'a> {
    /// A yardstick; `campaign` must be without effects.
    ///
    /// # Errors
    /// As [`World::reading`].
    pub fn new(
        campaign: &'a SimulatedCampaign,
        rows: &'a [PlanRow],
        measurand: Measurand,
    ) -> Result<Self, TruthError> {
        let mut yardstick = Self::of_signatures(campaign, rows, measurand)?;
        yardstick.explain_by_springs()?;
        if measurand == Measurand::AbsolutePose {
            yardstick.explain_by_frames()?;
        }
        Ok(yardstick)
    }

    /// A yardstick of what the sensors of the machine read; `campaign` must be without effects.
    ///
    /// # Errors
    /// As [`World::reading`].
    pub fn of_sensors(campaign: &'a SimulatedCampaign, rows: &'a [PlanRow]) -> Result<Self, TruthError> {
        let sensed = Some(campaign.sensed(rows)?.concat());
        let poses = Self::of_signatures(campaign, rows, Measurand::DeflectionEuler)?;
        let mut yardstick = Self { sensed, ..poses };
        yardstick.explain_by_springs()?;
        Ok(yardstick)
    }

    /// A yardstick that explains nothing by springs or frames: its signatures are the same, at a tenth of the effort, and
    /// its distances are whole lengths.
    ///
    /// # Errors
    /// As [`World::reading`].
    pub fn of_signatures(
        campaign: &'a SimulatedCampaign,
        rows: &'a [PlanRow],
        measurand: Measurand,
    ) -> Result<Self, TruthError> {
        let baseline = campaign.ideal(rows, measurand)?;
        Ok(Self { campaign, rows, measurand, baseline, sensed: None, explained: Vec::new() })
    }

    /// What the mechanisms add to the readings, m and rad.
    ///
    /// # Errors
    /// As [`World::reading`].
    pub fn signature(&self, mechanisms: Vec<Box<dyn Mechanism>>) -> Result<Vec<Vector6>, TruthError> {
        self.added_by(&self.with(mechanisms))
    }

    fn with(&self, mechanisms: Vec<Box<dyn Mechanism>>) -> SimulatedCampaign {
        self.of_world(World { mechanisms, ..self.campaign.world.without_effects() })
    }

    /// The campaign in another world.
    fn of_world(&self, world: World) -> SimulatedCampaign {
        SimulatedCampaign { world, frames: self.campaign.frames, noise: self.campaign.noise }
    }

    /// Distance of the mechanisms taken together.
    ///
    /// # Errors
    /// As [`World::reading`].
    pub fn distance(&self, mechanisms: Vec<Box<dyn Mechanism>>) -> Result<f64, TruthError> {
        let mut rest = self.whitened(self.seen(&self.with(mechanisms))?);
        self.remove_explained(&mut rest);
        Ok(norm(&rest))
    }

    /// Factor by which an effect must be scaled to have a distance, and the distance reached.
    ///
    /// # Errors
    /// [`TruthError::NotVisible`] when no reasonable size of the effect is so visible.
    pub fn scale_to(&self, effect: &dyn Mechanism, wanted: f64) -> Result<(f64, f64), TruthError> {
        const ITERATIONS: usize = 60;
        const EXACT: f64 = 1e-9;
        const ENOUGH: f64 = 1e-5;
        const SMALLEST_FACTOR: f64 = 1e-3;
        let largest_factor = effect.largest_factor();
        let mut factor = 1.0;
        let mut best = (factor, 0.0);
        let mut bracket = (0.0, f64::INFINITY);
        for _ in 0..ITERATIONS {
            if !(SMALLEST_FACTOR..largest_factor).contains(&factor) {
                break;
            }
            // A machine that gives way under the effect has too much of it.
            let distance = self.distance(vec![effect.scaled(factor)]).unwrap_or(f64::INFINITY);
            if (distance - wanted).abs() < (best.1 - wanted).abs() {
                best = (factor, distance);
            }
            if (distance / wanted - 1.0).abs() < EXACT {
                break;
            }
            if distance > wanted {
                bracket.1 = factor;
            } else {
                bracket.0 = factor;
            }
            factor = next_factor(factor, distance, wanted, bracket, largest_factor);
        }
        if (best.1 / wanted - 1.0).abs() < ENOUGH {
            return Ok(best);
        }
        Err(TruthError::NotVisible { id: effect.id().to_owned(), wanted, reached: best.1, scale: best.0 })
    }

    fn added_by(&self, campaign: &SimulatedCampaign) -> Result<Vec<Vector6>, TruthError> {
        let readings = campaign.ideal(self.rows, self.measurand)?;
        Ok(readings.iter().zip(&self.baseline).map(|(a, b)| difference(a, b)).collect())
    }

    /// What another campaign adds to the numbers that are read, m and rad.
    fn seen(&self, campaign: &SimulatedCampaign) -> Result<Vec<f64>, TruthError> {
        let Some(baseline) = &self.sensed else {
            return Ok(self.added_by(campaign)?.iter().flat_map(|r| <[f64; 6]>::from(*r)).collect());
        };
        let read = campaign.sensed(self.rows)?.concat();
        Ok(read.iter().zip(baseline).map(|(a, b)| a - b).collect())
    }

    fn whitened(&self, numbers: impl IntoIterator<Item = f64>) -> Vec<f64> {
        let sigmas = match &self.sensed {
            None => self.campaign.noise.sigma().iter().copied().collect(),
            Some(_) => self.campaign.world.hexapod.sensor_sigmas(),
        };
        numbers.into_iter().zip(sigmas.iter().cycle()).map(|(number, sigma)| number / sigma).collect()
    }

    /// Central differences by each leg compliance.
    fn explain_by_springs(&mut self) -> Result<(), TruthError> {
        const SHARE: f64 = 0.01;
        for leg in 0..6 {
            let changed = |share: f64| {
                let mut world = self.campaign.world.without_effects();
                world.leg_compliance[leg] *= 1.0 + share;
                self.seen(&self.of_world(world))
            };
            let (plus, minus) = (changed(SHARE)?, changed(-SHARE)?);
            self.explain(plus.iter().zip(&minus).map(|(p, m)| p - m));
        }
        Ok(())
    }

    /// Central differences by the frames of the instrument.
    fn explain_by_frames(&mut self) -> Result<(), TruthError> {
        const STEP: f64 = 1e-5;
        for k in 0..12 {
            let changed = |step: f64| {
                let world = self.campaign.world.without_effects();
                let frames = absolute::shifted(&self.campaign.frames, k, step);
                self.seen(&SimulatedCampaign { world, frames, noise: self.campaign.noise })
            };
            let (plus, minus) = (changed(STEP)?, changed(-STEP)?);
            self.explain(plus.iter().zip(&minus).map(|(p, m)| p - m));
        }
        Ok(())
    }

    /// Adds a direction to what is explained anyway, orthonormal to the others; one that is none of its own is dropped.
    fn explain(&mut self, column: impl Iterator<Item = f64>) {
        const DEPENDENT: f64 = 1e-6;
        let mut v = self.whitened(column);
        let before = norm(&v);
        self.remove_explained(&mut v);
        self.remove_explained(&mut v);
        let after = norm(&v);
        if after > DEPENDENT * before {
            for x in &mut v {
                *x /= after;
            }
            self.explained.push(v);
        }
    }

    fn remove_explained(&self, v: &mut [f64]) {
        for direction in &self.explained {
            let along: f64 = v.iter().zip(direction).map(|(a, b)| a * b).sum();
            v.iter_mut().zip(direction).for_each(|(a, b)| *a -= along * b);
        }
    }
}

/// Proportional step, kept between what was too small and what was too large.
fn next_factor(factor: f64, distance: f64, wanted: f64, bracket: (f64, f64), largest: f64) -> f64 {
    const LARGEST_STEP: f64 = 20.0;
    let next = factor * (wanted / distance.max(f64::MIN_POSITIVE)).clamp(1.0 / LARGEST_STEP, LARGEST_STEP);
    if next > bracket.0 && next < bracket.1 { next } else { 0.5 * (bracket.0 + bracket.1.min(2.0 * largest)) }
}

fn difference(a: &Vector6, b: &Vector6) -> Vector6 {
    let pose = |v: &Vector6| Pose::from_array((*v).into());
    crate::world::difference(&pose(a), &pose(b))
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Root mean square of translations (m) and of rotations (rad) over readings.
pub fn rms(readings: &[Vector6]) -> (f64, f64) {
    let of = |rows: std::ops::Range<usize>| {
        root_mean_square(readings.iter().flat_map(|r| rows.clone().map(|k| r[k]))).unwrap_or(0.0)
    };
    (of(0..3), of(3..6))
}
