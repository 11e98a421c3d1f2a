//! Links between the documents of the repository: files that are there, headings that are there.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::support::root;

/// Folders that hold no documents of ours.
const FOREIGN: [&str; 4] = ["target", "node_modules", ".git", "artefacts"];

/// Markdown files of a folder and of those below it.
fn documents(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() && !path.is_symlink() && !FOREIGN.contains(&name.as_str()) {
            documents(&path, found);
        } else if path.extension().is_some_and(|end| end == "md") {
            found.push(path);
        }
    }
}

/// Lines outside blocks of code, with their numbers, counted from 1.
fn prose(text: &str) -> Vec<(usize, &str)> {
    let mut in_code = false;
    let is_prose = |(_, line): &(usize, &str)| {
        let is_fence = line.trim_start().starts_with("```");
        in_code ^= is_fence;
        !in_code && !is_fence
    };
    (1..).zip(text.lines()).filter(is_prose).collect()
}

/// Targets of the links in a line, those in code left out.
fn targets(line: &str) -> Vec<String> {
    let spoken: String = line.split('`').step_by(2).collect();
    let ends = spoken.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    ends.map(str::to_owned).collect()
}

/// The address of a heading, as GitHub and mdBook make it.
fn anchor(heading: &str) -> String {
    let kept = heading.to_lowercase();
    let kept = kept.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// Addresses of all headings; a second one of the same words ends in `-1`.
fn anchors(text: &str) -> Vec<String> {
    let mut uses: BTreeMap<String, usize> = BTreeMap::new();
    let headings = prose(text).into_iter().filter(|(_, line)| line.starts_with('#'));
    let unique = headings.map(|(_, line)| {
        let name = anchor(line.trim_start_matches('#').trim());
        let before = uses.entry(name.clone()).or_default();
        *before += 1;
        if *before == 1 { name } else { format!("{name}-{}", *before - 1) }
    });
    unique.collect()
}

/// What is wrong with a link on a page.
fn fault(page: &Path, target: &str) -> Option<String> {
    if target.contains("://") || target.starts_with("mailto:") {
        return None;
    }
    let (file, heading) = target.split_once('#').unwrap_or((target, ""));
    let path = if file.is_empty() { page.to_owned() } else { page.parent().unwrap().join(file) };
    if !path.exists() {
        return Some("there is no such file".to_owned());
    }
    let is_page = path.extension().is_some_and(|end| end == "md");
    let is_there = heading.is_empty()
        || is_page && anchors(&fs::read_to_string(path).unwrap()).contains(&heading.to_owned());
    (!is_there).then(|| "there is no such heading".to_owned())
}

#[test]
fn every_link_of_all_documents_leads_to_a_file_and_a_heading() {
    let mut pages = Vec::new();
    documents(&root(), &mut pages);
    assert!(pages.len() > 40, "{} documents", pages.len());
    let (mut links, mut faults) = (0, Vec::new());
    for page in pages {
        let text = fs::read_to_string(&page).unwrap();
        for (number, line) in prose(&text) {
            for target in targets(line) {
                links += 1;
                faults.extend(
                    fault(&page, &target).map(|f| format!("{}:{number}: {target}: {f}", page.display())),
                );
            }
        }
    }
    println!("{links} links");
    assert!(links > 200, "{links} links found");
    assert!(faults.is_empty(), "{faults:#?}");
}

#[test]
fn a_link_to_a_missing_file_or_heading_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.md");
    fs::write(&page, "# One `two`\n\n## Twice\n\n## Twice\n\n```text\n# no heading\n```\n").unwrap();
    for good in ["page.md", "#one-two", "page.md#twice-1", "https://example.org/#x"] {
        assert_eq!(fault(&page, good), None, "{good}");
    }
    for bad in ["pages.md", "#no-heading", "page.md#twice-2"] {
        assert!(fault(&page, bad).is_some(), "{bad}");
    }
    assert_eq!(targets("[a](b.md), `[c](d)` and ![e](f.svg)"), ["b.md", "f.svg"]);
}
