//! Measurements made by independent programs (a finite-deflection Newton solver, and a MuJoCo model brought to rest), with the
//! truth they were made from: predicted without noise they must agree within it. See tests/data/README.md.

mod common;

use common::{chi2_by_direction, hexapod, numbers, plan_rows, rows, stiffness, truth};
use hexbench_truth::{
    Mechanism, World,
    campaign::{Campaign, PlanKind, Yardstick, rms},
    mechanisms::{BaseCompliance, JointFriction, LegNonlinearity, LoadOffset, PeriodicCompliance},
    metrology::{Frames, Noise},
};

fn world(case: &str) -> World {
    let truth = truth(case);
    let p = &truth["parameters"];
    let mut mechanisms: Vec<Box<dyn Mechanism>> = Vec::new();
    if p["base"].is_array() {
        mechanisms.push(Box::new(BaseCompliance { stiffness: numbers(&p["base"]) }));
    }
    if p["cog"].is_array() {
        mechanisms.push(Box::new(LoadOffset { point: numbers(&p["cog"]) }));
    }
    if let Some(slider_force) = p["friction"].as_f64() {
        mechanisms.push(Box::new(JointFriction { slider_force, stick_ratio: Some(20.0) }));
    }
    if p["power"].is_array() {
        let [kappa, power] = numbers(&p["power"]);
        mechanisms.push(Box::new(LegNonlinearity { kappa, power }));
    }
    if p["periodic_compliance"].is_array() {
        let [amplitude, pitch] = numbers(&p["periodic_compliance"]);
        mechanisms.push(Box::new(PeriodicCompliance { amplitude, pitch }));
    }
    let mut world = World::new(hexapod(case), &stiffness(&truth));
    world.mechanisms = mechanisms;
    world
}

/// Reduced chi-square over both files lies within five standard deviations of one, and would not without the effects.
fn agrees(case: &str) {
    for file in ["measurements.csv", "holdout.csv"] {
        let (world, rows) = (world(case), rows(case, file));
        let by_direction = chi2_by_direction(&world, &rows);
        let chi2 = by_direction.iter().sum::<f64>() / 6.0;
        let bare = chi2_by_direction(&world.without_effects(), &rows).iter().sum::<f64>() / 6.0;
        let bound = 5.0 * (2.0 / (6.0 * rows.len() as f64)).sqrt();
        println!(
            "{case} {file}: chi2 {chi2:.4} (+-{bound:.3}), without effects {bare:.3}; {by_direction:.2?}"
        );
        assert!((chi2 - 1.0).abs() < bound, "{case} {file}: {chi2} {by_direction:?}");
        assert!(world.mechanisms.is_empty() || bare > 1.2, "{case} {file} shows nothing: {bare}");
    }
}

#[test]
fn a_clean_machine_in_mujoco_agrees() {
    agrees("mujoco-clean");
}

#[test]
fn a_yielding_foundation_in_mujoco_agrees() {
    agrees("mujoco-foundation");
}

#[test]
fn joint_friction_agrees() {
    agrees("friction");
}

#[test]
fn hertzian_contacts_agree() {
    agrees("contact");
}

#[test]
fn foundation_and_load_offset_agree() {
    agrees("two-effects");
}

#[test]
fn a_periodic_compliance_agrees() {
    agrees("not-in-catalogue");
}

#[test]
fn a_yielding_foundation_under_the_paper_protocol_agrees() {
    agrees("paper-protocol");
}

/// The distance and the size of the effect that the truth files state are those found here.
#[test]
fn sizes_of_effects_agree() {
    for case in ["contact", "friction", "not-in-catalogue", "paper-protocol", "two-effects"] {
        let (world, truth) = (world(case), truth(case));
        let bare =
            Campaign { world: world.without_effects(), frames: Frames::default(), noise: Noise::default() };
        let plan = plan_rows(case, "measurements.csv");
        let yardstick = Yardstick::new(&bare, &plan, PlanKind::Rich).unwrap();
        let all = || world.mechanisms.iter().map(|m| m.scaled(1.0)).collect();
        let (translation, rotation) = rms(&yardstick.signature(all()).unwrap());
        let raw: [f64; 2] = numbers(&truth["raw_effect_rms"]);
        let distance = yardstick.distance(all()).unwrap();
        let stated = truth["distance"].as_f64().unwrap();
        let each: Vec<f64> =
            world.mechanisms.iter().map(|m| yardstick.distance(vec![m.scaled(1.0)]).unwrap()).collect();
        println!(
            "{case}: distance {distance:.6} of {stated:.6} each {each:.4?}; {:.6} of {:.6} um, {:.6} of {:.6} urad",
            translation * 1e6,
            raw[0],
            rotation * 1e6,
            raw[1]
        );
    }
}
