//! `diagnose --html`: one file that needs nothing else.

use std::fs;

use crate::json::diagnosis;
use crate::support::{cases, diagnose, hexbench, root, text};

/// Pages are mailed around: the largest of the bundled cases.
const LARGEST_BYTES: usize = 3_000_000;

fn page(case: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.html");
    text(diagnose(case, &["--html", file.to_str().unwrap()]));
    fs::read_to_string(file).unwrap()
}

#[test]
fn every_case_has_a_page_with_its_verdict_its_charts_and_nothing_from_elsewhere() {
    for case in cases() {
        let html = page(&case);
        assert!(html.starts_with("<!doctype html>") && html.ends_with("</html>"), "{case}: cut");
        assert!(html.len() < LARGEST_BYTES, "{case}: {} bytes", html.len());
        let verdict = diagnosis(&case)["verdict"].as_str().unwrap().to_uppercase();
        assert!(html.contains(&format!(">{verdict}</span>")), "{case}: no verdict");
        assert!(html.matches("<svg").count() >= 6, "{case}: {} charts", html.matches("<svg").count());
        assert!(!html.contains("NaN") && !html.contains(">inf<"), "{case}: a number that is none");
        let elsewhere = html.replace("http://www.w3.org/", "");
        for sign in ["http:", "https:", "<script", "<link", "src=", "url("] {
            assert!(!elsewhere.contains(sign), "{case}: {sign}");
        }
    }
}

#[test]
fn names_in_files_are_text_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let case = root().join("data/cases/contact");
    let machine = fs::read_to_string(case.join("hexapod.toml")).unwrap();
    let named =
        machine.lines().map(|l| if l.starts_with("name") { "name = '<script>alert(1)</script>'" } else { l });
    let hexapod = folder.path().join("hexapod.toml");
    fs::write(&hexapod, named.collect::<Vec<_>>().join("\n")).unwrap();
    let file = folder.path().join("report.html");
    let arguments = [hexapod.as_path(), &case.join("measurements.csv")];
    text(hexbench().arg("diagnose").args(arguments).arg("--html").arg(&file).output().unwrap());
    let html = fs::read_to_string(file).unwrap();
    assert!(html.contains("&lt;script&gt;alert(1)&lt;&#x2f;script&gt;") && !html.contains("<script>"));
}
