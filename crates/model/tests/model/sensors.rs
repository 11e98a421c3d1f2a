//! Campaigns read with gauges, points, levels and scales, made by an independent world of finite deflections.

use hexbench_core::{
    Channel, Dataset, Hexapod, Measurand, Observation, Pose, PoseFunction, Sensor, SensorInput, SensorKind,
    UNREAD, Vector3, Vector6,
};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::{Fit, fit_baseline};
use hexbench_model::estimation::linearization::{Linearization, ModelPoint};
use hexbench_model::inference::misread::{Readable, names, other_readings};
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::check::check;
use hexbench_model::results::compare::legs::leg_space;
use hexbench_model::results::diagnose::diagnose;
use hexbench_model::terms::catalogue;

use crate::common::plan::{dataset, rich_plan};
use crate::common::random::Random;
use crate::common::world::World;
use crate::common::{PAPER_STIFFNESS, measured_machine, paper_machine};

/// Noise so small that nothing but the error of the model is left.
const NO_NOISE_M: f64 = 1e-12;
/// Of a gauge.
pub(crate) const GAUGE_M: f64 = 0.2e-6;

pub(crate) fn ring_point(degrees: f64) -> Vector3 {
    let (s, c) = degrees.to_radians().sin_cos();
    Vector3::new(0.15 * c, 0.15 * s, 0.04)
}

pub(crate) fn gauges(sigma: f64) -> Vec<Sensor> {
    let one = |(k, degrees): (usize, f64)| {
        let (s, c) = degrees.to_radians().sin_cos();
        let direction = if k % 2 == 0 { Vector3::z() } else { Vector3::new(-s, c, 0.0) };
        Sensor::new(format!("g{k}"), SensorKind::Distance { point: ring_point(degrees), direction, sigma })
    };
    [0.0, 60.0, 120.0, 180.0, 240.0, 300.0].into_iter().enumerate().map(one).collect()
}

pub(crate) fn balls(sigma: f64) -> Vec<Sensor> {
    let one = |k: u8| {
        let point = ring_point(20.0 + 120.0 * f64::from(k));
        Sensor::new(format!("ball{k}"), SensorKind::Point { point, sigma: [sigma; 3] })
    };
    (0..3).map(one).collect()
}

pub(crate) fn scales(sigma: f64) -> Vec<Sensor> {
    (0..6).map(|leg| Sensor::new(format!("scale{leg}"), SensorKind::LegLength { leg, sigma })).collect()
}

/// The readings of all sensors, with noise, in blocks of six.
pub(crate) fn read(world: &World, hexapod: &Hexapod, plan: &[Observation], seed: Option<u64>) -> Dataset {
    let channels = Channel::all([], &hexapod.sensors);
    let mut random = Random::new(seed.unwrap_or(1));
    let mut data = dataset(Measurand::DeflectionRotationVector, Vec::new());
    for (line, o) in (2..).zip(plan) {
        let [before, after] = [&o.reference, &o.wrench].map(|wrench| world.rest(&o.pose, wrench));
        let numbers: Vec<f64> = hexapod
            .sensors
            .iter()
            .flat_map(|s| {
                let shift = |p: &Vector3| {
                    (after * nalgebra::Point3::from(*p)) - (before * nalgebra::Point3::from(*p))
                };
                match &s.kind {
                    SensorKind::Distance { point, direction, .. } => vec![direction.dot(&shift(point))],
                    SensorKind::Point { point, .. } => shift(point).iter().copied().collect(),
                    SensorKind::Inclination { axis, .. } => {
                        vec![axis.dot(&(after.rotation * before.rotation.inverse()).scaled_axis())]
                    }
                    SensorKind::LegLength { leg, .. } => {
                        let end = nalgebra::Point3::from(hexapod.platform_joints[*leg]);
                        let length = |place: &nalgebra::Isometry3<f64>| {
                            ((place * end).coords - hexapod.base_joints[*leg]).norm()
                        };
                        vec![length(&after) - length(&before)]
                    }
                    SensorKind::Function { .. } => unreachable!("this world knows no pose"),
                }
            })
            .collect();
        for (block, part) in channels.chunks(6).enumerate() {
            let (mut measured, mut sigma) = ([0.0; 6], [UNREAD; 6]);
            for (k, channel) in part.iter().enumerate() {
                let Channel::Sensor { sensor, number } = *channel else { continue };
                sigma[k] = hexapod.sensors[sensor].kind.sigma(number);
                let error = if seed.is_some() { random.normal() * sigma[k] } else { 0.0 };
                measured[k] = numbers[6 * block + k] + error;
            }
            data.observations.push(Observation { line, block, measured, sigma: Some(sigma), ..*o });
        }
    }
    data.blocks = Channel::in_blocks(&channels);
    data.columns.sigma = true;
    data
}

