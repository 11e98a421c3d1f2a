//! Which number of the model stands for which number of the world: the one place that knows both.
//!
//! The world's numbers are those of `Mechanism::parameters` (the case files, SI); the model's are named and shown by
//! `hexbench_model::estimation::estimate` (`term.parameter`, shown unit).

use std::f64::consts::TAU;

use hexbench_core::{Hexapod, Vector3};
use serde_json::{Map, Value};

/// Standard gravity as the world has it, m/s^2.
const GRAVITY_M_PER_S2: f64 = 9.81;
/// Force at which the model states the size of a nonlinear spring, N.
const STATED_AT_N: f64 = 100.0;

/// The parameters of the world as the model's term has them, SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Equivalent {
    /// Value of every parameter of the ideal form, in the order of the term; `None` where the world has no such number.
    pub values: Vec<Option<f64>>,
    /// Value of the shape that is not a parameter.
    pub shape: Option<f64>,
}

/// How one effect of the world is written as a term of the model.
pub struct Correspondence {
    /// Id in both catalogues.
    pub effect: &'static str,
    /// Key of the world's numbers in the case files.
    pub world: &'static str,
    /// Rule from the world's numbers to the model's, for people.
    pub rule: &'static str,
    /// Why some numbers of the two forms differ; empty when they are the same physics.
    pub differs: &'static str,
    convert: Conversion,
}

/// From the world's numbers to the model's.
#[derive(Clone, Copy)]
enum Conversion {
    /// The same numbers in the same order.
    Same,
    /// Compliances of stiffnesses.
    Reciprocal,
    /// Something else.
    Special(fn(&Value) -> Equivalent),
    /// Joints, of which the world gives the true places.
    Joints,
    /// Waves over the leg length: the world counts phases from zero length, the model from the home length.
    Waves,
}

/// Every effect of the catalogue.
pub const CORRESPONDENCES: &[Correspondence] = &[
    same("leg-length-compliance", "screw", "slope = s"),
    Correspondence {
        effect: "leg-nonlinearity",
        world: "power",
        rule: "elongation-at-100-N = kappa 100^p, exponent = p",
        differs: "",
        convert: Conversion::Special(|v| {
            let (kappa, power) = (number(&v[0]), number(&v[1]));
            Equivalent { values: vec![Some(kappa * STATED_AT_N.powf(power))], shape: Some(power) }
        }),
    },
    same("leg-asymmetry", "asymmetry", "tension-compliance = c_t"),
    same("leg-backlash", "backlash", "gap = gap, of a contact that closes at once"),
    Correspondence {
        differs: "the world's slider is an elastic bristle twenty times as stiff as the leg, the model's is rigid",
        ..same("joint-friction", "friction", "force = f_c")
    },
    same("joint-rotation-stiffness", "joint_rotation", "base-end, platform-end = k of each joint"),
    same("bracket-compliance", "bracket", "lateral-compliance = c_lat"),
    same("leg-coupling", "coupling", "cross-compliance = c_x"),
    inverse("base-compliance", "base"),
    inverse("platform-compliance", "platform"),
    same("load-offset", "cog", "x, y, z = r'"),
    same("load-tilt", "tilt", "about-x, about-y = angles"),
    same("thermal-expansion", "alpha", "coefficient = alpha"),
    same("metrology-drift", "drift", "rates = rates of the numbers that are read"),
    same("target-offset", "target", "x, y, z = r'"),
    Correspondence {
        effect: "creep",
        world: "creep",
        rule: "fraction = chi, time-constant = tau, of a preload that has settled",
        differs: "",
        convert: Conversion::Special(|v| Equivalent {
            values: vec![Some(number(&v[0]))],
            shape: Some(number(&v[1])),
        }),
    },
    Correspondence {
        effect: "joint-geometry",
        world: "A_true, B_true",
        rule: "base-i, platform-i = true minus nominal joint; twelve combinations belong to the frames",
        differs: "",
        convert: Conversion::Joints,
    },
    same("leg-offset", "leg_offset", "leg-i = offset_i"),
    same("actuator-scale", "actuator_scale", "leg-i = gain_i"),
    Correspondence {
        effect: "actuator-pitch",
        world: "actuator_pitch",
        rule: "leg-i-sine = amp cos(phi_i), leg-i-cosine = amp sin(phi_i), phi_i = phase_i + 2 pi q_home,i / pitch",
        differs: "",
        convert: Conversion::Waves,
    },
    Correspondence {
        effect: "leg-weight",
        world: "leg_weight",
        rule: "weight-per-leg = m g",
        differs: "",
        convert: Conversion::Special(|v| plain(vec![number(v) * GRAVITY_M_PER_S2])),
    },
];

const fn same(effect: &'static str, world: &'static str, rule: &'static str) -> Correspondence {
    Correspondence { effect, world, rule, differs: "", convert: Conversion::Same }
}

const fn inverse(effect: &'static str, world: &'static str) -> Correspondence {
    Correspondence {
        effect,
        world,
        rule: "compliance along and about each axis = 1 / stiffness",
        differs: "",
        convert: Conversion::Reciprocal,
    }
}

fn plain(values: Vec<f64>) -> Equivalent {
    Equivalent { values: values.into_iter().map(Some).collect(), shape: None }
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// A number or the numbers of a list, lists of lists in order.
fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().map_or_else(|| vec![number(value)], |all| all.iter().flat_map(numbers).collect())
}

/// What the model should find for an effect of the world with these parameters; `None` when the effect or its numbers
/// are not known here.
pub fn equivalent(effect: &str, parameters: &Map<String, Value>, hexapod: &Hexapod) -> Option<Equivalent> {
    let c = CORRESPONDENCES.iter().find(|c| c.effect == effect)?;
    match c.convert {
        Conversion::Waves => Some(waves(parameters.get(c.world)?, hexapod)),
        Conversion::Joints => joint_errors(parameters, hexapod).map(plain),
        Conversion::Same => Some(plain(numbers(parameters.get(c.world)?))),
        Conversion::Reciprocal => {
            Some(plain(numbers(parameters.get(c.world)?).into_iter().map(f64::recip).collect()))
        }
        Conversion::Special(convert) => Some(convert(parameters.get(c.world)?)),
    }
}

/// True minus nominal joints, base joints first, m.
fn joint_errors(parameters: &Map<String, Value>, hexapod: &Hexapod) -> Option<Vec<f64>> {
    let of = |key: &str, nominal: &[Vector3; 6]| -> Option<Vec<f64>> {
        let found = numbers(parameters.get(key)?);
        Some(found.iter().zip(nominal.iter().flat_map(|j| j.iter())).map(|(x, n)| x - n).collect())
    };
    let mut all = of("A_true", &hexapod.base_joints)?;
    all.extend(of("B_true", &hexapod.platform_joints)?);
    Some(all)
}

/// Sine and cosine amplitude of each leg about its home length, and the pitch.
fn waves(world: &Value, hexapod: &Hexapod) -> Equivalent {
    let (amplitude, pitch) = (number(&world[0]), number(&world[1]));
    let home = |leg: usize| (hexapod.platform_joints[leg] - hexapod.base_joints[leg]).norm();
    let turned = |(leg, phase): (usize, f64)| phase + TAU * home(leg) / pitch;
    let parts = numbers(&world[2]).into_iter().enumerate().map(turned).flat_map(|phi| [phi.cos(), phi.sin()]);
    Equivalent { values: parts.map(|w| Some(amplitude * w)).collect(), shape: Some(pitch) }
}
