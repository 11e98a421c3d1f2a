//! Campaigns of one machine over months.

use hexbench_core::words::joined;
use hexbench_model::estimation::parameters::leg_of_stiffness;
use hexbench_model::results::book::{CampaignBook, ChangeKind, ChartChange, ChartSubject, ControlChart};

use super::book_advice::advice;
use super::notes;
use crate::number::{chance, multiple, rounded, significant, with_uncertainty};
use crate::page::{Block, Mood, Page, PageColumn, Section, Table};

/// Changes that the answer names; the table has all.
const MOST_IN_WORDS: usize = 3;

/// The page.
pub fn book(book: &CampaignBook) -> Page {
    Page::new(format!("Campaign book: {}", book.machine))
        .about("campaigns", span(book))
        .with(notes::look_at(book.warnings.iter().cloned()))
        .with(verdict(book))
        .with(changes(book))
        .with(campaigns(book))
        .with(levels(book))
        .with(rule(book))
}

/// `12, from 2026-01-05 to 2026-12-01`.
fn span(book: &CampaignBook) -> String {
    let count = book.campaigns.len();
    let ends = [book.campaigns.first(), book.campaigns.last()].map(|c| c.and_then(|c| c.date));
    match ends {
        [Some(first), Some(last)] if book.is_dated() => format!("{count}, from {first} to {last}"),
        _ => format!("{count}, in the order given"),
    }
}

/// `campaign 7 (2026-05-04)`.
pub(super) fn campaign(book: &CampaignBook, number: usize) -> String {
    let date = book.campaigns.get(number - 1).and_then(|c| c.date);
    date.map_or_else(|| format!("campaign {number}"), |date| format!("campaign {number} ({date})"))
}

/// Every change with its chart, the most significant first.
pub(super) fn all_changes(book: &CampaignBook) -> Vec<(&ControlChart, &ChartChange)> {
    let mut all: Vec<_> = book.charts.iter().flat_map(|c| c.changes.iter().map(move |x| (c, x))).collect();
    all.sort_by(|a, b| b.1.sigmas.abs().total_cmp(&a.1.sigmas.abs()));
    all
}

/// Charts that scatter more than they state.
pub(super) fn scattered(book: &CampaignBook) -> impl Iterator<Item = (&ControlChart, f64)> {
    book.charts.iter().filter_map(|c| Some((c, c.scatter?)))
}

fn verdict(book: &CampaignBook) -> Section {
    let changes = all_changes(book);
    let (word, mood) = match (changes.is_empty(), book.is_alarmed()) {
        (false, _) => ("CHANGED", Mood::Bad),
        (true, true) => ("SCATTERED", Mood::Doubt),
        _ => ("STEADY", Mood::Good),
    };
    let changed = changes.iter().take(MOST_IN_WORDS).map(|(chart, change)| sentence(book, chart, change));
    let more = changes.len().saturating_sub(MOST_IN_WORDS);
    let more = (more > 0).then(|| format!("The table below lists {more} more changes."));
    let scatter = scattered(book).map(|(c, times)| scatter_sentence(c, times));
    let none = (!book.is_alarmed()).then(|| steady(book));
    let what: Vec<String> = changed.chain(more).chain(scatter.take(MOST_IN_WORDS)).chain(none).collect();
    let sure = changes.first().map(|(_, c)| sure(c));
    let sentences = [what.join(" ")].into_iter().chain(sure).chain([advice(book)]).collect();
    Section::new("What changed").id("verdict").with(Block::Verdict { word: word.to_owned(), mood, sentences })
}

fn steady(book: &CampaignBook) -> String {
    format!(
        "None of {} numbers changed significantly over {} campaigns.",
        book.charts.len(),
        book.campaigns.len()
    )
}

fn sure(change: &ChartChange) -> String {
    format!(
        "The largest is {} standard uncertainties (chance of one this large from noise anywhere in this book: {}).",
        significant(change.sigmas.abs(), 2),
        chance(change.chance)
    )
}

/// `Leg 3`, `base-compliance.rotation-x`, `The held-out error`.
pub(crate) fn name(chart: &ControlChart) -> String {
    match (chart.about, leg_of_stiffness(&chart.name)) {
        (_, Some(leg)) => format!("Leg {}", leg + 1),
        (ChartSubject::Error, _) if chart.name == "error" => "The held-out error".to_owned(),
        (ChartSubject::Error, _) => "The error on fitted readings".to_owned(),
        _ => chart.name.clone(),
    }
}

/// `softer`, `smaller`.
pub(super) fn direction(chart: &ControlChart, change: &ChartChange) -> &'static str {
    match (chart.about, change.size > 0.0) {
        (ChartSubject::Stiffness, true) => "stiffer",
        (ChartSubject::Stiffness, false) => "softer",
        (_, true) => "larger",
        (_, false) => "smaller",
    }
}

