//! `hexbench workbench [HEXAPOD DATA]`.

use std::io;
use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_core::Hexapod;
use hexbench_core::files::{campaign_to_csv, read_text};
use hexbench_workbench::bench::Given;
use hexbench_workbench::server::{Server, ServerSettings};
use hexbench_workbench::wire::FileText;

use crate::failure::Failure;
use crate::input::{self, TableNames};
use crate::output::Screen;

/// Open an interactive page in your browser: compare, tick effects on and off, diagnose, simulate, guess what is hidden
///
/// The command serves the page to this computer only, at the printed address, which contains a secret token. It writes no
/// files, and forgets what was opened when it ends (Ctrl-C).
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench workbench\n  \
    hexbench workbench hexapod.toml measurements.csv --holdout holdout.csv")]
pub(crate) struct Arguments {
    /// The machine: hexapod.toml; the page can load other files too
    #[arg(requires = "data")]
    hexapod: Option<PathBuf>,
    /// Deflections or absolute poses: measurements.csv
    data: Option<PathBuf>,
    /// Held-out readings, which no fit uses
    #[arg(long, value_name = "FILE", requires = "data")]
    holdout: Option<PathBuf>,
    /// Port on 127.0.0.1 [default: the system chooses a free one]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    port: u16,
}

/// Serve until asked to stop.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let given = given(arguments)?;
    let port = arguments.port;
    let failed = |cause| Failure::Server { port, cause };
    let server =
        Server::bind(&ServerSettings { port, ..ServerSettings::default() }, given).map_err(failed)?;
    let stop = server.asked_to_stop().map_err(failed)?;
    screen.tell(&format!(
        "The workbench is open at\n\n  {}\n\nOpen this address in a browser on this machine. Ctrl-C ends it.\n",
        server.url()
    ))?;
    server.run_until(stop);
    Ok(())
}

/// The files, once it is clear that they can be used.
fn given(arguments: &Arguments) -> Result<Option<Given>, Failure> {
    let (Some(path), Some(data)) = (&arguments.hexapod, &arguments.data) else { return Ok(None) };
    let machine = input::hexapod(path)?;
    let data = readings(&machine, data)?;
    let holdout = arguments.holdout.as_deref().map(|path| readings(&machine, path)).transpose()?;
    let hexapod = FileText { name: path.display().to_string(), text: read_text(path)? };
    Ok(Some(Given { hexapod, data, holdout }))
}

/// A table as its page reads it: the text of the file, or the same readings as such a text where the file is another one: a workbook, a
/// table of a program, text in another encoding.
fn readings(machine: &Hexapod, path: &Path) -> Result<FileText, Failure> {
    let read = input::measurements(machine, path, &TableNames::default())?;
    let name = path.display().to_string();
    let written = || {
        let mut text = Vec::new();
        let written = campaign_to_csv(&mut text, machine, &read);
        written.and_then(|()| String::from_utf8(text).map_err(io::Error::other))
    };
    let as_it_is = std::fs::read_to_string(path).ok();
    let text = as_it_is.map_or_else(written, Ok);
    let text = text.map_err(Failure::unreadable(path))?;
    Ok(FileText { name, text })
}
