//! A small study of sensors: faults are named, clean machines are not accused, ways that tell the same give the same answer.

use hexbench_core::Wrench;
use hexbench_experiments::harness::{self, Protocol, Silent};
use hexbench_experiments::sensors::{
    AlikeProtocol, AlikeStudy, SEED, SensorProtocol, SensorStudy, alike, faults, page, shown, ways,
};
use hexbench_model::estimation::fit::fit_baseline;
use hexbench_model::results::diagnose::prepare;
use hexbench_report::render::markdown;
use hexbench_truth::campaign::{AlikeReadings, CaseKind, SensorFault, SensorSet, SimulatedCase};

/// Largest difference of a stiffness between ways that tell the same, in standard deviations: what is left is noise times the turn of the
/// legs.
const SAME_STD: f64 = 1e-2;

fn study() -> (SensorStudy, AlikeStudy) {
    let protocol = SensorProtocol { seed: SEED, trials: 2 };
    let first = SensorStudy::of(protocol.clone(), harness::run(&protocol, None, &Silent).unwrap());
    let protocol = AlikeProtocol { seed: SEED, campaigns: 3 };
    let second = AlikeStudy::of(protocol.clone(), harness::run(&protocol, None, &Silent).unwrap());
    (first, second)
}

#[test]
fn wrong_sensors_are_named_and_the_same_information_gives_the_same_answer() {
    let (study, same) = study();
    assert!(
        study.failures.is_empty() && same.failures.is_empty(),
        "{:?} {:?}",
        study.failures,
        same.failures
    );
    for fault in [SensorFault::Sign, SensorFault::Factor] {
        let records = study.of_group(fault.word());
        assert_eq!(records.len(), 4);
        assert!(records.iter().all(|r| r.shows_fault() && r.is_named()), "{}: {records:?}", fault.word());
    }
    let sound = || study.records.iter().filter(|r| r.has_sound_sensors());
    assert_eq!(sound().count(), 2 * (SensorSet::ALL.len() - 3));
    assert!(sound().filter(|r| r.of.is_clean()).all(|r| r.of.is_right() && !r.accuses_a_sensor()));
    for record in &same.records {
        for way in 1..3 {
            assert!(record.whole[0].says_the_same(&record.whole[way]), "{record:?}");
            assert!(record.apart(way) < SAME_STD, "{}: {:e}", way, record.apart(way));
            // A fifth of the numbers less tells less, and not half.
            assert!(record.widened(way).iter().all(|w| (1.0..1.6).contains(w)), "{:?}", record.widened(way));
        }
    }
    let text = markdown(&page(&study, &same));
    assert!(SensorFault::ALL.iter().all(|fault| text.contains(fault.word())), "{text}");
    assert_eq!([ways(&study).text(8, 0), faults(&study).text(2, 0)], ["scales", "sensor-place"]);
    assert_eq!(alike(&same).text(2, 0), "six distances");
    assert_eq!(shown(&study, SensorFault::Place).text(0, 0), "to 9");
}

#[test]
fn a_trial_is_found_by_its_name() {
    let protocol = SensorProtocol::default();
    let case = protocol.case("sensor-place/six-gauges-clean-0000").unwrap().unwrap();
    let sound = protocol.case("six-gauges/six-gauges-clean-0000").unwrap().unwrap();
    let first =
        |case: &hexbench_truth::campaign::SimulatedCase| *case.hexapod.sensors[0].kind.point().unwrap();
    assert!(((first(&case) - first(&sound)).norm() - 0.01).abs() < 1e-12);
    assert_eq!(case.measurements.observations, sound.measurements.observations);
    assert!(protocol.case("sensor-place/scales-clean-0000").is_none());
}