/// `0.21 +- 0.03 N/um (5.1 %)`.
fn size(chart: &ControlChart, change: &ChartChange) -> String {
    let [size, std] = with_uncertainty(change.size.abs(), change.std);
    let share = 1e2 * change.size.abs() / chart.base().abs();
    let share = if share.is_finite() { format!(" ({} %)", significant(share, 2)) } else { String::new() };
    format!("{size} +- {std} {}{share}", chart.unit)
}

/// What changed in a chart.
fn sentence(book: &CampaignBook, chart: &ControlChart, change: &ChartChange) -> String {
    let (name, direction, size) = (name(chart), direction(chart, change), size(chart, change));
    let at = campaign(book, change.campaign);
    match change.kind {
        ChangeKind::Step => format!("{name} is {direction} by {size} since {at}{}.", open(change)),
        ChangeKind::Alone => format!("{name} was {direction} by {size} in {at} only."),
        ChangeKind::Drift => {
            format!("{name} drifts: {direction} by {size} from the first campaign to the last.")
        }
    }
}

/// Where a step may have begun too.
fn open(change: &ChartChange) -> String {
    let [first, last] = change.between;
    if first == last {
        String::new()
    } else {
        format!(", or possibly since another of campaigns {first} to {last}")
    }
}

fn scatter_sentence(chart: &ControlChart, times: f64) -> String {
    format!("{} scatters {} times as much as its uncertainties indicate.", name(chart), significant(times, 2))
}

fn changes(book: &CampaignBook) -> Option<Section> {
    let number = PageColumn::number;
    let columns = [
        PageColumn::words("number"),
        PageColumn::words("what"),
        number("campaign"),
        number("change"),
        number("sigmas"),
        number("chance"),
    ];
    let row = |(chart, c): &(&ControlChart, &ChartChange)| {
        let [size, std] = with_uncertainty(c.size, c.std);
        [
            chart.name.clone(),
            c.kind.word().to_owned(),
            c.campaign.to_string(),
            format!("{size} +- {std} {}", chart.unit).trim_end().to_owned(),
            format!("{:+.1}", c.sigmas),
            chance(c.chance),
        ]
    };
    let all = all_changes(book);
    let table = Table::new(columns).rows(all.iter().map(row));
    let remark =
        "+- standard uncertainty (k = 1); chance: of a change this large from noise anywhere in the book";
    Section::new("Changes").id("changes").remark(remark).table(table).when(!all.is_empty())
}

fn campaigns(book: &CampaignBook) -> Section {
    let error = book.charts.iter().find(|c| c.about == ChartSubject::Error);
    let columns = [
        PageColumn::number(""),
        PageColumn::words("date"),
        PageColumn::words("answer"),
        PageColumn::number("x noise"),
        PageColumn::words("file"),
    ];
    let rows = book.campaigns.iter().enumerate().map(|(k, c)| {
        let answer = match c.verdict {
            Some(verdict) if c.added.is_empty() => verdict.word().to_owned(),
            Some(verdict) => format!("{}: {}", verdict.word(), joined(&c.added)),
            None if c.added.is_empty() => "springs alone".to_owned(),
            None => format!("springs + {}", joined(&c.added)),
        };
        let error = error.and_then(|e| e.points.get(k)).map_or("-".to_owned(), |p| multiple(p.value));
        let date = c.date.map_or("-".to_owned(), |d| d.to_string());
        [(k + 1).to_string(), date, answer, error, c.file.clone()]
    });
    Section::new("Campaigns")
        .id("campaigns")
        .remark("error of the final model in multiples of the noise")
        .table(Table::new(columns).rows(rows))
}

/// Where every number stands, and what would be seen.
fn levels(book: &CampaignBook) -> Section {
    let number = PageColumn::number;
    let columns = [
        PageColumn::words("number"),
        number("first"),
        number("now"),
        PageColumn::words("unit"),
        number("new"),
        number("lasting"),
    ];
    let row = |c: &ControlChart| {
        let std = c.points.iter().map(|p| p.std).fold(f64::INFINITY, f64::min);
        let now = c.points.last().map_or(c.base(), |p| p.level);
        [
            c.name.clone(),
            rounded(c.base(), std),
            rounded(now, std),
            c.unit.clone(),
            significant(c.visible.last, 2),
            significant(c.visible.lasting, 2),
        ]
    };
    Section::new("Levels, and detectable changes")
        .id("levels")
        .remark("new, lasting: the smallest change that is reported nine times out of ten")
        .table(Table::new(columns).rows(book.charts.iter().map(row)))
        .paragraph(
            "New: a change in the last campaign. Lasting: a change that began at the campaign for which it is \
             easiest to detect.",
        )
}

fn rule(book: &CampaignBook) -> Section {
    let r = &book.rule;
    let text = format!(
        "A chart raises an alarm if a step, a single campaign or a drift exceeds {} standard uncertainties, or \
         if the campaigns scatter more than their uncertainties allow. If nothing changes, at most {} % of such \
         books raise any alarm: {} tests in {} charts share this chance.",
        significant(r.sigmas, 3),
        significant(1e2 * r.false_alarm, 1),
        r.tests,
        book.charts.len()
    );
    Section::new("When a chart raises an alarm").id("rule").paragraph(text)
}
