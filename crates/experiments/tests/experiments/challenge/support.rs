//! Small challenges and small programs.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use hexbench_experiments::challenge::run::{Entrant, Manner, Program, RunLimits, RunRecord, run};
use hexbench_experiments::challenge::{Challenge, ChallengeSuite, make};
use hexbench_experiments::harness::Silent;
use tempfile::TempDir;

/// One case without effect.
pub(crate) const ONE: &str =
    "[cases.clean]\nkind = \"clean\"\ncount = 1\nplan = \"paper\"\nmachine = \"ring_a\"\n";

/// A case of every sort of truth.
pub(crate) const EVERY_SORT: &str = "\
[cases.clean]\nkind = \"clean\"\ncount = 1\nplan = \"few-poses\"\nmachine = \"ring_a\"\n\
[cases.one]\nkind = \"single\"\ncount = 1\neffects = [\"base-compliance\"]\nplan = \"few-poses\"\nmachine = \"ring_a\"\n\
[cases.two]\nkind = \"pair\"\ncount = 1\neffects = [\"thermal-expansion+load-offset\"]\nplan = \"few-poses\"\nmachine = \"ring_a\"\nrepeats = 1\n\
[cases.outside]\nkind = \"outside\"\ncount = 1\nplan = \"few-poses\"\nmachine = \"ring_a\"\n\
[cases.poses]\nkind = \"absolute\"\ncount = 1\nmachine = \"ring_a\"\n";

pub(crate) fn suite(cases: &str) -> ChallengeSuite {
    let head = "format = \"challenge-suite/1\"\nname = \"tiny\"\nversion = 1\ntitle = \"Small\"\nseed = 11\n";
    ChallengeSuite::from_text(&format!("{head}{cases}"), Path::new("tiny.toml")).unwrap()
}

/// A challenge in a folder of its own.
pub(crate) struct Bench {
    pub(crate) folder: TempDir,
    pub(crate) challenge: Challenge,
}

impl Bench {
    pub(crate) fn of(cases: &str) -> Self {
        Self::of_suite(&suite(cases))
    }

    pub(crate) fn of_suite(suite: &ChallengeSuite) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("challenge");
        make(suite, &place, &Silent).unwrap();
        let challenge = Challenge::open(&place).unwrap();
        Self { folder, challenge }
    }

    pub(crate) fn place(&self) -> PathBuf {
        self.folder.path().join("challenge")
    }

    pub(crate) fn answers(&self) -> PathBuf {
        self.folder.path().join("answers")
    }

    /// Runs a shell script, which has the case in $1, the folder to write to in $2 and `zero` in $0.
    pub(crate) fn run_with(&self, script: &str, zero: &Path, limits: RunLimits) -> Vec<RunRecord> {
        let entrant = entrant(script, zero, limits);
        run(&self.challenge, &entrant, &self.answers(), MANNER, &|_| true, &Silent).unwrap().fresh
    }

    /// The record of the only case.
    pub(crate) fn record(&self, script: &str, limits: RunLimits) -> RunRecord {
        let records = self.run_with(script, Path::new("sh"), limits);
        assert_eq!(records.len(), 1);
        records[0].clone()
    }

    /// Text of a file that is kept of the only case.
    pub(crate) fn kept(&self, name: &str) -> String {
        fs::read_to_string(self.answers().join("cases/case-001").join(name)).unwrap()
    }
}

pub(crate) const MANNER: Manner = Manner { jobs: 2, again: false };

pub(crate) fn entrant(script: &str, zero: &Path, limits: RunLimits) -> Entrant {
    let line = ["sh", "-c", script, zero.to_str().unwrap()].map(str::to_owned);
    Entrant { name: "script".to_owned(), program: Program::find(&line).unwrap(), limits }
}

/// Path and bytes of every file in a folder.
pub(crate) fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(next).unwrap().map(Result::unwrap) {
            let path = entry.path();
            if path.is_dir() {
                open.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().to_owned();
                found.insert(name, fs::read(path).unwrap());
            }
        }
    }
    found
}
