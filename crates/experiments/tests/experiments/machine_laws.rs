//! Five laws of real machines, written down from mechanics before the grammar of laws was read, then searched for.
//!
//! Each is what a designer would write for one part of a machine: a preloaded bearing, a screw held at both ends, a bowed strut, air
//! conditioning, clamps of a base. What came out is reported beside each, whether the grammar can say the law or not.

use std::f64::consts::TAU;

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Hexapod, Matrix6, Wrench};
use hexbench_model::results::diagnose::{DiagnoseOptions, StepReport};
use hexbench_model::results::discover::{Discovery, discover};
use hexbench_model::terms::catalogue;
use hexbench_truth::campaign::{PlanKind, SimulatedCampaign, Yardstick, machines, measure};
use hexbench_truth::metrology::{InstrumentFrames, InstrumentNoise};
use hexbench_truth::{Instant, Mechanism, Setup, World};
use serde_json::{Map, Value};

/// How far each law stands beyond what the springs absorb.
const DISTANCE: f64 = 40.0;

/// A law of one part of a machine.
#[derive(Debug, Clone, Copy)]
enum Part {
    /// Bearings preloaded against each other: once the force exceeds the preload one row of balls lifts off, and the other alone is softer.
    /// `e = s sgn(f) max(|f| - preload, 0)`.
    PreloadedBearing { preload_n: f64 },
    /// A screw held at both ends: its compliance is a parabola in the place of the nut, least softened away from the middle.
    /// `e = -s (q - middle)^2 f`.
    ScrewHeldAtBothEnds { middle_from_home_m: f64 },
    /// A slightly bowed strut shortens as its bow grows toward the load under which it buckles.
    /// `e = -s / q (1 / (1 + f / (P (q_home / q)^2))^2 - 1)`, f < 0 in compression. Source: Timoshenko and Gere, Theory of Elastic Stability, 1.12.
    BowedStrut { buckling_n: f64 },
    /// A leg beside a vent follows the cycle of the air conditioning: `e = s sin(2 pi t / period)`.
    AirConditioning { leg: usize, period_s: f64 },
    /// Clamps of the base slip once the lateral force exceeds their friction: the base moves along x by `s sgn(F_x) max(|F_x| - friction, 0)`.
    SlippingClamps { friction_n: f64 },
}

/// A law and its size.
#[derive(Debug, Clone, Copy)]
struct MachineLaw {
    part: Part,
    size: f64,
}

/// Forces of the legs of the nominal machine at the commanded pose, N, tension positive.
fn leg_forces(setup: &Setup) -> [f64; 6] {
    let (r, t) = (setup.pose.rotation(), setup.pose.translation);
    let mut of_units = Matrix6::zeros();
    for leg in 0..6 {
        let arm = r * setup.platform_joints[leg];
        let n = (t + arm - setup.base_joints[leg]).normalize();
        of_units.column_mut(leg).copy_from_slice([n, arm.cross(&n)].map(|v| [v.x, v.y, v.z]).as_flattened());
    }
    of_units.lu().solve(&setup.wrench.to_vector()).map_or([0.0; 6], Into::into)
}

/// What exceeds a limit, with its sign.
fn beyond(value: f64, limit: f64) -> f64 {
    value.signum() * (value.abs() - limit).max(0.0)
}

impl Mechanism for MachineLaw {
    fn id(&self) -> &'static str {
        "out:machine-law"
    }

    fn act(&self, instant: &Instant<'_>, setup: &mut Setup) {
        let (forces, lengths, home) = (leg_forces(setup), instant.nominal_lengths, instant.home_lengths);
        let mut grow = |elongation: &dyn Fn(usize) -> f64| {
            for leg in 0..6 {
                setup.leg_lengths[leg] += self.size * elongation(leg);
            }
        };
        match self.part {
            Part::PreloadedBearing { preload_n } => grow(&|i| beyond(forces[i], preload_n)),
            Part::ScrewHeldAtBothEnds { middle_from_home_m } => {
                grow(&|i| -(lengths[i] - home[i] - middle_from_home_m).powi(2) * forces[i]);
            }
            Part::BowedStrut { buckling_n } => grow(&|i| {
                let load = -forces[i] / buckling_n * (lengths[i] / home[i]).powi(2);
                (1.0 - (1.0 - load).powi(-2)) / lengths[i]
            }),
            Part::AirConditioning { leg, period_s } => {
                grow(&|i| if i + 1 == leg { (TAU * instant.elapsed() / period_s).sin() } else { 0.0 });
            }
            Part::SlippingClamps { friction_n } => {
                let Wrench { force, .. } = setup.wrench;
                for joint in &mut setup.base_joints {
                    joint.x += self.size * beyond(force.x, friction_n);
                }
            }
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { size: self.size * factor, ..*self })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::new()
    }
}
