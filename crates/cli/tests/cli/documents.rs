//! Documents that state what the code is: generated, or checked against it.

use std::fs;
use std::path::PathBuf;

use cargo_metadata::MetadataCommand;

use crate::support::{hexbench, root, text};

/// Set to write generated documents instead of comparing them.
const BLESS: &str = "HEXBENCH_BLESS";

/// A committed file is what was just made; with `HEXBENCH_BLESS` it becomes it.
pub(crate) fn assert_kept(file: &str, fresh: &str) {
    let path = root().join(file);
    if std::env::var_os(BLESS).is_some() {
        fs::write(&path, fresh).unwrap();
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == fresh, "{file} is stale: run the tests once with {BLESS}=1");
}

#[test]
fn the_page_of_effects_is_what_the_code_says() {
    assert_kept(
        "docs/reference/effects.md",
        &text(hexbench().args(["terms", "--markdown"]).output().unwrap()),
    );
}

#[test]
fn the_picture_of_the_bench_with_gauges_is_what_check_draws() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    text(
        hexbench()
            .arg("simulate")
            .arg(root().join("scenes/granite"))
            .arg("-o")
            .arg(at("bench"))
            .output()
            .unwrap(),
    );
    let machine = at("bench/hexapod.toml");
    let page =
        text(hexbench().arg("check").arg(&machine).arg("--picture").arg(at("g.svg")).output().unwrap());
    assert!(page.contains("A z1") && page.contains("distance of (300.0, 0, 40.00) mm"), "{page}");
    let fresh = fs::read_to_string(at("g.svg")).unwrap();
    assert!(fresh.contains("sensors: distance"), "{fresh}");
    assert_kept("docs/guide/screenshots/gauges.svg", &fresh);
}

#[test]
fn the_picture_of_the_law_is_what_discover_draws() {
    let folder = tempfile::tempdir().unwrap();
    let case = root().join("data/cases/not-in-catalogue");
    let discover = ["discover", "hexapod.toml", "measurements.csv", "--quiet", "--charts"];
    text(hexbench().current_dir(case).args(discover).arg(folder.path()).output().unwrap());
    let fresh = fs::read_to_string(folder.path().join("period-folded.svg")).unwrap();
    assert!(fresh.contains("leg length within 8.00 mm"), "{fresh}");
    assert_kept("docs/guide/screenshots/law.svg", &fresh);
}

/// Fields of the first public structure of a source file, as its parameters are named in scenes.
fn parameters(source: &str) -> Vec<&str> {
    let fields = source.lines().skip_while(|line| !line.starts_with("pub struct ")).skip(1);
    let fields = fields.take_while(|line| *line != "}").filter_map(|line| line.trim().strip_prefix("pub "));
    fields.filter_map(|field| field.split(':').next()).collect()
}

#[test]
fn the_formats_list_every_parameter_of_every_effect_of_a_scene() {
    let formats = fs::read_to_string(root().join("docs/reference/file-formats.md")).unwrap();
    for entry in hexbench_truth::mechanisms::REGISTRY {
        let file = entry.id.trim_start_matches("out:").replace('-', "_");
        let source = root().join(format!("crates/truth/src/mechanisms/{file}.rs"));
        let row = formats.lines().find(|line| line.starts_with(&format!("| `{}` |", entry.id)));
        let row = row.unwrap_or_else(|| panic!("no row for {}", entry.id));
        let source = fs::read_to_string(source).unwrap();
        let names = parameters(&source);
        assert!(!names.is_empty(), "{}", entry.id);
        for name in names {
            assert!(row.contains(&format!("`{name}`:")), "{} has no `{name}`: {row}", entry.id);
        }
    }
}

/// Markdown files of a folder of the documentation.
fn pages(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join(folder)).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    paths.filter(|path| path.extension().is_some_and(|end| end == "md")).collect()
}

#[test]
fn every_page_of_results_says_in_the_same_words_what_writes_it() {
    let pages = pages("docs/results");
    assert!(pages.len() > 9, "{pages:?}");
    for page in pages {
        let text = fs::read_to_string(&page).unwrap();
        let banner = text.lines().nth(2).unwrap_or_default();
        let command =
            banner.strip_prefix("Written by `").and_then(|rest| rest.strip_suffix("`; do not edit."));
        assert!(command.is_some_and(|c| !c.contains('`')), "{}: {banner}", page.display());
    }
}

