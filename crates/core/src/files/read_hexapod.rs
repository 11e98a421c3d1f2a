//! Reading `hexapod.toml`.

use super::error::Fault;
use super::read_sensor::{point, sensors};
use super::toml_file::{Format, parse_toml, read_toml};
use super::toml_value::{Item, KeyUnit, TomlSection};
use super::{Dimension, FileError, FileProblem};
use crate::{AngleConvention, Hexapod, Metrology, Tolerances, Vector3, pairs_of_six};
use std::path::Path;

/// The format this program reads and writes.
pub(crate) const FORMAT: &str = "hexapod/1";

const HEXAPOD: Format = Format { name: FORMAT, keys: TOP };

/// Joints nearer than this are one point, m.
const SAME_POINT_M: f64 = 1e-9;

/// Smallest and largest distance between two joints of one side, m.
const MACHINE_SIZE_M: [f64; 2] = [1e-3, 1e3];

const TOP: &[KeyUnit] = &KeyUnit::all_plain([
    "format",
    "name",
    "geometry",
    "metrology",
    "legs",
    "base",
    "payload",
    "tolerances",
    "conventions",
    "sensor",
]);
const GEOMETRY: &[KeyUnit] = &[
    KeyUnit::with_unit("base_joints", Dimension::Length, "mm"),
    KeyUnit::with_unit("platform_joints", Dimension::Length, "mm"),
];
const METROLOGY: &[KeyUnit] = &[
    KeyUnit::with_unit("sigma_translation", Dimension::Length, "um"),
    KeyUnit::with_unit("sigma_rotation", Dimension::Angle, "urad"),
];
const LEGS: &[KeyUnit] = &[
    KeyUnit::with_unit("nominal_stiffness", Dimension::Stiffness, "N_per_um"),
    KeyUnit::with_unit("min_length", Dimension::Length, "mm"),
    KeyUnit::with_unit("max_length", Dimension::Length, "mm"),
    KeyUnit::plain("brackets"),
];
const BASE: &[KeyUnit] = &[KeyUnit::with_unit("mounting_plane_z", Dimension::Length, "mm")];
const TOLERANCES: &[KeyUnit] = &[
    KeyUnit::with_unit("joints", Dimension::Length, "mm"),
    KeyUnit::plain("load_gain"),
    KeyUnit::with_unit("load_direction", Dimension::Angle, "deg"),
    KeyUnit::with_unit("load_point", Dimension::Length, "mm"),
    KeyUnit::with_unit("frame", Dimension::Angle, "deg"),
    KeyUnit::plain("noise"),
    KeyUnit::with_unit("sensor_point", Dimension::Length, "mm"),
    KeyUnit::with_unit("sensor_direction", Dimension::Angle, "deg"),
    KeyUnit::plain("sensor_gain"),
];
const CONVENTIONS: &[KeyUnit] = &KeyUnit::all_plain(["angles"]);
const PAYLOAD: &[KeyUnit] = &[KeyUnit::with_unit("center_of_gravity", Dimension::Length, "mm")];

/// Reads `hexapod.toml`; `docs/reference/file-formats.md` defines the keys.
///
/// # Errors
/// The first thing that is wrong, with line, column, value and next step: an unknown key, a missing joint, a number
/// that is not finite, joints at one point, a standard deviation of zero.
///
/// # Example
/// ```no_run
/// let hexapod = hexbench_core::files::read_hexapod("hexapod.toml".as_ref())?;
/// println!("{}", hexapod.name);
/// # Ok::<(), hexbench_core::files::FileError>(())
/// ```
pub fn read_hexapod(path: &Path) -> Result<Hexapod, FileError> {
    read_toml(path, HEXAPOD, hexapod_of)
}

/// The same from text; `name` stands for the file in messages.
///
/// # Errors
/// As [`read_hexapod`].
pub fn parse_hexapod(text: &str, name: &str) -> Result<Hexapod, FileError> {
    parse_toml(text, HEXAPOD, hexapod_of).map_err(|fault| fault.in_file(Path::new(name)))
}

