//! What the model leaves of the legs: told where a law is missing, in the leg that has it, and nowhere on a sound machine.

use hexbench_model::application::model_file::{DataOrigin, Estimator, Model};
use hexbench_model::application::predict::predict;
use hexbench_model::inference::selection::JudgedTask;
use hexbench_model::results::diagnose::{Diagnosis, RemainderReport, diagnose, prepare};
use hexbench_model::terms::catalogue;

use crate::cases;

fn diagnosed(case: &str) -> Diagnosis {
    let (hexapod, data, holdout) = cases::case(case);
    diagnose(&hexapod, &data, Some(&holdout), &catalogue()).unwrap().diagnosis
}

/// Largest share left of a leg, percent.
fn largest(remainder: &RemainderReport) -> f64 {
    remainder.legs.iter().map(|leg| leg.percent_of_spring).fold(0.0, f64::max)
}

#[test]
fn a_law_that_the_catalogue_lacks_remains_in_every_leg_and_follows_its_length() {
    let d = diagnosed("not-in-catalogue");
    let remainder = d.remainder.as_ref().unwrap();
    assert_eq!(remainder.legs.len(), 6, "{remainder:?}");
    // The compliance of every leg has a wave; its root mean square is its amplitude over the square root of two.
    assert!((2.0..20.0).contains(&largest(remainder)), "{remainder:?}");
    // A stiffness is no better known than what is left.
    for leg in &remainder.legs {
        let stiffness = d.stiffness(leg.leg - 1).unwrap();
        assert!(stiffness.std / stiffness.value >= leg.percent_of_spring / 100.0, "{stiffness:?} {leg:?}");
    }
}

#[test]
fn a_fitted_model_is_as_wide_as_what_it_leaves() {
    let (hexapod, data, _) = cases::case("not-in-catalogue");
    let campaign = prepare(&hexapod, &data).unwrap();
    let task = JudgedTask { hexapod: &hexapod, data: &data, campaign: &campaign, holdout: None };
    let judged = task.fit(&[]).unwrap();
    assert!(judged.left.is_any());
    let pure = Model::new(&campaign, &judged.fit, Estimator::Gls, DataOrigin::default());
    let open = pure.clone().open_by(&judged.left.share);
    for leg in 0..6 {
        let share = (open.std(leg).powi(2) - pure.std(leg).powi(2)).sqrt() / open.point.compliances[leg];
        assert!((share / judged.left.share[leg] - 1.0).abs() < 1e-9, "leg {}: {share}", leg + 1);
    }
    let rows = &data.observations[..1];
    let [narrow, wide] = [&pure, &open].map(|model| predict(model, rows).unwrap()[0].sigma);
    assert!(narrow.iter().zip(wide).all(|(n, w)| *n < w), "{narrow:?} {wide:?}");
    // The numbers that people read are those of the model that is kept.
    let [read, kept] = [judged.estimates(), open.estimates()].map(|e| e.determined);
    assert_eq!(read, kept);
}

#[test]
fn nothing_remains_where_springs_and_named_effects_explain_the_readings() {
    for case in ["mujoco-clean", "friction", "contact", "two-effects"] {
        assert!(diagnosed(case).remainder.is_none(), "{case}");
    }
}
