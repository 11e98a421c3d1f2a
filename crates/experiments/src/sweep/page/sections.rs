//! The sections of the page.

use hexbench_report::Page;

use super::charts::{Picture, spoken};
use super::equal::{Equal, Matching, equals};
use super::laws::{Law, laws};
use super::marginal::{group_of, marginal, varying};
use super::response::{Response, responses};
use crate::sweep::cells::{AxisLevels, Level};
use crate::sweep::columns::Status;
use crate::sweep::results::CellStatistics;
use crate::sweep::study::{Study, Task};

/// Cells up to which all of them are listed.
const FEW_CELLS: usize = 60;

/// Title, what was run, how much of it has an answer.
pub(super) fn head(page: &mut Page, study: &Study, cells: &[CellStatistics]) {
    page.heading(1, study.title.clone());
    let what = match study.task {
        Task::Springs => "six stiffnesses are fitted and compared with the truth",
        Task::Diagnose => "the diagnosis is asked what is hidden",
    };
    page.paragraph(format!(
        "{} cells of {} trials, {} in all; in each {what}. Machine, random poses, surroundings and effect are drawn anew \
         every {} trials, noise in every trial. Seed {}, study {}.",
        cells.len(),
        study.trials,
        study.all_trials(),
        study.redraw,
        study.seed,
        &study.hash()[..12.min(study.hash().len())],
    ));
    let mut failed: Vec<String> = Vec::new();
    for (k, name) in Status::NAMES.iter().enumerate().skip(1) {
        let count: u64 = cells.iter().map(|c| c.by_status[k]).sum();
        if count > 0 {
            failed.push(format!("{name}: {count}"));
        }
    }
    if !failed.is_empty() {
        page.paragraph(format!("Trials without an answer: {}. They are left out below.", failed.join(", ")));
    }
}

/// The axes with their values.
pub(super) fn axes(page: &mut Page, study: &Study) {
    page.heading(2, "Axes");
    let values = |axis: &AxisLevels| axis.levels.iter().map(Level::text).collect::<Vec<_>>().join(", ");
    let rows = study
        .axes
        .levels()
        .into_iter()
        .filter(|axis| axis.given)
        .map(|axis| vec![axis.name.to_owned(), values(&axis)]);
    page.table(["axis", "values"], rows.collect::<Vec<_>>());
}

/// Laws of powers, and how many random poses designed ones are worth.
pub(super) fn conclusions(page: &mut Page, study: &Study, cells: &[CellStatistics]) {
    let (laws, equals) = (laws(study, cells), equals(study, cells));
    if !laws.is_empty() {
        page.heading(2, "How the stiffness error scales");
        page.paragraph(
            "Least squares on logarithms over all cells of a plan; an exponent of -0.5 is the root of the number, 1 is \
             proportional. What the law leaves over is given as a share of the error.",
        );
        law_table(page, &laws);
    }
    if !equals.is_empty() {
        page.heading(2, "Designed and random poses");
        page.paragraph(
            "Random poses with the same stiffness error as designed ones, all other axes together.",
        );
        equal_table(page, &equals);
    }
}

fn law_table(page: &mut Page, laws: &[Law]) {
    let axes = laws[0].exponents.iter().map(|(name, _)| (*name).to_owned());
    let header: Vec<String> =
        std::iter::once("plan".to_owned()).chain(axes).chain(["left over".to_owned()]).collect();
    let row = |law: &Law| {
        let exponents = law.exponents.iter().map(|(_, x)| format!("{x:.2}"));
        let left = format!("{:.1} %", 100.0 * law.misfit);
        std::iter::once(law.group.clone()).chain(exponents).chain([left]).collect()
    };
    page.table(header, laws.iter().map(row).collect::<Vec<_>>());
}

fn equal_table(page: &mut Page, equals: &[Equal]) {
    let row = |e: &Equal| {
        let matching = match e.random_poses {
            Matching::About(n) => format!("{n:.1}"),
            Matching::MoreThan(n) => format!("more than {n}"),
            Matching::FewerThan(n) => format!("fewer than {n}"),
        };
        let percent = |x: f64| number(x);
        vec![
            e.plan.clone(),
            e.poses.to_string(),
            percent(e.error_percent),
            percent(e.random_error_percent),
            format!("{:.2}", e.random_error_percent / e.error_percent),
            matching,
        ]
    };
    let header = ["plan", "poses", "error, %", "as many random, %", "ratio", "random poses as good"];
    page.table(header, equals.iter().map(row).collect::<Vec<_>>());
}