fn hexapod_of(top: &TomlSection<'_>) -> Result<Hexapod, Fault> {
    let name = top.get("name").map(Item::string).transpose()?.unwrap_or("hexapod").to_owned();
    with_sections(name, top)
}

fn with_sections(name: String, top: &TomlSection<'_>) -> Result<Hexapod, Fault> {
    let geometry = top.section("geometry", "[geometry]", GEOMETRY)?;
    let metrology = top.section("metrology", "[metrology]", METROLOGY)?;
    let legs = top.section("legs", "[legs]", LEGS)?;
    let base = top.section("base", "[base]", BASE)?;
    let payload = top.section("payload", "[payload]", PAYLOAD)?;
    let stated = top.section("tolerances", "[tolerances]", TOLERANCES)?;
    let conventions = top.section("conventions", "[conventions]", CONVENTIONS)?;
    let [base_joints, platform_joints] = all_joints(&geometry)?;
    Ok(Hexapod {
        name,
        base_joints,
        platform_joints,
        metrology: top.get("metrology").map(|_| stated_noise(&metrology)).transpose()?,
        nominal_stiffness: legs.get("nominal_stiffness").map(stiffness).transpose()?,
        stroke: stroke(&legs)?,
        brackets: legs.get("brackets").map(brackets).transpose()?,
        mounting_plane_z: base.get("mounting_plane_z").map(Item::number).transpose()?,
        payload_centre: payload.get("center_of_gravity").map(point).transpose()?,
        angles: conventions.get("angles").map_or(Ok(AngleConvention::default()), angles)?,
        tolerances: tolerances(&stated)?,
        sensors: top.get("sensor").map_or(Ok(Vec::new()), sensors)?,
    })
}

fn angles(item: &Item<'_>) -> Result<AngleConvention, Fault> {
    AngleConvention::of_word(item.string()?).ok_or_else(|| {
        item.fault(FileProblem::Rule {
            rule: "this is no convention of angles".to_owned(),
            next: "Write extrinsic-xyz (about fixed axes x, y, z; the usual one), intrinsic-xyz (about axes that move with the platform), another order of x, y, z, or rotation-vector.".to_owned(),
        })
    })
}

fn all_joints(geometry: &TomlSection<'_>) -> Result<[[Vector3; 6]; 2], Fault> {
    let base = geometry.require("base_joints")?;
    let platform = geometry.require("platform_joints")?;
    let joints = [joints(base, "base")?, joints(platform, "platform")?];
    let length = |leg: usize| (joints[0][leg] - joints[1][leg]).norm();
    match (0..6).find(|leg| length(*leg) < SAME_POINT_M) {
        Some(leg) => Err(platform.fault(FileProblem::NoLegLength { leg: leg + 1 })),
        None => Ok(joints),
    }
}

fn joints(item: &Item<'_>, side: &'static str) -> Result<[Vector3; 6], Fault> {
    let mut joints = [Vector3::zeros(); 6];
    let rows = item.exactly::<6>("six joints")?;
    for (joint, row) in joints.iter_mut().zip(&rows) {
        *joint = point(row)?;
    }
    check_meeting(&joints, &rows, side)?;
    check_size(&joints, item, side)?;
    Ok(joints)
}

