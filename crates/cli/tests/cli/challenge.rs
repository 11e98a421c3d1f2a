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
const NOISE: std::ops::Range<f64> = 0.6..1.5;

struct Bench {
    folder: TempDir,
}

impl Bench {
    /// The tiny suite, made.
    fn new() -> Self {
        Self::of(SUITE)
    }

    fn of(suite: &str) -> Self {
        let bench = Self { folder: tempfile::tempdir().unwrap() };
        fs::write(bench.path("suite.toml"), suite).unwrap();
        bench.make("challenge", &[]).assert().success();
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn make(&self, name: &str, more: &[&str]) -> assert_cmd::Command {
        let mut command = hexbench();
        command
            .args(["challenge", "make"])
            .arg(self.path("suite.toml"))
            .arg("-o")
            .arg(self.path(name))
            .args(more);
        command
    }

    fn run(&self, name: &str, program: &[&str]) -> assert_cmd::Command {
        let mut command = hexbench();
        command.args(["challenge", "run"]).arg(self.path("challenge")).arg("-o").arg(self.path(name));
        command.args(["--name", name, "--"]).args(program);
        command
    }

    fn score(&self, names: &[&str], more: &[&str]) -> Output {
        let mut command = hexbench();
        command.args(["challenge", "score"]).arg(self.path("challenge"));
        command.args(names.iter().map(|name| self.path(name))).args(more);
        command.output().unwrap()
    }

    fn json(&self, names: &[&str]) -> Value {
        serde_json::from_str(&text(self.score(names, &["--json", "-"]))).unwrap()
    }
}

fn own() -> &'static str {
    env!("CARGO_BIN_EXE_hexbench")
}

