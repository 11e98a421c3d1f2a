//! The ladder: error on held-out poses, step by step, beside the noise.

use hexbench_core::Measurand;
use hexbench_model::inference::selection::HeldOut;
use hexbench_model::results::diagnose::{Diagnosis, NestedReport, StepReport};

use crate::number::{multiple, significant};
use crate::page::{Block, Cell, Mood, PageColumn, Section, Table};

use super::conclusion::telling_law;
use super::units::UnitsRead;

/// One row per step of the model, one for the law where one was found, then the noise.
pub fn section(d: &Diagnosis, measurand: Measurand) -> Section {
    let with_law = telling_law(d).and_then(|law| law.held_out).map(|held| held.after);
    ladder(&d.steps, with_law, d, measurand)
        .with(d.nested.as_ref().map(|nested| Block::paragraph(chosen_anew(d, nested))))
}

/// The same for steps of another model of the readings of a diagnosis.
pub fn of_steps(steps: &[StepReport], d: &Diagnosis, measurand: Measurand) -> Section {
    ladder(steps, None, d, measurand)
}

/// `with_law`: the error that a law found leaves, over the noise.
fn ladder(steps: &[StepReport], with_law: Option<f64>, d: &Diagnosis, measurand: Measurand) -> Section {
    let title = if steps.len() > 1 || with_law.is_some() { "The error falls" } else { "The error" };
    let largest = steps.iter().map(|s| s.error().times_noise()).fold(1.0, f64::max);
    let read = UnitsRead::of([d.noise.both()]);
    let units = read.of_both(["um", "urad"]).map(PageColumn::number);
    let names = measurand.names().into_iter().enumerate();
    let numbers = names.map(|(k, name)| format!("{name} {}", if k < 3 { "um" } else { "urad" }));
    let coordinates = of_coordinates(d, numbers).map(|title| PageColumn::number(title).detail());
    let columns = std::iter::once(PageColumn::words("model"))
        .chain(units)
        .chain([PageColumn::number("x noise"), PageColumn::bars()])
        .chain(coordinates);
    let table = Table::new(columns)
        .rows(steps.iter().map(|step| row(d, step, largest, read)))
        .rows(with_law.map(|times| of_law(d, times, largest, read)))
        .rows([noise(d, largest, read)]);
    Section::new(title).id("ladder").remark(how_held_out(d)).table(table)
}

/// `With the terms chosen anew ...: 1.08 times the noise ...`
fn chosen_anew(d: &Diagnosis, nested: &NestedReport) -> String {
    let parts = nested.chosen.len();
    let same = match nested.agreeing(&d.model) {
        n if n == parts && d.model.is_empty() => "none is chosen".to_owned(),
        n if n == parts => "they are the same every time".to_owned(),
        n => format!("they are the same in {n} of {parts} cases"),
    };
    format!(
        "The terms of these steps were chosen with all poses. When the poses are split into {parts} parts and the terms are chosen \
         again without each part, among the best sets of the whole search, {same}; the error on the part left out is {} times the noise.",
        multiple(nested.error.times_noise())
    )
}

/// Where the held-out error comes from.
pub fn how_held_out(d: &Diagnosis) -> &'static str {
    match d.steps.first().and_then(|s| s.holdout) {
        None => "on the fitted readings: too few poses to hold any out",
        Some(_) if d.holdout == HeldOut::File => "on held-out poses (root mean square, holdout file)",
        Some(_) => "on held-out poses (root mean square, each left out in turn)",
    }
}

/// `springs alone`, then `+ term`.
pub fn name(step: &StepReport) -> String {
    step.terms.last().map_or_else(|| "springs alone".to_owned(), |term| format!("+ {term}"))
}

/// Six values, none where sensors read something else.
fn of_coordinates<T>(d: &Diagnosis, six: impl IntoIterator<Item = T>) -> impl Iterator<Item = T> {
    six.into_iter().filter(|_| d.sensors.is_empty())
}

fn row(d: &Diagnosis, step: &StepReport, largest: f64, read: UnitsRead) -> Vec<Cell> {
    let error = step.error();
    let times = error.times_noise();
    let mood = if step.is_at_the_noise() { Mood::Good } else { Mood::Bad };
    let bar = Cell::colored_bar(at_least_one(times / largest), mood);
    let six = of_coordinates(d, error.per_coordinate.map(Some));
    cells(name(step), read.values(error.rms.both()), [multiple(times).into(), bar], six)
}

fn of_law(d: &Diagnosis, times: f64, largest: f64, read: UnitsRead) -> Vec<Cell> {
    let bar = Cell::colored_bar(at_least_one(times / largest), Mood::Doubt);
    let six = of_coordinates(d, [None; 6]);
    cells("+ the law found".to_owned(), read.values([None; 2]), [multiple(times).into(), bar], six)
}

fn noise(d: &Diagnosis, largest: f64, read: UnitsRead) -> Vec<Cell> {
    let [t, r] = d.noise.both();
    let bar = Cell::bar(at_least_one(1.0 / largest));
    let six = of_coordinates(d, [t, t, t, r, r, r]);
    cells("noise of one reading".to_owned(), read.values([t, r]), ["1.00".into(), bar], six)
}

fn cells(
    name: String,
    both: impl Iterator<Item = String>,
    times: [Cell; 2],
    six: impl Iterator<Item = Option<f64>>,
) -> Vec<Cell> {
    let six = six.map(|x| x.map_or("-".to_owned(), |x| significant(x, 3))).map(Cell::from);
    std::iter::once(name.into()).chain(both.map(Cell::from)).chain(times).chain(six).collect()
}

/// However small an error, its bar is seen.
fn at_least_one(share: f64) -> f64 {
    const LEAST: f64 = 0.03;
    share.max(LEAST)
}
