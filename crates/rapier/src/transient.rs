//! How the machine settles after a load step, with true masses.

use hexbench_core::files::CsvText;
use hexbench_core::{Hexapod, Pose, Vector6, Wrench};
use hexbench_truth::{Instant, LegMemory, Newton, Phase, Setup, Situation, Statics, TruthError, World};

use crate::{
    Modes, inexpressible,
    parts::{Dynamics, Inertia, Stepping},
    scene::BodyScene,
    whole,
};

/// Most sweeps over the joints in a step; lighter legs than these allow for are refused.
const MOST_SWEEPS: f64 = 2000.0;
/// Share of the last deflection within which the machine counts as settled.
pub const SETTLED: f64 = 0.02;
/// What is left of the lowest mode at the end of the trace.
const LEFT: f64 = 1e-4;
/// Angle through which the fastest mode turns in a step, rad: errs by its square over 24 in frequency, 0.04 %.
const PHASE: f64 = 0.1;
/// Samples in a period of the fastest mode.
const SAMPLES_PER_PERIOD: f64 = 20.0;

/// What moves, and how it is damped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadStep {
    /// Platform with its payload, center of mass at the mobile origin.
    pub platform: Inertia,
    /// Mass of each leg, kg.
    pub leg_mass: f64,
    /// Damping of the lowest mode over its critical damping, by dampers beside the leg springs.
    pub damping_ratio: f64,
}

impl LoadStep {
    /// Sweeps that settle the joints: light bodies that carry a heavy one take as many more as it is heavier.
    fn sweeps(&self) -> usize {
        const FEWEST: f64 = 50.0;
        whole((8.0 * self.platform.mass / self.leg_mass).max(FEWEST))
    }
}

/// One moment of the trace.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraceSample {
    /// Time after the step, s.
    pub time: f64,
    /// Pose parameters minus the commanded ones, m and rad.
    pub deflection: Vector6,
    /// Leg forces, N, without those of the dampers.
    pub forces: [f64; 6],
}

/// A settled machine and the way there.
#[derive(Debug, Clone, PartialEq)]
pub struct Transient {
    /// Natural modes of the linear machine.
    pub modes: Modes,
    /// The trace; never empty.
    pub samples: Vec<TraceSample>,
    /// Time after which the deflection stays within [`SETTLED`] of its last value, s.
    pub settling_time: f64,
    /// Frequency at which the lowest mode was seen to swing, Hz; none when it hardly did.
    pub observed_frequency_hz: Option<f64>,
}

impl Transient {
    /// Deflection at the end of the trace, m and rad.
    pub fn limit(&self) -> Vector6 {
        self.samples.last().map_or_else(Vector6::zeros, |s| s.deflection)
    }
}

/// The nominal machine with linear leg springs (N/m) at a pose, under a wrench.
///
/// # Errors
/// [`TruthError::NotFinite`].
pub fn nominal(
    hexapod: &Hexapod,
    stiffness: &[f64; 6],
    pose: Pose,
    wrench: Wrench,
) -> Result<Setup, TruthError> {
    let numbers = pose.to_array().into_iter().chain(wrench.to_array()).chain(*stiffness);
    if !numbers.into_iter().all(f64::is_finite) {
        return Err(TruthError::NotFinite { what: "pose, wrench or stiffness" });
    }
    let (situation, r) = (Situation::new(pose, wrench), pose.rotation());
    let lengths = std::array::from_fn(|i| {
        (pose.translation + r * hexapod.platform_joints[i] - hexapod.base_joints[i]).norm()
    });
    let moment = Instant {
        hexapod,
        situation: &situation,
        phase: Phase::Loaded,
        nominal_lengths: lengths,
        home_lengths: lengths,
        past: &[],
        put_on: 0.0,
    };
    Ok(World::new(hexapod.clone(), stiffness).setup(&moment, wrench))
}

/// Deflection (m, rad; Euler differences) at which the first world comes to rest.
///
/// # Errors
/// As [`hexbench_truth::equilibrium::solve`].
pub fn static_deflection(setup: &Setup) -> Result<Vector6, TruthError> {
    let rest = Newton.rest(setup, &[LegMemory::default(); 6])?;
    let pose = Pose::from_rotation(rest.platform.origin, &rest.platform.axes);
    Ok(pose.to_vector() - setup.pose.to_vector())
}

/// The machine stands unloaded at the pose; at time zero the wrench of the setup acts. Gravity does not: the trace is the
/// deflection by the wrench.
///
/// # Errors
/// [`TruthError::BadParameters`]: no mass, no damping. [`TruthError::Singular`]: legs that do not hold the platform.
/// [`TruthError::Inexpressible`]: yielding base or plate, whose masses nobody stated.
pub fn settle(setup: &Setup, step: &LoadStep) -> Result<Transient, TruthError> {
    check(setup, step)?;
    let singular = TruthError::Singular { pivot_ratio: 0.0 };
    let modes = Modes::of(setup, &step.platform, step.leg_mass).ok_or(singular)?;
    let [lowest, .., highest] = modes.angular_frequencies;
    let stepping = Stepping { dt: PHASE / highest, sweeps: step.sweeps() };
    let dynamics = Dynamics {
        plate: step.platform,
        loaded: step.platform,
        base: step.platform,
        half_leg: 0.5 * step.leg_mass,
        per_stiffness: 2.0 * step.damping_ratio / lowest,
        per_mass: 0.0,
    };
    let scene = BodyScene::new(setup, &[LegMemory::default(); 6], &dynamics, &stepping)?;
    // A mode damped beyond critical creeps home at about omega / (2 ratio).
    let decay = lowest * step.damping_ratio.min(0.5 / step.damping_ratio);
    let samples = trace(scene, &setup.pose, &stepping, LEFT.ln().abs() / decay);
    Ok(Transient {
        settling_time: settling_time(&samples, radius(setup)),
        observed_frequency_hz: observed(&samples, &modes),
        samples,
        modes,
    })
}

