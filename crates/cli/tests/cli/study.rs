//! `hexbench study`: runs that are killed, threads, pages, and everything that can be wrong.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use crate::support::{hexbench, root, text};

/// Six shards; the machine changes often enough that a run is not over before it can be killed.
const KILLED: &str = "format = \"study/1\"\ntitle = \"killed\"\nseed = 3\ntrials = 2900\ntask = \"springs\"\nredraw = 20\n\
                      [axes]\ngeometry = [\"ring_a\"]\nplan = [\"random\"]\nposes = [3]\nnoise_scale = [1, 2]\n";

fn write(folder: &Path, text: &str) -> PathBuf {
    let path = folder.join("study.toml");
    fs::write(&path, text).unwrap();
    path
}

fn study(file: &Path, out: &Path) -> assert_cmd::Command {
    let mut command = hexbench();
    command.arg("study").arg(file).arg("-o").arg(out);
    command
}

fn results(out: &Path) -> [Vec<u8>; 3] {
    ["trials.parquet", "cells.csv", "study.md"].map(|name| fs::read(out.join(name)).unwrap())
}

fn records(out: &Path) -> usize {
    let Ok(entries) = fs::read_dir(out.join("journal")) else { return 0 };
    entries.filter(|e| e.as_ref().unwrap().path().extension().is_some_and(|e| e == "shard")).count()
}

fn begin(file: &Path, out: &Path) -> Child {
    Command::new(env!("CARGO_BIN_EXE_hexbench"))
        .arg("study")
        .arg(file)
        .arg("-o")
        .arg(out)
        .env("RAYON_NUM_THREADS", "1")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// Kills a run as soon as the journal holds so many records.
fn kill_at(file: &Path, out: &Path, wanted: usize) {
    let mut child = begin(file, out);
    while records(out) < wanted && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    let _ = child.kill();
    child.wait().unwrap();
}

#[test]
fn a_study_killed_three_times_ends_with_the_bytes_of_an_unbroken_one_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let file = write(folder.path(), KILLED);
    let [whole, killed] = ["whole", "killed"].map(|name| folder.path().join(name));
    study(&file, &whole).env("RAYON_NUM_THREADS", "2").assert().success();
    for wanted in [1, 2, 4] {
        kill_at(&file, &killed, wanted);
    }
    assert!(!killed.join("trials.parquet").exists(), "the run was over before it could be killed");
    // As a crash of the whole machine may leave it.
    let torn = killed.join("journal/00000000.shard");
    let bytes = fs::read(&torn).unwrap();
    fs::write(&torn, &bytes[..bytes.len() - 7]).unwrap();
    let told = study(&file, &killed).env("RAYON_NUM_THREADS", "1").output().unwrap();
    let stderr = String::from_utf8(told.stderr).unwrap();
    assert!(stderr.contains("1 damaged record"), "{stderr}");
    assert!(results(&whole) == results(&killed), "the files differ");
}

#[test]
fn a_study_reads_as_before_and_its_charts_exist() {
    let folder = tempfile::tempdir().unwrap();
    let file = write(
        folder.path(),
        "format = \"study/1\"\ntitle = \"Noise and poses\"\nseed = 1\ntrials = 200\ntask = \"springs\"\n\
         [axes]\ngeometry = [\"ring_a\"]\nplan = [\"random\", \"rich\"]\nposes = [3, 6, 12]\nnoise_scale = [1, 2]\n",
    );
    let [out, page] = ["out", "page/study.md"].map(|name| folder.path().join(name));
    let shown = text(study(&file, &out).arg("--markdown").arg(&page).output().unwrap());
    let shown = shown.replace(&folder.path().display().to_string(), "FOLDER");
    assert!(shown.lines().all(|l| l.chars().count() <= 80), "{shown}");
    insta::assert_snapshot!("study", shown);
    for page in [out.join("study.md"), page] {
        let markdown = fs::read_to_string(&page).unwrap();
        let charts: Vec<&str> = markdown
            .split("](")
            .skip(1)
            .filter_map(|rest| rest.split_once(')'))
            .map(|(path, _)| path)
            .collect();
        assert!(charts.len() >= 3, "{charts:?}");
        for chart in charts {
            assert!(page.parent().unwrap().join(chart).is_file(), "{chart}");
        }
    }
}

