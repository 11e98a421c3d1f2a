//! The catalogue as programs receive it: `terms/1`.

use std::sync::Arc;

use serde::Serialize;

use crate::effects::term::{Need, Term, TermInfo};

/// All terms.
#[derive(Debug, Clone, Serialize)]
pub struct TermList<'a> {
    /// `terms/1`.
    pub format: &'static str,
    /// In the order of the catalogue.
    pub terms: Vec<TermEntry<'a>>,
}

/// One term.
#[derive(Debug, Clone, Serialize)]
pub struct TermEntry<'a> {
    /// Kebab-case id.
    pub id: &'a str,
    /// A few words.
    pub title: &'a str,
    /// Part of the machine or of the measurement it belongs to.
    pub chapter: &'a str,
    /// What happens physically.
    pub physics: &'a str,
    /// First-order equation.
    pub equation: &'a str,
    /// Where the physics is described.
    pub source: &'a str,
    /// What the data must contain for it to show.
    pub shows: &'a str,
    /// What to vary to see it alone.
    pub breaker: &'a str,
    /// Parameters of the ideal form.
    pub parameters: Vec<TermNumber<'a>>,
    /// Shape parameter, where there is one.
    pub shape: Option<TermNumber<'a>>,
    /// What it cannot do without: `absolute`, `approach`, `delta-T`, `elapsed`, `brackets`, `loads`.
    pub needs: Vec<&'static str>,
}

/// A number of a term.
#[derive(Debug, Clone, Serialize)]
pub struct TermNumber<'a> {
    /// Name below the id of the term.
    pub name: &'a str,
    /// Unit.
    pub unit: &'a str,
}

impl<'a> TermList<'a> {
    /// Of these terms.
    pub fn of(terms: &'a [Arc<dyn Term>]) -> Self {
        Self { format: "terms/1", terms: terms.iter().map(|term| TermEntry::of(term.info())).collect() }
    }
}

impl<'a> TermEntry<'a> {
    /// Of a term.
    pub fn of(info: &'a TermInfo) -> Self {
        Self {
            id: info.id,
            title: info.title,
            chapter: info.chapter.title(),
            physics: info.physics,
            equation: info.equation,
            source: info.source,
            shows: info.shows,
            breaker: info.how_to_isolate,
            parameters: info.parameters.iter().map(|p| TermNumber { name: p.name, unit: p.unit }).collect(),
            shape: info.shape.map(|shape| TermNumber { name: shape.name, unit: shape.unit }),
            needs: info.needs.iter().map(|need| word(*need)).collect(),
        }
    }
}

fn word(need: Need) -> &'static str {
    match need {
        Need::Absolute => "absolute",
        Need::Approach => "approach",
        Need::DeltaT => "delta-T",
        Need::Elapsed => "elapsed",
        Need::Brackets => "brackets",
        Need::Loads => "loads",
    }
}
