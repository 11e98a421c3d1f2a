//! What results follow when axes are ranges: rank correlations over all points.

use hexbench_report::{Block, Section, Table};

use super::answer::{rank_advantage, rank_correlation};
use super::charts::spoken;
use super::response::{Response, responses};
use crate::sweep::cells::AXES;
use crate::sweep::question::ERROR;
use crate::sweep::results::CellStatistics;
use crate::sweep::study::SweepStudy;

/// Rank correlation of every result with every ranged axis; none without ranges.
pub(super) fn follows(study: &SweepStudy, cells: &[CellStatistics]) -> Option<Section> {
    let (design, _) = study.axes.points.as_ref()?;
    let results = responses(study, cells);
    let row = |axis: usize| {
        let numbers =
            results.iter().map(|r| in_words(rank_correlation(&pairs(study, cells, axis, r), ERROR)));
        std::iter::once(name(study, axis)).chain(numbers).collect::<Vec<_>>()
    };
    let names = results.iter().map(|r| r.title.to_lowercase());
    let section = Section::new("What results follow")
        .with_all(results.first().and_then(|main| sentence(study, cells, main)).map(Block::paragraph))
        .paragraph(format!(
            "Rank correlation of each result with each range over all cells ({} points, {}): 1 where it always grows, -1 where it always \
             falls, about 0 where it follows something else. 95 % bounds by resampling the cells.",
            design.points,
            design.kind.name(),
        ))
        .table(Table::named(std::iter::once("axis".to_owned()).chain(names)).rows(ranged(study).map(row)));
    Some(section)
}

/// The axis that a result follows most, those that it follows as much, and the last; none without two of them.
fn sentence(study: &SweepStudy, cells: &[CellStatistics], result: &Response) -> Option<String> {
    let mut found: Vec<(usize, [f64; 3])> = ranged(study)
        .map(|axis| (axis, rank_correlation(&pairs(study, cells, axis, result), ERROR)))
        .filter(|(_, [rho, ..])| rho.is_finite())
        .collect();
    found.sort_by(|(_, a), (_, b)| b[0].abs().total_cmp(&a[0].abs()));
    let [first, others @ ..] = &found[..] else { return None };
    let last = others.last()?;
    // Which way a result follows an axis does not count.
    let turned = |&(axis, [rho, ..]): &(usize, [f64; 3])| -> Vec<[f64; 2]> {
        let of_axis = pairs(study, cells, axis, result);
        of_axis.into_iter().map(|[x, y]| [x * rho.signum(), y]).collect()
    };
    let is_as_strong =
        |other: &&(usize, [f64; 3])| rank_advantage(&turned(first), &turned(other), ERROR)[1] <= 0.0;
    let as_strong: Vec<String> =
        others.iter().filter(is_as_strong).map(|(axis, _)| name(study, *axis)).collect();
    let how = match as_strong.as_slice() {
        [] => "significantly".to_owned(),
        all => format!("not significantly more than {}", all.join(", ")),
    };
    Some(format!(
        "{} follows {} most ({how}): rank correlation {} over {} points; {} least, {}.",
        result.title,
        name(study, first.0),
        in_words(first.1),
        cells.len(),
        name(study, last.0),
        in_words(last.1),
    ))
}

fn ranged(study: &SweepStudy) -> impl Iterator<Item = usize> {
    (0..AXES).filter(|&axis| study.axes.is_ranged(axis))
}

fn name(study: &SweepStudy, axis: usize) -> String {
    spoken(study.axes.levels()[axis].name)
}

/// Value on an axis and result of every cell that has one.
fn pairs(study: &SweepStudy, cells: &[CellStatistics], axis: usize, result: &Response) -> Vec<[f64; 2]> {
    let numbers = study.axes.levels()[axis].numbers().unwrap_or_default();
    let pair = |cell: &CellStatistics| {
        let x = *numbers.get(study.axes.cell(cell.cell).position[axis])?;
        Some([x, (result.of)(cell)[0]]).filter(|pair| pair[1].is_finite())
    };
    cells.iter().filter_map(pair).collect()
}

fn in_words([rho, low, high]: [f64; 3]) -> String {
    if rho.is_finite() { format!("{rho:.2} ({low:.2} to {high:.2})") } else { "-".to_owned() }
}
