//! Contract of every term of the catalogue.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use hexbench_core::{Hexapod, Measurand, Pose, Vector6, Wrench};
use hexbench_model::effects::chain::Action;
use hexbench_model::effects::term::{Chapter, Need, Rich, Term, version_named};
use hexbench_model::estimation::campaign::{Campaign, Condition};
use hexbench_model::estimation::linearization::{
    Active, Linearization, ModelPoint, actions, parameter_count,
};
use hexbench_model::machine::geometry::Machine;
use hexbench_model::terms::catalogue;

use crate::common::plan::{dataset, reading};
use crate::common::terms::{NATURAL, by_id, conditions_on, drawn_with_pairs, rows, some_shape};
use crate::common::{PAPER_STIFFNESS, measured_machine, paper_machine};

fn conditions(count: usize, seed: u64) -> Vec<Condition> {
    conditions_on(&paper_machine(), &dataset(Measurand::DeflectionRotationVector, rows(count, seed)))
}

/// What parameters of zero may add, relative: rounding.
const ROUNDING: f64 = 1e-12;

fn machine() -> Machine {
    Machine::nominal(&paper_machine())
}

fn actions_of(term: &dyn Term, rich: bool, shape: f64, at: &Condition) -> Vec<Action> {
    let mut out = Vec::new();
    actions(term, rich, shape, &machine(), at, &mut out);
    out
}

/// Elements of an action.
fn elements(action: &Action) -> Vec<f64> {
    match action {
        Action::Force(v)
        | Action::Wrench(v)
        | Action::Elongation(v)
        | Action::Base(v)
        | Action::Plate(v)
        | Action::Reading(v) => v.iter().copied().collect(),
        Action::Shift(all) => all.iter().flatten().copied().collect(),
        Action::Bending(k) => k.to_vec(),
        Action::Stiffness(m) | Action::Target(m) => m.iter().copied().collect(),
        Action::Joint { elongation: first, force } | Action::Frame { twist: first, force } => {
            first.iter().chain(force).copied().collect()
        }
    }
}

