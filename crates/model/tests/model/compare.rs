//! The comparison on cases with a known answer.

use hexbench_model::application::model_file::{DataOrigin, Estimator, Model};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::fit_named::{Added, fit_named, refuse_undetermined, term_named};
use hexbench_model::results::compare::{Comparison, compare};
use hexbench_model::results::diagnose::prepare;
use hexbench_model::terms::catalogue;

use crate::cases;

fn of(case: &str) -> Comparison {
    let (hexapod, data, holdout) = cases::case(case);
    compare(&hexapod, &data, None, Some(&holdout)).unwrap().comparison
}

#[test]
fn a_clean_machine_is_adequate_and_follows_nothing() {
    let c = of("mujoco-clean");
    assert!(c.adequacy.lack_of_fit_chi2.unwrap().p > 0.01 && c.adequacy.lack_of_fit_f.unwrap().p > 0.01);
    assert!(c.associations.is_empty(), "{:?}", c.associations);
    assert!(c.period.is_none(), "{:?}", c.period);
    for leg in &c.legs {
        assert!((0.7..1.3).contains(&(leg.rms_um / leg.noise_um)), "leg {}: {}", leg.leg, leg.rms_um);
    }
}

#[test]
fn a_hidden_foundation_is_rejected_and_seen_in_leg_space() {
    let c = of("mujoco-foundation");
    assert!(c.adequacy.lack_of_fit_chi2.unwrap().p < 1e-9);
    assert!(c.adequacy.repeats_chi2.unwrap().p > 0.01, "the stated noise holds");
    assert!(!c.associations.is_empty());
    assert!(c.holdout.unwrap().chi2_reduced > 1.8);
}

#[test]
fn a_compliance_periodic_in_leg_length_shows_its_period() {
    let peak = of("not-in-catalogue").period.unwrap();
    assert_eq!((peak.leg, peak.of), (None, "compliance"));
    assert!((peak.period_mm - 8.0).abs() < 0.2 && peak.false_alarm < 1e-6, "{peak:?}");
}

#[test]
fn friction_is_seen_in_the_approach() {
    let c = of("friction");
    assert_eq!(c.associations[0].variable, "approach", "{:?}", c.associations);
}

#[test]
fn the_papers_plan_hides_a_foundation_in_the_springs() {
    let c = of("paper-protocol");
    let base = c.hidden.iter().find(|h| h.term == "base-compliance").unwrap();
    assert!(base.bias_of_leg_stiffness_percent.iter().all(|b| (-15.0..-4.0).contains(b)), "{base:?}");
    assert!(c.design.condition.unwrap() < 3.0, "well conditioned, and yet blind");
    assert!(c.period.is_none() && c.design.unobservable.is_empty());
}

#[test]
fn frames_and_joints_of_absolute_poses_are_told_in_one_sentence() {
    let (hexapod, data, holdout) = cases::case("absolute-pitch");
    let campaign = prepare(&hexapod, &data).unwrap();
    let terms = ["joint-geometry", "actuator-pitch"].map(|id| term_named(id, &catalogue()).unwrap());
    let fitted = fit_named(&campaign, &terms).unwrap();
    refuse_undetermined(&fitted).unwrap();
    let model = Model::new(&campaign, &fitted, Estimator::Gls, DataOrigin::default());
    let c = compare(&hexapod, &data, Some(&model), Some(&holdout)).unwrap().comparison;
    assert_eq!(c.design.unobservable.len(), 1);
    assert!(
        c.design.unobservable[0].starts_with("7 combinations of joint-geometry"),
        "{:?}",
        c.design.unobservable
    );
    assert!(c.holdout.unwrap().chi2_reduced < 1.4 && !c.fitted_here);
    let pitch = fitted.point.active[1].shape;
    assert!((pitch - 3e-3).abs() < 4.0 * fitted.std(18 + 36 + 12) * pitch, "pitch {pitch}");
}

#[test]
fn what_cannot_be_fitted_is_refused_by_name() {
    let (hexapod, data, _) = cases::case("mujoco-clean");
    let campaign = prepare(&hexapod, &data).unwrap();
    let all = catalogue();
    assert!(
        matches!(term_named("base-complience", &all), Err(ModelError::UnknownTerm { nearest: Some(n), .. }) if n == "base-compliance")
    );
    let absolute = term_named("leg-offset", &all).unwrap();
    assert!(matches!(fit_named(&campaign, &[absolute]), Err(ModelError::Untestable { .. })));
    let twice = term_named("creep", &all).unwrap();
    assert!(matches!(fit_named(&campaign, &[twice.clone(), twice]), Err(ModelError::Selection(_))));
}

#[test]
fn effects_are_asked_for_in_the_version_that_their_name_says() {
    let all = catalogue();
    for name in ["creep", "creep:ideal", "creep:logarithmic", "creep:richer", "base-compliance"] {
        assert_eq!(Added::named(name, &all).unwrap().name(), name);
    }
    for name in ["creep:ideal:richer", "creep:idle", "load-offset:richer"] {
        assert!(Added::named(name, &all).is_err(), "{name}");
    }
}

#[test]
fn an_effect_of_which_nothing_shows_is_not_determined() {
    let (hexapod, data, _) = cases::case("mujoco-clean");
    let campaign = prepare(&hexapod, &data).unwrap();
    // The gain of a leg in the direction it cannot be seen: a term without effect on these readings.
    let silent = hexbench_model::effects::user_term::parse(
        r#"
        format = "term/1"
        id = "whisper"
        title = "Too small to be seen"
        elongation = "size*q*1e-6"
        parameters = [{ name = "size", unit = "um/m", scale = 10 }]
    "#,
    )
    .unwrap();
    let fitted = fit_named(&campaign, &[silent]).unwrap();
    let error = refuse_undetermined(&fitted).unwrap_err();
    assert!(matches!(&error, ModelError::NotDetermined { what } if what.contains("whisper")), "{error}");
}

/// Nothing creeps here: what has settled long before the first reading fits as well as anything else, and is a softer spring.
#[test]
fn a_term_that_acts_as_other_springs_is_blamed_for_it_and_not_the_readings() {
    let (hexapod, data, _) = cases::case("mujoco-clean");
    let campaign = prepare(&hexapod, &data).unwrap();
    let creep = term_named("creep", &catalogue()).unwrap();
    let fitted = fit_named(&campaign, &[creep]).unwrap();
    let error = refuse_undetermined(&fitted).unwrap_err().to_string();
    let said = "`creep` with a time-constant of ";
    assert!(error.contains(said) && error.contains("acts like other leg springs"), "{error}");
    assert!(!error.contains("leg-1.stiffness"), "{error}");
}
