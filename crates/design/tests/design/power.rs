//! What a plan would see: closed forms, levels, scaling.

use std::sync::Arc;

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{
    Approach, Columns, Dataset, Hexapod, Measurand, Observation, Pose, Tolerances, Vector3, Vector6, Wrench,
};
use hexbench_design::power::{
    EffectSizes, Planned, PowerSettings, PowerStudy, PreparedTest, Visibility, study,
};
use hexbench_model::effects::term::Term;
use hexbench_model::estimation::noise::{Noise, NoiseSource, Structure};
use hexbench_model::inference::power::noncentrality;
use hexbench_model::terms::catalogue;
use nalgebra::DVector;
use rand_distr::{Distribution, StandardNormal};

/// Shares may miss what was computed by four standard deviations, one in 16000 by chance.
const SIGMAS: f64 = 4.0;

fn machine() -> Hexapod {
    let joint = |r: f64, deg: f64, z: f64| {
        let (s, c) = deg.to_radians().sin_cos();
        Vector3::new(r * c, r * s, z)
    };
    let base = [-10.0, 10.0, 110.0, 130.0, 230.0, 250.0].map(|d| joint(0.16, d, -0.165));
    let platform = [-50.0, 50.0, 70.0, 170.0, 190.0, 290.0].map(|d| joint(0.12, d, 0.0));
    Hexapod::of_joints("ring", base, platform)
}

fn noise(factor: f64, dof: f64) -> Noise {
    let source = if dof.is_finite() { NoiseSource::Repeats } else { NoiseSource::Metrology };
    Noise {
        translation: factor * 0.5e-6,
        rotation: factor * 3e-6,
        source,
        dof,
        structure: Structure::Independent,
    }
}

/// Four poses under each load, each read `repeats` times; the waits differ from load to load.
fn plan(loads: &[[f64; 6]], repeats: i64) -> Dataset {
    let poses = [
        [0.0; 6],
        [0.02, -0.01, 0.01, 0.1, 0.0, 0.1],
        [-0.02, 0.015, 0.0, -0.05, 0.1, -0.1],
        [0.01, 0.02, -0.01, 0.0, -0.12, 0.05],
    ];
    let mut observations = Vec::new();
    for (pose_id, pose) in (1..).zip(poses) {
        for (wait, load) in [20.0, 60.0, 120.0, 240.0].into_iter().zip(loads) {
            observations.extend((1..=repeats).map(|repeat| Observation {
                block: 0,
                pose_id,
                repeat,
                line: 2,
                pose: Pose::from_array(pose),
                wrench: Wrench::from_array(*load),
                reference: Wrench::from_array([0.0, 0.0, -120.0, 0.0, 0.0, 0.0]),
                approach: Approach::Direct,
                overload: Approach::OVERLOAD,
                delta_t: 0.0,
                elapsed: wait,
                reference_age: None,
                reference_record: None,
                order: None,
                measured: [0.0; 6],
                sigma: None,
            }));
        }
    }
    let columns =
        Columns { reference: true, approach: true, delta_t: true, elapsed: true, ..Columns::default() };
    Dataset::of_poses("plan", Measurand::DeflectionEuler, columns, observations)
}

const DOWN: [f64; 6] = [0.0, 0.0, -340.0, 0.0, 0.0, 0.0];
const ALL_WAYS: [[f64; 6]; 4] = [
    DOWN,
    [100.0, 0.0, -120.0, 0.0, 0.0, 0.0],
    [0.0, 100.0, -120.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 150.0, 8.0, 0.0, 0.0],
];

fn planned(loads: &[[f64; 6]], repeats: i64, noise: Noise) -> Planned {
    Planned::new(&machine(), &plan(loads, repeats), Vector6::repeat(1.0 / 4e6), noise).unwrap()
}

fn term(id: &str) -> Arc<dyn Term> {
    catalogue().into_iter().find(|t| t.info().id == id).unwrap()
}

fn studied(planned: &Planned, ids: &[&str]) -> PowerStudy {
    let subjects = ids.iter().map(|id| EffectSizes::natural(&term(id), planned)).collect();
    study(planned, subjects, PowerSettings { draws: 40, ..PowerSettings::default() }).unwrap()
}

