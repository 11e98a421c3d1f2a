//! Contract of every term of the catalogue.
#![allow(clippy::unwrap_used, reason = "a test without its condition fails")]

mod common;

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use common::plan::{dataset, random_pose, random_wrench, reading};
use common::random::Random;
use common::world::{World, coordinates, rigid};
use common::{PAPER_STIFFNESS, measured_machine, paper_machine, six};
use hexbench_core::{Dataset, Hexapod, Matrix6, Measurand, Observation, Pose, Vector3, Vector6, Wrench};
use hexbench_model::campaign::{Campaign, Condition};
use hexbench_model::chain::{Action, Link, Load};
use hexbench_model::linearization::{Active, Linearization, Point, actions, parameter_count};
use hexbench_model::machine::Machine;
use hexbench_model::term::{Natural, Rich, Term};
use hexbench_model::terms::catalogue;
use nalgebra::{DMatrix, Isometry3, UnitQuaternion};

/// Ids in the order of the design's table.
const IDS: [&str; 21] = [
    "leg-length-compliance",
    "leg-nonlinearity",
    "leg-asymmetry",
    "leg-backlash",
    "joint-friction",
    "joint-rotation-stiffness",
    "bracket-compliance",
    "leg-coupling",
    "base-compliance",
    "platform-compliance",
    "load-offset",
    "load-tilt",
    "thermal-expansion",
    "metrology-drift",
    "target-offset",
    "creep",
    "joint-geometry",
    "leg-offset",
    "actuator-scale",
    "actuator-pitch",
    "leg-weight",
];
/// Terms that know the vertical or the normal of the base: a bracket's plane, two tilt axes, gravity.
const KNOWS_THE_VERTICAL: [&str; 3] = ["bracket-compliance", "load-tilt", "leg-weight"];
/// Springs along fixed axes turn as a matrix: a test of its own.
const TURNS_AS_A_MATRIX: &str = "base-compliance";
/// Products of a dozen 3x3 and 6x6 matrices of condition number below 1e3, after 2 to 3 digits lost in differences of
/// lengths.
const ROUNDING: f64 = 1e-9;
/// Central differences of a smooth function with steps of 1e-4 of its scale.
const DIFFERENCE: f64 = 1e-6;
const SPRING: f64 = 2.5e-7;

/// Sizes of the paper's machine under 100 N.
const NATURAL: Natural =
    Natural { compliance: SPRING, force: 100.0, radius: 0.12, length: 0.19, elapsed: 300.0 };

fn plan(count: usize, seed: u64) -> Vec<Observation> {
    let mut random = Random::new(seed);
    let row = |id: i64| Observation {
        pose_id: id,
        approach: if id % 2 == 0 { 1.0 } else { -1.0 },
        delta_t: random.within(3.0),
        elapsed: 300.0 * random.unit(),
        measured: std::array::from_fn(|_| random.within(2e-5)),
        ..reading(
            random_pose(&mut random, 15.0, 8.0),
            random_wrench(&mut random, 300.0, 20.0),
            random_wrench(&mut random, 60.0, 5.0),
        )
    };
    (0..).take(count).map(row).collect()
}

fn conditions_on(hexapod: &Hexapod, data: &Dataset) -> Vec<Condition> {
    let stated = Hexapod { metrology: measured_machine(0.5e-6, 3e-6).metrology, ..hexapod.clone() };
    let campaign = Campaign::new(&stated, data).unwrap();
    campaign.conditions(&Machine::nominal(hexapod), &Vector6::repeat(SPRING)).unwrap()
}

fn conditions(count: usize, seed: u64) -> Vec<Condition> {
    conditions_on(&paper_machine(), &dataset(Measurand::DeflectionRotationVector, plan(count, seed)))
}

fn machine() -> Machine {
    Machine::nominal(&paper_machine())
}

/// A shape of every term that has one, 1 for the others.
fn some_shape(term: &dyn Term, conditions: &[Condition]) -> f64 {
    let grid = term.shape_grid(conditions);
    grid.get(grid.len() / 3).copied().unwrap_or(1.0)
}

