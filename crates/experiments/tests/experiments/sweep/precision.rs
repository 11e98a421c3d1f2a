//! Cells that stop when they are decided.

use std::fs;
use std::path::Path;

use hexbench_core::statistics::ClusteredShare;
use hexbench_core::streams::{Purpose, stream};
use hexbench_experiments::harness::{ExperimentPart, Silent};
use hexbench_experiments::sweep::Work;
use hexbench_experiments::sweep::page::{Meets, judged};
use hexbench_experiments::sweep::precision::looks;
use hexbench_experiments::sweep::results::CellStatistics;
use rand::RngExt;

/// Errors of some 1, 2 and 4 % at three poses: the outer ones are decided at once, the inner one is not.
const STUDY: &str = "format = \"study/1\"\ntitle = \"stops\"\nseed = 9\ntrials = 8192\ntask = \"springs\"\nredraw = 16\n\
                     until = { half_width = 0.02 }\n\
                     [axes]\ngeometry = [\"ring_a\"]\nplan = [\"random\"]\nposes = [3]\nnoise_scale = [0.5, 1, 2]\n\
                     [question]\nerror_percent = LIMIT\n";

fn open(folder: &Path, out: &str, limit: f64) -> Work {
    let file = folder.join("study.toml");
    fs::write(&file, STUDY.replace("LIMIT", &limit.to_string())).unwrap();
    Work::open(&file, &folder.join(out)).unwrap()
}

fn finished(work: &Work) -> (Vec<CellStatistics>, [Vec<u8>; 2]) {
    work.finish(None, &Silent, &|_| ()).unwrap();
    work.require_complete().unwrap();
    let cells = work.write_tables(&|| ()).unwrap();
    (cells, ["trials.parquet", "cells.csv"].map(|name| fs::read(work.folder().join(name)).unwrap()))
}

#[test]
fn trials_go_to_the_cell_that_is_not_decided_and_the_bytes_are_the_same_however_it_was_run() {
    let folder = tempfile::tempdir().unwrap();
    let (first, _) = finished(&open(folder.path(), "first", 1e3));
    assert!(
        first.iter().all(|cell| cell.trials() == 1024),
        "nothing is open, and cells stop at their first look"
    );
    // What the middle cell comes to is the limit: it stays open for long.
    let limit = first[1].springs.blocks.rms(0.05)[0];
    let whole = open(folder.path(), "whole", limit);
    let (cells, bytes) = finished(&whole);
    let trials: Vec<u64> = cells.iter().map(CellStatistics::trials).collect();
    assert_eq!((trials[0], trials[2]), (1024, 1024), "{trials:?}");
    assert!(trials[1] > 1024, "{trials:?}");
    let told = |k: usize| judged(whole.study(), &cells[k]).unwrap().meets;
    assert_eq!((told(0), told(2)), (Meets::Yes, Meets::No));

    let broken = open(folder.path(), "broken", limit);
    let todo = broken.todo(None).unwrap();
    broken.compute(&todo.pending[1..], &Silent).unwrap();
    // A shard that nobody will ask for, as another run may have left it.
    broken.compute(&[7], &Silent).unwrap();
    drop(broken);
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let (_, again) = one.install(|| finished(&open(folder.path(), "broken", limit)));
    assert!(bytes == again, "the files differ");

    let merged = open(folder.path(), "merged", limit);
    for part in ExperimentPart::all(2) {
        let out = format!("part-{part}").replace('/', "-");
        let work = open(folder.path(), &out, limit);
        work.finish(Some(part), &Silent, &|_| ()).unwrap();
        drop(work);
        merged.journal().adopt(&folder.path().join(out)).unwrap();
    }
    merged.require_complete().unwrap();
    merged.write_tables(&|| ()).unwrap();
    assert!(bytes[1] == fs::read(folder.path().join("merged/cells.csv")).unwrap(), "parts differ");
}

#[test]
fn bounds_at_the_look_at_which_a_cell_stops_hold_the_truth_as_often_as_they_say() {
    const RUNS: u64 = 1000;
    const SHARDS: u64 = 32;
    const TRIALS: u64 = 16;
    let error = 0.05 / looks(SHARDS).count() as f64;
    for (truth, wanted) in [(0.9, 0.9), (0.9, 0.8), (0.97, 0.9), (0.5, 0.9)] {
        let held = (0..RUNS).filter(|&run| {
            let mut rng = stream(10, Purpose::Example, [run]);
            let mut found = ClusteredShare::default();
            let mut bounds = [0.0, 1.0];
            for look in looks(SHARDS) {
                while found.of() < look * TRIALS {
                    found.add(u64::from(rng.random_bool(truth)), 1);
                }
                bounds = found.interval(error);
                if bounds[0] >= wanted || bounds[1] < wanted || bounds[1] - bounds[0] < 0.1 {
                    break;
                }
            }
            let [low, high] = bounds;
            (low..=high).contains(&truth)
        });
        let held = held.count() as f64 / RUNS as f64;
        // Three standard deviations of 1000 runs.
        assert!(held > 0.95 - 0.021, "{truth} of {wanted}: {held}");
    }
}