fn is_kebab(id: &str) -> bool {
    let words: Vec<&str> = id.split('-').collect();
    words.iter().all(|w| !w.is_empty() && w.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit()))
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
        for text in [i.title, i.physics, i.equation, i.source, i.shows, i.how_to_isolate] {
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
fn what_shows_in_absolute_poses_only_has_its_own_chapter() {
    for term in catalogue() {
        let i = term.info();
        let absolute = i.needs.contains(&Need::Absolute);
        assert_eq!(absolute, i.chapter == Chapter::AbsolutePoses, "{}", i.id);
        assert!(i.chapter != Chapter::Own, "{}", i.id);
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
fn a_term_calibrates_where_its_values_change_the_machine() {
    let told = |machine: &Machine| format!("{machine:?}");
    for term in catalogue() {
        let mut calibrated = machine();
        term.calibrate(&vec![1e-4; term.info().parameters.len()], &mut calibrated);
        assert_eq!(term.calibrates(), told(&calibrated) != told(&machine()), "{}", term.info().id);
    }
}

#[test]
fn a_term_is_of_the_metrology_where_it_acts_on_target_or_reading() {
    let of_metrology = |action: &Action| matches!(action, Action::Target(_) | Action::Reading(_));
    let conditions = conditions(6, 3);
    for term in catalogue() {
        let shape = some_shape(term.as_ref(), &conditions);
        let all = actions_of(term.as_ref(), false, shape, &conditions[0]);
        assert_eq!(term.is_of_metrology(), all.iter().any(of_metrology), "{}", term.info().id);
        let moves_target = all.iter().any(|action| matches!(action, Action::Target(_)));
        assert_eq!(term.is_part_of_target_frame(), moves_target, "{}", term.info().id);
    }
}

#[test]
fn versions_share_the_id_and_differ_in_word_and_numbers() {
    let all = conditions(3, 1);
    for term in catalogue() {
        let versions = term.versions();
        let shares: f64 = versions.iter().map(|(share, _)| share).sum();
        assert!(shares < 1.0 && versions.iter().all(|(share, _)| *share > 0.0), "{}", term.info().id);
        assert_eq!(term.version(), None);
        let mut words = BTreeSet::new();
        for (_, version) in &versions {
            let (info, word) = (version.info(), version.version().unwrap());
            assert!(is_kebab(word) && words.insert(word), "{}:{word}", info.id);
            assert!(word != "ideal" && word != "rich" && word != "richer", "{}:{word}", info.id);
            assert_eq!((info.id, info.needs), (term.info().id, term.info().needs));
            assert_ne!(info.equation, term.info().equation, "{word}");
            let usual = term.info().parameters;
            let is_special = info.parameters.len() < usual.len();
            assert!(!is_special || info.parameters.iter().all(|p| usual.contains(p)), "{}:{word}", info.id);
            assert!(info.parameters.iter().chain(term.info().parameters).all(|p| is_kebab(p.name)));
            let shape = some_shape(version.as_ref(), &all);
            let count = actions_of(version.as_ref(), false, shape, &all[0]).len();
            assert_eq!(count, info.parameters.len(), "{word}");
            assert_eq!(version_named(&term, word).unwrap().info().title, info.title);
        }
    }
}

#[test]
fn creep_of_a_stated_age_has_no_part_of_its_own_and_lies_between_fresh_and_settled() {
    let term = by_id("creep");
    let columns = |age: Option<f64>| {
        let mut plan = rows(6, 5);
        for o in &mut plan {
            o.reference_age = age;
        }
        let all = conditions_on(&paper_machine(), &dataset(Measurand::DeflectionRotationVector, plan));
        let open = version_named(&term, "unsettled").unwrap().shape_grid(&all);
        assert_eq!(open.is_empty(), age.is_some());
        let of = |at: &Condition| elements(&actions_of(term.as_ref(), false, 100.0, at)[0]);
        all.iter().map(of).collect::<Vec<_>>()
    };
    let [unknown, settled, middle, fresh] = [None, Some(1e9), Some(70.0), Some(0.0)].map(columns);
    let share = (-0.7_f64).exp();
    for k in 0..6 {
        for leg in 0..6 {
            assert!((unknown[k][leg] - settled[k][leg]).abs() < 1e-9);
            let between = settled[k][leg] + share * (fresh[k][leg] - settled[k][leg]);
            assert!((middle[k][leg] - between).abs() < 1e-9, "{} {between}", middle[k][leg]);
        }
    }
}

#[test]
fn a_contact_without_width_is_the_ideal_one() {
    let (term, all) = (by_id("leg-backlash"), conditions(5, 3));
    let soft = version_named(&term, "soft").unwrap();
    for at in &all {
        let [ideal, narrow] = [(&term, 1.0), (&soft, 1e-6)]
            .map(|(t, width)| elements(&actions_of(t.as_ref(), false, width, at)[0]));
        assert_eq!(ideal, narrow);
    }
}

#[test]
fn actions_are_finite_also_where_nothing_acts() {
    let mut plan = rows(8, 2);
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

fn point(campaign: &Campaign) -> ModelPoint {
    ModelPoint { compliances: Vector6::from(PAPER_STIFFNESS).map(f64::recip), ..ModelPoint::start(campaign) }
}

#[test]
fn parameters_of_zero_add_nothing() {
    let hexapod = Hexapod { metrology: measured_machine(0.5e-6, 3e-6).metrology, ..drawn_with_pairs() };
    let campaign = Campaign::new(&hexapod, &dataset(Measurand::DeflectionEuler, rows(6, 8))).unwrap();
    let bare = Linearization::at(&campaign, &point(&campaign)).unwrap();
    for term in catalogue() {
        let shape = some_shape(term.as_ref(), &bare.conditions);
        let with =
            ModelPoint { active: vec![Active::new(Arc::clone(&term), true, shape)], ..point(&campaign) };
        let lin = Linearization::at(&campaign, &with).unwrap();
        let added = (lin.predictions() - bare.predictions()).amax() / bare.predictions().amax();
        assert!(added < ROUNDING, "{}: {added:.1e}", term.info().id);
    }
}