#[test]
fn the_page_for_a_browser_has_the_words_of_the_page_and_its_charts_inside() {
    let folder = tempfile::tempdir().unwrap();
    let file = write(
        folder.path(),
        "format = \"study/1\"\ntitle = \"Spread <wide>\"\nseed = 1\ntrials = 100\ntask = \"springs\"\n\
         [design]\nkind = \"latin-hypercube\"\npoints = 8\n[axes]\ngeometry = [\"ring_a\", \"ring_b\"]\nplan = [\"random\"]\n\
         poses = { from = 3, to = 12 }\nnoise_scale = { from = 0.5, to = 4, scale = \"log\" }\n",
    );
    let out = folder.path().join("out");
    let shown = text(study(&file, &out).output().unwrap());
    assert!(shown.contains("study.html") && shown.contains("What results follow"), "{shown}");
    let html = fs::read_to_string(out.join("study.html")).unwrap();
    let markdown = fs::read_to_string(out.join("study.md")).unwrap();
    assert!(html.contains("Spread &lt;wide&gt;") && !html.contains("<wide>"));
    let charts = markdown.matches("](charts/").count();
    assert!(charts >= 3 && html.matches("<svg").count() == charts, "{charts}");
    for line in markdown.lines().filter(|line| line.starts_with("## ")) {
        assert!(html.contains(&line[3..]), "{line}");
    }
    let cells = fs::read_to_string(out.join("cells.csv")).unwrap();
    assert_eq!(cells.lines().count(), 1 + 2 * 8, "{cells}");
}

#[test]
fn a_study_of_the_diagnosis_counts_what_became_of_the_truth() {
    let folder = tempfile::tempdir().unwrap();
    let file = write(
        folder.path(),
        "format = \"study/1\"\ntitle = \"Creep\"\nseed = 1\ntrials = 4\ntask = \"diagnose\"\n[axes]\n\
         geometry = [\"ring_a\"]\nplan = [\"few-poses\"]\neffect = [\"thermal-expansion\"]\nsize_sigmas = [0, 30]\n",
    );
    let out = folder.path().join("out");
    let page = text(study(&file, &out).output().unwrap());
    assert!(page.contains("right, %") && page.contains("size of the effect"), "{page}");
    let cells = fs::read_to_string(out.join("cells.csv")).unwrap();
    assert!(
        cells.lines().next().unwrap().contains(",seen,seen_low,seen_high,right,right_low,right_high,"),
        "{cells}"
    );
}

#[test]
fn the_bundled_studies_can_be_read() {
    let all = fs::read_dir(root().join("data/studies")).unwrap().map(|e| e.unwrap().path());
    let files: Vec<PathBuf> = all.filter(|p| p.extension().is_some_and(|e| e == "toml")).collect();
    assert!(!files.is_empty());
    for file in files {
        hexbench_experiments::sweep::SweepStudy::read(&file).unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn the_example_of_the_page_on_formats_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let formats = fs::read_to_string(root().join("docs/reference/file-formats.md")).unwrap();
    let example = formats.split("```toml\nformat = \"study/1\"").nth(1).unwrap();
    let file = write(folder.path(), &format!("format = \"study/1\"{}", example.split("```").next().unwrap()));
    for (from, to) in
        [("scenes/paper/hexapod.toml", "hexapod.toml"), ("data/designs/paper-space.toml", "space.toml")]
    {
        fs::copy(root().join(from), folder.path().join(to)).unwrap();
    }
    let study =
        hexbench_experiments::sweep::SweepStudy::read(&file).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(study.axes.cells(), 2 * 2 * 3 * 3);
    assert_eq!(study.inputs.len(), 3, "{:?}", study.inputs);
}

/// A file that must be refused: what is wrong, its text, exit code, parts of the message.
struct Bad {
    what: &'static str,
    text: String,
    code: i32,
    says: &'static [&'static str],
}

/// A good study with a part exchanged.
fn with(old: &str, new: &str) -> String {
    assert!(GOOD.contains(old), "{old}");
    GOOD.replacen(old, new, 1)
}