/// A table for each axis with more than one value: by a second axis with charts, else by itself.
pub(super) fn by_axis(
    page: &mut Page,
    study: &Study,
    cells: &[CellStatistics],
    charts: Option<&[(&Picture, String)]>,
) {
    let levels = study.axes.levels();
    for axis in varying(&levels) {
        let group = charts.and_then(|_| group_of(&levels, axis));
        page.heading(2, format!("Over {}", spoken(levels[axis].name)));
        let found = marginal(study, cells, axis, group);
        let mut header: Vec<String> = group.map(|g| levels[g].name.to_owned()).into_iter().collect();
        header.push(levels[axis].name.to_owned());
        header.extend(responses(study.task).iter().map(|r| r.short.to_owned()));
        let mut rows = Vec::new();
        for (g, line) in found.groups.iter().enumerate() {
            for (k, cell) in line.iter().enumerate() {
                let mut row: Vec<String> = group.map(|a| levels[a].levels[g].text()).into_iter().collect();
                row.push(levels[axis].levels[k].text());
                row.extend(results(study, cell));
                rows.push(row);
            }
        }
        page.table(header, rows);
        for (picture, file) in
            charts.unwrap_or_default().iter().filter(|(picture, _)| picture.axis == levels[axis].name)
        {
            page.figure(file.clone(), picture.caption.clone());
        }
    }
}

fn results(study: &Study, cell: &CellStatistics) -> Vec<String> {
    let told = |r: &Response| {
        let [value, low, high] = (r.of)(cell);
        // Coverage is close to 95 %: a digit more tells something.
        let places = usize::from(r.key == "coverage");
        match (value.is_nan(), low.is_nan()) {
            (true, _) => "-".to_owned(),
            (false, true) => number(value),
            (false, false) => format!("{value:.places$} ({low:.places$} to {high:.places$})"),
        }
    };
    responses(study.task).iter().map(told).collect()
}

/// Every cell, when there are few.
pub(super) fn all_cells(page: &mut Page, study: &Study, cells: &[CellStatistics]) {
    if cells.len() > FEW_CELLS {
        return;
    }
    let levels = study.axes.levels();
    let shown = varying(&levels);
    page.heading(2, "All cells");
    let axes = shown.iter().map(|&k| levels[k].name.to_owned());
    let header: Vec<String> = axes.chain(responses(study.task).iter().map(|r| r.short.to_owned())).collect();
    let row = |cell: &CellStatistics| {
        let position = study.axes.cell(cell.cell).position;
        let at = shown.iter().map(|&k| levels[k].levels[position[k]].text());
        at.chain(results(study, cell)).collect()
    };
    page.table(header, cells.iter().map(row).collect::<Vec<_>>());
}

/// What the numbers mean.
pub(super) fn reading(page: &mut Page, study: &Study) {
    page.heading(2, "How to read it");
    let together = "A table over one axis takes all trials with the same value together, whatever their values on the \
                    others: the factorial is full, so that values may be compared.";
    let own = match study.task {
        Task::Springs => [
            "Stiffness error: root mean square over the legs of estimated over true stiffness minus one.",
            "Held-out error over noise: root mean square error of predicted deflections at poses drawn from the same \
             space, without noise, over the standard deviation of one reading. Below 1 the model predicts better than a \
             reading would measure.",
            "Coverage: share of 95 % intervals that hold the true stiffness, with exact binomial bounds that count \
             each trial once.",
        ],
        Task::Diagnose => [
            "Right: exactly what is hidden is named; nothing when there is nothing; \"outside\" when the catalogue lacks it.",
            "Honest: the answer is ambiguous and does not exclude the truth. Wrong: anything else.",
            "Bounds are exact binomial bounds, 95 %.",
        ],
    };
    page.list(std::iter::once(together).chain(own));
    page.paragraph(
        "`cells.csv` has one row per cell, `trials.parquet` one per trial: `pandas.read_parquet(\"trials.parquet\")`.",
    );
}

/// Three digits.
fn number(x: f64) -> String {
    const MOST_PLACES: u8 = 8;
    if !x.is_finite() {
        return "-".to_owned();
    }
    let shows = |places: &u8| x.abs() * 10.0_f64.powi(i32::from(*places)) >= 99.5;
    let places = (0..MOST_PLACES).find(shows).unwrap_or(MOST_PLACES);
    format!("{x:.*}", usize::from(places))
}
