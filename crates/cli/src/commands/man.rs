//! `hexbench man DIR`.

use std::path::{Path, PathBuf};

use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;

use crate::args::Cli;
use crate::failure::Failure;
use crate::output::Screen;

/// Write a manual page for the command and for each of its subcommands
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench man ~/.local/share/man/man1 && man hexbench-diagnose")]
pub(crate) struct Arguments {
    /// Folder for hexbench.1, hexbench-check.1 and the others; existing pages are replaced
    folder: PathBuf,
}

/// Write the pages.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let mut command = Cli::command().disable_help_subcommand(true);
    command.build();
    pages(&command, &arguments.folder, screen)
}

fn pages(command: &Command, folder: &Path, screen: &Screen) -> Result<(), Failure> {
    let file = format!("{}.1", command.get_display_name().unwrap_or_else(|| command.get_name()));
    let mut page = Vec::new();
    Man::new(command.clone()).render(&mut page).map_err(Failure::unwritable(&folder.join(&file)))?;
    screen.write_into(folder, &file, &String::from_utf8_lossy(&page))?;
    command.get_subcommands().filter(|sub| !sub.is_hide_set()).try_for_each(|sub| pages(sub, folder, screen))
}
