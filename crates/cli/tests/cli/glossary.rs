//! One name for one thing: the public types of the workspace, and the glossary.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::support::root;

/// Types of the publication, which may be called a paper.
const PUBLICATION: [&str; 4] = ["PaperError", "PaperEstimator", "PaperFit", "PaperMachine"];
/// Words that say nothing about what a type holds.
const EMPTY: [&str; 4] = ["Manager", "Helper", "Utils", "Data"];
/// Types whose name ends in an empty word that is the field's own.
const DATA: [&str; 3] = ["Dataset", "DataColumn", "DataOrigin"];

/// Rust files of a folder and of those below it.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs") {
            found.push(path);
        }
    }
}

/// Public types with the files that declare them.
fn public_types() -> BTreeMap<String, Vec<String>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let folder = entry.unwrap().path().join("src");
        if folder.is_dir() {
            sources(&folder, &mut files);
        }
    }
    let mut types: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        for line in text.lines() {
            let declared = ["struct ", "enum ", "trait ", "type "]
                .iter()
                .find_map(|kind| line.strip_prefix("pub ")?.strip_prefix(kind));
            if let Some(rest) = declared {
                let name: String = rest.chars().take_while(|c| c.is_alphanumeric()).collect();
                types.entry(name).or_default().push(file.display().to_string());
            }
        }
    }
    types
}

/// Rows of the glossary's words: cells without their marks.
fn glossary() -> Vec<Vec<String>> {
    let text = fs::read_to_string(root().join("docs/glossary.md")).unwrap();
    let words = text.split("\n## In sentences").next().unwrap();
    let rows = words.lines().filter(|l| l.starts_with("| ") && !l.starts_with("| word "));
    rows.map(|l| l.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect()).collect()
}

/// The words of a type's name: `LegCompliances` is `leg`, `compliances`.
fn words(name: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for c in name.chars() {
        match words.last_mut() {
            Some(word) if !c.is_uppercase() => word.push(c),
            _ => words.push(c.to_lowercase().collect()),
        }
    }
    words
}

#[test]
fn no_name_stands_for_two_public_types() {
    let types = public_types();
    assert!(types.len() > 400, "{} types found", types.len());
    let twice: Vec<_> = types.iter().filter(|(_, files)| files.len() > 1).collect();
    assert!(twice.is_empty(), "one name for two things: {twice:#?}");
}

#[test]
fn no_public_type_carries_a_word_that_says_nothing() {
    let carries = |name: &&String| EMPTY.iter().any(|w| words(name).contains(&w.to_lowercase()));
    let types = public_types();
    let bad: Vec<_> = types.keys().filter(carries).filter(|n| !DATA.contains(&n.as_str())).collect();
    assert!(bad.is_empty(), "{bad:?}");
}

#[test]
fn the_glossary_names_types_that_exist_and_none_carries_a_word_it_forbids() {
    let types = public_types();
    let rows = glossary();
    assert!(rows.len() >= 40, "{} words", rows.len());
    for row in &rows {
        assert_eq!(row.len(), 4, "{row:?}");
        for name in row[2].split('`').filter(|n| n.chars().next().is_some_and(char::is_alphabetic)) {
            assert!(types.contains_key(name), "the glossary names `{name}`, which is no public type");
        }
        for word in row[3].split(", ").filter(|w| !w.is_empty()) {
            let bad: Vec<_> = types
                .keys()
                .filter(|n| words(n).iter().any(|w| w == word) && !PUBLICATION.contains(&n.as_str()))
                .collect();
            assert!(bad.is_empty(), "{bad:?}: the glossary says {} for {word}", row[0]);
        }
    }
}