pub(crate) fn with(sensors: Vec<Sensor>) -> Hexapod {
    Hexapod { sensors, ..paper_machine() }
}

fn springs(hexapod: &Hexapod, data: &Dataset) -> Fit {
    fit_baseline(&Campaign::new(hexapod, data).unwrap()).unwrap()
}

fn worst_error(fit: &Fit) -> f64 {
    let errors = (0..6).map(|leg| (fit.point.compliances[leg] * PAPER_STIFFNESS[leg] - 1.0).abs());
    errors.fold(0.0, f64::max)
}

#[test]
fn what_gauges_balls_and_scales_read_gives_the_springs_to_second_order() {
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    for sensors in [gauges(NO_NOISE_M), balls(NO_NOISE_M), scales(NO_NOISE_M)] {
        let hexapod = with(sensors);
        let error = |load: f64| {
            worst_error(&springs(&hexapod, &read(&world, &hexapod, &rich_plan(12, load, 5), None)))
        };
        let [usual, fourfold] = [error(1.0), error(4.0)];
        let name = &hexapod.sensors[0].name;
        assert!(usual < 2e-6, "{name}: {usual:e}");
        // Of second order in the load, where a model linear in the deflection has fourfold; the larger motion is computed halfway too.
        assert!(fourfold < 3e-5 && fourfold > 6.0 * usual, "{name}: {usual:e} {fourfold:e}");
    }
}

#[test]
fn the_same_six_numbers_are_the_same_campaign_whatever_reads_them() {
    let (sigma_m, sigma_rad) = (0.5e-6, 3e-6);
    let pose = measured_machine(sigma_m, sigma_rad);
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let mut poses = world.measure(Measurand::DeflectionRotationVector, &rich_plan(30, 1.0, 7));
    let mut random = Random::new(3);
    for o in &mut poses.observations {
        let noise = Vector6::from_fn(|k, _| random.normal() * if k < 3 { sigma_m } else { sigma_rad });
        o.measured = std::array::from_fn(|k| o.measured[k] + noise[k]);
    }
    let level = |k: usize| {
        Sensor::new(
            format!("level{k}"),
            SensorKind::Inclination { axis: Vector3::ith(k, 1.0), sigma: sigma_rad },
        )
    };
    let levels = Hexapod { sensors: (0..3).map(level).collect(), ..pose.clone() };
    let mut read = poses.clone();
    let sensor = |sensor| Channel::Sensor { sensor, number: 0 };
    read.blocks =
        vec![[Channel::Pose(0), Channel::Pose(1), Channel::Pose(2), sensor(0), sensor(1), sensor(2)]];
    read.columns.sigma = true;
    for o in &mut read.observations {
        o.sigma = Some([sigma_m, sigma_m, sigma_m, sigma_rad, sigma_rad, sigma_rad]);
    }
    let [as_pose, as_levels] = [springs(&pose, &poses), springs(&levels, &read)];
    for leg in 0..6 {
        let (a, b) = (&as_pose, &as_levels);
        let apart = (a.point.compliances[leg] - b.point.compliances[leg]).abs() / a.std(leg);
        assert!(apart < 1e-2, "leg {leg}: {apart:e} standard deviations");
        assert!((a.std(leg) / b.std(leg) - 1.0).abs() < 1e-3, "leg {leg}");
    }
    assert!((as_pose.dof - as_levels.dof).abs() < 1e-6);
}