fn actions_of(term: &dyn Term, rich: bool, shape: f64, at: &Condition) -> Vec<Action> {
    let mut out = Vec::new();
    actions(term, rich, shape, &machine(), at, &mut out);
    out
}

/// Elements of an action.
fn elements(action: &Action) -> Vec<f64> {
    match action {
        Action::Force(v) | Action::Elongation(v) | Action::Twist(v) => v.iter().copied().collect(),
        Action::Stiffness(m) | Action::Target(m) => m.iter().copied().collect(),
    }
}

fn is_kebab(id: &str) -> bool {
    let words: Vec<&str> = id.split('-').collect();
    words.iter().all(|w| !w.is_empty() && w.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit()))
}

#[test]
fn the_catalogue_holds_the_designed_terms_in_order() {
    let ids: Vec<&str> = catalogue().iter().map(|t| t.info().id).collect();
    assert_eq!(ids, IDS);
}

#[test]
fn names_are_unique_and_kebab_case() {
    let mut seen = BTreeSet::new();
    for term in catalogue() {
        let info = term.info();
        assert!(is_kebab(info.id), "{}", info.id);
        for name in info.parameters.iter().map(|p| p.name).chain(info.shape.map(|s| s.name)) {
            assert!(is_kebab(&name.to_ascii_lowercase()), "{}.{name}", info.id);
            assert!(seen.insert(format!("{}.{name}", info.id)), "{}.{name} twice", info.id);
        }
    }
}

#[test]
fn every_term_says_what_it_is_where_it_comes_from_and_how_to_see_it() {
    for term in catalogue() {
        let i = term.info();
        for text in [i.title, i.physics, i.equation, i.source, i.shows, i.breaker] {
            assert!(text.len() > 10, "{}: {text:?}", i.id);
        }
        assert!(
            i.source.chars().any(|c| c.is_ascii_digit()),
            "{}: source without year or number: {}",
            i.id,
            i.source
        );
        assert!(!i.parameters.is_empty(), "{}", i.id);
    }
}

#[test]
fn every_parameter_has_a_unit_and_a_physical_size() {
    for term in catalogue() {
        let id = term.info().id;
        for p in term.info().parameters {
            assert!(!p.unit.is_empty() && p.per_si > 0.0, "{id}.{}", p.name);
            let size = NATURAL.size(p.scale);
            assert!(size > 0.0 && size.is_finite(), "{id}.{}: {size}", p.name);
        }
        if let Some(s) = term.info().shape {
            assert!(
                !s.unit.is_empty() && s.per_si > 0.0 && s.bounds[0] > 0.0 && s.bounds[0] < s.bounds[1],
                "{id}"
            );
        }
    }
}

#[test]
fn every_parameter_has_one_action_in_both_forms() {
    let all = conditions(3, 1);
    for term in catalogue() {
        let shape = some_shape(term.as_ref(), &all);
        for rich in [false, true] {
            let count = actions_of(term.as_ref(), rich, shape, &all[0]).len();
            assert_eq!(count, parameter_count(term.as_ref(), rich), "{} rich {rich}", term.info().id);
        }
        let richer = parameter_count(term.as_ref(), true) > parameter_count(term.as_ref(), false);
        assert_eq!(richer, term.info().rich != Rich::None, "{}", term.info().id);
    }
}

