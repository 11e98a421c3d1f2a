//! Every medium says the same: whatever stands on a terminal stands in Markdown, in HTML and in the JSON of a page.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use hexbench_core::files::{read_hexapod, read_measurements};
use hexbench_core::{Dataset, Hexapod};
use hexbench_model::results::compare::compare;
use hexbench_model::results::diagnose::diagnose;
use hexbench_model::terms::catalogue;
use hexbench_report::render::{Terminal, html, markdown, terminal};
use hexbench_report::words::{Provenance, ReportSubject, comparison, diagnosis, subject};
use hexbench_report::{Block, Cell, Definition, Page, Section, charts};

struct Case {
    name: String,
    hexapod: Hexapod,
    data: Dataset,
    holdout: Dataset,
}

fn cases() -> Vec<Case> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/cases");
    let mut folders: Vec<PathBuf> = std::fs::read_dir(root).unwrap().map(|e| e.unwrap().path()).collect();
    folders.retain(|folder| folder.is_dir());
    folders.sort();
    let read = |folder: &PathBuf| Case {
        name: folder.file_name().unwrap().to_string_lossy().into_owned(),
        hexapod: read_hexapod(&folder.join("hexapod.toml")).unwrap(),
        data: read_measurements(&folder.join("measurements.csv")).unwrap().dataset,
        holdout: read_measurements(&folder.join("holdout.csv")).unwrap().dataset,
    };
    folders.iter().map(read).collect()
}

/// A case's name, its page in words, and the page with its charts as `--html` shows it.
type Pages = Vec<(String, Page, Page)>;

/// The diagnosis of every bundled case, made once for all tests.
static DIAGNOSES: LazyLock<Pages> = LazyLock::new(diagnoses);
static COMPARISONS: LazyLock<Pages> = LazyLock::new(comparisons);

fn diagnoses() -> Pages {
    let page = |case: &Case| {
        let study = diagnose(&case.hexapod, &case.data, Some(&case.holdout), &catalogue()).unwrap();
        let subject = ReportSubject::of(&case.hexapod, &case.data, Some(&case.holdout), &study);
        (case.name.clone(), diagnosis(&subject), charts::diagnosis(&subject, &provenance()).unwrap())
    };
    cases().iter().map(page).collect()
}

fn comparisons() -> Pages {
    let page = |case: &Case| {
        let held = Some(&case.holdout);
        let compared = compare(&case.hexapod, &case.data, None, held).unwrap();
        let about = subject::entries(&case.data, held, &compared.campaign);
        let words = comparison(&case.hexapod.name, about, &compared.comparison);
        let charts = charts::comparison(&case.hexapod, &case.data, held, &compared, &provenance()).unwrap();
        (case.name.clone(), words, charts)
    };
    cases().iter().map(page).collect()
}

fn provenance() -> Provenance {
    Provenance { command: "hexbench diagnose".to_owned(), files: Vec::new() }
}

/// Letters and digits alone: blanks, line breaks, rules of tables and capital first letters are layout.
fn plain(text: &str) -> String {
    text.to_lowercase().chars().filter(|c| c.is_alphanumeric()).collect()
}