fn check(setup: &Setup, step: &LoadStep) -> Result<(), TruthError> {
    let bad = |why: &str| Err(TruthError::BadParameters { id: "load step".to_owned(), why: why.to_owned() });
    let positive = |x: f64| x.is_finite() && x > 0.0;
    if !step.platform.principal.into_iter().chain([step.platform.mass, step.leg_mass]).all(positive) {
        return bad("masses and moments of inertia have to be positive");
    }
    if !positive(step.damping_ratio) {
        return bad("the damping ratio has to be positive");
    }
    if 8.0 * step.platform.mass / step.leg_mass > MOST_SWEEPS {
        return bad("legs have to weigh at least 1/250 of the platform");
    }
    if setup.base_compliance.is_some() || setup.plate_compliance.is_some() {
        return Err(inexpressible("the transient of a yielding base or plate: its mass is not known"));
    }
    Ok(())
}

fn radius(setup: &Setup) -> f64 {
    setup.platform_joints.iter().map(nalgebra::Matrix::norm).sum::<f64>() / 6.0
}

fn trace(mut scene: BodyScene, commanded: &Pose, stepping: &Stepping, duration: f64) -> Vec<TraceSample> {
    let stride = whole((std::f64::consts::TAU / PHASE / SAMPLES_PER_PERIOD).round().max(1.0));
    let count = whole((duration / (stepping.dt * stride as f64)).ceil());
    let sample = |scene: &BodyScene, i: usize| {
        let place = scene.loaded();
        let pose = Pose::from_rotation(place.origin, &place.axes);
        TraceSample {
            time: (i * stride) as f64 * stepping.dt,
            deflection: pose.to_vector() - commanded.to_vector(),
            forces: scene.forces(),
        }
    };
    let mut samples = vec![sample(&scene, 0)];
    for i in 1..=count {
        (0..stride).for_each(|_| scene.step());
        samples.push(sample(&scene, i));
    }
    samples
}

/// Size of a deflection, rotations at the radius, m.
fn size(d: &Vector6, radius: f64) -> f64 {
    d.fixed_rows::<3>(0).norm().hypot(radius * d.fixed_rows::<3>(3).norm())
}

fn settling_time(samples: &[TraceSample], radius: f64) -> f64 {
    let last = samples.last().map_or_else(Vector6::zeros, |s| s.deflection);
    let limit = SETTLED * size(&last, radius);
    let outside = |s: &&TraceSample| size(&(s.deflection - last), radius) > limit;
    samples.iter().rev().find(outside).map_or(0.0, |s| s.time)
}

/// Frequency of the lowest mode from the first zero crossings of its coordinate `x_1' M (d - d_end)`.
///
/// Small angles: Euler differences stand for the rotation vector through the commanded orientation's first-order map, which
/// scales a coordinate but moves no crossing by more than the deflection's own size.
fn observed(samples: &[TraceSample], modes: &Modes) -> Option<f64> {
    const MOST_CROSSINGS: usize = 21;
    const FEWEST_CROSSINGS: usize = 5;
    /// Share of the lowest mode in the whole motion, below which only rounding swings there.
    const LEAST_SWING: f64 = 1e-3;
    let row = modes.mass * modes.shapes.column(0);
    let last = samples.last()?.deflection;
    let swing: Vec<f64> = samples.iter().map(|s| row.dot(&(s.deflection - last))).collect();
    let metric = |d: &Vector6| d.dot(&(modes.mass * d)).max(0.0).sqrt();
    let whole = samples.iter().map(|s| metric(&(s.deflection - last))).fold(0.0, f64::max);
    let shape = metric(&modes.shapes.column(0).into_owned());
    let largest = swing.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if largest <= LEAST_SWING * shape * whole {
        return None;
    }
    let crossings: Vec<f64> = swing
        .windows(2)
        .zip(samples.windows(2))
        .filter(|(a, _)| a[0] * a[1] < 0.0)
        .map(|(a, s)| s[0].time + (s[1].time - s[0].time) * a[0] / (a[0] - a[1]))
        .take(MOST_CROSSINGS)
        .collect();
    if crossings.len() < FEWEST_CROSSINGS {
        return None;
    }
    let half_periods = (crossings.len() - 1) as f64;
    Some(half_periods / (2.0 * (crossings.last()? - crossings.first()?)))
}

/// The trace as a table, units in the names.
pub fn csv(samples: &[TraceSample]) -> String {
    let deflections =
        ["da_um", "db_um", "dc_um", "dalpha_urad", "dbeta_urad", "dgamma_urad"].map(str::to_owned);
    let forces = (1..=6).map(|i| format!("force_{i}_N"));
    let mut text = CsvText::new(std::iter::once("time_s".to_owned()).chain(deflections).chain(forces));
    for s in samples {
        // Rounded before a zero loses its sign.
        let six = |x: f64| format!("{:.6}", (x * 1e6).round() * 1e-6 + 0.0);
        let deflections = s.deflection.iter().map(|d| six(d * 1e6));
        let forces = s.forces.iter().map(|f| six(*f));
        text.row(std::iter::once(format!("{:.7}", s.time)).chain(deflections).chain(forces));
    }
    text.into_text()
}
