//! Cases, machines, plans, effects and terms to choose from.

use std::collections::BTreeSet;

use hexbench_model::effects::term::{Chapter, Rich, TermInfo};
use hexbench_model::effects::user_term::{self, FormulaVariable};
use hexbench_model::terms;

use super::{Given, cases, simulate};
use crate::wire::{Catalogue, Choice, FormulaHelp, NamedUnit, ServerLimits, TermCard};

/// Terms, cases, machines, plans, effects, the language of formulas.
pub fn catalogue(limits: ServerLimits, given: Option<&Given>) -> Catalogue {
    let terms = terms::catalogue();
    let chapters: BTreeSet<Chapter> = terms.iter().map(|t| t.info().chapter).collect();
    Catalogue {
        version: env!("CARGO_PKG_VERSION"),
        terms: terms.iter().map(|t| card(t.info())).collect(),
        chapters: chapters.into_iter().map(Chapter::title).collect(),
        cases: cases::choices(),
        machines: simulate::machines(),
        plans: simulate::plans(),
        effects: simulate::effects(),
        given: given.map(choice_of),
        formula: formula(),
        limits,
    }
}

fn choice_of(given: &Given) -> Choice {
    let held = given.holdout.iter().map(|t| t.name.as_str());
    let names: Vec<&str> = [given.hexapod.name.as_str(), &given.data.name].into_iter().chain(held).collect();
    Choice { id: "given".to_owned(), title: given.data.name.clone(), text: names.join(", ") }
}

fn card(info: &TermInfo) -> TermCard {
    let shape = info.shape.map(|s| named(s.name, s.unit));
    TermCard {
        id: info.id.to_owned(),
        title: info.title.to_owned(),
        chapter: info.chapter.title(),
        physics: info.physics.to_owned(),
        equation: info.equation.to_owned(),
        shows: info.shows.to_owned(),
        richer: info.rich != Rich::None,
        parameters: info.parameters.iter().map(|p| named(p.name, p.unit)).chain(shape).collect(),
    }
}

fn named(name: &str, unit: &str) -> NamedUnit {
    NamedUnit { name: name.to_owned(), unit: unit.to_owned() }
}

fn formula() -> FormulaHelp {
    let choice = |v: FormulaVariable| Choice {
        id: v.name.to_owned(),
        title: v.meaning.to_owned(),
        text: v.unit.to_owned(),
    };
    FormulaHelp {
        variables: user_term::variables().into_iter().map(choice).collect(),
        functions: user_term::functions().into_iter().map(str::to_owned).collect(),
        units: user_term::units().into_iter().map(str::to_owned).collect(),
        example: user_term::EXAMPLE.to_owned(),
    }
}
