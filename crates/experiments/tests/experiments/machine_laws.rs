//! Eight laws of real machines, the first five written down from mechanics before the grammar of laws was read, then searched for.
//!
//! Each is what a designer would write for one part of a machine: a preloaded bearing, a screw held at both ends, a bowed strut, air
//! conditioning, clamps of a base, grease that thins, a guide that lets go, a screw cut while it grew warm. What came out is said at each. The part of a large file is
//! tested here as well.

use std::f64::consts::TAU;

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Hexapod, Matrix6, Vector3, Wrench};
use hexbench_model::inference::examination::FindingKind;
use hexbench_model::results::diagnose::{DiagnoseOptions, diagnose};
use hexbench_model::results::discover::{Discovery, DiscoveryReason, discover};
use hexbench_model::terms::catalogue;
use hexbench_report::render::plain;
use hexbench_report::words::{LawFiles, discovery};
use hexbench_truth::campaign::{
    PlanKind, Poses, SimulatedCampaign, Yardstick, machines, measure, usual_half_range_mm_deg,
};
use hexbench_truth::mechanisms::PeriodicCompliance;
use hexbench_truth::metrology::{InstrumentFrames, InstrumentNoise};
use hexbench_truth::{Instant, Mechanism, Setup, World};
use serde_json::{Map, Value};

/// How far each law stands beyond what the springs absorb.
const DISTANCE: f64 = 40.0;

/// A law of one part of a machine.
#[derive(Debug, Clone, Copy)]
enum Part {
    /// Bearings preloaded against each other: once the force exceeds the preload one row of balls lifts off, and the other alone is softer.
    /// `e = s sgn(f) max(|f| - preload, 0)`.
    PreloadedBearing { preload_n: f64 },
    /// A screw held at both ends: its compliance is a parabola in the place of the nut, least softened away from the middle.
    /// `e = -s (q - middle)^2 f`.
    ScrewHeldAtBothEnds { middle_from_home_m: f64 },
    /// A slightly bowed strut shortens as its bow grows toward the load under which it buckles.
    /// `e = -s / q (1 / (1 + f / (P (q_home / q)^2))^2 - 1)`, f < 0 in compression. Source: Timoshenko and Gere, Theory of Elastic Stability, 1.12.
    BowedStrut { buckling_n: f64 },
    /// A leg beside a vent follows the cycle of the air conditioning: `e = s sin(2 pi t / period)`.
    AirConditioning { leg: usize, period_s: f64 },
    /// Clamps of the base slip once the lateral force exceeds their friction: the base moves along x by `s sgn(F_x) max(|F_x| - friction, 0)`.
    SlippingClamps { friction_n: f64 },
    /// A second guide holds one screw until it is drawn out by so much; beyond, it yields more. `e = s step(q - q_home - way) f`.
    GuideLetGo { leg: usize, way_m: f64 },
    /// A screw grew warm while it was cut: its lead changes along it, whatever it carries. `e = s (q - q_home)^2`.
    ScrewCutWarm,
    /// Warmth thins the grease of all joints alike, the more the farther they are tilted. `e = s delta_T alpha f`.
    ThinnedGrease,
}

/// A law and its size.
#[derive(Debug, Clone, Copy)]
struct MachineLaw {
    part: Part,
    size: f64,
}

/// Forces of the legs of the nominal machine at the commanded pose, N, tension positive.
fn leg_forces(setup: &Setup) -> [f64; 6] {
    let (r, t) = (setup.pose.rotation(), setup.pose.translation);
    let mut of_units = Matrix6::zeros();
    for leg in 0..6 {
        let arm = r * setup.platform_joints[leg];
        let n = (t + arm - setup.base_joints[leg]).normalize();
        of_units.column_mut(leg).copy_from_slice([n, arm.cross(&n)].map(|v| [v.x, v.y, v.z]).as_flattened());
    }
    of_units.lu().solve(&setup.wrench.to_vector()).map_or([0.0; 6], Into::into)
}

/// What exceeds a limit, with its sign.
fn beyond(value: f64, limit: f64) -> f64 {
    value.signum() * (value.abs() - limit).max(0.0)
}