#[test]
fn one_parameter_is_seen_where_the_noncentral_law_says() {
    const RELATIVE: f64 = 1e-6;
    let planned = planned(&ALL_WAYS, 1, noise(1.0, f64::INFINITY));
    let effect = &studied(&planned, &["bracket-compliance"]).effects[0];
    assert!(
        (effect.threshold / 6.634_897 - 1.0).abs() < RELATIVE,
        "chi-square, 1 in 100: {}",
        effect.threshold
    );
    let found = effect.seen_at.middle;
    let subject = EffectSizes::natural(&term("bracket-compliance"), &planned);
    let (size, natural) = (subject.size(&subject.examples[0]), subject.examples[0].values[0]);
    assert!((size / (natural * 1e9) - 1.0).abs() < RELATIVE, "nm/N: {size} of {natural}");
    let signature = planned.signature(subject.term.as_ref(), 1.0, &subject.examples[0].values);
    let expected = noncentrality(1.0, 0.01, 0.9).sqrt() / planned.absorption.rest(&signature).norm();
    assert!((found / expected - 1.0).abs() < RELATIVE, "{found} {expected}");
}

#[test]
fn twice_the_noise_takes_twice_the_size_and_four_repeats_half_of_it() {
    const RELATIVE: f64 = 1e-6;
    let ids = ["bracket-compliance", "leg-coupling", "load-offset"];
    let sizes = |repeats, factor| -> Vec<f64> {
        let planned = planned(&ALL_WAYS, repeats, noise(factor, f64::INFINITY));
        // Repeats make the noise smaller, not the errors of the inputs.
        studied(&planned.with_exact_inputs().unwrap(), &ids)
            .effects
            .iter()
            .map(|e| e.usual_size * e.seen_at.middle)
            .collect()
    };
    let single = sizes(1, 1.0);
    for (other, factor) in [(sizes(1, 2.0), 2.0), (sizes(4, 1.0), 0.5)] {
        for (id, (a, b)) in ids.iter().zip(single.iter().zip(&other)) {
            assert!((b / a / factor - 1.0).abs() < RELATIVE, "{id}: {b} {a}");
        }
    }
}

#[test]
fn a_test_over_many_shapes_keeps_its_level_and_its_power() {
    const DRAWS: usize = 4000;
    // The computed figures rest on as many draws of their own.
    const BOTH: f64 = std::f64::consts::SQRT_2;
    for dof in [f64::INFINITY, 36.0] {
        let planned = planned(&ALL_WAYS, 1, noise(1.0, dof));
        let settings = PowerSettings::default();
        let subject = EffectSizes::natural(&term("leg-nonlinearity"), &planned);
        let test = PreparedTest::new(&planned, subject.term.as_ref(), &settings).unwrap();
        assert!(test.shapes() > 5);
        let example = &subject.examples[3];
        let whole = planned.signature(subject.term.as_ref(), example.shape, &example.values);
        let rest = planned.absorption.rest(&whole);
        let signature = &rest * (4.0 / rest.norm());
        let computed = test.chance(&signature);
        assert!((0.5..0.99).contains(&computed), "{computed}");
        for (mean, expected) in [(0.0 * &signature, settings.alarm), (signature, computed)] {
            let share = share_seen(&test, &mean, dof, DRAWS);
            let sigma = BOTH * (expected * (1.0 - expected) / DRAWS as f64).sqrt();
            assert!((share - expected).abs() < SIGMAS * sigma, "dof {dof}: {share} instead of {expected}");
        }
    }
}

/// Share of noisy residuals about a mean in which a test sees something.
fn share_seen(test: &PreparedTest, mean: &DVector<f64>, noise_dof: f64, draws: usize) -> f64 {
    let mut rng = stream(7, Purpose::Test, [7]);
    let law = rand_distr::ChiSquared::new(noise_dof.min(1e9)).unwrap();
    let mut seen = 0;
    for _ in 0..draws {
        let y = mean.map(|x| -> f64 { x + Distribution::<f64>::sample(&StandardNormal, &mut rng) });
        let level = if noise_dof.is_finite() { law.sample(&mut rng) / noise_dof } else { 1.0 };
        seen += usize::from(test.sees(&(y / level.sqrt())));
    }
    seen as f64 / draws as f64
}

#[test]
fn legs_that_never_pull_show_neither_play_nor_a_softer_side() {
    let planned = planned(&[DOWN], 2, noise(1.0, f64::INFINITY));
    let study = studied(&planned, &["leg-asymmetry", "leg-backlash", "bracket-compliance"]);
    let verdicts: Vec<Visibility> = study.effects.iter().map(|e| e.verdict).collect();
    assert_eq!(verdicts[..2], [Visibility::NoTrace; 2]);
    assert!(study.effects[2].shows());
    assert!(study.alike.taken_for[0].is_empty());
}

