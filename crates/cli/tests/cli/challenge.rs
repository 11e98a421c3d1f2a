//! `hexbench challenge`: made, run and scored by the command, with its own entrants.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use serde_json::Value;
use tempfile::TempDir;

use crate::support::{hexbench, root, text};

const SUITE: &str = "format = \"challenge-suite/1\"\nname = \"tiny\"\nversion = 3\ntitle = \"Small\"\nseed = 4\n\
    [cases.clean]\nkind = \"clean\"\ncount = 1\nplan = \"few-poses\"\nmachine = \"ring_a\"\n\
    [cases.one]\nkind = \"single\"\ncount = 1\neffects = [\"base-compliance\"]\ndistance = 30\nplan = \"few-poses\"\nmachine = \"ring_a\"\n";

/// Reduced chi-square of 180 numbers: 1, give or take.
pub(crate) const NOISE: std::ops::Range<f64> = 0.6..1.5;

pub(crate) struct Bench {
    pub(crate) folder: TempDir,
}

impl Bench {
    /// The tiny suite, made.
    pub(crate) fn new() -> Self {
        Self::of(SUITE)
    }

    pub(crate) fn of(suite: &str) -> Self {
        let bench = Self { folder: tempfile::tempdir().unwrap() };
        fs::write(bench.path("suite.toml"), suite).unwrap();
        bench.make("challenge", &[]).assert().success();
        bench
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn make(&self, name: &str, more: &[&str]) -> assert_cmd::Command {
        let mut command = hexbench();
        command
            .args(["challenge", "make"])
            .arg(self.path("suite.toml"))
            .arg("-o")
            .arg(self.path(name))
            .args(more);
        command
    }

    pub(crate) fn run(&self, name: &str, program: &[&str]) -> assert_cmd::Command {
        self.run_with(name, &[], program)
    }

    fn run_with(&self, name: &str, more: &[&str], program: &[&str]) -> assert_cmd::Command {
        let mut command = hexbench();
        command.args(["challenge", "run"]).arg(self.path("challenge")).arg("-o").arg(self.path(name));
        command.args(["--name", name]).args(more).arg("--").args(program);
        command
    }

    fn score(&self, names: &[&str], more: &[&str]) -> Output {
        let mut command = hexbench();
        command.args(["challenge", "score"]).arg(self.path("challenge"));
        command.args(names.iter().map(|name| self.path(name))).args(more);
        command.output().unwrap()
    }

    pub(crate) fn json(&self, names: &[&str]) -> Value {
        serde_json::from_str(&text(self.score(names, &["--json", "-"]))).unwrap()
    }
}

pub(crate) fn own() -> &'static str {
    env!("CARGO_BIN_EXE_hexbench")
}

fn shell() -> String {
    root().join("scripts/entrants/shell_entrant.sh").display().to_string()
}

#[test]
fn parts_of_a_run_are_put_together_and_missing_or_other_ones_are_told() {
    let bench = Bench::new();
    let part = |out: &str, more: &[&str], program: &[&str]| {
        let mut command = hexbench();
        command.args(["challenge", "run"]).arg(bench.path("challenge")).arg("-o").arg(bench.path(out));
        command
            .args(["--name", "shell"])
            .args(more.iter().map(|word| word.replace("AT", &bench.path("").display().to_string())));
        command.arg("--").args(program);
        command
    };
    let shell = shell();
    part("whole", &[], &[&shell]).assert().success();
    for number in [1, 2] {
        let told = text(
            part(&format!("part-{number}"), &["--shard", &format!("{number}/2")], &[&shell])
                .output()
                .unwrap(),
        );
        assert!(told.contains("1 cases answered"), "{told}");
    }
    let stderr = |mut command: assert_cmd::Command, code: i32| {
        let output = command.output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{stderr}");
        stderr
    };
    let missing = stderr(part("one", &["--parts", "ATpart-2"], &[&shell]), 3);
    assert!(missing.contains("1 of 2 cases are missing in the folders, the first is case-001"), "{missing}");
    let other =
        stderr(part("other", &["--parts", "ATpart-1", "ATpart-2"], &[own(), "challenge", "answer"]), 2);
    assert!(other.contains("these answers belong to another run: there the program is"), "{other}");
    let told =
        text(part("merged", &["--parts", "ATpart-2", "ATpart-1", "ATpart-2"], &[&shell]).output().unwrap());
    assert!(told.contains("2 answers taken over, 0 were here"), "{told}");
    for case in ["case-001", "case-002"] {
        let read =
            |run: &str| fs::read(bench.path(run).join("cases").join(case).join("predictions.csv")).unwrap();
        assert_eq!(read("merged"), read("whole"), "{case}");
    }
    let figures = |run: &str| bench.json(&[run])["entrants"][0]["all"]["chi2_reduced"].clone();
    assert_eq!(figures("merged"), figures("whole"));
}

