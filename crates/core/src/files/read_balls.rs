//! Reading balls touched by a measuring machine, and the places where they should be.

use std::path::Path;

use super::column_names::ColumnNames;
use super::error::Fault;
use super::points::{BallTable, PointTable, twice_in};
use super::records::Records;
use super::source::of_records;
use super::toml_file::{Format, read_toml};
use super::toml_value::{Item, KeyUnit, TomlSection};
use super::units::Unit;
use super::{Dimension, FileError};
use crate::{BallPlace, BallPlaces};

const BALLS: Format = Format {
    name: "balls/1",
    keys: &[
        KeyUnit::plain("format"),
        KeyUnit::with_unit("sigma", Dimension::Length, "um"),
        KeyUnit::plain("platform"),
        KeyUnit::plain("base"),
    ],
};
const BALL: &[KeyUnit] = &[KeyUnit::plain("ball"), KeyUnit::with_unit("center", Dimension::Length, "mm")];

/// Reads `balls.csv`: columns `record`, `ball`, `x_mm`, `y_mm`, `z_mm`, others are passed over; or one row for each record, columns `P1_x_mm`
/// and so on; or a file in the layout of another program. `unit` is that of coordinates that state none.
///
/// # Errors
/// The first thing that is wrong, with line, column, value and next step; a ball that is twice in a record, too.
pub fn read_balls(
    path: &Path,
    names: &ColumnNames,
    unit: Option<&'static Unit>,
) -> Result<BallTable, FileError> {
    PointTable::of_balls(names, unit).read(path)
}

/// The same of records; `path` stands for the file in messages.
///
/// # Errors
/// As [`read_balls`].
pub fn read_balls_records(
    records: &Records,
    names: &ColumnNames,
    unit: Option<&'static Unit>,
    path: &Path,
) -> Result<BallTable, FileError> {
    let table = PointTable::of_balls(names, unit);
    of_records(records, |input| table.table(input)).map_err(|fault| fault.in_file(path))
}

/// Reads places of balls, format `balls/1`.
///
/// # Errors
/// The first thing that is wrong, with line, column, value and next step.
pub fn read_ball_places(path: &Path) -> Result<BallPlaces, FileError> {
    read_toml(path, BALLS, |top| {
        let side = |name| top.get(name).map_or(Ok(Vec::new()), places);
        top.require("platform")?;
        let sigma = top.get("sigma").map(|item| item.positive("a standard deviation")).transpose()?;
        Ok(BallPlaces { sigma, platform: side("platform")?, base: side("base")? })
    })
}

fn places(item: &Item<'_>) -> Result<Vec<BallPlace>, Fault> {
    let balls = item.list()?;
    let places = balls.iter().map(|ball| ball.section("[[ball]]", BALL).and_then(|s| place(&s)));
    let places = places.collect::<Result<Vec<_>, _>>()?;
    match (0..places.len()).find(|&k| places[..k].iter().any(|other| other.ball == places[k].ball)) {
        None => Ok(places),
        Some(twice) => Err(balls[twice].fault(twice_in("ball", "this list", &places[twice].ball))),
    }
}

fn place(section: &TomlSection<'_>) -> Result<BallPlace, Fault> {
    let ball = section.require("ball")?.string()?.to_owned();
    let centre = section.require("center")?.numbers::<3>("three coordinates [x, y, z]")?;
    Ok(BallPlace { ball, centre: centre.into() })
}
