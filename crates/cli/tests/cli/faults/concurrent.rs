//! Commands that are killed, and commands that get into each other's way.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use super::bench::{Bench, CLEAN, Share};
use super::fate::Fate;
use super::places::remains;
use crate::support::complaint;

/// Six shards, over in a second or two.
const STUDY: &str = "format = \"study/1\"\ntitle = \"killed\"\nseed = 3\ntrials = 2900\ntask = \"springs\"\nredraw = 40\n\
                     [axes]\ngeometry = [\"ring_a\"]\nplan = [\"random\"]\nposes = [3]\nnoise_scale = [1, 2]\n";

fn begin(bench: &Bench, words: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_hexbench"))
        .current_dir(bench.path())
        .args(words)
        .env("RAYON_NUM_THREADS", "1")
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

fn kill_after(child: &mut Child, time: Duration) {
    sleep(time);
    let _ = child.kill();
    child.wait().unwrap();
}

/// A fit killed at many instants, a study at some.
pub(super) fn kills(share: Share) -> Vec<Fate> {
    let bench = || Bench::with(&CLEAN.machine, CLEAN.readings.text());
    let fit = ["fit", "hexapod.toml", "measurements.csv", "-o", "model.toml"];
    let whole = bench();
    assert_eq!(whole.run(&fit).code, Some(0));
    let new = fs::read_to_string(whole.at("model.toml")).unwrap();
    let instants: Vec<u64> = (0..60).collect();
    let mut fates = share.each(&instants, |after| {
        let bench = bench();
        bench.write("model.toml", "old");
        kill_after(&mut begin(&bench, &fit), Duration::from_micros(700 * after));
        let kept = fs::read_to_string(bench.at("model.toml")).unwrap();
        let is_whole = kept == "old" || kept == new;
        let swept = bench.run(&fit).code == Some(0) && remains(bench.path()).is_empty();
        Fate::survived_if(is_whole && swept, || format!("{after}: swept {swept}: {kept}"))
    });
    fates.extend(share.each(&[1, 2, 3, 4, 5, 6], |kills| study_killed(*kills)));
    fates
}

/// A study killed so many times ends with the bytes of an unbroken one.
fn study_killed(kills: u64) -> Fate {
    let bench = Bench::empty();
    bench.write("study.toml", STUDY);
    let whole = bench.run(&["study", "study.toml", "-o", "whole"]);
    assert_eq!(whole.code, Some(0), "{}", whole.said);
    for k in 1..=kills {
        kill_after(&mut begin(&bench, &["study", "study.toml", "-o", "out"]), Duration::from_millis(60 * k));
    }
    let resumed = bench.run(&["study", "study.toml", "-o", "out"]);
    let same = ["trials.parquet", "cells.csv", "study.md"]
        .iter()
        .all(|name| fs::read(bench.at("whole").join(name)).ok() == fs::read(bench.at("out").join(name)).ok());
    Fate::survived_if(resumed.code == Some(0) && same, || {
        format!("{kills} kills: {:?} {}", resumed.code, resumed.said)
    })
}

/// Fits on one file, studies on one folder.
pub(super) fn rivals(share: Share) -> Vec<Fate> {
    let fits: Vec<u64> = (0..6).collect();
    let mut fates = share.each(&fits, |_| fits_on_one_file());
    fates.extend(share.each(&fits[..3], |_| studies_on_one_folder()));
    fates
}

fn fits_on_one_file() -> Fate {
    let bench = Bench::with(&CLEAN.machine, CLEAN.readings.text());
    let all: Vec<Child> = (0..4)
        .map(|_| begin(&bench, &["fit", "hexapod.toml", "measurements.csv", "-o", "model.toml"]))
        .collect();
    let ended = all.into_iter().all(|mut child| child.wait().unwrap().success());
    let read = bench.run(&["predict", "model.toml", "measurements.csv"]);
    let left = remains(bench.path());
    Fate::survived_if(ended && read.code == Some(0) && left.is_empty(), || format!("{left:?} {}", read.said))
}

/// One goes on, the others say so.
fn studies_on_one_folder() -> Fate {
    let bench = Bench::empty();
    bench.write("study.toml", STUDY);
    let all: Vec<Child> = (0..3).map(|_| begin(&bench, &["study", "study.toml", "-o", "out"])).collect();
    let ended: Vec<_> = all.into_iter().map(|child| child.wait_with_output().unwrap()).collect();
    let well = |output: &std::process::Output| {
        let said = complaint(output);
        output.status.success()
            || (said.contains("next: ") && said.contains("another run is using this folder"))
    };
    let one = ended.iter().any(|output| output.status.success());
    Fate::survived_if(one && ended.iter().all(well), || format!("{ended:?}"))
}
