//! A small world of its own: finite deflection of a platform on six springs, solved on leg lengths by Newton's method.
//!
//! It shares no formula with the model: rotations are composed, not linearized; legs find their own direction; the
//! reading is the difference of two states of equilibrium.

use hexbench_core::{Dataset, Hexapod, Measurand, Observation, Pose, Vector3, Vector6, Wrench};
use nalgebra::{Isometry3, Rotation3, Translation3, UnitQuaternion};

use super::plan::dataset;
use super::six;

/// Steps after which Newton's method counts as failed; ten suffice for springs, thirty beside soft brackets.
const MOST_STEPS: usize = 100;
/// Steps below this many meters and radians end it.
const SMALLEST_STEP: f64 = 1e-16;

/// The machine as it is.
#[derive(Clone)]
pub(crate) struct World {
    /// The machine as its controller knows it.
    pub(crate) drawn: Hexapod,
    /// The machine as built.
    pub(crate) built: Hexapod,
    /// Compliance of each leg, m/N.
    pub(crate) compliance: [f64; 6],
    /// Lateral compliance of every base-joint bracket, m/N.
    pub(crate) bracket: f64,
    /// Where the load acts, mobile frame, m.
    pub(crate) load_point: Vector3,
    /// Fixed frame seen from the metrology frame.
    pub(crate) metrology_frame: Isometry3<f64>,
    /// Target frame seen from the mobile frame.
    pub(crate) target_frame: Isometry3<f64>,
}

impl World {
    /// A machine built as drawn, on springs of these stiffnesses (N/m).
    pub(crate) fn on_springs(drawn: &Hexapod, stiffness: [f64; 6]) -> Self {
        Self {
            drawn: drawn.clone(),
            built: drawn.clone(),
            compliance: stiffness.map(f64::recip),
            bracket: 0.0,
            load_point: Vector3::zeros(),
            metrology_frame: Isometry3::identity(),
            target_frame: Isometry3::identity(),
        }
    }

    /// Where the platform comes to rest at a commanded pose under a wrench.
    pub(crate) fn rest(&self, command: &Pose, wrench: &Wrench) -> Isometry3<f64> {
        let mut place = rigid(command);
        let lengths: [f64; 6] = std::array::from_fn(|leg| {
            (place * point(&self.drawn.platform_joints[leg]) - point(&self.drawn.base_joints[leg])).norm()
        });
        for _ in 0..MOST_STEPS {
            let step = self.newton_step(&place, &lengths, wrench);
            let turn = UnitQuaternion::from_scaled_axis(step.fixed_rows::<3>(3).into_owned());
            place.translation.vector += step.fixed_rows::<3>(0);
            place.rotation = turn * place.rotation;
            if step.amax() < SMALLEST_STEP {
                return place;
            }
        }
        // The last digits may wander; a step of a picometre is none.
        assert!(self.newton_step(&place, &lengths, wrench).amax() < 1e-14, "no equilibrium at {command:?}");
        place
    }

    fn newton_step(&self, place: &Isometry3<f64>, lengths: &[f64; 6], wrench: &Wrench) -> Vector6 {
        let arm = place.rotation * self.load_point;
        let mut unbalanced = six(&wrench.force, &(wrench.moment + arm.cross(&wrench.force)));
        let mut tangent = hexbench_core::Matrix6::zeros();
        for leg in 0..6 {
            let joint = place.rotation * self.built.platform_joints[leg];
            let end = place.translation.vector + joint;
            let (force, along) = self.pull(leg, &end, lengths[leg]);
            let row = six(&along, &joint.cross(&along));
            unbalanced -= force * row;
            tangent += row * row.transpose() / self.compliance[leg];
        }
        tangent.try_inverse().unwrap() * unbalanced
    }

    /// Tension (N) and direction of a leg whose platform joint is at `end`; its bracket gives way sideways.
    fn pull(&self, leg: usize, end: &Vector3, length: f64) -> (f64, Vector3) {
        let mut foot = self.built.base_joints[leg];
        // Each round gains the ratio of bracket to leg compliance, at most a fifth.
        let rounds = if self.bracket > 0.0 { 25 } else { 0 };
        for _ in 0..rounds {
            let (force, along) = self.tension(leg, &(end - foot), length);
            foot = self.built.base_joints[leg] + self.bracket * force * Vector3::new(along.x, along.y, 0.0);
        }
        self.tension(leg, &(end - foot), length)
    }

    fn tension(&self, leg: usize, span: &Vector3, length: f64) -> (f64, Vector3) {
        ((span.norm() - length) / self.compliance[leg], span.normalize())
    }

    /// What the metrology reads: a deflection or an absolute pose.
    pub(crate) fn read(&self, measurand: Measurand, o: &Observation) -> [f64; 6] {
        let loaded = self.rest(&o.pose, &o.wrench);
        if measurand == Measurand::AbsolutePose {
            return coordinates(&(self.metrology_frame * loaded * self.target_frame));
        }
        let reference = self.rest(&o.pose, &o.reference);
        let shift = loaded.translation.vector - reference.translation.vector;
        let turn = if measurand == Measurand::DeflectionEuler {
            let (a, b) = (coordinates(&loaded), coordinates(&reference));
            Vector3::from_fn(|k, _| a[3 + k] - b[3 + k])
        } else {
            (loaded.rotation * reference.rotation.inverse()).scaled_axis()
        };
        [shift.x, shift.y, shift.z, turn.x, turn.y, turn.z]
    }

    /// A plan as measured without noise.
    pub(crate) fn measure(&self, measurand: Measurand, plan: &[Observation]) -> Dataset {
        let read = |o: &Observation| Observation { measured: self.read(measurand, o), ..*o };
        dataset(measurand, plan.iter().map(read).collect())
    }
}

fn point(v: &Vector3) -> nalgebra::Point3<f64> {
    nalgebra::Point3::from(*v)
}

/// A pose as a rigid transformation, by nalgebra's own Euler angles.
pub(crate) fn rigid(pose: &Pose) -> Isometry3<f64> {
    let [a, b, c, alpha, beta, gamma] = pose.to_array();
    let turn = Rotation3::from_euler_angles(alpha, beta, gamma);
    Isometry3::from_parts(Translation3::new(a, b, c), UnitQuaternion::from_rotation_matrix(&turn))
}

/// `[a, b, c, alpha, beta, gamma]` of a rigid transformation, by nalgebra's own Euler angles.
pub(crate) fn coordinates(place: &Isometry3<f64>) -> [f64; 6] {
    let t = place.translation.vector;
    let (alpha, beta, gamma) = place.rotation.euler_angles();
    [t.x, t.y, t.z, alpha, beta, gamma]
}
