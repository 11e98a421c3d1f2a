//! `hexbench demo`: the page at its end, and what it leaves alone.

use std::fs;
use std::path::Path;
use std::process::Output;

use crate::support::{complaint, hexbench, text};

fn demo(folder: &Path, more: &[&str]) -> Output {
    hexbench().arg("demo").args(more).current_dir(folder).output().unwrap()
}

#[test]
fn the_demo_ends_with_a_page_and_says_where_and_how_large() {
    let folder = tempfile::tempdir().unwrap();
    let output = demo(folder.path(), &[]);
    let page = fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(page.contains(">NAMED</span>") && page.contains("base-compliance"));
    let told = complaint(&output);
    assert!(told.contains(&format!("report.html ({} kB)", page.len().div_ceil(1000))), "{told}");
    text(output);
    // Its own page gives way to a new one.
    assert_eq!(complaint(&demo(folder.path(), &[])), told);
}

#[test]
fn a_page_that_is_not_its_own_stays_and_the_story_is_told_all_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("report.html");
    fs::write(&path, "the report of someone else").unwrap();
    let output = demo(folder.path(), &[]);
    assert!(
        complaint(&output).contains("is not a page of hexbench; it was not replaced"),
        "{}",
        complaint(&output)
    );
    assert!(text(output).contains("Verdict"));
    assert_eq!(fs::read_to_string(&path).unwrap(), "the report of someone else");
    let asked = demo(folder.path(), &["-o", "report.html"]);
    assert_eq!(asked.status.code(), Some(2), "{}", complaint(&asked));
    assert_eq!(fs::read_to_string(&path).unwrap(), "the report of someone else");
}

#[test]
fn the_page_can_go_elsewhere_or_be_left_out() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(complaint(&demo(folder.path(), &["--no-report"])), "");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    text(demo(folder.path(), &["-o", "mine.html"]));
    assert!(folder.path().join("mine.html").is_file() && !folder.path().join("report.html").exists());
}

/// Nobody can write there, not even root.
#[cfg(target_os = "linux")]
#[test]
fn where_nothing_can_be_written_the_story_is_told_and_the_page_is_missed() {
    let output = demo(Path::new("/proc/self"), &[]);
    assert!(complaint(&output).contains("report.html: cannot be written"), "{}", complaint(&output));
    assert!(text(output).contains("Verdict"));
    let asked = demo(Path::new("/proc/self"), &["-o", "report.html"]);
    assert_eq!(asked.status.code(), Some(5), "{}", complaint(&asked));
}
