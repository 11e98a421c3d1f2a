//! What the model leaves of the legs: told where a law is missing, in the leg that has it, and nowhere on a sound machine.

use hexbench_model::results::diagnose::{Diagnosis, RemainderReport, diagnose};
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
fn nothing_remains_where_springs_and_named_effects_explain_the_readings() {
    for case in ["mujoco-clean", "friction", "contact", "two-effects"] {
        assert!(diagnosed(case).remainder.is_none(), "{case}");
    }
}
