//! Sensors in TOML: `[[sensor]]` tables, of machines and of candidates to choose from.

use super::Dimension;
use super::error::Fault;
use super::sensor_columns::column_taken_by;
use super::toml_value::{Item, KeyUnit, TomlSection};
use crate::{Sensor, SensorKind, Vector3};

/// Keys of a sensor, and `cost`.
pub const SENSOR_WITH_COST: &[KeyUnit] = &[
    KeyUnit::plain("name"),
    KeyUnit::plain("kind"),
    KeyUnit::with_unit("point", Dimension::Length, "mm"),
    KeyUnit::plain("direction"),
    KeyUnit::plain("axis"),
    KeyUnit::plain("leg"),
    KeyUnit::with_unit("sigma", Dimension::Length, "um"),
    KeyUnit::with_unit("sigma", Dimension::Angle, "urad"),
    KeyUnit::plain("cost"),
];
/// Keys of a sensor of a machine.
const SENSOR: &[KeyUnit] = SENSOR_WITH_COST.split_at(SENSOR_WITH_COST.len() - 1).0;

/// A point in the unit of its key, m.
///
/// # Errors
/// Anything but three numbers.
pub fn point(item: &Item<'_>) -> Result<Vector3, Fault> {
    item.numbers::<3>("three coordinates [x, y, z]").map(Vector3::from)
}

/// The `[[sensor]]` tables of a machine.
///
/// # Errors
/// The first that is wrong, or has the name of another.
pub fn sensors(item: &Item<'_>) -> Result<Vec<Sensor>, Fault> {
    let mut all: Vec<Sensor> = Vec::new();
    for table in item.list()? {
        let section = table.section("[[sensor]]", SENSOR)?;
        let sensor = sensor_of(&section)?;
        if all.iter().any(|other| other.name == sensor.name) {
            let rule = format!("two sensors are called \"{}\"", sensor.name);
            return Err(section.require("name")?.breaks(rule, "Give each a name of its own."));
        }
        all.push(sensor);
    }
    Ok(all)
}

/// The sensor of a table with the keys of [`SENSOR_WITH_COST`].
///
/// # Errors
/// The first key that is missing or wrong; a name that a column of something else begins with.
pub fn sensor_of(section: &TomlSection<'_>) -> Result<Sensor, Fault> {
    let sensor = Sensor::new(sensor_name(section)?, sensor_kind(section)?);
    if let Some(column) = column_taken_by(&sensor.name) {
        let name = &sensor.name;
        let rule = format!(
            "a sensor called \"{name}\" would take the column {column}, which is no reading of a sensor"
        );
        return Err(section.require("name")?.breaks(rule, format!("Call it gauge_{name}, for example.")));
    }
    Ok(sensor)
}

/// The name of a sensor, or what the names of several begin with.
///
/// # Errors
/// No name, or one that no column can have.
pub fn sensor_name(section: &TomlSection<'_>) -> Result<String, Fault> {
    let name = section.require("name")?;
    let text = name.string()?;
    let mut letters = text.chars();
    let is_name = letters.next().is_some_and(|c| c.is_ascii_lowercase())
        && letters.all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    if !is_name {
        let rule =
            "the name of a sensor begins with a small letter and goes on with small letters, digits and _";
        return Err(name.breaks(rule, "Write for example g1 or level_x."));
    }
    Ok(text.to_owned())
}

fn sensor_kind(section: &TomlSection<'_>) -> Result<SensorKind, Fault> {
    const SIGMA: &str = "a standard deviation";
    let kind = section.require("kind")?;
    let one = || section.require("sigma")?.positive(SIGMA);
    let point_of = || section.require("point").and_then(point);
    let read = match kind.string()? {
        "distance" => SensorKind::Distance {
            point: point_of()?,
            direction: direction(section, "direction")?,
            sigma: one()?,
        },
        "point" => {
            let sigma = section.require("sigma")?;
            let mut each = [0.0; 3];
            if sigma.is_list() {
                for (value, item) in
                    each.iter_mut().zip(sigma.exactly::<3>("one standard deviation or three")?)
                {
                    *value = item.positive(SIGMA)?;
                }
            } else {
                each = [sigma.positive(SIGMA)?; 3];
            }
            SensorKind::Point { point: point_of()?, sigma: each }
        }
        "inclination" => SensorKind::Inclination { axis: direction(section, "axis")?, sigma: one()? },
        "leg-length" => {
            let item = section.require("leg")?;
            let leg = (1..=6_usize).find(|leg| item.whole(1).is_ok_and(|number| number == *leg as u64));
            let leg =
                leg.ok_or_else(|| item.breaks("a leg is numbered 1 to 6", "Write for example leg = 3."))?;
            SensorKind::LegLength { leg: leg - 1, sigma: one()? }
        }
        "function" => {
            let rule = "no file holds the function of a sensor of one's own";
            return Err(kind.breaks(rule, "Add it in Python, by Hexapod.with_sensor."));
        }
        other => {
            let rule = format!("\"{other}\" is no kind of sensor");
            return Err(kind.breaks(rule, "Write distance, point, inclination or leg-length."));
        }
    };
    let sigma = section.require("sigma")?;
    if read.is_angle() != sigma.key().ends_with("rad") && !sigma.key().ends_with("deg") {
        let usual = if read.is_angle() { "sigma_urad" } else { "sigma_um" };
        return Err(sigma
            .breaks(format!("a sensor of kind {} states {usual}", read.word()), format!("Write {usual}.")));
    }
    Ok(read)
}

fn direction(section: &TomlSection<'_>, key: &str) -> Result<Vector3, Fault> {
    unit_vector(section.require(key)?)
}

/// A direction of any length, as a unit vector.
///
/// # Errors
/// Anything but three numbers of which one is not zero.
pub fn unit_vector(item: &Item<'_>) -> Result<Vector3, Fault> {
    let vector = Vector3::from(item.numbers::<3>("three numbers [x, y, z]")?);
    let length = vector.norm();
    if length > 0.0 && length.is_finite() {
        Ok(vector / length)
    } else {
        Err(item.breaks("a direction must not be zero", "Write for example [0, 0, 1]."))
    }
}
