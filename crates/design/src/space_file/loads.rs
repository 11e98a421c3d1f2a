//! `[loads]` of `space.toml`: loads that are listed, and loads that are chosen between bounds.

use hexbench_core::files::{Dimension, Fault, Item, KeyUnit, TomlSection, unit_vector};
use hexbench_core::{Vector6, Wrench};

use crate::space::{ChosenPart, LoadRange, Loading};

/// Standard gravity, m/s^2 (exact by definition).
const GRAVITY_M_PER_S2: f64 = 9.806_65;
/// Loads between bounds of a file, at most.
const MOST: usize = 12;

const LOADS: &[KeyUnit] = &[
    KeyUnit::plain("reference_kg"),
    KeyUnit::plain("masses_kg"),
    KeyUnit::plain("reference_N_Nm"),
    KeyUnit::plain("wrenches_N_Nm"),
    KeyUnit::plain("between"),
];
const BETWEEN: &[KeyUnit] = &[
    KeyUnit::with_unit("mass", Dimension::Mass, "kg"),
    KeyUnit::with_unit("pull", Dimension::Force, "N"),
    KeyUnit::plain("along"),
    KeyUnit::with_unit("fx", Dimension::Force, "N"),
    KeyUnit::with_unit("fy", Dimension::Force, "N"),
    KeyUnit::with_unit("fz", Dimension::Force, "N"),
    KeyUnit::with_unit("mx", Dimension::Moment, "Nm"),
    KeyUnit::with_unit("my", Dimension::Moment, "Nm"),
    KeyUnit::with_unit("mz", Dimension::Moment, "Nm"),
];
const FORCES: usize = 3;
const MASS: &str = "mass";
const PULL: &str = "pull";
const SIX: &str = "six numbers, three forces (N) and three moments (Nm)";

/// The loads of a space, and which of them are chosen.
pub(super) fn loads(top: &TomlSection<'_>) -> Result<(Vec<Loading>, Vec<LoadRange>), Fault> {
    let table = top.section("loads", "[loads]", LOADS)?;
    let reference = reference(&table)?;
    let mut loads = listed(&table, reference)?;
    let mut ranges = Vec::new();
    for (k, between) in table.get("between").map_or(Ok(Vec::new()), Item::list)?.iter().enumerate() {
        if k == MOST {
            let next = "Remove one; a load serves all poses.";
            return Err(between.breaks(format!("at most {MOST} loads are chosen"), next));
        }
        let range = range(between, &reference, loads.len())?;
        loads.push(Loading { reference, load: range.farthest_from(&reference) });
        ranges.push(range);
    }
    Ok((loads, ranges))
}

fn one_of<'s, 't>(
    table: &'s TomlSection<'t>,
    [kg, wrench]: [&str; 2],
) -> Result<(Option<&'s Item<'t>>, Option<&'s Item<'t>>), Fault> {
    match (table.get(kg), table.get(wrench)) {
        (Some(_), Some(second)) => {
            let rule = format!("{kg} and {wrench} say the same");
            Err(second.breaks(rule, "Remove one of the two keys."))
        }
        both => Ok(both),
    }
}

fn reference(table: &TomlSection<'_>) -> Result<Wrench, Fault> {
    match one_of(table, ["reference_kg", "reference_N_Nm"])? {
        (Some(mass), _) => weight(mass),
        (_, Some(item)) => wrench(item),
        _ => Ok(Wrench::default()),
    }
}

fn listed(table: &TomlSection<'_>, reference: Wrench) -> Result<Vec<Loading>, Fault> {
    let loads: Result<Vec<Wrench>, Fault> = match one_of(table, ["masses_kg", "wrenches_N_Nm"])? {
        (Some(masses), _) => masses.list()?.iter().map(weight).collect(),
        (None, None) if table.get("between").is_some() => Ok(Vec::new()),
        _ => table.require("wrenches_N_Nm")?.list()?.iter().map(wrench).collect(),
    };
    Ok(loads?.into_iter().map(|load| Loading { reference, load }).collect())
}

fn weight(item: &Item<'_>) -> Result<Wrench, Fault> {
    let mass = item.positive("a mass")?;
    Ok(Wrench::from_array([0.0, 0.0, -mass * GRAVITY_M_PER_S2, 0.0, 0.0, 0.0]))
}

