//! The `hexbench` command.
//!
//! Data go to standard output, progress and messages to standard error. Exit codes are those of [`failure::Exit`].

mod args;
mod commands;
mod csv;
mod input;
mod output;
mod page;
mod question;
mod read_as;
mod states;

use std::process::ExitCode;

use clap::Parser;
use hexbench_app::failure;

fn main() -> ExitCode {
    let cli = args::Cli::parse();
    match commands::run(&cli) {
        Ok(()) => failure::Exit::Done.into(),
        Err(failure) => {
            output::report::print(&failure, cli.colour);
            failure.exit().into()
        }
    }
}
