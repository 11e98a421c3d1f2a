//! Faults of the data are found, told with their lines, and kept from passing for physics.

use hexbench_core::{Dataset, Hexapod};
use hexbench_model::inference::examination::FindingKind;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{Diagnosis, diagnose};
use hexbench_model::terms::catalogue;

use crate::cases;

fn clean() -> (Hexapod, Dataset) {
    let (hexapod, data, _) = cases::case("mujoco-clean");
    (hexapod, data)
}

fn told(hexapod: &Hexapod, data: &Dataset) -> Diagnosis {
    diagnose(hexapod, data, None, &catalogue()).unwrap().diagnosis
}

fn kinds(d: &Diagnosis) -> Vec<FindingKind> {
    d.findings.iter().map(|f| f.kind).collect()
}

#[test]
fn sound_readings_have_no_findings() {
    for name in ["mujoco-clean", "mujoco-foundation", "friction", "two-effects", "not-in-catalogue"] {
        let (hexapod, data, _) = cases::case(name);
        assert_eq!(kinds(&told(&hexapod, &data)), [], "{name}");
    }
}

#[test]
fn one_wrong_number_is_a_blunder_with_its_line_and_not_an_unknown_effect() {
    let (hexapod, mut data) = clean();
    let sigma = hexapod.metrology.unwrap().sigma_translation;
    data.observations[17].measured[1] += 30.0 * sigma;
    let d = told(&hexapod, &data);
    assert_eq!(d.verdict, Verdict::Measurement);
    assert_eq!(kinds(&d), [FindingKind::Blunder]);
    assert_eq!(d.findings[0].rows, [data.observations[17].line]);
}

#[test]
fn a_wrong_load_is_told_with_its_size() {
    let (hexapod, mut data) = clean();
    let place = data.observations.iter().position(|o| o.wrench.force.x.abs() > 50.0).unwrap();
    let (condition, applied) = (data.observations[place], data.observations[place].wrench.force.x);
    for o in &mut data.observations {
        if o.pose == condition.pose
            && o.wrench == condition.wrench
            && o.delta_t.to_bits() == condition.delta_t.to_bits()
        {
            o.wrench.force.x = 1.5 * applied;
        }
    }
    let d = told(&hexapod, &data);
    assert_eq!((d.verdict, kinds(&d)), (Verdict::Measurement, vec![FindingKind::Load]));
    let told: f64 = d.findings[0].size.split(' ').next().unwrap().parse().unwrap();
    // The stiffness of the legs in the direction of the load decides how well it is known.
    assert!((told / applied - 1.0).abs() < 0.25, "{} for {applied}", d.findings[0].size);
}

#[test]
fn noise_that_is_stated_too_small_is_told_and_the_machine_still_judged() {
    for name in ["mujoco-clean", "mujoco-foundation"] {
        let (mut hexapod, data, _) = cases::case(name);
        let sound = told(&hexapod, &data);
        let metrology = hexapod.metrology.as_mut().unwrap();
        metrology.sigma_translation /= 2.0;
        metrology.sigma_rotation /= 2.0;
        let d = told(&hexapod, &data);
        assert_eq!(kinds(&d), [FindingKind::NoiseLevel], "{name}");
        assert_eq!(d.added, sound.added, "{name}");
    }
}
