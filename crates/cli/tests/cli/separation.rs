//! Truth and model never meet: recovery proves nothing when both share their physics.

use std::collections::{BTreeMap, BTreeSet};

use cargo_metadata::{Dependency, DependencyKind, MetadataCommand, Package};

use crate::support::root;

/// Direct dependencies of each package of the workspace, of every kind.
type Graph = BTreeMap<String, BTreeSet<String>>;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Truth,
    Model,
}

fn side(package: &str) -> Option<Side> {
    if package.starts_with("hexbench-truth") || package == "hexbench-rapier" {
        Some(Side::Truth)
    } else if ["hexbench-model", "hexbench-design", DOOR].contains(&package) {
        Some(Side::Model)
    } else {
        None
    }
}

/// The only packages that may depend on both sides: the experiments, what the command and the Python package do
/// alike, both of these, the workbench, and what feeds the readers of all of them.
const MEETING_PLACES: [&str; 6] = [
    "hexbench-experiments",
    "hexbench-app",
    "hexbench-workbench",
    "hexbench-python",
    "hexbench-cli",
    "hexbench-fuzz",
];

/// What Rust users depend on is of the model's side. Nobody who depends on it gets what its examples depend on, and one of them compares
/// with the truth.
const DOOR: &str = "hexbench";

/// All that the two sides may have in common: the nouns, and crates of the registry that know nothing of hexapods.
const SHARED: [&str; 21] = [
    "hexbench-core",
    "nalgebra",
    "rand",
    "rand_distr",
    "rand_pcg",
    "rayon",
    "statrs",
    "thiserror",
    "calamine",
    "encoding_rs",
    "memchr",
    "roxmltree",
    "zip",
    "serde",
    "serde_json",
    "sha2",
    "strsim",
    "tempfile",
    "toml",
    "criterion",
    "proptest",
];

fn reachable(graph: &Graph, from: &str) -> BTreeSet<String> {
    let mut seen = BTreeSet::new();
    let mut open = vec![from.to_owned()];
    while let Some(name) = open.pop() {
        for next in graph.get(&name).into_iter().flatten() {
            if seen.insert(next.clone()) {
                open.push(next.clone());
            }
        }
    }
    seen
}

/// One sentence per package that sees both sides and may not.
fn violations(graph: &Graph) -> Vec<String> {
    let mut found = Vec::new();
    for package in graph.keys().filter(|p| !MEETING_PLACES.contains(&p.as_str())) {
        let mut seen = reachable(graph, package);
        seen.insert(package.clone());
        let first = |wanted: Side| seen.iter().find(|p| side(p) == Some(wanted));
        if let (Some(truth), Some(model)) = (first(Side::Truth), first(Side::Model)) {
            found.push(format!("{package} sees both {truth} and {model}"));
        }
    }
    found
}

/// What both sides depend on, directly or not, and may not: physics there would be shared.
fn shared_beyond_the_list(graph: &Graph) -> Vec<String> {
    let seen = |from: Side| -> BTreeSet<String> {
        graph.keys().filter(|p| side(p) == Some(from)).flat_map(|p| reachable(graph, p)).collect()
    };
    let both = &seen(Side::Truth) & &seen(Side::Model);
    both.into_iter().filter(|p| !SHARED.contains(&p.as_str())).collect()
}

/// The graph of this workspace: normal, build and dev dependencies alike, but for those of the examples of the door.
fn workspace() -> Graph {
    let metadata = MetadataCommand::new().current_dir(root()).no_deps().exec().unwrap();
    let counts =
        |p: &Package, d: &Dependency| p.name.as_str() != DOOR || d.kind != DependencyKind::Development;
    let names =
        |p: &Package| p.dependencies.iter().filter(|d| counts(p, d)).map(|d| d.name.clone()).collect();
    metadata.workspace_packages().iter().map(|p| (p.name.to_string(), names(p))).collect()
}

fn graph(edges: &[(&str, &[&str])]) -> Graph {
    let names = |list: &[&str]| list.iter().map(ToString::to_string).collect();
    edges.iter().map(|(from, to)| ((*from).to_owned(), names(to))).collect()
}

#[test]
fn truth_and_model_do_not_depend_on_each_other_in_this_workspace() {
    let graph = workspace();
    for package in ["hexbench-model", "hexbench-truth", DOOR] {
        assert!(graph.contains_key(package), "{package}: {graph:?}");
    }
    assert_eq!(violations(&graph), Vec::<String>::new());
}

#[test]
fn a_direct_dependency_is_found() {
    let bad = graph(&[("hexbench-truth", &["hexbench-model"]), ("hexbench-model", &[])]);
    assert_eq!(violations(&bad), ["hexbench-truth sees both hexbench-truth and hexbench-model"]);
}

#[test]
fn a_dependency_through_a_third_crate_is_found() {
    let bad = graph(&[
        ("hexbench-design", &["hexbench-shared"]),
        ("hexbench-shared", &["hexbench-rapier"]),
        ("hexbench-rapier", &[]),
    ]);
    assert_eq!(violations(&bad).len(), 1);
}

#[test]
fn a_crate_that_joins_both_sides_is_found_unless_it_is_a_meeting_place() {
    let meeting = |name: &str| graph(&[(name, &["hexbench-truth-two", "hexbench-model"])]);
    for allowed in MEETING_PLACES {
        assert_eq!(violations(&meeting(allowed)), Vec::<String>::new());
    }
    assert_eq!(violations(&meeting("hexbench-report")).len(), 1);
}

#[test]
fn truth_and_model_share_only_the_nouns_and_what_is_listed() {
    assert_eq!(shared_beyond_the_list(&workspace()), Vec::<String>::new());
}

#[test]
fn physics_that_both_use_is_found() {
    let beside = graph(&[
        ("hexbench-rapier", &["hexbench-core", "hexbench-kinematics"]),
        ("hexbench-design", &["hexbench-core", "hexbench-kinematics"]),
    ]);
    assert_eq!(shared_beyond_the_list(&beside), ["hexbench-kinematics"]);
    let below_the_nouns = graph(&[
        ("hexbench-truth", &["hexbench-core"]),
        ("hexbench-model", &["hexbench-core"]),
        ("hexbench-core", &["hexbench-kinematics"]),
    ]);
    assert_eq!(shared_beyond_the_list(&below_the_nouns), ["hexbench-kinematics"]);
    let of_the_registry = graph(&[("hexbench-truth", &["k"]), ("hexbench-model", &["k", "nalgebra"])]);
    assert_eq!(shared_beyond_the_list(&of_the_registry), ["k"]);
}

#[test]
fn the_door_for_rust_users_shows_the_model_alone() {
    let bad = graph(&[(DOOR, &["hexbench-model", "hexbench-truth"]), ("hexbench-model", &[])]);
    assert_eq!(violations(&bad).len(), 1);
    let bad = graph(&[("hexbench-truth", &[DOOR]), (DOOR, &[])]);
    assert_eq!(violations(&bad), ["hexbench-truth sees both hexbench-truth and hexbench"]);
}

#[test]
fn sharing_the_nouns_is_allowed() {
    let good = graph(&[
        ("hexbench-truth", &["hexbench-core"]),
        ("hexbench-model", &["hexbench-core"]),
        ("hexbench-core", &["serde"]),
    ]);
    assert_eq!(violations(&good), Vec::<String>::new());
    assert_eq!(shared_beyond_the_list(&good), Vec::<String>::new());
}