#[test]
fn entrants_of_two_languages_stand_side_by_side() {
    let bench = Bench::new();
    bench.run("ours", &[own(), "challenge", "answer"]).assert().success();
    bench.run("paper", &[own(), "challenge", "answer", "--method", "paper"]).assert().success();
    bench.run("shell", &[&shell()]).assert().success();
    let scores = bench.json(&["ours", "paper", "shell"]);
    let of = |k: usize, key: &str| scores["entrants"][k]["all"][key].clone();
    for k in 0..3 {
        assert_eq!(of(k, "answered"), 2, "{scores:#}");
    }
    assert_eq!(of(0, "outcomes"), serde_json::json!([2, 0, 0]));
    assert!(NOISE.contains(&of(0, "chi2_reduced").as_f64().unwrap()), "{}", of(0, "chi2_reduced"));
    assert!(of(1, "outcomes").is_null() && of(2, "stiffness_error").is_null());
    let error = |k: usize| of(k, "error_in_noise").as_f64().unwrap();
    assert!(error(0) < error(1) && error(1) < error(2), "{} {} {}", error(0), error(1), error(2));
    let markdown = bench.path("page.md");
    let page = text(bench.score(&["ours", "shell"], &["--markdown", markdown.to_str().unwrap(), "--check"]));
    assert!(page.contains("cases answered") && page.contains("2 of 2"), "{page}");
    assert!(fs::read_to_string(markdown).unwrap().starts_with("# Challenge tiny, version 3\n"));
    let html = bench.path("board.html");
    text(bench.score(&["shell", "paper", "ours"], &["--html", html.to_str().unwrap()]));
    let board = fs::read_to_string(html).unwrap();
    // Two cases are too few for a curve of power.
    crate::html::assert_sound(&board, "leaderboard", 1);
    let at = |what: &str| board.find(what).unwrap_or_else(|| panic!("{what} is not on the leaderboard"));
    assert!(at(">ours<") < at(">paper<") && at(">paper<") < at(">shell<"), "the best first");
    assert!(at("Do intervals hold?") < at("Side by side"), "charts before figures");
}

#[test]
fn cases_that_gauges_read_are_answered_in_the_motion_of_the_platform() {
    let read_by = |suite: &str| suite.replace("count = 1\n", "count = 1\nread_by = \"six-gauges\"\n");
    let bench = Bench::of(&read_by(SUITE));
    let case = |name: &str| fs::read_to_string(bench.path("challenge/cases/case-001").join(name)).unwrap();
    assert_eq!(case("hexapod.toml").matches("[[sensor]]").count(), 6);
    let header = case("measurements.csv").lines().next().unwrap().to_owned();
    assert!(header.ends_with("z1_um,z2_um,z3_um,t1_um,t2_um,t3_um"), "{header}");
    assert!(!case("predict.csv").contains("z1_um"));
    bench.run("ours", &[own(), "challenge", "answer"]).assert().success();
    bench.run("paper", &[own(), "challenge", "answer", "--method", "paper"]).assert().success();
    let scores = bench.json(&["ours", "paper"]);
    let ours = &scores["entrants"][0]["all"];
    assert_eq!(ours["outcomes"], serde_json::json!([2, 0, 0]), "{scores:#}");
    assert!(NOISE.contains(&ours["chi2_reduced"].as_f64().unwrap()), "{ours:#}");
    // The paper's estimator takes full poses, and says so.
    assert_eq!(scores["entrants"][1]["all"]["answered"], 0, "{scores:#}");
    let told = fs::read_to_string(bench.path("paper/cases/case-001/stderr.txt")).unwrap();
    assert!(told.contains("full poses"), "{told}");
}

#[test]
fn our_entrants_need_the_public_files_of_a_case_and_nothing_else() {
    let bench = Bench::new();
    let [alone, out] = ["alone", "out"].map(|name| bench.path(name));
    fs::create_dir(&out).unwrap();
    fs::rename(bench.path("challenge/cases/case-001"), &alone).unwrap();
    fs::remove_dir_all(bench.path("challenge")).unwrap();
    hexbench().args(["challenge", "answer"]).args([&alone, &out]).assert().success();
    for name in ["parameters.json", "predictions.csv", "diagnosis.json"] {
        assert!(out.join(name).is_file(), "{name}");
    }
    let printed = hexbench().args(["challenge", "answer"]).args([&out, &alone]).output().unwrap();
    let error = String::from_utf8(printed.stderr).unwrap();
    assert!(
        printed.status.code() == Some(5) && error.contains("hexapod.toml: there is no such file"),
        "{error}"
    );
}