#[test]
fn actions_are_finite_also_where_nothing_acts() {
    let mut plan = plan(8, 2);
    plan[0].wrench = Wrench::default();
    plan[0].reference = Wrench::default();
    plan[1].reference = plan[1].wrench;
    plan[2].elapsed = 0.0;
    plan[3].delta_t = 0.0;
    plan[4].pose = Pose::default();
    plan[5] = reading(Pose::default(), Wrench::default(), Wrench::default());
    for measurand in [Measurand::DeflectionEuler, Measurand::AbsolutePose] {
        let mut rows = plan.clone();
        if measurand == Measurand::AbsolutePose {
            for o in &mut rows {
                o.measured = o.pose.to_array();
            }
        }
        let all = conditions_on(&paper_machine(), &dataset(measurand, rows));
        for term in catalogue() {
            let mut shapes = term.shape_grid(&all);
            shapes.extend(term.info().shape.map_or(vec![1.0], |s| s.bounds.to_vec()));
            for (i, at) in all.iter().enumerate() {
                for &shape in &shapes {
                    let sound = actions_of(term.as_ref(), true, shape, at)
                        .iter()
                        .all(|a| elements(a).iter().all(|x| x.is_finite()));
                    assert!(sound, "{} at row {i}, shape {shape}", term.info().id);
                }
            }
        }
    }
}

#[test]
fn every_file_of_the_folder_is_registered_and_every_term_has_its_file() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/terms");
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|f| f.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
        .filter(|name| name != "mod")
        .collect();
    let terms: BTreeSet<String> = catalogue().iter().map(|t| t.info().id.replace('-', "_")).collect();
    assert_eq!(files, terms);
}

#[test]
fn shape_grids_are_sorted_and_within_their_bounds() {
    let all = conditions(12, 3);
    for term in catalogue() {
        let grid = term.shape_grid(&all);
        let Some(shape) = term.info().shape else {
            assert!(grid.is_empty(), "{} has a grid but no shape", term.info().id);
            continue;
        };
        assert!(grid.len() > 2, "{}: {grid:?}", term.info().id);
        let inside = |s: &f64| (shape.bounds[0]..=shape.bounds[1]).contains(s);
        assert!(grid.iter().all(inside), "{}: {grid:?} outside {:?}", term.info().id, shape.bounds);
        let rising = grid.windows(2).all(|w| w[0] < w[1]);
        let falling = grid.windows(2).all(|w| w[0] > w[1]);
        assert!(rising || falling, "{}: {grid:?}", term.info().id);
        for &start in &grid {
            let [low, high] = term.shape_bounds(start);
            assert!(low <= start && start <= high, "{}: start {start} outside {low}..{high}", term.info().id);
        }
    }
}

#[test]
fn actions_change_smoothly_with_the_shape() {
    let all = conditions(12, 4);
    for term in catalogue().iter().filter(|t| t.info().shape.is_some()) {
        for shape in term.shape_grid(&all) {
            let at = |s: f64| -> Vec<f64> {
                all.iter()
                    .flat_map(|c| actions_of(term.as_ref(), false, s, c))
                    .flat_map(|a| elements(&a))
                    .collect()
            };
            let slope = |h: f64| -> f64 {
                let (a, b) = (at(shape * h.exp()), at(shape * (-h).exp()));
                a.iter().zip(&b).map(|(a, b)| ((a - b) / (2.0 * h)).powi(2)).sum::<f64>().sqrt()
            };
            let (fine, finer) = (slope(1e-5), slope(2e-6));
            assert!(fine.is_finite(), "{} at {shape}", term.info().id);
            // A term whose shape decides which legs slide has kinks: equal slopes only almost everywhere.
            let limit = if term.info().id == "joint-friction" { 0.2 } else { 1e-3 };
            assert!(
                (fine - finer).abs() <= limit * finer.max(1e-12),
                "{} at {shape}: {fine} {finer}",
                term.info().id
            );
        }
    }
}

/// Whitened columns of a term at a condition.
fn columns(term: &dyn Term, rich: bool, shape: f64, machine: &Machine, at: &Condition) -> Vec<Vector6> {
    let mut out = Vec::new();
    actions(term, rich, shape, machine, at, &mut out);
    let springs = Vector6::repeat(SPRING);
    let mut load = Load::default();
    for (k, action) in out.iter().enumerate() {
        load.add(action, 1e-3 * size(term, k));
    }
    let link = Link::at(at, &springs, &load);
    // Twists in fixed axes: the observer of rotation vectors is the identity, the weights are equal per half.
    out.iter().map(|a| link.by_action(at, a).component_div(&at.weight)).collect()
}