#[test]
fn cells_left_empty_widen_the_intervals_and_are_not_counted() {
    let hexapod = with(gauges(GAUGE_M));
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let whole = read(&world, &hexapod, &rich_plan(60, 1.0, 11), Some(4));
    let mut random = Random::new(9);
    let mut holes = whole.clone();
    let mut empty = 0;
    for o in &mut holes.observations {
        for k in 0..6 {
            if random.unit() < 0.2 {
                o.measured[k] = 0.0;
                o.sigma.as_mut().unwrap()[k] = UNREAD;
                empty += 1;
            }
        }
    }
    let [all, some] = [springs(&hexapod, &whole), springs(&hexapod, &holes)];
    assert!((all.dof - some.dof - f64::from(empty)).abs() < 1e-6);
    let wider = (0..6).map(|leg| some.std(leg) / all.std(leg)).sum::<f64>() / 6.0;
    // A fifth of the numbers less: intervals wider by 1 / sqrt(0.8) on the average.
    assert!((wider - 0.8_f64.sqrt().recip()).abs() < 0.06, "{wider}");
    assert!(
        (0..6)
            .all(|leg| (some.point.compliances[leg] - PAPER_STIFFNESS[leg].recip()).abs()
                < 4.5 * some.std(leg))
    );
}

#[test]
fn one_gauge_determines_what_it_can_and_no_more() {
    let hexapod = with(gauges(GAUGE_M).into_iter().take(1).collect());
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let flat: Vec<Observation> = rich_plan(1, 1.0, 11).into_iter().cycle().take(8).collect();
    let data = read(&world, &hexapod, &flat, Some(4));
    let answer = diagnose(&hexapod, &data, None, &catalogue()).unwrap().diagnosis;
    assert!(answer.parameters.is_empty(), "one number cannot give a stiffness: {:?}", answer.parameters);
    assert_ne!(answer.verdict, Verdict::Named);
}

#[test]
fn a_gauge_with_the_wrong_sign_or_factor_is_a_misread_file_and_a_sound_one_is_not() {
    let hexapod = with(gauges(GAUGE_M));
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let sound = read(&world, &hexapod, &rich_plan(60, 1.0, 11), Some(4));
    let said = |data: &Dataset| diagnose(&hexapod, data, None, &catalogue()).unwrap().diagnosis;
    let answer = said(&sound);
    assert_eq!((answer.verdict, answer.findings.len()), (Verdict::Adequate, 0), "{:?}", answer.findings);
    for (factor, off, kind) in [
        (-1.0, 0.0, "sensor-sign"),
        (25.4, 0.0, "sensor-factor"),
        (1.2, 0.0, "sensor-factor"),
        (1.0, 8e-6, "zero-error"),
    ] {
        let mut wrong = sound.clone();
        wrong.observations.iter_mut().for_each(|o| o.measured[2] = o.measured[2] * factor + off);
        let answer = said(&wrong);
        assert_eq!(answer.verdict, Verdict::Measurement);
        assert_eq!(answer.findings[0].kind.word(), kind);
        assert!(
            answer.findings[0].text.contains("g2") && answer.added.is_empty(),
            "{}",
            answer.findings[0].text
        );
    }
}

#[test]
fn a_gauge_beside_its_place_is_told_with_its_size_and_the_machine_is_judged_all_the_same() {
    let truth = with(gauges(GAUGE_M));
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let data = read(&world, &truth, &rich_plan(60, 1.0, 11), Some(4));
    let mut stated = truth.clone();
    let SensorKind::Distance { point, .. } = &mut stated.sensors[0].kind else { panic!("a gauge") };
    point.x += 0.01;
    let answer = diagnose(&stated, &data, None, &catalogue()).unwrap().diagnosis;
    let finding = &answer.findings[0];
    assert_eq!(finding.kind.word(), "sensor-place");
    assert!(finding.text.contains("g0"), "{}", finding.text);
    let mm: f64 = finding.size.trim_end_matches(" mm").parse().unwrap();
    assert!((mm - 10.0).abs() < 3.0, "{}", finding.size);
    assert!(answer.added.is_empty());
    for leg in 0..6 {
        let k = answer.parameters.iter().find(|p| p.name == format!("leg-{}.stiffness", leg + 1)).unwrap();
        assert!(
            (k.value - PAPER_STIFFNESS[leg] * 1e-6).abs() < 4.5 * k.std,
            "{}: {} +- {}",
            k.name,
            k.value,
            k.std
        );
    }
}

