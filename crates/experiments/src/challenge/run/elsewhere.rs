//! An answer to one case that was given on another machine, and how it travels.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::Entrant;
use super::one::{PRINTED, Watched, watched};
use super::record::End;
use super::scratch::{AnswerFile, KEPT_BYTES, Scratch};
use crate::challenge::folder::ANSWER;

/// What came of one case elsewhere: the files of the answer, how the run went, what was printed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TravelledAnswer {
    end: End,
    code: Option<i32>,
    wall_s: f64,
    peak_memory_bytes: Option<u64>,
    /// Why a file of the answer is none.
    refused: Option<String>,
    printed: [PrintedText; 2],
    files: Vec<(String, Vec<u8>)>,
}

/// The beginning of what was printed, and how long all of it was.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct PrintedText {
    beginning: Vec<u8>,
    all: u64,
}

impl TravelledAnswer {
    /// Runs a program over a case, given by the folder of its public files, under the limits of the entrant.
    ///
    /// # Errors
    /// The program cannot be started or watched.
    pub fn by_program(entrant: &Entrant, public: &Path) -> io::Result<Self> {
        let scratch = Scratch::with_case(public)?;
        let went = watched(entrant, &scratch)?;
        let [out, err] = PRINTED.map(|name| PrintedText::read(&scratch.printed(name)));
        Self::of(went, &scratch.out(), [out?, err?])
    }

    /// Of a function that has written its answer into a folder; `said` is what it says of its failure.
    ///
    /// # Errors
    /// A file cannot be read.
    pub fn by_function(out: &Path, said: Option<&str>, wall_s: f64) -> io::Result<Self> {
        let (end, code) = if said.is_none() { (End::Exited, Some(0)) } else { (End::Raised, None) };
        let text = said.map(|said| format!("{said}\n")).unwrap_or_default().into_bytes();
        let printed = PrintedText { all: text.len() as u64, beginning: text };
        let went = Watched { end, code, wall_s, peak_memory_bytes: None, refused: None };
        Self::of(went, out, [PrintedText::default(), printed])
    }

    fn of(went: Watched, out: &Path, printed: [PrintedText; 2]) -> io::Result<Self> {
        let Watched { end, code, wall_s, peak_memory_bytes, mut refused } = went;
        let mut files = Vec::new();
        for name in ANSWER {
            match AnswerFile::of(out, name)? {
                AnswerFile::At(path) => files.push((name.to_owned(), fs::read(path)?)),
                AnswerFile::Refused(why) => refused = refused.or(Some(why)),
                AnswerFile::Missing => {}
            }
        }
        Ok(Self { end, code, wall_s, peak_memory_bytes, refused, printed, files })
    }

    /// As bytes, for another machine.
    ///
    /// # Errors
    /// None that a file could cause.
    pub fn to_bytes(&self) -> io::Result<Vec<u8>> {
        postcard::to_stdvec(self).map_err(io::Error::other)
    }

    /// What came from another machine.
    ///
    /// # Errors
    /// Bytes that are no such answer.
    pub fn from_bytes(bytes: &[u8]) -> io::Result<Self> {
        postcard::from_bytes(bytes).map_err(io::Error::other)
    }

    /// Puts it where the answer of a program of this machine would be.
    pub(super) fn unpack(self, scratch: &Scratch) -> io::Result<Watched> {
        let Self { end, code, wall_s, peak_memory_bytes, refused, printed, files } = self;
        for (name, bytes) in files.iter().filter(|(name, _)| ANSWER.contains(&name.as_str())) {
            fs::write(scratch.out().join(name), bytes)?;
        }
        for (name, text) in PRINTED.into_iter().zip(&printed) {
            let mut file = File::create(scratch.printed(name))?;
            file.write_all(&text.beginning)?;
            file.set_len(text.all)?;
        }
        Ok(Watched { end, code, wall_s, peak_memory_bytes, refused })
    }
}

impl PrintedText {
    fn read(path: &Path) -> io::Result<Self> {
        let file = File::open(path)?;
        let all = file.metadata()?.len();
        let mut beginning = Vec::new();
        file.take(KEPT_BYTES).read_to_end(&mut beginning)?;
        Ok(Self { beginning, all })
    }
}
