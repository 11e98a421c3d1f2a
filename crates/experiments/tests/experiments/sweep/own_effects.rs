//! Effects of studies with a size of their own, and laws of one's own.

use std::path::Path;

use hexbench_experiments::calibration::Fate;
use hexbench_experiments::challenge::{ChallengeSuite, draw};
use hexbench_experiments::harness::Silent;
use hexbench_experiments::sweep::Runner;
use hexbench_experiments::sweep::columns::answers;
use hexbench_experiments::sweep::page::{sentences, summary};
use hexbench_experiments::sweep::results::Counted;
use hexbench_experiments::sweep::task::open::OpenTrials;
use hexbench_report::render::plain;

use super::studies::run;
use super::support::study;

const LAW: &str = "{ id = \"out:formula\", elongation = \"size*f*sin(a/0.004)\", size = 1e-8 }";
const PAIR: &str = "[{ id = \"base-compliance\", size_nm_per_N = 20 }, { id = \"thermal-expansion\", size_um_per_m_K = 40 }]";

#[test]
fn effects_of_a_set_have_their_own_sizes_and_are_said_with_them() {
    let folder = tempfile::tempdir().unwrap();
    let study = study(&format!(
        "trials = 12\ntask = \"diagnose\"\n[axes]\ngeometry = [\"ring_a\"]\nplan = [\"rich\"]\n\
         effect = [{PAIR}]\nsize_factor = [0, 1]\n[question]\nname = 0.5\n"
    ));
    let (runner, cells) = run(folder.path(), study);
    let right = |cell: usize| cells[cell].answers.share(Counted::Of(Fate::Right)).rate();
    assert!(
        right(0) > 0.6 && right(1) > 0.6,
        "nothing of size 0, both of their own: {} {}",
        right(0),
        right(1)
    );
    let said = sentences(runner.study(), &cells).join(" ");
    let wanted = "base-compliance of 20 nm/N and thermal-expansion of 40 um/(m K), each times 1";
    assert!(said.contains(wanted), "{said}");
    let page = plain(&summary(runner.study(), &cells));
    for wanted in ["base-compliance 20", "nm/N+thermal-expansion 40", "um/(m K)"] {
        assert!(page.contains(wanted), "{page}");
    }
}

#[test]
fn a_size_of_its_own_is_the_true_size_and_a_factor_multiplies_it() {
    let study = study(
        "trials = 2\ntask = \"diagnose\"\n[axes]\ngeometry = [\"cubic\"]\nplan = [\"few-poses\"]\n\
         effect = [{ id = \"base-compliance\", size_nm_per_N = 3 }, { id = \"creep\", size_percent = [2, 8] }]\n\
         size_factor = [1, 0.5]\n",
    );
    let trials = OpenTrials::of(Runner::new(study).unwrap());
    let sizes = |cell| [0, 1].map(|trial| trials.trial(cell, trial).unwrap().true_size.unwrap());
    for (cell, expected) in [(0, 3.0), (1, 1.5)] {
        assert!(sizes(cell).iter().all(|size| (size - expected).abs() < 1e-9), "{:?}", sizes(cell));
    }
    let [drawn, half] = [2, 3].map(sizes);
    assert!(
        (drawn[0] - drawn[1]).abs() > 1e-3 && drawn.iter().all(|size| (2.0..=8.0).contains(size)),
        "{drawn:?}"
    );
    assert!((half[0] / drawn[0] - 0.5).abs() < 1e-9, "{drawn:?} {half:?}");
}

#[test]
fn a_law_of_ones_own_is_hidden_in_studies_and_is_outside_the_catalogue() {
    let folder = tempfile::tempdir().unwrap();
    let study = study(&format!(
        "trials = 8\ntask = \"diagnose\"\n[axes]\ngeometry = [\"ring_a\"]\nplan = [\"rich\"]\n\
         effect = [\"none\", {LAW}, {}]\n",
        LAW.replace("1e-8", "0.0")
    ));
    let (runner, cells) = run(folder.path(), study);
    let outside = answers(runner.study()).iter().position(|said| said == "outside the catalogue").unwrap();
    let said = |cell: usize| cells[cell].answers.said(outside);
    // What is neither is ambiguous: a law outside is not always told from effects that do something like it.
    assert!(said(1) >= 4 && said(0) == 0 && said(2) == 0, "{} {} {}", said(0), said(1), said(2));
    assert!(cells[1].answers.share(Counted::Of(Fate::Right)).rate() > 0.45);
    let page = plain(&summary(runner.study(), &cells));
    assert!(page.contains("(2)"), "two laws have two names: {page}");
}

#[test]
fn suites_take_the_same_effects_as_studies() {
    let text = format!(
        "format = \"challenge-suite/1\"\nname = \"own\"\nversion = 1\ntitle = \"Own\"\nseed = 4\n\
         [cases.pair]\nkind = \"pair\"\ncount = 2\nmachine = \"ring_a\"\nplan = \"rich\"\neffects = [{PAIR}]\n\
         [cases.law]\nkind = \"single\"\ncount = 1\nmachine = \"ring_a\"\nplan = \"rich\"\neffects = [{LAW}]\n\
         [cases.seen]\nkind = \"single\"\ncount = 1\nmachine = \"ring_a\"\nplan = \"rich\"\neffects = [{LAW}]\ndistance = 30\n"
    );
    let suite = ChallengeSuite::from_text(&text, Path::new("suite.toml")).unwrap();
    let cases = draw(&suite, &Silent).unwrap();
    let of = |group: &'static str| cases.iter().map(|case| &case.truth).filter(move |t| t.group == group);
    for truth in of("pair") {
        let axis = |k: usize| truth.parameters["base"][k].as_f64().unwrap().powi(-2);
        let base = ((0..3).map(axis).sum::<f64>() / 3.0).sqrt() * 1e9;
        assert!((base - 20.0).abs() < 1e-9, "{base}");
        assert_eq!(truth.effects, ["base-compliance", "thermal-expansion"]);
    }
    let [law, seen] = ["law", "seen"].map(|group| of(group).next().unwrap());
    assert_eq!(law.parameters["formula"]["factor"], 1.0);
    assert!((seen.distance - 30.0).abs() < 1e-3 && seen.parameters["formula"]["factor"] != 1.0);
    assert_eq!((&law.effects, &seen.effects), (&vec!["out:formula".to_owned()], &law.effects));
}
