//! The way to rest: frequencies, damping and the static limit.

#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "helpers of a test may fail it; sample numbers are small"
)]

use hexbench_core::{Pose, Vector6, Wrench};
use hexbench_rapier::{
    Modes,
    parts::Inertia,
    transient::{self, LoadStep, Transient},
};
use hexbench_truth::{
    Setup,
    campaign::machines::{RING_A, RING_B, Ring},
};

/// Observed against computed frequency: the time step errs by 0.04 %, light damping shifts by `ratio^2 / 2`, which is
/// taken into account; the rest is the sampling of the crossings.
const FREQUENCY_TOLERANCE: f64 = 2e-3;
/// Static limit against the first world; the lowest mode is left with 1e-4 of its swing at the end.
const LIMIT_TOLERANCE: f64 = 3e-4;
const RATIO: f64 = 0.05;

fn setup(ring: &Ring, wrench: Wrench) -> Setup {
    let pose = Pose::from_array([0.01, -0.005, 0.003, 0.05, -0.03, 0.08]);
    transient::nominal(&ring.hexapod("ring"), &[4e6; 6], pose, wrench).unwrap()
}

fn step() -> LoadStep {
    LoadStep { platform: Inertia::disc(20.0, 0.12), leg_mass: 2.0, damping_ratio: RATIO }
}

/// A load along the lowest mode, so that it swings alone, of about 100 N.
fn along_lowest(ring: &Ring) -> Wrench {
    let modes = Modes::of(&setup(ring, Wrench::default()), &step().platform, step().leg_mass).unwrap();
    let load: Vector6 = modes.mass * modes.shapes.column(0);
    Wrench::from_array((load * (100.0 / load.fixed_rows::<3>(0).norm())).into())
}

fn settled(ring: &Ring) -> (Setup, Transient) {
    let setup = setup(ring, along_lowest(ring));
    let transient = transient::settle(&setup, &step()).unwrap();
    (setup, transient)
}

#[test]
fn the_machine_swings_at_the_frequency_of_its_lowest_mode_and_ends_where_the_first_world_stands() {
    for ring in [RING_A, RING_B] {
        let (setup, transient) = settled(&ring);
        let expected = transient.modes.frequencies_hz()[0] * (1.0 - RATIO * RATIO).sqrt();
        let observed = transient.observed_frequency_hz.unwrap();
        let error = observed / expected - 1.0;
        assert!(error.abs() < FREQUENCY_TOLERANCE, "{observed} Hz seen, {expected} Hz expected: {error:.1e}");
        let limit = transient::static_deflection(&setup).unwrap();
        let apart = (transient.limit() - limit).norm() / limit.norm();
        assert!(apart < LIMIT_TOLERANCE, "static limit differs by {apart:.1e}");
        println!("{observed} Hz, {error:.1e}; limit {apart:.1e}");
    }
}

#[test]
fn the_swing_decays_as_fast_as_the_damping_ratio_says() {
    let (_, transient) = settled(&RING_B);
    let last = transient.limit();
    let row = transient.modes.mass * transient.modes.shapes.column(0);
    let swing = |i: usize| row.dot(&(transient.samples[i].deflection - last)).abs();
    let lowest = transient.modes.angular_frequencies[0];
    let period = std::f64::consts::TAU / (lowest * (1.0 - RATIO * RATIO).sqrt());
    let interval = transient.samples[1].time;
    let peak = |n: f64| {
        let around = (n * period / interval).round() as usize;
        (around.saturating_sub(8)..around + 8).map(swing).fold(0.0, f64::max)
    };
    let ratio = (peak(1.0) / peak(6.0)).ln() / (5.0 * lowest * period);
    assert!((ratio / RATIO - 1.0).abs() < 0.02, "damping ratio {ratio}, {RATIO} asked for");
}

#[test]
fn doubling_all_masses_lowers_all_frequencies_by_the_root_of_two() {
    let setup = setup(&RING_A, Wrench::default());
    let light = Modes::of(&setup, &step().platform, 2.0).unwrap();
    let heavy = Modes::of(&setup, &step().platform.scaled(2.0), 4.0).unwrap();
    for (a, b) in light.angular_frequencies.iter().zip(heavy.angular_frequencies) {
        assert!((a / b - 2.0_f64.sqrt()).abs() < 1e-12, "{a} {b}");
    }
}

#[test]
fn a_step_without_mass_or_damping_is_refused() {
    let setup = setup(&RING_A, Wrench::default());
    for bad in [LoadStep { leg_mass: 0.0, ..step() }, LoadStep { damping_ratio: 0.0, ..step() }] {
        assert!(transient::settle(&setup, &bad).unwrap_err().to_string().contains("positive"));
    }
}
