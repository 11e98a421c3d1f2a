//! Files that do not mean what they say are found, with what they seem to mean, and pass for no effect.

use hexbench_core::{Dataset, Hexapod, Observation, Pose, Vector3};
use hexbench_model::inference::examination::FindingKind;
use hexbench_model::inference::misread::{
    AngleOrder, Change, Group, KINDS, Multiple, Signed, SignedAxes, Target,
};
use hexbench_model::inference::selection::HeldOut;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::check::check;
use hexbench_model::results::diagnose::{DiagnoseOptions, Diagnosis, diagnose, diagnose_with};
use hexbench_model::terms::catalogue;

use crate::cases;
use crate::examination::kinds;

/// A mistake as a user makes it in the files of a campaign, and its word.
type Mistake = (FindingKind, fn(&mut Hexapod, &mut Dataset));

const MISTAKES: [Mistake; 12] = [
    (FindingKind::DeflectionSign, |_, data| each(data, |o| o.measured = o.measured.map(|x| -x))),
    (FindingKind::RotationSign, |_, data| each(data, |o| o.measured[3..].iter_mut().for_each(|x| *x = -*x))),
    (FindingKind::MomentSign, |_, data| {
        each(data, |o| {
            o.wrench.moment *= -1.0;
            o.reference.moment *= -1.0;
        });
    }),
    (FindingKind::Unit, |_, data| each(data, |o| o.measured[3..].iter_mut().for_each(|x| *x *= 1e-3))),
    (FindingKind::Axes, |_, data| {
        each(data, |o| o.measured = turned(&o.measured, |v| Vector3::new(-v.y, v.x, v.z)));
    }),
    (FindingKind::LegOrder, |hexapod, _| hexapod.platform_joints.swap(0, 1)),
    (FindingKind::JointsExchanged, |hexapod, _| {
        std::mem::swap(&mut hexapod.base_joints, &mut hexapod.platform_joints);
    }),
    (FindingKind::WrenchFrame, |_, data| {
        each(data, |o| {
            let back = o.pose.rotation().transpose();
            for w in [&mut o.wrench, &mut o.reference] {
                (w.force, w.moment) = (back * w.force, back * w.moment);
            }
        });
    }),
    (FindingKind::ReferenceMissing, |_, data| {
        each(data, |o| o.reference = hexbench_core::Wrench::default());
        data.columns.reference = false;
    }),
    (FindingKind::RowOrder, |_, data| {
        let loads: Vec<_> = data.observations.iter().map(|o| (o.wrench, o.reference)).collect();
        for (i, o) in data.observations.iter_mut().enumerate() {
            (o.wrench, o.reference) = loads[(i + 1) % loads.len()];
        }
    }),
    (FindingKind::Origin, |_, data| each(data, |o| o.pose.translation.z += 0.12)),
    (FindingKind::Geometry, |hexapod, _| hexapod.base_joints[2].x += 0.009),
];

fn each(data: &mut Dataset, change: impl FnMut(&mut Observation)) {
    data.observations.iter_mut().for_each(change);
}

fn turned(measured: &[f64; 6], turn: impl Fn(&Vector3) -> Vector3) -> [f64; 6] {
    let (shift, rotation) = measured.split_at(3);
    let parts = [shift, rotation].map(|part| turn(&Vector3::from_column_slice(part)));
    std::array::from_fn(|k| parts[k / 3][k % 3])
}

fn told(hexapod: &Hexapod, data: &Dataset) -> Diagnosis {
    diagnose(hexapod, data, None, &catalogue()).unwrap().diagnosis
}

fn read_as(d: &Diagnosis) -> Change {
    let text = d.findings[0].next.rsplit("--read-as ").next().unwrap();
    text.parse().unwrap()
}

