//! What experiments read: studies, suites, answers of programs, baselines, records of journals.

use std::path::Path;

use hexbench_core::Measurand;
use hexbench_experiments::challenge::ChallengeSuite;
use hexbench_experiments::challenge::answer::{CaseAnswer, columns};
use hexbench_experiments::harness::{self, Field, Protocol, Silent};
use hexbench_experiments::journal::{self, Identity, Journal, Shards};
use hexbench_experiments::regress::baseline::Baseline;
use hexbench_experiments::sweep::SweepStudy;

use super::simulations::HEXAPOD;
use crate::scratch;

pub(super) fn study(bytes: &[u8]) -> bool {
    let space = include_bytes!("../../../data/designs/paper-space.toml");
    let files =
        [("study.toml", bytes), ("space.toml", space.as_slice()), ("hexapod.toml", HEXAPOD.as_bytes())];
    scratch::folder(&files, |folder: &Path| SweepStudy::read(&folder.join("study.toml"))).is_ok()
}

pub(super) fn suite(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    ChallengeSuite::from_text(text, Path::new("suite.toml")).is_ok()
}

pub(super) fn baseline(bytes: &[u8]) -> bool {
    scratch::file("baseline.json", bytes, Baseline::read).is_ok()
}

const PARAMETERS: &[u8] = br#"{"format": "parameters/1", "parameters": []}"#;
const DIAGNOSIS: &[u8] = br#"{"format": "diagnosis/1", "verdict": "adequate"}"#;

/// The bytes as each file of an answer, the others as they should be; what is accepted is finite.
pub(super) fn answer(bytes: &[u8]) -> bool {
    let measurand = Measurand::DeflectionEuler;
    let right = format!("row,{}\n1,0,0,0,0,0,0\n", columns(measurand)[0].join(","));
    let files = ["predictions.csv", "parameters.json", "diagnosis.json"];
    let usual = [right.as_bytes(), PARAMETERS, DIAGNOSIS];
    let mut accepted = false;
    for wrong in 0..files.len() {
        let given: Vec<(&str, &[u8])> =
            (0..files.len()).map(|k| (files[k], if k == wrong { bytes } else { usual[k] })).collect();
        let read = scratch::folder(&given, |folder| CaseAnswer::read(folder, 1, measurand));
        if let Ok(answer) = read {
            accepted = true;
            assert!(answer.predictions.iter().all(|p| p.value.iter().all(|x| x.is_finite())));
        }
    }
    accepted
}

/// An experiment of one trial that has been done before.
struct Done;

impl Protocol for Done {
    type Job = ();
    type Record = (f64, String, Vec<Option<u32>>);
    type Error = String;

    fn identity(&self) -> Identity {
        Identity::new("fuzzed", "fuzzed/1", [("setting", "one".into())])
    }

    fn jobs(&self) -> Vec<()> {
        vec![()]
    }

    fn trial(&self, (): &()) -> Result<Self::Record, String> {
        Ok((0.0, String::new(), Vec::new()))
    }

    fn name(&self, (): &()) -> String {
        "0".to_owned()
    }

    fn fields(&self) -> Vec<Field<Self::Record>> {
        Vec::new()
    }

    fn trials_of_a_shard(&self) -> u64 {
        1
    }
}

/// The bytes as a record: refused unless whole. The bytes as what a whole record holds: found again, or no record of this experiment.
pub(super) fn journal(bytes: &[u8]) -> bool {
    let shards = Shards { trials: 1, size: 1 };
    let whole = journal::record(Done.identity(), shards, 0, bytes);
    scratch::folder(&[], |folder| {
        let folder = folder.join("study");
        {
            let journal = Journal::open(&folder, Done.identity(), shards).expect("a folder of its own");
            assert!(journal.keep_record(0, bytes).is_err() || journal.content(0).is_ok());
            std::fs::remove_file(folder.join("journal/00000000.shard")).ok();
            journal.keep_record(0, &whole).expect("a record that is whole");
            assert_eq!(journal.content(0).expect("it was kept"), bytes);
        }
        let gathered = harness::run(&Done, Some(&folder), &Silent);
        std::fs::remove_file(folder.join("journal/00000000.shard")).ok();
        gathered.is_ok()
    })
}