/// Joints may meet only as in a machine with three double joints; anything else is a copied line.
fn check_meeting(joints: &[Vector3; 6], rows: &[Item<'_>; 6], side: &'static str) -> Result<(), Fault> {
    let is_meeting = |(i, j): &(usize, usize)| (joints[*i] - joints[*j]).norm() < SAME_POINT_M;
    let meeting: Vec<_> = pairs_of_six().filter(is_meeting).collect();
    let mut legs: Vec<usize> = meeting.iter().flat_map(|(i, j)| [*i, *j]).collect();
    legs.sort_unstable();
    if meeting.len() == 3 && legs == [0, 1, 2, 3, 4, 5] {
        return Ok(());
    }
    match meeting.first() {
        None => Ok(()),
        Some((i, j)) => {
            Err(rows[*j].fault(FileProblem::CoincidingJoints { side, first: i + 1, second: j + 1 }))
        }
    }
}

fn check_size(joints: &[Vector3; 6], item: &Item<'_>, side: &'static str) -> Result<(), Fault> {
    let distances = joints.iter().flat_map(|one| joints.iter().map(move |other| (one - other).norm()));
    let size = distances.fold(0.0, f64::max);
    if (MACHINE_SIZE_M[0]..=MACHINE_SIZE_M[1]).contains(&size) {
        return Ok(());
    }
    let size_mm = format!("{:.3e}", size * 1e3).parse().unwrap_or(size * 1e3);
    Err(item.fault(FileProblem::MachineSize { side, size_mm }))
}

fn stated_noise(metrology: &TomlSection<'_>) -> Result<Metrology, Fault> {
    Ok(Metrology {
        sigma_translation: metrology.require("sigma_translation")?.positive("a standard deviation")?,
        sigma_rotation: metrology.require("sigma_rotation")?.positive("a standard deviation")?,
    })
}

/// Those that are stated, the rest as usual; none may be zero, for nothing is exact.
fn tolerances(stated: &TomlSection<'_>) -> Result<Tolerances, Fault> {
    let usual = Tolerances::default();
    let value = |key, usual: f64| stated.get(key).map_or(Ok(usual), |item| item.positive("a tolerance"));
    Ok(Tolerances {
        joints: value("joints", usual.joints)?,
        load_gain: value("load_gain", usual.load_gain)?,
        load_direction: value("load_direction", usual.load_direction)?,
        load_point: value("load_point", usual.load_point)?,
        frame: value("frame", usual.frame)?,
        noise: value("noise", usual.noise)?,
        sensor_point: value("sensor_point", usual.sensor_point)?,
        sensor_direction: value("sensor_direction", usual.sensor_direction)?,
        sensor_gain: value("sensor_gain", usual.sensor_gain)?,
    })
}

/// One stiffness for all legs, or six.
fn stiffness(item: &Item<'_>) -> Result<[f64; 6], Fault> {
    const QUANTITY: &str = "a stiffness";
    if !item.is_list() {
        return Ok([item.positive(QUANTITY)?; 6]);
    }
    let mut stiffness = [0.0; 6];
    for (value, item) in stiffness.iter_mut().zip(item.exactly::<6>("one stiffness or six")?) {
        *value = item.positive(QUANTITY)?;
    }
    Ok(stiffness)
}

fn stroke(legs: &TomlSection<'_>) -> Result<Option<[f64; 2]>, Fault> {
    if legs.get("min_length").is_none() && legs.get("max_length").is_none() {
        return Ok(None);
    }
    let shortest = legs.require("min_length")?.positive("a leg length")?;
    let longest = legs.require("max_length")?;
    match longest.positive("a leg length")? {
        length if length > shortest => Ok(Some([shortest, length])),
        _ => Err(longest.fault(FileProblem::Stroke)),
    }
}

/// Whole numbers are exact in a float.
fn is_same(one: f64, other: f64) -> bool {
    one.total_cmp(&other).is_eq()
}

/// Pairs counted from 1 in the file, from 0 inside.
fn brackets(item: &Item<'_>) -> Result<Vec<[usize; 2]>, Fault> {
    item.list()?.iter().map(bracket).collect()
}

fn bracket(item: &Item<'_>) -> Result<[usize; 2], Fault> {
    let pair = item.numbers::<2>("two legs")?;
    let leg = |number: f64| (0..6_u8).find(|leg| is_same(f64::from(leg + 1), number)).map(usize::from);
    match pair.map(leg) {
        [Some(one), Some(other)] if one != other => Ok([one, other]),
        _ => Err(item.fault(FileProblem::Bracket)),
    }
}
