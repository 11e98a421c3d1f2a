//! Faults of the data are found, told with their lines, and kept from passing for physics.

use std::collections::{HashMap, HashSet};

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Hexapod, LineRange, Measurand, Observation, Vector3, Vector6, Wrench};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::fit_baseline;
use hexbench_model::estimation::linearization::Linearization;
use hexbench_model::inference::examination::FindingKind;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::machine::kinematics::Legs;
use hexbench_model::results::diagnose::{DiagnoseOptions, Diagnosis, diagnose, diagnose_with};
use hexbench_model::terms::catalogue;
use nalgebra::SVector;
use rand_distr::{Distribution, StandardNormal};

use crate::cases;
use crate::common::plan::{noisy, random_pose, reading, rich_plan};
use crate::common::random::Random;
use crate::common::world::World;
use crate::common::{PAPER_STIFFNESS, measured_machine, paper_machine};

fn clean() -> (Hexapod, Dataset) {
    let (hexapod, data, _) = cases::case("mujoco-clean");
    (hexapod, data)
}

fn told(hexapod: &Hexapod, data: &Dataset) -> Diagnosis {
    diagnose(hexapod, data, None, &catalogue()).unwrap().diagnosis
}

pub(crate) fn kinds(d: &Diagnosis) -> Vec<FindingKind> {
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
    let (hexapod, data, line) = with_one_wrong_number();
    let d = told(&hexapod, &data);
    assert_eq!(d.verdict, Verdict::Measurement);
    assert_eq!(kinds(&d), [FindingKind::Blunder]);
    assert_eq!(d.findings[0].rows, [line]);
}

#[test]
fn a_sign_that_changes_to_and_fro_is_told_of_the_readings_and_not_of_the_machine() {
    let (hexapod, mut data, _) = cases::case("mujoco-foundation");
    let every_second = data.observations.chunks_mut(4).skip(1).step_by(2).flatten();
    every_second.for_each(|reading| reading.measured[0] *= -1.0);
    let d = told(&hexapod, &data);
    assert_eq!((d.verdict, kinds(&d)), (Verdict::Measurement, vec![FindingKind::Inconsistent]));
    assert!(d.added.is_empty() && d.parameters.is_empty(), "{:?}", d.parameters);
}

/// Adds what two legs do that share a bracket which yields, by a share of the compliance of a leg, while other brackets do not.
fn loosen_one_bracket(hexapod: &Hexapod, data: &mut Dataset, share: f64) {
    let campaign = Campaign::new(hexapod, data).unwrap();
    let springs = fit_baseline(&campaign).unwrap().point;
    let lin = Linearization::at(&campaign, &springs).unwrap();
    let coupling = catalogue().into_iter().find(|term| term.info().id == "leg-coupling").unwrap();
    let (pair, size) = (lin.machine.bracket_pairs[0], share * springs.compliances.mean());
    // The column of all brackets alike comes first.
    let columns = lin.term_block(coupling.as_ref(), true, 1.0).select_columns(&pair.map(|leg| 1 + leg));
    for (g, (group, at)) in campaign.groups.iter().zip(&lin.conditions).enumerate() {
        let seen: Vector6 = columns.fixed_rows::<6>(6 * g).column_sum();
        let moved = at.weights.numbers(seen * size);
        for &row in &group.rows {
            let numbers = data.observations[row as usize].measured.iter_mut();
            numbers.zip(&moved).for_each(|(number, gained)| *number += gained);
        }
    }
}

#[test]
fn one_bracket_that_yields_is_told_as_the_coupling_of_its_legs_and_not_as_a_wrong_joint() {
    let (hexapod, mut data) = clean();
    loosen_one_bracket(&hexapod, &mut data, 0.2);
    let d = told(&hexapod, &data);
    assert_eq!(kinds(&d), []);
    assert_eq!(d.added, ["leg-coupling"]);
}

/// Readings of a sound machine of which one is wrong, and its line.
fn with_one_wrong_number() -> (Hexapod, Dataset, u64) {
    let (hexapod, mut data) = clean();
    let sigma = hexapod.metrology.unwrap().sigma_translation;
    data.observations[17].measured[1] += 30.0 * sigma;
    let line = data.observations[17].line;
    (hexapod, data, line)
}

fn told_with(hexapod: &Hexapod, data: &Dataset, options: &DiagnoseOptions) -> Diagnosis {
    diagnose_with(hexapod, data, None, &catalogue(), options).unwrap().diagnosis
}

/// An answer as an alternative states it.
fn answer(d: &Diagnosis) -> (Verdict, Vec<String>, [Option<f64>; 6], f64) {
    let stiffness = std::array::from_fn(|leg| d.stiffness(leg).map(|p| p.value));
    (d.verdict, d.added.clone(), stiffness, d.steps.last().unwrap().fitted.chi2_reduced)
}

