//! Questions of studies, and whether their answers may be believed.

use std::path::Path;

use hexbench_core::statistics::ClusteredShare;
use hexbench_core::streams::{Purpose, stream};
use hexbench_experiments::sweep::SweepStudy;
use hexbench_experiments::sweep::page::{Meets, groups, ranks, sentences};
use hexbench_experiments::sweep::results::BlockSquares;
use hexbench_report::render::plain;
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};

use super::studies::run;
use super::support::study;

/// A bundled study with so many trials in a cell, and the sentences of its answer.
fn answered(file: &str, trials: u64, change: impl Fn(&mut SweepStudy)) -> Vec<String> {
    let mut study = bundled(file);
    study.trials = trials;
    change(&mut study);
    let folder = tempfile::tempdir().unwrap();
    let (runner, cells) = run(folder.path(), study);
    let said = sentences(runner.study(), &cells);
    let page = plain(&hexbench_experiments::sweep::page::summary(runner.study(), &cells));
    assert!(page.contains("Answer"), "{page}");
    said
}

fn bundled(file: &str) -> SweepStudy {
    SweepStudy::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/studies").join(file)).unwrap()
}

#[test]
fn how_many_poses_see_a_base_of_two_nanometers_per_newton_is_answered() {
    let said = answered("base-compliance.toml", 16, |study| {
        study.axes.poses = vec![6, 12];
        study.axes.repeats = vec![1];
    });
    assert_eq!(said.len(), 1);
    assert!(said[0].starts_with("base-compliance of 2 nm/N, noise of 0.5 um 3 urad: "), "{said:?}");
    assert!(said[0].contains(" poses x 1 repeat see it with ") && said[0].contains(" h)"), "{said:?}");
}

#[test]
fn which_index_predicts_the_error_best_is_answered() {
    let said = answered("which-index.toml", 9000, |_| ());
    assert_eq!(said.len(), 3);
    for sentence in said {
        assert!(
            sentence.contains(" predicts the stiffness error best (")
                && sentence.contains("rank correlation 0."),
            "{sentence}"
        );
        // The worst of the directions, or the sum over them, is what the error is made of: no index of ratios alone wins.
        assert!(!sentence.contains(": O2 predicts"), "{sentence}");
    }
}

#[test]
fn what_two_percent_of_stiffness_take_is_answered_with_hours() {
    let said = answered("two-percent.toml", 400, |_| ());
    assert_eq!(said.len(), 1);
    assert!(said[0].contains(" repeats of plan O1 leave a stiffness error of 1."), "{said:?}");
    assert!(
        said[0].contains("the cheapest that is sure to leave 2 % or less (") && said[0].contains(" h)"),
        "{said:?}"
    );
}

#[test]
fn a_question_that_no_plan_meets_says_so_and_names_the_best() {
    let rest = "trials = 200\ntask = \"springs\"\nredraw = 10\n[axes]\ngeometry = [\"ring_a\"]\nplan = [\"random\"]\nposes = [3, 9]\n\
                [question]\nerror_percent = 0.001\n";
    let folder = tempfile::tempdir().unwrap();
    let (runner, cells) = run(folder.path(), study(rest));
    let said = sentences(runner.study(), &cells);
    let begins =
        "none of 2 plans is sure to leave 0.001 % or less. The best: 9 poses leave a stiffness error of ";
    assert!(said[0].starts_with(begins), "{said:?}");
    assert!(groups(runner.study(), &cells)[0].plans.iter().all(|plan| plan.meets == Meets::No));
}

#[test]
fn indices_are_columns_of_the_tables_and_larger_ones_mean_smaller_errors() {
    let rest = "trials = 6000\ntask = \"springs\"\nredraw = 100\nindices = true\n[axes]\ngeometry = [\"ring_a\", \"cubic\"]\n\
                plan = [\"random\"]\nposes = [2]\n";
    let folder = tempfile::tempdir().unwrap();
    let (runner, cells) = run(folder.path(), study(rest));
    let table = std::fs::read_to_string(folder.path().join("cells.csv")).unwrap();
    assert!(
        table.lines().next().unwrap().ends_with(
            "index_O1_mean,index_O2_mean,index_O3_mean,index_O4_mean,index_O5_mean,\
        index_D_mean,index_A_mean,index_E_mean,index_I_mean"
        ),
        "{table}"
    );
    for found in ranks(runner.study(), &cells) {
        assert_eq!(found.plans, 60);
        // A, the sixth but one, is the mean variance itself.
        assert!(found.found[6][0] > 0.0, "{:?}", found.found);
    }
    assert!(super::studies::column(folder.path(), "index_A").iter().all(|x| x.parse::<f64>().unwrap() > 0.0));
}

