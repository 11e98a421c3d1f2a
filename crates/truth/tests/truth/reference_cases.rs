//! Measurements made by independent programs (a finite-deflection Newton solver, and a `MuJoCo` model brought to rest), with the
//! truth they were made from: predicted without noise they must agree within it. See tests/data/README.md.

use hexbench_core::{Measurand, Pose};
use hexbench_truth::{
    Mechanism, World,
    campaign::{SimulatedCampaign, Yardstick, rms},
    mechanisms::{
        ActuatorPitch, BaseCompliance, JointFriction, JointGeometry, LegNonlinearity, LoadOffset,
        PeriodicCompliance,
    },
    metrology::{InstrumentFrames, InstrumentNoise},
};
use nalgebra::{DMatrix, DVector};

use crate::common::{self, chi2_by_direction, hexapod, numbers, plan_rows, points, rows, stiffness, truth};

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
        let bare = SimulatedCampaign {
            world: world.without_effects(),
            frames: InstrumentFrames::default(),
            noise: InstrumentNoise::default(),
        };
        let plan = plan_rows(case, "measurements.csv");
        let yardstick = Yardstick::new(&bare, &plan, Measurand::DeflectionEuler).unwrap();
        let all = || world.mechanisms.iter().map(|m| m.scaled(1.0)).collect();
        let (translation, rotation) = rms(&yardstick.signature(all()).unwrap());
        let raw: [f64; 2] = numbers(&truth["raw_effect_rms"]);
        let distance = yardstick.distance(all()).unwrap();
        let stated = truth["distance"].as_f64().unwrap();
        let each: Vec<f64> =
            world.mechanisms.iter().map(|m| yardstick.distance(vec![m.scaled(1.0)]).unwrap()).collect();
        let errors =
            [distance / stated - 1.0, translation * 1e6 / raw[0] - 1.0, rotation * 1e6 / raw[1] - 1.0];
        println!("{case}: distance, um and urad rms off by {errors:.8?}; distance of each effect {each:.4?}");
        // The other program takes out the springs by linear columns, which moves the distance in the third digit.
        assert!(
            errors[0].abs() < 2e-3 && errors[1].abs() < 1e-6 && errors[2].abs() < 1e-6,
            "{case} {errors:?}"
        );
    }
}

/// Absolute poses of true joints and a periodic lead error.
#[test]
fn joint_geometry_and_periodic_leads_agree() {
    let case = "absolute-pitch";
    let (truth, hexapod) = (truth(case), hexapod(case));
    let p = &truth["parameters"];
    let minus = |key: &str, nominal: &[[f64; 3]; 6]| {
        let points = points(&p[key]);
        std::array::from_fn(|i| std::array::from_fn(|k| points[i][k] - nominal[i][k]))
    };
    let (nominal_base, nominal_platform) =
        (hexapod.base_joints.map(Into::into), hexapod.platform_joints.map(Into::into));
    let geometry = JointGeometry {
        base: minus("A_true", &nominal_base),
        platform: minus("B_true", &nominal_platform),
        nominal_base,
        nominal_platform,
    };
    let pitch = ActuatorPitch {
        amplitude: p["actuator_pitch"][0].as_f64().unwrap(),
        pitch: p["actuator_pitch"][1].as_f64().unwrap(),
        phases: numbers(&p["actuator_pitch"][2]),
    };
    let world = World::new(hexapod, &stiffness(&truth)).with(Box::new(geometry)).with(Box::new(pitch));
    let frames = fitted_frames(&world, &rows(case, "measurements.csv"));
    for file in ["measurements.csv", "holdout.csv"] {
        let rows = rows(case, file);
        let chi2 = whitened(&world, &frames, &rows).norm_squared() / (6 * rows.len()) as f64;
        let bound = 5.0 * (2.0 / (6.0 * rows.len() as f64)).sqrt();
        println!("{case} {file}: chi2 {chi2:.4}, frames {frames:.1?}");
        assert!((chi2 - 1.0).abs() < bound, "{case} {file}: {chi2}");
    }
}

/// Reading minus prediction over noise, with the metrology and the target frame `[um, urad]` as given.
fn whitened(world: &World, frames: &[f64; 12], rows: &[common::Row]) -> DVector<f64> {
    let pose = |k: usize| Pose::from_array(std::array::from_fn(|i| frames[k + i] * 1e-6));
    let frames = InstrumentFrames { metrology: pose(0), target: pose(6) };
    let sigma = InstrumentNoise::default().sigma();
    let errors = rows.iter().flat_map(|row| {
        let seen = frames.seen(&world.pose(&row.situation).unwrap());
        (row.measured - seen.to_vector()).component_div(&sigma).iter().copied().collect::<Vec<_>>()
    });
    DVector::from_iterator(6 * rows.len(), errors)
}

/// The instrument's frames, which the truth file does not state, by Gauss-Newton.
fn fitted_frames(world: &World, rows: &[common::Row]) -> [f64; 12] {
    let mut frames = [0.0; 12];
    for _ in 0..3 {
        let now = whitened(world, &frames, rows);
        let columns: Vec<_> = (0..12)
            .map(|k| {
                let mut shifted = frames;
                shifted[k] += 1.0;
                whitened(world, &shifted, rows) - &now
            })
            .collect();
        let a = DMatrix::from_columns(&columns);
        let step = (a.tr_mul(&a)).lu().solve(&a.tr_mul(&now)).unwrap();
        frames.iter_mut().zip(step.iter()).for_each(|(f, s)| *f -= s);
    }
    frames
}