fn alternative(d: &Diagnosis) -> (Verdict, Vec<String>, [Option<f64>; 6], f64) {
    let a = d.alternative.clone().unwrap();
    (a.verdict, a.added, a.stiffness.map(|leg| leg.map(|p| p.value)), a.chi2_reduced)
}

#[test]
fn each_of_the_two_answers_tells_the_other() {
    let (hexapod, data, line) = with_one_wrong_number();
    let without = told(&hexapod, &data);
    let with = told_with(&hexapod, &data, &DiagnoseOptions::default().with_keep_all(true));
    assert_eq!((kinds(&with), with.keep_all), (kinds(&without), true));
    for d in [&without, &with] {
        assert_eq!(d.alternative.as_ref().unwrap().rows, [line]);
    }
    assert_eq!(alternative(&without), answer(&with));
    assert_eq!(alternative(&with), answer(&without));
    let (kept, left_out) = (answer(&with).3, answer(&without).3);
    assert!(kept > 1.5 * left_out, "a wrong number that is kept is seen: {kept} beside {left_out}");
}

#[test]
fn a_wrong_row_is_kept_with_the_noise_that_was_found() {
    let (mut hexapod, data, line) = with_one_wrong_number();
    let metrology = hexapod.metrology.as_mut().unwrap();
    metrology.sigma_translation /= 2.0;
    metrology.sigma_rotation /= 2.0;
    let without = told(&hexapod, &data);
    let with = told_with(&hexapod, &data, &DiagnoseOptions::default().with_keep_all(true));
    assert_eq!(kinds(&without), [FindingKind::Blunder, FindingKind::NoiseLevel]);
    assert_eq!(without.noise.translation_um.map(f64::to_bits), with.noise.translation_um.map(f64::to_bits));
    assert_eq!(without.alternative.as_ref().unwrap().rows, [line]);
    assert_eq!(alternative(&without), answer(&with));
}

#[test]
fn a_line_excluded_by_name_gives_the_answer_of_the_examination() {
    let (hexapod, data, line) = with_one_wrong_number();
    let found = told(&hexapod, &data);
    let named = told_with(&hexapod, &data, &DiagnoseOptions::default().with_exclude([line.into()]));
    assert_eq!(
        (named.excluded.as_slice(), kinds(&named), named.alternative.is_none()),
        (&[line][..], vec![], true)
    );
    assert_eq!(named.verdict, Verdict::Adequate);
    let (found, named) = (answer(&found), answer(&named));
    assert_eq!((found.1, found.2, found.3.to_bits()), (named.1, named.2, named.3.to_bits()));
}

#[test]
fn nothing_differs_where_nothing_is_left_out() {
    let (hexapod, data) = clean();
    let options = DiagnoseOptions::default().with_keep_all(true);
    for d in [told(&hexapod, &data), told_with(&hexapod, &data, &options)] {
        assert_eq!((d.alternative, d.excluded), (None, vec![]));
    }
}

