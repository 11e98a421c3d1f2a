//! What is said instead of what is hidden.

use hexbench_report::{Section, Table};

use crate::sweep::columns::answers;
use crate::sweep::results::CellStatistics;
use crate::sweep::study::{SweepStudy, SweepTask};

/// Answers by hidden effect, over all other axes together, in percent of the trials with an answer.
pub(super) fn confusion(study: &SweepStudy, cells: &[CellStatistics]) -> Option<Section> {
    if study.task != SweepTask::Diagnose {
        return None;
    }
    let rows = rows(study, cells);
    let answers = answers(study);
    let occurs = |k: &usize| rows.iter().any(|(_, said)| said[*k] > 0);
    let columns: Vec<usize> = (0..answers.len()).filter(occurs).collect();
    let header = ["hidden", "trials"].into_iter().chain(columns.iter().map(|&k| answers[k].as_str()));
    let row = |(hidden, said): &(String, Vec<u64>)| {
        let of: u64 = said.iter().sum();
        let percent = |k: &usize| format!("{:.0}", 100.0 * said[*k] as f64 / of.max(1) as f64);
        [hidden.clone(), of.to_string()].into_iter().chain(columns.iter().map(percent)).collect::<Vec<_>>()
    };
    let section = Section::new("What is said of what is hidden")
        .remark("percent of the trials")
        .table(Table::named(header).rows(rows.iter().map(row)));
    Some(section)
}

/// Answers of every hidden effect, nothing among them, in the order of the cells.
fn rows(study: &SweepStudy, cells: &[CellStatistics]) -> Vec<(String, Vec<u64>)> {
    let mut rows: Vec<(String, Vec<u64>)> = Vec::new();
    let (answers, names) = (answers(study).len(), study.axes.effect_names());
    for cell in cells {
        let at = study.axes.cell(cell.cell);
        let hidden =
            if at.effects().is_empty() { "nothing".to_owned() } else { names[at.position[5]].clone() };
        let said: Vec<u64> = (0..answers).map(|answer| cell.answers.said(answer)).collect();
        match rows.iter_mut().find(|(known, _)| *known == hidden) {
            Some((_, all)) => all.iter_mut().zip(said).for_each(|(a, b)| *a += b),
            None => rows.push((hidden, said)),
        }
    }
    rows
}
