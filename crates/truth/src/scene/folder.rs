//! Writing what a scene gives to a folder, in chunks computed in parallel and written in order.
//!
//! Everything goes to a temporary folder first; the last step puts it into its place.

use std::{
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
};

use hexbench_core::Dataset;
use hexbench_core::files::{FileError, atomic_write, campaign_to_csv, open_to_readers, write_hexapod};
use rayon::prelude::*;

use super::{Instrument, Measured, PartName, RowError, VirtualBench, balls_file, loads_file, sealed_truth};

/// Rows computed at a time by one thread.
const CHUNK: u64 = 1024;
/// Chunks of a round, per thread: their text waits in memory until it is written.
const CHUNKS_PER_THREAD: usize = 4;

/// What a folder may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// A folder with anything in it stays as it is.
    Refused,
    /// Files of the same names are replaced.
    Replaced,
}

/// Why a simulation ended early. Nothing is left behind then.
#[derive(Debug, thiserror::Error)]
pub enum SimulationError {
    /// A row without a state of rest.
    #[error(transparent)]
    Row(#[from] RowError),
    /// The folder is not empty.
    #[error("{}: the folder is not empty", .0.display())]
    NotEmpty(PathBuf),
    /// Something cannot be written.
    #[error("{}: cannot be written: {cause}", path.display())]
    Write {
        /// File or folder.
        path: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
}

impl VirtualBench<'_> {
    /// Measures all rows and writes the folder; `progress` hears how many rows are done.
    ///
    /// # Errors
    /// [`SimulationError`].
    pub fn write(
        &self,
        folder: &Path,
        existing: Existing,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<(), SimulationError> {
        let failed = |cause| SimulationError::Write { path: folder.to_owned(), cause };
        if existing == Existing::Refused && has_entries(folder).map_err(failed)? {
            return Err(SimulationError::NotEmpty(folder.to_owned()));
        }
        let parent = folder.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        fs::create_dir_all(parent).map_err(failed)?;
        let prefix = tempfile::Builder::new().prefix(".hexbench-").suffix(".part").tempdir_in(parent);
        let temporary = prefix.map_err(failed)?;
        self.fill(temporary.path(), folder, progress)?;
        put_in_place(temporary, folder).map_err(failed)
    }

    /// Writes every file into `at`; messages call it `shown`.
    fn fill(&self, at: &Path, shown: &Path, progress: &(dyn Fn(u64) + Sync)) -> Result<(), SimulationError> {
        write_hexapod(&at.join("hexapod.toml"), &self.scene().hexapod)?;
        self.table(PartName::Training, [at, shown], progress)?;
        if !self.scene().part(PartName::Holdout).is_empty() {
            self.table(PartName::Holdout, [at, shown], progress)?;
        }
        if let Some(text) = balls_file::nominal(&self.scene().instrument) {
            whole(at, shown, "balls.toml", |out| out.write_all(text.as_bytes()))?;
        }
        let sealed = at.join("sealed");
        fs::create_dir(&sealed).map_err(|cause| SimulationError::Write { path: shown.to_owned(), cause })?;
        let truth = sealed_truth::of(self);
        whole(&sealed, shown, "truth.json", |out| writeln!(out, "{truth:#}"))
    }

    fn table(
        &self,
        part: PartName,
        [at, shown]: [&Path; 2],
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<(), SimulationError> {
        let rows = |out: &mut dyn Write, beside: Option<[&mut dyn Write; 2]>| {
            self.stream(part, out, beside, progress)
        };
        let mut failed = None;
        let mut kept = |result: Result<(), Stop>| match result {
            Ok(()) => Ok(()),
            Err(Stop::Write(cause)) => Err(cause),
            Err(Stop::Row(row)) => {
                failed = Some(row);
                Err(io::Error::other("a row without a state of rest"))
            }
        };
        let result = whole(at, shown, part.file(), |out| {
            if !balls_are_kept(self, part) {
                return kept(rows(out, None));
            }
            atomic_write(&at.join("balls.csv"), |balls| {
                atomic_write(&at.join("loads.csv"), |loads| kept(rows(out, Some([balls, loads]))))
            })
        });
        failed.map_or(result, |row| Err(row.into()))
    }

    fn stream(
        &self,
        part: PartName,
        out: &mut dyn Write,
        mut beside: Option<[&mut dyn Write; 2]>,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<(), Stop> {
        out.write_all(&table_of(self, &[])?)?;
        if let Some([balls, loads]) = &mut beside {
            balls_file::header(*balls)?;
            loads_file::header(*loads, &self.empty())?;
        }
        let rows = self.scene().part(part).len();
        let starts: Vec<u64> = (0..rows.div_ceil(CHUNK)).map(|chunk| chunk * CHUNK).collect();
        for round in starts.chunks(CHUNKS_PER_THREAD * rayon::current_num_threads()) {
            let texts: Vec<Result<[Vec<u8>; 3], Stop>> = round
                .par_iter()
                .map(|&start| {
                    let end = rows.min(start + CHUNK);
                    let measured = self.measure(part, start..end)?;
                    progress(end - start);
                    Ok(text_of(self, &measured, start, balls_are_kept(self, part))?)
                })
                .collect();
            for text in texts {
                let [table, touched, applied] = text?;
                out.write_all(&table)?;
                if let Some([balls, loads]) = &mut beside {
                    balls.write_all(&touched)?;
                    loads.write_all(&applied)?;
                }
            }
        }
        Ok(())
    }
}

fn balls_are_kept(bench: &VirtualBench<'_>, part: PartName) -> bool {
    part == PartName::Training && matches!(bench.scene().instrument, Instrument::Balls(_))
}

/// Some rows as a table, its header included.
fn table_of(bench: &VirtualBench<'_>, measured: &[Measured]) -> io::Result<Vec<u8>> {
    let observations = measured.iter().flat_map(Measured::observations).collect();
    let mut text = Vec::new();
    campaign_to_csv(&mut text, &bench.scene().hexapod, &Dataset { observations, ..bench.empty() })?;
    Ok(text)
}

fn text_of(
    bench: &VirtualBench<'_>,
    measured: &[Measured],
    start: u64,
    with_balls: bool,
) -> io::Result<[Vec<u8>; 3]> {
    let table = table_of(bench, measured)?;
    let header = table.iter().position(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    let (mut balls, mut loads) = (Vec::new(), Vec::new());
    for (index, row) in (start..).zip(measured).filter(|_| with_balls) {
        balls_file::rows(&mut balls, index, row)?;
        loads_file::row(&mut loads, &bench.empty(), index, row)?;
    }
    Ok([table[header..].to_vec(), balls, loads])
}

/// What ends a table early.
enum Stop {
    Row(RowError),
    Write(io::Error),
}

impl From<RowError> for Stop {
    fn from(row: RowError) -> Self {
        Self::Row(row)
    }
}

impl From<io::Error> for Stop {
    fn from(cause: io::Error) -> Self {
        Self::Write(cause)
    }
}

fn whole(
    at: &Path,
    shown: &Path,
    name: &str,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), SimulationError> {
    atomic_write(&at.join(name), |out| fill(out))
        .map_err(|cause| SimulationError::Write { path: shown.join(name), cause })
}

fn has_entries(folder: &Path) -> io::Result<bool> {
    match fs::read_dir(folder) {
        Ok(mut entries) => Ok(entries.next().is_some()),
        Err(missing) if missing.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(other) => Err(other),
    }
}

/// Renames the whole folder where there is none yet, else file by file.
fn put_in_place(temporary: tempfile::TempDir, folder: &Path) -> io::Result<()> {
    if !folder.exists() {
        open_to_readers(temporary.path())?;
        fs::rename(temporary.path(), folder)?;
        // Nothing is left under the temporary name.
        let _ = temporary.keep();
        return Ok(());
    }
    move_files(temporary.path(), folder)
}

fn move_files(from: &Path, to: &Path) -> io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let place = to.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            move_files(&entry.path(), &place)?;
        } else {
            fs::rename(entry.path(), place)?;
        }
    }
    Ok(())
}
