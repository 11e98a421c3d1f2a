//! One case, answered by one program.

use std::fs::{self, File};
use std::io;
use std::path::Path;
use std::process::{Command, Stdio};

use hexbench_core::files::{atomic_write, open_to_readers};
use tempfile::TempDir;

use super::record::{End, RunRecord};
use super::scratch::Scratch;
use super::{Entrant, PART, RunLimits};
use crate::challenge::folder::{ANSWER, PREDICTIONS, RUN};
use crate::challenge::stored::json;
use crate::challenge::{Challenge, ChallengeError};
use crate::error::ExperimentError;

/// Files of what a program prints.
pub(super) const PRINTED: [&str; 2] = ["stdout.txt", "stderr.txt"];

/// How it went, before the answer is looked at.
#[derive(Debug, Clone)]
pub(super) struct Watched {
    pub(super) end: End,
    pub(super) code: Option<i32>,
    pub(super) wall_s: f64,
    pub(super) peak_memory_bytes: Option<u64>,
    /// Why a file of the answer is none, where that was seen elsewhere.
    pub(super) refused: Option<String>,
}

/// Answers a case and keeps what came of it in a folder of `cases`.
pub(super) fn answer(
    challenge: &Challenge,
    id: &str,
    cases: &Path,
    watched: impl FnOnce(&Scratch) -> io::Result<Watched>,
) -> Result<RunRecord, ChallengeError> {
    let start = |cause| ChallengeError::Start { case: id.to_owned(), cause };
    let scratch = Scratch::with_case(&challenge.case(id)).map_err(start)?;
    let watched = watched(&scratch).map_err(start)?;
    let part =
        tempfile::Builder::new().prefix(PART).tempdir_in(cases).map_err(ExperimentError::writing(cases))?;
    let record =
        kept(challenge, id, &scratch, watched, part.path()).map_err(ExperimentError::writing(part.path()))?;
    let place = cases.join(id);
    put(part, &place).map_err(ExperimentError::writing(&place))?;
    Ok(record)
}

/// An answer takes the place of an unreadable one, whole or not at all.
pub(super) fn put(part: TempDir, place: &Path) -> io::Result<()> {
    if place.exists() {
        fs::remove_dir_all(place)?;
    }
    fs::rename(part.keep(), place)
}

/// Copies the answer, what was printed and the record.
fn kept(
    challenge: &Challenge,
    id: &str,
    scratch: &Scratch,
    watched: Watched,
    to: &Path,
) -> io::Result<RunRecord> {
    let mut record = RunRecord::new(id, challenge.case_sha256(id), watched.end, watched.code);
    record.wall_s = (watched.wall_s * 1e3).round() / 1e3;
    record.peak_memory_mb = watched.peak_memory_bytes.map(|bytes| (bytes as f64 / 1e5).round() / 10.0);
    record.failure = failure(&watched).or(watched.refused);
    for name in ANSWER {
        match scratch.take(name, to) {
            Ok(true) => record.files.push(name.to_owned()),
            Ok(false) => {}
            Err(why) => record.failure = record.failure.or(Some(why.to_string())),
        }
    }
    if record.failure.is_none() && !record.files.iter().any(|f| f == PREDICTIONS) {
        record.failure = Some(format!("it wrote no {PREDICTIONS}"));
    }
    for name in PRINTED {
        scratch.keep_printed(name, to)?;
    }
    if let (Some(why), Some(said)) = (&mut record.failure, complaint(to)) {
        match record.end {
            End::Exited => *why = format!("{why}: {said}"),
            End::Raised => *why = format!("{why} {said}"),
            End::Killed | End::TimeLimit | End::MemoryLimit | End::OutputLimit => {}
        }
    }
    atomic_write(&to.join(RUN), |out| out.write_all(json(&record).as_bytes()))?;
    open_to_readers(to)?;
    Ok(record)
}

/// What a program says of its failure: the first line of its errors that is neither indented nor the head of a trace.
fn complaint(folder: &Path) -> Option<String> {
    const LONGEST: usize = 160;
    let text = fs::read(folder.join(PRINTED[1])).ok()?;
    let text = String::from_utf8_lossy(&text);
    let telling =
        |line: &&str| !line.is_empty() && !line.starts_with([' ', '\t']) && !line.starts_with("Traceback");
    let line = text.lines().find(telling)?;
    Some(line.chars().filter(|c| !c.is_control()).take(LONGEST).collect())
}

fn failure(watched: &Watched) -> Option<String> {
    let code = watched.code.unwrap_or(0);
    match watched.end {
        End::Exited if code == 0 => None,
        End::Exited => Some(format!("exit code {code}")),
        End::Raised => Some("raised".to_owned()),
        End::Killed => Some(format!("ended by signal {code}")),
        End::TimeLimit => Some("time limit".to_owned()),
        End::MemoryLimit => Some("memory limit".to_owned()),
        End::OutputLimit => Some("output limit".to_owned()),
    }
}

#[cfg(unix)]
pub(super) fn watched(entrant: &Entrant, scratch: &Scratch) -> io::Result<Watched> {
    super::supervise::watch(command(entrant, scratch)?, &entrant.limits, scratch.root())
}

#[cfg(not(unix))]
pub(super) fn watched(_: &Entrant, _: &Scratch) -> io::Result<Watched> {
    Err(io::Error::new(io::ErrorKind::Unsupported, "limits can be kept on Unix systems only"))
}

/// Sets the limits of the system, then becomes the program.
const LIMITED: &str = "ulimit -c 0; ulimit -v \"$1\" && ulimit -f \"$2\" && ulimit -t \"$3\" || exit 125\n\
                       shift 3; exec \"$@\"";

/// The program under limits, with nothing of this process's surroundings but the PATH.
fn command(entrant: &Entrant, scratch: &Scratch) -> io::Result<Command> {
    let Entrant { program, limits, .. } = entrant;
    let mut command = Command::new("sh");
    command.args(["-c", LIMITED, "sh"]).args(RunLimits::of_the_system(limits)).args(program.line());
    command.arg(scratch.case()).arg(scratch.out()).current_dir(scratch.work());
    command.env_clear().env("HOME", scratch.work()).env("TMPDIR", scratch.work()).env("LC_ALL", "C.UTF-8");
    if let Some(path) = std::env::var_os("PATH") {
        command.env("PATH", path);
    }
    let [out, err] = PRINTED.map(|name| File::create(scratch.printed(name)));
    command.stdin(Stdio::null()).stdout(out?).stderr(err?);
    Ok(command)
}
