//! The sections of the page.

use hexbench_report::{Block, Figure, Section, Table};

use super::charts::{SweepChart, spoken};
use super::equal::{Equal, Matching, equals};
use super::laws::{PowerLaw, laws};
use super::marginal::{Marginal, group_of, marginal, varying};
use super::response::{Response, responses};
use crate::sweep::cells::{AXES, AxisLevel, AxisLevels};
use crate::sweep::columns::Status;
use crate::sweep::results::CellStatistics;
use crate::sweep::study::{SweepStudy, SweepTask};

/// Cells up to which all of them are listed.
const FEW_CELLS: usize = 60;

/// What was run, how much of it has an answer.
pub(super) fn head(study: &SweepStudy, cells: &[CellStatistics]) -> Section {
    let what = match study.task {
        SweepTask::Springs => "six stiffnesses are fitted and compared with the truth",
        SweepTask::Diagnose => "the diagnosis is asked what is hidden",
    };
    let count = |k: usize| cells.iter().map(|c| c.by_status[k]).sum::<u64>();
    let counted = Status::NAMES.iter().enumerate().skip(1).map(|(k, name)| (name, count(k)));
    let failed: Vec<String> =
        counted.filter(|(_, n)| *n > 0).map(|(name, n)| format!("{name}: {n}")).collect();
    let left_out = format!("Trials without an answer: {}. They are left out below.", failed.join(", "));
    let redrawn = match study.redraw {
        1 => "in every trial".to_owned(),
        n => format!("every {n} trials"),
    };
    Section::lead()
        .paragraph(format!(
            "{} cells of {} trials{}, {} in all; in each {what}. Machine, random poses, surroundings and effect are drawn anew \
             {redrawn}, noise in every trial. Seed {}, study {}.",
            cells.len(),
            study.trials,
            if study.until.is_some() { " at most" } else { "" },
            cells.iter().map(CellStatistics::trials).sum::<u64>(),
            study.seed,
            &study.hash()[..12.min(study.hash().len())],
        ))
        .with(sensors_read(study).map(Block::paragraph))
        .with((!failed.is_empty()).then(|| Block::paragraph(left_out)))
}

/// Which machines their sensors read; none where no file has any.
fn sensors_read(study: &SweepStudy) -> Option<String> {
    let with_sensors = study.axes.geometry.iter().filter(|geometry| geometry.has_sensors());
    let names: Vec<&str> = with_sensors.map(|geometry| geometry.name.as_str()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "The sensors in {} take every reading there, as the files state them; held-out errors of translations and rotations \
             are those of the platform.",
            names.join(", ")
        )
    })
}

/// The axes with their values.
pub(super) fn axes(study: &SweepStudy) -> Section {
    let listed = |axis: &AxisLevels| axis.levels.iter().map(AxisLevel::text).collect::<Vec<_>>().join(", ");
    let values = |(place, axis): (usize, &AxisLevels)| match (&study.axes.points, axis.numbers()) {
        (Some((design, ranged)), Some(numbers)) if ranged.contains(&place) => {
            let [from, to] =
                [f64::min, f64::max].map(|end| numbers.iter().copied().reduce(end).unwrap_or(f64::NAN));
            format!("{} points from {from} to {to} ({})", design.points, design.kind.name())
        }
        _ => listed(axis),
    };
    let levels = study.axes.levels();
    let given = levels.iter().enumerate().filter(|(_, axis)| axis.given);
    let rows = given.map(|(place, axis)| [axis.name.to_owned(), values((place, axis))]);
    Section::new("Axes").table(Table::named(["axis", "values"]).rows(rows))
}

/// Laws of powers.
pub(super) fn scaling(study: &SweepStudy, cells: &[CellStatistics]) -> Option<Section> {
    let laws = laws(study, cells);
    let axes = laws.first()?.exponents.iter().map(|(name, _)| *name);
    let row = |law: &PowerLaw| {
        let exponents = law.exponents.iter().map(|(_, x)| format!("{x:.2}"));
        let left = format!("{:.1} %", 100.0 * law.misfit);
        std::iter::once(law.group.clone()).chain(exponents).chain([left]).collect::<Vec<_>>()
    };
    let table = Table::named(std::iter::once("plan").chain(axes).chain(["left over"]));
    let section = Section::new("How the stiffness error scales")
        .paragraph(
            "Least squares on logarithms over all cells of a plan; an exponent of -0.5 is the root of the number, 1 is \
             proportional. What the law leaves over is given as a share of the error.",
        )
        .table(table.rows(laws.iter().map(row)));
    Some(section)
}

/// How many random poses designed ones are worth.
pub(super) fn designed(study: &SweepStudy, cells: &[CellStatistics]) -> Option<Section> {
    let equals = equals(study, cells);
    let row = |e: &Equal| {
        let matching = match e.random_poses {
            Matching::About(n) => format!("{n:.1}"),
            Matching::MoreThan(n) => format!("more than {n}"),
            Matching::FewerThan(n) => format!("fewer than {n}"),
        };
        [
            e.plan.clone(),
            e.poses.to_string(),
            number(e.error_percent),
            number(e.random_error_percent),
            format!("{:.2}", e.random_error_percent / e.error_percent),
            matching,
        ]
    };
    let header = ["plan", "poses", "error, %", "as many random, %", "ratio", "random poses as good"];
    Section::new("Designed and random poses")
        .paragraph("Random poses with the same stiffness error as designed ones, all other axes together.")
        .table(Table::named(header).rows(equals.iter().map(row)))
        .when(!equals.is_empty())
}

