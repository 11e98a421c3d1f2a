//! One run at a time in a folder.

use std::fs::{self, File, TryLockError};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};

use crate::error::ExperimentError;

/// A lock of the operating system: it ends with the process, however that ends.
#[derive(Debug)]
pub(crate) struct Lock(File);

/// Why a lock is not to be had.
pub(crate) enum Locked {
    /// Another run holds it; its process, when it is known.
    By(Option<u32>),
    /// The file cannot be used.
    Not(PathBuf, io::Error),
}

impl Locked {
    pub(crate) fn of(self, folder: &Path) -> ExperimentError {
        match self {
            Self::By(holder) => ExperimentError::Busy { folder: folder.to_owned(), holder },
            Self::Not(path, cause) => ExperimentError::Write { path, cause },
        }
    }
}

impl Lock {
    /// Takes a lock and writes the number of the process into its file, for messages.
    pub(crate) fn take(path: &Path) -> Result<Self, Locked> {
        let failed = |cause| Locked::Not(path.to_owned(), cause);
        let open = File::options().read(true).write(true).create(true).truncate(false).open(path);
        let mut file = open.map_err(failed)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let holder = fs::read_to_string(path).ok().and_then(|text| text.trim().parse().ok());
                return Err(Locked::By(holder));
            }
            Err(TryLockError::Error(cause)) => return Err(failed(cause)),
        }
        let emptied = file.set_len(0).and_then(|()| file.rewind());
        emptied.and_then(|()| writeln!(file, "{}", std::process::id())).map_err(failed)?;
        Ok(Self(file))
    }
}

impl Drop for Lock {
    /// Said aloud: a program that another thread is just starting holds a copy of the file for a moment, and the lock with it.
    fn drop(&mut self) {
        // What cannot be unlocked is unlocked when the file is closed.
        let _ = self.0.unlock();
    }
}
