//! What each added effect explains: the residuals of the final model with that effect taken out, beside the effect itself.

use crate::number::significant;
use crate::page::{Block, Section};
use crate::plot::{Axis, Chart, Panels, Series};
use hexbench_core::{Vector6, spread_of};
use hexbench_model::estimation::campaign::Condition;
use hexbench_model::estimation::linearization::Linearization;
use hexbench_model::results::compare::legs::{LegSpace, leg_space};

use super::ReportError;
use super::data::{Data, Seen};
use super::figures::{Dot, cloud, is_curve, panels, residuals, sheet};
use super::residual_sheet::{OF_LEGS, varies};

/// Conditions of a panel.
const MOST: usize = 100;
/// Charts side by side.
const MOST_COLUMNS: usize = 3;
/// Legs of which an effect must be a curve for them all to be drawn over the variable.
const LEAST_CURVES: usize = 4;

/// Something a leg has, over which an effect may be a curve.
type Over<'a> = Box<dyn Fn(&Condition, usize) -> f64 + 'a>;

/// One effect, with and without.
struct Effect<'a> {
    id: &'static str,
    final_model: &'a Seen<'a>,
    without: LegSpace,
}

/// A chart for each added effect, and its course over a variable where it has one.
pub(crate) fn section(data: &Data<'_>) -> Result<Option<Section>, ReportError> {
    let Some(after) = data.after.as_ref().filter(|_| data.tells_of_legs()) else { return Ok(None) };
    let remark = "Residual elongations of the final model with one effect removed; springs and other effects stay as fitted.";
    let mut section = Section::new("What each added effect explains").id("explained").remark(remark);
    let columns = after.point.active.len().min(MOST_COLUMNS);
    let mut all = Panels::new("", columns).with_panel_size(300.0, 240.0);
    let mut courses = Vec::new();
    for k in 0..after.point.active.len() {
        let effect = Effect::of(data, after, k)?;
        all = all.with(effect.chart());
        courses.extend(effect.course(after.point.active[k].shape)?);
    }
    let caption = "All legs: residual without the effect against the part that the effect explains. On the line, the effect explains everything.";
    section.blocks.push(sheet("all-legs", &all, caption)?);
    section.blocks.extend(courses);
    Ok(Some(section))
}

impl<'a> Effect<'a> {
    fn of(data: &Data<'_>, after: &'a Seen<'a>, k: usize) -> Result<Self, ReportError> {
        let mut point = after.point.clone();
        point.active[k].values.fill(0.0);
        let lin = Linearization::at(data.campaign, &point)?;
        Ok(Self { id: point.active[k].id(), final_model: after, without: leg_space(data.campaign, &lin) })
    }

    /// Condition, what is left without the effect, and what the effect explains of it, um.
    fn shown(&self) -> impl Iterator<Item = (&Condition, Vector6, Vector6)> {
        let judged = &self.final_model.judged;
        spread_of(judged.space.determined(), MOST).map(|i| {
            let left = self.without.elongation[i] * 1e6;
            (&judged.lin.conditions[i], left, left - judged.space.elongation[i] * 1e6)
        })
    }

    fn chart(&self) -> Chart {
        let points: Vec<[f64; 2]> = self
            .shown()
            .flat_map(|(_, left, explained)| {
                (0..6).map(|leg| [explained[leg], left[leg]]).collect::<Vec<_>>()
            })
            .collect();
        let [low, high] = points.iter().fold([0.0, 0.0], |[l, h]: [f64; 2], p| [l.min(p[0]), h.max(p[0])]);
        Chart::new(self.id, Axis::new("the effect explains", "um"), Axis::new("left without it", "um"))
            .with(residuals("left without the effect", points))
            .with(Series::line("explained", vec![[low, low], [high, high]]).as_reference())
    }

    /// Every leg over the variable of which the effect is a curve.
    fn course(&self, shape: f64) -> Result<Option<Block>, ReportError> {
        let mut best: Option<(usize, &str, &str, Over<'_>)> = None;
        for (title, unit, x) in self.variables(shape) {
            let curves = (0..6).filter(|leg| is_curve(&self.dots(*leg, &x))).count();
            if curves >= LEAST_CURVES && best.as_ref().is_none_or(|(most, ..)| curves > *most) {
                best = Some((curves, title, unit, x));
            }
        }
        let Some((_, title, unit, x)) = best else { return Ok(None) };
        let mut all = panels();
        for leg in 0..6 {
            let names = ["left without the effect", "the effect explains"];
            let y = Axis::new(format!("leg {}", leg + 1), "um");
            all = all.with(cloud(names, &self.dots(leg, &x), Axis::new(title, unit), y));
        }
        let caption = format!("{} in each leg over {title}{}.", self.id, fold(shape, title));
        Ok(Some(sheet(self.id, &all, caption)?))
    }

    /// What may carry the course of the effect; a periodic one within its period.
    fn variables(&self, shape: f64) -> Vec<(&'static str, &'static str, Over<'_>)> {
        let mut all: Vec<(&str, &str, Over<'_>)> = Vec::new();
        for v in &OF_LEGS {
            if varies(self.shown().map(|(c, ..)| (v.x)(c, 0))) {
                all.push((v.title, v.unit, Box::new(v.x)));
            }
        }
        if self.is_periodic() {
            let x = move |c: &Condition, leg: usize| 1e3 * c.commanded_lengths[leg].rem_euclid(shape);
            all.push((WITHIN, "mm", Box::new(x)));
        }
        all
    }

    fn is_periodic(&self) -> bool {
        let own = self.final_model.point.active.iter().find(|a| a.id() == self.id);
        own.and_then(|a| a.term.info().shape).is_some_and(|shape| PERIODS.contains(&shape.name))
    }

    fn dots(&self, leg: usize, x: &Over<'_>) -> Vec<Dot> {
        let dot = |(c, left, explained): (&Condition, Vector6, Vector6)| Dot {
            x: x(c, leg),
            left: left[leg],
            explained: Some(explained[leg]),
            approach: c.approach,
        };
        self.shown().map(dot).collect()
    }
}

/// Shapes that are periods of leg length.
const PERIODS: [&str; 2] = ["pitch", "period"];
/// Name of the variable of a periodic effect.
const WITHIN: &str = "leg length within one period";

/// The period, where a chart is folded at it.
fn fold(shape: f64, title: &str) -> String {
    if title == WITHIN { format!(" of {} mm", significant(shape * 1e3, 4)) } else { String::new() }
}
