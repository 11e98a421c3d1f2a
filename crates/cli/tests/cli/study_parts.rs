//! `hexbench study plan`, `run` and `merge`: a study shared among machines gives the bytes of one.

use std::fs;
use std::path::{Path, PathBuf};

use crate::support::{hexbench, text};

/// Six shards.
const STUDY: &str = "format = \"study/1\"\ntitle = \"shared\"\nseed = 3\ntrials = 2900\ntask = \"springs\"\n\
                     [axes]\ngeometry = [\"ring_a\"]\nplan = [\"random\"]\nposes = [3]\nnoise_scale = [1, 2]\n";

fn study_in(folder: &Path) -> PathBuf {
    let path = folder.join("study.toml");
    fs::write(&path, STUDY).unwrap();
    path
}

fn part(file: &Path, out: &Path, shard: &str) -> assert_cmd::Command {
    let mut command = hexbench();
    command.args(["study", "run"]).arg(file).arg("-o").arg(out).args(["--shard", shard]);
    command
}

fn merge(file: &Path, parts: &[PathBuf], out: &Path) -> assert_cmd::Command {
    let mut command = hexbench();
    command.args(["study", "merge"]).arg(file).args(parts).arg("-o").arg(out);
    command
}

fn results(out: &Path) -> [Vec<u8>; 3] {
    ["trials.parquet", "cells.csv", "study.md"].map(|name| fs::read(out.join(name)).unwrap())
}

fn parts(folder: &Path, file: &Path, of: usize) -> Vec<PathBuf> {
    let one = |number: usize| {
        let out = folder.join(format!("part-{number}-of-{of}"));
        part(file, &out, &format!("{number}/{of}")).assert().success();
        out
    };
    (1..=of).map(one).collect()
}

#[test]
fn any_number_of_parts_in_any_order_gives_the_bytes_of_one_machine() {
    let folder = tempfile::tempdir().unwrap();
    let file = study_in(folder.path());
    let whole = folder.path().join("whole");
    hexbench().arg("study").arg(&file).arg("-o").arg(&whole).assert().success();
    // Seven parts of six shards: one has nothing to do.
    for of in [1, 2, 7] {
        let mut all = parts(folder.path(), &file, of);
        all.reverse();
        // A part that is given twice does no harm.
        all.push(all[0].clone());
        let out = folder.path().join(format!("merged-{of}"));
        merge(&file, &all, &out).assert().success();
        assert!(results(&out) == results(&whole), "{of} parts");
    }
}

#[test]
fn a_part_computes_its_own_shards_only_and_writes_no_results() {
    let folder = tempfile::tempdir().unwrap();
    let file = study_in(folder.path());
    let out = folder.path().join("part");
    let told = text(part(&file, &out, "2/3").output().unwrap());
    assert!(told.contains("Part 2/3 is done"), "{told}");
    let mut names: Vec<String> = fs::read_dir(out.join("journal"))
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.contains(".shard"))
        .collect();
    names.sort();
    assert_eq!(names, ["00000001.shard", "00000004.shard"]);
    assert!(!out.join("trials.parquet").exists());
    let stamp = || fs::metadata(out.join("journal/00000001.shard")).unwrap().modified().unwrap();
    let before = stamp();
    part(&file, &out, "2/3").assert().success();
    assert_eq!(before, stamp(), "a part that is done is not computed again");
}

#[test]
fn missing_damaged_and_foreign_parts_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let file = study_in(folder.path());
    let all = parts(folder.path(), &file, 2);
    let out = folder.path().join("merged");
    let missing = merge(&file, &all[1..], &out).assert().code(3);
    let stderr = String::from_utf8(missing.get_output().stderr.clone()).unwrap();
    assert!(stderr.contains("3 of 6 shards are missing in the folders, the first is shard 0"), "{stderr}");
    let torn = all[0].join("journal/00000002.shard");
    let bytes = fs::read(&torn).unwrap();
    fs::write(&torn, &bytes[..bytes.len() - 7]).unwrap();
    let damaged = merge(&file, &all, &out).assert().code(3);
    let stderr = String::from_utf8(damaged.get_output().stderr.clone()).unwrap();
    assert!(stderr.contains("1 records are damaged") && stderr.contains("1 of 6 shards"), "{stderr}");
    // Finished, it all fits together.
    part(&file, &all[0], "1/2").assert().success();
    merge(&file, &all, &out).assert().success();
    fs::write(&file, STUDY.replace("seed = 3", "seed = 4")).unwrap();
    let foreign = merge(&file, &all, &folder.path().join("other")).assert().code(3);
    let stderr = String::from_utf8(foreign.get_output().stderr.clone()).unwrap();
    assert!(stderr.contains("the study file has changed"), "{stderr}");
    merge(&file, &[folder.path().join("nowhere")], &folder.path().join("none")).assert().code(5);
}

#[test]
fn the_plan_shares_out_every_trial_once() {
    let folder = tempfile::tempdir().unwrap();
    let file = study_in(folder.path());
    let told = text(hexbench().args(["study", "plan"]).arg(&file).args(["--parts", "4"]).output().unwrap());
    assert!(told.starts_with("6 shards, 5800 trials"), "{told}");
    let rows = told.lines().filter(|l| l.contains("/4") && !l.contains("hexbench"));
    let trials: u64 = rows.map(|l| l.split_whitespace().last().unwrap().parse::<u64>().unwrap()).sum();
    assert_eq!(trials, 5800, "{told}");
    for wrong in ["0/4", "5/4", "x"] {
        part(&file, &folder.path().join("p"), wrong).assert().code(2);
    }
    hexbench().arg("study").assert().code(2);
}
