//! Sets of effects, points over ranges, inputs off by their tolerances.

use hexbench_experiments::calibration::Fate;
use hexbench_experiments::sweep::page::summary;
use hexbench_experiments::sweep::results::Counted;
use hexbench_report::render::plain;

use super::studies::run;
use super::support::study;

#[test]
fn two_effects_hidden_together_are_right_only_together_and_are_called_by_both_names() {
    let folder = tempfile::tempdir().unwrap();
    let study = study(
        "trials = 12\ntask = \"diagnose\"\n[axes]\ngeometry = [\"ring_a\"]\nplan = [\"rich\"]\n\
         effect = [[\"base-compliance\", \"thermal-expansion\"], \"thermal-expansion\"]\nsize_sigmas = [60]\n",
    );
    let (runner, cells) = run(folder.path(), study);
    let [both, one] = [0, 1].map(|k| &cells[k]);
    let right = |cell: usize| cells[cell].answers.share(Counted::Of(Fate::Right)).rate();
    assert!(right(0) > 0.6 && right(1) > 0.6, "{} {}", right(0), right(1));
    let answers = hexbench_experiments::sweep::columns::answers(runner.study());
    let at = |name: &str| answers.iter().position(|answer| answer == name).unwrap();
    let (set, alone) = (at("base-compliance+thermal-expansion"), at("thermal-expansion"));
    let rights = 12.0 * right(0);
    let named = both.answers.said(set) as f64;
    assert!((named - rights).abs() < 1e-9, "what is right is called by both names: {named} {rights}");
    assert!(one.answers.said(alone) > 0 && one.answers.said(set) == 0);
    // Who names one of two is incomplete, not right.
    let incomplete = both.answers.share(Counted::Of(Fate::Incomplete)).rate() * 12.0;
    assert!((both.answers.said(alone) as f64) <= incomplete + 1e-9);
    let page = plain(&summary(runner.study(), &cells));
    assert!(page.contains("base-compliance+thermal-expansion"), "{page}");
}

#[test]
fn points_over_ranges_are_as_many_cells_and_all_of_them_differ() {
    let folder = tempfile::tempdir().unwrap();
    let study = study(
        "trials = 200\ntask = \"springs\"\nredraw = 20\n[design]\nkind = \"sobol\"\npoints = 16\n[axes]\n\
         geometry = [\"ring_a\", \"ring_b\"]\nplan = [\"random\"]\n\
         poses = { from = 3, to = 24, scale = \"log\" }\nnoise_scale = { from = 0.25, to = 4, scale = \"log\" }\n",
    );
    assert_eq!(study.axes.cells(), 2 * 16);
    let (runner, cells) = run(folder.path(), study);
    let axes = &runner.study().axes;
    let points: Vec<(u64, String)> =
        (0..16).map(|k| (axes.cell(k).poses().unwrap(), format!("{}", axes.cell(k).noise_scale()))).collect();
    for (k, point) in points.iter().enumerate() {
        assert!(!points[..k].contains(point), "{point:?}");
        assert_eq!(axes.cell(k).poses(), axes.cell(16 + k).poses(), "both machines meet the same points");
    }
    // The error of stiffness is proportional to the noise, and falls with the root of the number of poses.
    let laws = hexbench_experiments::sweep::page::laws(runner.study(), &cells);
    for law in laws {
        let [poses, noise] = [0, 1].map(|k| law.exponents[k].1);
        assert!((noise - 1.0).abs() < 0.1 && (-1.0..-0.3).contains(&poses), "{law:?}");
    }
    let page = plain(&summary(runner.study(), &cells));
    let words = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("What results follow") && words.contains("16 points, sobol"), "{page}");
    // 16-fold in noise against 8-fold in poses, whose error falls with a root.
    let most =
        "Stiffness error, rms follows noise (times the usual) most (significantly): rank correlation 0.";
    assert!(words.contains(most) && words.contains("; poses least, -0."), "{page}");
}

#[test]
fn inputs_that_are_off_cost_stiffness_and_coverage_and_exact_ones_cost_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let axes = "[axes]\ngeometry = [\"ring_a\"]\nplan = [\"random\"]\nposes = [6]\nnoise_scale = [0.1]\n";
    let head = "trials = 400\ntask = \"springs\"\nredraw = 10\n";
    let (_, cells) = run(folder.path(), study(&format!("{head}{axes}tolerance_scale = [0, 1, 3]\n")));
    let [exact, usual, large] = [0, 1, 2].map(|k| cells[k].springs.errors.rms());
    // A load known to 0.2 % in each component alone is an error of about as much.
    assert!(usual > 2.0 * exact && usual > 0.1, "{exact} {usual} %");
    assert!((large / usual - 3.0).abs() < 0.3, "errors grow in proportion: {usual} {large} %");
    let [of_exact, of_large] = [0, 2].map(|k| cells[k].coverage()[0]);
    assert!(of_exact > 0.93 && of_large < 0.5, "{of_exact} {of_large}");
    let other = tempfile::tempdir().unwrap();
    let (_, without) = run(other.path(), study(&format!("{head}{axes}")));
    assert_eq!(without[0].springs.errors.rms().to_bits(), exact.to_bits(), "0 are exact inputs");
}

#[test]
fn a_diagnosis_that_knows_its_tolerances_does_not_name_what_they_do() {
    let folder = tempfile::tempdir().unwrap();
    let study = study(
        "trials = 16\ntask = \"diagnose\"\n[axes]\ngeometry = [\"ring_a\"]\nplan = [\"rich\"]\n\
         tolerance_scale = [0, 2]\n",
    );
    let (_, cells) = run(folder.path(), study);
    for cell in &cells {
        let wrong = cell.answers.share(Counted::Of(Fate::FalseName)).rate();
        assert!(wrong <= 1.0 / 16.0, "{wrong}");
    }
}