#[test]
fn a_gauge_that_shows_too_much_is_told_with_its_gain_and_the_machine_is_judged_all_the_same() {
    let stated = with(gauges(GAUGE_M));
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    for (sensor, gain) in [(0, 1.04), (3, 0.97)] {
        let mut data = read(&world, &stated, &rich_plan(60, 1.0, 11), Some(4));
        data.observations.iter_mut().for_each(|row| row.measured[sensor] *= gain);
        let answer = diagnose(&stated, &data, None, &catalogue()).unwrap().diagnosis;
        let finding = &answer.findings[0];
        assert_eq!(finding.kind.word(), "sensor-gain", "{}", finding.text);
        assert!(finding.text.contains(&format!("g{sensor}")), "{}", finding.text);
        let percent: f64 = finding.size.trim_end_matches(" %").parse().unwrap();
        assert!((percent - 100.0 * (gain - 1.0)).abs() < 1.0, "{}", finding.size);
        assert!(answer.added.is_empty());
        for (leg, wanted) in PAPER_STIFFNESS.iter().enumerate() {
            let name = format!("leg-{}.stiffness", leg + 1);
            let k = answer.parameters.iter().find(|p| p.name == name).unwrap();
            assert!((k.value - wanted * 1e-6).abs() < 4.5 * k.std, "{name}: {} +- {}", k.value, k.std);
        }
    }
}

/// Three translations, two gauges and a ball: eight numbers, which make two blocks.
type Row = [f64; 8];

/// A mistake of the measured numbers, row by row, and the kinds that call it by its name.
type Mistake = (fn(&mut Row), &'static [&'static str]);

const MISTAKES: [Mistake; 11] = [
    (|row| row[1] = -row[1], &["deflection-sign"]),
    (|row| row[..3].iter_mut().for_each(|x| *x = -*x), &["deflection-sign", "axes"]),
    (|row| row[2] *= 1e-3, &["unit"]),
    (|row| row[0] *= 1e3, &["unit"]),
    (|row| row[..3].iter_mut().for_each(|x| *x /= 25.4), &["unit"]),
    (|row| row.swap(0, 1), &["axes"]),
    (|row| row[4] = -row[4], &["sensor-sign"]),
    (|row| row[3..5].iter_mut().for_each(|x| *x /= 25.4), &["sensor-factor"]),
    (|row| row.swap(3, 4), &["sensors-exchanged"]),
    (|row| row[7] = -row[7], &["sensor-sign", "axes"]),
    (|row| (row[5], row[6]) = (row[6], -row[5]), &["axes"]),
];

/// The two gauges and the ball.
fn gauges_and_a_ball() -> Hexapod {
    with(gauges(GAUGE_M).into_iter().take(2).chain(balls(GAUGE_M).into_iter().take(1)).collect())
}

/// They, and the translations: what a point at the mobile origin reads.
fn beside_translations(world: &World, plan: &[Observation]) -> (Hexapod, Dataset) {
    let hexapod = gauges_and_a_ball();
    let origin = SensorKind::Point { point: Vector3::zeros(), sigma: [GAUGE_M; 3] };
    let mut more = hexapod.clone();
    more.sensors.insert(0, Sensor::new("origin", origin));
    let mut data = read(world, &more, plan, Some(4));
    for channel in data.blocks.iter_mut().flatten() {
        *channel = match *channel {
            Channel::Sensor { sensor: 0, number } => Channel::Pose(number),
            Channel::Sensor { sensor, number } => Channel::Sensor { sensor: sensor - 1, number },
            other => other,
        };
    }
    (hexapod, data)
}

fn table(data: &Dataset) -> Vec<Row> {
    let rows = data.observations.chunks(2);
    rows.map(|row| std::array::from_fn(|k| row[k / 6].measured[k % 6])).collect()
}

fn written(data: &Dataset, table: &[Row]) -> Dataset {
    let mut data = data.clone();
    for (row, numbers) in data.observations.chunks_mut(2).zip(table) {
        (0..8).for_each(|k| row[k / 6].measured[k % 6] = numbers[k]);
    }
    data
}

#[test]
fn mistakes_in_files_of_some_pose_numbers_and_sensors_are_found_with_their_cause() {
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let (hexapod, sound) = beside_translations(&world, &rich_plan(40, 1.0, 11));
    let told = |data: &Dataset, kinds: &[&str]| {
        let answer = diagnose(&hexapod, data, None, &catalogue()).unwrap().diagnosis;
        assert_eq!(answer.verdict, Verdict::Measurement, "{kinds:?}: {:?}", answer.findings);
        let first = &answer.findings[0];
        assert!(answer.added.is_empty() && kinds.contains(&first.kind.word()), "{kinds:?}: {}", first.text);
        assert!(first.next.contains("--read-as"), "{}", first.next);
    };
    let answer = diagnose(&hexapod, &sound, None, &catalogue()).unwrap().diagnosis;
    assert_eq!((answer.verdict, answer.findings.len()), (Verdict::Adequate, 0), "{:?}", answer.findings);
    for (spoil, kinds) in MISTAKES {
        let mut rows = table(&sound);
        rows.iter_mut().for_each(spoil);
        told(&written(&sound, &rows), kinds);
    }
    let mut rows = table(&sound);
    rows.rotate_left(1);
    told(&written(&sound, &rows), &["row-order"]);
    let mut loads = sound.clone();
    loads.observations.iter_mut().for_each(|o| o.wrench.force.z *= -1.0);
    loads.observations.iter_mut().for_each(|o| o.reference.force.z *= -1.0);
    told(&loads, &["wrench-sign"]);
}

