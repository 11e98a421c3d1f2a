//! `docs/results/inputs.md`, made from the table. Run with `HEXBENCH_BLESS=1` to write it again.

use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use hexbench_core::{BallRecord, Dataset};

use super::{Input, Meaning, Reads, balls, measurements, said};

const OPENING: &str = "# Files as people make them\n\n\
    Written by `HEXBENCH_BLESS=1 cargo test -p hexbench-core --test core inputs`; do not edit.\n\n\
    Tables as spreadsheets, programs of measuring machines, scripts and people write them, made from one plain table each. A test\n\
    reads every one: it has the numbers of the plain table, or it is refused with what to do. *As it is* means that nothing is said.\n";

fn listed<T: Reads>(text: &mut String, title: &str, inputs: &[Input]) {
    let is_read = |input: &&Input| matches!(input.meaning, Meaning::Read(_));
    let read = inputs.iter().filter(is_read).count();
    writeln!(text, "\n## {title}\n\n{} files: {read} read, {} refused.\n", inputs.len(), inputs.len() - read)
        .unwrap();
    writeln!(text, "| read as the plain table | what is said |\n|---|---|").unwrap();
    for input in inputs.iter().filter(is_read) {
        let (told, _) = said::<T>(&input.bytes);
        let told = if told.is_empty() { "*as it is*".to_owned() } else { cell(&told) };
        writeln!(text, "| {} | {told} |", cell(input.what)).unwrap();
    }
    writeln!(text, "\n| refused | message | next step |\n|---|---|---|").unwrap();
    for input in inputs.iter().filter(|input| !is_read(input)) {
        let (told, next) = said::<T>(&input.bytes);
        writeln!(text, "| {} | {} | {} |", cell(input.what), cell(&told), cell(&next)).unwrap();
    }
}

fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

#[test]
fn the_page_about_inputs_is_up_to_date() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/results/inputs.md");
    let mut text = OPENING.to_owned();
    listed::<Dataset>(&mut text, "Measurements", &measurements::inputs());
    listed::<Vec<BallRecord>>(&mut text, "Ball centers", &balls::inputs());
    if std::env::var_os("HEXBENCH_BLESS").is_some() {
        fs::write(&path, &text).unwrap();
    }
    let stored = fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    assert!(stored == text, "docs/results/inputs.md is stale: run with HEXBENCH_BLESS=1");
}
