//! The whole catalogue: a list for the terminal, a Markdown page for the documentation.

use std::fmt::Write;
use std::sync::Arc;

use hexbench_model::term::{Term, TermInfo};

use super::effect::{needs, rich};
use crate::text::{Ink, Paper};

const LABEL: usize = 28;

/// One effect per line.
pub fn list(terms: &[Arc<dyn Term>], ink: Ink) -> String {
    let mut paper = Paper::new(ink);
    paper.heading(&format!("{} effects", terms.len()), "`hexbench terms TERM` explains one");
    for info in terms.iter().map(|t| t.info()) {
        paper.hanging(&format!("  {}", info.id), LABEL, info.title);
    }
    paper.into_text()
}

/// The page `docs/effects.md`.
pub fn markdown(terms: &[Arc<dyn Term>]) -> String {
    let mut page = introduction(terms.len());
    for info in terms.iter().map(|t| t.info()) {
        // Writing into a String cannot fail.
        let _ = section(&mut page, info);
    }
    page
}

fn introduction(count: usize) -> String {
    format!(
        "# The {count} effects of the catalogue\n\n\
         Generated from the code by `hexbench terms --markdown`; a test fails when this page is stale.\n\n\
         Every effect is a *term* of the model: an extra elongation `e_i` of leg `i`, an extra leg force or a rigid \
         motion, between the reference state and the loaded state. `f` and `f0` are the leg forces in the two states \
         (N, tension positive), `q` the leg length, `n` its direction, `c = 1/k` the compliance of its spring. The \
         fixed frame and the mobile frame coincide at the zero pose; a dash marks mobile axes.\n"
    )
}

fn section(page: &mut String, info: &TermInfo) -> std::fmt::Result {
    writeln!(page, "\n## {}\n", info.id)?;
    writeln!(page, "{}. {}\n", info.title, info.physics)?;
    writeln!(page, "```text\n{}\n```\n", info.equation)?;
    writeln!(page, "| parameter | unit | values |\n|---|---|---|")?;
    for p in info.parameters {
        writeln!(page, "| {} | {} | {} |", p.name, p.unit, if p.positive { "positive" } else { "any sign" })?;
    }
    if let Some(s) = info.shape {
        writeln!(page, "| {} | {} | shape, profiled |", s.name, s.unit)?;
    }
    writeln!(page, "\n- Visible when {}.", info.shows)?;
    writeln!(page, "- To see it alone: {}.", info.breaker)?;
    writeln!(page, "- The file must have: {}.", needs(info))?;
    writeln!(page, "- Richer form: {}.", rich(info.rich))?;
    writeln!(page, "- Source: {}.", info.source)
}
