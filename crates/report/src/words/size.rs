//! How large: parameters of the effects in their own units.

use std::collections::BTreeSet;

use hexbench_core::words::{joined, joined_with, lower_first};
use hexbench_model::effects::term::TermInfo;
use hexbench_model::estimation::estimate::Estimate;
use hexbench_model::estimation::fit_named::form_asked;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::Diagnosis;
use hexbench_model::terms::catalogue;

use super::plus_minus::Wide;
use super::subject::ReportSubject;
use crate::number::with_uncertainty;
use crate::page::{Block, PageColumn, Section, Table};

/// Most parameters of one effect where there is little room.
const BRIEF: usize = 8;
/// Most names listed one by one.
const MOST_NAMES: usize = 6;

/// Values of every effect in the fitted model.
pub(super) fn section(subject: &ReportSubject<'_>) -> Option<Section> {
    let (d, wide) = (&subject.study.diagnosis, &subject.wide());
    let belong = (!d.model.is_empty() && d.model != d.added).then(|| {
        let model = joined_with(&d.model, "+");
        Block::paragraph(format!("These numbers belong to the most probable model, springs + {model}."))
    });
    let section =
        Section::new("How large").id("effects").remark(format!("value {}", wide.remark())).with(belong);
    let section = d.model.iter().fold(section, |section, term| section.with_all(effect(d, term, wide)));
    section.with_all(saved(subject)).unless_empty()
}

/// How the model named is saved.
fn saved(subject: &ReportSubject<'_>) -> Vec<Block> {
    let is_named = subject.study.diagnosis.verdict == Verdict::Named;
    let said = |command: &String| {
        let text = "This command saves the model for predictions and corrected commands:";
        [Block::paragraph(text), Block::code(command)]
    };
    subject.saving.iter().filter(|_| is_named).flat_map(said).collect()
}

/// True for a term of the catalogue, in any of its forms.
pub(super) fn is_listed(name: &str) -> bool {
    catalogue().iter().any(|t| form_asked(name).0 == t.info().id)
}

fn effect(d: &Diagnosis, term: &str, wide: &Wide) -> impl Iterator<Item = Block> {
    let own: Vec<&Estimate> = d.parameters.iter().filter(|p| belongs(&p.name, term)).collect();
    let row = |p: &&Estimate| {
        let [value, std] = with_uncertainty(p.value, wide.factor * p.std);
        let unit = if p.unit == "1" { "" } else { &p.unit };
        [short(&p.name).to_owned(), value, format!("+- {std}"), unit.to_owned()]
    };
    let columns =
        [PageColumn::words(""), PageColumn::number(""), PageColumn::number(""), PageColumn::words("")];
    let table = Table::new(columns).titled(with_form(d, term)).rows(most_telling(&own).iter().map(row));
    [Some(Block::Table(table.brief(BRIEF))), not_determined(d, term)].into_iter().flatten()
}

/// An effect, and its form where that is not the usual one.
fn with_form(d: &Diagnosis, term: &str) -> String {
    if d.richer.iter().any(|r| r == term) {
        return format!("{term}, of a form richer than the ideal one");
    }
    version(d, term).map_or_else(|| term.to_owned(), |title| format!("{term}: {}", lower_first(title)))
}

/// Title of the version of a listed effect that has the numbers of the model, unless it is the usual one.
fn version(d: &Diagnosis, term: &str) -> Option<&'static str> {
    let numbers = d.parameters.iter().map(|p| &p.name).chain(&d.not_determined);
    let fitted: BTreeSet<&str> = numbers.filter(|name| belongs(name, term)).map(|name| short(name)).collect();
    let has = |info: &TermInfo| {
        let names = info.parameters.iter().map(|p| p.name).chain(info.shape.map(|s| s.name));
        names.collect::<BTreeSet<_>>() == fitted
    };
    let usual = catalogue().into_iter().find(|t| t.info().id == term)?;
    let others = usual.versions().into_iter().map(|(_, version)| *version.info());
    others.filter(|_| !has(usual.info())).find(has).map(|info| info.title)
}

/// In the given order when few, else the ones furthest from zero first.
fn most_telling<'a>(own: &[&'a Estimate]) -> Vec<&'a Estimate> {
    let mut all = own.to_vec();
    if all.len() > BRIEF {
        let z = |p: &Estimate| (p.value / p.std).abs();
        all.sort_by(|a, b| z(b).total_cmp(&z(a)));
    }
    all
}

fn not_determined(d: &Diagnosis, term: &str) -> Option<Block> {
    let names: Vec<&str> = d.not_determined.iter().filter(|n| belongs(n, term)).map(|n| short(n)).collect();
    let what = match names.len() {
        0 => return None,
        n if n <= MOST_NAMES => joined(&names),
        n => format!("{n} further parameters"),
    };
    Some(Block::paragraph(format!("Not determined by these data: {what}.")))
}

fn belongs(name: &str, term: &str) -> bool {
    name.strip_prefix(term).is_some_and(|rest| rest.starts_with('.'))
}

fn short(name: &str) -> &str {
    name.split_once('.').map_or(name, |(_, parameter)| parameter)
}
