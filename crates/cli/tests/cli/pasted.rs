//! Commands on pages work as pasted. A block of `sh` is run and must end well; a block of `console` is a session: commands behind
//! `$ `, which go on behind a `\\`, each followed by what it prints, which is compared. A line `...` in it stands for lines that the
//! page leaves out.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::root;

/// Set to write what commands print into the pages; blocks with `...` are left to a person.
const BLESS: &str = "HEXBENCH_BLESS";
const ELISION: &str = "...";

/// What a user has who cloned the repository, as far as commands on pages need it.
fn clone() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for part in ["data", "scenes"] {
        copy(&root().join(part), &folder.path().join(part));
    }
    folder
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy(&path, &target);
        } else {
            fs::copy(&path, &target).unwrap();
        }
    }
}

/// A shell in which `hexbench` is the command under test.
struct Shell {
    folder: PathBuf,
    path: String,
}

impl Shell {
    fn new(folder: &Path) -> Self {
        let bin = Path::new(env!("CARGO_BIN_EXE_hexbench")).parent().unwrap().display();
        let path = format!("{bin}:{}", std::env::var("PATH").unwrap_or_default());
        Self { folder: folder.to_owned(), path }
    }

    /// What lines of the shell print on both streams.
    fn run(&self, lines: &str) -> String {
        // Building and installing is what has happened here already.
        let here = lines.replace("cargo run --release -- ", "hexbench ");
        let here: Vec<&str> = here.lines().filter(|l| !l.starts_with("cargo install ")).collect();
        let script = format!("exec 2>&1\n{}\n", here.join("\n"));
        let output = Command::new("bash")
            .args(["-euo", "pipefail", "-c", &script])
            .current_dir(&self.folder)
            .env("PATH", &self.path)
            .env_remove("COLUMNS")
            .output()
            .unwrap();
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success(), "{lines}\nended with {}:\n{said}", output.status);
        said
    }
}

/// Pieces of a page: what stands between blocks that are run, and those blocks.
enum Piece<'a> {
    Kept(&'a str),
    Script(&'a str),
    Session(&'a str),
}

fn pieces(page: &str) -> Vec<Piece<'_>> {
    let mut pieces = Vec::new();
    let mut rest = page;
    while let Some(fence) =
        ["```sh\n", "```console\n"].iter().filter_map(|f| rest.find(f).map(|at| (at, *f))).min()
    {
        let start = fence.0 + fence.1.len();
        let end = start + rest[start..].find("```").unwrap();
        pieces.push(Piece::Kept(&rest[..start]));
        let block = &rest[start..end];
        pieces.push(if fence.1 == "```sh\n" { Piece::Script(block) } else { Piece::Session(block) });
        rest = &rest[end..];
    }
    pieces.push(Piece::Kept(rest));
    pieces
}

/// Commands of a session, each with what the page says it prints.
fn commands(session: &str) -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = Vec::new();
    for line in session.lines() {
        if let Some(command) = line.strip_prefix("$ ") {
            all.push((command.to_owned(), String::new()));
            continue;
        }
        let (command, printed) = all.last_mut().unwrap();
        if printed.is_empty() && command.ends_with('\\') {
            *command += "\n";
            *command += line;
        } else {
            *printed += line;
            printed.push('\n');
        }
    }
    all
}

fn tidy(text: &str) -> String {
    let lines: Vec<&str> = text.trim_end().lines().map(str::trim_end).collect();
    if lines.is_empty() { String::new() } else { lines.join("\n") + "\n" }
}

/// Whether a page shows what was printed: the parts between `...` stand in it, in their order.
fn shows(page: &str, printed: &str) -> bool {
    if !page.lines().any(|line| line.trim() == ELISION) {
        return page == printed;
    }
    let lines: Vec<&str> = page.lines().collect();
    let printed: Vec<&str> = printed.lines().collect();
    let mut at = 0;
    for part in lines.split(|line| line.trim() == ELISION).filter(|part| !part.is_empty()) {
        let Some(found) = printed[at..].windows(part.len()).position(|window| window == part) else {
            return false;
        };
        at += found + part.len();
    }
    true
}

/// A session as it goes now; where the page leaves lines out and still shows what is so, as it was.
fn session_now(shell: &Shell, session: &str, page: &str) -> String {
    let mut now = String::new();
    for (command, shown) in commands(session) {
        let printed = tidy(&shell.run(&command));
        let is_right = shows(&shown, &printed);
        let is_cut = shown.lines().any(|line| line.trim() == ELISION);
        assert!(
            is_right || !is_cut,
            "{page}: `{command}` no longer prints what the page shows, but\n{printed}"
        );
        writeln!(now, "$ {command}").unwrap();
        now += if is_right { &shown } else { &printed };
    }
    now
}

/// Runs a page in a folder of a clone, and compares it with what comes.
fn hold(page: &str, folder: &str) {
    let clone = clone();
    let folder = clone.path().join(folder);
    fs::create_dir_all(&folder).unwrap();
    let shell = Shell::new(&folder);
    let path = root().join(page);
    let kept = fs::read_to_string(&path).unwrap();
    let (mut fresh, mut blocks) = (String::new(), 0);
    for piece in pieces(&kept) {
        match piece {
            Piece::Kept(text) => fresh += text,
            Piece::Script(script) => {
                shell.run(script);
                blocks += 1;
                fresh += script;
            }
            Piece::Session(session) => {
                blocks += 1;
                fresh += &session_now(&shell, session, page);
            }
        }
    }
    assert!(blocks > 0, "{page} has no block to run");
    if std::env::var_os(BLESS).is_some() {
        fs::write(&path, &fresh).unwrap();
        return;
    }
    assert!(kept == fresh, "{page} is stale: run the tests once with {BLESS}=1\n{fresh}");
}

#[test]
fn the_documents_first_page_works_as_pasted() {
    hold("README.md", "");
}

#[test]
fn the_documents_tutorial_prints_what_it_shows() {
    hold("docs/guide/tutorial.md", "desk");
}

#[test]
fn the_documents_answers_to_questions_work_as_pasted() {
    hold("docs/guide/how-do-i.md", "");
}

#[test]
fn a_page_that_leaves_lines_out_still_has_to_show_the_rest() {
    assert!(shows("a\n...\nc\n", "a\nb\nb\nc\n"));
    assert!(!shows("a\n...\nd\n", "a\nb\nc\n"));
    assert!(!shows("c\n...\na\n", "a\nb\nc\n"));
    assert!(!shows("a\nc\n", "a\nb\nc\n"));
}
