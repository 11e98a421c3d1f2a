//! The residual sheet: what the first model leaves, as elongation of each leg, over everything it may follow.

use crate::page::{Block, Section};
use crate::plot::Axis;
use hexbench_model::estimation::campaign::Condition;

use super::ReportError;
use super::data::{Data, Shown};
use super::figures::{Dot, EXPLAIN, cloud, panels, sheet};

const REMARK: &str = "Six legs measure six coordinates, so every residual can be written as six leg elongations, which show the physics.";

/// What has a panel for each leg.
pub(crate) struct OfLegs {
    id: &'static str,
    pub(crate) title: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) x: fn(&Condition, usize) -> f64,
}

pub(crate) const OF_LEGS: [OfLegs; 5] = [
    OfLegs { id: "force", title: "leg force", unit: "N", x: |c, leg| c.force[leg] },
    OfLegs {
        id: "force-change",
        title: "change of leg force",
        unit: "N",
        x: |c, leg| c.force[leg] - c.reference_force[leg],
    },
    OfLegs { id: "length", title: "leg length", unit: "mm", x: |c, leg| 1e3 * c.legs.lengths[leg] },
    OfLegs { id: "time", title: "time since the reference", unit: "s", x: |c, _| c.elapsed },
    OfLegs { id: "temperature", title: "temperature since the reference", unit: "K", x: |c, _| c.delta_t },
];

/// What has a panel for all legs together: its name, unit and value.
type OfAll = (&'static str, &'static str, fn(&Condition) -> f64);

const POSE: [OfAll; 6] = [
    ("a", "mm", |c| 1e3 * c.place.pose().to_array()[0]),
    ("b", "mm", |c| 1e3 * c.place.pose().to_array()[1]),
    ("c", "mm", |c| 1e3 * c.place.pose().to_array()[2]),
    ("alpha", "deg", |c| c.place.pose().to_array()[3].to_degrees()),
    ("beta", "deg", |c| c.place.pose().to_array()[4].to_degrees()),
    ("gamma", "deg", |c| c.place.pose().to_array()[5].to_degrees()),
];

/// Travel of a coordinate of the pose worth a panel, mm and deg: deflections alone move it less.
const LEAST_TRAVEL: f64 = 0.05;

const LOAD: [OfAll; 3] = [
    ("change of force", "N", |c| (c.wrench.force - c.reference.force).norm()),
    ("change of moment", "N m", |c| (c.wrench.moment - c.reference.moment).norm()),
    ("approach", "", |c| c.approach.sign()),
];

/// Per leg over force, length, time and temperature; all legs over pose, load and approach: as far as they vary.
pub(crate) fn section(data: &Data<'_>) -> Result<Option<Section>, ReportError> {
    if !data.tells_of_legs() {
        return Ok(None);
    }
    let mut section = Section::new("Residual sheet").id("residuals").remark(REMARK).folded();
    for one in OF_LEGS.iter().filter(|v| differs_from_the_one_before(data, v)) {
        section.blocks.extend(by_leg(data, one)?);
    }
    let pose = "Residual elongation of all legs against the coordinates of the pose.";
    section.blocks.extend(by_all(data, "pose", &POSE, LEAST_TRAVEL, pose)?);
    let load = "Residual elongation of all legs against the size of the load change and the approach.";
    section.blocks.extend(by_all(data, "load", &LOAD, 0.0, load)?);
    Ok(Some(section))
}

/// Without a reference load the change of a leg force is the force itself.
fn differs_from_the_one_before(data: &Data<'_>, v: &OfLegs) -> bool {
    v.id != "force-change" || data.conditions().any(|s| s.at.reference_force.amax() > 0.0)
}

pub(crate) fn varies(mut values: impl Iterator<Item = f64>) -> bool {
    const SAME: f64 = 1e-9;
    let Some(first) = values.next() else { return false };
    values.any(|v| (v - first).abs() > SAME * first.abs().max(1.0))
}

fn by_leg(data: &Data<'_>, v: &OfLegs) -> Result<Option<Block>, ReportError> {
    if !varies(data.conditions().map(|s| (v.x)(s.at, 0))) {
        return Ok(None);
    }
    let mut all = panels();
    for leg in 0..6 {
        let dots: Vec<Dot> = data.conditions().map(|s| dot(&s, leg, (v.x)(s.at, leg))).collect();
        let y = Axis::new(format!("leg {}", leg + 1), "um");
        all = all.with(cloud([data.words.leaves, EXPLAIN], &dots, Axis::new(v.title, v.unit), y));
    }
    let caption = format!("Residual elongation of each leg against {}.", v.title);
    Ok(Some(sheet(v.id, &all, caption)?))
}

fn dot(shown: &Shown<'_>, leg: usize, x: f64) -> Dot {
    Dot { x, left: shown.left[leg], explained: shown.explained.map(|e| e[leg]), approach: shown.at.approach }
}

/// Those that vary by more than the least.
fn by_all(
    data: &Data<'_>,
    id: &'static str,
    all: &[OfAll],
    least: f64,
    caption: &str,
) -> Result<Option<Block>, ReportError> {
    let mut shown = panels();
    let mut drawn = 0;
    for (name, unit, x) in all {
        let values = || data.conditions().map(|s| x(s.at));
        let [low, high] = values().fold([f64::MAX, f64::MIN], |[l, h], v| [l.min(v), h.max(v)]);
        if !varies(values()) || high - low < least {
            continue;
        }
        let dots: Vec<Dot> = data
            .conditions_with_all_legs()
            .flat_map(|s| (0..6).map(|leg| dot(&s, leg, x(s.at))).collect::<Vec<_>>())
            .collect();
        shown = shown.with(cloud(
            [data.words.leaves, EXPLAIN],
            &dots,
            Axis::new(*name, *unit),
            Axis::new("all legs", "um"),
        ));
        drawn += 1;
    }
    Ok(if drawn > 0 { Some(sheet(id, &shown, caption)?) } else { None })
}
