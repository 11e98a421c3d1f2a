//! The corpus of every target, as it is and changed by seeds.
//!
//! `HEXBENCH_FUZZ_MUTATIONS=N cargo test -p hexbench-fuzz` changes every file of the corpus N times: a fuzzer without coverage where
//! there is no nightly compiler. `HEXBENCH_FUZZ_TARGET=NAME` does so for one target, `HEXBENCH_FUZZ_SEED=K` by other changes;
//! `scripts/fuzz_stable.sh` sets all three.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on must fail")]

use std::collections::BTreeSet;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use hexbench_fuzz::{TARGETS, Target, mutate};

/// Changes of every file in `./test`.
const MUTATIONS: u64 = 20;

fn here(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn names(folder: &Path, ending: &str) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let name = |entry: fs::DirEntry| entry.file_name().into_string().unwrap();
    entries.map(|entry| name(entry.unwrap()).trim_end_matches(ending).to_owned()).collect()
}

fn asked(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).map_or(otherwise, |number| number.parse().unwrap())
}

/// The targets that are asked for: all of them, or one by its name.
fn targets() -> Vec<&'static Target> {
    let name = std::env::var("HEXBENCH_FUZZ_TARGET").ok();
    let chosen: Vec<_> = TARGETS.iter().filter(|t| name.as_ref().is_none_or(|name| t.name == name)).collect();
    assert!(!chosen.is_empty(), "there is no target {name:?}");
    chosen
}

/// What became of some inputs of a target.
#[derive(Default)]
struct Outcome {
    inputs: u64,
    accepted: u64,
    /// What broke a promise, in words that say how to do it again.
    faults: Vec<String>,
}

impl Outcome {
    fn add(&mut self, target: &Target, input: &str, bytes: &[u8]) {
        self.inputs += 1;
        if let Ok(accepted) = catch_unwind(AssertUnwindSafe(|| (target.check)(bytes))) {
            self.accepted += u64::from(accepted);
        } else {
            let kept = keep(target, input, bytes);
            let text = String::from_utf8_lossy(bytes);
            self.faults.push(format!("{input}, kept as {}:\n{text}", kept.display()));
        }
    }
}

/// Writes what breaks a target to where the fuzzer writes it too: as text not every byte can be seen.
fn keep(target: &Target, input: &str, bytes: &[u8]) -> PathBuf {
    let folder = here("artifacts").join(target.name);
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join(input.rsplit('/').next().unwrap_or(input).replace(", ", "-").replace(' ', "-"));
    fs::write(&file, bytes).unwrap();
    file
}

fn replay(target: &Target) -> Outcome {
    let folder = here("corpus").join(target.name);
    let mut outcome = Outcome::default();
    for (number, file) in (0..).zip(names(&folder, "")) {
        let bytes = fs::read(folder.join(&file)).unwrap();
        let file = format!("corpus/{}/{file}", target.name);
        outcome.add(target, &file, &bytes);
        for k in 0..asked("HEXBENCH_FUZZ_MUTATIONS", MUTATIONS) {
            // Streams of different files do not meet.
            let seed = (number << 40) | (asked("HEXBENCH_FUZZ_SEED", 0) + k);
            outcome.add(target, &format!("{file}, seed {seed}"), &mutate(&bytes, seed));
        }
    }
    outcome
}

#[test]
fn no_input_of_the_corpus_and_no_change_of_one_breaks_a_promise() {
    let targets = targets();
    let threads: Vec<_> = targets.iter().map(|&t| std::thread::spawn(|| replay(t))).collect();
    let mut broken = Vec::new();
    for (target, thread) in targets.into_iter().zip(threads) {
        let Outcome { inputs, accepted, faults } = thread.join().unwrap();
        println!("{}: {inputs} inputs, {accepted} accepted, {} faults", target.name, faults.len());
        if accepted == 0 {
            broken.push(format!("{}, which accepts nothing, so that nothing is shown", target.name));
        }
        broken.extend(faults);
    }
    assert!(broken.is_empty(), "{} faults, the first by {}", broken.len(), broken[0]);
}

#[test]
fn every_target_has_a_corpus_and_a_program() {
    let listed: BTreeSet<String> = TARGETS.iter().map(|t| t.name.to_owned()).collect();
    assert_eq!(listed.len(), TARGETS.len(), "a name is there twice");
    assert_eq!(names(&here("corpus"), ""), listed);
    assert_eq!(names(&here("fuzz_targets"), ".rs"), listed);
    let manifest = fs::read_to_string(here("Cargo.toml")).unwrap();
    for name in listed {
        let program = fs::read_to_string(here("fuzz_targets").join(format!("{name}.rs"))).unwrap();
        assert!(program.contains(&format!("fuzz!(\"{name}\")")), "{program}");
        assert!(manifest.contains(&format!("path = \"fuzz_targets/{name}.rs\"")), "{name}");
    }
}
