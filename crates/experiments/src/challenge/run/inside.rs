//! A function of the calling program over the cases of a challenge, without a process for each.

use std::fs;
use std::io;
use std::path::Path;
use std::time::Instant;

use super::one::{PRINTED, Watched, answer};
use super::record::End;
use super::scratch::Scratch;
use super::{Entrant, Manner, Prepared, Summary};
use crate::challenge::{Challenge, ChallengeError};

/// Answers a case: its folder, and the folder for the answer. An error is what the function says of its failure.
pub type InsideAnswer<'a> = dyn Fn(&Path, &Path) -> Result<(), String> + 'a;

/// Runs a function over the cases that it has not answered, one after the other on this thread. The folder of answers is that of a
/// program; limits of time, memory and output are not kept, and a function sees all that its process sees.
///
/// # Errors
/// As [`run_some`](super::run_some); [`ChallengeError::Start`] where `stop` says so after a case, which is not kept then.
pub fn run_inside(
    challenge: &Challenge,
    entrant: &Entrant,
    answers: &Path,
    manner: Manner,
    function: &InsideAnswer<'_>,
    stop: &dyn Fn() -> bool,
) -> Result<Summary, ChallengeError> {
    let prepared = Prepared::of(challenge, entrant, answers, manner.again, &|_| true)?;
    let mut fresh = Vec::with_capacity(prepared.pending.len());
    for id in &prepared.pending {
        let watched = |scratch: &Scratch| {
            let watched = asked(function, scratch)?;
            // What was broken off is no answer.
            if stop() { Err(io::ErrorKind::Interrupted.into()) } else { Ok(watched) }
        };
        fresh.push(answer(challenge, id, &prepared.cases, watched)?);
    }
    prepared.begun.refuse_edits(answers, &entrant.program)?;
    Ok(Summary { known: prepared.ids.len() - prepared.pending.len(), fresh })
}

fn asked(function: &InsideAnswer<'_>, scratch: &Scratch) -> io::Result<Watched> {
    let start = Instant::now();
    let said = function(&scratch.case(), &scratch.out());
    let wall_s = start.elapsed().as_secs_f64();
    let (code, said) = said.map_or_else(|said| (1, said + "\n"), |()| (0, String::new()));
    for (name, text) in PRINTED.into_iter().zip(["", &said]) {
        fs::write(scratch.printed(name), text)?;
    }
    Ok(Watched { end: End::Exited, code: Some(code), wall_s, peak_memory_bytes: None })
}
