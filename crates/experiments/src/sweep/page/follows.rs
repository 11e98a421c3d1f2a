//! What results follow when axes are ranges: rank correlations over all points.

use hexbench_report::{Section, Table};

use super::answer::rank_correlation;
use super::charts::spoken;
use super::response::{Response, responses};
use crate::sweep::cells::AXES;
use crate::sweep::question::ERROR;
use crate::sweep::results::CellStatistics;
use crate::sweep::study::SweepStudy;

/// Rank correlation of every result with every ranged axis; none without ranges.
pub(super) fn follows(study: &SweepStudy, cells: &[CellStatistics]) -> Option<Section> {
    let (design, _) = study.axes.points.as_ref()?;
    let levels = study.axes.levels();
    let ranged: Vec<usize> = (0..AXES).filter(|&axis| study.axes.is_ranged(axis)).collect();
    let told = |axis: usize, r: &Response| {
        let numbers = levels[axis].numbers().unwrap_or_default();
        let pair = |cell: &CellStatistics| {
            let x = *numbers.get(study.axes.cell(cell.cell).position[axis])?;
            Some([x, (r.of)(cell)[0]]).filter(|pair| pair[1].is_finite())
        };
        let [rho, low, high] = rank_correlation(&cells.iter().filter_map(pair).collect::<Vec<_>>(), ERROR);
        if rho.is_finite() { format!("{rho:.2} ({low:.2} to {high:.2})") } else { "-".to_owned() }
    };
    let results = responses(study, cells);
    let row = |&axis: &usize| {
        let numbers = results.iter().map(|r| told(axis, r));
        std::iter::once(spoken(levels[axis].name)).chain(numbers).collect::<Vec<_>>()
    };
    let names = results.iter().map(|r| r.title.to_lowercase());
    let section = Section::new("What results follow")
        .paragraph(format!(
            "Rank correlation of each result with each range over all cells ({} points, {}): 1 where it always grows, -1 where it always \
             falls, about 0 where it follows something else. 95 % bounds by resampling the cells.",
            design.points,
            design.kind.name(),
        ))
        .table(Table::named(std::iter::once("axis".to_owned()).chain(names)).rows(ranged.iter().map(row)));
    Some(section)
}
