//! Newton's method from the commanded pose.

use hexbench_core::Vector3;

use super::{
    Body,
    assembly::{Bodies, Layout, derivatives, imbalance},
    leg::{Leg, legs},
};
use crate::{
    LegLaw, LegMemory, Setup, TruthError,
    law::LawPoint,
    linear::{self, MOST},
};

/// Newton steps before giving up; four are usual, a dozen when a leg crosses its play.
const MOST_ITERATIONS: usize = 60;
/// A step below this share of the largest scaled unknown is the last: what it leaves is four digits smaller still.
const LAST_STEP: f64 = 1e-10;
/// Imbalance accepted at the end, per newton of the largest scaled unknown: rounding of leg lengths times stiffness.
const ACCEPTED_IMBALANCE: f64 = 1e-8;
/// Below this ratio of pivots the legs do not hold the platform (a good machine has 0.01 to 0.5).
const SMALLEST_PIVOT_RATIO: f64 = 1e-5;
/// Farthest the platform may go from the commanded pose, as a share of its radius and in rad.
const FARTHEST: f64 = 0.1;

/// A state of rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equilibrium {
    /// The loaded and measured body; its origin is the mobile origin.
    pub platform: Body,
    /// The body that the legs hold.
    pub plate: Body,
    /// The base, its origin at the base center.
    pub base: Body,
    /// Leg forces, N, tension positive.
    pub forces: [f64; 6],
    /// Leg elongations against the commanded lengths, m.
    pub elongations: [f64; 6],
    /// What the legs remember of this state.
    pub memory: [LegMemory; 6],
    /// Newton steps taken.
    pub iterations: usize,
}

struct Iterate {
    parameters: [f64; 6],
    bodies: Bodies,
    legs: [Leg; 6],
    residual: [f64; MOST],
    norm: f64,
}

/// State of rest of a structure, given what its legs remember.
///
/// # Errors
/// [`TruthError::NoSpring`], [`TruthError::Singular`], [`TruthError::GaveWay`], [`TruthError::NotConverged`],
/// [`TruthError::NotFinite`].
pub fn solve(setup: &Setup, remembered: &[LegMemory; 6]) -> Result<Equilibrium, TruthError> {
    check_springs(setup)?;
    let layout = Layout::of(setup);
    let mut now = start(setup, &layout, remembered)?;
    for iteration in 1..=MOST_ITERATIONS {
        let mut step = now.residual.map(|r| -r);
        let mut matrix = derivatives(setup, &layout, &now.bodies, &now.legs);
        let pivot_ratio = linear::solve(&mut matrix, &mut step, layout.unknowns);
        if pivot_ratio.is_nan() || pivot_ratio < SMALLEST_PIVOT_RATIO {
            return Err(TruthError::Singular { pivot_ratio });
        }
        now = damped(setup, &layout, remembered, &now, &step);
        check_place(setup, &layout, &now.bodies)?;
        let size = largest(&now.parameters).max(1.0);
        if largest(&step[..layout.unknowns]) <= LAST_STEP * size && now.norm <= ACCEPTED_IMBALANCE * size {
            return Ok(finished(setup, remembered, &now, iteration));
        }
    }
    Err(TruthError::NotConverged { iterations: MOST_ITERATIONS, imbalance_n: now.norm })
}

/// A negative compliance would have an equilibrium, and one that no machine can be in.
fn check_springs(setup: &Setup) -> Result<(), TruthError> {
    let compliances = setup.laws.iter().map(LegLaw::compliance_at_length);
    let negative = (1..).zip(compliances).find(|(_, compliance)| *compliance < 0.0);
    negative.map_or(Ok(()), |(leg, compliance)| Err(TruthError::NoSpring { leg, compliance }))
}

/// The commanded pose with the leg forces that hold the wrench there.
fn start(setup: &Setup, layout: &Layout, remembered: &[LegMemory; 6]) -> Result<Iterate, TruthError> {
    let place = Body::at(&setup.pose);
    let bodies = Bodies { plate: place, base: Body::upright(setup.base_centre), loaded: place };
    let slack =
        legs(setup, &bodies.plate, &bodies.base, &[LawPoint { force_slope: 1.0, ..LawPoint::default() }; 6]);
    let residual = imbalance(setup, layout, &bodies, &slack);
    if !residual.iter().all(|r| r.is_finite()) {
        return Err(TruthError::NotFinite { what: "pose, wrench or a parameter of the machine" });
    }
    let (mut matrix, mut forces) = ([[0.0; MOST]; MOST], [0.0; MOST]);
    forces[..6].copy_from_slice(&residual[6..12]);
    for (i, leg) in slack.iter().enumerate() {
        let moment = leg.upper_arm.cross(&leg.direction) / layout.radius;
        for axis in 0..3 {
            matrix[axis][i] = leg.direction[axis];
            matrix[axis + 3][i] = moment[axis];
        }
    }
    let pivot_ratio = linear::solve(&mut matrix, &mut forces, 6);
    if pivot_ratio.is_nan() || pivot_ratio < SMALLEST_PIVOT_RATIO {
        return Err(TruthError::Singular { pivot_ratio });
    }
    let parameters =
        std::array::from_fn(|i| setup.laws[i].parameter(forces[i], layout.stiffness, remembered[i]));
    Ok(evaluate(setup, layout, remembered, parameters, &bodies))
}

fn evaluate(
    setup: &Setup,
    layout: &Layout,
    remembered: &[LegMemory; 6],
    parameters: [f64; 6],
    bodies: &Bodies,
) -> Iterate {
    let points: [LawPoint; 6] =
        std::array::from_fn(|i| setup.laws[i].at(parameters[i], layout.stiffness, remembered[i]));
    let legs = legs(setup, &bodies.plate, &bodies.base, &points);
    let residual = imbalance(setup, layout, bodies, &legs);
    let norm = largest(&residual[..layout.unknowns]);
    Iterate { parameters, bodies: *bodies, legs, residual, norm }
}