#[test]
fn the_book_and_its_first_page_list_every_page() {
    let summary = fs::read_to_string(root().join("docs/SUMMARY.md")).unwrap();
    let first = fs::read_to_string(root().join("docs/README.md")).unwrap();
    for shelf in ["guide", "reference", "results", "repository"] {
        for page in pages(&format!("docs/{shelf}")) {
            let link = format!("]({shelf}/{})", page.file_name().unwrap().display());
            assert!(summary.contains(&link), "docs/SUMMARY.md lacks {link}");
            assert!(shelf == "repository" || first.contains(&link), "docs/README.md lacks {link}");
        }
    }
}

#[test]
fn the_list_of_schemas_has_every_schema_with_its_format() {
    let folder = root().join("docs/reference/schemas");
    let list = fs::read_to_string(folder.join("README.md")).unwrap();
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let schemas: Vec<PathBuf> = entries.filter(|p| p.extension().is_some_and(|end| end == "json")).collect();
    assert_eq!(list.lines().filter(|line| line.starts_with("| `")).count(), schemas.len());
    for schema in schemas {
        let file = schema.file_name().unwrap().to_string_lossy().into_owned();
        let format = file.trim_end_matches("-1.json");
        let row = format!("| `{format}/1` | [{file}]({file}) | ");
        assert!(list.contains(&row), "docs/reference/schemas/README.md lacks {row}");
    }
}

#[test]
fn the_constants_of_the_methods_are_those_of_the_code() {
    let page = fs::read_to_string(root().join("docs/guide/methods.md")).unwrap();
    let rows = page.lines().filter(|line| line.starts_with("| ") && line.contains("crates/model/src"));
    let mut count = 0;
    for row in rows {
        // Every second piece is code: the value, the name, the file.
        let said: Vec<&str> = row.split('`').skip(1).step_by(2).collect();
        let source = fs::read_to_string(root().join(said[2])).unwrap();
        let line = source.lines().find(|line| line.contains(&format!("const {}: ", said[1])));
        let line = line.unwrap_or_else(|| panic!("{} has no {}", said[2], said[1]));
        assert!(line.ends_with(&format!(" = {};", said[0])), "docs/guide/methods.md: {row}\nis not {line}");
        count += 1;
    }
    assert!(count > 10, "{count}");
}

#[test]
fn the_architecture_names_every_crate_and_no_other() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let metadata = MetadataCommand::new().current_dir(root()).no_deps().exec().unwrap();
    let members: Vec<String> = metadata.workspace_packages().iter().map(|p| p.name.to_string()).collect();
    for name in &members {
        assert!(page.contains(&format!("`{name}`")), "ARCHITECTURE.md does not name {name}");
    }
    for name in page.split('`').filter(|w| w.starts_with("hexbench-")) {
        assert!(members.iter().any(|m| m == name), "ARCHITECTURE.md names {name}, which is gone");
    }
}

#[test]
fn every_path_in_the_architecture_exists() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let paths: Vec<&str> = page.split('`').filter(|w| w.contains('/') && !w.contains([' ', '*'])).collect();
    assert!(paths.len() > 10, "{paths:?}");
    for path in paths {
        assert!(root().join(path).exists(), "ARCHITECTURE.md names {path}, which is gone");
    }
}

#[test]
fn the_readme_is_short_and_shows_the_errors_of_the_demo() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    assert!(readme.lines().count() <= 120, "{} lines", readme.lines().count());
    let demo = text(hexbench().args(["demo", "--no-report"]).output().unwrap());
    let steps = demo.lines().filter(|l| l.trim_end().ends_with('#'));
    let rungs: Vec<&str> = steps
        .filter(|l| ["springs alone", "+ ", "noise of one"].iter().any(|s| l.trim().starts_with(s)))
        .collect();
    assert_eq!(rungs.len(), 3, "{rungs:?}");
    for rung in rungs {
        assert!(readme.contains(rung.trim_end()), "README.md lacks the line: {rung}");
    }
}
