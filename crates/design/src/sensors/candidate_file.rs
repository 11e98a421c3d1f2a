//! `candidates.toml`: sensors to choose from.
//!
//! ```toml
//! format = "sensor-candidates/1"
//!
//! [[sensor]]                     # as in hexapod.toml; a cost may be added
//! name = "level_x"
//! kind = "inclination"
//! axis = [1, 0, 0]
//! sigma_urad = 1.5
//! cost = 3                       # default 1
//!
//! [[ring]]                       # points on a circle about the z axis of the platform
//! name = "rim"                   # rim1, rim2, ...; with several directions rim1a, rim1b, ...
//! radius_mm = 120
//! height_mm = 40                 # z of the circle, mobile frame
//! count = 12
//! start_deg = 15                 # of the first point, from x towards y; default 0
//! directions = ["radial", "tangential", [0, 0, 1]]     # of a gauge at each point
//! sigma_um = 0.3
//!
//! [[face]]                       # a grid of points on a parallelogram of the platform
//! name = "top"
//! corner_mm = [-50, -50, 60]     # mobile frame
//! edges_mm = [[100, 0, 0], [0, 100, 0]]
//! counts = [3, 3]                # points along each edge; one stands in the middle
//! directions = ["normal"]
//! sigma_um = 0.3
//! ```
//!
//! Rings and faces with `kind = "point"` have no directions. Directions are fixed axes, of the platform at the zero pose.

use std::path::Path;

use hexbench_core::files::{
    Dimension, Fault, FileError, Format, Item, KeyUnit, SENSOR_WITH_COST, TomlSection, point, read_toml,
    sensor_name, sensor_of, unit_vector,
};
use hexbench_core::{Sensor, SensorKind, Vector3};

/// Points of one ring or along one edge, and candidates of a file, at most.
const MOST: usize = 500;

const FORMAT: Format =
    Format { name: "sensor-candidates/1", keys: &KeyUnit::all_plain(["format", "sensor", "ring", "face"]) };
const RING: &[KeyUnit] = &[
    KeyUnit::plain("name"),
    KeyUnit::plain("kind"),
    KeyUnit::with_unit("radius", Dimension::Length, "mm"),
    KeyUnit::with_unit("height", Dimension::Length, "mm"),
    KeyUnit::plain("count"),
    KeyUnit::with_unit("start", Dimension::Angle, "deg"),
    KeyUnit::plain("directions"),
    KeyUnit::with_unit("sigma", Dimension::Length, "um"),
    KeyUnit::plain("cost"),
];
const FACE: &[KeyUnit] = &[
    KeyUnit::plain("name"),
    KeyUnit::plain("kind"),
    KeyUnit::with_unit("corner", Dimension::Length, "mm"),
    KeyUnit::with_unit("edges", Dimension::Length, "mm"),
    KeyUnit::plain("counts"),
    KeyUnit::plain("directions"),
    KeyUnit::with_unit("sigma", Dimension::Length, "um"),
    KeyUnit::plain("cost"),
];

/// A sensor that may be chosen.
#[derive(Debug, Clone, PartialEq)]
pub struct CandidateSensor {
    /// The sensor.
    pub sensor: Sensor,
    /// What it costs, in the unit of the budget; 1 unless stated.
    pub cost: f64,
}

