//! The residual sheet: what the springs alone leave, as elongation of each leg, over everything it may follow.

use hexbench_model::campaign::Condition;
use hexbench_report::html::{Block, Section};
use hexbench_report::plot::{Axis, Panels};

use super::ReportError;
use super::data::Data;
use super::figures::Cloud;

const REMARK: &str =
    "Six legs measure six coordinates, so every residual is six leg elongations: there physics shows.";

/// Per leg over its force and length; all legs over pose, load, time, temperature and approach.
pub(crate) fn section(data: &Data) -> Result<Section, ReportError> {
    let section = Section::new("residuals", "Residual sheet", REMARK)
        .with(by_leg(data, "change of leg force", "N", |c, leg| c.force_change()[leg])?)
        .with(by_leg(data, "leg length", "mm", |c, leg| 1e3 * c.legs.lengths[leg])?)
        .with(by_pose(data)?);
    Ok(match by_conditions(data)? {
        Some(block) => section.with(block),
        None => section,
    })
}

fn by_leg(
    data: &Data,
    title: &str,
    unit: &str,
    x: impl Fn(&Condition, usize) -> f64,
) -> Result<Block, ReportError> {
    let mut panels = Panels::new("", 3).with_panel_size(300.0, 190.0);
    for leg in 0..6 {
        let cloud =
            Cloud::of(data.conditions().map(|(c, left, fit)| (x(c, leg), left[leg], fit.map(|f| f[leg]))));
        let y = Axis::new(format!("leg {}", leg + 1), "um");
        panels = panels.with(cloud.chart("", Axis::new(title, unit), y));
    }
    Ok(Block::figure(&panels.to_svg()?, format!("Residual elongation of each leg over its {title}.")))
}

fn by_pose(data: &Data) -> Result<Block, ReportError> {
    const NAMES: [&str; 6] = ["a", "b", "c", "alpha", "beta", "gamma"];
    let mut panels = Panels::new("", 3).with_panel_size(300.0, 190.0);
    for (k, name) in NAMES.iter().enumerate() {
        let (unit, per_si) = if k < 3 { ("mm", 1e3) } else { ("deg", 1f64.to_degrees()) };
        panels = panels.with(all_legs(data, |c| per_si * c.pose.to_array()[k]).chart(
            "",
            Axis::new(*name, unit),
            Axis::new("all legs", "um"),
        ));
    }
    Ok(Block::figure(&panels.to_svg()?, "Residual elongation of all legs over each coordinate of the pose."))
}

/// Load, time, temperature and approach, as far as they vary.
fn by_conditions(data: &Data) -> Result<Option<Block>, ReportError> {
    type Variable = (&'static str, &'static str, fn(&Condition) -> f64);
    const ALL: [Variable; 5] = [
        ("change of force", "N", |c| (c.wrench.force - c.reference.force).norm()),
        ("change of moment", "N m", |c| (c.wrench.moment - c.reference.moment).norm()),
        ("time since the reference", "s", |c| c.elapsed),
        ("temperature since the reference", "K", |c| c.delta_t),
        ("approach", "", |c| c.approach),
    ];
    let mut panels = Panels::new("", 3).with_panel_size(300.0, 190.0);
    let mut drawn = 0;
    for (name, unit, x) in ALL {
        let values: Vec<f64> = data.conditions().map(|(c, ..)| x(c)).collect();
        if values.iter().all(|v| (v - values[0]).abs() <= 1e-9 * values[0].abs()) {
            continue;
        }
        panels = panels.with(all_legs(data, x).chart("", Axis::new(name, unit), Axis::new("all legs", "um")));
        drawn += 1;
    }
    let caption = "Residual elongation of all legs over what else varies from reading to reading.";
    Ok(if drawn > 0 { Some(Block::figure(&panels.to_svg()?, caption)) } else { None })
}

fn all_legs(data: &Data, x: impl Fn(&Condition) -> f64) -> Cloud {
    Cloud::of(data.conditions().flat_map(|(c, left, fit)| {
        let x = x(c);
        (0..6).map(move |leg| (x, left[leg], fit.map(|f| f[leg])))
    }))
}
