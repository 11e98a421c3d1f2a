//! A function of the calling program over the cases of a challenge, without a process for each; it may have others answer.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use super::elsewhere::TravelledAnswer;
use super::one::{PRINTED, Watched, answer};
use super::record::End;
use super::scratch::Scratch;
use super::{Entrant, Prepared, Summary};
use crate::challenge::{Challenge, ChallengeError};

/// Answers a case: its folder, and the folder for the answer; gives the answer itself where it comes from another machine. An error is what
/// the function says of its failure.
pub type InsideAnswer<'a> = dyn Fn(&Path, &Path) -> Result<Option<TravelledAnswer>, String> + 'a;

/// Hears which program is run over which cases, by the folders of their public files in the order in which they are asked for.
pub type InsideBegin<'a> = dyn Fn(&Entrant, &[PathBuf]) + 'a;

/// A function that answers cases, and whether it asked for the end of a run.
#[derive(Clone, Copy)]
pub struct InsideFunction<'a> {
    /// Hears of all cases before the first is asked for.
    pub begin: &'a InsideBegin<'a>,
    /// The function.
    pub answer: &'a InsideAnswer<'a>,
    /// True after a case that is no answer: the run ends.
    pub is_stopped: &'a dyn Fn() -> bool,
}

/// Runs a function over those of the wanted cases that it has not answered, one after the other on this thread. The folder of answers is that
/// of a program; limits of time, memory and output are not kept, and a function sees all that its process sees.
///
/// # Errors
/// As [`run`](super::run()); [`ChallengeError::Start`] where it is stopped after a case, which is not kept then.
pub fn run_inside(
    challenge: &Challenge,
    entrant: &Entrant,
    answers: &Path,
    again: bool,
    is_wanted: &dyn Fn(&str) -> bool,
    function: InsideFunction<'_>,
) -> Result<Summary, ChallengeError> {
    let prepared = Prepared::of(challenge, entrant, answers, again, is_wanted)?;
    let mut fresh = Vec::with_capacity(prepared.pending.len());
    let folders: Vec<PathBuf> = prepared.pending.iter().map(|id| challenge.case(id)).collect();
    (function.begin)(entrant, &folders);
    for id in &prepared.pending {
        let watched = |scratch: &Scratch| {
            let watched = asked(function.answer, scratch)?;
            // What was broken off is no answer.
            if (function.is_stopped)() { Err(io::ErrorKind::Interrupted.into()) } else { Ok(watched) }
        };
        fresh.push(answer(challenge, id, &prepared.cases, watched)?);
    }
    prepared.begun.refuse_edits(answers, &entrant.program)?;
    Ok(Summary { earlier: prepared.earlier, fresh })
}

fn asked(function: &InsideAnswer<'_>, scratch: &Scratch) -> io::Result<Watched> {
    let start = Instant::now();
    let said = function(&scratch.case(), &scratch.out());
    let wall_s = start.elapsed().as_secs_f64();
    let (end, code, said) = match said {
        Ok(Some(elsewhere)) => return elsewhere.unpack(scratch),
        Ok(None) => (End::Exited, Some(0), String::new()),
        Err(said) => (End::Raised, None, said + "\n"),
    };
    for (name, text) in PRINTED.into_iter().zip(["", &said]) {
        fs::write(scratch.printed(name), text)?;
    }
    Ok(Watched { end, code, wall_s, peak_memory_bytes: None, refused: None })
}