#[test]
fn two_mistakes_of_different_sensors_are_found_together() {
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let (hexapod, sound) = beside_translations(&world, &rich_plan(40, 1.0, 11));
    let mut rows = table(&sound);
    for row in &mut rows {
        (row[3], row[4]) = (-row[3], row[4] / 25.4);
    }
    let answer = diagnose(&hexapod, &written(&sound, &rows), None, &catalogue()).unwrap().diagnosis;
    assert_eq!(answer.verdict, Verdict::Measurement, "{:?}", answer.findings);
    let text = &answer.findings[0].text;
    assert!(text.contains("sensor g0 seems to read with the other sign"), "{text}");
    assert!(text.contains("sensor g1 seem to be in 25.4 times"), "{text}");
}

#[test]
fn a_gauge_that_looks_far_aside_is_found_and_no_effect_is_named_for_what_a_turn_is_not_linear_in() {
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let plan = || rich_plan(40, 1.0, 11);
    for degrees in [8.0_f64, 15.0] {
        let stated = with(gauges(GAUGE_M));
        let mut stands = stated.clone();
        let turn = Vector3::new(0.6, 0.8, 0.0).scale(degrees.to_radians());
        stands.sensors[2].put_off(SensorInput::Direction, turn.as_slice());
        let data = read(&world, &stands, &plan(), Some(4));
        let held_out = read(&world, &stands, &rich_plan(12, 1.0, 12), Some(5));
        let d = diagnose(&stated, &data, Some(&held_out), &catalogue()).unwrap().diagnosis;
        assert_eq!((d.verdict, d.added.len()), (Verdict::Measurement, 0), "{degrees}: {:?}", d.findings);
        let [found] = &d.findings[..] else { panic!("{degrees}: {:?}", d.findings) };
        assert!(found.text.starts_with("sensor g2 seems to measure in another direction"), "{}", found.text);
        let size: f64 = found.size.split(' ').next().unwrap().parse().unwrap();
        assert!((size / degrees - 1.0).abs() < 0.2, "{degrees}: {size}");
        let last = d.steps.last().unwrap();
        assert!(last.is_at_the_noise(), "{degrees}: {:?}", last.holdout);
    }
}

#[test]
fn a_gauge_that_stops_reading_is_found_with_its_lines() {
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let hexapod = with(gauges(GAUGE_M));
    let mut data = read(&world, &hexapod, &rich_plan(60, 1.0, 11), Some(4));
    for o in data.observations.iter_mut().skip(45) {
        o.measured[1] = 12.5e-6;
    }
    let d = diagnose(&hexapod, &data, None, &catalogue()).unwrap().diagnosis;
    let [found] = &d.findings[..] else { panic!("{:?}", d.findings) };
    assert_eq!((d.verdict, found.kind.word()), (Verdict::Measurement, "idle-column"));
    let lines = "g1_um is the same number in 15 rows in succession, lines 47 to 61";
    assert!(found.text.starts_with(lines), "{}", found.text);
}

#[test]
fn a_number_that_no_repeat_has_is_not_counted_where_repeats_are_averaged() {
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let plan: Vec<Observation> = rich_plan(40, 1.0, 11).into_iter().flat_map(|o| [o, o]).collect();
    let mut hexapod = with(gauges(GAUGE_M).into_iter().take(3).collect());
    (hexapod.tolerances.sensor_point, hexapod.tolerances.sensor_direction) = (1e-9, 1e-9);
    hexapod.tolerances.sensor_gain = 1e-9;
    let mut data = read(&world, &hexapod, &plan, Some(4));
    data.observations.iter_mut().for_each(|o| o.measured[1] *= 1e3);
    let readings = other_readings(&hexapod, &data, Readable::Everything).unwrap();
    let best = &readings.ways[0];
    assert_eq!(names(&best.changes), ["sensor-factor=g1*0.001"]);
    // Three numbers a condition make 120 - 6 degrees of freedom: within four standard deviations of one, 4 / sqrt(2 * 114).
    assert!((best.level - 1.0).abs() < 0.27, "{}", best.level);
}

