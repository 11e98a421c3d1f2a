//! Deflections, one fit, one diagnosis: per core (one thread).
#![allow(clippy::expect_used, missing_docs)] // a benchmark without its data has nothing to measure

use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use hexbench_core::files::{read_hexapod, read_measurements};
use hexbench_core::{
    Channel, Dataset, Hexapod, Measurand, Metrology, Observation, Pose, Sensor, SensorKind, Vector3, Wrench,
};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::fit_baseline;
use hexbench_model::estimation::spring_trials::SpringTrials;
use hexbench_model::machine::batch::{LoadCase, deflections};
use hexbench_model::results::diagnose::diagnose;
use hexbench_model::terms::catalogue;

const POSES: u32 = 100_000;

fn case(name: &str) -> (Hexapod, Dataset) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/cases").join(name);
    let hexapod = read_hexapod(&folder.join("hexapod.toml")).expect("the bundled hexapod");
    let reading = read_measurements(&folder.join("measurements.csv")).expect("the bundled measurements");
    (hexapod, reading.dataset)
}

fn load_cases() -> Vec<LoadCase> {
    let wave = |i: u32, k: f64| (f64::from(i) * k).sin();
    let pose = |i| {
        Pose::from_array(
            [0.1, 0.2, 0.3, 0.5, 0.7, 1.1].map(|k| wave(i, k) * if k < 0.4 { 0.03 } else { 0.1 }),
        )
    };
    let load = |i| Wrench::from_array([1.3, 1.7, 1.9, 2.3, 2.9, 3.1].map(|k| 100.0 * wave(i, k)));
    (1..=POSES).map(|i| LoadCase { pose: pose(i), change: load(i) }).collect()
}

fn deflection(c: &mut Criterion) {
    let (hexapod, _) = case("contact");
    let cases = load_cases();
    let mut group = c.benchmark_group("deflection");
    group.throughput(Throughput::Elements(u64::from(POSES)));
    group.bench_function("batch of 100000 poses", |b| {
        b.iter(|| deflections(&hexapod, &[4e6; 6], black_box(&cases)));
    });
    group.finish();
}

fn fit(c: &mut Criterion) {
    let (hexapod, data) = case("paper-protocol");
    let campaign = Campaign::new(&hexapod, &data).expect("a campaign");
    c.bench_function("fit of the springs, 54 equations", |b| b.iter(|| fit_baseline(black_box(&campaign))));
}

fn trials(c: &mut Criterion) {
    const CAMPAIGNS: usize = 10_000;
    let (hexapod, data) = case("paper-protocol");
    let sigma = [0.8e-6, 0.8e-6, 0.8e-6, 9.6e-6, 9.6e-6, 6.8e-6];
    let same = SpringTrials::new(&hexapod, &data.observations, &sigma, &[4e6; 6]).expect("a plan");
    let own = same.clone().with_joint_tolerance(&hexapod, 5e-5);
    let mut group = c.benchmark_group("simulated campaigns");
    group.throughput(Throughput::Elements(CAMPAIGNS as u64));
    for (name, trials) in [("one machine", same), ("a machine each", own)] {
        group.bench_function(name, |b| b.iter(|| trials.run(CAMPAIGNS, black_box(1))));
    }
    group.finish();
}

fn diagnosis(c: &mut Criterion) {
    let terms = catalogue();
    for name in ["contact", "mujoco-foundation", "two-effects"] {
        let (hexapod, data) = case(name);
        let title = format!("diagnosis of {name}, {} rows", data.observations.len());
        // The held-out error comes from a file in practice; here the data serve as their own.
        c.bench_function(&title, |b| b.iter(|| diagnose(&hexapod, black_box(&data), Some(&data), &terms)));
    }
}

/// The same readings by six gauges in three pairs that tell as much of a motion: along z at `+-x`, along y at `+-z`, along x at `+-y`.
fn by_gauges(hexapod: &Hexapod, data: &Dataset) -> (Hexapod, Dataset) {
    assert_eq!(data.measurand, Measurand::DeflectionEuler);
    let Metrology { sigma_translation, sigma_rotation } = hexapod.metrology.expect("stated noise");
    let sigma = sigma_translation * std::f64::consts::SQRT_2;
    let arm = sigma_translation / sigma_rotation;
    let places = [(2, 0), (1, 2), (0, 1)].map(|(along, at)| [1.0, -1.0].map(|side| (along, at, side * arm)));
    let gauge = |(k, (along, at, arm)): (usize, (usize, usize, f64))| {
        let (point, direction) = (Vector3::ith(at, arm), Vector3::ith(along, 1.0));
        Sensor::new(format!("g{}", k + 1), SensorKind::Distance { point, direction, sigma })
    };
    let sensors: Vec<Sensor> = places.into_iter().flatten().enumerate().map(gauge).collect();
    let read = |o: &Observation| {
        let numbers = o.pose.to_array();
        let moved = Pose::from_array(std::array::from_fn(|k| numbers[k] + o.measured[k]));
        let at = |pose: &Pose, p: &Vector3| pose.rotation() * p + pose.translation;
        let number = |s: &Sensor| match (s.kind.point(), s.kind.direction()) {
            (Some(p), Some(u)) => u.dot(&(at(&moved, p) - at(&o.pose, p))),
            _ => f64::NAN,
        };
        let measured = std::array::from_fn(|k| number(&sensors[k]));
        Observation { measured, sigma: Some([sigma; 6]), ..*o }
    };
    let observations = data.observations.iter().map(read).collect();
    let mut gauges = Dataset { observations, ..data.clone() };
    gauges.blocks = Channel::in_blocks(&Channel::all([], &sensors));
    gauges.columns.sigma = true;
    (Hexapod { sensors, ..hexapod.clone() }, gauges)
}

/// Six numbers of a pose beside six gauges that tell the same: fit and diagnosis in pairs.
fn readings(c: &mut Criterion) {
    let terms = catalogue();
    let (hexapod, poses) = case("two-effects");
    let ways = [("a pose", (hexapod.clone(), poses.clone())), ("six gauges", by_gauges(&hexapod, &poses))];
    let mut group = c.benchmark_group(format!("{} rows", poses.observations.len()));
    for (name, (hexapod, data)) in &ways {
        let campaign = Campaign::new(hexapod, data).expect("a campaign");
        group.bench_function(format!("fit of the springs to {name}"), |b| {
            b.iter(|| fit_baseline(black_box(&campaign)));
        });
        group.bench_function(format!("diagnosis of {name}"), |b| {
            b.iter(|| diagnose(hexapod, black_box(data), Some(data), &terms));
        });
    }
    group.finish();
}

fn one_thread() -> Criterion {
    // The figures are per core.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the only pool");
    Criterion::default().sample_size(20)
}

criterion_group! { name = benches; config = one_thread(); targets = deflection, fit, trials, diagnosis, readings }
criterion_main!(benches);
