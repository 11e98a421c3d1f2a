//! `gate`: baselines, exit codes, files; programs that stay as they are, programs that are edited.

use std::fs;
use std::path::PathBuf;
use std::process::Output;

use serde_json::Value;
use tempfile::TempDir;

use crate::support::{complaint, hexbench, text};

/// Many small cases of springs alone, and one that gauges read.
const SUITE: &str = "format = \"challenge-suite/1\"\nname = \"small\"\nversion = 1\ntitle = \"Small\"\nseed = 4\n\
    [cases.clean]\nkind = \"clean\"\ncount = 32\nplan = \"paper\"\nmachine = \"ring_a\"\n";
const GAUGES: &str = "format = \"challenge-suite/1\"\nname = \"gauges\"\nversion = 1\ntitle = \"Gauges\"\nseed = 4\n\
    [cases.gauges]\nkind = \"clean\"\ncount = 2\nplan = \"few-poses\"\nmachine = \"ring_a\"\nread_by = \"six-gauges\"\n";

/// Constant answers: stiffnesses with an uncertainty, predictions of no motion. `$stiffness` is what an edit changes.
const SOLVE: &str = r#"
stiffness=40; jitter=0
. "$(dirname "$0")/settings.sh"
awk -F, -v j="$jitter" 'NR == 1 { print "row,da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad" }
    NR > 1 { printf "%s,%s,0,0,0,0,0\n", $1, j }' "$1/predict.csv" > "$2/predictions.csv"
{
    printf '{"format": "parameters/1", "parameters": ['
    for leg in 1 2 3 4 5 6; do
        [ $leg = 1 ] || printf ', '
        printf '{"name": "leg-%s.stiffness", "value": %s, "std": 20, "unit": "N/um"}' $leg "$stiffness"
    done
    printf ']}\n'
} > "$2/parameters.json"
"#;
/// An edit that makes one of 32 answers, 3 %, confidently wrong.
const ONE_WRONG: &str = "grep -q '\"case-007\"' \"$1/hexapod.toml\" && stiffness=900\n";

struct Bench {
    folder: TempDir,
}

