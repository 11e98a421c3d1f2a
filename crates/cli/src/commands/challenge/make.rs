//! `hexbench challenge make SUITE -o DIR`.

use std::path::PathBuf;

use clap::Args;
use hexbench_experiments::challenge::{ChallengeSuite, make};

use crate::failure::Failure;
use crate::output::{Progress, Screen};

/// Make the cases of a suite, with their truth in a sealed folder; the same suite and seed give the same
/// bytes
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench challenge make data/challenges/springs-and-effects.toml --out cases\n  \
    hexbench challenge make springs-and-effects --seed-file seed.txt --out hidden")]
pub(crate) struct Arguments {
    /// A bundled suite (springs-and-effects) or a suite file
    suite: String,
    /// Folder for the challenge; it must be empty or absent
    #[arg(short = 'o', long, value_name = "DIR")]
    out: PathBuf,
    /// A seed other than that of the suite, for cases that nobody has seen
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    /// A file with a secret seed of at least 32 random characters: neither the cases nor `challenge.toml` contain it
    #[arg(long, value_name = "FILE", conflicts_with = "seed")]
    seed_file: Option<PathBuf>,
}

/// Make the challenge and say what to hand out.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let suite = ChallengeSuite::named(&arguments.suite)?;
    let suite = match (arguments.seed, &arguments.seed_file) {
        (Some(seed), _) => suite.with_seed(seed),
        (None, Some(path)) => {
            let text = std::fs::read_to_string(path).map_err(Failure::unreadable(path))?;
            suite.with_hidden_seed(&text)?
        }
        (None, None) => suite,
    };
    let progress = Progress::of(0, "cases");
    let manifest = make(&suite, &arguments.out, &progress)?;
    progress.done();
    let out = arguments.out.display();
    let about = format!("{} cases of {} version {}", manifest.cases.len(), manifest.suite, manifest.version);
    screen.tell(&match manifest.seed {
        Some(seed) => format!(
            "{about}, seed {seed}.\n\
             To hand out: {out}/cases and {out}/README.md. Keep {out}/sealed and {out}/challenge.toml: with its seed anyone can\n\
             make the truth again.\n"
        ),
        None => format!(
            "{about}, a hidden seed.\n\
             To hand out: {out}/cases, {out}/README.md and {out}/challenge.toml, with which anyone can run a program. Keep\n\
             {out}/sealed and the file of the seed.\n"
        ),
    })
}
