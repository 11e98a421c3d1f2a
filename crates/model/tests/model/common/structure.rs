//! A second small world: legs with several laws, bent joints, brackets, a base and a plate that yield; balances of forces at finite
//! deflection, solved by Newton's method on differences.
//!
//! It shares no formula with the model: a leg is a body in balance under its end forces and joint moments, bodies are poses, and
//! the derivative of the balances is never written down.

use hexbench_core::{Hexapod, Matrix6, Observation, Pose, Vector3, Vector6, Wrench};
use nalgebra::{DMatrix, DVector, Isometry3, Rotation3, Translation3, UnitQuaternion};

use super::world::{coordinates, rigid};

/// Steps of Newton's method; a dozen suffice.
const MOST_STEPS: usize = 60;
/// Unknowns: plate and base as motions, six leg forces.
const UNKNOWNS: usize = 18;

/// The machine as it is. SI.
#[derive(Clone)]
pub(crate) struct Structure {
    pub(crate) drawn: Hexapod,
    pub(crate) compliance: [f64; 6],
    /// Joints against turns of their leg: base end, platform end, N m/rad.
    pub(crate) bending: [f64; 2],
    /// Sideways compliance of the mounts of the base joints, m/N.
    pub(crate) bracket: f64,
    /// Displacement of a base joint by the pull of its neighbor, m/N.
    pub(crate) coupling: f64,
    /// Elongation at 100 N (m) and exponent of a contact in series with each leg.
    pub(crate) contact: (f64, f64),
    /// Further compliance of legs in tension, m/N.
    pub(crate) tension: f64,
    /// Compliances of the base at its center, fixed axes, and of the plate at the mobile origin, mobile axes.
    pub(crate) bodies: [Vector6; 2],
}

/// Force and moment about an origin.
type Balance = (Vector3, Vector3);

impl Structure {
    pub(crate) fn on_springs(drawn: &Hexapod, stiffness: [f64; 6]) -> Self {
        Self {
            drawn: drawn.clone(),
            compliance: stiffness.map(f64::recip),
            bending: [0.0; 2],
            bracket: 0.0,
            coupling: 0.0,
            contact: (0.0, 1.0),
            tension: 0.0,
            bodies: [Vector6::zeros(); 2],
        }
    }

    fn elongation(&self, leg: usize, f: f64) -> f64 {
        let (size, power) = self.contact;
        self.compliance[leg] * f
            + size * f.signum() * (f.abs() / 100.0).powf(power)
            + self.tension * f.max(0.0)
    }

    /// What is out of balance, lengths over a micrometre, forces and moments over a newton (meter).
    fn imbalance(&self, command: &Isometry3<f64>, wrench: &Wrench, x: &DVector<f64>) -> DVector<f64> {
        let centre = self.drawn.base_centre();
        let plate = moved(command, &x.fixed_rows::<6>(0).into_owned());
        let base = moved(&Isometry3::from(Translation3::from(centre)), &x.fixed_rows::<6>(6).into_owned());
        let force: [f64; 6] = std::array::from_fn(|leg| x[12 + leg]);
        let loaded = self.loaded(&plate, wrench);
        let lever = loaded.translation.vector - plate.translation.vector;
        let mut on_plate = (wrench.force, wrench.moment + lever.cross(&wrench.force));
        let mut on_base: Balance = (Vector3::zeros(), Vector3::zeros());
        let feet = self.feet(&plate, &base, &force);
        let mut r = DVector::zeros(UNKNOWNS);
        for leg in 0..6 {
            let arm = plate.rotation * self.drawn.platform_joints[leg];
            let foot = feet[leg] - base.translation.vector;
            let span = plate.translation.vector + arm - feet[leg];
            let (length, n) = (span.norm(), span.normalize());
            let upright = command * point(&self.drawn.platform_joints[leg]) - self.drawn.base_joints[leg];
            let commanded = upright.coords.norm();
            let straight = upright.coords / commanded;
            r[leg] = (length - commanded - self.elongation(leg, force[leg])) * 1e6;
            // Moments on the leg turn it back to where its joints are at ease; a shear at its ends holds it.
            let of_base = self.bending[0] * n.cross(&(base.rotation * straight));
            let at_ease = plate.rotation * (command.rotation.inverse() * straight);
            let of_plate = self.bending[1] * n.cross(&at_ease);
            let pull = n * force[leg] + n.cross(&(of_base + of_plate)) / length;
            on_plate.0 -= pull;
            on_plate.1 -= arm.cross(&pull) + of_plate;
            on_base.0 += pull;
            on_base.1 += foot.cross(&pull) - of_base;
        }
        put(&mut r, 6, &on_plate.0, &on_plate.1);
        let yielded = self.bodies[0].component_mul(&six(&on_base.0, &on_base.1)) - x.fixed_rows::<6>(6);
        r.rows_mut(12, 6).copy_from(&(yielded * 1e6));
        r
    }