fn size(term: &dyn Term, k: usize) -> f64 {
    term.info().parameters.get(k).map_or(0.0, |p| NATURAL.size(p.scale))
}

/// The same setup, turned as a whole about the origin of the fixed frame.
struct Turned {
    machine: Machine,
    conditions: Vec<Condition>,
    spread: Matrix6,
}

impl Turned {
    fn new(turn: UnitQuaternion<f64>, plan: &[Observation]) -> Self {
        let r = *turn.to_rotation_matrix().matrix();
        let mut spread = Matrix6::zeros();
        spread.fixed_view_mut::<3, 3>(0, 0).copy_from(&r);
        spread.fixed_view_mut::<3, 3>(3, 3).copy_from(&r);
        let drawn = paper_machine();
        let pairs = drawn.bracket_pairs();
        // Platform joints stay in mobile axes; the base and everything in fixed axes turns.
        let hexapod =
            Hexapod { base_joints: drawn.base_joints.map(|a| r * a), brackets: Some(pairs), ..drawn };
        let wrench = |w: &Wrench| Wrench { force: r * w.force, moment: r * w.moment };
        let turned = |o: &Observation| {
            let measured = spread * Vector6::from(o.measured);
            Observation {
                pose: Pose::from_rotation(r * o.pose.translation, &(r * o.pose.rotation())),
                wrench: wrench(&o.wrench),
                reference: wrench(&o.reference),
                measured: std::array::from_fn(|k| measured[k]),
                ..*o
            }
        };
        let data = dataset(Measurand::DeflectionRotationVector, plan.iter().map(turned).collect());
        let conditions = conditions_on(&hexapod, &data);
        let mut machine = Machine::nominal(&hexapod);
        // The home pose turns too.
        machine.home_lengths = Machine::nominal(&drawn_with_pairs()).home_lengths;
        let home = machine.home_lengths;
        let conditions = conditions
            .into_iter()
            .map(|c| Condition { extension: c.commanded_lengths - home, ..c })
            .collect();
        let centre = Machine::nominal(&drawn_with_pairs()).base_centre;
        machine.base_centre = r * centre;
        Self { machine, conditions, spread }
    }
}

fn drawn_with_pairs() -> Hexapod {
    let drawn = paper_machine();
    Hexapod { brackets: Some(drawn.bracket_pairs()), ..drawn }
}

/// First parameters of the vectors that a term keeps along fixed axes, and their lengths: these turn with the setup.
/// A yielding base turns as a matrix and has a test of its own.
fn fixed_vectors(id: &str) -> Vec<(usize, usize)> {
    match id {
        "load-tilt" => vec![(0, 2)],
        "metrology-drift" => vec![(0, 3), (3, 3)],
        "joint-geometry" => (0..6).map(|leg| (3 * leg, 3)).collect(),
        _ => Vec::new(),
    }
}

/// Columns of a turned setup by the parameters of the still one: a turned vector is `p' = R p`, so the column of `p_k`
/// is the sum of `R_ik` times the columns of `p'_i`.
fn by_still_parameters(id: &str, columns: &[Vector6], spread: &Matrix6) -> Vec<Vector6> {
    let mut all = columns.to_vec();
    for (first, length) in fixed_vectors(id) {
        for k in 0..length {
            all[first + k] = (0..length).map(|i| columns[first + i] * spread[(i, k)]).sum();
        }
    }
    all
}

