//! A file of a test program that nothing declares is silently never run.

use std::fs;
use std::path::{Path, PathBuf};

use crate::support::root;

fn entries(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).into_iter().flatten().map(|entry| entry.unwrap().path()).collect()
}

/// Rust files and folders of them below the folder of `root`, which declares modules, that are no module of it.
fn undeclared(root: &Path) -> Vec<PathBuf> {
    let text = fs::read_to_string(root).unwrap();
    let mut found = Vec::new();
    for path in entries(root.parent().unwrap()).into_iter().filter(|path| path != root) {
        let below = path.join("mod.rs");
        let is_rust = below.is_file() || path.extension().is_some_and(|e| e == "rs");
        let declaration = format!("mod {};", path.file_stem().unwrap().display());
        if is_rust && !text.lines().any(|line| line.trim_start_matches("pub(crate) ") == declaration) {
            found.push(path);
        } else if below.is_file() {
            found.extend(undeclared(&below));
        }
    }
    found
}

#[test]
fn every_file_of_a_test_program_is_a_module_of_it() {
    let folders =
        entries(&root().join("crates")).into_iter().flat_map(|package| entries(&package.join("tests")));
    let programs: Vec<PathBuf> =
        folders.map(|folder| folder.join("main.rs")).filter(|f| f.is_file()).collect();
    assert!(programs.len() > 5, "{programs:?}");
    for program in programs {
        assert_eq!(undeclared(&program), Vec::<PathBuf>::new(), "of {}", program.display());
    }
}

#[test]
fn a_file_that_is_not_declared_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    fs::create_dir(place("group")).unwrap();
    let files =
        [("main.rs", "mod group;\n"), ("group/mod.rs", "mod a;\n"), ("group/a.rs", ""), ("group/b.rs", "")];
    for (name, text) in files {
        fs::write(place(name), text).unwrap();
    }
    assert_eq!(undeclared(&place("main.rs")), [place("group/b.rs")]);
}