const GOOD: &str = "format = \"study/1\"\ntitle = \"good\"\nseed = 1\ntrials = 10\ntask = \"springs\"\n\n[axes]\n\
                    geometry = [\"ring_a\"]\nplan = [\"O1\", \"random\"]\nposes = [3, 6]\nnoise_scale = [1]\n";

fn bad(what: &'static str, text: String, says: &'static [&'static str]) -> Bad {
    Bad { what, text, code: 3, says }
}

fn all_bad() -> Vec<Bad> {
    let effect = |axes: &str| with("noise_scale = [1]\n", axes);
    vec![
        bad("empty file", String::new(), &["the format must be \"study/1\""]),
        bad("not TOML", with("[axes]", "[axes"), &["line 7", "not valid TOML"]),
        bad("another format", with("study/1", "study/2"), &["line 1, column 10", "\"study/2\""]),
        bad("unknown key", with("trials = 10", "trails = 10"), &["line 4, column 1", "\"trials\" is meant"]),
        bad("unknown axis", with("noise_scale", "noise"), &["line 11, column 1 (noise)", "unknown key"]),
        bad("no axes", GOOD[..GOOD.find("[axes]").unwrap()].to_owned(), &["the key \"axes\" is missing"]),
        bad("no seed", with("seed = 1\n", ""), &["the key \"seed\" is missing"]),
        bad("unknown task", with("\"springs\"", "\"spring\""), &["line 5, column 8", "Write \"springs\"."]),
        bad("no trial", with("trials = 10", "trials = 0"), &["line 4, column 10", "whole number from 1"]),
        bad("too many trials", with("trials = 10", "trials = 900000000"), &["line 4", "at most 10^9"]),
        bad("empty list", with("[3, 6]", "[]"), &["line 10, column 9", "the list of an axis is empty"]),
        bad(
            "one value instead of a list",
            with("[3, 6]", "3"),
            &["line 10, column 9", "a list in square brackets"],
        ),
        bad("value twice", with("[3, 6]", "[3, 3]"), &["line 10, column 13", "twice"]),
        bad("no poses at all", with("[3, 6]", "[0]"), &["line 10, column 10", "whole number from 1"]),
        bad("too many poses", with("[3, 6]", "[3, 5000]"), &["line 10, column 13", "at most 200"]),
        bad("unknown family", with("ring_a", "ring_d"), &["line 8, column 13", "no family of machines"]),
        bad("unknown plan", with("\"random\"", "\"randon\""), &["line 9, column 15", "Write \"random\"."]),
        bad("plan of absolute poses", with("\"random\"", "\"absolute\""), &["line 9", "not absolute poses"]),
        bad(
            "poses with a plan that has its own",
            with("\"random\"", "\"paper\""),
            &["line 9, column 15", "its own poses"],
        ),
        bad(
            "designed plan without poses",
            with("poses = [3, 6]\n", ""),
            &["line 9, column 9", "needs a number of poses"],
        ),
        bad(
            "unknown effect",
            effect("effect = [\"base-complience\"]\n"),
            &["line 11, column 11", "Write \"base-compliance\"."],
        ),
        bad(
            "effect without deflections",
            effect("effect = [\"leg-offset\"]\n"),
            &["line 11", "shows only in absolute poses"],
        ),
        bad("size without effect", effect("size_sigmas = [5]\n"), &["line 11, column 15", "no effect"]),
        bad(
            "size of no effect",
            effect("effect = [\"none\"]\nsize_sigmas = [5]\n"),
            &["line 11, column 11", "add 0 to the sizes"],
        ),
        bad(
            "size in two ways",
            effect("effect = [\"creep\"]\nsize_sigmas = [5]\nsize_factor = [1]\n"),
            &["line 13, column 15", "size_sigmas too"],
        ),
        bad(
            "negative size",
            effect("effect = [\"creep\"]\nsize_factor = [-1]\n"),
            &["line 12, column 16", "cannot be negative"],
        ),
    ]
    .into_iter()
    .chain(bad_sizes_in_units())
    .chain(bad_questions())
    .chain(bad_sets_and_ranges())
    .chain(bad_noise_and_estimators())
    .chain(missing_files())
    .collect()
}

fn bad_sizes_in_units() -> Vec<Bad> {
    let effect = |axes: &str| with("noise_scale = [1]\n", axes);
    vec![
        bad(
            "size in the unit of another effect",
            effect("effect = [\"base-compliance\", \"creep\"]\nsize_nm_per_N = [2]\n"),
            &["line 11, column 30", "in %, not in nm/N", "{ id = \"creep\", size_percent"],
        ),
        bad(
            "size of an effect outside the catalogue",
            effect("effect = [\"out:cable\"]\nsize_um = [2]\n"),
            &["line 11, column 11", "outside the catalogue"],
        ),
        bad(
            "size in two units",
            effect("effect = [\"creep\"]\nsize_um = [1]\nsize_percent = [1]\n"),
            &["line 13, column 16", "size_um too"],
        ),
        bad(
            "an axis of sizes beside a size of its own",
            effect("effect = [{ id = \"creep\", size_percent = 9 }]\nsize_sigmas = [5]\n"),
            &["line 11, column 11", "creep has a size of its own", "size_factor multiplies"],
        ),
        bad(
            "a size of its own in another unit",
            effect("effect = [[{ id = \"creep\", size_um = 9 }, \"base-compliance\"]]\n"),
            &["line 11, column 38", "the size of creep is in %, not in um"],
        ),
        bad(
            "an unknown key of an effect",
            effect("effect = [{ id = \"creep\", size_percents = 9 }]\n"),
            &["line 11, column 27", "unknown key", "Write size_percent."],
        ),
        bad(
            "a law of one's own without its formula",
            effect("effect = [\"out:formula\"]\n"),
            &["line 11, column 11", "needs its formula"],
        ),
        bad(
            "a formula that is not closed",
            effect("effect = [{ id = \"out:formula\", elongation = \"2*(f\" }]\n"),
            &["line 11, column 46", "not closed"],
        ),
        bad(
            "the same law twice",
            effect("effect = [{ id = \"creep\", size_percent = 9 }, { size_percent = 9, id = \"creep\" }]\n"),
            &["line 11, column 47", "in the list twice"],
        ),
    ]
}

fn bad_questions() -> Vec<Bad> {
    let asked = |rest: &str| format!("{GOOD}{rest}");
    let diagnosed = |rest: &str| {
        asked(rest).replace("springs", "diagnose").replace("noise_scale = [1]", "effect = [\"creep\"]")
    };
    vec![
        bad("no question", asked("[question]\n"), &["the question is missing", "see = 0.9"]),
        bad(
            "two questions",
            diagnosed("[question]\nsee = 0.9\nname = 0.5\n"),
            &["line 14, column 8", "a study has one question"],
        ),
        bad(
            "question of another task",
            asked("[question]\nsee = 0.9\n"),
            &["line 13", "task = \"diagnose\""],
        ),
        bad("a share beyond 1", diagnosed("[question]\nsee = 90\n"), &["line 13, column 7", "0.9"]),
        bad(
            "a question without hidden effects",
            asked("[question]\nsee = 0.9\n").replace("springs", "diagnose"),
            &["line 13, column 7", "no effect is hidden"],
        ),
        bad("an error of zero", asked("[question]\nerror_percent = 0\n"), &["line 13", "greater than zero"]),
        bad(
            "an index of another quantity",
            asked("[question]\nindex = \"O1\"\n"),
            &["line 13", "index = \"error\""],
        ),
        bad(
            "indices neither true nor false",
            with("seed = 1", "seed = 1\nindices = 1"),
            &["line 4", "true or false"],
        ),
        bad(
            "precision without a question",
            with("seed = 1", "seed = 1\nuntil = { half_width = 0.03 }"),
            &["line 4, column 9", "there is no question"],
        ),
        bad(
            "trials that are not a multiple of the step",
            diagnosed("[question]\nsee = 0.9\n")
                .replace("seed = 1", "seed = 1\nuntil = { half_width = 0.03 }"),
            &["line 5, column 10", "a multiple of 16", "Write 16."],
        ),
        bad(
            "unknown laboratory fault",
            with("noise_scale = [1]", "effect = [\"creep\"]\nlaboratory = [\"joints\"]")
                .replace("springs", "diagnose"),
            &["line 12, column 15", "there is no laboratory fault with this name"],
        ),
        bad(
            "laboratory fault with task springs",
            with("noise_scale = [1]", "laboratory = [\"joints-0.1mm\"]"),
            &["line 11, column 14", "does not support laboratory faults"],
        ),
        bad(
            "cost below zero",
            asked("[cost]\nreading_s = -1\n"),
            &["line 13, column 13", "greater than zero"],
        ),
    ]
}

fn bad_sets_and_ranges() -> Vec<Bad> {
    let effect = |axes: &str| with("noise_scale = [1]\n", axes);
    let spread =
        |axes: &str| effect(axes).replace("[axes]", "[design]\nkind = \"sobol\"\npoints = 8\n[axes]");
    vec![
        bad(
            "a set of one effect",
            effect("effect = [[\"creep\"]]\n"),
            &["line 11, column 11", "2 to 4 effects can be hidden together"],
        ),
        bad(
            "none in a set of effects",
            effect("effect = [[\"creep\", \"none\"]]\n"),
            &["line 11, column 21", "\"none\" is not an effect"],
        ),
        bad(
            "the same effect twice in a set",
            effect("effect = [[\"creep\", \"creep\"]]\n"),
            &["line 11, column 21", "in the set twice"],
        ),
        bad(
            "the same set in another order",
            effect("effect = [[\"creep\", \"joint-friction\"], [\"joint-friction\", \"creep\"]]\n"),
            &["line 11, column 40", "in the list twice"],
        ),
        bad(
            "a set with an effect of another unit",
            effect("effect = [[\"base-compliance\", \"creep\"]]\nsize_nm_per_N = [2]\n"),
            &["line 11, column 31", "in %, not in nm/N"],
        ),
        bad(
            "a range without points",
            effect("noise_scale = { from = 1, to = 2 }\n"),
            &["line 11, column 15", "there is no [design]"],
        ),
        bad("points without a range", spread("noise_scale = [1]\n"), &["line 7", "no axis is a range"]),
        bad(
            "unknown design",
            spread("noise_scale = { from = 1, to = 2 }\n").replace("\"sobol\"", "\"soboll\""),
            &["line 8, column 8", "Write \"sobol\"."],
        ),
        bad(
            "one point",
            spread("noise_scale = { from = 1, to = 2 }\n").replace("points = 8", "points = 1"),
            &["line 9, column 10", "whole number from 2"],
        ),
        bad(
            "a range that falls",
            spread("noise_scale = { from = 2, to = 1 }\n"),
            &["line 14, column 32", "a range must rise, but from is 2"],
        ),
        bad(
            "a logarithmic range from zero",
            spread("effect = [\"creep\"]\nsize_factor = { from = 0, to = 4, scale = \"log\" }\n"),
            &["line 15, column 43", "cannot begin at zero"],
        ),
        bad(
            "noise from zero",
            spread("noise_scale = { from = 0, to = 1 }\n"),
            &["line 14, column 24", "greater than zero"],
        ),
        bad(
            "unknown scale of a range",
            spread("noise_scale = { from = 1, to = 2, scale = \"logs\" }\n"),
            &["line 14, column 43", "Write \"log\"."],
        ),
        bad(
            "a question over a range of noise",
            spread("noise_scale = { from = 1, to = 2 }\n") + "[question]\nerror_percent = 2\n",
            &["line 15", "cannot be a range"],
        ),
        bad(
            "a negative tolerance",
            effect("tolerance_scale = [-1]\n"),
            &["line 11, column 20", "cannot be negative"],
        ),
        bad(
            "tolerances of full poses",
            effect("tolerance_scale = [1]\n").replace("\"ring_a\"", "\"gauges.toml\""),
            &["line 11", "these errors apply to full poses only"],
        ),
    ]
}

fn bad_noise_and_estimators() -> Vec<Bad> {
    let effect = |axes: &str| with("noise_scale = [1]\n", axes);
    vec![
        bad("noise of zero", with("[1]", "[0]"), &["line 11, column 16", "greater than zero"]),
        bad(
            "noise in two ways",
            effect("noise_scale = [1]\nnoise_um_urad = [[1, 2]]\n"),
            &["line 12", "noise_scale too"],
        ),
        bad(
            "one level of noise",
            effect("noise_um_urad = [[1]]\n"),
            &["line 11, column 18", "two standard deviations"],
        ),
        bad(
            "unknown estimator",
            effect("estimator = [\"ols\"]\n"),
            &["line 11, column 14", "there is no estimator with this name"],
        ),
        bad(
            "estimator of a diagnosis",
            effect("estimator = [\"gls\"]\n").replace("springs", "diagnose"),
            &["line 11", "its own estimator"],
        ),
        bad(
            "pose noise of sensors",
            effect("noise_um_urad = [[1, 2]]\n").replace("\"ring_a\"", "\"gauges.toml\""),
            &["line 11", "whose noise this key does not state"],
        ),
        bad(
            "estimator of full poses",
            effect("estimator = [\"gls\", \"paper\"]\n").replace("\"ring_a\"", "\"gauges.toml\""),
            &["line 11, column 21", "needs full poses"],
        ),
    ]
}

fn missing_files() -> Vec<Bad> {
    vec![
        Bad {
            what: "missing hexapod file",
            text: with("ring_a", "none.toml"),
            code: 5,
            says: &["none.toml", "no such file"],
        },
        Bad {
            what: "missing plan",
            text: with("\"O1\", \"random\"]\nposes = [3, 6]", "\"none.csv\"]"),
            code: 5,
            says: &["none.csv", "no such file"],
        },
        Bad {
            what: "missing space",
            text: with("trials", "space = \"none.toml\"\ntrials"),
            code: 5,
            says: &["none.toml", "no such file"],
        },
    ]
}

/// The granite machine with the gauges of its scene.
fn machine_with_gauges() -> String {
    let read = |name: &str| fs::read_to_string(root().join("scenes/granite").join(name)).unwrap();
    let scene = read("scene.toml");
    let sensors = scene.lines().skip_while(|line| *line != "[[sensor]]");
    let other = |line: &&str| !line.starts_with('[') || *line == "[[sensor]]";
    read("hexapod.toml") + &sensors.take_while(other).collect::<Vec<_>>().join("\n") + "\n"
}

/// Exit code and standard error.
fn refused(command: &mut assert_cmd::Command) -> (Option<i32>, String) {
    let output = command.output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

/// One line of the page for `error: MESSAGE\n  next: STEP\n`.
fn line(what: &str, told: &str, folder: &Path) -> String {
    let told = told.replace(&format!("{}/", folder.display()), "");
    let (message, next) = told.strip_prefix("error: ").unwrap().split_once("\n  next: ").unwrap();
    let cell = |text: &str| text.trim().replace('|', "\\|");
    format!("| {what} | {} | {} |\n", cell(message), cell(next))
}

#[test]
fn every_bad_study_is_told_with_its_place_and_next_step_and_the_page_lists_them() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("gauges.toml"), machine_with_gauges()).unwrap();
    let mut page = BEGINNING.to_owned();
    for bad in all_bad() {
        let file = write(folder.path(), &bad.text);
        let out = folder.path().join("out");
        let (code, told) = refused(&mut study(&file, &out));
        assert_eq!(code, Some(bad.code), "{}: {told}", bad.what);
        for part in bad.says {
            assert!(told.contains(part), "{}: {part} is not in {told}", bad.what);
        }
        assert!(!out.exists(), "{}: a refused study leaves no folder", bad.what);
        page += &line(bad.what, &told, folder.path());
    }
    page += "\n## The folder\n\n| what is wrong | message | next step |\n|---|---|---|\n";
    for (what, code, told) in bad_folders(folder.path()) {
        let told = told.replace(&std::process::id().to_string(), "4711");
        page += &line(what, &told, folder.path());
        assert!(code == Some(3) || code == Some(5) || code == Some(2), "{what}: {code:?} {told}");
    }
    compare(&page);
}

