//! Writing a file whole or not at all.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Writes a file through `fill` so that readers see the old file or the complete new one, never a part.
///
/// The bytes go to a temporary file in the same folder, are flushed to the disk and renamed. Nothing is left behind
/// when something fails. A link stays a link: what it points at is written. What is no file (`/dev/null`,
/// `/dev/stdout`, a pipe) must not be renamed over; it receives the bytes once they are complete.
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
    if fs::metadata(path).is_ok_and(|old| !old.is_file() && !old.is_dir()) {
        let mut bytes = Vec::new();
        fill(&mut bytes)?;
        return fs::OpenOptions::new().write(true).open(path)?.write_all(&bytes);
    }
    let path = &fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut temporary = tempfile::Builder::new();
    temporary.prefix(".hexbench-").suffix(".part");
    give_ordinary_permissions(&mut temporary);
    let mut buffer = BufWriter::new(temporary.tempfile_in(folder)?);
    fill(&mut buffer)?;
    let file = buffer.into_inner().map_err(io::IntoInnerError::into_error)?;
    file.as_file().sync_all()?;
    keep_permissions_of(path, file.as_file())?;
    file.persist(path).map(drop).map_err(|failed| failed.error)
}

/// A temporary file is private by default; a result is an ordinary file (the umask still applies).
#[cfg(unix)]
fn give_ordinary_permissions(temporary: &mut tempfile::Builder<'_, '_>) {
    use std::os::unix::fs::PermissionsExt;
    temporary.permissions(fs::Permissions::from_mode(0o666));
}

#[cfg(not(unix))]
fn give_ordinary_permissions(_: &mut tempfile::Builder<'_, '_>) {}

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
    fn a_missing_folder_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        assert!(atomic_write(&folder.path().join("none/x"), |_| Ok(())).is_err());
    }
}
