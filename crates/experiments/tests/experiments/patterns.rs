//! Patterns that no term of the catalogue has: simulated, then told as what they are, and as no effect of the catalogue.

use hexbench_core::{Matrix3, Pose, Vector3};
use hexbench_model::inference::verdict::Verdict;
use hexbench_truth::mechanisms::build;
use hexbench_truth::setup::Bracket;
use hexbench_truth::{Instant, Mechanism, Setup};
use serde_json::{Map, Value, json};

use crate::histories::history;

/// Of every effect beside what springs absorb, standard deviations of all readings together.
const DISTANCE: f64 = 40.0;
/// The leg that comes loose.
const LOOSE: usize = 3;
/// The same of a softer leg, which its spring absorbs but for a small part.
const NEAR: f64 = 4.0;
/// Lines by which the place of a change may be missed: those of one pose.
const LINES: u64 = 12;

/// The stand of the instrument moves by so much per kelvin: a, b, c (m), alpha, beta, gamma (rad).
#[derive(Debug, Clone)]
struct WarmStand([f64; 6]);

impl Mechanism for WarmStand {
    fn id(&self) -> &'static str {
        "out:warm-stand"
    }

    fn read(&self, moment: &Instant<'_>, pose: &mut Pose) {
        let read = pose.to_array();
        *pose = Pose::from_array(std::array::from_fn(|k| read[k] + self.0[k] * moment.delta_t()));
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self(self.0.map(|x| x * factor)))
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::new()
    }
}

/// The force of the next leg moves the base joint of a leg along it, m/N.
#[derive(Debug, Clone)]
struct NextLeg(f64);

impl Mechanism for NextLeg {
    fn id(&self) -> &'static str {
        "out:next-leg"
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        let rotation = moment.situation.pose.rotation();
        let along = |leg: usize| -> Vector3 {
            let joint = rotation * setup.platform_joints[leg] + moment.situation.pose.translation;
            (joint - setup.base_joints[leg]).normalize()
        };
        let bracket = |leg: usize| {
            let next = (leg + 1) % 6;
            let compliance: Matrix3 = self.0 * along(leg) * along(next).transpose();
            Bracket { displaced: leg, pulled: next, compliance }
        };
        let brackets: Vec<Bracket> = (0..6).map(bracket).collect();
        setup.brackets.extend(brackets);
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self(self.0 * factor))
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::new()
    }
}

/// A base joint yields by so much more along z, m/N, which makes its leg softer.
#[derive(Debug, Clone)]
struct SoftLeg(f64);

impl Mechanism for SoftLeg {
    fn id(&self) -> &'static str {
        "out:soft-leg"
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        let compliance = self.0 * Vector3::z() * Vector3::z().transpose();
        setup.brackets.push(Bracket { displaced: LOOSE, pulled: LOOSE, compliance });
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self(self.0 * factor))
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::new()
    }
}

/// The compliance of all legs grows with the tilt.
fn tilted() -> Box<dyn Mechanism> {
    build("out:formula", json!({ "elongation": "size*f*sqrt(alpha^2 + beta^2)", "size": 1e-7 })).unwrap()
}

#[test]
fn a_stand_that_grows_warm_a_leg_that_feels_the_next_and_joints_that_yield_by_tilt_are_told_as_such() {
    type Effect = fn() -> Box<dyn Mechanism>;
    // In proportion or with the square: springs take up what tells them apart.
    let table: [(&[&str], &str, Effect); 3] = [
        (&["moving-frame"], "delta_T_K", || Box::new(WarmStand([1e-6, 5e-7, -8e-7, 2e-6, -3e-6, 1e-6]))),
        (&["other-leg"], "leg_force", || Box::new(NextLeg(1e-9))),
        (&["linear", "quadratic"], "tilt", tilted),
    ];
    for (patterns, variable, effect) in table {
        for seed in 0..4 {
            let d = history(Some(effect()), DISTANCE, seed, |_| {}).diagnosis();
            assert_eq!(d.verdict, Verdict::Outside, "{patterns:?} {seed}: {:?}", d.candidates);
            let outside = d.outside.unwrap();
            assert_eq!(outside.variable, Some(variable), "{seed}: {}", outside.text);
            assert!(outside.pattern.is_some_and(|p| patterns.contains(&p)), "{seed}: {}", outside.text);
        }
    }
}

/// Every leg by its own size: here alike, but for the sign.
fn alternating(follows: &str) -> Box<dyn Mechanism> {
    build("out:formula", json!({ "elongation": format!("size*{follows}*cos(pi*leg)"), "size": 1e-7 }))
        .unwrap()
}

#[test]
fn what_every_leg_follows_by_its_own_size_is_no_noise_of_the_loads_and_no_wrong_pose() {
    let table = [("approach*is_loaded", "linear", "approach"), ("delta_T^2", "quadratic", "delta_T_K")];
    for (follows, pattern, variable) in table {
        for seed in 0..3 {
            let d = history(Some(alternating(follows)), DISTANCE, seed, |_| {}).diagnosis();
            assert_eq!(d.verdict, Verdict::Outside, "{follows} {seed}: {:?} {:?}", d.candidates, d.findings);
            let outside = d.outside.unwrap();
            assert_eq!(
                [outside.pattern, outside.variable],
                [Some(pattern), Some(variable)],
                "{seed}: {}",
                outside.text
            );
        }
    }
}

#[test]
fn a_leg_that_comes_loose_within_the_file_is_named_with_the_line() {
    for seed in 0..4 {
        let sound = history(None, DISTANCE, seed, |_| {}).measurements;
        let mut loose = history(Some(Box::new(SoftLeg(1e-9))), NEAR, seed, |_| {});
        let before = loose.measurements.observations.len() / 2;
        loose.measurements.observations[..before].copy_from_slice(&sound.observations[..before]);
        let d = loose.diagnosis();
        assert_eq!(d.verdict, Verdict::Outside, "{seed}: {:?}", d.candidates);
        let outside = d.outside.unwrap();
        assert_eq!(
            (outside.leg, outside.variable),
            (Some(LOOSE + 1), Some("line")),
            "{seed}: {}",
            outside.text
        );
        let after = outside.text.split("line ").nth(1).and_then(|text| text.split(' ').next());
        let line = after.and_then(|number| number.parse::<u64>().ok());
        let changed = loose.measurements.observations[before].line;
        assert!(line.is_some_and(|line| line.abs_diff(changed) <= LINES), "{changed}: {}", outside.text);
    }
}