#[test]
fn a_drift_of_a_gauge_is_found_with_empty_cells_and_more_than_six_numbers() {
    let hexapod = with(gauges(GAUGE_M).into_iter().chain(balls(GAUGE_M).into_iter().take(1)).collect());
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let mut data = read(&world, &hexapod, &rich_plan(60, 1.0, 11), Some(4));
    let mut random = Random::new(9);
    let (mut drift, correlation) = ([[0.0; 6]; 2], 0.95_f64);
    for o in &mut data.observations {
        for k in 0..6 {
            let at = &mut drift[o.block][k];
            *at = correlation * *at + (1.0 - correlation.powi(2)).sqrt() * random.normal() * 1.5 * GAUGE_M;
            if !o.is_read(k) {
                continue;
            }
            o.measured[k] += *at;
            if random.unit() < 0.1 {
                (o.measured[k], o.sigma.as_mut().unwrap()[k]) = (0.0, UNREAD);
            }
        }
    }
    let answer = diagnose(&hexapod, &data, None, &catalogue()).unwrap().diagnosis;
    let kinds: Vec<&str> = answer.findings.iter().map(|f| f.kind.word()).collect();
    assert_eq!(kinds, ["drift"], "{:?}", answer.findings);
    assert!(answer.added.is_empty(), "{:?}", answer.added);
}

#[test]
fn a_check_of_gauges_and_a_ball_speaks_of_lengths_alone_and_finds_nothing_odd() {
    let plan: Vec<Observation> = rich_plan(40, 1.0, 11).into_iter().flat_map(|o| [o, o]).collect();
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let (hexapod, mut data) = beside_translations(&world, &plan);
    let of = |data: &Dataset| check(&hexapod, Some(data), None, &catalogue(), &[]).unwrap();
    let sound = of(&data);
    assert!(sound.ready && sound.remarks.is_empty(), "{:?}", sound.remarks);
    let read = sound.measurements.unwrap();
    assert!(read.translation_rms_um.is_some() && read.rotation_rms_urad.is_none() && read.repeats.is_none());
    // 320 numbers in pairs: within four standard deviations, 4 / sqrt(2 * 320).
    assert!((read.repeats_over_noise.unwrap() - 1.0).abs() < 0.16);
    data.observations.iter_mut().for_each(|o| o.sigma = o.sigma.map(|s| s.map(|x| 2.0 * x)));
    assert!(of(&data).remarks[0].contains("repeats scatter by 0."), "{:?}", of(&data).remarks);
}

/// A function of the pose for a gauge or a scale, as somebody else would write it.
fn as_function(hexapod: &Hexapod, sensor: &Sensor) -> Sensor {
    let at = |pose: &Pose, point: Vector3| pose.rotation() * point + pose.translation;
    let of = match sensor.kind {
        SensorKind::Distance { point, direction, .. } => {
            PoseFunction::new(move |pose| direction.dot(&at(pose, point)))
        }
        SensorKind::LegLength { leg, .. } => {
            let (foot, head) = (hexapod.base_joints[leg], hexapod.platform_joints[leg]);
            PoseFunction::new(move |pose| (at(pose, head) - foot).norm())
        }
        _ => unreachable!("a gauge or a scale"),
    };
    let kind = SensorKind::Function { of, is_angle: false, sigma: sensor.kind.sigma(0) };
    Sensor::new(sensor.name.clone(), kind)
}

#[test]
fn functions_of_the_pose_read_as_the_gauges_and_scales_that_they_copy() {
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let plan = rich_plan(25, 1.0, 4);
    for sensors in [gauges(NO_NOISE_M), scales(NO_NOISE_M)] {
        let built_in = with(sensors);
        let copies = built_in.sensors.iter().map(|s| as_function(&built_in, s)).collect();
        let data = read(&world, &built_in, &plan, None);
        let [expected, copied] = [&built_in, &with(copies)].map(|hexapod| springs(hexapod, &data));
        // Differences of lengths of a meter over steps of 3e-5 m: 1e-9.
        let apart = (copied.point.compliances - expected.point.compliances)
            .component_div(&expected.point.compliances)
            .amax();
        assert!(apart < 1e-8, "{apart:e}");
        assert!(worst_error(&copied) < 1.01 * worst_error(&expected) + 1e-8);
    }
}

