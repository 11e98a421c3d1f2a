//! `docs/reference/file-messages.md`, made from the cases. Run with `HEXBENCH_BLESS=1` to write it again.

use super::{Case, error_of, hexapods, noticed, plans, tables};
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

const OPENING: &str = "# Messages about files\n\n\
    Written by `HEXBENCH_BLESS=1 cargo test -p hexbench-core --test core bad_input`; do not edit.\n\n\
    What the readers refuse, what they say, and what to do next. The tests check the same files.\n\n\
    Every message begins with the name of the file, left out here. Exit code 3; 5 for a missing file or a folder.\n";

fn document_path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/reference/file-messages.md")
}

fn refused(text: &mut String, title: &str, cases: &[Case]) {
    writeln!(text, "\n## {title}\n\n| what is wrong | message | next step |\n|---|---|---|").unwrap();
    for case in cases {
        let error = error_of(case);
        writeln!(text, "| {} | {} | {} |", case.what, cell(&error.message()), cell(&error.next_step()))
            .unwrap();
    }
}

fn accepted(text: &mut String) {
    text.push_str("\n## measurements.csv: read with a warning\n\n| what is noticed | message | next step |\n|---|---|---|\n");
    for case in noticed::cases() {
        let warnings = noticed::warnings_of(&case.text);
        let warning = warnings.iter().find(|warning| warning.to_string().contains(case.says)).unwrap();
        writeln!(text, "| {} | {} | {} |", case.what, cell(&warning.to_string()), warning.next_step())
            .unwrap();
    }
}

fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

#[test]
fn the_page_about_bad_input_is_up_to_date() {
    let mut text = OPENING.to_owned();
    refused(&mut text, "measurements.csv: refused", &tables::cases());
    accepted(&mut text);
    refused(&mut text, "plan.csv: refused", &plans::cases());
    refused(&mut text, "hexapod.toml: refused", &hexapods::cases());
    if std::env::var_os("HEXBENCH_BLESS").is_some() {
        fs::write(document_path(), &text).unwrap();
    }
    let stored = fs::read_to_string(document_path()).unwrap_or_default().replace("\r\n", "\n");
    assert!(stored == text, "docs/reference/file-messages.md is stale: run with HEXBENCH_BLESS=1");
}
