//! `hexbench completions SHELL`.

use clap::builder::PossibleValuesParser;
use clap::{Arg, Args, Command, CommandFactory};
use clap_complete::Shell;
use hexbench_model::terms::catalogue;

use crate::args::Cli;
use crate::failure::Failure;
use crate::output::Screen;

/// Print the completion script for a shell; it also completes names of effects
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench completions bash > ~/.local/share/bash-completion/completions/hexbench\n  \
    hexbench completions fish > ~/.config/fish/completions/hexbench.fish")]
pub(crate) struct Arguments {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Print the script.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let mut script = Vec::new();
    let ids: Vec<&'static str> = catalogue().iter().map(|term| term.info().id).collect();
    clap_complete::generate(arguments.shell, &mut with_terms(Cli::command(), &ids), "hexbench", &mut script);
    screen.write(&String::from_utf8_lossy(&script))
}

/// Says what may stand where a term is wanted. The command itself takes any word there, to say which is the nearest.
fn with_terms(command: Command, ids: &[&'static str]) -> Command {
    let named = |arg: Arg| {
        let is_term = arg.get_value_names().is_some_and(|names| names.iter().any(|name| *name == "TERM"));
        if is_term { arg.value_parser(PossibleValuesParser::new(ids.to_vec())) } else { arg }
    };
    command.mut_args(named).mut_subcommands(|sub| with_terms(sub, ids))
}