#[test]
fn the_command_gives_the_same_bytes_twice_and_others_for_another_seed() {
    let bench = Bench::new();
    bench.make("again", &[]).assert().success();
    bench.make("other", &["--seed", "5"]).assert().success();
    let manifest = |name: &str| fs::read(bench.path(name).join("challenge.toml")).unwrap();
    assert!(manifest("challenge") == manifest("again") && manifest("challenge") != manifest("other"));
    bench.make("again", &[]).assert().code(2);
}

#[test]
fn what_goes_wrong_has_its_exit_code_and_next_step() {
    let bench = Bench::new();
    let failed = |output: Output, code: i32, expected: &str| {
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(code) && error.contains(expected), "{code} {expected}: {error}");
        assert!(error.contains("next: "), "{error}");
    };
    let out = bench.path("x");
    let unknown = hexbench().args(["challenge", "make", "no-such-suite", "-o"]).arg(&out).output().unwrap();
    failed(unknown, 2, "there is no suite \"no-such-suite\"");
    failed(bench.run("x", &["no-such-program"]).output().unwrap(), 2, "there is no program");
    let script = bench.path("solve.py").display().to_string();
    fs::write(&script, "print()").unwrap();
    failed(bench.run("x", &[&script]).output().unwrap(), 2, "solve.py\" is not executable");
    failed(bench.run("x|y", &["sh"]).output().unwrap(), 2, "none of them |");
    failed(bench.score(&["nobody"], &[]), 5, "answers.json: cannot be read");
    fs::write(bench.path("suite.toml"), SUITE.replace("clean\"", "claen\"")).unwrap();
    failed(bench.make("x", &[]).output().unwrap(), 3, "line 7");
    bench.run("none", &["true"]).assert().success();
    let unchecked = text(bench.score(&["none"], &[]));
    assert!(unchecked.contains("0 of 2") && unchecked.contains("it wrote no predictions.csv"), "{unchecked}");
    assert_eq!(bench.score(&["none"], &["--check"]).status.code(), Some(1));
    spoil(&bench.path("challenge/sealed/case-002/truth.json"));
    failed(bench.score(&["none"], &[]), 3, "truth.json: it was changed");
}

#[test]
fn a_run_tells_what_failed_before_and_can_fail_with_it() {
    let bench = Bench::new();
    let again = "Cases that failed before were not run again; --again answers all cases anew.";
    let first = text(bench.run("none", &["true"]).output().unwrap());
    assert!(first.starts_with("none: 0 cases answered, 2 failed, 0 answered before.\n"), "{first}");
    assert!(!first.contains(again), "{first}");
    let checked = bench.run_with("none", &["--check"], &["true"]).output().unwrap();
    let told = String::from_utf8(checked.stdout).unwrap();
    let head = "none: 0 cases answered, 0 failed, 2 answered before, of which 2 failed.\n";
    assert!(told.starts_with(head), "{told}");
    assert!(told.contains("case-002: it wrote no predictions.csv") && told.contains(again), "{told}");
    assert_eq!(checked.status.code(), Some(1));
    bench.run_with("shell", &["--check"], &[&shell()]).assert().success();
}

#[test]
fn the_page_of_one_program_compares_it_with_nobody() {
    let bench = Bench::new();
    bench.run("shell", &[&shell()]).assert().success();
    bench.run("other", &[&shell()]).assert().success();
    let [one, two] = [&["shell"][..], &["shell", "other"]].map(|names| text(bench.score(names, &[])));
    for of_several in ["times the best", "above the best", "than the first", "between equals"] {
        assert!(!one.contains(of_several) && two.contains(of_several), "{of_several}\n{one}");
    }
    // The shell states no diagnosis.
    assert!(!one.contains("Right / honest / wrong."), "{one}");
}

fn spoil(path: &Path) {
    let text = fs::read_to_string(path).unwrap();
    fs::write(path, text.replace("\"kind\"", "\"kin\"")).unwrap();
}

#[test]
fn the_documented_formats_are_those_of_the_bundled_contract() {
    let page = fs::read_to_string(root().join("docs/guide/challenges.md")).unwrap();
    let contract = fs::read_to_string(root().join("crates/experiments/src/challenge/entrants.md")).unwrap();
    for block in contract.split("```").skip(1).step_by(2).filter(|b| b.starts_with("json")) {
        assert!(page.contains(block.trim()), "docs/guide/challenges.md lacks {block}");
    }
}
