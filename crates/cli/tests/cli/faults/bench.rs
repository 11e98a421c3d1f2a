//! Files of a case, changed, and the command in their folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::thread;
use std::time::Duration;

use assert_cmd::Command;
use tempfile::TempDir;

use super::fate::{Answer, Fate, judged};
use super::table::Table;
use crate::support::{complaint, hexbench, root};

/// A run that takes longer hangs.
const LIMIT: Duration = Duration::from_mins(2);

/// A run that has ended.
pub(super) struct Run {
    /// Exit code; none: ended by a signal or by the limit.
    pub(super) code: Option<i32>,
    pub(super) said: String,
    pub(super) shown: Vec<u8>,
}

/// A folder of its own.
pub(super) struct Bench(TempDir);

impl Bench {
    pub(super) fn empty() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// With a machine and its readings.
    pub(super) fn with(machine: impl AsRef<[u8]>, readings: impl AsRef<[u8]>) -> Self {
        let bench = Self::empty();
        bench.write("hexapod.toml", machine);
        bench.write("measurements.csv", readings);
        bench
    }

    pub(super) fn path(&self) -> &Path {
        self.0.path()
    }

    pub(super) fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(super) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.at(name), bytes).unwrap();
    }

    /// The command in the folder, on one thread: cases run side by side.
    pub(super) fn command(&self, words: &[&str]) -> Command {
        let mut command = hexbench();
        command.current_dir(self.path()).args(words).env("RAYON_NUM_THREADS", "1").timeout(LIMIT);
        command
    }

    pub(super) fn run(&self, words: &[&str]) -> Run {
        run(&mut self.command(words))
    }
}

pub(super) fn run(command: &mut Command) -> Run {
    let output = command.output().unwrap();
    let said = complaint(&output);
    Run { code: output.status.code(), said, shown: output.stdout }
}

/// A sound machine with its readings, and what the command makes of them.
pub(super) struct Sound {
    pub(super) machine: String,
    pub(super) readings: Table,
    fit: Answer,
    diagnosis: Answer,
}

/// Few readings, for what is seen in one file of thousands.
pub(super) static FEW: LazyLock<Sound> = LazyLock::new(|| Sound::of("mujoco-clean", 4));
/// A machine without effects.
pub(super) static CLEAN: LazyLock<Sound> = LazyLock::new(|| Sound::of("mujoco-clean", 1));
/// A machine whose base yields, in few readings: what contradicts itself takes long.
pub(super) static SPARSE: LazyLock<Sound> = LazyLock::new(|| Sound::of("mujoco-foundation", 4));
/// The same in all of them.
pub(super) static YIELDING: LazyLock<Sound> = LazyLock::new(|| Sound::of("mujoco-foundation", 1));

impl Sound {
    /// Every so many conditions of a bundled case.
    fn of(case: &str, step: usize) -> Self {
        let read = |name: &str| fs::read_to_string(root().join("data/cases").join(case).join(name)).unwrap();
        let (machine, mut readings) = (read("hexapod.toml"), Table::of(&read("measurements.csv")));
        if step > 1 {
            let first = readings.column("repeat");
            let firsts = readings.rows.into_iter().filter(|row| row[first] == "1");
            readings.rows = firsts.step_by(step).collect();
        }
        let bench = Bench::with(&machine, readings.text());
        let answer = |command| Answer::of(&asked(&bench, command)).assert_sound();
        Self { fit: answer("fit"), diagnosis: answer("diagnose"), machine, readings }
    }

    /// What `fit` makes of other readings.
    pub(super) fn fit(&self, readings: impl AsRef<[u8]>) -> Fate {
        self.fit_of(&self.machine, readings)
    }

    /// What `fit` makes of other files.
    pub(super) fn fit_of(&self, machine: impl AsRef<[u8]>, readings: impl AsRef<[u8]>) -> Fate {
        judged(&asked(&Bench::with(machine, readings), "fit"), &self.fit)
    }

    /// What `fit` makes of other readings, and `diagnose` where `fit` says nothing.
    pub(super) fn ask(&self, readings: impl AsRef<[u8]>) -> Fate {
        self.ask_of(&self.machine, readings)
    }

    /// What `fit` makes of other files, and `diagnose` where `fit` says nothing.
    pub(super) fn ask_of(&self, machine: impl AsRef<[u8]>, readings: impl AsRef<[u8]>) -> Fate {
        match self.fit_of(&machine, &readings) {
            Fate::Silent(_) => self.diagnose_of(machine, readings),
            fate => fate,
        }
    }

    /// What `diagnose` makes of readings too few to show more than springs.
    pub(super) fn springs_of(&self, readings: impl AsRef<[u8]>) -> Fate {
        let run = asked(&Bench::with(&self.machine, readings), "diagnose");
        match judged(&run, &self.diagnosis) {
            Fate::Silent(_) if Answer::of(&run).has_springs_of(&self.diagnosis) => Fate::Survived,
            fate => fate,
        }
    }

    /// What `diagnose` makes of other readings.
    pub(super) fn diagnose(&self, readings: impl AsRef<[u8]>) -> Fate {
        self.diagnose_of(&self.machine, readings)
    }

    /// What `diagnose` makes of other files.
    pub(super) fn diagnose_of(&self, machine: impl AsRef<[u8]>, readings: impl AsRef<[u8]>) -> Fate {
        judged(&asked(&Bench::with(machine, readings), "diagnose"), &self.diagnosis)
    }
}

fn asked(bench: &Bench, command: &str) -> Run {
    bench.run(&[command, "hexapod.toml", "measurements.csv", "--json", "-"])
}

/// Every so many of the cases of a class.
#[derive(Debug, Clone, Copy)]
pub(super) struct Share(pub(super) usize);

impl Share {
    /// These cases side by side on the threads of this machine; fates in their order.
    pub(super) fn each<T: Sync>(self, cases: &[T], fate: impl Fn(&T) -> Fate + Sync) -> Vec<Fate> {
        let cases: Vec<&T> = cases.iter().step_by(self.0).collect();
        let threads = thread::available_parallelism().map_or(1, usize::from);
        let lot = |first: usize| {
            cases.iter().skip(first).step_by(threads).map(|case| fate(case)).collect::<Vec<_>>()
        };
        let mut lots: Vec<_> = thread::scope(|scope| {
            let started: Vec<_> = (0..threads).map(|first| scope.spawn(move || lot(first))).collect();
            started.into_iter().map(|thread| thread.join().unwrap().into_iter()).collect()
        });
        (0..cases.len()).map(|k| lots[k % threads].next().unwrap()).collect()
    }
}
