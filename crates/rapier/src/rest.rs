//! States of rest, found by letting the machine come to rest.

use hexbench_truth::{
    LegMemory, Setup, Statics, TruthError,
    equilibrium::{Body, Equilibrium},
};

use crate::{inexpressible, law, masses, parts::Stepping, scene::BodyScene};

/// Farthest the platform may go from the commanded pose, as a share of its radius and in rad.
const FARTHEST: f64 = 0.1;

/// The world of the engine: legs as bodies, springs as motors, brought to rest by damping.
///
/// Masses are chosen for speed ([`masses::quickest`]); a state of rest does not depend on them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RapierStatics {
    /// Angle through which the fastest mode turns in a step, rad.
    pub phase: f64,
    /// Sweeps over the joints in a step.
    pub sweeps: usize,
    /// At rest when no force but the static ones exceeds this share of the largest leg force (at least of 1 N).
    pub unrest: f64,
    /// Widest gap of a joint at rest, m.
    pub gap: f64,
    /// Steps before giving up.
    pub most_steps: usize,
}

impl Default for RapierStatics {
    /// A relative error of 1e-6 and less in about 50 ms.
    fn default() -> Self {
        Self { phase: 0.5, sweeps: 50, unrest: 1e-8, gap: 1e-10, most_steps: 20_000 }
    }
}

impl Statics for RapierStatics {
    fn rest(&self, setup: &Setup, remembered: &[LegMemory; 6]) -> Result<Equilibrium, TruthError> {
        expressible(setup)?;
        // Only the phase per step matters: time is measured in steps of a millisecond.
        let stepping = Stepping { dt: 1e-3, sweeps: self.sweeps };
        let dynamics = masses::quickest(setup, stepping.dt, self.phase);
        let mut scene = BodyScene::new(setup, remembered, &dynamics, &stepping)?;
        for step in 1..=self.most_steps {
            scene.step();
            check_place(setup, &scene.loaded())?;
            let largest = scene.forces().iter().fold(1.0_f64, |m, f| m.max(f.abs()));
            if scene.unrest() <= self.unrest * largest && scene.gap() <= self.gap {
                return Ok(state(setup, remembered, &scene, step));
            }
        }
        Err(TruthError::NotConverged { iterations: self.most_steps, imbalance_n: scene.unrest() })
    }
}

fn expressible(setup: &Setup) -> Result<(), TruthError> {
    let numbers = setup.wrench.to_array().into_iter().chain(setup.pose.to_array()).chain(setup.leg_lengths);
    if !numbers.chain(setup.laws.iter().map(|l| l.compliance)).all(f64::is_finite) {
        return Err(TruthError::NotFinite { what: "pose, wrench or a parameter of the machine" });
    }
    if setup.laws.iter().any(|l| !l.own.is_empty()) {
        return Err(inexpressible("a leg whose law is a formula"));
    }
    if setup.laws.iter().any(|l| l.slider_force != 0.0 && l.slider_ratio.is_infinite()) {
        return Err(inexpressible("a rigid friction slider: its force does not follow from the elongation"));
    }
    Ok(())
}

fn check_place(setup: &Setup, platform: &Body) -> Result<(), TruthError> {
    let away = platform.relative_to(&Body::at(&setup.pose));
    let (distance, angle) = (away.fixed_rows::<3>(0).norm(), away.fixed_rows::<3>(3).norm());
    let radius = setup.platform_joints.iter().map(nalgebra::Matrix::norm).sum::<f64>() / 6.0;
    if distance < FARTHEST * radius && angle < FARTHEST {
        return Ok(());
    }
    Err(TruthError::GaveWay { translation_mm: distance * 1e3, rotation_deg: angle.to_degrees() })
}

fn state(setup: &Setup, remembered: &[LegMemory; 6], scene: &BodyScene, iterations: usize) -> Equilibrium {
    let forces = scene.forces();
    Equilibrium {
        platform: scene.loaded(),
        plate: scene.plate(),
        base: scene.base(),
        forces,
        elongations: scene.elongations(),
        memory: std::array::from_fn(|i| LegMemory {
            force: forces[i],
            spring_force: law::held(&setup.laws[i], forces[i], remembered[i]).0,
        }),
        iterations,
    }
}
