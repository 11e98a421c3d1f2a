//! `--shard` and `--parts`: an experiment of any command shared among processes gives the bytes of one run.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::support::{hexbench, root, text};

/// A command whose experiments are shared, and what it writes into a folder.
struct SharedCommand {
    words: &'static [&'static str],
    writes: &'static [&'static str],
}

/// One experiment, several in one command, one whose trials depend on files. The tests of the Python package have more of them.
const COMMANDS: [SharedCommand; 3] = [
    SharedCommand { words: &["validate", "recovery", "--campaigns", "4", "--diagnoses", "0"], writes: &[] },
    SharedCommand {
        words: &["validate", "discover", "--outside", "1", "--listed", "1", "--clean", "1"],
        writes: &["-o", "files"],
    },
    SharedCommand {
        words: &[
            "power",
            "scenes/paper/hexapod.toml",
            "data/cases/paper-protocol/measurements.csv",
            "--sigma",
            "0.5,3",
            "--effect",
            "joint-friction",
            "--simulate",
            "3",
        ],
        writes: &["--json", "power.json"],
    },
];

impl SharedCommand {
    /// The command with its results in a folder; the folder's name stands in no file.
    fn to(&self, folder: &Path) -> assert_cmd::Command {
        fs::create_dir_all(folder).unwrap();
        let mut command = hexbench();
        command.current_dir(folder);
        command.args(self.words.iter().map(|word| {
            let path = root().join(word);
            if path.exists() { path.display().to_string() } else { (*word).to_owned() }
        }));
        command.args(self.writes);
        command
    }
}

/// All files below a folder but for journals, with what was printed.
fn results(folder: &Path, printed: String) -> Vec<(PathBuf, Vec<u8>)> {
    fn below(folder: &Path, found: &mut Vec<PathBuf>) {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if !path.is_dir() {
                found.push(path);
            } else if !path.ends_with("kept") {
                below(&path, found);
            }
        }
    }
    let mut files = Vec::new();
    below(folder, &mut files);
    files.sort();
    let named = |path: PathBuf| (path.strip_prefix(folder).unwrap().to_owned(), fs::read(&path).unwrap());
    files.into_iter().map(named).chain([(PathBuf::from("printed"), printed.into_bytes())]).collect()
}

#[test]
fn parts_of_any_experiment_give_the_bytes_of_one_run() {
    for command in &COMMANDS {
        let folder = tempfile::tempdir().unwrap();
        let [whole, merged] = ["whole", "merged"].map(|name| folder.path().join(name));
        let printed = text(command.to(&whole).output().unwrap());
        let parts: Vec<PathBuf> = (1..=3)
            .map(|number| {
                let part = folder.path().join(format!("part-{number}"));
                let at = folder.path().join(format!("elsewhere-{number}"));
                let mut process = command.to(&at);
                process.env("RAYON_NUM_THREADS", number.to_string());
                process.args(["--shard", &format!("{number}/3"), "--journal"]).arg(&part);
                let told = text(process.output().unwrap());
                assert!(told.contains(&format!("Part {number}/3 is done")), "{told}");
                assert!(results(&at, String::new()).len() == 1, "a part writes results");
                part
            })
            .collect();
        let mut process = command.to(&merged);
        process.arg("--journal").arg(merged.join("kept")).arg("--parts").args(&parts);
        let again = text(process.output().unwrap());
        let [one, shared] = [results(&whole, printed), results(&merged, again)];
        assert!(one == shared, "{:?} differs", command.words);
        assert!(one.len() > 1 || command.writes.is_empty(), "{:?} writes nothing", command.words);
    }
}

#[test]
fn missing_parts_and_parts_of_something_else_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let command = |more: &[&str]| {
        let mut command = hexbench();
        command.current_dir(folder.path()).args([
            "validate",
            "robustness",
            "--fault",
            "drift-1",
            "-o",
            "files",
        ]);
        command.args(more);
        command
    };
    let told = |command: &mut assert_cmd::Command, code: i32| {
        let output = command.output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{stderr}");
        stderr
    };
    command(&["--journal", "one", "--shard", "1/2"]).assert().success();
    let shards = |of: &str| fs::read_dir(at(of).join("journal")).unwrap().count();
    let before = shards("one");
    let missing = told(&mut command(&["--journal", "whole", "--parts", "one"]), 3);
    assert!(missing.contains("shards are missing in the folders, the first is shard 1"), "{missing}");
    assert!(!at("all.json").exists(), "results without all trials");
    let other = told(&mut command(&["--seed", "2", "--journal", "other", "--parts", "one"]), 3);
    assert!(other.contains("here it is 2"), "{other}");
    told(&mut command(&["--journal", "none", "--parts", "nowhere"]), 5);
    for wrong in [
        &["--shard", "1/2"][..],
        &["--shard", "3/2", "--journal", "x"],
        &["--parts", "one"],
        &["--shard", "1/2", "--parts", "one", "--journal", "x"],
    ] {
        told(&mut command(wrong), 2);
    }
    // Given again, a part that is done computes nothing.
    command(&["--journal", "one", "--shard", "1/2"]).assert().success();
    assert_eq!(shards("one"), before);
}

/// The scripts for a batch system on the page about sharing, run as the tasks of an array.
#[test]
fn the_scripts_of_the_page_run_as_processes_of_an_array() {
    const TASKS: usize = 2;
    let page = fs::read_to_string(root().join("docs/guide/shared-studies.md")).unwrap();
    let blocks = page.split("```").skip(1).step_by(2);
    let scripts: Vec<&str> = blocks.filter(|block| block.contains("#SBATCH")).collect();
    assert!(scripts.len() >= 2, "{}", scripts.len());
    for script in scripts {
        let folder = tempfile::tempdir().unwrap();
        let script = script.trim_start_matches("bash\n").replace("/32", &format!("/{TASKS}"));
        fs::write(folder.path().join("task.sh"), script.replace("--trials 100", "--trials 1")).unwrap();
        fs::write(
            folder.path().join("study.toml"),
            "format = \"study/1\"\ntitle = \"an array\"\nseed = 3\ntrials = 2900\ntask = \"springs\"\n[axes]\n\
             geometry = [\"ring_a\"]\nplan = [\"random\"]\nposes = [3]\n",
        )
        .unwrap();
        let program = Path::new(env!("CARGO_BIN_EXE_hexbench")).parent().unwrap();
        let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
        let task = |number: usize| {
            Command::new("bash")
                .arg("task.sh")
                .current_dir(folder.path())
                .env("PATH", &path)
                .env("SLURM_CPUS_PER_TASK", "1")
                .env("SLURM_ARRAY_TASK_ID", number.to_string())
                .stdout(Stdio::null())
                .spawn()
                .unwrap()
        };
        let tasks: Vec<_> = (1..=TASKS).map(task).collect();
        for mut task in tasks {
            assert!(task.wait().unwrap().success());
        }
        let parts = (1..=TASKS).map(|number| format!("part-{number}"));
        let mut merge = hexbench();
        merge.current_dir(folder.path());
        if script.contains("study run") {
            merge.args(["study", "merge", "study.toml", "-o", "whole"]).args(parts);
        } else {
            merge.args(["validate", "robustness", "--trials", "1", "-o", "robustness", "--journal", "whole"]);
            merge.arg("--parts").args(parts);
        }
        merge.assert().success();
    }
}