fn wrench(item: &Item<'_>) -> Result<Wrench, Fault> {
    item.numbers::<6>(SIX).map(Wrench::from_array)
}

/// A load between bounds; `load` is its place among the loads.
fn range(table: &Item<'_>, reference: &Wrench, load: usize) -> Result<LoadRange, Fault> {
    let section = table.section("[[loads.between]]", BETWEEN)?;
    let (mut fixed, mut parts) = (reference.to_vector(), Vec::new());
    for (item, part) in stated(&section)? {
        let [low, high] = bounds(item, part.name)?;
        // What is pulled comes on top of the reference; everything else is what the load has of it.
        if part.name != PULL {
            fixed -= part.direction * (fixed.dot(&part.direction) / part.direction.norm_squared());
        }
        if high > low {
            parts.push(ChosenPart { bounds: [low, high], ..part });
        } else {
            fixed += part.direction * low;
        }
    }
    if parts.is_empty() {
        let next = "Give two numbers, as in fz_N = [-300, -100], or list the load in wrenches_N_Nm.";
        return Err(table.breaks("nothing of this load is between two bounds", next));
    }
    Ok(LoadRange { load, fixed: Wrench::from_array(fixed.into()), parts })
}

/// The parts that a table states, without their bounds; no two along one direction.
fn stated<'s, 't>(section: &'s TomlSection<'t>) -> Result<Vec<(&'s Item<'t>, ChosenPart)>, Fault> {
    let part = |name, unit, direction| ChosenPart { name, unit, direction, bounds: [0.0; 2] };
    let mut parts = Vec::new();
    if let Some(item) = section.get(MASS) {
        let down = Vector6::new(0.0, 0.0, -GRAVITY_M_PER_S2, 0.0, 0.0, 0.0);
        parts.push((item, part(MASS, "kg", down)));
    }
    for (k, name) in Wrench::NAMES.into_iter().enumerate() {
        let Some(item) = section.get(name) else { continue };
        if name == "fz" && section.get(MASS).is_some() {
            return Err(item.breaks("a mass is a force along z", "Remove mass or fz."));
        }
        let mut direction = Vector6::zeros();
        direction[k] = 1.0;
        parts.push((item, part(name, if k < FORCES { "N" } else { "Nm" }, direction)));
    }
    parts.extend(pulled(section)?);
    Ok(parts)
}

/// The pull of a table, which excludes other forces.
fn pulled<'s, 't>(section: &'s TomlSection<'t>) -> Result<Option<(&'s Item<'t>, ChosenPart)>, Fault> {
    let (pull, along) = match (section.get(PULL), section.get("along")) {
        (Some(pull), Some(along)) => (pull, along),
        (Some(pull), None) => {
            return Err(pull.breaks("a pull has a direction", "State it, as in along = [1, 0, 0]."));
        }
        (None, Some(along)) => {
            return Err(along.breaks("only a pull has a direction", "State it, as in pull_N = [0, 100]."));
        }
        (None, None) => return Ok(None),
    };
    let mut forces = std::iter::once(MASS).chain(Wrench::NAMES.into_iter().take(FORCES));
    if let Some(other) = forces.find_map(|name| section.get(name)) {
        return Err(other.breaks("beside a pull there is no other force", "Remove it, or the pull."));
    }
    let n = unit_vector(along)?;
    let direction = Vector6::new(n.x, n.y, n.z, 0.0, 0.0, 0.0);
    Ok(Some((pull, ChosenPart { name: PULL, unit: "N", direction, bounds: [0.0; 2] })))
}

fn bounds(item: &Item<'_>, name: &str) -> Result<[f64; 2], Fault> {
    let bounds = if item.is_list() {
        item.numbers("two numbers, the lowest and the highest")?
    } else {
        [item.number()?; 2]
    };
    if bounds[0] > bounds[1] {
        return Err(item.breaks("the lowest comes first", "Swap the two numbers."));
    }
    if name == MASS && bounds[0] < 0.0 {
        return Err(item.breaks("no mass is negative", "Remove the sign; the weight of a mass is along -z."));
    }
    Ok(bounds)
}