#[test]
fn mistakes_are_found_with_their_cause_and_effects_are_those_of_the_files_as_meant() {
    for case in ["mujoco-clean", "mujoco-foundation"] {
        let (hexapod, data, _) = cases::case(case);
        for (kind, mistake) in MISTAKES {
            let (mut hexapod, mut data) = (hexapod.clone(), data.clone());
            mistake(&mut hexapod, &mut data);
            let d = told(&hexapod, &data);
            assert_eq!(d.verdict, Verdict::Measurement, "{case}, {kind:?}: {:?}", d.findings);
            assert!(d.findings.iter().any(|f| f.kind == kind), "{case}, {kind:?}: {:?}", d.findings);
            assert!(d.findings.iter().all(|f| f.kind.is_of_file()), "{case}, {kind:?}: {:?}", d.findings);
            assert!(d.parameters.is_empty(), "{case}, {kind:?}");
            // What the model lacks is told of the files as they seem to be meant, and of them alone.
            let meant = d.other_reading.map_or_else(Vec::new, |other| other.added);
            let lacks: &[&str] = if case == "mujoco-clean" { &[] } else { &["base-compliance"] };
            assert_eq!(d.added, lacks, "{case}, {kind:?}");
            assert_eq!(d.added, meant, "{case}, {kind:?}");
        }
    }
}

