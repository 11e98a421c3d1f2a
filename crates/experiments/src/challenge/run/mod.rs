//! Running a program over the cases of a challenge.
//!
//! ```text
//! ANSWERS/answers.json            who answered, how it was called, what the program is made of, which challenge, which limits
//! ANSWERS/cases/case-001/         what it wrote, run.json, stdout.txt, stderr.txt
//! ```
//!
//! Each case is answered in a fresh folder that holds a copy of its public files; nothing the program is given leads to the
//! truth. This protects against accidents, not against a program that searches the disk. A case is saved completely or not at
//! all, so an interrupted run can be resumed.

mod begun;
mod elsewhere;
mod files;
mod inside;
mod limits;
mod one;
mod parts;
mod program;
mod record;
mod scratch;
#[cfg(unix)]
mod supervise;
#[cfg(target_os = "linux")]
mod tree;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::challenge::answer::{AskedCase, lint};
use crate::challenge::{Challenge, ChallengeError};
use crate::error::ExperimentError;
use crate::harness::{Progress, each, on_threads};
use crate::journal::Lock;
pub(crate) use begun::cases_folder;
pub use begun::{ANSWERS, RunHeader};
pub use elsewhere::TravelledAnswer;
pub use files::ProgramFiles;
pub use inside::{InsideAnswer, InsideBegin, InsideFunction, run_inside};
pub use limits::RunLimits;
pub use parts::{of_part, take_over};
pub use program::Program;
pub use record::{End, RunRecord};

/// A program, its name and its limits.
#[derive(Debug, Clone)]
pub struct Entrant {
    /// Name in the tables.
    pub name: String,
    /// How it is called.
    pub program: Program,
    /// What it may use.
    pub limits: RunLimits,
}

/// How to go about it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Manner {
    /// Cases at once.
    pub jobs: usize,
    /// Answer again what is answered.
    pub again: bool,
}

/// Beginning of the name of an answer that is not whole yet.
const PART: &str = ".part-";

/// What a run did.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Summary {
    /// Records of former runs, which are not made again.
    pub earlier: Vec<RunRecord>,
    /// Records of this run, in the order of the cases.
    pub fresh: Vec<RunRecord>,
}

/// The cases among these records that count as failed, each with its reason.
pub fn failures<'a>(
    challenge: &Challenge,
    answers: &Path,
    records: &'a [RunRecord],
) -> Vec<(&'a str, String)> {
    let why = |record| why_failed(challenge, answers, record);
    records.iter().filter_map(|record| Some((record.case.as_str(), why(record)?))).collect()
}

/// Why a case counts as failed: the program failed, or what it wrote cannot be read.
fn why_failed(challenge: &Challenge, answers: &Path, record: &RunRecord) -> Option<String> {
    let unreadable = || {
        let case = AskedCase::read(&challenge.case(&record.case)).ok();
        let faults = lint(&begun::cases_folder(answers).join(&record.case), case).faults;
        Some(format!("the answer cannot be read: {}", faults.first()?))
    };
    record.failure.clone().or_else(unreadable)
}

/// Runs a program over those of the wanted cases that it has not answered.
///
/// # Errors
/// [`ChallengeError`] when the challenge changed, the folder belongs to another run, a file cannot be written, or the progress asks
/// for a stop. What the program does wrong is a record.
pub fn run(
    challenge: &Challenge,
    entrant: &Entrant,
    answers: &Path,
    manner: Manner,
    is_wanted: &dyn Fn(&str) -> bool,
    progress: &dyn Progress,
) -> Result<Summary, ChallengeError> {
    let Prepared { begun, _lock, cases, earlier, pending } =
        Prepared::of(challenge, entrant, answers, manner.again, is_wanted)?;
    progress.begin((earlier.len() + pending.len()) as u64, earlier.len() as u64);
    let one = |id: &&String| {
        let record = one::answer(challenge, id, &cases, |scratch| one::watched(entrant, scratch))?;
        progress.advance(1);
        Ok::<_, ChallengeError>(record)
    };
    let fresh = on_threads(manner.jobs, || each(pending.par_iter(), progress, one))?;
    begun.refuse_edits(answers, &entrant.program)?;
    Ok(Summary { earlier, fresh })
}

/// A folder of answers at the beginning of a run.
struct Prepared<'a> {
    begun: RunHeader,
    /// Held as long as the run lasts.
    _lock: Lock,
    /// Folder of the answered cases.
    cases: PathBuf,
    /// Records of the wanted cases that are answered.
    earlier: Vec<RunRecord>,
    /// Wanted cases without an answer.
    pending: Vec<&'a String>,
}

impl<'a> Prepared<'a> {
    fn of(
        challenge: &'a Challenge,
        entrant: &Entrant,
        answers: &Path,
        again: bool,
        is_wanted: &dyn Fn(&str) -> bool,
    ) -> Result<Self, ChallengeError> {
        challenge.verify_public()?;
        let begun = RunHeader::new(challenge, entrant)?;
        let lock = begun.settle(answers, again)?;
        let cases = cases_folder(answers);
        remove_remains(&cases).map_err(ExperimentError::writing(&cases))?;
        scratch::sweep(&std::env::temp_dir());
        let wanted = challenge.manifest().cases.iter().filter(|id| is_wanted(id));
        let (answered, pending): (Vec<&String>, Vec<&String>) =
            wanted.partition(|id| is_answered(&cases.join(id), &challenge.case_sha256(id)));
        let earlier = answered.iter().map(|id| RunRecord::read(&cases.join(id))).collect::<Result<_, _>>()?;
        Ok(Self { begun, _lock: lock, cases, earlier, pending })
    }
}

/// Removes what a killed run was about to keep.
fn remove_remains(cases: &Path) -> io::Result<()> {
    for entry in fs::read_dir(cases)? {
        let entry = entry?;
        if entry.file_name().to_string_lossy().starts_with(PART) {
            fs::remove_dir_all(entry.path())?;
        }
    }
    Ok(())
}

/// True when there is a record made from these very files.
fn is_answered(folder: &Path, case_sha256: &str) -> bool {
    RunRecord::read(folder).is_ok_and(|record| record.case_sha256 == case_sha256)
}
