//! A laboratory whose inputs are as good as their tolerances: what a file says of joints, loads and axes is not quite what was there.
//!
//! ```text
//! joints    true A_i, B_i = drawn ones + Gaussian errors; legs are commanded by the drawing
//! loads     F = exp(d) diag(1 + g) F_file,  M the same with gains of its own, + (R r) x F at the true point of attack
//! readings  turned by exp(e): the axes of the instrument are not those of the base
//! ```
//!
//! One draw holds for a whole campaign. Absolute poses keep their axes: there the frames of the instrument are free anyway.

use hexbench_core::{Hexapod, Measurand, Tolerances, Vector3, Vector6, Wrench};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::{PlanRow, SimulatedCampaign};
use crate::mechanisms::JointGeometry;
use crate::{Situation, TruthError, World, so3};

/// Errors of the inputs of one campaign.
#[derive(Debug, Clone)]
pub struct InputErrors {
    joints: JointGeometry,
    /// Of the scale of each component of force and moment.
    gain: Vector6,
    /// Rotation of the loads, rad, fixed axes.
    turn: Vector3,
    /// True minus stated point of attack, m, mobile frame.
    point: Vector3,
    /// Rotation of the axes of the readings, rad, fixed axes.
    axes: Vector3,
}

impl InputErrors {
    /// Independent Gaussian errors, each with the standard deviation that the tolerances state.
    pub fn sampled(hexapod: &Hexapod, tolerances: &Tolerances, rng: &mut Pcg64) -> Self {
        let Tolerances { joints, load_gain, load_direction, load_point, frame, .. } = *tolerances;
        let joints = JointGeometry::sampled(hexapod, joints, rng);
        let mut three = |sigma: f64| Vector3::from_fn(|_, _| normal(rng) * sigma);
        let [force, moment] = [load_gain; 2].map(&mut three);
        Self {
            joints,
            gain: Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z),
            turn: three(load_direction),
            point: three(load_point),
            axes: three(frame),
        }
    }

    /// What an ideal instrument reads in a laboratory with these errors, row by row; m and rad.
    ///
    /// # Errors
    /// As [`SimulatedCampaign::ideal`].
    pub fn ideal(
        &self,
        mut campaign: SimulatedCampaign,
        rows: &[PlanRow],
        measurand: Measurand,
    ) -> Result<Vec<Vector6>, TruthError> {
        self.alter(&mut campaign.world);
        let done: Vec<PlanRow> =
            rows.iter().map(|row| PlanRow { situation: self.done(&row.situation), ..*row }).collect();
        let readings = campaign.ideal(&done, measurand)?;
        Ok(readings.into_iter().map(|reading| self.read(&reading, measurand)).collect())
    }

    fn alter(&self, world: &mut World) {
        // What the effects do starts from where the joints are.
        world.mechanisms.insert(0, Box::new(self.joints.clone()));
    }

    fn done(&self, written: &Situation) -> Situation {
        let at = |wrench: &Wrench| {
            let gained = wrench.to_vector().component_mul(&self.gain.add_scalar(1.0));
            let turn = so3::exp(&self.turn);
            let force = turn * gained.fixed_rows::<3>(0);
            let arm = written.pose.rotation() * self.point;
            Wrench { force, moment: turn * gained.fixed_rows::<3>(3) + arm.cross(&force) }
        };
        Situation { wrench: at(&written.wrench), reference: at(&written.reference), ..*written }
    }

    fn read(&self, reading: &Vector6, measurand: Measurand) -> Vector6 {
        if measurand == Measurand::AbsolutePose {
            return *reading;
        }
        let turn = so3::exp(&self.axes);
        let (shift, angles) = (turn * reading.fixed_rows::<3>(0), turn * reading.fixed_rows::<3>(3));
        Vector6::new(shift.x, shift.y, shift.z, angles.x, angles.y, angles.z)
    }
}

fn normal(rng: &mut Pcg64) -> f64 {
    StandardNormal.sample(rng)
}
