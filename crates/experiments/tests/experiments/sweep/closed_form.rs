//! The fast trial against the fits it stands for.

use hexbench_experiments::sweep::Runner;
use hexbench_experiments::sweep::axes::SweepEstimator;
use hexbench_experiments::sweep::bench::BlockSetup;
use hexbench_experiments::sweep::draw::{SweepPurpose, generator};
use hexbench_experiments::sweep::task::springs::Prepared;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::{Fit, fit_baseline};
use hexbench_model::estimation::paper::fit_paper;
use hexbench_model::estimation::residuals::{prediction_errors, summarise};

use super::support::study;

/// The noise moves the point of linearization by noise / (leg length), 3 um / 0.1 m here at most, and forces by as much times the
/// condition of the leg Jacobian, 100 at most; a stiffness is known to a percent: a share of 0.3 of a standard error would
/// be far too much, a hundredth is nothing.
const SHARE_OF_STANDARD_ERROR: f64 = 1e-2;
/// Rounding times the square of the condition of the regressor.
const ROUNDING: f64 = 1e-8;
const TRIALS: u64 = 25;

/// Machines of every kind, with and without an effect.
fn benches() -> Vec<(Runner, usize)> {
    let text = |axes: &str| format!("trials = 100\ntask = \"springs\"\nredraw = 5\n[axes]\n{axes}");
    let plain = "geometry = [\"ring_b\", \"random_ring\", \"cubic\"]\nplan = [\"random\"]\nposes = [2, 8]\nrepeats = [1]\n";
    let effect = "geometry = [\"ring_a\"]\nplan = [\"rich\"]\nrepeats = [1]\neffect = [\"base-compliance\"]\nsize_sigmas = [20]\n";
    let runners = [plain, effect].map(|axes| Runner::new(study(&text(axes))).unwrap());
    runners
        .into_iter()
        .map(|r| {
            let cells = r.study().axes.cells();
            (r, cells)
        })
        .collect()
}

fn each(check: impl Fn(&BlockSetup, u64, usize)) {
    for (runner, cells) in benches() {
        for cell in 0..cells {
            let cell = runner.study().axes.cell(cell);
            let bench = BlockSetup::draw(&runner, &cell, 0).unwrap();
            (0..TRIALS).for_each(|trial| check(&bench, trial, cell.index));
        }
    }
}

/// The readings of a trial: with one reading of each condition they take their noise in the order of the fast trial.
fn readings(bench: &BlockSetup, trial: u64, cell: usize) -> hexbench_core::Dataset {
    let mut rng = generator(1, SweepPurpose::Noise, cell, trial);
    bench.training.dataset("data", Some(&mut rng))
}

fn fast(
    bench: &BlockSetup,
    trial: u64,
    cell: usize,
    estimator: SweepEstimator,
) -> hexbench_experiments::sweep::task::springs::SpringsResult {
    Prepared::of(bench, estimator)
        .unwrap()
        .trial(&mut generator(1, SweepPurpose::Noise, cell, trial))
        .unwrap()
}

fn weighted(bench: &BlockSetup, data: &hexbench_core::Dataset) -> (Campaign, Fit) {
    let campaign = Campaign::new(&bench.hexapod, data).unwrap();
    let fit = fit_baseline(&campaign).unwrap();
    (campaign, fit)
}

#[test]
fn a_fast_trial_finds_what_generalised_least_squares_find() {
    let mut worst = std::sync::Mutex::new(0.0_f64);
    each(|bench, trial, cell| {
        let (_, fit) = weighted(bench, &readings(bench, trial, cell));
        let found = fast(bench, trial, cell, SweepEstimator::Gls);
        for leg in 0..6 {
            let slow = 1.0 / (fit.point.compliances[leg] * bench.true_stiffness[leg]) - 1.0;
            let standard_error = fit.std(leg) / fit.point.compliances[leg];
            let off = (found.errors[leg] - slow).abs() / standard_error;
            let mut worst = worst.lock().unwrap();
            *worst = worst.max(off);
        }
    });
    let worst = *worst.get_mut().unwrap();
    assert!(worst < SHARE_OF_STANDARD_ERROR, "off by {worst:.1e} standard errors");
    assert!(worst > 0.0);
}

#[test]
fn a_fast_trial_of_the_papers_estimator_is_exact() {
    each(|bench, trial, cell| {
        let data = readings(bench, trial, cell);
        let slow = fit_paper(&Campaign::new(&bench.hexapod, &data).unwrap(), &data).unwrap();
        let found = fast(bench, trial, cell, SweepEstimator::Paper);
        for leg in 0..6 {
            let error = 1.0 / (slow.compliances[leg] * bench.true_stiffness[leg]) - 1.0;
            let off = (found.errors[leg] - error).abs();
            assert!(off < ROUNDING * (1.0 + error.abs()), "leg {leg}: off by {off:.1e}");
        }
        let (_, std) = Prepared::of(bench, SweepEstimator::Paper).unwrap().without_noise();
        for leg in 0..6 {
            let off = std[leg] / slow.covariance[(leg, leg)].sqrt() - 1.0;
            assert!(off.abs() < ROUNDING, "standard error of leg {leg}: off by {off:.1e}");
        }
    });
}

#[test]
fn the_held_out_error_of_a_fast_trial_is_that_of_the_predictions() {
    /// As for the stiffnesses; an error of prediction is a sum over them.
    const SHARE: f64 = 1e-2;
    each(|bench, trial, cell| {
        let (campaign, fit) = weighted(bench, &readings(bench, trial, cell));
        let held_out = bench.holdout.dataset("holdout", None);
        let errors = prediction_errors(&bench.hexapod, &held_out, campaign.noise, &fit.point).unwrap();
        let slow = summarise(&errors, None).chi2_reduced.sqrt();
        let [_, _, quick] = fast(bench, trial, cell, SweepEstimator::Gls).holdout;
        assert!((quick / slow - 1.0).abs() < SHARE, "{quick} {slow}");
    });
}
