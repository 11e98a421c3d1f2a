//! Deflections, one fit, one diagnosis: per core (one thread).
#![allow(clippy::expect_used, missing_docs)] // a benchmark without its data has nothing to measure

use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use hexbench_core::files::{read_hexapod, read_measurements};
use hexbench_core::{Dataset, Hexapod, Pose, Wrench};
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

fn one_thread() -> Criterion {
    // The figures are per core.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the only pool");
    Criterion::default().sample_size(20)
}

criterion_group! { name = benches; config = one_thread(); targets = deflection, fit, trials, diagnosis }
criterion_main!(benches);
