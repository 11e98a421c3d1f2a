//! The whole catalogue: a list for the terminal, a Markdown page for the documentation.

use std::sync::Arc;

use hexbench_model::effects::term::Term;

use super::effect::{needs, rich};
use super::written_by;
use crate::page::{Block, Definition, Page, Section, Table};

/// One effect per line.
pub fn list(terms: &[Arc<dyn Term>]) -> Page {
    let entries = terms.iter().map(|t| Definition::new(t.info().id, t.info().title));
    let section =
        Section::new(format!("{} effects", terms.len())).remark("`hexbench terms TERM` explains one");
    Page::default().with(section.with(Block::entries(entries)))
}

/// The page `docs/reference/effects.md`.
pub fn catalogue(terms: &[Arc<dyn Term>]) -> Page {
    let page = Page::new(format!("The {} effects of the catalogue", terms.len())).with(introduction());
    terms.iter().fold(page, |page, term| page.with(section(term.as_ref())))
}

fn introduction() -> Section {
    Section::lead()
        .paragraph(written_by("hexbench terms --markdown"))
        .paragraph(
            "Every effect is a *term* of the model: an extra elongation `e_i` of leg `i`, an extra leg force or a rigid \
             motion, between the reference state and the loaded state. `f` and `f0` are the leg forces in the two states \
             (N, tension positive), `q` the leg length, `n` its direction, `c = 1/k` the compliance of its spring. The \
             fixed frame and the mobile frame coincide at the zero pose; a prime marks mobile axes.",
        )
}

/// The other versions of a term: word, equation, numbers.
fn versions(term: &dyn Term) -> Vec<String> {
    let line = |version: &dyn Term| {
        let info = version.info();
        let names = info.parameters.iter().map(|p| p.name).chain(info.shape.map(|s| s.name));
        let names: Vec<&str> = names.collect();
        let word = version.version().unwrap_or_default();
        format!("As `{}:{word}`: {}. `{}`; {}.", info.id, info.title, info.equation, names.join(", "))
    };
    let others = term.versions();
    let usual = || {
        format!("As `{}:ideal`: the law above, even where the readings suggest another one.", term.info().id)
    };
    let first = (!others.is_empty()).then(usual);
    first.into_iter().chain(others.iter().map(|(_, version)| line(version.as_ref()))).collect()
}

fn section(term: &dyn Term) -> Section {
    let info = term.info();
    let sign = |positive: bool| if positive { "positive" } else { "any sign" };
    let parameters = info.parameters.iter().map(|p| [p.name, p.unit, sign(p.positive)]);
    let shape = info.shape.iter().map(|s| [s.name, s.unit, "shape, profiled"]);
    let table = Table::named(["parameter", "unit", "values"]).words_in(1).words_in(2);
    Section::new(info.id)
        .paragraph(format!("{}. {}", info.title, info.physics))
        .with(Block::code(info.equation))
        .table(table.rows(parameters.chain(shape)))
        .list(versions(term).into_iter().chain([
            format!("Visible when {}.", info.shows),
            format!("To isolate it: {}.", info.how_to_isolate),
            format!("The file needs: {}.", needs(info)),
            format!("Richer form: {}.", rich(info.rich)),
            format!("Source: {}.", info.source),
        ]))
}
