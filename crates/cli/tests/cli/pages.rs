//! Pages of text that people read: kept as snapshots, never wider than a terminal.

use hexbench_model::terms::catalogue;

use crate::support::{cases, diagnose, hexbench, hexbench_in, text};

const WIDTH: usize = 80;

fn assert_narrow(page: &str, what: &str) {
    for line in page.lines() {
        assert!(line.chars().count() <= WIDTH, "{what} is wider than {WIDTH} columns: {line}");
    }
}

#[test]
fn every_diagnosis_reads_as_before() {
    for case in cases() {
        let page = text(diagnose(&case, &[]));
        assert_narrow(&page, &case);
        insta::assert_snapshot!(format!("diagnose_{case}"), page);
    }
}

#[test]
fn all_the_details_fit_the_page_too() {
    for case in cases() {
        assert_narrow(&text(diagnose(&case, &["--verbose"])), &case);
    }
}

#[test]
fn the_demo_reads_as_before() {
    let page = text(hexbench().args(["demo", "--no-report"]).output().unwrap());
    assert_narrow(&page, "demo");
    insta::assert_snapshot!("demo", page);
}

#[test]
fn the_catalogue_reads_as_before() {
    let list = text(hexbench().arg("terms").output().unwrap());
    assert_narrow(&list, "terms");
    insta::assert_snapshot!("terms", list);
    insta::assert_snapshot!(
        "terms_joint_friction",
        text(hexbench().args(["terms", "joint-friction"]).output().unwrap())
    );
}

#[test]
fn every_effect_can_be_explained() {
    let list = text(hexbench().arg("terms").output().unwrap());
    let listed: Vec<&str> = list.lines().skip(1).filter_map(|l| l.split_whitespace().next()).collect();
    let ids: Vec<&str> = catalogue().iter().map(|t| t.info().id).collect();
    assert_eq!(listed, ids);
    for id in ids {
        let page = text(hexbench().args(["terms", id]).output().unwrap());
        assert_narrow(&page, id);
        for part in ["physics", "model", "needs", "source", "Parameters"] {
            assert!(page.contains(part), "{id} lacks {part}");
        }
    }
}

#[test]
fn the_demo_ends_with_the_foundation_named_and_the_chance_of_what_is_left() {
    let page = text(hexbench().args(["demo", "--no-report"]).output().unwrap());
    let end = page.split("Verdict").last().unwrap();
    let words = end.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        words.contains("base-compliance") && words.contains("still above the noise (chance 1 %)"),
        "{words}"
    );
}

#[test]
fn a_transient_reads_as_before_and_its_trace_ends_where_the_page_says() {
    let folder = tempfile::tempdir().unwrap();
    let trace = folder.path().join("trace.csv");
    let arguments = ["transient", "hexapod.toml", "--load", "0,0,-300,0,8,0", "--stiffness", "4", "-o"];
    let page = text(hexbench_in("mujoco-clean").args(arguments).arg(&trace).output().unwrap());
    assert_narrow(&page, "transient");
    let rows = std::fs::read_to_string(&trace).unwrap();
    let last: Vec<f64> = rows.lines().last().unwrap().split(',').map(|x| x.parse().unwrap()).collect();
    assert_eq!(rows.lines().next().unwrap().split(',').count(), last.len());
    assert!(page.contains(&format!("{:.3}", last[3])), "dc_um {} is not on the page:\n{page}", last[3]);
}
