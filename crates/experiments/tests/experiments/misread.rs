//! A small study of files that do not say what is meant: what matters, what is found, the same bytes on any number of threads.

use std::path::Path;

use hexbench_experiments::harness::{self, Protocol, Silent};
use hexbench_experiments::misread::{
    Misread, MisreadCampaign, MisreadFate, MisreadGroup, MisreadProtocol, MisreadScene, WHOLE_FILE, case,
    page, sheets,
};
use hexbench_experiments::trial::kinds;
use hexbench_model::results::diagnose::diagnose;
use hexbench_model::terms::catalogue;
use hexbench_report::render::markdown;
use hexbench_truth::misstatements::registry;
use hexbench_truth::scene::{PartName, Scene, VirtualBench};

/// Right words that speak of more than a file.
const BESIDE_FILES: [&str; 3] = ["noise-level", "tolerance", "load"];

/// One that any data show, one that none can show, and one that leaves the misfit alone.
const FEW: [&str; 3] = ["deflection-negated", "temperature-fahrenheit-as-kelvin", "loads-kgf-as-n"];

fn protocol() -> MisreadProtocol {
    MisreadProtocol { trials: 1, sound: 2, ..MisreadProtocol::default() }.with_misstatements(&FEW)
}

fn study(threads: usize) -> Misread {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let gathered = pool.install(|| harness::run(&protocol(), None, &Silent)).unwrap();
    Misread::of(protocol(), gathered)
}

#[test]
fn the_same_seed_gives_the_same_study_on_any_number_of_threads() {
    let [one, three] = [1, 3].map(study);
    assert!(one.failures.is_empty(), "{:?}", one.failures);
    assert_eq!(one.records, three.records);
    assert_eq!(page(&one), page(&three));
    judge(&one);
}

fn judge(study: &Misread) {
    let groups = MisreadGroup::of_each_misstatement(&study.records);
    let figures = |id: &str| {
        let group = groups.iter().find(|group| group.name == id).unwrap();
        [group.matters().hits, group.looks_right().hits]
    };
    assert_eq!(figures("deflection-negated"), [1, 0], "springs below zero look right");
    assert_eq!(figures("temperature-fahrenheit-as-kelvin"), [0, 0], "springs do not know temperature");
    assert_eq!(figures("loads-kgf-as-n"), [1, 1], "another unit of all loads shows in the springs");
    for group in &groups {
        let fates: usize = MisreadFate::ALL.map(|fate| group.share(fate).hits).iter().sum();
        assert_eq!(fates, group.matters().hits, "{}", group.name);
    }
    let text = markdown(&page(study));
    assert!(FEW.iter().all(|id| text.contains(id)), "{text}");
    assert!(text.contains("Written by `hexbench validate misread --markdown FILE`; do not edit."), "{text}");
    assert_eq!(sheets::misstatements(&study.records).rows.len(), FEW.len());
}

#[test]
fn every_right_word_is_a_word_of_the_format_and_every_word_of_a_file_is_right_for_some() {
    for entry in registry() {
        for word in entry.causes {
            assert!(WHOLE_FILE.contains(word) || BESIDE_FILES.contains(word), "{}: {word}", entry.id);
        }
    }
    for word in WHOLE_FILE {
        assert!(
            registry().any(|entry| entry.causes.first() == Some(&word) || entry.is_caused_by(word)),
            "{word}"
        );
    }
}

#[test]
fn trials_have_names_by_which_their_files_are_written() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/cubic");
    let protocol =
        MisreadProtocol { scenes: vec![MisreadScene::of(&folder).unwrap()], ..MisreadProtocol::default() };
    let drawn = |name: &str| case(name, &protocol).unwrap().unwrap();
    let MisreadCampaign::Case(written) = drawn("fz-negated/ring_b-single-0002") else { panic!("a scene") };
    assert_eq!((written.spec.family, &written.truth["misstatement"]), ("ring_b", &"fz-negated".into()));
    let MisreadCampaign::Scene { scene, size, .. } = drawn("scene/cubic-3x-0007") else { panic!("a case") };
    assert_eq!((scene.name.as_str(), size), ("cubic", 3.0));
    for bad in [
        "fz-negated",
        "sound/single-0002",
        "sound/single-2x-0002",
        "scene/none-3x-0007",
        "magic/ring_a-clean-0001",
    ] {
        assert!(case(bad, &protocol).is_none(), "{bad}");
    }
    let jobs = protocol.jobs();
    for job in [&jobs[0], &jobs[5], &jobs[1_000], &jobs[jobs.len() - 1]] {
        let name = protocol.name(job);
        assert!(case(&name, &protocol).is_some(), "{name}");
    }
}

/// With its sign reversed too, a law that grows with the force explains a file of the wrong sign, and leaves the springs open.
#[test]
fn a_sign_reversed_throughout_is_no_nonlinear_spring() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/hidden-3");
    for seed in 0..3 {
        let scene = Scene::read_with_seed(&folder, Some(seed)).unwrap();
        let mut data = VirtualBench::new(&scene, false).dataset(PartName::Training).unwrap();
        for row in &mut data.observations {
            row.measured = row.measured.map(|x| -x);
        }
        let d = diagnose(&scene.hexapod, &data, None, &catalogue()).unwrap().diagnosis;
        let kinds = kinds(&d);
        assert!(kinds.iter().any(|kind| kind == "deflection-sign"), "seed {seed}: {:?} {kinds:?}", d.verdict);
    }
}