#[test]
fn a_gauge_beside_its_place_is_not_taken_for_an_effect_nor_an_effect_for_a_gauge() {
    let protocol = SensorProtocol::default();
    let trial = |name: &str| {
        let job = protocol.jobs().into_iter().find(|job| protocol.name(job) == name);
        protocol.trial(&job.expect(name)).unwrap()
    };
    // A point registered beside the origin explains these readings too, with as many numbers and less probably.
    for index in [13, 17, 25, 45] {
        let record = trial(&format!("sensor-place/three-gauges-clean-{index:04}"));
        assert!(record.is_named() && !record.of.names_falsely(), "{record:?}");
    }
    let record = trial("three-gauges/three-gauges-single-0014");
    assert_eq!(record.of.answer.hidden_words(), "target-offset");
    assert!(record.of.is_right() && !record.accuses_a_sensor(), "{record:?}");
}

#[test]
fn every_trial_of_alike_readings_is_found_by_the_name_of_its_table() {
    let protocol = AlikeProtocol { seed: SEED, campaigns: 5 };
    for job in protocol.jobs() {
        let name = protocol.name(&job);
        let cases = protocol.cases(&name).expect(&name).unwrap();
        let ways: Vec<&str> = cases.iter().map(|(way, _)| way.as_str()).collect();
        assert_eq!(ways[..3], ["a-pose", "three-points", "six-distances"], "{name}");
        assert_eq!(ways[3..], ["a-pose-gaps", "three-points-gaps", "six-distances-gaps"], "{name}");
        let empty = |k: usize| {
            let all = &cases[k].1.measurements.observations;
            all.iter().map(|o| 6 - o.numbers()).sum::<usize>()
        };
        assert!(empty(0) == 0 && empty(2) == 0 && empty(3) > 0 && empty(5) > 0, "{name}");
    }
    assert!(protocol.cases("alike/clean-0004").is_none(), "beyond the last campaign");
}

/// A machine on which the platform moves by half a millimeter and turns by three milliradians under the loads, drawn with [`SEED`].
const SOFT: usize = 142;

/// Largest difference of a leg stiffness from that of the pose, in standard deviations, and of those standard deviations, relative, of the
/// soft machine read as points and as distances, its loads multiplied.
fn apart_under(loads: f64) -> [[f64; 2]; 2] {
    let springs = |way| {
        let mut case = SimulatedCase::draw(CaseKind::Clean, SOFT, SEED, None).unwrap();
        for o in case.measurements.observations.iter_mut().chain(&mut case.holdout.observations) {
            o.wrench = Wrench::default().beyond(&o.wrench, loads);
            o.reference = Wrench::default().beyond(&o.reference, loads);
        }
        case.read_alike(way, false).unwrap();
        let fit = fit_baseline(&prepare(&case.hexapod, &case.measurements).unwrap()).unwrap();
        std::array::from_fn::<_, 6, _>(|leg| (fit.point.compliances[leg], fit.std(leg)))
    };
    let pose = springs(AlikeReadings::Pose);
    [AlikeReadings::Points, AlikeReadings::Distances].map(|way| {
        let other = springs(way);
        let beside = || pose.iter().zip(&other);
        let value = beside().map(|(a, b)| (a.0 - b.0).abs() / a.1).fold(0.0, f64::max);
        let std = beside().map(|(a, b)| (b.1 / a.1 - 1.0).abs()).fold(0.0, f64::max);
        [value, std]
    })
}

#[test]
fn readings_that_tell_the_same_differ_by_the_turn_of_the_legs_alone() {
    /// Turn of the legs under the full loads, and what six springs make of it at most.
    const TURN: f64 = 5e-3;
    const AMPLIFIED: f64 = 10.0;
    let [whole, tenth] = [1.0, 0.1].map(apart_under);
    for (whole, tenth) in whole.iter().zip(&tenth) {
        assert!(whole[0] < AMPLIFIED * TURN && whole[1] < TURN, "{whole:?}");
        assert!(tenth[0] < 0.2 * whole[0] && tenth[1] < 0.2 * whole[1], "{whole:?}, {tenth:?}");
    }
}
