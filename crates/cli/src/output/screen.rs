//! Standard output that survives a closed pipe, and files written whole.

use std::cell::RefCell;
use std::io::{self, Write};
use std::path::Path;

use hexbench_core::files::{Destination, atomic_write};
use hexbench_core::visible_lines;
use hexbench_report::Page;
use hexbench_report::render::{Terminal, TextStyle, terminal};

use super::quiet::is_quiet;
use super::{Colour, OutFile};
use crate::failure::Failure;

/// Standard output.
#[derive(Debug)]
pub(crate) struct Screen {
    sink: Sink,
    terminal: Terminal,
}

#[derive(Debug)]
enum Sink {
    Stdout(io::Stdout),
    Kept(RefCell<Vec<u8>>),
}

impl Screen {
    /// Standard output, colored when it is a terminal.
    pub(crate) fn stdout(colour: Colour, verbose: bool) -> Self {
        let stdout = io::stdout();
        let style = TextStyle::new(colour.on(&stdout));
        Self { sink: Sink::Stdout(stdout), terminal: Terminal { style, verbose } }
    }

    /// One that keeps what is written.
    pub(crate) fn kept(verbose: bool) -> Self {
        Self { sink: Sink::Kept(RefCell::default()), terminal: Terminal { verbose, ..Terminal::default() } }
    }

    /// What was kept; nothing of what went to standard output.
    pub(crate) fn into_text(self) -> String {
        match self.sink {
            Sink::Stdout(_) => String::new(),
            Sink::Kept(text) => String::from_utf8_lossy(&text.into_inner()).into_owned(),
        }
    }

    /// True when details are wanted.
    pub(crate) fn is_verbose(&self) -> bool {
        self.terminal.verbose
    }

    /// Show a page, unless everything is to be quiet.
    pub(crate) fn show(&self, page: &Page) -> Result<(), Failure> {
        if is_quiet() { Ok(()) } else { self.write(&terminal(page, self.terminal)) }
    }

    /// Show a page, unless one of these files is standard output and stands in its place.
    pub(crate) fn show_unless<'a>(
        &self,
        files: impl IntoIterator<Item = &'a Option<OutFile>>,
        page: impl FnOnce() -> Page,
    ) -> Result<(), Failure> {
        if OutFile::any_is_stdout(files) { Ok(()) } else { self.show(&page()) }
    }

    /// Write text. A reader that has gone away, as in `hexbench ... | head`, is no failure.
    pub(crate) fn write(&self, text: &str) -> Result<(), Failure> {
        let written = match &self.sink {
            Sink::Stdout(stdout) => {
                let mut out = stdout.lock();
                out.write_all(text.as_bytes()).and_then(|()| out.flush())
            }
            Sink::Kept(kept) => kept.borrow_mut().write_all(text.as_bytes()),
        };
        match written {
            Err(cause) if cause.kind() != io::ErrorKind::BrokenPipe => {
                Err(Failure::Output { path: "standard output".into(), cause })
            }
            _ => Ok(()),
        }
    }

    /// Tell a few lines, unless everything is to be quiet; names in them act on no terminal.
    pub(crate) fn tell(&self, text: &str) -> Result<(), Failure> {
        if is_quiet() { Ok(()) } else { self.write(&visible_lines(text)) }
    }

    /// Refuse a file that exists, with what to do instead; standard output and devices are none.
    pub(crate) fn refuse_existing(path: &Path, next: &str) -> Result<(), Failure> {
        if matches!(Destination::of(path), Ok(Destination::File(place)) if place.exists()) {
            return Err(Failure::usage(format!("{} exists already", path.display()), next));
        }
        Ok(())
    }

    /// Make the folder of a file to be written.
    pub(crate) fn make_folder_of(path: &Path) -> Result<(), Failure> {
        let Some(folder) = path.parent().filter(|f| !f.as_os_str().is_empty()) else { return Ok(()) };
        std::fs::create_dir_all(folder).map_err(Failure::unwritable(folder))
    }

    /// Write text to a file of a folder, which is made.
    pub(crate) fn write_into(&self, folder: &Path, name: &str, text: &str) -> Result<(), Failure> {
        self.write_with_folder(&folder.join(name), text)
    }

    /// Write text to a file whose folder is made.
    pub(crate) fn write_with_folder(&self, path: &Path, text: &str) -> Result<(), Failure> {
        Self::make_folder_of(path)?;
        self.write_to(path, text)
    }

    /// Write text to a file, or to standard output when the path is `-`.
    pub(crate) fn write_to(&self, path: &Path, text: &str) -> Result<(), Failure> {
        if path.as_os_str() == "-" {
            return self.write(text);
        }
        atomic_write(path, |out| out.write_all(text.as_bytes())).map_err(Failure::unwritable(path))
    }
}