    /// Base joints where they are, pulled along on their brackets.
    fn feet(&self, plate: &Isometry3<f64>, base: &Isometry3<f64>, force: &[f64; 6]) -> [Vector3; 6] {
        let centre = self.drawn.base_centre();
        let at_rest =
            |leg: usize| base.translation.vector + base.rotation * (self.drawn.base_joints[leg] - centre);
        let mut feet: [Vector3; 6] = std::array::from_fn(at_rest);
        // Each pass gains the ratio of shift to leg length.
        for _ in 0..6 {
            let pull = |leg: usize| {
                let head = plate * point(&self.drawn.platform_joints[leg]);
                (head.coords - feet[leg]).normalize() * force[leg]
            };
            let pulls: [Vector3; 6] = std::array::from_fn(pull);
            feet = std::array::from_fn(|leg| {
                at_rest(leg) + self.bracket * Vector3::new(pulls[leg].x, pulls[leg].y, 0.0)
            });
            for [i, j] in self.drawn.bracket_pairs() {
                feet[i] += self.coupling * pulls[j];
                feet[j] += self.coupling * pulls[i];
            }
        }
        feet
    }

    /// The body that is loaded and measured, on the plate.
    fn loaded(&self, plate: &Isometry3<f64>, wrench: &Wrench) -> Isometry3<f64> {
        let own = |v: &Vector3| plate.rotation.inverse() * v;
        let d = self.bodies[1].component_mul(&six(&own(&wrench.force), &own(&wrench.moment)));
        plate * Isometry3::new(d.fixed_rows::<3>(0).into_owned(), d.fixed_rows::<3>(3).into_owned())
    }

    /// Where the measured body comes to rest.
    fn rest(&self, command: &Pose, wrench: &Wrench) -> Isometry3<f64> {
        let command = rigid(command);
        // Without any force the slope of a contact is not finite.
        let mut x = DVector::from_fn(UNKNOWNS, |k, _| if k < 12 { 0.0 } else { -30.0 });
        for _ in 0..MOST_STEPS {
            let r = self.imbalance(&command, wrench, &x);
            let slopes = DMatrix::from_fn(UNKNOWNS, UNKNOWNS, |_, _| 0.0);
            let slopes = (0..UNKNOWNS).fold(slopes, |mut all, k| {
                let step = if k < 12 { 1e-9 } else { 1e-4 };
                let mut beside = x.clone();
                beside[k] += step;
                all.set_column(k, &((self.imbalance(&command, wrench, &beside) - &r) / step));
                all
            });
            let step = slopes.lu().solve(&r).expect("a machine that stands");
            x -= &step;
            if step.rows(0, 12).amax() < 1e-17 && step.rows(12, 6).amax() < 1e-9 {
                break;
            }
        }
        assert!(self.imbalance(&command, wrench, &x).amax() < 1e-7, "no equilibrium");
        self.loaded(&moved(&command, &x.fixed_rows::<6>(0).into_owned()), wrench)
    }

    /// A plan as measured without noise: rotation vectors in fixed axes.
    pub(crate) fn measured(&self, plan: &[Observation]) -> Vec<Observation> {
        plan.iter().map(|o| Observation { measured: self.read(o), ..*o }).collect()
    }

    fn read(&self, o: &Observation) -> [f64; 6] {
        let [a, b] = [&o.reference, &o.wrench].map(|wrench| self.rest(&o.pose, wrench));
        let shift = coordinates(&b);
        let before = coordinates(&a);
        let turn = (b.rotation * a.rotation.inverse()).scaled_axis();
        std::array::from_fn(|k| if k < 3 { shift[k] - before[k] } else { turn[k - 3] })
    }
}

fn moved(place: &Isometry3<f64>, motion: &Vector6) -> Isometry3<f64> {
    let turn = Rotation3::new(motion.fixed_rows::<3>(3).into_owned());
    let shift = place.translation.vector + motion.fixed_rows::<3>(0);
    Isometry3::from_parts(
        Translation3::from(shift),
        UnitQuaternion::from_rotation_matrix(&turn) * place.rotation,
    )
}

fn point(v: &Vector3) -> nalgebra::Point3<f64> {
    nalgebra::Point3::from(*v)
}

fn six(upper: &Vector3, lower: &Vector3) -> Vector6 {
    super::six(upper, lower)
}

fn put(r: &mut DVector<f64>, at: usize, upper: &Vector3, lower: &Vector3) {
    r.rows_mut(at, 6).copy_from(&six(upper, lower));
}

/// A diagonal compliance from stiffnesses along and about the axes.
pub(crate) fn yielding(along: f64, about: f64) -> Vector6 {
    let k = Matrix6::from_diagonal(&Vector6::from_fn(|k, _| if k < 3 { along } else { about }));
    k.diagonal().map(f64::recip)
}
