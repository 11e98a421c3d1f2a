//! Two results beside each other.

use hexbench_core::words::joined;
use hexbench_model::results::runs::{Changed, ComparedRuns, ParameterChange, Run};

use crate::number::{chance, multiple, percent, significant, with_uncertainty};
use crate::page::{Block, Cell, Mood, Page, PageColumn, Section, Table};

use super::conclusion::in_words;
use super::notes;
use super::units::UnitsRead;

/// Least probability that gets a row.
const WORTH_A_ROW: f64 = 0.03;

/// The page.
pub fn runs(runs: &ComparedRuns) -> Page {
    let machine = runs.a.origin.as_ref().or(runs.b.origin.as_ref()).map_or("", |o| &o.machine);
    Page::new(format!("Two runs: {machine}"))
        .about("A", &runs.a.file)
        .about("B", &runs.b.file)
        .with(notes::look_at(runs.warnings.iter().cloned()))
        .with(verdict(runs))
        .with(confidence(runs))
        .with(errors(runs))
        .with(parameters(runs))
}

fn verdict(runs: &ComparedRuns) -> Section {
    let (word, mood) = match (runs.has_other_answer(), runs.has_changed()) {
        (true, _) => ("ANOTHER ANSWER", Mood::Bad),
        (_, true) => ("CHANGED", Mood::Doubt),
        _ => ("UNCHANGED", Mood::Good),
    };
    let row = |name: &str, run: &Run| {
        let from = run.origin.as_ref().map_or("unknown", |o| &o.program);
        [name.to_owned(), answer(run), from.to_owned()]
    };
    let table = Table::new(["", "answer", "program"].map(PageColumn::words));
    Section::new("What changed from A to B")
        .id("verdict")
        .with(Block::Verdict { word: word.to_owned(), mood, sentences: vec![error_sentence(runs)] })
        .table(table.rows([row("A", &runs.a), row("B", &runs.b)]))
}

fn confidence(runs: &ComparedRuns) -> Option<Section> {
    let columns = [
        PageColumn::words("effect"),
        PageColumn::number("A"),
        PageColumn::bars(),
        PageColumn::number("B"),
        PageColumn::bars(),
    ];
    let rows =
        runs.probabilities.iter().filter(|(_, [a, b])| a.max(*b) >= WORTH_A_ROW).map(|(id, [a, b])| {
            [in_words(id).into(), percent(*a).into(), Cell::bar(*a), percent(*b).into(), Cell::bar(*b)]
        });
    let table = Table::new(columns).rows(rows);
    let section = Section::new("How sure").id("confidence").remark("present, alone or with others");
    (!table.rows.is_empty()).then(|| section.table(table))
}

/// `named: base-compliance`.
fn answer(run: &Run) -> String {
    let added = joined(&run.added);
    match run.verdict {
        Some(verdict) if run.added.is_empty() => verdict.word().to_owned(),
        Some(verdict) => format!("{}: {added}", verdict.word()),
        None if run.added.is_empty() => "springs alone".to_owned(),
        None => format!("springs + {added}"),
    }
}

/// Name, errors of every step of both, A first: times the noise, um, urad.
fn rungs(runs: &ComparedRuns) -> Vec<(String, String, [Option<f64>; 2])> {
    let of = |name: &'static str, run: &Run| {
        let mut all = Vec::new();
        for step in &run.steps {
            let with = if step.terms.is_empty() {
                "springs alone".to_owned()
            } else {
                format!("+ {}", step.terms.join(" + "))
            };
            let e = step.error();
            all.push((format!("{name}  {with}"), multiple(e.times_noise()), e.rms.both()));
        }
        let noise = [run.noise_translation_um, run.noise_rotation_urad];
        all.push((format!("{name}  noise ({})", run.noise_source.word()), multiple(1.0), noise));
        all
    };
    of("A", &runs.a).into_iter().chain(of("B", &runs.b)).collect()
}

/// What became of the error, in a sentence.
fn error_sentence(runs: &ComparedRuns) -> String {
    let noise =
        if runs.noise_changed { " The noise differs: multiples of it are not comparable." } else { "" };
    let Some(e) = runs.error else {
        return format!(
            "Only one of the two has held-out readings, so their errors are not compared.{noise}"
        );
    };
    let times = significant(e.ratio.sqrt(), 3);
    let p = chance(e.p);
    match e.changed {
        Changed::Yes => {
            format!(
                "The error of B is {times} times that of A, a significant difference (chance {p}).{noise}"
            )
        }
        _ => format!(
            "The error of B is {times} times that of A, not a significant difference (chance {p}).{noise}"
        ),
    }
}

fn errors(runs: &ComparedRuns) -> Section {
    let rungs = rungs(runs);
    let units = UnitsRead::of(rungs.iter().map(|rung| rung.2));
    let columns = ["model", "x noise"].into_iter().chain(units.of_both(["um", "urad"]));
    let mut table = Table::named(columns);
    for (name, times, both) in rungs {
        table.row([name, times].into_iter().chain(units.values(both)));
    }
    Section::new("The error")
        .id("ladder")
        .remark("root mean square; on held-out readings if there are any")
        .table(table)
}

/// Value with its uncertainty, or a dash.
fn number(x: Option<[f64; 2]>) -> String {
    x.map_or("-".to_owned(), |[value, std]| with_uncertainty(value, std).join(" +- "))
}

/// Difference in combined uncertainties, starred when beyond chance.
fn difference(p: &ParameterChange) -> String {
    let star = if p.changed == Changed::Yes { " *" } else { "" };
    p.sigmas.map_or("-".to_owned(), |s| format!("{s:+.1}{star}"))
}

/// What the stars mean.
fn legend(runs: &ComparedRuns) -> String {
    let count = runs.parameters.iter().filter(|p| p.changed == Changed::Yes).count();
    let verb = if count == 1 { "differs" } else { "differ" };
    format!(
        "{count} of {} parameters {verb} significantly (*: more than {} combined standard uncertainties; noise alone exceeds this anywhere in \
         the list in one of a hundred comparisons).",
        runs.parameters.len(),
        significant(runs.sigmas_beyond_chance, 2)
    )
}

fn parameters(runs: &ComparedRuns) -> Option<Section> {
    let row = |p: &ParameterChange| [p.name.clone(), number(p.a), number(p.b), p.unit.clone(), difference(p)];
    let columns = [
        PageColumn::words("parameter"),
        PageColumn::number("A"),
        PageColumn::number("B"),
        PageColumn::words("unit"),
    ];
    let table = Table::new(columns.into_iter().chain([PageColumn::number("B - A")]));
    let section = Section::new("Parameters")
        .remark("+- standard uncertainty (k = 1); B - A in combined uncertainties")
        .table(table.rows(runs.parameters.iter().map(row)))
        .paragraph(legend(runs));
    (!runs.parameters.is_empty()).then_some(section)
}
