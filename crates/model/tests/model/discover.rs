//! The law that no catalogue has: found, written, and as good as any other term; nothing is found where nothing is.

use hexbench_model::effects::user_term::parse;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{DiagnoseOptions, diagnose};
use hexbench_model::results::discover::{DiscoveryReason, DiscoveryStudy, discover};
use hexbench_model::terms::catalogue;

use crate::cases;

/// Largest error of the period of the bundled case, mm: three of the standard errors that its fit states.
const PERIOD_MM: f64 = 0.05;

fn discovered(case: &str) -> DiscoveryStudy {
    let (hexapod, data, holdout) = cases::case(case);
    discover(&hexapod, &data, Some(&holdout), &catalogue(), &DiagnoseOptions::default()).unwrap()
}

#[test]
fn outside_the_catalogue_a_law_is_found_and_then_named() {
    let found = discovered("not-in-catalogue").discovery;
    assert_eq!(found.verdict, Verdict::Outside);
    assert!(found.found && found.beside.is_empty() && found.laws.len() == 1, "{found:?}");
    let law = &found.laws[0];
    let period = law.parameters.iter().find(|p| p.name.ends_with(".period")).unwrap();
    assert!((period.value - 8.0).abs() < PERIOD_MM && period.unit == "mm", "{period:?}");
    assert_eq!(law.text, "the compliance of all legs repeats every 8.00 mm of leg length");
    let held = law.held_out.unwrap();
    assert!(held.before > 1.5 && held.after < 1.1, "{held:?}");
}

#[test]
fn the_file_of_a_law_is_a_term_that_the_diagnosis_names() {
    let (hexapod, data, holdout) = cases::case("not-in-catalogue");
    let term = parse(discovered("not-in-catalogue").term_file().unwrap()).unwrap();
    let id = term.info().id.to_owned();
    let terms: Vec<_> = catalogue().into_iter().chain([term]).collect();
    let study = diagnose(&hexapod, &data, Some(&holdout), &terms).unwrap().diagnosis;
    assert_eq!((study.verdict, &study.added), (Verdict::Named, &vec![id]));
    assert!(study.steps.last().unwrap().is_at_the_noise());
}

#[test]
fn nothing_is_found_on_a_sound_machine_or_where_the_catalogue_has_the_effect() {
    for (case, reason, beside) in [
        ("mujoco-clean", DiscoveryReason::NothingMissing, vec![]),
        ("friction", DiscoveryReason::Catalogue, vec!["joint-friction"]),
        // Play whose contact is soft fits these readings as well as the contact that is hidden.
        ("contact", DiscoveryReason::Catalogue, vec![]),
        ("two-effects", DiscoveryReason::Catalogue, vec!["base-compliance", "load-offset"]),
    ] {
        let found = discovered(case).discovery;
        assert!(!found.found && found.laws.is_empty(), "{case}: {:?}", found.laws);
        assert_eq!(
            (found.reason, found.beside),
            (reason, beside.iter().map(|b| (*b).to_owned()).collect()),
            "{case}"
        );
    }
}

#[test]
fn the_same_readings_give_the_same_bytes_on_any_number_of_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let study = discovered("not-in-catalogue");
            serde_json::to_string(&study.discovery).unwrap() + study.term_file().unwrap()
        })
    };
    assert_eq!(on(1), on(3));
}