/// What a finding says, and what is done to every row.
type Spoiled = (&'static str, fn(&mut Observation));

#[test]
fn columns_that_are_exchanged_within_translations_rotations_or_positions_are_found() {
    let exchanged: [Spoiled; 4] = [
        ("axes=translation-columns:y,x,z", |row| row.measured.swap(0, 1)),
        ("axes=translation-columns:x,z,y", |row| row.measured.swap(1, 2)),
        ("axes=rotation-columns:z,y,x", |row| row.measured.swap(3, 5)),
        ("axes=pose-position-columns:y,x,z", |row| row.pose.translation = row.pose.translation.yxz()),
    ];
    // Of a machine with an effect one exchange is enough: effects are weighed against it.
    for (case, tried) in [("mujoco-clean", &exchanged[..]), ("mujoco-foundation", &exchanged[..1])] {
        let (hexapod, sound, _) = cases::case(case);
        for (meant, exchange) in tried {
            let mut data = sound.clone();
            each(&mut data, exchange);
            let d = told(&hexapod, &data);
            assert_eq!(d.verdict, Verdict::Measurement, "{case}, {meant}: {:?}", d.findings);
            assert_eq!(read_as(&d).to_string(), *meant, "{case}: {:?}", d.findings);
        }
    }
}

/// What a finding says, with which size, and what is done to every row.
type SpoiledBy = (&'static str, f64, fn(&mut Observation));

#[test]
fn a_column_that_is_off_by_a_factor_or_an_amount_is_told_with_its_size() {
    let off: [SpoiledBy; 4] = [
        ("unit=da*", 1.0 / 1.2, |row| row.measured[0] *= 1.2),
        ("unit=rotations*", 1.0 / 0.85, |row| row.measured[3..].iter_mut().for_each(|x| *x *= 0.85)),
        ("zero-error=dc:", 10.0, |row| row.measured[2] += 10e-6),
        ("zero-error=dgamma:", -30.0, |row| row.measured[5] -= 30e-6),
    ];
    for (case, tried) in [("mujoco-clean", &off[..]), ("mujoco-foundation", &off[2..3])] {
        let (hexapod, sound, _) = cases::case(case);
        for (column, size, spoil) in tried {
            let mut data = sound.clone();
            each(&mut data, spoil);
            let d = told(&hexapod, &data);
            assert_eq!(d.verdict, Verdict::Measurement, "{case}, {column}: {:?}", d.findings);
            // Too small rotations are too large translations of stiffer legs.
            let sizes = d.findings.iter().filter_map(|f| {
                f.read_as[0].to_string().strip_prefix(column).and_then(|text| text.parse::<f64>().ok())
            });
            let sizes: Vec<f64> = sizes.collect();
            assert!(
                matches!(sizes[..], [x] if (x / size - 1.0).abs() < 0.05),
                "{case}, {column}{size}: {sizes:?}"
            );
        }
    }
}

#[test]
fn what_one_effect_or_a_missing_load_explains_is_no_column_that_is_off() {
    let is_off = |kind: &FindingKind| matches!(kind, FindingKind::Unit | FindingKind::ZeroError);
    // The foundation yields along z as a probe along z does that shows too much.
    let (hexapod, data, _) = cases::case("mujoco-foundation");
    let d = told(&hexapod, &data);
    assert!(!kinds(&d).iter().any(is_off) && d.added == ["base-compliance"], "{:?}", d.findings);
    let (hexapod, mut data, _) = cases::case("mujoco-clean");
    each(&mut data, |row| row.wrench.force.z += 20.0);
    let d = told(&hexapod, &data);
    assert!(!kinds(&d).iter().any(is_off), "{:?}", d.findings);
}

#[test]
fn columns_in_which_nothing_was_read_are_named() {
    let (hexapod, sound, _) = cases::case("mujoco-clean");
    let spoiled: [Spoiled; 3] = [
        ("da_um is the same number", |row| row.measured[0] = 0.0),
        ("dgamma_urad is the same number", |row| row.measured[5] = 12e-6),
        ("da_um and db_um are the same numbers", |row| row.measured[1] = row.measured[0]),
    ];
    for (text, spoil) in spoiled {
        let mut data = sound.clone();
        each(&mut data, spoil);
        let d = told(&hexapod, &data);
        let kinds: Vec<_> = d.findings.iter().map(|f| f.kind).collect();
        assert_eq!(
            (d.verdict, kinds),
            (Verdict::Measurement, vec![FindingKind::IdleColumn]),
            "{:?}",
            d.findings
        );
        assert!(d.findings[0].text.contains(text), "{:?}", d.findings);
        let found = check(&hexapod, Some(&data), None, &catalogue(), &[]).unwrap();
        assert!(!found.ready && found.findings == d.findings, "{:?}", found.findings);
    }
    // A column that the springs do not move may well read zero.
    let mut coarse = sound.clone();
    each(&mut coarse, |row| row.measured[5] = 0.0);
    let still = Hexapod {
        metrology: hexapod.metrology.map(|m| hexbench_core::Metrology { sigma_rotation: 1e-3, ..m }),
        ..hexapod
    };
    let d = told(&still, &coarse);
    assert!(d.findings.iter().all(|f| f.kind != FindingKind::IdleColumn), "{:?}", d.findings);
}

#[test]
fn a_load_that_was_not_written_down_is_named_and_the_other_rows_are_diagnosed() {
    let (hexapod, mut data, mut held) = cases::case("friction");
    each(&mut data, |row| row.wrench.moment.x = 0.0);
    each(&mut held, |row| row.wrench.moment.x = 0.0);
    let d = diagnose(&hexapod, &data, Some(&held), &catalogue()).unwrap().diagnosis;
    assert_eq!(kinds(&d), [FindingKind::Load], "{:?}", d.findings);
    assert!(d.findings[0].text.contains("mx is zero in every row"), "{:?}", d.findings);
    assert_eq!(
        (d.verdict, &d.added[..], d.holdout),
        (Verdict::Named, &["joint-friction".to_owned()][..], HeldOut::File)
    );
}

#[test]
fn a_load_that_was_not_written_down_beside_others_is_named() {
    let (hexapod, mut data, _) = cases::case("mujoco-clean");
    // Small deflections add up: each push along x comes with the vertical load that the file begins with.
    let vertical = data.observations.clone();
    each(&mut data, |row| {
        if row.wrench.force.x != 0.0 {
            let beside =
                vertical.iter().find(|o| (o.pose_id, o.repeat) == (row.pose_id, row.repeat)).unwrap();
            row.measured = std::array::from_fn(|k| row.measured[k] + beside.measured[k]);
            row.wrench = beside.wrench;
        }
    });
    let d = told(&hexapod, &data);
    assert_eq!(
        (d.verdict, kinds(&d)),
        (Verdict::Measurement, vec![FindingKind::IdleColumn]),
        "{:?}",
        d.findings
    );
    assert!(d.findings[0].text.contains("fx is zero in every row"), "{:?}", d.findings);
}

/// Columns of x and y in each other's place.
const Y_X_Z: SignedAxes = SignedAxes::new([2, 1, 3]).unwrap();

/// A sign, a unit or an axis as it changes within a file: how the rows are meant, and what is done to them.
type PartChange = (Multiple, fn(&mut Observation));

const PART_CHANGES: [PartChange; 5] = [
    (Multiple::Reversed(Signed::Reading(0)), |row| row.measured[0] *= -1.0),
    (Multiple::Reversed(Signed::Reading(3)), |row| row.measured[3] *= -1.0),
    (Multiple::Scaled(Group::Translations, 1e3), |row| {
        row.measured[..3].iter_mut().for_each(|x| *x *= 1e-3);
    }),
    (Multiple::Scaled(Group::Forces, 9.806_65), |row| {
        row.wrench.force /= 9.806_65;
        row.reference.force /= 9.806_65;
    }),
    (Multiple::Renamed(Target::WrenchColumns, Y_X_Z), |row| {
        for wrench in [&mut row.wrench, &mut row.reference] {
            (wrench.force, wrench.moment) = (wrench.force.yxz(), wrench.moment.yxz());
        }
    }),
];

#[test]
fn a_sign_a_unit_or_an_axis_that_changes_in_the_file_is_found_with_its_lines() {
    // Of a machine with an effect one change is enough: effects are weighed against it.
    for (case, tried) in [("mujoco-clean", &PART_CHANGES[..]), ("mujoco-foundation", &PART_CHANGES[..1])] {
        let (hexapod, sound, _) = cases::case(case);
        let answer = told(&hexapod, &sound);
        let rows = sound.observations.len();
        for (k, (multiple, change)) in tried.iter().enumerate() {
            for range in [rows / 3..rows, rows / 4..rows / 2] {
                let mut data = sound.clone();
                data.observations[range.clone()].iter_mut().for_each(change);
                let d = told(&hexapod, &data);
                let what = format!("{case}, change {k}, rows {range:?}: {:?}", d.findings);
                assert_eq!((d.verdict, d.findings.len()), (Verdict::Measurement, 1), "{what}");
                let Change::Within(lines, found) = read_as(&d) else { panic!("{what}") };
                assert_eq!(found, *multiple, "{what}");
                // Readings of nearly nothing at a boundary are the same with either sign.
                let ends = [range.start, range.end - 1].map(|row| sound.observations[row].line);
                let apart =
                    lines.ends().into_iter().zip(ends).map(|(found, true_end)| found.abs_diff(true_end));
                assert!(apart.max() <= Some(3), "{what}");
                let options = DiagnoseOptions::default().with_read_as([read_as(&d)]);
                let again = diagnose_with(&hexapod, &data, None, &catalogue(), &options).unwrap().diagnosis;
                assert_eq!((again.verdict, &again.added), (answer.verdict, &answer.added), "{what}");
            }
        }
    }
}

/// All of the above but rows in another order: where repeats are taken for readings of other loads, so is their scatter for noise.
#[test]
fn they_are_found_where_only_repeats_tell_the_noise() {
    let (mut hexapod, data, _) = cases::case("mujoco-clean");
    hexapod.metrology = None;
    for (kind, mistake) in MISTAKES.into_iter().filter(|(kind, _)| *kind != FindingKind::RowOrder) {
        let (mut hexapod, mut data) = (hexapod.clone(), data.clone());
        mistake(&mut hexapod, &mut data);
        let d = told(&hexapod, &data);
        assert_eq!(d.verdict, Verdict::Measurement, "{kind:?}: {:?}", d.findings);
        assert!(d.findings.iter().any(|f| f.kind == kind), "{kind:?}: {:?}", d.findings);
    }
}

#[test]
fn a_few_repeats_that_tell_the_noise_make_no_file_a_misread_one() {
    let (mut hexapod, data, _) = cases::case("mujoco-clean");
    hexapod.metrology = None;
    for (conditions, first) in [(3, 5), (3, 11), (5, 1), (5, 40), (6, 20), (8, 44), (12, 9)] {
        // Every seventh condition with its repeat.
        let is_kept = |i: usize| i / 2 >= first && (i / 2 - first).is_multiple_of(7);
        let rows = data.observations.iter().enumerate().filter(|(i, _)| is_kept(*i));
        let observations = rows.map(|(_, o)| *o).take(2 * conditions).collect();
        let found = told(&hexapod, &Dataset { observations, ..data.clone() });
        assert!(found.findings.is_empty(), "{conditions} from {first}: {:?}", found.findings);
    }
}

#[test]
fn read_as_the_finding_says_the_file_gives_the_answer_of_the_sound_one() {
    let (hexapod, data, _) = cases::case("mujoco-foundation");
    let sound = told(&hexapod, &data);
    for (kind, mistake) in MISTAKES {
        let (mut hexapod, mut data) = (hexapod.clone(), data.clone());
        mistake(&mut hexapod, &mut data);
        let change = read_as(&told(&hexapod, &data));
        // A size that springs alone have found is where to look, not what to write.
        if change.sizes() > 0 {
            continue;
        }
        let options = DiagnoseOptions::default().with_read_as([change]);
        let d = diagnose_with(&hexapod, &data, None, &catalogue(), &options).unwrap().diagnosis;
        assert_eq!(d.added, sound.added, "{kind:?} by {change}");
        assert_eq!(d.read_as, [change.to_string()]);
    }
}

#[test]
fn signs_that_no_reading_tells_apart_are_all_named() {
    let (hexapod, mut data, _) = cases::case("mujoco-clean");
    each(&mut data, |o| o.measured = o.measured.map(|x| -x));
    let d = told(&hexapod, &data);
    for kind in [FindingKind::DeflectionSign, FindingKind::WrenchSign, FindingKind::StatesExchanged] {
        assert!(d.findings.iter().any(|f| f.kind == kind), "{kind:?}: {:?}", d.findings);
    }
    let sum: f64 = d.findings.iter().map(|f| f.probability).sum();
    assert!((sum - 1.0).abs() < 1e-12, "{sum}");
}

#[test]
fn angles_about_moving_axes_are_found_where_they_matter() {
    let (hexapod, mut data, _) = cases::case("mujoco-foundation");
    each(&mut data, |o| {
        let r = o.pose.rotation();
        let beta = r[(0, 2)].asin();
        let (alpha, gamma) = ((-r[(1, 2)]).atan2(r[(2, 2)]), (-r[(0, 1)]).atan2(r[(0, 0)]));
        o.pose = Pose { translation: o.pose.translation, angles: Vector3::new(alpha, beta, gamma) };
    });
    let d = told(&hexapod, &data);
    assert_eq!(d.findings[0].kind, FindingKind::AngleConvention, "{:?}", d.findings);
}

#[test]
fn a_file_that_nothing_can_be_fitted_to_is_refused_with_what_it_seems_to_mean() {
    let (mut hexapod, data, _) = cases::case("mujoco-clean");
    hexapod.platform_joints.rotate_right(1);
    let error = diagnose(&hexapod, &data, None, &catalogue()).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("platform joints 2, 3, 4, 5, 6, 1"), "{error}");
    assert!(error.next_step("").contains("--read-as leg-order=2,3,4,5,6,1"), "{}", error.next_step(""));
}

#[test]
fn sound_files_are_ready_and_mean_what_they_say() {
    for case in
        ["mujoco-clean", "mujoco-foundation", "friction", "two-effects", "contact", "not-in-catalogue"]
    {
        let (hexapod, data, holdout) = cases::case(case);
        let found = check(&hexapod, Some(&data), Some(&holdout), &catalogue(), &[]).unwrap();
        assert!(found.ready, "{case}: {:?}", found.findings);
        assert!(found.measurements.is_some_and(|m| m.rows == data.observations.len()));
    }
}

#[test]
fn copies_are_left_out_and_a_held_out_file_that_holds_nothing_out_is_set_aside() {
    let (hexapod, mut data, holdout) = cases::case("mujoco-clean");
    let last = data.observations.last().unwrap().line;
    let copies: Vec<_> = data.observations.iter().take(40).copied().collect();
    data.observations.extend((1..).zip(copies).map(|(k, o)| Observation { repeat: 9, line: last + k, ..o }));
    let d = told(&hexapod, &data);
    assert_eq!((d.findings[0].kind, d.findings[0].rows.len()), (FindingKind::Copies, 40));
    assert_eq!(d.verdict, Verdict::Measurement);
    let d = diagnose(&hexapod, &holdout, Some(&holdout), &catalogue()).unwrap().diagnosis;
    assert_eq!(d.findings[0].kind, FindingKind::Holdout);
}

#[test]
fn a_held_out_file_of_another_sign_or_machine_does_not_belong_to_the_measurements() {
    let (hexapod, data, holdout) = cases::case("mujoco-clean");
    let mut reversed = holdout.clone();
    each(&mut reversed, |o| o.measured = o.measured.map(|x| -x));
    let mut softer = holdout;
    // The same readings under half the load are those of legs half as stiff.
    each(&mut softer, |o| {
        for w in [&mut o.wrench, &mut o.reference] {
            (w.force, w.moment) = (0.5 * w.force, 0.5 * w.moment);
        }
    });
    for held in [reversed, softer] {
        let d = diagnose(&hexapod, &data, Some(&held), &catalogue()).unwrap().diagnosis;
        assert_eq!((d.verdict, d.findings[0].kind), (Verdict::Measurement, FindingKind::Holdout));
    }
}

#[test]
fn a_held_out_file_that_no_effect_explains_beside_the_measurements_does_not_belong_to_them() {
    let (hexapod, data, _) = cases::case("mujoco-clean");
    let (.., holdout) = cases::case("friction");
    let d = diagnose(&hexapod, &data, Some(&holdout), &catalogue()).unwrap().diagnosis;
    assert_eq!((d.verdict, d.findings[0].kind), (Verdict::Measurement, FindingKind::Holdout));
    let found = check(&hexapod, Some(&data), Some(&holdout), &catalogue(), &[]).unwrap();
    assert_eq!(found.findings[0].kind, FindingKind::Holdout);
}

#[test]
fn one_impossible_number_of_a_held_out_file_is_told_with_its_line_and_refutes_nothing() {
    let (hexapod, data, mut holdout) = cases::case("mujoco-foundation");
    let sound = diagnose(&hexapod, &data, Some(&holdout), &catalogue()).unwrap().diagnosis;
    let rows = holdout.observations.len();
    let wrong = &mut holdout.observations[rows / 2];
    wrong.measured[1] += 25.0 * 0.5e-6;
    let line = format!("line {} of the held-out file", wrong.line);
    let d = diagnose(&hexapod, &data, Some(&holdout), &catalogue()).unwrap().diagnosis;
    assert_eq!((d.verdict, &d.added), (sound.verdict, &sound.added));
    assert_eq!(kinds(&d), [FindingKind::Holdout]);
    assert!(d.findings[0].text.contains(&line), "{}", d.findings[0].text);
    let counts = [&d, &sound].map(|d| d.steps[0].holdout.unwrap().count);
    assert_eq!(counts, [6 * (rows - 1), 6 * rows]);
}

#[test]
fn misread_files_say_what_the_model_lacks_read_as_they_seem_to_be_meant() {
    let (hexapod, mut data, mut holdout) = cases::case("mujoco-foundation");
    let sound = diagnose(&hexapod, &data, Some(&holdout), &catalogue()).unwrap().diagnosis;
    for file in [&mut data, &mut holdout] {
        each(file, |o| (3..6).for_each(|k| o.measured[k] *= 1e3));
    }
    let d = diagnose(&hexapod, &data, Some(&holdout), &catalogue()).unwrap().diagnosis;
    let other = d.other_reading.clone().unwrap();
    assert_eq!((d.verdict, other.verdict), (Verdict::Measurement, Verdict::Named));
    assert_eq!([&d.added, &other.added], [&sound.added; 2]);
    assert_eq!(other.read_as, [read_as(&d).to_string()]);
    let [before, after] = other.times_noise.unwrap();
    assert!(before > 1.3 && after < 1.15, "{before} {after}");
    assert!(d.parameters.is_empty() && sound.other_reading.is_none());
    // Whoever says how to read them is answered that, and nothing else.
    let asked = DiagnoseOptions::default().with_read_as([read_as(&d)]);
    let read_so = diagnose_with(&hexapod, &data, Some(&holdout), &catalogue(), &asked).unwrap().diagnosis;
    assert_eq!(
        (read_so.verdict, &read_so.added, &read_so.other_reading),
        (Verdict::Named, &sound.added, &None)
    );
}

/// Readings of the first pose under vertical forces, and all others.
fn few_and_others(data: &Dataset) -> [Dataset; 2] {
    let is_vertical = |w: &hexbench_core::Wrench| w.force.xy().norm() == 0.0 && w.moment.norm() == 0.0;
    let is_of_few = |o: &Observation| o.pose == data.observations[0].pose && is_vertical(&o.wrench);
    [true, false].map(|few| {
        let observations = data.observations.iter().filter(|o| is_of_few(o) == few).copied().collect();
        Dataset { observations, ..data.clone() }
    })
}

#[test]
fn six_readings_tell_no_covariance_of_coordinates() {
    let (hexapod, data, _) = cases::case("mujoco-clean");
    let [few, others] = few_and_others(&data);
    assert_eq!(few.observations.len(), 6);
    for held in [None, Some(&others)] {
        let d = diagnose(&hexapod, &few, held, &catalogue()).unwrap().diagnosis;
        assert!(d.findings.is_empty() && d.added.is_empty(), "{:?} {:?}", d.findings, d.added);
    }
}

#[test]
fn every_change_is_written_as_it_is_read() {
    let all = [
        "deflection-sign=reversed",
        "rotation-sign=dgamma",
        "wrench-sign=fz",
        "moment-sign=mx",
        "states-exchanged=yes",
        "unit=rotations*4.848137",
        "axes=readings:y,-x,z",
        "axes=wrench:turned:0.5,0,-2",
        "leg-order=2,3,4,5,6,1",
        "joints-exchanged=yes",
        "origin=moments-fixed:0,0,-95",
        "geometry=base-2-y:-1.5",
        "unit=fz*9.80665",
        "axes=pose-angle-columns:z,y,x",
        "wrench-frame=mobile",
        "wrench-frame=moments-mobile",
        "deflection-frame=mobile",
        "angle-convention=moving-x-y-z",
        "angle-convention=poses:rotation-vector",
        "rotation-convention=other",
        "reference-missing=0,0,-119.7,0,0,0",
        "reference-missing=change",
        "reference-missing=twice",
        "row-order=loads-from-below",
        "row-order=load-of-the-next",
        "row-order=readings-reversed",
        "sensor-sign=g1",
        "sensor-sign=all:distance",
        "sensor-factor=all:point*1000",
        "sensors-exchanged=g1,g2",
        "axes=points:y,-x,z",
        "sensor-factor=g1*25.4",
        "sensor-place=g1:1,-2,0.5",
        "axes=g1:turned:0,90,0",
        "wrench-sign=reference",
        "deflection-sign=da@12-99",
        "unit=forces*9.80665@2-90",
        "sensor-factor=g1*25.4@3-3",
        "axes=force-columns:y,x,z",
        "axes=translation-columns:y,x,z",
        "axes=rotation-columns:x,z,y",
        "axes=pose-position-columns:y,x,z",
        "unit=da*0.85",
        "zero-error=da:5",
        "zero-error=ball_x:-2.5",
        "measured-pose=-alpha",
        "measured-pose=-positions@2-90",
        "measured-pose=angles*57.29578",
        "measured-pose=positions:y,x,z@5-9",
        "measured-pose=left-handed",
        "measured-pose=moving-x-y-z",
        "commanded-pose=inverse",
        "commanded-pose=angles:-x,-y,z",
    ];
    for text in all {
        let change: Change = text.parse().unwrap();
        assert_eq!(change.to_string(), text);
    }
    for (kind, _) in KINDS {
        assert!(all.iter().any(|text| text.starts_with(&format!("{kind}="))), "{kind}");
        // Any word may be the name of a sensor.
        let value = if kind == "sensor-sign" { "" } else { "nonsense" };
        let error = format!("{kind}={value}").parse::<Change>().unwrap_err();
        assert!(error.to_string().contains(kind), "{error}");
    }
    assert!("nonsense".parse::<Change>().is_err() && "unit=loads*-1".parse::<Change>().is_err());
}

#[test]
fn words_of_findings_are_those_of_the_files() {
    for (kind, _) in MISTAKES {
        assert_eq!(serde_json::to_string(&kind).unwrap(), format!("\"{}\"", kind.word()));
    }
    assert_eq!(Target::Readings.word(), "readings");
    assert_eq!(AngleOrder::Zyx.word(), "moving-x-y-z");
}

#[test]
fn a_weight_that_nobody_wrote_down_is_missing_beside_a_preload_that_somebody_did() {
    let (hexapod, mut data, _) = cases::case("mujoco-clean");
    assert!(data.columns.reference);
    each(&mut data, |o| o.wrench.force.z += 90.0);
    let d = told(&hexapod, &data);
    assert_eq!(d.verdict, Verdict::Measurement, "{:?}", d.findings);
    let kinds: Vec<_> = d.findings.iter().map(|f| f.kind).collect();
    assert_eq!(kinds, [FindingKind::ReferenceMissing], "{:?}", d.findings);
    let Change::Preload(load) = read_as(&d) else { panic!("{:?}", d.findings) };
    assert!((load.force.z - 90.0).abs() < 3.0, "{load:?}");
}

#[test]
fn a_load_far_beside_the_origin_is_an_effect_in_few_readings_too() {
    let (hexapod, mut data, _) = cases::case("mujoco-clean");
    let offset = Vector3::new(0.13, 0.09, 0.0);
    each(&mut data, |o| {
        let arm = o.pose.rotation() * offset;
        for w in [&mut o.wrench, &mut o.reference] {
            w.moment -= arm.cross(&w.force);
        }
    });
    let poses: Vec<Pose> = data.observations.iter().map(|o| o.pose).collect();
    data.observations.retain(|o| o.pose == poses[0] || o.pose == poses[poses.len() - 1]);
    let d = told(&hexapod, &data);
    assert!(d.findings.is_empty(), "{:?}", d.findings);
    assert_eq!(d.added, ["load-offset"], "{:?}", d.candidates.first().map(|c| c.term.clone()));
}
