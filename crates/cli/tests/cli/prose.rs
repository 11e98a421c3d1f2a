//! Words of documents written by hand, and of the help: the glossary lists what is not written.

use std::fs;
use std::path::PathBuf;

use crate::support::root;

const PAGES: [&str; 9] = [
    "README.md",
    "ARCHITECTURE.md",
    "CONTRIBUTING.md",
    "docs/README.md",
    "docs/SUMMARY.md",
    "docs/reference/command-line.md",
    "docs/reference/file-formats.md",
    "scenes/README.md",
    "data/cases/README.md",
];

fn pages() -> Vec<PathBuf> {
    let guide = fs::read_dir(root().join("docs/guide")).unwrap().map(|entry| entry.unwrap().path());
    let guide = guide.filter(|path| path.extension().is_some_and(|end| end == "md"));
    PAGES.iter().map(|page| root().join(page)).chain(guide).collect()
}

/// What is written, and what is not, by the glossary's table of sentences.
fn rules() -> Vec<(String, Vec<String>)> {
    let glossary = fs::read_to_string(root().join("docs/glossary.md")).unwrap();
    let table = glossary.split("## In sentences").nth(1).unwrap();
    let rows = table.lines().filter(|line| line.starts_with("| ")).skip(1);
    let cells = rows.map(|row| row.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>());
    cells.map(|cells| (cells[0].to_owned(), cells[1].split(", ").map(str::to_owned).collect())).collect()
}

/// A line of help without names of commands: what comes behind the program, and what a list begins with.
fn without_commands(line: &str) -> String {
    let is_list = line.strip_prefix("  ").and_then(|rest| rest.split_once("  "));
    let line = match is_list {
        Some((name, says)) if !name.is_empty() && !name.contains(' ') => says,
        _ => line,
    };
    let mut parts = line.split("hexbench ");
    let before = parts.next().unwrap_or_default().to_owned();
    parts.fold(before, |all, part| all + part.split_once(' ').map_or("", |(_, rest)| rest))
}

/// Small letters and single blanks, everything else a blank; code and targets of links left out. In a block of help, all but names of
/// commands is prose.
fn words(line: &str, is_help: bool) -> String {
    let spoken: String = if is_help { without_commands(line) } else { line.split('`').step_by(2).collect() };
    let mut parts = spoken.split("](");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        text += part.split_once(')').map_or(part, |(_, rest)| rest);
    }
    let letters: String =
        text.to_lowercase().chars().map(|c| if c.is_alphanumeric() || c == '-' { c } else { ' ' }).collect();
    format!(" {} ", letters.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// Lines of a page, without blocks of code unless they are help.
fn lines(text: &str, is_help: bool) -> Vec<(usize, String)> {
    let mut in_code = false;
    let mut all = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        if line.trim_start().starts_with("```") {
            in_code ^= true;
        } else if !in_code || is_help {
            all.push((number, words(line, is_help)));
        }
    }
    all
}

#[test]
fn documents_use_the_words_of_the_glossary() {
    let rules = rules();
    assert!(rules.len() >= 8, "{rules:?}");
    let mut faults = Vec::new();
    for page in pages() {
        let is_help = page.ends_with("command-line.md");
        for (number, line) in lines(&fs::read_to_string(&page).unwrap(), is_help) {
            for (write, bad) in rules.iter().flat_map(|(write, all)| all.iter().map(move |bad| (write, bad)))
            {
                if line.contains(&format!(" {bad} ")) {
                    faults.push(format!("{}:{number}: not `{bad}` but {write}", page.display()));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

#[test]
fn a_word_is_found_in_prose_and_not_in_code() {
    let found = |line: &str, is_help| words(line, is_help).contains(" told ");
    assert!(found("It is told.", false) && found("`told`", true) && found("[told](page.md)", false));
    assert!(
        !found("  told   Say", true) && !found("hexbench told SCENE", true) && found("  says told", true)
    );
    assert!(!found("`told`", false) && !found("[page](told.md)", false) && !found("untold", false));
}
