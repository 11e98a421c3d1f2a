//! `hexbench terms [TERM]`: the catalogue, from the code.

use std::sync::Arc;

use clap::Args;
use hexbench_core::files::nearest;
use hexbench_experiments::sized::usual_size;
use hexbench_model::effects::term::{Term, TermInfo};
use hexbench_model::error::ModelError;
use hexbench_model::results::terms::TermList;
use hexbench_model::terms::catalogue;
use hexbench_report::number::significant;
use hexbench_report::render::markdown;
use hexbench_report::words::{effect, effects};

use crate::failure::Failure;
use crate::output::{OutFile, Screen, write_json};

/// List the effects of the catalogue, or explain one
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench terms\n  \
    hexbench terms base-compliance\n  \
    hexbench terms --json terms.json")]
pub(crate) struct Arguments {
    /// Explain this effect: physics, equation, parameters, required columns, source
    term: Option<String>,
    /// Print the whole catalogue as Markdown
    #[arg(long, conflicts_with = "term")]
    markdown: bool,
    /// Write the whole catalogue as terms.json to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE", conflicts_with_all = ["term", "markdown"])]
    json: Option<OutFile>,
}

/// Print the list, one effect, or the Markdown page.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let terms = catalogue();
    if let Some(path) = &arguments.json {
        return write_json(screen, Some(path), &TermList::of(&terms));
    }
    match &arguments.term {
        Some(id) => screen.show(&effect::page(find(&terms, id)?, usual(id))),
        None if arguments.markdown => screen.write(&markdown(&effects::catalogue(&terms))),
        None => screen.show(&effects::list(&terms)),
    }
}

/// How large the effect usually is in simulations, and how a study states its size.
fn usual(id: &str) -> Option<String> {
    let (size, unit) = usual_size(id)?;
    let size = significant(size, 2);
    Some(format!(
        "usually {size} {} in simulations of the machine ring_a; in a study: {} = [{size}]",
        unit.unit, unit.key
    ))
}

fn find<'a>(terms: &'a [Arc<dyn Term>], id: &str) -> Result<&'a TermInfo, Failure> {
    let known = || terms.iter().map(|t| t.info());
    known().find(|info| info.id == id).ok_or_else(|| {
        let nearest = nearest(id, known().map(|info| info.id)).map(str::to_owned);
        let cause = ModelError::UnknownTerm { id: id.to_owned(), nearest };
        Failure::of_name(cause)
    })
}