impl Mechanism for MachineLaw {
    fn id(&self) -> &'static str {
        "out:machine-law"
    }

    fn act(&self, instant: &Instant<'_>, setup: &mut Setup) {
        let (forces, lengths, home) = (leg_forces(setup), instant.nominal_lengths, instant.home_lengths);
        let mut grow = |elongation: &dyn Fn(usize) -> f64| {
            for leg in 0..6 {
                setup.leg_lengths[leg] += self.size * elongation(leg);
            }
        };
        match self.part {
            Part::PreloadedBearing { preload_n } => grow(&|i| beyond(forces[i], preload_n)),
            Part::ScrewHeldAtBothEnds { middle_from_home_m } => {
                grow(&|i| -(lengths[i] - home[i] - middle_from_home_m).powi(2) * forces[i]);
            }
            Part::BowedStrut { buckling_n } => grow(&|i| {
                let load = -forces[i] / buckling_n * (lengths[i] / home[i]).powi(2);
                (1.0 - (1.0 - load).powi(-2)) / lengths[i]
            }),
            Part::AirConditioning { leg, period_s } => {
                grow(&|i| if i + 1 == leg { (TAU * instant.elapsed() / period_s).sin() } else { 0.0 });
            }
            Part::SlippingClamps { friction_n } => {
                let Wrench { force, .. } = setup.wrench;
                for joint in &mut setup.base_joints {
                    joint.x += self.size * beyond(force.x, friction_n);
                }
            }
            Part::GuideLetGo { leg, way_m } => {
                grow(&|i| if i + 1 == leg && lengths[i] > home[i] + way_m { forces[i] } else { 0.0 });
            }
            Part::ScrewCutWarm => grow(&|i| (lengths[i] - home[i]).powi(2)),
            Part::ThinnedGrease => {
                let by_tilt = instant.delta_t() * setup.pose.angles.x;
                grow(&|i| by_tilt * forces[i]);
            }
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { size: self.size * factor, ..*self })
    }

    /// Sizes have different units, and one to begin with.
    fn largest_factor(&self) -> f64 {
        1e6
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::new()
    }
}

/// A campaign with a hidden law, read with noise.
struct Measured {
    hexapod: Hexapod,
    measurements: Dataset,
    holdout: Dataset,
    /// The measurements of the same machine without the law.
    without: Dataset,
}

/// A machine of a seed and its readings at so many poses under the loads of the plan "other-loads".
fn measured(law: &dyn Mechanism, seed: u64, poses: u64) -> Measured {
    measured_by(PlanKind::OtherLoads, law, seed, poses)
}

/// The same by another plan.
fn measured_by(plan: PlanKind, law: &dyn Mechanism, seed: u64, poses: u64) -> Measured {
    let rng = |number| stream(seed, Purpose::Test, [18, number]);
    let mut hexapod = machines::draw("ring_a", &mut rng(0));
    let noise = InstrumentNoise::default();
    hexapod.metrology = Some(noise.metrology());
    let stiffness = machines::leg_stiffness("ring_a", &mut rng(1));
    let mut schemes = plan.schemes(&hexapod, &mut rng(2));
    schemes.training.poses = Poses::Drawn { count: poses, half_mm_deg: usual_half_range_mm_deg(&hexapod) };
    let measurand = schemes.training.measurand;
    let [training, holdout] = [(schemes.training, 3), (schemes.holdout, 4)].map(|(s, n)| s.draw(&mut rng(n)));
    let world = World::new(hexapod.clone(), &stiffness);
    let mut campaign = SimulatedCampaign { world, frames: InstrumentFrames::default(), noise };
    let yardstick = Yardstick::new(&campaign, &training, measurand).unwrap();
    let hidden = law.scaled(yardstick.scale_to(law, DISTANCE).unwrap().0);
    let read = |campaign: &SimulatedCampaign, rows, n| {
        measure(campaign, rows, measurand, "measurements.csv", &mut rng(n)).unwrap()
    };
    let without = read(&campaign, &training, 5);
    campaign.world.mechanisms.push(hidden);
    let (measurements, holdout) = (read(&campaign, &training, 5), read(&campaign, &holdout, 6));
    Measured { hexapod, measurements, holdout, without }
}