impl Bench {
    fn new() -> Self {
        let bench = Self { folder: tempfile::tempdir().unwrap() };
        bench.write("suite.toml", SUITE);
        bench.write("solve.sh", SOLVE);
        bench.write("settings.sh", "");
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    fn gate(&self, words: &[&str]) -> Output {
        hexbench().current_dir(self.folder.path()).arg("gate").args(words).output().unwrap()
    }

    fn record(&self, more: &[&str]) -> String {
        let words = [
            &["record", "suite.toml", "--depends", "settings.sh", "--jobs", "4"],
            more,
            &["--", "sh", "solve.sh"],
        ];
        text(self.gate(&words.concat()))
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_str(&fs::read_to_string(self.path(name)).unwrap()).unwrap()
    }
}

fn one_line(page: &[u8]) -> String {
    String::from_utf8_lossy(page).split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn a_program_that_answers_no_case_is_not_recorded() {
    let bench = Bench::new();
    bench.write("solve.sh", "exit 7\n");
    let refused = bench.gate(&["record", "suite.toml", "--jobs", "4", "--", "sh", "solve.sh"]);
    assert_eq!(refused.status.code(), Some(3), "{}", complaint(&refused));
    assert!(complaint(&refused).contains("answered no case"), "{}", complaint(&refused));
    assert!(!bench.path("hexbench-gate.json").exists());
}

#[test]
fn an_unchanged_program_passes_and_an_edit_that_makes_three_percent_confidently_wrong_is_noticed() {
    let bench = Bench::new();
    let page = one_line(bench.record(&[]).as_bytes());
    assert!(page.contains("All 5 runs gave the same scores"), "{page}");
    assert!(
        page.contains("with a probability of 3 %, a check notices it with 62 %")
            && page.contains("With 76 such cases it would be 90 %"),
        "{page}"
    );
    let baseline = fs::read(bench.path("hexbench-gate.json")).unwrap();
    assert!(baseline.len() < 8000, "{} bytes to commit", baseline.len());
    let passed = one_line(text(bench.gate(&["check", "--jobs", "4"])).as_bytes());
    assert!(passed.contains("every case has the scores of the baseline"), "{passed}");
    assert!(passed.contains("The files of the program are those of the baseline"), "{passed}");

    bench.write("settings.sh", ONE_WRONG);
    let files = ["--junit", "gate.xml", "--json", "gate.json", "--markdown", "gate.md"];
    let failed = bench.gate(&[&["check", "--jobs", "4"], &files[..]].concat());
    assert_eq!(failed.status.code(), Some(1), "{}", complaint(&failed));
    assert!(
        complaint(&failed).contains("leg stiffnesses far outside their uncertainty"),
        "{}",
        complaint(&failed)
    );
    let page = one_line(&failed.stdout);
    for wanted in ["Files of the program that changed since: settings.sh", "case-007", "--update --reason"] {
        assert!(page.contains(wanted), "{wanted} is not in {page}");
    }
    let comparison = bench.json("gate.json");
    // The same as of a program whose runs differ: chance takes part.
    let mut scattered = bench.json("hexbench-gate.json");
    scattered["steady"] = false.into();
    scattered["repeats"] = 1.into();
    bench.write("scattered.json", &scattered.to_string());
    let by_chance = bench.gate(&["check", "--jobs", "4", "--baseline", "scattered.json", "--json", "-"]);
    crate::schemas::check(
        "gate/1",
        &[comparison.clone(), serde_json::from_slice(&by_chance.stdout).unwrap()],
    );
    let worse: Vec<&Value> =
        comparison["findings"].as_array().unwrap().iter().filter(|f| f["verdict"] == "worse").collect();
    assert!(
        worse.iter().any(|f| f["id"] == "stiffness-far-off" && f["figures"] == serde_json::json!([0.0, 1.0]))
    );
    let junit = fs::read_to_string(bench.path("gate.xml")).unwrap();
    let xml = roxmltree::Document::parse(&junit).unwrap();
    let count = |tag: &str| xml.descendants().filter(|n| n.has_tag_name(tag)).count();
    assert_eq!((count("testsuite"), count("failure")), (1, worse.len()));
    assert_eq!(count("testcase"), comparison["findings"].as_array().unwrap().len());
    assert!(fs::read_to_string(bench.path("gate.md")).unwrap().contains("case-007"));
    assert!(fs::read(bench.path("hexbench-gate.json")).unwrap() == baseline, "a check changes no baseline");

    bench.write("settings.sh", "# an edit without an effect\n");
    let passed = one_line(text(bench.gate(&["check", "--jobs", "4"])).as_bytes());
    assert!(passed.contains("every case has the scores") && passed.contains("settings.sh"), "{passed}");
}

#[test]
fn a_gate_in_parts_has_the_scores_of_one_machine() {
    let bench = Bench::new();
    bench.record(&["--repeats", "2"]);
    let program = ["--", "sh", "solve.sh"];
    let by_part = |step: &[&str], number: u32, program: &[&str]| {
        let share = [format!("{number}/3"), format!("part-{number}")];
        let words = [step, &["--jobs", "4", "--shard", &share[0], "--work", &share[1]], program].concat();
        text(bench.gate(&words))
    };
    let parts = ["--parts", "part-1", "part-2", "part-3"];
    let step = ["record", "suite.toml", "--baseline", "b.json", "--repeats", "2", "--depends", "settings.sh"];
    for number in 1..=3 {
        let told = by_part(&step, number, &program);
        assert!(told.contains(&format!("Part {number}/3: 1{} of 32 cases", u32::from(number < 3))), "{told}");
    }
    assert!(!bench.path("b.json").exists(), "a part writes no baseline");
    text(bench.gate(&[&step[..], &parts, &program].concat()));
    let [whole, together] = ["hexbench-gate.json", "b.json"].map(|name| bench.json(name));
    for key in ["cases", "figures", "steady", "repeats", "suite", "entrant"] {
        assert_eq!(whole[key], together[key], "{key}");
    }

    // Cases that differ run again where their part is.
    bench.write("settings.sh", ONE_WRONG);
    let no_part = bench.gate(&[&["check"], &parts[..]].concat());
    assert_eq!(no_part.status.code(), Some(3), "{}", complaint(&no_part));
    assert!(complaint(&no_part).contains("no answers of this program"), "{}", complaint(&no_part));
    for number in 1..=3 {
        by_part(&["check"], number, &[]);
    }
    let checked = |more: &[&str]| bench.gate(&[&["check", "--json", "-"], more].concat());
    let [whole, together] = [checked(&["--jobs", "4"]), checked(&parts)];
    assert_eq!((whole.status.code(), together.status.code()), (Some(1), Some(1)), "{}", complaint(&together));
    assert_eq!(whole.stdout, together.stdout);

    for (words, code, wanted) in [
        (&["--parts", "part-1", "part-3"][..], 3, "11 of 32 cases are missing in the folders"),
        (&["--parts", "part-1", "--work", "part-1"], 2, "the folder of --work too"),
        (&["--shard", "1/3"], 2, "--shard needs a folder"),
        (&["--shard", "1/3", "--work", "w", "--parts", "part-1"], 2, "cannot be used with"),
    ] {
        let refused = bench.gate(&[&["check"], words].concat());
        assert_eq!(refused.status.code(), Some(code), "{words:?}: {}", complaint(&refused));
        assert!(complaint(&refused).contains(wanted), "{words:?}: {}", complaint(&refused));
    }
}

#[test]
fn a_program_that_chance_moves_is_compared_with_its_own_scatter() {
    let bench = Bench::new();
    // Chance decides the predictions, and in a third of the cases whether there is an answer.
    let random = "jitter=$(od -An -N2 -tu2 /dev/urandom | awk '{ print $1 / 65536 }')\n\
        case $(basename \"$(grep -o 'case-0.*[369]\"' \"$1/hexapod.toml\")\") in case*) awk -v j=$jitter 'BEGIN { exit j < 0.3 }' || exit 1 ;; esac\n";
    bench.write("settings.sh", random);
    let page = one_line(bench.record(&["--repeats", "4"]).as_bytes());
    assert!(page.contains("The 4 runs differ"), "{page}");
    let passed = one_line(text(bench.gate(&["check", "--jobs", "4"])).as_bytes());
    assert!(
        passed.contains("no figure is worse") && passed.contains("The runs of the baseline differ"),
        "{passed}"
    );
    bench.write("settings.sh", &format!("{random}stiffness=900\n"));
    let failed = bench.gate(&["check", "--jobs", "4"]);
    assert_eq!(failed.status.code(), Some(1), "{}", complaint(&failed));
    assert!(
        complaint(&failed).contains("leg stiffnesses far outside their uncertainty"),
        "{}",
        complaint(&failed)
    );
}

#[test]
fn a_baseline_is_changed_with_a_reason_alone_and_keeps_its_history() {
    let bench = Bench::new();
    bench.record(&["--repeats", "2"]);
    let recorded_again = bench.gate(&["record", "suite.toml", "--", "sh", "solve.sh"]);
    assert_eq!(recorded_again.status.code(), Some(2), "{}", complaint(&recorded_again));
    assert!(complaint(&recorded_again).contains("exists already"), "{}", complaint(&recorded_again));
    bench.write("settings.sh", ONE_WRONG);
    for more in [vec!["--update"], vec!["--update", "--reason", " "], vec!["--reason", "why"]] {
        let refused = bench.gate(&[&["check"], &more[..]].concat());
        assert_eq!(refused.status.code(), Some(2), "{more:?}: {}", complaint(&refused));
    }
    text(bench.gate(&["check", "--jobs", "4", "--update", "--reason", "case 7 is another machine"]));
    let history = bench.json("hexbench-gate.json")["history"].clone();
    let reasons: Vec<&str> =
        history.as_array().unwrap().iter().map(|u| u["reason"].as_str().unwrap()).collect();
    assert_eq!(reasons, ["The first baseline.", "case 7 is another machine"]);
    text(bench.gate(&["check", "--jobs", "4"]));
    bench.write("settings.sh", "");
    let better = one_line(text(bench.gate(&["check", "--jobs", "4"])).as_bytes());
    assert!(better.contains("are better: consider --update"), "{better}");
}

#[test]
fn a_folder_that_is_kept_gives_no_old_answers_though_nobody_named_what_changed() {
    let bench = Bench::new();
    let kept = ["--work", "kept", "--jobs", "4"];
    let record = [&["record", "suite.toml", "--repeats", "2"], &kept[..], &["--", "sh", "solve.sh"]].concat();
    text(bench.gate(&record));
    assert!(bench.path("kept/challenge/challenge.toml").is_file());
    text(bench.gate(&[&["check"], &kept[..]].concat()));
    bench.write("settings.sh", ONE_WRONG);
    let failed = bench.gate(&[&["check"], &kept[..]].concat());
    assert_eq!(failed.status.code(), Some(1), "{}", complaint(&failed));
    assert!(one_line(&failed.stdout).contains("The files of the program are those of the baseline"));
}

#[test]
fn machines_that_gauges_read_have_a_gate_too() {
    let bench = Bench::new();
    bench.write("suite.toml", GAUGES);
    bench.write(
        "solve.sh",
        &format!(
            "{} challenge answer \"$1\" \"$2\"\n. \"$(dirname \"$0\")/settings.sh\"\n",
            env!("CARGO_BIN_EXE_hexbench")
        ),
    );
    let page = one_line(bench.record(&["--repeats", "2"]).as_bytes());
    assert!(
        page.contains("All 2 runs gave the same scores") && page.contains("2 of gauges version 1"),
        "{page}"
    );
    // Motions in millimeters instead of micrometers.
    bench.write("settings.sh", "awk -F, -v OFS=, 'NR > 1 { $2 /= 1000 } { print }' \"$2/predictions.csv\" > p && mv p \"$2/predictions.csv\"\n");
    let failed = bench.gate(&["check"]);
    assert_eq!(failed.status.code(), Some(1), "{}", complaint(&failed));
    assert!(one_line(&failed.stdout).contains("predictions: error"), "{}", one_line(&failed.stdout));
}

#[test]
fn a_challenge_that_was_made_before_is_named_again_and_others_are_refused() {
    let bench = Bench::new();
    bench.write("seed.txt", &"7e".repeat(20));
    let make = |name: &str, more: &[&str]| {
        let mut command = hexbench();
        command
            .current_dir(bench.folder.path())
            .args(["challenge", "make", "suite.toml", "-o", name])
            .args(more);
        text(command.output().unwrap())
    };
    make("hidden", &["--seed-file", "seed.txt"]);
    make("other", &[]);
    text(bench.gate(&[
        "record",
        "hidden",
        "--repeats",
        "1",
        "--jobs",
        "4",
        "--depends",
        "settings.sh",
        "--",
        "sh",
        "solve.sh",
    ]));
    let unnamed = bench.gate(&["check"]);
    assert_eq!(unnamed.status.code(), Some(2), "{}", complaint(&unnamed));
    assert!(complaint(&unnamed).contains("--challenge DIR"), "{}", complaint(&unnamed));
    let other = bench.gate(&["check", "--challenge", "other"]);
    assert_eq!(other.status.code(), Some(3), "{}", complaint(&other));
    text(bench.gate(&["check", "--challenge", "hidden", "--jobs", "4"]));
    let seeded =
        bench.gate(&["record", "hidden", "--baseline", "b.json", "--seed", "3", "--", "sh", "solve.sh"]);
    assert_eq!(seeded.status.code(), Some(2), "{}", complaint(&seeded));
}

#[test]
fn baselines_that_are_none_are_refused_with_the_next_step() {
    type Change = fn(&mut Value);
    let bench = Bench::new();
    bench.record(&["--repeats", "1"]);
    let good = bench.json("hexbench-gate.json");
    let changes: [(Change, &str); 5] = [
        (|b| b["format"] = "gate-baseline/9".into(), "has the format `gate-baseline/9`"),
        (|b| b["surplus"] = 1.into(), "unknown key `surplus`"),
        (|b| b["figures"]["unanswered"][0] = "0 0".into(), "2 values for 32 cases"),
        (|b| b["repeats"] = 3.into(), "has 1 runs instead of 3"),
        (|b| b["suite"]["seed"] = 5.into(), "the cases differ from those of the baseline"),
    ];
    for (change, wanted) in changes {
        let mut bad = good.clone();
        change(&mut bad);
        bench.write("bad.json", &bad.to_string());
        let output = bench.gate(&["check", "--baseline", "bad.json"]);
        assert_eq!(output.status.code(), Some(3), "{wanted}: {}", complaint(&output));
        assert!(
            complaint(&output).contains(wanted) && complaint(&output).contains("next:"),
            "{}",
            complaint(&output)
        );
    }
    let output = bench.gate(&["check", "--baseline", "nowhere.json"]);
    assert_eq!(output.status.code(), Some(5), "{}", complaint(&output));
    assert!(complaint(&output).contains("gate record"), "{}", complaint(&output));
}
