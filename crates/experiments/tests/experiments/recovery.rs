//! Recovery on a small scale; `hexbench validate recovery` runs the same on two thousand campaigns.

use hexbench_core::{Hexapod, Metrology};
use hexbench_experiments::harness::{self, Silent};
use hexbench_experiments::recovery::correspondence::CORRESPONDENCES;
use hexbench_experiments::recovery::geometry::combinations;
use hexbench_experiments::recovery::protocol::Recovery;
use hexbench_experiments::recovery::pulls::right_fit;
use hexbench_experiments::recovery::scene::{HiddenSubject, RecoveryCampaign, subjects};
use hexbench_experiments::recovery::study::{RecoverySettings, RecoveryStudy};
use hexbench_model::effects::term::Need;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::fit_baseline;
use hexbench_model::estimation::fit_named::{Added, fit_wanted};
use hexbench_model::estimation::linearization::Active;
use hexbench_model::estimation::parameters::parameter_names;
use hexbench_model::terms::catalogue;
use hexbench_truth::mechanisms::{REGISTRY, Shows};

/// Campaigns of each subject.
const FEW: usize = 2;

fn subject(name: &str) -> HiddenSubject {
    subjects().into_iter().find(|s| s.name == name).unwrap()
}

fn run(settings: RecoverySettings) -> RecoveryStudy {
    let protocol = Recovery::new(settings);
    RecoveryStudy::of(&protocol, &harness::run(&protocol, None, &Silent).unwrap())
}

#[test]
fn a_small_study_holds_its_bounds_and_repeats_itself_on_one_thread() {
    let settings = RecoverySettings { campaigns: FEW * subjects().len(), diagnoses: 0, seed: 5 };
    let study = run(settings);
    assert!(study.broken.is_empty(), "{} bounds, broken: {:#?}", study.bounds, study.broken);
    assert!(study.bounds > 60, "only {} bounds", study.bounds);
    let few = RecoverySettings { campaigns: 1, ..settings };
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let bytes = |study| serde_json::to_string(&study).unwrap();
    assert_eq!(bytes(run(few)), bytes(alone.install(|| run(few))));
}

#[test]
fn deflections_never_agree_to_rounding_and_their_error_is_of_second_order_in_the_load() {
    // Relative error of the stiffness; below it world and model would share arithmetic.
    const SHARED: f64 = 1e-12;
    // Tenfold loads: a hundredfold error, give or take what is of third order.
    const POWERS: std::ops::Range<f64> = 1.8..2.3;
    let scene = RecoveryCampaign::draw(&subject("springs"), 0, 3, None).unwrap();
    let none = Metrology { sigma_translation: 1e-12, sigma_rotation: 6e-12 };
    let error = |factor: f64| {
        let data = scene.ideal_under(factor).unwrap();
        let campaign =
            Campaign::new(&Hexapod { metrology: Some(none), ..scene.hexapod().clone() }, &data).unwrap();
        let springs = fit_baseline(&campaign).unwrap().point.compliances;
        let relative = |(c, k): (&f64, f64)| (1.0 / (c * k) - 1.0).abs();
        springs.iter().zip(scene.leg_stiffness()).map(relative).fold(0.0, f64::max)
    };
    let (once, tenfold) = (error(1.0), error(10.0));
    let power = (tenfold / once).log10();
    assert!(once > SHARED, "{once:.1e}");
    assert!(POWERS.contains(&power), "errors {once:.1e} and {tenfold:.1e}: power {power:.2}");
}

#[test]
fn both_catalogues_have_the_same_effects_in_the_same_order_and_their_numbers_are_written_down() {
    let world: Vec<(&str, bool)> = REGISTRY
        .iter()
        .filter(|e| e.shows != Shows::Outside)
        .map(|e| (e.id, e.shows == Shows::Absolute))
        .collect();
    let model: Vec<(&str, bool)> =
        catalogue().iter().map(|t| (t.info().id, t.info().needs.contains(&Need::Absolute))).collect();
    assert_eq!(model, world, "id, and whether it shows in absolute poses only");
    let known: Vec<&str> = CORRESPONDENCES.iter().map(|c| c.effect).collect();
    assert_eq!(known, world.iter().map(|(id, _)| *id).collect::<Vec<_>>());
}

#[test]
fn the_numbers_of_an_effect_are_as_many_as_the_term_has() {
    for s in subjects().iter().filter(|s| s.effects.len() == 1) {
        let scene = RecoveryCampaign::draw(s, 0, 4, None).unwrap();
        let known = scene.equivalents();
        let term = s.terms().remove(0);
        let names = parameter_names(&Active::new(term.clone(), false, 1.0));
        assert_eq!(known.len(), 1, "{}", s.name);
        assert_eq!(known[0].1.values.len(), names.len(), "{}", s.name);
        let has_shape = term.info().shape.is_some() && !term.shape_is_parameter();
        assert_eq!(known[0].1.shape.is_some(), has_shape, "{}", s.name);
    }
}

/// On a grid of their shapes, laws of creep are too near each other to be told apart by readings at a few waits.
#[test]
fn readings_without_noise_choose_the_law_of_creep_that_made_them() {
    let s = subject("creep");
    let none = Metrology { sigma_translation: 1e-12, sigma_rotation: 6e-12 };
    for index in [6, 65] {
        let scene = RecoveryCampaign::draw(&s, index, 1, None).unwrap();
        let hexapod = Hexapod { metrology: Some(none), ..scene.hexapod().clone() };
        let campaign = Campaign::new(&hexapod, &scene.ideal_under(1.0).unwrap()).unwrap();
        let open: Vec<Added> = s.terms().into_iter().map(Added::from).collect();
        let (wanted, fit) = fit_wanted(&campaign, &open).unwrap();
        assert_eq!(wanted[0].term.version(), None, "campaign {index}: {:?}", fit.point.active);
    }
}

#[test]
fn absolute_poses_leave_seven_to_twelve_combinations_of_the_geometry_open_and_predict_to_the_noise() {
    // Twelve rigid motions are frames; of five of them the load gives a hint, more of one on a quieter instrument.
    const OPEN: std::ops::RangeInclusive<usize> = 7..=12;
    let s = subject("geometry, 42 numbers");
    let scene = RecoveryCampaign::draw(&s, 1, 6, None).unwrap();
    let (campaign, fit) = right_fit(&s, scene.hexapod(), &scene.case.measurements).unwrap();
    let found = combinations(&scene, &fit).unwrap();
    assert_eq!(found.misses.len() + found.open, 42);
    assert!(OPEN.contains(&found.open), "{} combinations are open", found.open);
    let errors = hexbench_model::estimation::residuals::prediction_errors(
        scene.hexapod(),
        &scene.case.holdout,
        campaign.noise,
        &fit.point,
    )
    .unwrap();
    let summary = hexbench_model::estimation::residuals::summarise(&errors, None);
    // 180 numbers: five standard deviations of a reduced chi-square, and some percent for the 48 numbers fitted.
    let most = 1.15 + 5.0 * (2.0 / summary.count as f64).sqrt();
    assert!(summary.chi2_reduced < most, "{:.2}, at most {most:.2}", summary.chi2_reduced);
}
