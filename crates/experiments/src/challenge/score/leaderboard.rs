//! The leaderboard: ranking, calibration, power, and all figures, as one page for a browser.

use hexbench_report::number::significant;
use hexbench_report::plot::PlotError;
use hexbench_report::{Block, Cell, Figure, Page, PageColumn, Section, Table};

use super::ChallengeScores;
use super::page::{figures, lead};
use super::pictures::{intervals, power, reliability};
use super::places::{MeanPlaces, places};
use crate::shares::or_dash;

const RANKING: &str = "In every case the programs take places, 1 for the best; equals share theirs, and who says nothing has the last place. Stiffness and \
predictions by their CRPS, in which too wide an uncertainty costs as too narrow a one does; diagnoses by right, honest, wrong; probabilities by their log \
score. Place: the mean over the cases and these disciplines. Behind: the mean difference to the best case by case, with its 95 % interval; an interval that holds 0 may \
be chance.";

/// The page, with charts.
///
/// # Errors
/// [`PlotError`].
pub fn leaderboard(scores: &ChallengeScores) -> Result<Page, PlotError> {
    let entrants = &scores.entrants;
    let chart = |title: &str, figure: Option<Figure>| {
        figure.map(|figure| Section::new(title).with(Block::Figure(figure)))
    };
    Ok(Page::new(format!("Leaderboard: {}, version {}", scores.suite, scores.version))
        .with(Section::lead().paragraph(lead(scores)))
        .with_all(ranking(scores))
        .with(chart("Do probabilities mean what they say?", reliability(entrants)?))
        .with(chart("Do intervals hold?", intervals(entrants)?))
        .with(chart("How large must an effect be?", power(entrants)?))
        .with_all(figures(scores)))
}

fn ranking(scores: &ChallengeScores) -> [Section; 2] {
    let (disciplines, ranked) = places(&scores.entrants);
    let last = scores.entrants.len().max(2) as f64;
    let columns = [
        PageColumn::number("rank"),
        PageColumn::words("program"),
        PageColumn::bars(),
        PageColumn::number("place"),
        PageColumn::number("behind the best"),
        PageColumn::number("answered"),
    ];
    let rows = ranked.iter().enumerate().map(|(k, places)| row(scores, k, places, last));
    let by_discipline = Table::named(std::iter::once("mean place in").chain(disciplines));
    let of_each = ranked.iter().map(|places| {
        let name = scores.entrants[places.entrant].name.clone();
        std::iter::once(name).chain(places.of.iter().map(|place| or_dash(*place, short)))
    });
    [
        Section::new("Ranking").table(Table::new(columns).rows(rows)).paragraph(RANKING),
        Section::new("Places by discipline").within().table(by_discipline.rows(of_each)),
    ]
}

fn short(place: f64) -> String {
    significant(place, 3)
}

fn row(scores: &ChallengeScores, k: usize, places: &MeanPlaces, last: f64) -> [Cell; 6] {
    let entrant = &scores.entrants[places.entrant];
    let behind = or_dash(places.behind, |(d, [low, high])| format!("{d:.2} ({low:.2} .. {high:.2})"));
    [
        Cell::from((k + 1).to_string()),
        Cell::from(entrant.name.as_str()),
        Cell::bar((last - places.all.mean) / (last - 1.0)),
        Cell::from(short(places.all.mean)),
        Cell::from(behind),
        Cell::from(format!("{} of {}", entrant.all.answered, entrant.all.cases)),
    ]
}
