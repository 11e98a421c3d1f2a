//! The reference of the command line, written from the help of every command.

use std::fmt::Write as _;

use crate::documents::assert_kept;
use crate::support::{hexbench, text};

const PAGE: &str = "docs/reference/command-line.md";

const HEAD: &str = "# Command line

Written by `HEXBENCH_BLESS=1 cargo test --workspace --test cli command_line`; do not edit.

Every command with its arguments, as `hexbench COMMAND --help` prints them. `hexbench man DIR` writes the same as manual pages.
Options common to all commands are listed once, under [hexbench](#hexbench).
";

/// What a command says of itself; the width does not depend on the terminal of whoever runs the test.
fn help(path: &[String]) -> String {
    text(hexbench().env_remove("COLUMNS").args(path).arg("--help").output().unwrap())
}

/// Names under `Commands:`, where every name stands two columns from the left.
fn subcommands(help: &str) -> Vec<String> {
    let lines = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let entries = lines.take_while(|line| !line.is_empty()).filter(|line| !line.starts_with("   "));
    let names = entries.filter_map(|line| line.split_whitespace().next()).filter(|name| *name != "help");
    names.map(str::to_owned).collect()
}

/// Help without the options that every command takes.
fn own(help: &str) -> String {
    let end_of_common = "Print help (see a summary with '-h')\n";
    match (help.find("      --color <WHEN>"), help.find(end_of_common)) {
        (Some(start), Some(end)) => {
            format!("{}{}", &help[..start], help[end + end_of_common.len()..].trim_start())
        }
        _ => help.to_owned(),
    }
}

/// Lines without blanks at their ends, and no two empty ones in a row.
fn tidy(help: &str) -> String {
    let mut lines: Vec<&str> = help.lines().map(str::trim_end).collect();
    lines.dedup_by(|line, before| line.is_empty() && before.is_empty());
    lines.join("\n").trim_end().replace("Options:\nExamples", "Examples")
}

fn chapter(path: &[String], page: &mut String) {
    let whole = help(path);
    let said = if path.is_empty() { whole.clone() } else { own(&whole) };
    let title = [&["hexbench".to_owned()], path].concat().join(" ");
    let level = "#".repeat(2 + path.len().saturating_sub(1));
    writeln!(page, "\n{level} {title}\n\n```text\n{}\n```", tidy(&said)).unwrap();
    for name in subcommands(&whole) {
        chapter(&[path, &[name]].concat(), page);
    }
}

/// `Exit codes: 0 done, 1 ...` at the end of the help, as rows.
fn exit_codes(help: &str) -> Vec<String> {
    let said = help.split("Exit codes: ").nth(1).unwrap().split_whitespace().collect::<Vec<_>>().join(" ");
    let rows = said.split(", ").map(|entry| entry.split_once(' ').unwrap());
    rows.map(|(code, meaning)| format!("| {code} | {meaning} |")).collect()
}

fn fresh() -> String {
    let mut page = HEAD.to_owned();
    let codes = exit_codes(&help(&[])).join("\n");
    writeln!(page, "\n## Exit codes\n\n| code | means |\n|---|---|\n{codes}").unwrap();
    chapter(&[], &mut page);
    page
}

#[test]
fn the_page_among_the_documents_is_what_every_command_says_of_itself() {
    let fresh = fresh();
    assert!(fresh.contains("\n### hexbench challenge make\n"), "{fresh}");
    assert_eq!(fresh.matches("--color <WHEN>").count(), 1);
    assert_kept(PAGE, &fresh);
}

#[test]
fn the_exit_codes_are_six() {
    let rows = exit_codes(&help(&[]));
    assert_eq!(rows.len(), 6, "{rows:?}");
    assert_eq!(rows[5], "| 5 | input or output |");
}
