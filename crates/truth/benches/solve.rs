//! Time of one equilibrium, plain and with extra bodies.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Pose, Wrench};
use hexbench_truth::{Situation, World, campaign::machines, mechanisms};

fn situation() -> Situation {
    Situation::new(
        Pose::from_array([0.02, -0.01, 0.005, 0.08, -0.05, 0.1]),
        Wrench::from_array([60.0, -30.0, -330.0, 4.0, 2.0, -1.0]),
    )
}

fn solve(c: &mut Criterion) {
    let machine = || World::new(machines::RING_A.hexapod("ring_a"), &[4e6; 6]);
    let plain = machine();
    c.bench_function("plain", |b| b.iter(|| plain.pose(black_box(&situation()))));
    for id in ["leg-nonlinearity", "joint-friction", "base-compliance", "platform-compliance"] {
        let effect =
            mechanisms::effect(id).map(|e| (e.draw)(&plain.hexapod, &mut stream(1, Purpose::Test, [1])));
        let Ok(effect) = effect else { continue };
        let world = machine().with(effect);
        c.bench_function(id, |b| b.iter(|| world.pose(black_box(&situation()))));
    }
}

criterion_group!(benches, solve);
criterion_main!(benches);
