//! Arguments common to all subcommands, and the list of subcommands.

use clap::Parser;

use crate::commands::Command;
use crate::output::Colour;

/// Compare a hexapod's stiffness model with measurements, name the physical effect it lacks, add it, and watch the
/// error on held-out poses fall to the noise.
#[derive(Debug, Parser)]
#[command(name = "hexbench", version, max_term_width = 80, arg_required_else_help = true)]
#[command(after_help = "Examples:\n  \
                        hexbench demo\n  \
                        hexbench init --base-radius 160 --base-gap 20 --platform-radius 120 --platform-gap 20 --height 165\n  \
                        hexbench diagnose hexapod.toml measurements.csv --holdout holdout.csv\n\n\
                        Exit codes: 0 done, 1 a requested check failed, 2 usage, 3 bad input, \
                        4 not determined by the data, 5 input or output")]
pub(crate) struct Cli {
    /// When to use color; `NO_COLOR` is respected by `auto`
    #[arg(
        long = "color",
        alias = "colour",
        value_name = "WHEN",
        default_value = "auto",
        global = true,
        display_order = 100
    )]
    pub(crate) colour: Colour,
    /// Show every row, column and section of a page, including details
    #[arg(long, short, global = true, display_order = 101)]
    pub(crate) verbose: bool,
    /// Print only warnings and errors: no page on the terminal, no notes, no progress
    #[arg(long, short, global = true, display_order = 102, conflicts_with = "verbose")]
    pub(crate) quiet: bool,
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    /// Lines of the help that are commands, of every command that does something itself.
    fn examples(command: &clap::Command, path: &str, all: &mut Vec<(String, Vec<String>)>) {
        let name = format!("{path} {}", command.get_name());
        let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
        let lines = help.lines().map(str::trim).filter(|line| line.starts_with("hexbench "));
        all.push((name.clone(), lines.map(str::to_owned).collect()));
        command.get_subcommands().for_each(|sub| examples(sub, &name, all));
    }

    #[test]
    fn every_command_shows_examples_that_it_takes() {
        let mut all = Vec::new();
        examples(&Cli::command(), "", &mut all);
        for (name, examples) in all {
            assert!(!examples.is_empty(), "{name} shows no example");
            for example in &examples {
                assert_taken(&name, example);
            }
        }
    }

    fn assert_taken(place: &str, command: &str) {
        let words = command.split(['<', '>', '&', '#', '|']).next().unwrap_or_default().split_whitespace();
        // A variable that stands alone counts something in a loop of the shell.
        let words = words.map(|word| if word.starts_with('$') { "1" } else { word });
        if let Err(wrong) = Cli::try_parse_from(words) {
            panic!("{place}: {command}\n{wrong}");
        }
    }

    #[test]
    fn every_command_in_a_block_of_the_guide_is_taken() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let read = |path: std::path::PathBuf| {
            (path.display().to_string(), std::fs::read_to_string(path).unwrap_or_default())
        };
        let guide = std::fs::read_dir(root.join("docs/guide"))
            .expect("the guide")
            .flatten()
            .map(|entry| entry.path());
        let pages = guide.filter(|path| path.extension().is_some_and(|ending| ending == "md"));
        let mut taken = 0;
        for (page, text) in std::iter::once(root.join("README.md")).chain(pages).map(read) {
            // Every second piece is a block; a line that goes on in the next is one command.
            for block in text.split("```").skip(1).step_by(2) {
                for line in block
                    .replace("\\\n", " ")
                    .lines()
                    .map(str::trim)
                    .filter(|line| line.starts_with("hexbench "))
                {
                    assert_taken(&page, line);
                    taken += 1;
                }
            }
        }
        assert!(taken > 20, "{taken}");
    }
}