/// Runs in which all of some plans have their true share within bounds, and in which a plan is wrongly called sure.
fn simulated(shares: &[f64], wanted: f64) -> [f64; 2] {
    const RUNS: u64 = 600;
    const BLOCKS: u64 = 30;
    const TRIALS: u64 = 5;
    let error = 0.05 / shares.len() as f64;
    let (mut held, mut wrong) = (0, 0);
    for run in 0..RUNS {
        let mut rng = stream(7, Purpose::Example, [run]);
        let bounds: Vec<[f64; 2]> = shares
            .iter()
            .map(|share| {
                let mut found = ClusteredShare::default();
                for _ in 0..BLOCKS {
                    // Half of the blocks are a little harder than the others.
                    let own = if rng.random_bool(0.5) { share - 0.05 } else { share + 0.05 };
                    found.add((0..TRIALS).filter(|_| rng.random_bool(own)).count() as u64, TRIALS);
                }
                found.interval(error)
            })
            .collect();
        let inside = |(share, [low, high]): (&f64, &[f64; 2])| (*low..=*high).contains(share);
        held += u64::from(shares.iter().zip(&bounds).all(inside));
        let cheapest = shares.iter().zip(&bounds).find(|(_, bounds)| bounds[0] >= wanted);
        wrong += u64::from(cheapest.is_some_and(|(share, _)| *share < wanted));
    }
    [held, wrong].map(|n| n as f64 / RUNS as f64)
}

#[test]
fn bounds_hold_for_all_plans_together_and_a_plan_is_hardly_ever_wrongly_called_sure() {
    let [held, wrong] = simulated(&[0.3, 0.5, 0.7, 0.8, 0.85, 0.89, 0.93, 0.95], 0.9);
    // Three standard deviations of 600 runs at 95 %.
    assert!(held > 0.95 - 0.027, "{held}");
    assert!(wrong < 0.05 + 0.027, "{wrong}");
}

#[test]
fn bounds_of_a_root_mean_square_hold_the_truth_as_often_as_they_say() {
    const RUNS: u64 = 1000;
    /// Scatter of the logarithm of the variance among blocks.
    const SCATTER: f64 = 0.4;
    for blocks in [10, 40] {
        let held = (0..RUNS).filter(|&run| {
            let mut rng = stream(8, Purpose::Example, [run, blocks]);
            let mut normal = || -> f64 { StandardNormal.sample(&mut rng) };
            let mut squares = BlockSquares::default();
            for block in 0..blocks {
                let sigma = (0.5 * SCATTER * normal()).exp();
                squares.add(block, (0..60).map(|_| sigma * normal()).collect::<Vec<_>>());
            }
            let [_, low, high] = squares.rms(0.05);
            // Mean of a log-normal variance.
            (low..=high).contains(&(0.25 * SCATTER * SCATTER).exp())
        });
        let held = held.count() as f64 / RUNS as f64;
        assert!(held > 0.95 - 0.021 - 0.01, "{blocks} blocks: {held}");
    }
}

#[test]
fn the_bounds_of_an_error_hold_what_forty_times_as_many_trials_find() {
    const SEEDS: u64 = 60;
    let rest = "trials = 200\ntask = \"springs\"\nredraw = 10\n[axes]\ngeometry = [\"ring_a\"]\nplan = [\"random\"]\nposes = [6]\n";
    let rms = |seed: u64, trials: u64| {
        let folder = tempfile::tempdir().unwrap();
        let (_, cells) = run(folder.path(), SweepStudy { seed, trials, ..study(rest) });
        cells[0].springs.blocks.rms(0.05)
    };
    let [truth, ..] = rms(1000, 8_000);
    let held = (0..SEEDS).filter(|&seed| {
        let [_, low, high] = rms(seed, 200);
        (low..=high).contains(&truth)
    });
    let held = held.count() as f64 / SEEDS as f64;
    assert!(held > 0.95 - 0.085, "{held}");
}
