//! Without a holdout file the terms, too, are chosen without the poses that judge them.

use hexbench_model::results::diagnose::{Diagnosis, diagnose};
use hexbench_model::terms::catalogue;

use crate::cases;

fn told(case: &str) -> Diagnosis {
    let (hexapod, data, _) = cases::case(case);
    diagnose(&hexapod, &data, None, &catalogue()).unwrap().diagnosis
}

#[test]
fn a_sure_effect_is_chosen_anew_whatever_poses_are_left_out() {
    let d = told("mujoco-foundation");
    let nested = d.nested.as_ref().unwrap();
    assert_eq!((nested.chosen.len(), nested.agreeing(&d.model)), (8, 8), "{:?}", nested.chosen);
    let held_out = d.steps.last().unwrap().holdout.unwrap();
    assert_eq!(nested.error.count, held_out.count);
    let ratio = nested.error.chi2_reduced / held_out.chi2_reduced;
    assert!((0.95..1.1).contains(&ratio), "other parts of the poses, the same terms: {ratio:.3}");
}

#[test]
fn with_a_holdout_file_nothing_is_chosen_anew() {
    let (hexapod, data, holdout) = cases::case("mujoco-clean");
    let d = diagnose(&hexapod, &data, Some(&holdout), &catalogue()).unwrap().diagnosis;
    assert!(d.nested.is_none());
}

#[test]
fn the_nested_error_is_the_same_on_any_number_of_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| serde_json::to_string(&told("two-effects")).unwrap())
    };
    assert_eq!(on(1), on(3));
}