/// A table for each axis with more than one value: by a second axis with charts, else by itself.
pub(super) fn by_axis(
    study: &SweepStudy,
    cells: &[CellStatistics],
    charts: Option<&[(&SweepChart, String)]>,
) -> Vec<Section> {
    let levels = study.axes.levels();
    let responses = responses(study, cells);
    let section = |axis: usize| {
        let group = charts.and_then(|_| group_of(study, &levels, axis));
        let of_axis = charts.unwrap_or_default().iter().filter(|(p, _)| p.axis == levels[axis].name);
        let section = Section::new(format!("Over {}", spoken(levels[axis].name)));
        // A value of a range stands for its point alone: its row is that of a cell.
        let section = if study.axes.is_ranged(axis) {
            section
        } else {
            section.table(over(&responses, &levels, &marginal(study, cells, axis, group)))
        };
        of_axis.fold(section, |section, (picture, file)| {
            let figure = Figure::in_file(file, &picture.caption);
            section.with(Block::Figure(Figure {
                svg: picture.svg.clone(),
                name: picture.name.clone(),
                ..figure
            }))
        })
    };
    let shown = |axis: &usize| charts.is_some() || !study.axes.is_ranged(*axis);
    varying(&levels).into_iter().filter(shown).map(section).collect()
}

fn over(responses: &[Response], levels: &[AxisLevels; AXES], found: &Marginal) -> Table {
    let (axis, group) = (&levels[found.axis], found.group.map(|g| &levels[g]));
    let names = group.into_iter().chain([axis]).map(|a| a.name);
    let mut table = Table::named(names.chain(responses.iter().map(|r| r.short.as_str())));
    for (g, line) in found.groups.iter().enumerate() {
        for (level, cell) in axis.levels.iter().zip(line) {
            let at = group.map(|a| &a.levels[g]).into_iter().chain([level]).map(AxisLevel::text);
            table.row(at.chain(results(responses, cell)));
        }
    }
    table
}

fn results(responses: &[Response], cell: &CellStatistics) -> Vec<String> {
    let row = |r: &Response| {
        let [value, low, high] = (r.of)(cell);
        // Coverage is close to 95 %: a digit more tells something.
        let places = usize::from(r.key == "coverage");
        match (value.is_nan(), low.is_nan()) {
            (true, _) => "-".to_owned(),
            (false, true) => number(value),
            (false, false) => format!("{value:.places$} ({low:.places$} to {high:.places$})"),
        }
    };
    responses.iter().map(row).collect()
}

/// Every cell, when there are few.
pub(super) fn all_cells(study: &SweepStudy, cells: &[CellStatistics]) -> Option<Section> {
    let levels = study.axes.levels();
    let responses = responses(study, cells);
    let shown = varying(&levels);
    let axes = shown.iter().map(|&k| levels[k].name);
    let row = |cell: &CellStatistics| {
        let position = study.axes.cell(cell.cell).position;
        let at = shown.iter().map(|&k| levels[k].levels[position[k]].text());
        at.chain(results(&responses, cell)).collect::<Vec<_>>()
    };
    let table = Table::named(axes.chain(responses.iter().map(|r| r.short.as_str())));
    Section::new("All cells").table(table.rows(cells.iter().map(row))).when(cells.len() <= FEW_CELLS)
}

/// What the numbers mean.
pub(super) fn reading(study: &SweepStudy) -> Section {
    let together = if study.axes.points.is_some() {
        "Axes that are ranges move together, from point to point: a marker in a chart is one point, and what lies between markers follows \
         from all ranges. Tables over the other axes take all points together."
    } else if study.until.is_some() {
        "Cells stopped when they were decided, after unequal numbers of trials. A table over one axis takes all trials together: \
         cells that were open for long weigh more in it. Compare single cells."
    } else {
        "A table over one axis takes all trials with the same value together, whatever their values on the others: the factorial \
         is full, so that values may be compared."
    };
    let own = match study.task {
        SweepTask::Springs => [
            "Stiffness error: root mean square over the legs of estimated over true stiffness minus one.",
            "Held-out error over noise: root mean square error of predicted deflections at poses drawn from the same \
             space, without noise, over the standard deviation of one reading. Below 1 the model predicts better than a \
             reading would measure.",
            "Coverage: share of 95 % intervals that hold the true stiffness, with exact binomial bounds that count \
             each trial once.",
        ],
        SweepTask::Diagnose => [
            "Right: exactly what is hidden is named; nothing when there is nothing; \"outside\" when the catalogue lacks it. Honest: \
             ambiguous, and the truth is not excluded. Seen: right or honest.",
            "Missed: nothing is said to be hidden, and something is; the plan lacks power, the diagnosis does not err. False name: an \
             effect is named that is not there; false outside: the catalogue has what is hidden; undecided: ambiguous without the \
             truth.",
            "Bounds are 95 % bounds that count trials with the same machine and effect as far as they tell something new (Korn \
             and Graubard, 1998). Cells share machines: bounds of several cells together are somewhat too narrow.",
        ],
    };
    Section::new("How to read it")
.list(std::iter::once(together).chain(own))
.paragraph("`cells.csv` has one row per cell, `trials.parquet` one per trial: `pandas.read_parquet(\"trials.parquet\")`.")
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
