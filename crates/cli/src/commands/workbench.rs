//! `hexbench workbench [HEXAPOD DATA]`.

use std::path::{Path, PathBuf};

use clap::Args;
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
    let (Some(hexapod), Some(data)) = (&arguments.hexapod, &arguments.data) else { return Ok(None) };
    let machine = input::hexapod(hexapod)?;
    input::measurements(&machine, data, &TableNames::default())?;
    let holdout = arguments.holdout.as_deref();
    holdout.map(|path| input::measurements(&machine, path, &TableNames::default())).transpose()?;
    let holdout = holdout.map(text).transpose()?;
    Ok(Some(Given { hexapod: text(hexapod)?, data: text(data)?, holdout }))
}

fn text(path: &Path) -> Result<FileText, Failure> {
    let text = std::fs::read_to_string(path)
        .map_err(|cause| Failure::Unreadable { path: path.to_owned(), cause })?;
    Ok(FileText { name: path.display().to_string(), text })
}
