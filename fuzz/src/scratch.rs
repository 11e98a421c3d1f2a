//! Files for readers that open them by name.

use std::path::Path;

use tempfile::TempDir;

thread_local! {
    /// One folder a thread, in memory where the system has such a place.
    static FOLDER: TempDir = made();
}

fn made() -> TempDir {
    let memory = Path::new("/dev/shm");
    let folder = tempfile::Builder::new().prefix("hexbench-fuzz-").tempdir_in(memory);
    folder.or_else(|_| tempfile::tempdir()).expect("a folder for files of this test")
}

/// The folder of this thread, with these files in it.
pub(crate) fn folder<T>(files: &[(&str, &[u8])], read: impl FnOnce(&Path) -> T) -> T {
    FOLDER.with(|folder| {
        for (name, bytes) in files {
            let path = folder.path().join(name);
            path.parent().map(std::fs::create_dir_all).transpose().expect("a folder that can be written");
            std::fs::write(path, bytes).expect("a folder that can be written");
        }
        read(folder.path())
    })
}

/// One file in it.
pub(crate) fn file<T>(name: &str, bytes: &[u8], read: impl FnOnce(&Path) -> T) -> T {
    folder(&[(name, bytes)], |folder| read(&folder.join(name)))
}
