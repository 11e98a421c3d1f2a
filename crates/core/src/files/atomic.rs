//! Writing a file whole or not at all.

use std::collections::BTreeSet;
use std::fs::{self, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use tempfile::NamedTempFile;

use super::Destination;
use super::destination::folder_of;

/// How names of temporary files begin and end.
const PREFIX: &str = ".hexbench-";
const SUFFIX: &str = ".part";

/// Writes an output through `fill`: a file so that readers see the old one or the complete new one, never a part.
///
/// The bytes go to a temporary file in the same folder, are flushed to the disk and renamed. Nothing is left behind
/// when something fails, and what a killed program left in the folder is removed. A link stays a link: what it points at is
/// written. What is no file ([`Destination`]) receives the bytes once they are complete; a reader of it that has gone away is
/// no error.
///
/// # Errors
/// Whatever `fill`, the disk or the folder report; a full disk is reported and not lost in a dropped buffer.
///
/// # Example
/// ```
/// # fn main() -> std::io::Result<()> {
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("answer.txt");
/// hexbench_core::files::atomic_write(&path, |out| writeln!(out, "42"))?;
/// assert_eq!(std::fs::read_to_string(path)?, "42\n");
/// # Ok(())
/// # }
/// ```
pub fn atomic_write(
    path: &Path,
    fill: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> io::Result<()> {
    match Destination::of(path)? {
        Destination::StandardOutput => stream(io::stdout(), fill),
        Destination::Stream(place) => stream(fs::OpenOptions::new().append(true).open(place)?, fill),
        Destination::File(place) => replace(&place, fill),
    }
}

fn stream(
    mut to: impl Write,
    fill: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> io::Result<()> {
    let mut bytes = Vec::new();
    fill(&mut bytes)?;
    match to.write_all(&bytes).and_then(|()| to.flush()) {
        Err(cause) if cause.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        done => done,
    }
}

fn replace(place: &Path, fill: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>) -> io::Result<()> {
    let folder = folder_of(place);
    refuse_protected(place)?;
    sweep(folder);
    let file = temporary_in(folder).map_err(|cause| of_folder(folder, cause))?;
    let mut buffer = BufWriter::new(file.as_file());
    fill(&mut buffer)?;
    buffer.into_inner().map_err(io::IntoInnerError::into_error)?.sync_all()?;
    keep_permissions_of(place, file.as_file())?;
    file.persist(place).map(drop).map_err(|failed| failed.error)
}

/// A file that its owner has protected against writing is not replaced either, though a renamed file would not ask it.
fn refuse_protected(place: &Path) -> io::Result<()> {
    match fs::OpenOptions::new().append(true).open(place) {
        Err(cause) if cause.kind() == io::ErrorKind::PermissionDenied => {
            Err(io::Error::new(cause.kind(), "the file is protected against writing"))
        }
        _ => Ok(()),
    }
}

/// What a folder that takes no file says of itself.
fn of_folder(folder: &Path, cause: io::Error) -> io::Error {
    match cause.kind() {
        kind @ io::ErrorKind::PermissionDenied => {
            io::Error::new(kind, format!("the folder {} may not be written to", folder.display()))
        }
        _ => cause,
    }
}

/// A temporary file, locked as long as it is written, by which others know that it is no remains.
fn temporary_in(folder: &Path) -> io::Result<NamedTempFile> {
    loop {
        let mut temporary = tempfile::Builder::new();
        temporary.prefix(PREFIX).suffix(SUFFIX);
        give_ordinary_permissions(&mut temporary);
        let file = temporary.tempfile_in(folder)?;
        let taken = matches!(file.as_file().try_lock(), Err(TryLockError::WouldBlock));
        // Another program may have swept it away before it was locked.
        if !taken && file.path().exists() {
            return Ok(file);
        }
    }
}

/// Removes the temporary files that killed programs left in a folder, once for each folder that this program writes to.
fn sweep(folder: &Path) {
    static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    if !SWEPT.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.to_owned()) {
        return;
    }
    // What cannot be listed or removed stays: it stands in nobody's way.
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_temporary = name.starts_with(PREFIX) && name.ends_with(SUFFIX);
        if is_temporary && entry.file_type().is_ok_and(|kind| kind.is_file()) {
            remove_if_abandoned(&entry.path());
        }
    }
}

fn remove_if_abandoned(path: &Path) {
    if let Ok(file) = fs::OpenOptions::new().append(true).open(path)
        && file.try_lock().is_ok()
    {
        let _ = fs::remove_file(path);
    }
}

/// A temporary file is private by default; a result is an ordinary file (the umask still applies).
#[cfg(unix)]
fn give_ordinary_permissions(temporary: &mut tempfile::Builder<'_, '_>) {
    use std::os::unix::fs::PermissionsExt;
    temporary.permissions(fs::Permissions::from_mode(0o666));
}

#[cfg(not(unix))]
fn give_ordinary_permissions(_: &mut tempfile::Builder<'_, '_>) {}

/// A temporary folder is private; one that holds a result is an ordinary folder.
///
/// # Errors
/// What the system says of it.
#[cfg(unix)]
pub fn open_to_readers(folder: &Path) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(folder, fs::Permissions::from_mode(0o755))
}

/// A folder is as readable as any other.
///
/// # Errors
/// None.
#[cfg(not(unix))]
pub fn open_to_readers(_: &Path) -> io::Result<()> {
    Ok(())
}

fn keep_permissions_of(path: &Path, file: &fs::File) -> io::Result<()> {
    match fs::metadata(path) {
        Ok(old) if old.is_file() => file.set_permissions(old.permissions()),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_keeps_the_old_file_and_leaves_no_other() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("model.toml");
        atomic_write(&path, |out| out.write_all(b"old")).unwrap();
        let failed = atomic_write(&path, |out| {
            out.write_all(b"half")?;
            Err(io::Error::other("no space"))
        });
        assert!(failed.is_err());
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let [link, file] = ["link", "file"].map(|name| folder.path().join(name));
        fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        atomic_write(&link, |out| out.write_all(b"new")).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"new");
    }

    /// A socket stands for all that is no file: nothing may be renamed over it, also where the user might.
    #[cfg(unix)]
    #[test]
    fn what_is_no_file_is_not_replaced() {
        use std::os::unix::fs::FileTypeExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("socket");
        let _listener = std::os::unix::net::UnixListener::bind(&path).unwrap();
        assert!(atomic_write(&path, |out| out.write_all(b"new")).is_err());
        assert!(fs::metadata(&path).unwrap().file_type().is_socket());
        assert!(atomic_write(Path::new("/dev/null"), |out| out.write_all(b"gone")).is_ok());
        assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    }

    #[test]
    fn a_missing_folder_is_said_as_such() {
        let folder = tempfile::tempdir().unwrap();
        let failed = atomic_write(&folder.path().join("none/x"), |_| Ok(())).unwrap_err().to_string();
        assert!(failed.starts_with("there is no folder ") && failed.ends_with("none"), "{failed}");
    }

    #[test]
    fn what_a_killed_program_left_is_removed_and_what_is_being_written_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().canonicalize().unwrap();
        fs::write(place.join(".hexbench-dead.part"), "half").unwrap();
        fs::write(place.join(".hexbench-notes.txt"), "mine").unwrap();
        let alive = temporary_in(&place).unwrap();
        atomic_write(&place.join("x"), |out| out.write_all(b"new")).unwrap();
        assert!(!place.join(".hexbench-dead.part").exists());
        assert!(place.join(".hexbench-notes.txt").exists() && alive.path().exists());
    }
}
