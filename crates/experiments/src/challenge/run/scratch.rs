//! The fresh folder in which one case is answered.

use std::fs::{self, File, TryLockError};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::Duration;

use hexbench_core::files::atomic_write;
use tempfile::TempDir;

use crate::challenge::folder::PUBLIC;

/// Longest text of a program's own that is kept.
pub(super) const KEPT_BYTES: u64 = 16_384;
/// Longest file of an answer.
pub(crate) const LONGEST_ANSWER: u64 = 16_000_000;

/// How names of these folders begin.
const PREFIX: &str = "hexbench-case-";
/// File in it that is locked as long as the folder is used.
const LOCK: &str = "lock";
/// Age from which a folder that is not locked is remains: the file is made right after the folder, and locked right after that.
const SURELY_LOCKED: Duration = Duration::from_mins(1);

/// A folder with a copy of a case; it goes away when dropped, and is swept by a later run when the program was killed.
pub(super) struct Scratch {
    folder: TempDir,
    _lock: File,
}

impl Scratch {
    pub(super) fn with_case(public: &Path) -> io::Result<Self> {
        let folder = tempfile::Builder::new().prefix(PREFIX).tempdir()?;
        let lock = File::create_new(folder.path().join(LOCK))?;
        lock.lock()?;
        let scratch = Self { folder, _lock: lock };
        for folder in [scratch.case(), scratch.out(), scratch.work()] {
            fs::create_dir(folder)?;
        }
        for name in PUBLIC {
            fs::copy(public.join(name), scratch.case().join(name))?;
        }
        Ok(scratch)
    }

    /// All of it.
    pub(super) fn root(&self) -> &Path {
        self.folder.path()
    }

    /// What is read.
    pub(super) fn case(&self) -> PathBuf {
        self.root().join("case")
    }

    /// What is written.
    pub(super) fn out(&self) -> PathBuf {
        self.root().join("out")
    }

    /// Where the program stands.
    pub(super) fn work(&self) -> PathBuf {
        self.root().join("work")
    }

    /// A file for what the program prints.
    pub(super) fn printed(&self, name: &str) -> PathBuf {
        self.root().join(name)
    }

    /// Copies a file of the answer; false when the program did not write it.
    pub(super) fn take(&self, name: &str, to: &Path) -> io::Result<bool> {
        match AnswerFile::of(&self.out(), name)? {
            AnswerFile::At(path) => fs::copy(&path, to.join(name)).map(|_| true),
            AnswerFile::Refused(why) => Err(io::Error::other(why)),
            AnswerFile::Missing => Ok(false),
        }
    }

    /// Keeps the beginning of what the program printed.
    pub(super) fn keep_printed(&self, name: &str, to: &Path) -> io::Result<()> {
        let mut text = Vec::new();
        let file = File::open(self.printed(name))?;
        let all = file.metadata()?.len();
        file.take(KEPT_BYTES).read_to_end(&mut text)?;
        if all > KEPT_BYTES {
            text.extend(format!("\n[cut here: {all} bytes were printed]\n").as_bytes());
        }
        atomic_write(&to.join(name), |out| out.write_all(&text))
    }
}

/// What is where a file of an answer should be.
pub(super) enum AnswerFile {
    /// The file.
    At(PathBuf),
    /// Something that is not taken, and why.
    Refused(String),
    /// Nothing.
    Missing,
}

impl AnswerFile {
    /// Looks into the folder of an answer. A link is not followed: it could lead anywhere.
    pub(super) fn of(out: &Path, name: &str) -> io::Result<Self> {
        let path = out.join(name);
        match fs::symlink_metadata(&path) {
            Ok(found) if !found.is_file() => Ok(Self::Refused(format!("{name} is not an ordinary file"))),
            Ok(found) if found.len() > LONGEST_ANSWER => {
                Ok(Self::Refused(format!("{name} is longer than {LONGEST_ANSWER} bytes")))
            }
            Ok(_) => Ok(Self::At(path)),
            Err(cause) if cause.kind() == io::ErrorKind::NotFound => Ok(Self::Missing),
            Err(cause) => Err(cause),
        }
    }
}

/// Removes the folders that killed runs have left in a place; what cannot be removed, of other users perhaps, stays.
pub(super) fn sweep(place: &Path) {
    let Ok(entries) = fs::read_dir(place) else { return };
    for entry in entries.flatten() {
        let is_one = entry.file_name().to_string_lossy().starts_with(PREFIX);
        if is_one && entry.file_type().is_ok_and(|kind| kind.is_dir()) && is_left(&entry.path()) {
            let _ = fs::remove_dir_all(entry.path());
        }
    }
}

fn is_left(folder: &Path) -> bool {
    let made = fs::metadata(folder).and_then(|found| found.modified());
    let is_old = made.is_ok_and(|made| made.elapsed().is_ok_and(|age| age > SURELY_LOCKED));
    let is_used = |lock: File| matches!(lock.try_lock(), Err(TryLockError::WouldBlock));
    is_old && !File::open(folder.join(LOCK)).is_ok_and(is_used)
}

/// Bytes of all files in a folder, links not followed.
pub(super) fn bytes_in(folder: &Path) -> u64 {
    let Ok(entries) = fs::read_dir(folder) else { return 0 };
    let size = |entry: fs::DirEntry| match entry.metadata() {
        Ok(found) if found.is_dir() => bytes_in(&entry.path()),
        Ok(found) => found.len(),
        Err(_) => 0,
    };
    entries.flatten().map(size).sum()
}

#[cfg(test)]
mod tests {
    use std::time::SystemTime;

    use super::*;

    #[test]
    fn folders_of_killed_runs_are_swept_and_those_in_use_stay() {
        let place = tempfile::tempdir().unwrap();
        let made = |name: &str| {
            let folder = place.path().join(name);
            fs::create_dir_all(folder.join("out")).unwrap();
            (File::create_new(folder.join(LOCK)).unwrap(), folder)
        };
        let (used, in_use) = made("hexbench-case-used");
        used.lock().unwrap();
        let (_, left) = made("hexbench-case-left");
        let (_, other) = made("of-someone-else");
        let before = SystemTime::now().checked_sub(2 * SURELY_LOCKED).unwrap();
        for folder in [&in_use, &left, &other] {
            File::open(folder).unwrap().set_modified(before).unwrap();
        }
        // One that is being made: its file is there, and not locked yet.
        let (_, fresh) = made("hexbench-case-fresh");
        sweep(place.path());
        assert!(in_use.exists() && other.exists() && fresh.exists() && !left.exists());
    }
}
