//! Reading `[design]`, and axes that are ranges.

use std::cell::RefCell;

use hexbench_core::files::{Fault, Item, KeyUnit, TomlSection};

use crate::keys::{named, one_of};
use crate::sweep::points::{AxisRange, PointDesign, PointKind};

const DESIGN: &[KeyUnit] = &KeyUnit::all_plain(["kind", "points"]);
const RANGE: &[KeyUnit] = &KeyUnit::all_plain(["from", "to", "scale"]);
const SCALES: [&str; 2] = ["linear", "log"];
/// Most points: beyond, the sequence repeats itself.
const MOST_POINTS: u64 = 65_536;
const FEWEST_POINTS: u64 = 2;

/// The points of a study, and which axes have been spread over them.
pub(super) struct Points {
    design: Option<PointDesign>,
    /// Places of the axes that are ranges, in the order of their dimensions.
    ranged: RefCell<Vec<usize>>,
}

impl Points {
    /// What `[design]` says; none without it.
    pub(super) fn read(top: &TomlSection<'_>, seed: u64) -> Result<Self, Fault> {
        let design = top.get("design").map(|item| design(item, seed)).transpose()?;
        Ok(Self { design, ranged: RefCell::default() })
    }

    /// Values of a range of an axis by the place of the axis.
    pub(super) fn numbers(&self, item: &Item<'_>, axis: usize, may_be_zero: bool) -> Result<Vec<f64>, Fault> {
        let range = range(item)?;
        if !may_be_zero || range[0].number()? != 0.0 {
            range[0].positive("the start of the range")?;
        }
        let (design, dimension) = self.next(item, axis)?;
        Ok(design.numbers(dimension, bounds(&range)?))
    }

    /// The same in whole numbers from 1.
    pub(super) fn whole(&self, item: &Item<'_>, axis: usize, most: u64) -> Result<Vec<u64>, Fault> {
        let range = range(item)?;
        range[0].whole(1)?;
        if range[1].whole(1)? > most {
            return Err(range[1].breaks(format!("at most {most}"), "Write a smaller number."));
        }
        let (design, dimension) = self.next(item, axis)?;
        Ok(design.whole(dimension, bounds(&range)?))
    }

    /// The points with the places of their axes; none where there are none.
    pub(super) fn of_axes(&self, top: &TomlSection<'_>) -> Result<Option<(PointDesign, Vec<usize>)>, Fault> {
        let ranged = self.ranged.borrow().clone();
        match (self.design, top.get("design")) {
            (Some(_), Some(item)) if ranged.is_empty() => Err(item.breaks(
                "no axis is a range",
                "Write for example noise_scale = { from = 0.5, to = 4 }, or remove [design].",
            )),
            (Some(design), _) => Ok(Some((design, ranged))),
            (None, _) => Ok(None),
        }
    }

    fn next(&self, item: &Item<'_>, axis: usize) -> Result<(PointDesign, usize), Fault> {
        let Some(design) = self.design else {
            let next = "Add [design] with kind = \"sobol\" and points = 64, or write a list of values.";
            return Err(item.breaks("a range needs points, but there is no [design]", next));
        };
        let mut ranged = self.ranged.borrow_mut();
        ranged.push(axis);
        Ok((design, ranged.len() - 1))
    }
}

fn design(item: &Item<'_>, seed: u64) -> Result<PointDesign, Fault> {
    let t = item.section("[design]", DESIGN)?;
    let kind = named(t.require("kind")?, PointKind::ALL, PointKind::name, "design")?;
    let points = t.require("points")?;
    let count = points.whole(FEWEST_POINTS)?;
    if count > MOST_POINTS {
        return Err(points.breaks(format!("at most {MOST_POINTS}"), "Write a smaller number."));
    }
    Ok(PointDesign { kind, points: usize::try_from(count).unwrap_or(usize::MAX), seed })
}

/// First and last value of a range, and its scale where it is stated.
struct Ends<'t> {
    ends: [Item<'t>; 2],
    scale: Option<Item<'t>>,
}

impl<'t> std::ops::Index<usize> for Ends<'t> {
    type Output = Item<'t>;

    fn index(&self, end: usize) -> &Item<'t> {
        &self.ends[end]
    }
}

fn range<'t>(item: &Item<'t>) -> Result<Ends<'t>, Fault> {
    let t = item.section("a range", RANGE)?;
    let ends = [t.require("from")?.clone(), t.require("to")?.clone()];
    Ok(Ends { ends, scale: t.get("scale").cloned() })
}

fn bounds(range: &Ends<'_>) -> Result<AxisRange, Fault> {
    let [from, to] = [range[0].number()?, range[1].number()?];
    if from >= to {
        return Err(
            range[1].breaks(format!("a range must rise, but from is {from}"), "Write a larger number.")
        );
    }
    let scale = range
        .scale
        .as_ref()
        .map(|item| Ok::<_, Fault>((item, one_of(item, &SCALES, "scale")?)))
        .transpose()?;
    let is_log = scale.as_ref().is_some_and(|(_, scale)| *scale == 1);
    match scale {
        Some((item, _)) if is_log && from <= 0.0 => Err(item.breaks(
            "a logarithmic range cannot begin at zero",
            "Write from above zero, or scale = \"linear\".",
        )),
        _ => Ok(AxisRange { from, to, is_log }),
    }
}