const BEGINNING: &str = "# Messages about studies\n\n\
    Written by `HEXBENCH_BLESS=1 cargo test -p hexbench-cli --test cli study`; do not edit.\n\n\
    What `hexbench study` refuses, what it says, and what to do next. The tests check the same files.\n\nExit code 3; 5 for files that are missing, for the disk and for a folder in use.\n\n\
    ## study.toml\n\n| what is wrong | message | next step |\n|---|---|---|\n";

fn compare(page: &str) {
    let path = root().join("docs/reference/study-messages.md");
    if std::env::var_os("HEXBENCH_BLESS").is_some() {
        fs::write(&path, page).unwrap();
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        kept == page,
        "docs/reference/study-messages.md is stale: run the tests once with HEXBENCH_BLESS=1\n{page}"
    );
}

/// What is wrong, exit code, message.
fn bad_folders(folder: &Path) -> Vec<(&'static str, Option<i32>, String)> {
    let file = write(folder, GOOD);
    let done = folder.join("done");
    study(&file, &done).assert().success();
    let mut all = Vec::new();
    let mut refuse = |what, file: &Path, out: &Path, expected: i32| {
        let (code, told) = refused(&mut study(file, out));
        assert_eq!(code, Some(expected), "{what}: {told}");
        all.push((what, code, told));
    };

    let changed = folder.join("changed.toml");
    fs::write(&changed, GOOD.replace("trials = 10", "trials = 11")).unwrap();
    refuse("study file changed since", &changed, &done, 3);

    let origin = done.join("journal/study.json");
    let said = fs::read_to_string(&origin).unwrap();
    let version = env!("CARGO_PKG_VERSION");
    fs::write(&origin, said.replace(version, "0.0.9")).unwrap();
    refuse("other version of the program", &file, &done, 3);
    fs::write(&origin, said.replace("study-journal/2", "study-journal/9")).unwrap();
    refuse("other format of the journal", &file, &done, 3);
    fs::write(&origin, &said[..20]).unwrap();
    refuse("damaged journal", &file, &done, 3);
    fs::write(&origin, &said).unwrap();

    let lock = fs::File::options().write(true).open(done.join("journal/lock")).unwrap();
    fs::write(done.join("journal/lock"), format!("{}\n", std::process::id())).unwrap();
    lock.lock().unwrap();
    refuse("another run in this folder", &file, &done, 5);
    drop(lock);
    study(&file, &done).assert().success();

    let other = folder.join("other");
    fs::create_dir(&other).unwrap();
    fs::write(other.join("notes.txt"), "mine").unwrap();
    refuse("folder with other files", &file, &other, 2);
    refuse("folder that cannot be created", &file, &other.join("notes.txt/below"), 5);
    all
}

