//! The `hexbench` command: as the program, and as a function for Python.
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
mod shared;
mod states;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, FromArgMatches};
pub use commands::gate::GateFunction;
use hexbench_app::failure::{self, Failure};
pub use shared::{NamedWork, SharedExperiment};

/// The program: arguments of the process, standard output, exit code.
pub fn main() -> ExitCode {
    outlive_file_size_limit();
    let matches = args::Cli::command().try_get_matches().unwrap_or_else(|wrong| without_alias(wrong).exit());
    let mut cli = args::Cli::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
    let screen = output::Screen::stdout(cli.colour, cli.verbose);
    match refuse_outputs(&matches).and_then(|()| commands::run(&mut cli, &screen)) {
        Ok(()) => failure::Exit::Done.into(),
        Err(failure) => {
            output::report::print(&failure, cli.colour);
            failure.exit().into()
        }
    }
}

/// The command with these words, the name of the program not among them: what it wrote to standard output, and whether the check it made
/// passed.
///
/// # Errors
/// [`Failure`] when it failed otherwise.
pub fn output_of(words: impl IntoIterator<Item = OsString>) -> Result<(String, bool), Failure> {
    kept(words, commands::run)
}

/// `gate record` or `gate check` by a function in place of a program; the name of the function stands in the words where that of a program
/// would.
///
/// # Errors
/// As [`output_of`].
pub fn gate_of(
    words: impl IntoIterator<Item = OsString>,
    function: &GateFunction<'_>,
) -> Result<(String, bool), Failure> {
    kept(words, |cli, screen| match &cli.command {
        commands::Command::Gate(arguments) => commands::gate::run_by(arguments, screen, Some(function)),
        _ => commands::run(cli, screen),
    })
}

fn kept(
    words: impl IntoIterator<Item = OsString>,
    run: impl FnOnce(&mut args::Cli, &output::Screen) -> Result<(), Failure>,
) -> Result<(String, bool), Failure> {
    let (matches, mut cli) = understood(words)?;
    let screen = output::Screen::kept(cli.verbose);
    let end = refuse_outputs(&matches).and_then(|()| run(&mut cli, &screen));
    match end {
        Ok(()) => Ok((screen.into_text(), true)),
        Err(failure) if matches!(failure.exit(), failure::Exit::CheckFailed) => {
            Ok((screen.into_text(), false))
        }
        Err(failure) => Err(failure),
    }
}

/// Refuse outputs that would destroy something or cannot be written, before any work.
fn refuse_outputs(matches: &clap::ArgMatches) -> Result<(), Failure> {
    output::refuse_overlaps(matches)?;
    output::refuse_misplaced(&args::Cli::command(), matches)
}

/// Words as a command, the name of the program not among them.
fn understood(words: impl IntoIterator<Item = OsString>) -> Result<(clap::ArgMatches, args::Cli), Failure> {
    let words = std::iter::once("hexbench".into()).chain(words);
    let command = args::Cli::command().color(clap::ColorChoice::Never);
    let matches =
        command.try_get_matches_from(words).map_err(|wrong| not_understood(&without_alias(wrong)))?;
    let cli = args::Cli::from_arg_matches(&matches).map_err(|wrong| not_understood(&wrong))?;
    Ok((matches, cli))
}

/// Names of the commands, those below another behind its name.
pub fn names() -> Vec<String> {
    fn below(command: &clap::Command, path: &str) -> Vec<String> {
        let named = |sub: &clap::Command| {
            let path = format!("{path}{}", sub.get_name());
            if sub.has_subcommands() { below(sub, &format!("{path} ")) } else { vec![path] }
        };
        command.get_subcommands().flat_map(named).collect()
    }
    below(&args::Cli::command(), "")
}

/// The same without an alias as a suggestion: it is for those who spell so, and looks like options of other commands.
fn without_alias(mut wrong: clap::Error) -> clap::Error {
    let alias = ContextValue::String("--colour".to_owned());
    if wrong.get(ContextKind::SuggestedArg) == Some(&alias) {
        wrong.remove(ContextKind::SuggestedArg);
        // It is made of the suggestion.
        wrong.remove(ContextKind::Usage);
    }
    wrong
}

fn not_understood(wrong: &clap::Error) -> Failure {
    let text = wrong.to_string();
    let (message, next) = text.split_once("\n\n").unwrap_or((&text, ""));
    Failure::usage(message.trim_start_matches("error: ").to_owned(), next.trim())
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
