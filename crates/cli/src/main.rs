//! The `hexbench` command.
//!
//! Data go to standard output, progress and messages to standard error. Exit codes are those of [`failure::Exit`].

mod args;
mod commands;
mod coverage;
mod csv;
mod first_plan;
mod input;
mod numbers;
mod output;
mod page;
mod question;
mod read_as;
mod states;

use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches};
use hexbench_app::failure;

fn main() -> ExitCode {
    outlive_file_size_limit();
    let matches = args::Cli::command().get_matches();
    let cli = args::Cli::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
    match output::refuse_overlaps(&matches).and_then(|()| commands::run(&cli)) {
        Ok(()) => failure::Exit::Done.into(),
        Err(failure) => {
            output::report::print(&failure, cli.colour);
            failure.exit().into()
        }
    }
}

/// A file that grows beyond the limit of the shell (`ulimit -f`) then fails to be written, as on a full disk, and is cleared away.
fn outlive_file_size_limit() {
    #[cfg(unix)]
    {
        let noticed = std::sync::Arc::default();
        // Where the signal cannot be caught it ends the program, as without this line.
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, noticed);
    }
}
