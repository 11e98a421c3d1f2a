//! From a ticked term to everything that is shown of it, for 1 000 and 10 000 readings: fit, held-out error, residuals, JSON.
#![allow(clippy::unwrap_used, reason = "a benchmark without its data fails")]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use hexbench_core::files::{hexapod_to_toml, measurements_to_csv};
use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Hexapod};
use hexbench_truth::campaign::{MeasurementPlan, PlanKind, Poses, SimulatedCampaign, machines, measure};
use hexbench_truth::metrology::{InstrumentFrames, InstrumentNoise};
use hexbench_truth::{World, mechanisms};
use hexbench_workbench::bench::LoadedCampaign;
use hexbench_workbench::wire::{FileText, Open, Selection, ServerLimits};

const LIMITS: ServerLimits =
    ServerLimits { bytes: 1 << 26, rows: 50_000, own_terms: 8, term_bytes: 1 << 16, benches: 4 };
/// Loads and readings at each pose of a rich plan.
const AT_A_POSE: u64 = 24;

/// Readings at `readings / 24` poses, every condition different from the others, and as many poses held out.
fn bench(readings: u64, with_holdout: bool) -> LoadedCampaign {
    let mut rng = stream(7, Purpose::Test, [0]);
    let mut hexapod = machines::draw("ring_b", &mut rng);
    hexapod.metrology = Some(InstrumentNoise::default().metrology());
    let mut schemes = PlanKind::Rich.schemes(&hexapod, &mut rng);
    for part in [&mut schemes.training, &mut schemes.holdout] {
        if let Poses::Drawn { count, .. } = &mut part.poses {
            *count = readings / AT_A_POSE;
        }
        part.anew = true;
    }
    let plan = MeasurementPlan {
        measurand: PlanKind::Rich.measurand(),
        training: schemes.training.draw(&mut rng),
        holdout: schemes.holdout.draw(&mut rng),
    };
    let mut world = World::new(hexapod.clone(), &machines::leg_stiffness("ring_b", &mut rng));
    world.mechanisms.push((mechanisms::effect("base-compliance").unwrap().draw)(&hexapod, &mut rng));
    let campaign =
        SimulatedCampaign { world, frames: InstrumentFrames::default(), noise: InstrumentNoise::default() };
    let mut read = |rows| measure(&campaign, rows, plan.measurand, "measurements.csv", &mut rng).unwrap();
    let (data, holdout) = (read(&plan.training), read(&plan.holdout));
    opened(&hexapod, &data, with_holdout.then_some(&holdout))
}

fn opened(hexapod: &Hexapod, data: &Dataset, holdout: Option<&Dataset>) -> LoadedCampaign {
    let csv = |rows: &Dataset| {
        let mut text = Vec::new();
        measurements_to_csv(&mut text, rows).unwrap();
        FileText { name: "measurements.csv".to_owned(), text: String::from_utf8(text).unwrap() }
    };
    let machine = FileText { name: "hexapod.toml".to_owned(), text: hexapod_to_toml(hexapod) };
    let request = Open::Files { hexapod: machine, data: csv(data), holdout: holdout.map(csv) };
    LoadedCampaign::open(&request, None, &LIMITS).unwrap()
}

fn tick(c: &mut Criterion) {
    let mut group = c.benchmark_group("tick");
    group.sample_size(10);
    for (readings, with_holdout) in [(1_000, true), (1_000, false), (10_000, true), (10_000, false)] {
        let bench = bench(readings, with_holdout);
        let judged = if with_holdout { "holdout file" } else { "poses in turn" };
        for terms in [&[][..], &["base-compliance"], &["leg-nonlinearity"], &["base-compliance", "creep"]] {
            let selection =
                Selection { terms: terms.iter().map(|&t| t.to_owned()).collect(), ..Selection::default() };
            let name = if terms.is_empty() { "springs alone".to_owned() } else { terms.join(" + ") };
            group.bench_function(format!("{readings} readings, {judged}: {name}"), |b| {
                b.iter(|| serde_json::to_vec(&bench.view(black_box(&selection)).unwrap()).unwrap());
            });
        }
    }
}

criterion_group!(benches, tick);
criterion_main!(benches);