/// The full step, or a part of it where the full one makes the imbalance worse; the last part is taken as it is, so that
/// kinks are crossed.
fn damped(
    setup: &Setup,
    layout: &Layout,
    remembered: &[LegMemory; 6],
    from: &Iterate,
    step: &[f64; MOST],
) -> Iterate {
    const SHORTEST: f64 = 0.1;
    let mut share = 1.0;
    loop {
        let parameters = std::array::from_fn(|i| from.parameters[i] + share * step[i]);
        let bodies = moved(layout, &from.bodies, step, share);
        let next = evaluate(setup, layout, remembered, parameters, &bodies);
        if next.norm <= from.norm || share < SHORTEST || from.norm < ACCEPTED_IMBALANCE {
            return next;
        }
        share *= 0.5;
    }
}

fn moved(layout: &Layout, bodies: &Bodies, step: &[f64; MOST], share: f64) -> Bodies {
    let shift = share / layout.stiffness;
    let turn = shift / layout.radius;
    let by = |body: &Body, start: usize| {
        let translation = Vector3::from_column_slice(&step[start..start + 3]) * shift;
        body.moved(&translation, &(Vector3::from_column_slice(&step[start + 3..start + 6]) * turn))
    };
    let plate = by(&bodies.plate, layout.plate);
    Bodies {
        plate,
        base: layout.base.map_or(bodies.base, |start| by(&bodies.base, start)),
        loaded: layout.loaded.map_or(plate, |start| by(&bodies.loaded, start)),
    }
}

fn check_place(setup: &Setup, layout: &Layout, bodies: &Bodies) -> Result<(), TruthError> {
    let away = bodies.loaded.relative_to(&Body::at(&setup.pose));
    let (distance, angle) = (away.fixed_rows::<3>(0).norm(), away.fixed_rows::<3>(3).norm());
    if distance < FARTHEST * layout.radius && angle < FARTHEST {
        return Ok(());
    }
    Err(TruthError::GaveWay { translation_mm: distance * 1e3, rotation_deg: angle.to_degrees() })
}

fn finished(setup: &Setup, remembered: &[LegMemory; 6], at: &Iterate, iterations: usize) -> Equilibrium {
    let forces = at.legs.map(|leg| leg.point.force);
    Equilibrium {
        platform: at.bodies.loaded,
        plate: at.bodies.plate,
        base: at.bodies.base,
        forces,
        elongations: at.legs.map(|leg| leg.point.elongation),
        memory: std::array::from_fn(|i| LegMemory {
            force: forces[i],
            spring_force: setup.laws[i].spring_force(forces[i], remembered[i]),
        }),
        iterations,
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, v| if m.is_nan() || v.is_nan() { f64::NAN } else { m.max(v.abs()) })
}

#[cfg(test)]
mod tests {
    use hexbench_core::streams::{Purpose, stream};
    use hexbench_core::{Pose, Wrench};

    use super::*;
    use crate::{Instant, Phase, Situation, World, campaign::machines::RING_B, mechanisms::REGISTRY};

    /// Central differences of the imbalance, by the scaled unknowns, about a state.
    fn differences(setup: &Setup, layout: &Layout, at: &Iterate) -> Vec<[f64; MOST]> {
        const STEP: f64 = 0.05;
        let memory = [LegMemory::default(); 6];
        let shifted = |k: usize, size: f64| {
            let mut step = [0.0; MOST];
            step[k] = size;
            let parameters = std::array::from_fn(|i| at.parameters[i] + step[i]);
            evaluate(setup, layout, &memory, parameters, &moved(layout, &at.bodies, &step, 1.0)).residual
        };
        let column = |k| {
            let (plus, minus) = (shifted(k, STEP), shifted(k, -STEP));
            std::array::from_fn(|i| (plus[i] - minus[i]) / (2.0 * STEP))
        };
        (0..layout.unknowns).map(column).collect()
    }

    #[test]
    fn derivatives_agree_with_differences_but_for_the_terms_left_out() {
        let hexapod = RING_B.hexapod("ring_b");
        let pose = Pose::from_array([0.02, -0.01, 0.005, 0.08, -0.05, 0.1]);
        let wrench = Wrench::from_array([60.0, -30.0, -330.0, 4.0, 2.0, -1.0]);
        let situation = Situation::new(pose, wrench);
        for effect in REGISTRY {
            let world = World::new(hexapod.clone(), &[4e6; 6])
                .with((effect.draw)(&hexapod, &mut stream(1, Purpose::Test, [1])).scaled(3.0));
            let lengths = world.reading(&situation).unwrap().equilibrium.elongations;
            let moment = Instant {
                hexapod: &hexapod,
                situation: &situation,
                phase: Phase::Loaded,
                nominal_lengths: lengths.map(|e| 0.2 + e),
                home_lengths: [0.2; 6],
                past: &[crate::PastForces { forces: [-40.0; 6], put_on: None, is_reference: true }],
                put_on: 0.0,
            };
            let setup = world.setup(&moment, wrench);
            let layout = Layout::of(&setup);
            let at = start(&setup, &layout, &[LegMemory::default(); 6]).unwrap();
            let exact = differences(&setup, &layout, &at);
            let used = derivatives(&setup, &layout, &at.bodies, &at.legs);
            for (k, column) in exact.iter().enumerate() {
                for i in 0..layout.unknowns {
                    let error = (used[i][k] - column[i]).abs();
                    assert!(error < 2e-3, "{} d{i}/d{k}: {} for {}", effect.id, used[i][k], column[i]);
                }
            }
        }
    }
}