/// The system lets a file grow to one block only: every write beyond fails as on a full disk.
#[cfg(unix)]
#[test]
fn a_full_disk_is_told_nothing_is_lost_and_the_run_goes_on_later() {
    let folder = tempfile::tempdir().unwrap();
    let file = write(folder.path(), KILLED);
    let [whole, full] = ["whole", "full"].map(|name| folder.path().join(name));
    study(&file, &whole).assert().success();
    kill_at(&file, &full, 2);
    let before = records(&full);
    let limited = "trap '' XFSZ; ulimit -f 8; exec \"$0\" study \"$1\" -o \"$2\"";
    let mut shell = assert_cmd::Command::new("sh");
    let (code, told) =
        refused(shell.arg("-c").arg(limited).arg(env!("CARGO_BIN_EXE_hexbench")).arg(&file).arg(&full));
    assert_eq!(code, Some(5), "{told}");
    assert!(
        told.contains(".shard: cannot be written") && told.contains("resumes where it stopped"),
        "{told}"
    );
    assert!(records(&full) >= before);
    let parts = fs::read_dir(full.join("journal")).unwrap().map(|e| e.unwrap().file_name());
    assert!(parts.map(|n| n.to_string_lossy().into_owned()).all(|n| !n.contains(".part")));
    study(&file, &full).assert().success();
    assert!(results(&whole) == results(&full), "the files differ");
}