#[test]
fn a_point_with_another_sign_or_two_coordinates_exchanged_is_named_with_where_it_is() {
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let meant = with(gauges(GAUGE_M).into_iter().take(4).chain(balls(GAUGE_M).into_iter().take(1)).collect());
    let data = read(&world, &meant, &rich_plan(25, 1.0, 4), Some(4));
    let mirrored = |p: &mut Vector3| p.x = -p.x;
    let exchanged = |p: &mut Vector3| p.swap_rows(0, 1);
    for sensor in [1, 4] {
        for slip in [&mirrored as &dyn Fn(&mut Vector3), &exchanged] {
            let mut written = meant.clone();
            let (SensorKind::Distance { point, .. } | SensorKind::Point { point, .. }) =
                &mut written.sensors[sensor].kind
            else {
                unreachable!("both look at points")
            };
            slip(point);
            let off = (meant.sensors[sensor].kind.point().unwrap() - *point) * 1e3;
            let readings = other_readings(&written, &data, Readable::Everything).unwrap();
            let best = &readings.ways[0];
            let name = &meant.sensors[sensor].name;
            let expected = format!("sensor-place={name}:");
            let found = names(&best.changes);
            assert!(found.len() == 1 && found[0].starts_with(&expected), "{found:?} for {name} off by {off}");
            assert!(best.level < 1.1, "{}", best.level);
        }
    }
}

#[test]
fn a_gauge_and_a_load_with_the_other_sign_are_named_together() {
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let hexapod = with(gauges(GAUGE_M));
    let mut data = read(&world, &hexapod, &rich_plan(25, 1.0, 4), Some(4));
    for o in &mut data.observations {
        o.measured[1] = -o.measured[1];
        (o.wrench.force.z, o.reference.force.z) = (-o.wrench.force.z, -o.reference.force.z);
    }
    let readings = other_readings(&hexapod, &data, Readable::Everything).unwrap();
    let found: Vec<_> = readings.ways.iter().map(|way| (names(&way.changes), way.level)).collect();
    assert!(found[0].1 < 1.1 && found[0].0.len() == 2, "{found:?}");
}

#[test]
fn legs_are_told_by_six_gauges_and_by_three_balls_as_by_poses_and_not_by_one_ball() {
    let softer = PAPER_STIFFNESS.map(|k| 0.9 * k);
    let world = World::on_springs(&paper_machine(), softer);
    let plan = rich_plan(6, 1.0, 11);
    // Springs 10 % stiffer than those of the world leave the same of every leg, whatever reads it.
    let left = |hexapod: &Hexapod, data: &Dataset| {
        let campaign = Campaign::new(hexapod, data).unwrap();
        let mut point = ModelPoint::start(&campaign);
        point.compliances = Vector6::from_fn(|leg, _| 1.0 / PAPER_STIFFNESS[leg]);
        let space = leg_space(&campaign, &Linearization::at(&campaign, &point).unwrap());
        let told: Vec<Vector6> = space.determined().iter().map(|&i| space.elongation[i]).collect();
        (told, space.is_complete())
    };
    let pose = measured_machine(1e-6, 6e-6);
    let (by_pose, _) = left(&pose, &world.measure(Measurand::DeflectionRotationVector, &plan));
    let largest = by_pose.iter().map(Vector6::amax).fold(0.0, f64::max);
    for sensors in [gauges(GAUGE_M), balls(GAUGE_M)] {
        let hexapod = with(sensors);
        let (told, is_complete) = left(&hexapod, &read(&world, &hexapod, &plan, None));
        assert!(is_complete && told.len() == by_pose.len(), "{}", hexapod.sensors[0].name);
        let apart = told.iter().zip(&by_pose).map(|(a, b)| (a - b).amax()).fold(0.0, f64::max);
        assert!(apart < 1e-3 * largest, "{}: {apart:e} of {largest:e}", hexapod.sensors[0].name);
    }
    let one = with(balls(GAUGE_M)[..1].to_vec());
    let (told, is_complete) = left(&one, &read(&world, &one, &plan, None));
    assert!(told.is_empty() && !is_complete);
}