fn assert_turns(term: &dyn Term, turn: UnitQuaternion<f64>, plan: &[Observation]) {
    let id = term.info().id;
    let before =
        conditions_on(&drawn_with_pairs(), &dataset(Measurand::DeflectionRotationVector, plan.to_vec()));
    let turned = Turned::new(turn, plan);
    let shape = some_shape(term, &before);
    let still = Machine::nominal(&drawn_with_pairs());
    let pairs = before.iter().zip(&turned.conditions).map(|(b, t)| {
        (columns(term, false, shape, &still, b), columns(term, false, shape, &turned.machine, t))
    });
    let pairs: Vec<_> = pairs.collect();
    let count = pairs[0].0.len();
    for k in 0..count {
        let (mut worst, mut scale) = (0.0_f64, 0.0_f64);
        for (b, t) in &pairs {
            let t = by_still_parameters(id, t, &turned.spread);
            worst = worst.max((turned.spread * b[k] - t[k]).amax());
            scale = scale.max(b[k].amax());
        }
        assert!(worst <= ROUNDING * scale.max(1e-12), "{id}, parameter {k}: {worst:.1e} of {scale:.1e}");
    }
}

#[test]
fn turning_the_whole_setup_about_the_vertical_turns_the_predicted_twist() {
    let plan = plan(6, 5);
    for term in catalogue().iter().filter(|t| t.info().id != TURNS_AS_A_MATRIX) {
        for angle in [0.3, 1.0, -2.0] {
            assert_turns(term.as_ref(), UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle), &plan);
        }
    }
}

#[test]
fn turning_the_whole_setup_anyhow_turns_the_predicted_twist_of_terms_that_know_no_vertical() {
    let plan = plan(6, 6);
    for term in catalogue().iter().filter(|t| t.info().id != TURNS_AS_A_MATRIX) {
        if KNOWS_THE_VERTICAL.contains(&term.info().id) {
            continue;
        }
        for turn in [Vector3::new(0.9, -0.4, 0.2), Vector3::new(-0.3, 1.4, 1.1)] {
            assert_turns(term.as_ref(), UnitQuaternion::from_scaled_axis(turn), &plan);
        }
    }
}

/// Fixed axes mean springs along x and y: a quarter turn swaps them, and a full matrix turns like a tensor.
#[test]
fn a_yielding_base_turns_as_a_full_compliance_matrix() {
    let plan = plan(6, 7);
    let term = by_id("base-compliance");
    let quarter = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
    let turned = Turned::new(quarter, &plan);
    let before = conditions_on(&drawn_with_pairs(), &dataset(Measurand::DeflectionRotationVector, plan));
    let still = Machine::nominal(&drawn_with_pairs());
    for (b, t) in before.iter().zip(&turned.conditions) {
        let (b, t) = (
            columns(term.as_ref(), true, 1.0, &still, b),
            columns(term.as_ref(), true, 1.0, &turned.machine, t),
        );
        // x of the still base is y of the turned one.
        for (k, turned_k) in [(0, 1), (1, 0), (2, 2), (3, 4), (4, 3), (5, 5)] {
            let error = (turned.spread * b[k] - t[turned_k]).amax();
            assert!(error <= ROUNDING * b[k].amax().max(1e-12), "compliance {k}: {error:.1e}");
        }
        // cross-x-y turns into minus itself.
        let error = (turned.spread * b[6] + t[6]).amax();
        assert!(error <= ROUNDING * b[6].amax(), "cross compliance: {error:.1e}");
    }
}

fn by_id(id: &str) -> Arc<dyn Term> {
    catalogue().into_iter().find(|t| t.info().id == id).unwrap()
}

fn point(campaign: &Campaign) -> Point {
    Point { springs: Vector6::from(PAPER_STIFFNESS).map(f64::recip), ..Point::start(campaign) }
}

#[test]
fn parameters_of_zero_add_nothing() {
    let hexapod = Hexapod { metrology: measured_machine(0.5e-6, 3e-6).metrology, ..drawn_with_pairs() };
    let campaign = Campaign::new(&hexapod, &dataset(Measurand::DeflectionEuler, plan(6, 8))).unwrap();
    let bare = Linearization::at(&campaign, &point(&campaign)).unwrap();
    for term in catalogue() {
        let shape = some_shape(term.as_ref(), &bare.conditions);
        let with = Point { active: vec![Active::new(Arc::clone(&term), true, shape)], ..point(&campaign) };
        let lin = Linearization::at(&campaign, &with).unwrap();
        let added = (lin.predictions() - bare.predictions()).amax() / bare.predictions().amax();
        assert!(added < ROUNDING, "{}: {added:.1e}", term.info().id);
    }
}

