//! Standard output that survives a closed pipe, and files written whole.

use std::io::{self, Write};
use std::path::Path;

use hexbench_core::files::atomic_write;
use hexbench_pages::text::Ink;

use super::Colour;
use crate::failure::Failure;

/// Standard output.
#[derive(Debug)]
pub(crate) struct Screen {
    stdout: io::Stdout,
    ink: Ink,
}

impl Screen {
    /// Standard output, coloured when it is a terminal.
    pub(crate) fn stdout(colour: Colour) -> Self {
        let stdout = io::stdout();
        let ink = Ink::new(colour.on(&stdout));
        Self { stdout, ink }
    }

    /// How to paint words for it.
    pub(crate) fn ink(&self) -> Ink {
        self.ink
    }

    /// Write text. A reader that has gone away, as in `hexbench ... | head`, is no failure.
    pub(crate) fn write(&self, text: &str) -> Result<(), Failure> {
        let mut out = self.stdout.lock();
        match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
            Err(cause) if cause.kind() != io::ErrorKind::BrokenPipe => {
                Err(Failure::Output { path: "standard output".into(), cause })
            }
            _ => Ok(()),
        }
    }

    /// Make the folder of a file to be written.
    pub(crate) fn make_folder_of(path: &Path) -> Result<(), Failure> {
        let Some(folder) = path.parent().filter(|f| !f.as_os_str().is_empty()) else { return Ok(()) };
        std::fs::create_dir_all(folder).map_err(|cause| Failure::Output { path: folder.to_owned(), cause })
    }

    /// Write text to a file, or to standard output when the path is `-`.
    pub(crate) fn write_to(&self, path: &Path, text: &str) -> Result<(), Failure> {
        if path.as_os_str() == "-" {
            return self.write(text);
        }
        atomic_write(path, |out| out.write_all(text.as_bytes()))
            .map_err(|cause| Failure::Output { path: path.to_owned(), cause })
    }
}