fn searched(m: &Measured) -> Discovery {
    let options = DiagnoseOptions::default();
    let found = discover(&m.hexapod, &m.measurements, Some(&m.holdout), &catalogue(), &options);
    found.unwrap().discovery
}

/// What a search finds of one part, whatever its size: it is scaled to the distance.
fn of_part(part: Part) -> Discovery {
    const ANY_SIZE: f64 = 1e-7;
    searched(&measured(&MachineLaw { part, size: ANY_SIZE }, 1, 18))
}

/// A law is found whose model brings the held-out error to the noise.
fn assert_foreseen(d: &Discovery) {
    let after = d.laws.first().and_then(|l| l.held_out).map_or(f64::INFINITY, |h| h.after);
    assert!(d.found && after < 1.05, "{} {:?} {after}", d.text, d.reason);
}

/// Found as it is: what the middle of the screw shifts of the parabola is the catalogue's own effect.
#[test]
fn a_screw_held_at_both_ends_is_found_as_the_law_it_is() {
    let d = of_part(Part::ScrewHeldAtBothEnds { middle_from_home_m: 0.002 });
    assert_foreseen(&d);
    assert_eq!(
        (d.laws[0].formula.as_str(), &d.beside[..]),
        ("size*df*(q - q_home)^2", &["leg-length-compliance".to_owned()][..])
    );
}

/// The grammar has no dead band; a saturating force beside the springs is one.
#[test]
fn a_bearing_beyond_its_preload_is_found_as_a_law_of_the_force() {
    let d = of_part(Part::PreloadedBearing { preload_n: 45.0 });
    assert_foreseen(&d);
    assert!(d.laws[0].formula.contains("f/F"), "{}", d.laws[0].formula);
}

/// The grammar cannot say it; laws of the force and of length times force foresee alike.
#[test]
fn a_bowed_strut_is_foreseen_by_other_laws_of_its_force() {
    let d = of_part(Part::BowedStrut { buckling_n: 300.0 });
    assert_foreseen(&d);
    assert!(d.laws[0].formula.contains("f^2"), "{}", d.laws[0].formula);
}

/// The grammar has no dead band of a wrench; the right body moves along the right axis with the right force.
#[test]
fn clamps_that_slip_are_found_as_a_motion_of_the_base() {
    let d = of_part(Part::SlippingClamps { friction_n: 40.0 });
    assert_foreseen(&d);
    let formula = &d.laws[0].formula;
    assert!(formula.contains("fx") && formula.contains("base motion along x"), "{formula}");
}

/// Found as it is, to within the leg lengths that were read.
#[test]
fn a_guide_that_lets_go_is_found_as_a_step_in_the_length_of_its_leg() {
    let d = of_part(Part::GuideLetGo { leg: 3, way_m: 1e-3 });
    assert_foreseen(&d);
    let law = &d.laws[0];
    assert_eq!(law.formula, "size*df*step(q - length)");
    assert!(law.text.contains("compliance of leg 3 grows beyond a leg length of"), "{}", law.text);
}

/// Absolute poses show what a leg does by itself; deflections, differences of two states at one pose, do not. Found as it is.
#[test]
fn a_screw_cut_while_it_grew_warm_is_found_in_absolute_poses() {
    let law = MachineLaw { part: Part::ScrewCutWarm, size: 1e-4 };
    let d = searched(&measured_by(PlanKind::Absolute, &law, 1, 40));
    assert_foreseen(&d);
    let law = &d.laws[0];
    assert_eq!(law.formula, "size*(q - q_home)^2");
    assert!(law.text.contains("the length of all legs grows"), "{}", law.text);
}

/// The grammar has no cycle in time, and no law is claimed; the ideas name the leg and the time.
#[test]
fn a_leg_beside_a_vent_is_honestly_not_found() {
    let d = of_part(Part::AirConditioning { leg: 3, period_s: 170.0 });
    assert!(!d.found && d.reason == DiscoveryReason::NoLawConvinces, "{}", d.text);
    assert!(
        d.laws.iter().all(|l| l.formula.contains("elapsed") && l.formula.contains("[3]")),
        "{:?}",
        d.laws
    );
}