/// Columns of a calibrating term, and central differences of the residual when the machine is recalibrated.
fn assert_recalibrates(term: &Arc<dyn Term>, campaign: &Campaign, here: &Point, values: &[f64], limit: f64) {
    let at = |values: &[f64]| {
        let active = Active { values: values.to_vec(), ..Active::new(Arc::clone(term), false, 1.0) };
        Linearization::at(campaign, &Point { active: vec![active], ..here.clone() }).unwrap()
    };
    let block: DMatrix<f64> = at(values).term_block(term.as_ref(), false, 1.0);
    for (k, p) in term.info().parameters.iter().enumerate() {
        let step = 1e-4 * NATURAL.size(p.scale);
        let beside = |h: f64| {
            let mut moved = values.to_vec();
            moved[k] += h;
            at(&moved).residuals()
        };
        let difference = (beside(step) - beside(-step)) / (2.0 * step);
        let error = (&difference + block.column(k)).amax() / difference.amax();
        assert!(error < limit, "{}.{}: column off by {error:.1e}", term.info().id, p.name);
    }
}

#[test]
fn loads_moved_and_tilted_recalibrate_the_forces_as_their_columns_say() {
    // The reference pose sags with the springs under the calibrated load: a relative change of the columns by load over
    // stiffness times length, 300 N / (4e6 N/m * 0.19 m) = 4e-4.
    const LIMIT: f64 = 2e-3;
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let data = world.measure(Measurand::DeflectionEuler, &plan(6, 9));
    let campaign = Campaign::new(&measured_machine(0.5e-6, 3e-6), &data).unwrap();
    for (id, values) in [("load-offset", vec![3e-3, -2e-3, 5e-3]), ("load-tilt", vec![2e-3, -1e-3])] {
        assert_recalibrates(&by_id(id), &campaign, &point(&campaign), &values, LIMIT);
    }
}

/// Joints with errors of some tenths of a millimetre, base joints first.
fn joint_errors(seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    (0..36).map(|_| random.within(3e-4)).collect()
}

/// A machine built with joint errors, read absolutely without load in displaced frames: exact closure of the legs.
fn displaced_world(errors: &[f64]) -> World {
    let mut world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    for leg in 0..6 {
        world.built.base_joints[leg] += Vector3::from_column_slice(&errors[3 * leg..3 * leg + 3]);
        world.built.platform_joints[leg] += Vector3::from_column_slice(&errors[18 + 3 * leg..21 + 3 * leg]);
    }
    world.metrology_frame = Isometry3::new(Vector3::new(0.4, -0.2, 0.1), Vector3::new(0.02, -0.01, 0.3));
    world.target_frame = Isometry3::new(Vector3::new(0.01, 0.02, 0.05), Vector3::new(-0.05, 0.1, 0.02));
    world
}

fn unloaded(plan: Vec<Observation>) -> Vec<Observation> {
    let bare = |o| Observation { wrench: Wrench::default(), reference: Wrench::default(), ..o };
    plan.into_iter().map(bare).collect()
}

#[test]
fn at_the_true_joints_and_frames_absolute_poses_leave_no_residual() {
    // Legs of 0.2 m closed to 1e-16 m against a noise of 0.5 um.
    const WHITENED: f64 = 1e-8;
    let errors = joint_errors(10);
    let world = displaced_world(&errors);
    let data = world.measure(Measurand::AbsolutePose, &unloaded(plan(8, 11)));
    let campaign = Campaign::new(&measured_machine(0.5e-6, 3e-6), &data).unwrap();
    let mut here = point(&campaign);
    here.machine.metrology_frame = world.metrology_frame;
    here.machine.target_frame = world.target_frame;
    let term = by_id("joint-geometry");
    here.active = vec![Active { values: errors, ..Active::new(term, false, 1.0) }];
    let left = Linearization::at(&campaign, &here).unwrap().residuals().amax();
    assert!(left < WHITENED, "{left:.1e} standard deviations");
}