/// The text of a page of HTML as a reader sees it; µm and × are read as the um and x of the other media.
fn readable(html: &str) -> String {
    let body = html.split_once("<main>").unwrap().1;
    let mut text = String::new();
    for part in body.split('<') {
        text.push_str(part.split_once('>').map_or(part, |(_, text)| text));
        text.push(' ');
    }
    let marks =
        [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#x27;", "'"), ("&#x2f;", "/"), ("&amp;", "&")];
    marks
        .into_iter()
        .fold(text.replace('µ', "u").replace('×', "x"), |text, (mark, sign)| text.replace(mark, sign))
}

/// Everything a page says, one part each.
fn parts(page: &Page) -> Vec<String> {
    let entries =
        |all: &[Definition]| all.iter().flat_map(|e| [e.label.clone(), e.text.clone()]).collect::<Vec<_>>();
    let block = |block: &Block| match block {
        Block::Verdict { word, sentences, .. } => {
            std::iter::once(word.clone()).chain(sentences.clone()).collect()
        }
        Block::Paragraph { text, .. } | Block::Code { text } => vec![text.clone()],
        Block::List { items } => items.clone(),
        Block::Entries { entries: all, .. } => entries(all),
        Block::Table(t) => {
            let header = t.columns.iter().map(|c| c.title.clone());
            let cells = t.rows.iter().flatten().map(Cell::text).map(str::to_owned);
            std::iter::once(t.title.clone()).chain(header).chain(cells).collect()
        }
        Block::Figure(_) => Vec::new(),
    };
    let section = |s: &Section| {
        let head = [s.title.clone(), s.remark.clone()];
        head.into_iter().chain(s.blocks.iter().flat_map(block)).collect::<Vec<_>>()
    };
    std::iter::once(page.title.clone())
        .chain(entries(&page.subject))
        .chain(page.sections.iter().flat_map(section))
        .filter(|part| !plain(part).is_empty())
        .collect()
}

fn assert_says(what: &str, medium: &str, text: &str, parts: &[String]) {
    let text = plain(text);
    for part in parts {
        assert!(text.contains(&plain(part)), "{what}: {medium} does not say: {part}");
    }
}

#[test]
fn every_medium_says_everything_the_page_says() {
    for (case, words, with_charts) in DIAGNOSES.iter().chain(&*COMPARISONS) {
        let said = parts(words);
        assert!(said.len() > 60, "{case}: {} parts", said.len());
        let verbose = Terminal { verbose: true, ..Terminal::default() };
        assert_says(case, "the terminal", &terminal(words, verbose), &words_of(&said));
        assert_says(case, "Markdown", &markdown(words), &said);
        assert_says(case, "HTML", &readable(&html(with_charts).unwrap()), &said);
        let json = serde_json::to_value(words).unwrap();
        let strings = texts(&json).join(" ");
        assert_says(case, "JSON", &strings, &said);
    }
}

/// Single words: in the columns of a terminal the parts of a page break into lines beside each other.
fn words_of(parts: &[String]) -> Vec<String> {
    parts.iter().flat_map(|part| part.split([' ', '.'])).map(str::to_owned).collect()
}

fn texts(value: &serde_json::Value) -> Vec<String> {
    match value {
        serde_json::Value::String(text) => vec![text.clone()],
        serde_json::Value::Array(all) => all.iter().flat_map(texts).collect(),
        serde_json::Value::Object(all) => all.values().flat_map(texts).collect(),
        _ => Vec::new(),
    }
}

#[test]
fn html_says_no_less_than_the_terminal() {
    for (case, words, with_charts) in &*DIAGNOSES {
        let html = plain(&readable(&html(with_charts).unwrap()));
        for line in terminal(words, Terminal::default()).lines().filter(|l| !l.contains("--verbose")) {
            for word in line.split_whitespace().map(plain).filter(|w| !w.is_empty()) {
                assert!(html.contains(&word), "{case}: HTML lacks `{word}` of: {line}");
            }
        }
    }
}

#[test]
fn warnings_and_promises_reach_the_page_that_is_mailed_around() {
    let promised = [
        (
            "not-in-catalogue",
            "These values are biased by what is missing: the uncertainties include only what remains unexplained in each leg.",
        ),
        ("paper-protocol", "is expected to give odds of 20:1 against the wrong one"),
    ];
    for (case, _, page) in &*DIAGNOSES {
        let html = readable(&html(page).unwrap());
        for (_, sentence) in promised.iter().filter(|(of, _)| of == case) {
            assert!(plain(&html).contains(&plain(sentence)), "{case}: {sentence}");
        }
    }
}

#[test]
fn anchors_of_a_page_are_its_own() {
    for (case, _, page) in DIAGNOSES.iter().chain(&*COMPARISONS) {
        let mut ids: Vec<&str> = page.sections.iter().map(|s| s.id.as_str()).collect();
        let all = ids.len();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), all, "{case}: {ids:?}");
    }
}