/// All legs change alike from condition to condition, so that one number of each explains it: no error of the setup, which takes six. Loads
/// that are off by a share of theirs look the same to a diagnosis, which knows no products.
#[test]
fn grease_that_warmth_thins_is_found_and_no_error_of_the_setup() {
    for seed in [1, 4, 5] {
        let m = measured(&MachineLaw { part: Part::ThinnedGrease, size: 1e-7 }, seed, 18);
        let d = searched(&m);
        assert!(d.found && d.laws[0].formula.contains("delta_T*alpha"), "{seed}: {}", d.text);
        let told = diagnose(&m.hexapod, &m.measurements, Some(&m.holdout), &catalogue()).unwrap().diagnosis;
        let kinds: Vec<FindingKind> = told.findings.iter().map(|f| f.kind).collect();
        assert!(!kinds.contains(&FindingKind::SetupError) && told.added.is_empty(), "{seed}: {kinds:?}");
    }
}

/// The same loads, stated as those at a point that is off by so much, m in mobile axes.
fn stated_about(data: &mut Dataset, off: Vector3) {
    for o in &mut data.observations {
        let arm = o.pose.rotation() * off;
        for wrench in [&mut o.wrench, &mut o.reference] {
            wrench.moment += arm.cross(&wrench.force);
        }
    }
}

/// No fit that takes the loads as stated explains the readings, with the law or without.
#[test]
fn loads_that_act_elsewhere_beside_a_law_are_told_with_it() {
    const OFF: Vector3 = Vector3::new(2e-3, 0.0, -1e-3);
    let mut m = measured(&WAVE, 1, 18);
    for file in [&mut m.measurements, &mut m.holdout] {
        stated_about(file, OFF);
    }
    let found =
        discover(&m.hexapod, &m.measurements, Some(&m.holdout), &catalogue(), &DiagnoseOptions::default())
            .unwrap();
    assert!(found.discovery.found, "{}", found.discovery.text);
    let page = discovery(&m.hexapod, &m.measurements, Some(&m.holdout), &found, &LawFiles::default());
    let page = plain(&page).split_whitespace().collect::<Vec<_>>().join(" ");
    let told = page.split_once("beside the law, the loads act ").and_then(|(_, far)| far.split_once(" mm"));
    let far: f64 = told.unwrap_or_else(|| panic!("{page}")).0.parse().unwrap();
    assert!((1e-3 * far / OFF.norm() - 1.0).abs() < 0.25, "{far}");
}

const WAVE: PeriodicCompliance = PeriodicCompliance { amplitude: 1e-8, pitch: 5e-3 };
/// Readings of the part of a large file.
const READINGS_OF_PART: usize = 432;
/// Poses of a large file.
const MANY_POSES: u64 = 90;

fn was_searched_in_a_part(d: &Discovery) -> bool {
    d.warnings.iter().any(|w| w.contains("the law was searched for in"))
}

#[test]
fn in_a_large_file_the_law_is_searched_in_a_part_and_explains_all_of_it() {
    let m = measured(&WAVE, 2, MANY_POSES);
    let d = searched(&m);
    assert!(d.found && was_searched_in_a_part(&d), "{} {:?}", d.text, d.warnings);
    let size = m.measurements.observations.len();
    assert!(d.warnings.iter().any(|w| w.contains(&format!("of {size} readings"))), "{:?}", d.warnings);
    let period = d.laws[0].parameters.iter().find(|p| p.name.ends_with("period")).unwrap();
    assert!((period.value - 1e3 * WAVE.pitch).abs() < 4.0 * period.std, "{period:?}");
}

#[test]
fn a_law_of_the_part_that_the_rest_of_a_large_file_contradicts_is_not_taken() {
    let mut m = measured(&WAVE, 2, MANY_POSES);
    // Every reading outside the part is one of the machine without the law.
    let part = m.measurements.some_poses(READINGS_OF_PART).unwrap();
    let is_in_part = |line: u64| part.observations.iter().any(|o| o.line == line);
    for (o, without) in m.measurements.observations.iter_mut().zip(&m.without.observations) {
        if !is_in_part(o.line) {
            o.measured = without.measured;
        }
    }
    let d = searched(&m);
    assert!(!was_searched_in_a_part(&d), "{} {:?}", d.text, d.warnings);
}