#[test]
fn joints_moved_recalibrate_the_closure_as_their_columns_say() {
    // At the truth the residual vanishes and with it all terms of second order.
    let errors = joint_errors(12);
    let world = displaced_world(&errors);
    let data = world.measure(Measurand::AbsolutePose, &unloaded(plan(6, 13)));
    let campaign = Campaign::new(&measured_machine(0.5e-6, 3e-6), &data).unwrap();
    let mut here = point(&campaign);
    here.machine.metrology_frame = world.metrology_frame;
    here.machine.target_frame = world.target_frame;
    assert_recalibrates(&by_id("joint-geometry"), &campaign, &here, &errors, DIFFERENCE);
}

#[test]
fn frames_moved_change_the_residual_as_their_columns_say() {
    // m and rad; the curvature of a frame's motion is of size one.
    const STEP: f64 = 1e-6;
    let errors = joint_errors(14);
    let world = displaced_world(&errors);
    let data = world.measure(Measurand::AbsolutePose, &unloaded(plan(6, 15)));
    let campaign = Campaign::new(&measured_machine(0.5e-6, 3e-6), &data).unwrap();
    let mut here = point(&campaign);
    here.machine.metrology_frame = world.metrology_frame;
    here.machine.target_frame = world.target_frame;
    here.active = vec![Active { values: errors, ..Active::new(by_id("joint-geometry"), false, 1.0) }];
    let block = Linearization::at(&campaign, &here).unwrap().common_block();
    for k in 0..12 {
        let beside = |h: f64| {
            let mut moved = here.clone();
            let mut motion = [0.0; 12];
            motion[k] = h;
            moved.move_frames(&motion);
            Linearization::at(&campaign, &moved).unwrap().residuals()
        };
        let difference = (beside(STEP) - beside(-STEP)) / (2.0 * STEP);
        let error = (&difference + block.column(6 + k)).amax() / difference.amax();
        assert!(error < DIFFERENCE, "frame motion {k}: column off by {error:.1e}");
    }
}

#[test]
fn frames_of_the_machine_are_those_of_the_world() {
    let world = displaced_world(&joint_errors(16));
    let mut machine = machine();
    machine.metrology_frame = world.metrology_frame;
    machine.target_frame = world.target_frame;
    let pose = Pose::from_array([0.01, -0.02, 0.005, 0.1, -0.05, 0.2]);
    let expected = coordinates(&(world.metrology_frame * rigid(&pose) * world.target_frame));
    let error = (machine.target_pose(&pose).to_vector() - Vector6::from(expected)).amax();
    let back = (machine.platform_pose(&machine.target_pose(&pose)).to_vector() - pose.to_vector()).amax();
    assert!(error < 1e-14 && back < 1e-14, "{error:.1e}, {back:.1e}");
}

#[test]
fn the_effective_wrench_is_the_moved_and_tilted_one() {
    let mut moved = machine();
    moved.load_point = Vector3::new(0.01, 0.02, -0.03);
    moved.load_tilt = Vector3::new(1e-3, -2e-3, 0.0);
    let pose = Pose::from_array([0.0, 0.0, 0.0, 0.2, -0.1, 0.4]);
    let wrench = Wrench::from_array([10.0, -20.0, -300.0, 1.0, 2.0, 3.0]);
    let force = wrench.force + moved.load_tilt.cross(&wrench.force);
    let arm = rigid(&pose).rotation * moved.load_point;
    let expected = six(&force, &(wrench.moment + arm.cross(&force)));
    let error = (moved.effective_wrench(&wrench, &pose) - expected).amax();
    assert!(error < 1e-12, "{error:.1e}");
}