/// What reads a table: the name in it, and the candidates that it makes.
type Reader = fn(&Item<'_>) -> Result<(String, Vec<CandidateSensor>), Fault>;

/// A point of the platform with directions of its own, by their words.
struct Place {
    point: Vector3,
    named: Vec<(&'static str, Vector3)>,
}

/// Reads the candidates of a file.
///
/// # Errors
/// The first thing that is wrong, with line, column, value and next step; a file without any candidate.
pub fn read_candidates(path: &Path) -> Result<Vec<CandidateSensor>, FileError> {
    read_toml(path, FORMAT, candidates)
}

fn candidates(top: &TomlSection<'_>) -> Result<Vec<CandidateSensor>, Fault> {
    let mut all: Vec<CandidateSensor> = Vec::new();
    let tables: [(&str, Reader); 3] = [("sensor", single), ("ring", ring), ("face", face)];
    for (key, read) in tables {
        for table in top.get(key).map_or(Ok(Vec::new()), Item::list)? {
            let (name, made) = read(&table)?;
            if made.iter().any(|c| all.iter().any(|other| other.sensor.name == c.sensor.name)) {
                let rule = format!("sensors of \"{name}\" have the names of others");
                return Err(table.breaks(rule, "Give each table a name of its own."));
            }
            all.extend(made);
        }
    }
    if all.is_empty() || all.len() > MOST {
        let rule = format!("{} sensors to choose from", all.len());
        let next = format!("Write [[sensor]], [[ring]] or [[face]] tables of 1 to {MOST} sensors.");
        return Err(top.require("format")?.breaks(rule, next));
    }
    Ok(all)
}

fn single(table: &Item<'_>) -> Result<(String, Vec<CandidateSensor>), Fault> {
    let section = table.section("[[sensor]]", SENSOR_WITH_COST)?;
    let sensor = sensor_of(&section)?;
    Ok((sensor.name.clone(), vec![CandidateSensor { sensor, cost: cost(&section)? }]))
}

fn cost(section: &TomlSection<'_>) -> Result<f64, Fault> {
    section.get("cost").map_or(Ok(1.0), |item| item.positive("a cost"))
}

fn ring(table: &Item<'_>) -> Result<(String, Vec<CandidateSensor>), Fault> {
    let section = table.section("[[ring]]", RING)?;
    let radius = section.require("radius")?.positive("a radius")?;
    let height = section.get("height").map_or(Ok(0.0), Item::number)?;
    let start = section.get("start").map_or(Ok(0.0), Item::number)?;
    let count = number(section.require("count")?)?;
    let place = |k: usize| {
        let (s, c) = (start + std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
        let [c, s] = [c, s].map(cleaned);
        Place {
            point: Vector3::new(radius * c, radius * s, height),
            named: vec![("radial", Vector3::new(c, s, 0.0)), ("tangential", Vector3::new(-s, c, 0.0))],
        }
    };
    at_places(&section, &(0..count).map(place).collect::<Vec<_>>())
}

/// Without what rounding leaves of a sine that is zero.
fn cleaned(x: f64) -> f64 {
    if x.abs() < 1e-15 { 0.0 } else { x }
}

fn face(table: &Item<'_>) -> Result<(String, Vec<CandidateSensor>), Fault> {
    let section = table.section("[[face]]", FACE)?;
    let corner = point(section.require("corner")?)?;
    let item = section.require("edges")?;
    let [first, second] = item.exactly::<2>("two edges [x, y, z]")?;
    let edges = [point(&first)?, point(&second)?];
    let normal = edges[0].cross(&edges[1]);
    if normal.norm() <= 1e-9 * edges[0].norm() * edges[1].norm() || normal.norm() <= 0.0 {
        return Err(item
            .breaks("the two edges must not be parallel", "Write for example [[100, 0, 0], [0, 100, 0]]."));
    }
    let [along, across] = section.require("counts")?.exactly::<2>("two numbers of points")?;
    let counts = [number(&along)?, number(&across)?];
    let share = |k: usize, count: usize| if count == 1 { 0.5 } else { k as f64 / (count - 1) as f64 };
    let place = |k: usize| Place {
        point: corner
            + edges[0] * share(k % counts[0], counts[0])
            + edges[1] * share(k / counts[0], counts[1]),
        named: vec![("normal", normal.normalize())],
    };
    at_places(&section, &(0..counts[0] * counts[1]).map(place).collect::<Vec<_>>())
}

fn number(item: &Item<'_>) -> Result<usize, Fault> {
    match usize::try_from(item.whole(1)?) {
        Ok(count) if count <= MOST => Ok(count),
        _ => Err(item.breaks(format!("at most {MOST} points"), "Write a smaller number.")),
    }
}

/// A sensor at every place, or one for each direction there.
fn at_places(section: &TomlSection<'_>, places: &[Place]) -> Result<(String, Vec<CandidateSensor>), Fault> {
    let name = sensor_name(section)?;
    let sigma = section.require("sigma")?.positive("a standard deviation")?;
    let cost = cost(section)?;
    let mut all = Vec::new();
    for (number, place) in (1..).zip(places) {
        let kinds: Vec<SensorKind> = match word(section)? {
            Word::Point => vec![SensorKind::Point { point: place.point, sigma: [sigma; 3] }],
            Word::Distance => directions(section, place)?
                .into_iter()
                .map(|direction| SensorKind::Distance { point: place.point, direction, sigma })
                .collect(),
        };
        let one = kinds.len() == 1;
        for (letter, kind) in ('a'..='z').zip(kinds) {
            let name = if one { format!("{name}{number}") } else { format!("{name}{number}{letter}") };
            all.push(CandidateSensor { sensor: Sensor::new(name, kind), cost });
        }
    }
    Ok((name, all))
}

enum Word {
    Distance,
    Point,
}

fn word(section: &TomlSection<'_>) -> Result<Word, Fault> {
    let Some(item) = section.get("kind") else { return Ok(Word::Distance) };
    match (item.string()?, section.get("directions")) {
        ("distance", _) => Ok(Word::Distance),
        ("point", None) => Ok(Word::Point),
        ("point", Some(item)) => Err(item.breaks("a point is read along all axes", "Remove the key.")),
        _ => {
            Err(item
                .breaks("sensors of a ring or face are of kind distance or point", "Write one of the two."))
        }
    }
}

fn directions(section: &TomlSection<'_>, place: &Place) -> Result<Vec<Vector3>, Fault> {
    let item = section.require("directions")?;
    let known: Vec<&str> = place.named.iter().map(|n| n.0).collect();
    let one = |member: &Item<'_>| {
        if !member.is_string() {
            return unit_vector(member);
        }
        let word = member.string()?;
        let found = place.named.iter().find(|n| n.0 == word).map(|n| n.1);
        found.ok_or_else(|| {
            let next = format!("Write {} or three numbers [x, y, z].", known.join(", "));
            member.breaks(format!("\"{word}\" is no direction here"), next)
        })
    };
    let all: Vec<Vector3> = item.list()?.iter().map(one).collect::<Result<_, _>>()?;
    if (1..=26).contains(&all.len()) {
        Ok(all)
    } else {
        Err(item.breaks("1 to 26 directions", "Write for example [\"radial\", [0, 0, 1]]."))
    }
}
