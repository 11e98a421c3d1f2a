//! The map of leg space: where it fails, leg by leg and condition by condition, and under which loads.

use crate::page::{Block, Figure, Section};
use crate::plot::{HeatMap, Raster};
use hexbench_core::{Vector6, spread_of};

use super::ReportError;
use super::data::{Data, Seen};
use crate::words::by_load;

/// Columns that the map shows apart.
const MOST: usize = 210;
/// Loads that a table shows.
const MOST_LOADS: usize = 24;
/// Sizes from which a cell is darker, standard deviations of the noise.
const LEVELS: [f64; 4] = [1.5, 3.0, 6.0, 12.0];

/// The darkest cell of a table of loads is at least this, times the noise: noise alone stays pale.
const DARKEST: f64 = 4.0;

/// Every condition, then every load; nothing where no readings tell of the legs.
pub(crate) fn section(data: &Data<'_>) -> Result<Option<Section>, ReportError> {
    if !data.tells_of_legs() {
        return Ok(None);
    }
    let remark =
        "The elongation of each leg that would explain the residuals, divided by the effect of noise alone.";
    let section = Section::new("Where in leg space it fails").id("leg-space").remark(remark).with(map(data)?);
    Ok(Some(match loads(data)? {
        Some(table) => section.with(table),
        None => section,
    }))
}

fn map(data: &Data<'_>) -> Result<Block, ReportError> {
    let raster = Raster::new("", LEVELS.to_vec()).with_words(
        "longer",
        "shorter",
        "condition, in the order of the file",
    );
    let group = |raster: Raster, (name, _, seen): (&str, usize, &Seen<'_>)| raster.with(name, rows(seen));
    let map = data.models().fold(raster, group);
    let figure = Figure::laid_out(map.laid_out()?, caption(data));
    Ok(Block::Figure(figure.named("map")))
}

fn rows(seen: &Seen<'_>) -> Vec<(String, Vec<f64>)> {
    let space = &seen.judged.space;
    let shown: Vec<usize> = spread_of(space.determined(), MOST).collect();
    let row = |leg: usize| shown.iter().map(|&i| space.elongation[i][leg] / space.sigma[i][leg]).collect();
    (0..6).map(|leg| (format!("leg {}", leg + 1), row(leg))).collect()
}

fn caption(data: &Data<'_>) -> String {
    let count = data.before.judged.space.determined().len();
    let which =
        if count > MOST { format!("{MOST} of {count} conditions") } else { format!("{count} conditions") };
    format!(
        "{which}: poses, loads and states, repeats averaged. Above the line a leg is longer than predicted, below it \
         shorter, in units of the noise."
    )
}

/// Root mean square of each leg under each load; for few loads, and more than one.
fn loads(data: &Data<'_>) -> Result<Option<Block>, ReportError> {
    let judged = &data.before.judged;
    let (rows, noise) = by_load(&judged.lin.conditions, &judged.space);
    if !(2..=MOST_LOADS).contains(&rows.len()) {
        return Ok(None);
    }
    let level = noise.root_mean_square();
    let cells = |rms: Vector6| rms.component_div(&level).iter().copied().collect();
    let values: Vec<Vec<f64>> = rows.iter().map(|r| cells(r.root_mean_square())).collect();
    let darkest = values.iter().flatten().fold(DARKEST, |m: f64, x| m.max(*x));
    let names = rows.iter().map(|r| r.load.clone()).collect();
    let legs = (1..=6).map(|leg| format!("leg {leg}")).collect();
    let map = HeatMap::new("", names, legs, values)
        .with_decimals(1)
        .with_full_shade_at(darkest)
        .with_cell_size(70.0, 24.0)
        .with_axis_titles("", "root mean square, times the noise");
    let caption = format!("What {} under each change of load, over all poses.", data.words.leaves);
    Ok(Some(Block::Figure(Figure::laid_out(map.laid_out()?, caption).named("loads"))))
}