#[test]
fn lines_without_a_reading_are_refused_and_ranges_leave_out_what_they_hold() {
    let (hexapod, data) = clean();
    let last = data.observations.last().unwrap().line;
    let tried = |text: &str| {
        let lines: LineRange = text.parse().unwrap();
        let options = DiagnoseOptions::default().with_exclude([lines]);
        diagnose_with(&hexapod, &data, None, &catalogue(), &options).map(|study| study.diagnosis.excluded)
    };
    let refused = Err(ModelError::NoReading { lines: 1.into(), readings: Some((2, last)) });
    assert_eq!(tried("1"), refused);
    assert!(matches!(tried(&format!("{}-{}", last + 1, last + 9)), Err(ModelError::NoReading { .. })));
    assert_eq!(tried("1-3"), Ok(vec![2, 3]));
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

#[test]
fn noise_that_is_stated_too_small_is_told_beside_an_error_of_the_setup() {
    let (mut hexapod, mut data) = clean();
    let sigma = hexapod.metrology.unwrap();
    change_conditions::<6>(&mut data, 5, |o, error| {
        for (k, value) in o.measured.iter_mut().enumerate() {
            let one = if k < 3 { sigma.sigma_translation } else { sigma.sigma_rotation };
            *value += 0.7 * one * error[k];
        }
    });
    assert_eq!(kinds(&told(&hexapod, &data)), [FindingKind::SetupError]);
    let stated = hexapod.metrology.as_mut().unwrap();
    stated.sigma_translation /= 1.5;
    stated.sigma_rotation /= 1.5;
    let d = told(&hexapod, &data);
    assert_eq!(kinds(&d), [FindingKind::SetupError, FindingKind::NoiseLevel]);
    let level: f64 = d.findings[1].size.split(' ').next().unwrap().parse().unwrap();
    assert!((1.4..1.6).contains(&level), "{}", d.findings[1].size);
}

#[test]
fn repeats_that_agree_with_the_noise_stated_do_not_contradict_it_where_poses_share_an_error() {
    let (hexapod, mut data) = clean();
    let sigma = hexapod.metrology.unwrap();
    let mut rng = stream(1, Purpose::Test, [61]);
    let mut of_pose: HashMap<i64, [f64; 6]> = HashMap::new();
    for row in &mut data.observations {
        let error = of_pose.entry(row.pose_id).or_insert_with(|| {
            std::array::from_fn(|k| {
                let one = if k < 3 { sigma.sigma_translation } else { sigma.sigma_rotation };
                let times: f64 = StandardNormal.sample(&mut rng);
                2.5 * one * times
            })
        });
        row.measured.iter_mut().zip(error).for_each(|(value, error)| *value += *error);
    }
    let d = told(&hexapod, &data);
    assert!(kinds(&d).contains(&FindingKind::SharedReference), "{:?}", kinds(&d));
    assert!(d.warnings.iter().all(|warning| !warning.contains("repeats scatter")), "{:?}", d.warnings);
}

#[test]
fn a_size_far_beyond_what_is_plausible_is_remarked() {
    let (hexapod, mut data) = clean();
    assert_eq!(told(&hexapod, &data).warnings, [""; 0]);
    data.observations.iter_mut().for_each(|row| row.measured[2] += 3e-6 * row.elapsed);
    let d = told(&hexapod, &data);
    assert_eq!(d.added, ["metrology-drift"]);
    assert_eq!(d.warnings.len(), 1, "{:?}", d.warnings);
    assert!(
        d.warnings[0].contains("metrology-drift.translation-rate-z is 44 times its plausible size"),
        "{:?}",
        d.warnings
    );
}

#[test]
fn noise_of_rotations_alone_that_is_stated_too_small_is_told_with_both_levels() {
    for name in ["mujoco-clean", "mujoco-foundation"] {
        let (mut hexapod, data, _) = cases::case(name);
        let sound = told(&hexapod, &data);
        hexapod.metrology.as_mut().unwrap().sigma_rotation /= 2.0;
        let d = told(&hexapod, &data);
        assert_eq!((kinds(&d), &d.added), (vec![FindingKind::NoiseLevel], &sound.added), "{name}");
        assert!(d.findings[0].size.contains(", rotations by "), "{name}: {}", d.findings[0].size);
        let ratio = |k: usize| d.noise.both()[k].unwrap() / sound.noise.both()[k].unwrap();
        assert!(
            [0, 1].into_iter().all(|k| (ratio(k) - 1.0).abs() < 0.1),
            "{name}: {} {}",
            ratio(0),
            ratio(1)
        );
    }
}

#[test]
fn a_load_cell_that_is_off_throughout_is_told_with_its_component_and_names_no_effect() {
    let (hexapod, mut data) = clean();
    for o in &mut data.observations {
        o.wrench.force.x *= 1.06;
        o.reference.force.x *= 1.06;
    }
    let d = told(&hexapod, &data);
    assert_eq!((d.verdict, kinds(&d)), (Verdict::Measurement, vec![FindingKind::Tolerance]));
    assert!(d.findings[0].size.starts_with("fx -"), "{}", d.findings[0].size);
}

/// Loads that act beside the point of the file (m, mobile axes).
fn act_beside(data: &mut Dataset, shift: Vector3) {
    for o in &mut data.observations {
        let arm = o.pose.rotation() * shift;
        for load in [&mut o.wrench, &mut o.reference] {
            load.moment += arm.cross(&load.force);
        }
    }
}

#[test]
fn loads_beside_their_point_by_less_than_an_effect_are_told_with_the_place() {
    for name in ["mujoco-clean", "mujoco-foundation"] {
        let (hexapod, mut data, _) = cases::case(name);
        let sound = told(&hexapod, &data);
        act_beside(&mut data, Vector3::new(0.0, 1e-3, 0.0));
        let d = told(&hexapod, &data);
        assert_eq!((kinds(&d), &d.added), (vec![FindingKind::Tolerance], &sound.added), "{name}");
        assert_eq!(d.verdict, sound.verdict, "{name}: what tolerances allow is no fault");
        let size: f64 = d.findings[0].size.trim_end_matches(" mm").parse().unwrap();
        // Their tolerance draws the most probable place to the stated one.
        assert!((0.6..1.1).contains(&size), "{name}: {}", d.findings[0].text);
        assert!(d.findings[0].text.contains("and within what"), "{}", d.findings[0].text);
        assert!(d.findings[0].next.contains("fit load-offset"), "{}", d.findings[0].next);
    }
}

/// Changes readings by so many standard normal numbers, which are drawn once for every condition.
fn change_conditions<const N: usize>(
    data: &mut Dataset,
    seed: u64,
    change: impl Fn(&mut Observation, &SVector<f64, N>),
) {
    let mut drawn: HashMap<[[u64; 6]; 2], SVector<f64, N>> = HashMap::new();
    let mut random = stream(seed, Purpose::CaseFault, []);
    for o in &mut data.observations {
        let condition = [o.pose.bits(), o.wrench.to_array().map(f64::to_bits)];
        let mut draw = || SVector::from_fn(|_, _| StandardNormal.sample(&mut random));
        change(o, drawn.entry(condition).or_insert_with(&mut draw));
    }
}

/// Loads that scatter by so many N, and a tenth of it in N m.
fn scatter_loads(data: &mut Dataset, size: f64, seed: u64) {
    change_conditions::<6>(data, seed, |o, error| {
        o.wrench.force += error.fixed_rows::<3>(0) * size;
        o.wrench.moment += error.fixed_rows::<3>(3) * (0.1 * size);
    });
}

#[test]
fn loads_that_scatter_are_told_with_their_size_and_are_no_effect() {
    for name in ["mujoco-foundation", "two-effects"] {
        let (hexapod, mut data, _) = cases::case(name);
        let sound = told(&hexapod, &data);
        scatter_loads(&mut data, 1.0, 3);
        let d = told(&hexapod, &data);
        assert_eq!(kinds(&d), [FindingKind::LoadNoise], "{name}");
        // Other loads hide in part where the load acts, but look like no other effect.
        assert_eq!(d.added[0], "base-compliance", "{name}");
        assert!(d.added.iter().all(|id| sound.added.contains(id)), "{name}: {:?}", d.added);
        let size: f64 = d.findings[0].size.split(' ').next().unwrap().parse().unwrap();
        assert!((0.8..1.3).contains(&size), "{name}: {}", d.findings[0].size);
    }
}

#[test]
fn loads_that_are_off_by_a_share_of_theirs_are_told_with_it_and_are_no_effect() {
    for name in ["mujoco-clean", "mujoco-foundation", "two-effects"] {
        let (hexapod, mut data, _) = cases::case(name);
        let sound = told(&hexapod, &data);
        change_conditions::<1>(&mut data, 7, |o, drawn| {
            let factor = 1.0 + 0.03 * drawn.x;
            o.wrench.force *= factor;
            o.wrench.moment *= factor;
        });
        let d = told(&hexapod, &data);
        assert_eq!(d.added, sound.added, "{name}");
        // A load that is far off is told by itself.
        let [.., found] = &d.findings[..] else { panic!("{name}: nothing is found") };
        assert_eq!(found.kind, FindingKind::LoadNoise, "{name}");
        let size: f64 = found.size.split(' ').next().unwrap().parse().unwrap();
        assert!((1.5..4.0).contains(&size) && found.size.contains("% of"), "{name}: {}", found.size);
    }
}

#[test]
fn loads_that_scatter_by_little_or_much_are_not_told_as_something_outside_the_catalogue() {
    for (name, size, seed) in ["mujoco-clean", "mujoco-foundation"]
        .into_iter()
        .flat_map(|name| [0.3, 0.6, 1.2].map(|size| (name, size)))
        .flat_map(|(name, size)| [1, 2, 3, 4].map(|seed| (name, size, seed)))
    {
        let (hexapod, mut data, _) = cases::case(name);
        scatter_loads(&mut data, size, seed);
        let d = told(&hexapod, &data);
        assert_ne!(d.verdict, Verdict::Outside, "{name} {size} {seed}");
        let expected = if name == "mujoco-clean" { vec![] } else { vec!["base-compliance".to_owned()] };
        assert_eq!(d.added, expected, "{name} {size} {seed}");
    }
}

#[test]
fn a_temperature_that_nobody_wrote_down_is_told_with_its_size_and_is_no_effect() {
    const STRAIN: f64 = 4e-6;
    for name in ["mujoco-clean", "mujoco-foundation"] {
        let (hexapod, mut data, _) = cases::case(name);
        let sound = told(&hexapod, &data);
        change_conditions::<1>(&mut data, 5, |o, drawn| {
            o.delta_t = 0.0;
            let legs = Legs::at(&hexapod.base_joints, &hexapod.platform_joints, &o.pose).unwrap();
            let twist = legs.platform_jacobian * legs.lengths * (STRAIN * drawn.x);
            o.measured.iter_mut().zip(&twist).for_each(|(number, gained)| *number += gained);
        });
        let d = told(&hexapod, &data);
        assert_eq!((kinds(&d), &d.added), (vec![FindingKind::SetupError], &sound.added), "{name}");
        let size: f64 = d.findings[0].size.split(' ').next().unwrap().parse().unwrap();
        assert!((0.75..1.3).contains(&(size * 1e-6 / STRAIN)), "{name}: {}", d.findings[0].size);
        assert!(d.findings[0].next.contains("delta_T_K"), "{}", d.findings[0].next);
    }
}

#[test]
fn coordinates_that_are_not_equally_good_are_a_matter_of_the_noise() {
    let (hexapod, mut data) = clean();
    // Independent errors, uniform within three standard deviations (Weyl's sequence, scrambled by Knuth's multiplier).
    for (i, o) in (1_u32..).zip(&mut data.observations) {
        let scrambled = i.wrapping_mul(2_654_435_761).rotate_left(16).wrapping_mul(2_246_822_519);
        o.measured[2] += 1.5e-6 * (f64::from(scrambled) / f64::from(u32::MAX) * 2.0 - 1.0);
    }
    let d = told(&hexapod, &data);
    assert_eq!((d.verdict, kinds(&d)), (Verdict::Measurement, vec![FindingKind::NoiseLevel]));
    assert!(d.findings[0].text.contains("c by"), "{}", d.findings[0].text);
}

/// The first reading of every condition.
fn without_repeats(data: &mut Dataset) {
    let mut seen = HashSet::new();
    data.observations.retain(|o| seen.insert([o.pose.bits(), o.wrench.to_array().map(f64::to_bits)]));
}

#[test]
fn one_coordinate_that_scatters_more_is_a_matter_of_the_noise_without_repeats_too() {
    for name in ["mujoco-clean", "mujoco-foundation"] {
        let (hexapod, mut data, _) = cases::case(name);
        without_repeats(&mut data);
        let sound = told(&hexapod, &data);
        let sigma = hexapod.metrology.unwrap().sigma_translation;
        change_conditions::<1>(&mut data, 11, |o, drawn| o.measured[2] += 3.0 * sigma * drawn.x);
        let d = told(&hexapod, &data);
        assert_eq!((kinds(&d), &d.added), (vec![FindingKind::NoiseLevel], &sound.added), "{name}");
        assert!(d.findings[0].size.starts_with("dc by "), "{name}: {}", d.findings[0].size);
    }
}

#[test]
fn readings_that_scatter_by_a_share_of_themselves_are_told_with_it_and_are_no_effect() {
    let (hexapod, mut data) = clean();
    let mut random = stream(13, Purpose::CaseFault, []);
    for o in &mut data.observations {
        for number in &mut o.measured {
            let error: f64 = StandardNormal.sample(&mut random);
            *number *= 1.0 + 0.04 * error;
        }
    }
    let d = told(&hexapod, &data);
    assert_eq!((d.verdict, kinds(&d)), (Verdict::Measurement, vec![FindingKind::NoiseLevel]));
    let share: f64 = d.findings[0].size.split(' ').next().unwrap().parse().unwrap();
    assert!((3.0..5.1).contains(&share), "{}", d.findings[0].size);
}

#[test]
fn a_reference_reading_that_is_wrong_at_one_pose_is_told_with_its_lines_and_is_no_effect() {
    for name in ["mujoco-clean", "mujoco-foundation"] {
        let (hexapod, mut data, _) = cases::case(name);
        let sound = told(&hexapod, &data);
        let pose = data.observations[0].pose;
        let at_pose = |o: &Observation| o.pose.bits() == pose.bits();
        for o in data.observations.iter_mut().filter(|o| at_pose(o)) {
            o.measured[2] -= 6e-6;
            o.measured[3] += 2e-5;
        }
        let lines: Vec<u64> = data.observations.iter().filter(|o| at_pose(o)).map(|o| o.line).collect();
        let d = told(&hexapod, &data);
        assert_eq!((kinds(&d), &d.added), (vec![FindingKind::Blunder], &sound.added), "{name}");
        assert_eq!(d.findings[0].rows, lines, "{name}");
        assert!(d.findings[0].text.contains("reference reading"), "{name}: {}", d.findings[0].text);
    }
}

#[test]
fn readings_at_the_end_of_a_range_are_left_out_with_their_lines_and_are_no_effect() {
    for name in ["mujoco-clean", "mujoco-foundation"] {
        let (hexapod, mut data, _) = cases::case(name);
        let sound = told(&hexapod, &data);
        let mut sizes: Vec<f64> = data.observations.iter().map(|o| o.measured[2].abs()).collect();
        sizes.sort_by(f64::total_cmp);
        let end = sizes[sizes.len() * 9 / 10];
        let is_beyond = |o: &&Observation| o.measured[2].abs() >= end;
        let lines: Vec<u64> = data.observations.iter().filter(is_beyond).map(|o| o.line).collect();
        data.observations.iter_mut().for_each(|o| o.measured[2] = o.measured[2].clamp(-end, end));
        let d = told(&hexapod, &data);
        assert_eq!((kinds(&d), &d.added), (vec![FindingKind::Blunder], &sound.added), "{name}");
        assert_eq!(d.findings[0].rows, lines, "{name}");
        assert!(d.findings[0].text.contains("end of its range"), "{name}: {}", d.findings[0].text);
    }
}

/// What a gauge shows of motions, one after the other, that rests at the reference before each of them.
fn shown(motions: impl Iterator<Item = f64>, half_band: f64, has_play: bool) -> Vec<f64> {
    let mut last = 0.0_f64;
    let of = |motion: f64| {
        let reference = if has_play { last.clamp(-half_band, half_band) } else { 0.0 };
        last = reference.clamp(motion - half_band, motion + half_band);
        last - reference
    };
    motions.map(of).collect()
}

#[test]
fn gauges_that_stick_or_have_play_are_told_with_their_width_and_are_no_effect() {
    for (name, has_play) in ["mujoco-clean", "mujoco-foundation", "friction"]
        .into_iter()
        .flat_map(|name| [(name, false), (name, true)])
    {
        let (hexapod, mut data, _) = cases::case(name);
        let sound = told(&hexapod, &data);
        let half_band = 2.0 * hexapod.metrology.unwrap().sigma_translation;
        for k in [0, 2] {
            let read = shown(data.observations.iter().map(|o| o.measured[k]), half_band, has_play);
            data.observations.iter_mut().zip(read).for_each(|(o, read)| o.measured[k] = read);
        }
        let d = told(&hexapod, &data);
        assert_eq!(
            (kinds(&d), &d.added),
            (vec![FindingKind::DeadBand], &sound.added),
            "{name} {has_play} {:?}",
            d.findings
        );
        if name == "friction" {
            // Friction and the band of the gauges look alike in part.
            continue;
        }
        let told = &d.findings[0].size;
        let widths = widths_of(told);
        let right = |width: &f64| (width / half_band - 1.0).abs() < 0.25;
        assert!(widths.len() == 2 && widths.iter().all(right), "{name} {has_play}: {told}");
        assert!(told.contains("da by") && told.contains("dc by"), "{name} {has_play}: {told}");
    }
}

/// Half widths that a finding of a dead band names, m or rad.
fn widths_of(size: &str) -> Vec<f64> {
    size.split(", ").map(|one| 1e-6 * one.split(' ').nth(2).unwrap().parse::<f64>().unwrap()).collect()
}

#[test]
fn the_width_of_a_dead_band_is_found_beside_effects_that_took_a_part_of_it_at_first() {
    for name in ["mujoco-foundation", "two-effects"] {
        let (hexapod, mut data, _) = cases::case(name);
        let sound = told(&hexapod, &data);
        let half_band = 2.0 * hexapod.metrology.unwrap().sigma_translation;
        for k in 0..3 {
            let read = shown(data.observations.iter().map(|o| o.measured[k]), half_band, false);
            data.observations.iter_mut().zip(read).for_each(|(o, read)| o.measured[k] = read);
        }
        let d = told(&hexapod, &data);
        assert_eq!((kinds(&d), &d.added), (vec![FindingKind::DeadBand], &sound.added), "{name}");
        let widths = widths_of(&d.findings[0].size);
        let right = |width: &f64| (width / half_band - 1.0).abs() < 0.15;
        assert!(widths.len() == 3 && widths.iter().all(right), "{name}: {}", d.findings[0].size);
    }
}

#[test]
fn lever_arms_that_are_all_short_are_told_with_their_share_and_are_no_effect() {
    let (hexapod, mut data) = clean();
    for o in &mut data.observations {
        o.wrench.moment *= 1.03;
        o.reference.moment *= 1.03;
    }
    let d = told(&hexapod, &data);
    assert_eq!((d.verdict, kinds(&d)), (Verdict::Measurement, vec![FindingKind::Tolerance]));
    assert!(d.findings[0].size.starts_with("moments -2."), "{}", d.findings[0].size);
}

#[test]
fn readings_that_cannot_judge_leave_the_verdict_undecided() {
    let (hexapod, data) = clean();
    let hexapod = Hexapod { metrology: None, ..hexapod };
    // One reading of every condition and no stated noise: nothing tells noise from what the springs leave.
    let mut seen = std::collections::HashSet::new();
    let first =
        data.observations.iter().filter(|o| seen.insert((o.pose_id, o.wrench.to_array().map(f64::to_bits))));
    let data = Dataset { observations: first.copied().collect(), ..data.clone() };
    let d = told(&hexapod, &data);
    assert_eq!((d.verdict, d.added.len()), (Verdict::Undecided, 0));
}

/// The same readings written down in whole multiples of a step, m and rad.
fn rounded(data: &Dataset, length: f64, angle: f64) -> Dataset {
    let mut data = data.clone();
    for o in &mut data.observations {
        for (k, x) in o.measured.iter_mut().enumerate() {
            let step = if k < 3 { length } else { angle };
            *x = (*x / step).round() * step;
        }
    }
    data
}

#[test]
fn readings_rounded_to_more_than_their_noise_have_a_resolution_and_its_variance() {
    let (hexapod, data) = clean();
    let d = told(&hexapod, &rounded(&data, 1e-6, 1e-5));
    assert_eq!((d.verdict, kinds(&d)), (Verdict::Measurement, vec![FindingKind::Resolution]));
    assert_eq!(d.findings[0].size, "1 um in da, db, dc, 10 urad in dalpha, dbeta, dgamma");
    let stated = hexapod.metrology.unwrap();
    let expected = [
        stated.sigma_translation.hypot(1e-6 / 12_f64.sqrt()),
        stated.sigma_rotation.hypot(1e-5 / 12_f64.sqrt()),
    ];
    let used = [d.noise.translation_um, d.noise.rotation_urad];
    for (used, expected) in used.iter().zip(expected) {
        let used = used.unwrap();
        assert!((used / expected * 1e-6 - 1.0).abs() < 1e-9, "{used} for {expected:e}");
    }
}

#[test]
fn a_coarse_step_in_some_columns_does_not_hide_an_effect() {
    let (hexapod, data, _) = cases::case("mujoco-foundation");
    let d = told(&hexapod, &rounded(&data, 1e-9, 1e-5));
    assert_eq!(
        (kinds(&d), d.added.as_slice()),
        (vec![FindingKind::Resolution], &["base-compliance".to_owned()][..])
    );
    assert_eq!(d.findings[0].size, "10 urad in dalpha, dbeta, dgamma");
}

#[test]
fn repeats_that_are_rounded_alike_are_no_unknown_effect() {
    // Four times the noise in translation, seven times in rotation: repeats of a condition often read the same.
    let (hexapod, data) = clean();
    let d = told(&hexapod, &rounded(&data, 2e-6, 2e-5));
    assert_eq!((d.verdict, kinds(&d)), (Verdict::Measurement, vec![FindingKind::Resolution]));
    let (hexapod, data, _) = cases::case("friction");
    let d = told(&hexapod, &rounded(&data, 2e-6, 2e-5));
    assert_ne!(d.verdict, Verdict::Outside, "{:?}", d.findings);
}

#[test]
fn a_step_below_the_noise_says_nothing() {
    let (hexapod, data) = clean();
    assert_eq!(kinds(&told(&hexapod, &rounded(&data, 1e-7, 1e-6))), []);
}

#[test]
fn a_coordinate_that_changes_its_sign_within_the_file_is_no_unknown_effect_and_no_dozen_of_blunders() {
    let (hexapod, mut data) = clean();
    let half = data.observations.len() / 2;
    for o in &mut data.observations[half..] {
        o.measured[0] = -o.measured[0];
    }
    let d = told(&hexapod, &data);
    assert_eq!((d.verdict, kinds(&d)), (Verdict::Measurement, vec![FindingKind::DeflectionSign]));
    assert!(d.findings[0].text.starts_with("in lines 86-169 da seems"), "{:?}", d.findings);
}

#[test]
fn repeats_that_agree_deny_a_noise_that_is_a_thousand_times_the_stated_one() {
    let (hexapod, mut data) = clean();
    // What no catalogue lists, and no fault of single readings: every load moves the platform to where no other does.
    for (n, o) in data.observations.iter_mut().enumerate() {
        let wave = |k: usize| ((n / 2 * 7 + k * 5) as f64).sin();
        o.measured = std::array::from_fn(|k| o.measured[k] + wave(k) * if k < 3 { 1e-3 } else { 5e-3 });
    }
    let d = told(&hexapod, &data);
    assert!(!kinds(&d).contains(&FindingKind::NoiseLevel), "{:?}", d.findings);
    assert_eq!(d.verdict, Verdict::Outside);
}

/// A plan of so many poses, each under the loads one after the other, read twice.
fn plan_of(poses: i64, loads: &[[f64; 6]], seed: u64) -> Vec<Observation> {
    let mut random = Random::new(seed);
    let mut rows = Vec::new();
    for pose_id in 1..=poses {
        let pose = random_pose(&mut random, 15.0, 8.0);
        for (load, repeat) in loads.iter().flat_map(|load| [(load, 1), (load, 2)]) {
            let reading = reading(pose, Wrench::from_array(*load), Wrench::default());
            rows.push(Observation { pose_id, repeat, ..reading });
        }
    }
    rows
}

#[test]
fn one_wrong_pose_of_eight_is_found_though_it_is_more_than_a_tenth_of_the_readings() {
    let hexapod = measured_machine(0.5e-6, 3e-6);
    let loads: [[f64; 6]; 6] = std::array::from_fn(|k| {
        let size = if k < 3 { 200.0 } else { 15.0 };
        std::array::from_fn(|i| if i == k { size } else { 0.0 })
    });
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let sound = world.measure(Measurand::DeflectionRotationVector, &plan_of(8, &loads, 5));
    let mut data = noisy(&sound, 0.5e-6, 3e-6, 6);
    assert_eq!(told(&hexapod, &data).verdict, Verdict::Adequate);
    let wrong: Vec<u64> = data.observations.iter().filter(|o| o.pose_id == 5).map(|o| o.line).collect();
    data.observations.iter_mut().filter(|o| o.pose_id == 5).for_each(|o| o.pose.angles.y += 0.09);
    let d = told(&hexapod, &data);
    assert_eq!((d.verdict, kinds(&d)), (Verdict::Measurement, vec![FindingKind::Pose]), "{:?}", d.findings);
    assert_eq!(d.findings[0].rows, wrong);
}

#[test]
fn a_wrong_load_among_absolute_poses_is_found_however_many_there_are() {
    let hexapod = measured_machine(0.5e-6, 3e-6);
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let loads = [[0.0; 6], [60.0, 40.0, -300.0, 0.0, 0.0, 0.0]];
    for poses in [16, 40] {
        let sound = world.measure(Measurand::AbsolutePose, &plan_of(poses, &loads, 7));
        let mut data = noisy(&sound, 0.5e-6, 3e-6, 8);
        let is_wrong = |o: &Observation| o.pose_id == 9 && o.wrench != Wrench::default();
        let wrong: Vec<u64> = data.observations.iter().filter(|o| is_wrong(o)).map(|o| o.line).collect();
        data.observations.iter_mut().filter(|o| is_wrong(o)).for_each(|o| o.wrench.force.z *= 1.3);
        let d = told(&hexapod, &data);
        assert_eq!(kinds(&d), [FindingKind::Load], "{poses} poses: {:?}", d.findings);
        assert_eq!(d.findings[0].rows, wrong, "{poses} poses");
        assert!(d.added.is_empty(), "{poses} poses: {:?}", d.added);
    }
}

#[test]
fn repeats_at_different_temperatures_tell_the_noise_beside_what_the_temperature_does() {
    const ALPHA: f64 = 1e-5;
    let hexapod = paper_machine();
    let world = World::on_springs(&hexapod, PAPER_STIFFNESS);
    let repeated: Vec<Observation> = rich_plan(14, 1.0, 3)
        .into_iter()
        .flat_map(|row| (1..=4).map(move |repeat| Observation { repeat, ..row }))
        .collect();
    let mut data = world.measure(Measurand::DeflectionRotationVector, &repeated);
    data.columns.delta_t = true;
    let mut random = Random::new(9);
    for o in &mut data.observations {
        o.delta_t = random.within(1.0);
        let legs = Legs::at(&hexapod.base_joints, &hexapod.platform_joints, &o.pose).unwrap();
        let grown = legs.platform_jacobian * legs.lengths * (ALPHA * o.delta_t);
        let noise = |k: usize| if k < 3 { 0.5e-6 } else { 3e-6 };
        o.measured = std::array::from_fn(|k| o.measured[k] + grown[k] + noise(k) * random.normal());
    }
    let d = told(&hexapod, &data);
    assert_eq!((kinds(&d), d.added.as_slice()), (vec![], ["thermal-expansion".to_owned()].as_slice()));
    let [translation, rotation] = d.noise.both().map(Option::unwrap);
    assert!(
        (translation / 0.5 - 1.0).abs() < 0.15 && (rotation / 3.0 - 1.0).abs() < 0.15,
        "{translation} {rotation}"
    );
}