#[test]
fn creep_after_equal_waits_is_taken_for_softer_springs() {
    const ROUNDING: f64 = 1e-9;
    let mut rows = plan(&ALL_WAYS, 1);
    rows.observations.iter_mut().for_each(|o| o.elapsed = 60.0);
    let springs = Vector6::repeat(1.0 / 4e6);
    let planned = Planned::new(&machine(), &rows, springs, noise(1.0, f64::INFINITY)).unwrap();
    let effect = &studied(&planned, &["creep"]).effects[0];
    assert_eq!(effect.verdict, Visibility::Absorbed);
    assert!((effect.absorbed - 1.0).abs() < ROUNDING, "{}", effect.absorbed);
    // The stiffness falls by the grown share of the compliance, x: 1 / (1 + x) - 1.
    let grown = 1.0 - (-60.0 / effect.example.shape).exp();
    let expected = 100.0 * (1.0 / (1.0 + effect.example.values[0] * grown) - 1.0);
    let found = effect.bias_at_usual_size_percent[0];
    assert!((found - expected).abs() < 1e-6, "{found} {expected}");
}

#[test]
fn an_estimated_noise_takes_a_larger_effect() {
    let size = |dof| {
        let planned = planned(&ALL_WAYS, 1, noise(1.0, dof));
        studied(&planned, &["base-compliance"]).effects[0].seen_at.middle
    };
    let [stated, many, few] = [f64::INFINITY, 600.0, 18.0].map(size);
    assert!(stated < many && many < few, "{stated} {many} {few}");
    assert!(many / stated < 1.02, "{many} {stated}");
}

/// The plan of [`planned`] for a machine whose tolerances are `factor` times the usual ones.
fn planned_within(factor: f64) -> Planned {
    let t = Tolerances::default();
    let tolerances = Tolerances {
        joints: t.joints * factor,
        load_gain: t.load_gain * factor,
        load_direction: t.load_direction * factor,
        load_point: t.load_point * factor,
        frame: t.frame * factor,
        ..t
    };
    let hexapod = Hexapod { tolerances, ..machine() };
    let springs = Vector6::repeat(1.0 / 4e6);
    Planned::new(&hexapod, &plan(&ALL_WAYS, 2), springs, noise(1.0, f64::INFINITY)).unwrap()
}

#[test]
fn inputs_as_good_as_exact_change_no_figure() {
    let ids = ["bracket-compliance", "leg-coupling", "load-offset", "leg-nonlinearity"];
    let nearly = planned_within(1e-9);
    let exact = nearly.with_exact_inputs().unwrap();
    let told = |planned| format!("{:?}", studied(planned, &ids));
    assert_eq!(nearly.tolerances(), None);
    assert_eq!(told(&nearly), told(&exact));
}

#[test]
fn the_less_inputs_are_known_the_larger_an_effect_must_be() {
    /// A large error of an input leaves nothing of what looks like it.
    const MOST: f64 = 1.0 + 1e-9;
    let ids = ["bracket-compliance", "leg-coupling", "load-offset", "base-compliance"];
    let sizes = |factor| -> Vec<f64> {
        studied(&planned_within(factor), &ids).effects.iter().map(|e| e.seen_at.middle).collect()
    };
    let all = [1e-9, 0.3, 1.0, 3.0].map(sizes);
    for pair in all.windows(2) {
        let grown = pair[0].iter().zip(&pair[1]).all(|(less, more)| *less <= more * MOST);
        assert!(grown, "{pair:?}");
    }
    let usual = studied(&planned_within(1.0), &ids);
    let told: Vec<f64> = usual.effects.iter().filter_map(|e| e.seen_at_with_exact_inputs).collect();
    assert_eq!(told, all[0], "what exact inputs would show is told beside");
    assert!(all[3][2] > 2.0 * all[0][2], "an error of the point of attack looks like load-offset: {all:?}");
}

#[test]
fn shares_of_explanations_add_up_and_an_effect_unlike_the_others_leads() {
    const ROUNDING: f64 = 1e-9;
    let planned = planned(&ALL_WAYS, 2, noise(1.0, f64::INFINITY));
    let ids = ["bracket-compliance", "load-offset", "leg-asymmetry"];
    let alike = studied(&planned, &ids).alike;
    for (k, row) in alike.taken_for.iter().enumerate() {
        let sum: f64 = row.iter().sum();
        assert!((sum - 1.0).abs() < ROUNDING, "{sum}");
        assert!((0..ids.len()).all(|j| row[j] <= row[k]), "{}: {row:?}", ids[k]);
        assert!((alike.cosine[k][k] - 1.0).abs() < ROUNDING, "{}", alike.cosine[k][k]);
    }
}

#[test]
fn a_plan_without_a_change_of_load_is_refused() {
    let reference = [0.0, 0.0, -120.0, 0.0, 0.0, 0.0];
    let rows = plan(&[reference], 1);
    let refused = Planned::new(&machine(), &rows, Vector6::repeat(1e-7), noise(1.0, f64::INFINITY));
    assert!(refused.is_err_and(|e| e.to_string().contains("no leg changes its force")));
}
