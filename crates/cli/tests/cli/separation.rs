//! Truth and model never meet: recovery proves nothing when both share their physics.

use std::collections::{BTreeMap, BTreeSet};

use cargo_metadata::MetadataCommand;

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
    } else if package == "hexbench-model" || package == "hexbench-design" {
        Some(Side::Model)
    } else {
        None
    }
}

/// The only packages that may depend on both sides: the experiments, what the command and the Python package do
/// alike, both of these, and the workbench.
const MEETING_PLACES: [&str; 5] =
    ["hexbench-experiments", "hexbench-app", "hexbench-workbench", "hexbench-python", "hexbench-cli"];

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

/// The graph of this workspace: normal, build and dev dependencies alike.
fn workspace() -> Graph {
    let metadata = MetadataCommand::new().current_dir(root()).no_deps().exec().unwrap();
    let names = |p: &cargo_metadata::Package| p.dependencies.iter().map(|d| d.name.clone()).collect();
    metadata.workspace_packages().iter().map(|p| (p.name.to_string(), names(p))).collect()
}

fn graph(edges: &[(&str, &[&str])]) -> Graph {
    let names = |list: &[&str]| list.iter().map(ToString::to_string).collect();
    edges.iter().map(|(from, to)| ((*from).to_owned(), names(to))).collect()
}

#[test]
fn truth_and_model_do_not_depend_on_each_other_in_this_workspace() {
    let graph = workspace();
    assert!(graph.contains_key("hexbench-model") && graph.contains_key("hexbench-truth"), "{graph:?}");
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
fn sharing_the_nouns_is_allowed() {
    let good = graph(&[
        ("hexbench-truth", &["hexbench-core"]),
        ("hexbench-model", &["hexbench-core"]),
        ("hexbench-core", &["serde"]),
    ]);
    assert_eq!(violations(&good), Vec::<String>::new());
}