fn shell() -> String {
    root().join("scripts/entrants/shell_entrant.sh").display().to_string()
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

/// Exit code and page, in one line, of a look at an answer to the first case.
fn linted(bench: &Bench, files: &[(&str, &str)], case: bool) -> (Option<i32>, String) {
    let out = bench.path("out");
    let _ = fs::remove_dir_all(&out);
    fs::create_dir(&out).unwrap();
    for (name, text) in files {
        fs::write(out.join(name), text).unwrap();
    }
    let mut command = hexbench();
    command.args(["challenge", "lint"]).arg(&out);
    if case {
        command.arg("--case").arg(bench.path("challenge/cases/case-001"));
    }
    let output = command.output().unwrap();
    let page = String::from_utf8(output.stdout).unwrap();
    (output.status.code(), page.split_whitespace().collect::<Vec<_>>().join(" "))
}

#[test]
fn a_look_at_an_answer_says_everything_that_is_wrong_with_its_place_and_what_to_write() {
    let bench = Bench::new();
    let header = "row,da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad";
    let asked = fs::read_to_string(bench.path("challenge/cases/case-001/predict.csv")).unwrap();
    let rows = asked.lines().count() - 1;
    let lines: Vec<String> = (1..=rows).map(|row| format!("{row},1,2,3,4,5,6\n")).collect();
    let good = format!("{header}\n{}", lines.concat());
    let bad = good.replacen("1,1,2,3", "1,nan,x,3", 1).replacen("3,1,2", "2,1e99,2", 1);
    let parameters = "{\"format\": \"parameters/1\", \"parameters\": [\n  {\"name\": \"leg-1.stiffness\", \"value\": 4, \
        \"std\": -1, \"unit\": \"N/m\"},\n  {\"name\": \"leg_2.stiffness\", \"value\": 4, \"unit\": \"N/um\"}]}";
    let diagnosis = "{\"format\": \"diagnosis/1\", \"verdict\": \"named\", \"added\": [\"creap\"], \"candidates\": [\n  \
        {\"term\": \"creep\", \"probability\": 97},\n  {\"term\": \"creep\", \"probability\": 0.03}]}";
    let files = [
        ("predictions.csv", &*bad),
        ("parameters.json", parameters),
        ("diagnosis.json", diagnosis),
        ("prediction.csv", ""),
    ];
    let (code, page) = linted(&bench, &files, true);
    assert_eq!(code, Some(1), "{page}");
    for wanted in [
        "predictions.csv: line 2, column 2 (da_um): \"nan\": NaN and infinity are not predictions. next: Predict something",
        "predictions.csv: line 2, column 3 (db_um): \"x\": this is not a number. next: Write a number with a decimal point",
        "predictions.csv: line 4, column 2 (da_um): \"1e99\": the number is too large",
        "parameters.json: line 2, column 4: parameters[0].std (leg-1.stiffness): -1",
        "parameters.json: line 2, column 4: parameters[0].unit (leg-1.stiffness): \"N/m\"",
        "diagnosis.json: line 2, column 4: candidates[0] (creep): 97: a probability is between 0 and 1. next: Write a share",
        "diagnosis.json: line 3, column 4: candidates[1] (creep): this candidate is given twice",
        "sum to 97.03, not to 1",
        "the folder: prediction.csv: this file is not a part of an answer, and is not read. next: Write \"predictions.csv\"",
    ] {
        assert!(page.contains(wanted), "{wanted} is not in {page}");
    }
    let sound = [
        ("predictions.csv", &*good),
        ("parameters.json", &*parameters.replace("-1", "1").replace("N/m\"", "N/um\"")),
        (
            "diagnosis.json",
            &*diagnosis.replace("97}", "0.97}").replace(
                "\"term\": \"creep\", \"probability\": 0.03",
                "\"term\": \"none\", \"probability\": 0.03",
            ),
        ),
    ];
    for case in [true, false] {
        let (code, page) = linted(&bench, &sound, case);
        assert_eq!(code, Some(0), "{page}");
        for wanted in [
            "The answer can be read and scored",
            "predictions.csv: no standard uncertainties",
            "parameters.json: leg_2.stiffness: this name is not scored. next: Write \"leg-2.stiffness\"",
            "\"creap\" is no effect of the catalogue: it is never right. next: Write \"creep\"",
        ] {
            assert!(page.contains(wanted), "{wanted} is not in {page}");
        }
    }
    let (code, page) = linted(&bench, &[("predictions.csv", &*format!("{header}\n1,1,2,3,4,5,6\n"))], true);
    assert!(
        code == Some(1)
            && page.contains(&format!("{} of {rows} rows are missing, the first is row 2", rows - 1)),
        "{page}"
    );
    let (code, page) = linted(&bench, &[("predictions.csv", "row,da_mm,db_um\n")], true);
    for wanted in [
        "line 1, column 2: unknown column \"da_mm\"",
        "next: Write \"da_um\"",
        "the column dgamma_urad is missing",
    ] {
        assert!(code == Some(1) && page.contains(wanted), "{wanted} is not in {page}");
    }
    let nowhere = hexbench().args(["challenge", "lint"]).arg(bench.path("nowhere")).output().unwrap();
    assert_eq!(nowhere.status.code(), Some(5));
}

/// A scene of one's own: the files of hidden-1, with a machine that is wider and another plan.
fn own_scene(bench: &Bench) {
    let from = root().join("scenes/hidden-1");
    fs::create_dir_all(bench.path("mine/sealed")).unwrap();
    for name in ["hexapod.toml", "scene.toml", "sealed/truth.toml"] {
        let text = fs::read_to_string(from.join(name)).unwrap();
        fs::write(bench.path("mine").join(name), text.replace("poses = 24", "poses = 16")).unwrap();
    }
    fs::create_dir_all(bench.path("gauges")).unwrap();
    let gauges = fs::read_to_string(root().join("scenes/granite/scene.toml")).unwrap();
    fs::create_dir_all(bench.path("gauges/sealed")).unwrap();
    fs::write(bench.path("gauges/scene.toml"), gauges).unwrap();
    for name in ["hexapod.toml", "sealed/truth.toml"] {
        fs::copy(root().join("scenes/granite").join(name), bench.path("gauges").join(name)).unwrap();
    }
}

#[test]
fn scenes_of_ones_own_are_made_run_and_scored() {
    let suite = "format = \"challenge-suite/1\"\nname = \"own\"\nversion = 1\ntitle = \"Own\"\nseed = 4\n\
        [cases.as-it-is]\nscene = \"mine\"\ncount = 2\n\
        [cases.another-effect]\nscene = \"mine\"\ncount = 1\neffects = [\"thermal-expansion\"]\ndistance = 40\n\
        [cases.gauges]\nscene = [\"gauges\"]\ncount = 1\n";
    let bench = Bench { folder: tempfile::tempdir().unwrap() };
    own_scene(&bench);
    fs::write(bench.path("suite.toml"), suite).unwrap();
    bench.make("challenge", &[]).assert().success();
    bench.make("again", &[]).assert().success();
    let read = |name: &str| fs::read_to_string(bench.path(name)).unwrap();
    assert_eq!(read("challenge/challenge.toml"), read("again/challenge.toml"));
    let truths: Vec<Value> = (1..=4)
        .map(|k| serde_json::from_str(&read(&format!("challenge/sealed/case-00{k}/truth.json"))).unwrap())
        .collect();
    let of = |group: &str| truths.iter().filter(|t| t["group"] == group).collect::<Vec<_>>();
    let [one, two] = of("as-it-is")[..] else { panic!("{truths:#?}") };
    assert!(one["machine"] == "mine" && one["effects"] == two["effects"] && one["seed"] != two["seed"]);
    let thermal = of("another-effect")[0];
    assert_eq!(thermal["effects"], serde_json::json!(["thermal-expansion"]));
    assert!((thermal["distance"].as_f64().unwrap() - 40.0).abs() < 0.1, "{thermal}");
    let public = read(&format!("challenge/cases/{}/hexapod.toml", of("gauges")[0]["id"].as_str().unwrap()));
    assert_eq!(public.matches("[[sensor]]").count(), 6);
    for word in ["mine", "hidden", "granite", "sealed"] {
        assert!(!public.contains(word), "{word} is told: {public}");
    }
    bench.run("ours", &[own(), "challenge", "answer"]).assert().success();
    let all = &bench.json(&["ours"])["entrants"][0]["all"];
    assert_eq!(
        (&all["answered"], &all["outcomes"]),
        (&serde_json::json!(4), &serde_json::json!([4, 0, 0])),
        "{all:#}"
    );
    assert!(NOISE.contains(&all["chi2_reduced"].as_f64().unwrap()), "{all:#}");
}

#[test]
fn a_scene_that_is_none_and_keys_that_it_decides_are_told_with_their_line() {
    let bench = Bench { folder: tempfile::tempdir().unwrap() };
    own_scene(&bench);
    let head = "format = \"challenge-suite/1\"\nname = \"own\"\nversion = 1\ntitle = \"Own\"\nseed = 4\n";
    for (group, wanted) in [
        ("scene = \"nowhere\"\ncount = 1", "there is no scene.toml in the folder"),
        ("scene = []\ncount = 1", "the list is empty"),
        ("scene = \"mine\"\nkind = \"single\"\ncount = 1", "the scene decides the kind"),
        ("scene = \"mine\"\nmachine = \"ring_a\"\ncount = 1", "the scene decides the machine"),
        ("scene = \"mine\"\ndistance = 5\ncount = 1", "the effects of the scene have their own sizes"),
    ] {
        fs::write(bench.path("suite.toml"), format!("{head}[cases.a]\n{group}\n")).unwrap();
        let output = bench.make("x", &[]).output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(
            output.status.code() == Some(3) && error.contains(wanted) && error.contains("line "),
            "{group}: {error}"
        );
    }
}
