//! Studies of a machine that gauges read.

use std::path::Path;

use hexbench_experiments::calibration::Fate;
use hexbench_experiments::sweep::axes::{Drawings, Geometry, SweepEstimator};
use hexbench_experiments::sweep::bench::BlockSetup;
use hexbench_experiments::sweep::draw::{SweepPurpose, generator};
use hexbench_experiments::sweep::results::Counted;
use hexbench_experiments::sweep::task::springs::Prepared;
use hexbench_experiments::sweep::{Runner, SweepStudy};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::fit_baseline;
use hexbench_model::estimation::residuals::{prediction_errors, summarise};
use hexbench_truth::scene::Scene;

use super::studies::run;
use super::support::study;

/// A study of the granite machine and its six gauges.
fn of_gauges(rest: &str) -> SweepStudy {
    let scene = Scene::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/granite")).unwrap();
    assert_eq!(scene.hexapod.sensors.len(), 6);
    let mut study = study(&format!("{rest}geometry = [\"ring_a\"]\n"));
    let source = Drawings::File(Box::new(scene.hexapod));
    study.axes.geometry = vec![Geometry { name: "granite".into(), source, space: None }];
    study
}

fn blocks(rest: &str, check: impl Fn(&BlockSetup, usize)) {
    let runner = Runner::new(of_gauges(rest)).unwrap();
    for index in 0..runner.study().axes.cells() {
        let cell = runner.study().axes.cell(index);
        check(&BlockSetup::draw(&runner, &cell, 0).unwrap(), index);
    }
}

#[test]
fn a_fast_trial_of_gauges_finds_and_foretells_what_a_fit_to_its_readings_does() {
    // As of full poses: the noise moves the point of linearization by much less than a hundredth of a standard error.
    const SHARE: f64 = 1e-2;
    const TRIALS: u64 = 20;
    let rest = "trials = 100\ntask = \"springs\"\nredraw = 5\n[axes]\nplan = [\"random\"]\nposes = [4, 8]\nrepeats = [1]\n";
    blocks(rest, |bench, index| {
        let prepared = Prepared::of(bench, SweepEstimator::Gls).unwrap();
        for trial in 0..TRIALS {
            let rng = || generator(1, SweepPurpose::Noise, index, trial);
            let data = bench.training.dataset("data", Some(&mut rng()));
            let campaign = Campaign::new(&bench.hexapod, &data).unwrap();
            let fit = fit_baseline(&campaign).unwrap();
            let found = prepared.trial(&mut rng()).unwrap();
            for leg in 0..6 {
                let slow = 1.0 / (fit.point.compliances[leg] * bench.true_stiffness[leg]) - 1.0;
                let standard_error = fit.std(leg) / fit.point.compliances[leg];
                let off = (found.errors[leg] - slow).abs() / standard_error;
                assert!(off < SHARE, "leg {leg} off by {off} standard errors");
            }
            let held_out = bench.holdout.dataset("holdout", None);
            let errors = prediction_errors(&bench.hexapod, &held_out, campaign.noise, &fit.point).unwrap();
            let slow = summarise(&errors, None).chi2_reduced.sqrt();
            let [um, urad, quick] = found.holdout;
            assert!((quick / slow - 1.0).abs() < SHARE, "{quick} {slow}");
            assert!(um > 0.0 && um < 1e-6 && urad > 0.0 && urad < 1e-5, "{um} m {urad} rad");
        }
    });
}

#[test]
fn the_size_of_an_effect_counts_in_standard_deviations_of_the_gauges() {
    const SIZE: f64 = 20.0;
    // Springs of the model are linearized, those of the world are not.
    const CLOSE: f64 = 0.02;
    let rest = format!(
        "trials = 20\ntask = \"springs\"\n[axes]\nplan = [\"rich\"]\neffect = [\"base-compliance\"]\nsize_sigmas = [{SIZE}]\n\
         noise_scale = [1, 3]\n"
    );
    blocks(&rest, |bench, _| {
        let data = bench.training.dataset("data", None);
        let campaign = Campaign::new(&bench.hexapod, &data).unwrap();
        let left = fit_baseline(&campaign).unwrap().solution.rss.sqrt();
        assert!((left / SIZE - 1.0).abs() < CLOSE, "{left}");
    });
}

#[test]
fn gauges_of_twice_the_noise_err_twice_as_much_at_designed_poses() {
    let folder = tempfile::tempdir().unwrap();
    let rest = "trials = 400\ntask = \"springs\"\nredraw = 20\nstarts = 2\n[axes]\nplan = [\"O1\", \"random\"]\nposes = [4]\n\
                noise_scale = [1, 2]\n";
    let (runner, cells) = run(folder.path(), of_gauges(rest));
    let errors: Vec<f64> = cells.iter().map(|cell| cell.springs.errors.rms()).collect();
    // 2400 errors each: 1.5 % of chance, four of them.
    for pair in errors.chunks(2) {
        assert!((pair[1] / pair[0] - 2.0).abs() < 0.12, "{errors:?}");
    }
    assert!(errors[0] < errors[2], "designed poses are worse than random ones: {errors:?}");
    let page =
        hexbench_report::render::plain(&hexbench_experiments::sweep::page::summary(runner.study(), &cells));
    assert!(page.contains("The sensors in granite take every reading there"), "{page}");
}

#[test]
fn a_diagnosis_of_gauges_names_what_is_plain_to_see() {
    let folder = tempfile::tempdir().unwrap();
    let rest = "trials = 6\ntask = \"diagnose\"\nredraw = 2\n[axes]\nplan = [\"rich\"]\neffect = [\"base-compliance\"]\n\
                size_sigmas = [0, 60]\n";
    let (_, cells) = run(folder.path(), of_gauges(rest));
    for cell in &cells {
        assert_eq!(cell.done(), 6);
        let count = |of| cell.answers.share(of).hits();
        assert!(count(Counted::Of(Fate::Right)) >= 5 && count(Counted::Seen) == 6, "{:?}", cell.answers);
    }
}
