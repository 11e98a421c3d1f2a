//! The story in one picture: the machine under its most telling load, what each model misses of its motion, and how the error falls.

mod bodies;
mod errors;
mod load;

use crate::body;
use crate::number::significant;
use crate::page::{Block, Figure, Section};
use crate::plot::{PlotError, Rungs, Wireframe};
use crate::words::next;
use hexbench_core::Vector6;
use hexbench_model::effects::term::Need;
use hexbench_model::estimation::campaign::Condition;
use hexbench_model::results::compare::acts::EffectMotion;
use hexbench_model::results::diagnose::Diagnosis;

use self::bodies::Bodies;
pub(super) use self::bodies::unloaded;
pub(super) use self::errors::ErrorSteps;
use super::ReportError;
use super::data::Data;
use super::figures::{FINAL, SPRINGS};

/// Longest drawn displacement of a joint, as a share of the platform radius.
const DRAWN: f64 = 0.35;
/// Share of that length at which a bar of scale is about as long.
const SCALE: f64 = 0.6;

/// The condition of which the added effects explain most, or that the first model misses most, of those in which six numbers tell the motion; `found`: with the ladder of a
/// diagnosis.
pub(crate) fn section(data: &Data<'_>, found: Option<&Diagnosis>) -> Result<Option<Section>, ReportError> {
    let charted = ChartedMachine::of(data, found.map(ErrorSteps::of).as_ref());
    let Some(charted) = charted.filter(|charted| charted.shrinks) else { return Ok(None) };
    let figure = Figure::laid_out(charted.laid_out()?, charted.caption);
    Ok(Some(Section::new(charted.title).id("machine").with(Block::Figure(figure))))
}

/// The parts of the picture, before they are laid out.
pub(super) struct ChartedMachine {
    pub(super) title: &'static str,
    pub(super) views: Wireframe,
    pub(super) bars: Rungs,
    pub(super) caption: String,
    /// True unless added effects leave as much as they should explain.
    pub(super) shrinks: bool,
}

impl ChartedMachine {
    /// None where no condition tells the motion of the platform, or nothing moves.
    pub(super) fn of(data: &Data<'_>, errors: Option<&ErrorSteps>) -> Option<Self> {
        let seen = Telling::of(data)?;
        let factor =
            DRAWN * data.before.judged.lin.machine.nominal.platform_radius() / seen.most(&seen.missed);
        let title = if data.after.is_some() { "The story in one picture" } else { "The machine under load" };
        factor.is_finite().then(|| Self {
            title,
            views: seen.drawing(data, factor),
            bars: bars(data, &seen, errors),
            caption: caption(data, &seen, factor),
            shrinks: seen
                .explained
                .is_none_or(|[_, left]| seen.of_joint(&left) < seen.of_joint(&seen.missed)),
        })
    }
}

impl ChartedMachine {
    /// For a wide window, the bars on the right, and for a narrow one, the bars below.
    pub(super) fn laid_out(&self) -> Result<[String; 2], PlotError> {
        let (views, bars) = (&self.views, &self.bars);
        Ok([views.clone().beside(bars.clone()).to_svg()?, views.clone().above(bars.clone()).to_svg()?])
    }
}

/// The most telling condition: twists of the platform at its origin, m and rad.
struct Telling<'a> {
    bodies: Bodies<'a>,
    /// What the first model misses.
    missed: Vector6,
    /// What the added effects explain of it, and what is left.
    explained: Option<[Vector6; 2]>,
    /// What the added effects do to base and legs.
    acts: Option<EffectMotion>,
    /// The platform joint that the first model misses most, from 0.
    joint: usize,
    /// Motion of that joint that noise alone gives, root mean square, m.
    noise: f64,
    /// Conditions that it was chosen from.
    of: usize,
}

impl<'a> Telling<'a> {
    fn of(data: &'a Data<'_>) -> Option<Self> {
        let judged = &data.before.judged;
        let determined = if data.campaign.blocks.len() < 2 { judged.space.determined() } else { Vec::new() };
        let of = determined.len();
        let after = |i: usize| data.after.as_ref().map_or(Vector6::zeros(), |a| a.judged.lin.residual(i));
        // What is explained tells more than what is missed: noise is missed too.
        let size = |i: &usize| (judged.lin.residual(*i) - after(*i)).norm();
        let worst = determined.into_iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
        let at = &judged.lin.conditions[worst];
        let missed = at.motion(&(at.reading - judged.lin.predicted(worst)));
        let left = data.after.as_ref().map(|a| {
            // Of absolute poses, each model has a reading of its own: in the frames that it found.
            let lin = &a.judged.lin;
            at.motion(&(lin.conditions[worst].reading - lin.predicted(worst)))
        });
        let explained = left.map(|left| [missed - left, left]);
        let acts = data.after.as_ref().and_then(|a| EffectMotion::of(&a.judged, worst));
        let moves = body::displacements(at, &missed).map(|d| d.norm());
        let joint = (0..6).fold(0, |most, k| if moves[k] > moves[most] { k } else { most });
        let noise = noise(at, &data.campaign.groups.get(worst)?.sigma, joint);
        Some(Self { bodies: Bodies::at(at), missed, explained, acts, joint, noise, of })
    }

    /// Displacement by a twist of the joint that the first model misses most, m.
    fn of_joint(&self, twist: &Vector6) -> f64 {
        body::displacements(self.bodies.at, twist)[self.joint].norm()
    }

    /// Largest displacement of a joint by a twist, m.
    fn most(&self, twist: &Vector6) -> f64 {
        body::largest(&body::displacements(self.bodies.at, twist))
    }

    fn drawing(&self, data: &Data<'_>, factor: f64) -> Wireframe {
        let moved = |twist: &Vector6| self.bodies.moved(twist, factor);
        let mut drawing =
            Wireframe::new("").seen("", 25.0, 22.0).with("as it stands", None, self.bodies.unloaded());
        drawing = drawing.with_wide(data.words.misses_short(), Some(SPRINGS), moved(&self.missed));
        if let Some([explained, _]) = &self.explained {
            let mut edges = moved(explained);
            edges.extend(self.acts.iter().flat_map(|acts| self.bodies.acted(acts, factor)));
            drawing = drawing.with("the added effects explain", Some(FINAL), edges);
        }
        drawing = self.bodies.numbered(drawing);
        drawing = load::arrows(drawing, self.bodies.at);
        let length = round_length(SCALE * self.most(&self.missed));
        drawing.scale_bar(format!("{} um of motion", significant(length * 1e6, 1)), length * factor)
    }
}

/// Root mean square motion of a joint that noise of the readings gives, m; `sigma` of the averaged readings of a condition.
fn noise(at: &Condition, sigma: &[f64; 6], joint: usize) -> f64 {
    let one = |k: usize| {
        let mut reading = Vector6::zeros();
        reading[k] = sigma[k];
        body::displacements(at, &at.motion(&reading))[joint].norm_squared()
    };
    (0..6).map(one).sum::<f64>().sqrt()
}

/// 1, 2 or 5 times a power of ten, not above a length.
fn round_length(most: f64) -> f64 {
    let power = 10f64.powf(most.log10().floor());
    [5.0, 2.0, 1.0].into_iter().map(|k| k * power).find(|l| *l <= most).unwrap_or(power)
}

/// What both models miss of one joint under this load, then the error of every step beside the noise. What the effects explain is no bar:
/// beside noise in the opposite direction it is longer than what the springs miss.
fn bars(data: &Data<'_>, seen: &Telling<'_>, errors: Option<&ErrorSteps>) -> Rungs {
    let um = |twist: &Vector6| 1e6 * seen.of_joint(twist);
    let bar = |rungs: Rungs, name: &str, twist: &Vector6, look: usize| {
        rungs.bar(name, um(twist), format!("{} um", significant(um(twist), 2)), look)
    };
    let noise = 1e6 * seen.noise;
    let named = format!("noise of this joint {} um", significant(noise, 2));
    let rungs = Rungs::default().group("This load, the joint that moves most").line(named, noise, 0.0);
    let mut rungs = bar(rungs, data.words.misses_short(), &seen.missed, SPRINGS);
    if let Some([_, left]) = &seen.explained {
        rungs = bar(rungs, "left with the added effects", left, FINAL);
    }
    match errors {
        Some(errors) => errors.drawn(rungs),
        None => rungs,
    }
}

fn caption(data: &Data<'_>, seen: &Telling<'_>, factor: f64) -> String {
    let at = seen.bodies.at;
    let acts = seen.acts.as_ref().map(|acts| acted(acts, at)).unwrap_or_default();
    let which = match data.after {
        Some(_) => "The load at which the added effects explain most".to_owned(),
        None => format!("The load, of {}, that {} most", seen.of, data.words.misses),
    };
    format!(
        "{}: force change ({}) N, moment change ({}) N m{}. Motions are enlarged {} times.{acts}",
        which,
        load::list(&(at.wrench.force - at.reference.force)),
        load::list(&(at.wrench.moment - at.reference.moment)),
        circumstances(data, at),
        significant(factor, 2)
    )
}

/// Temperature and time of a condition, for added effects that depend on them: `; 2.1 K warmer than at the reference`.
fn circumstances(data: &Data<'_>, at: &Condition) -> String {
    let active = data.after.iter().flat_map(|after| &after.point.active);
    let needs: Vec<Need> = active.flat_map(|a| a.term.info().needs).copied().collect();
    let if_needed = |need: Need, value: f64| if needs.contains(&need) { value } else { 0.0 };
    let surroundings =
        next::circumstances(if_needed(Need::Elapsed, at.elapsed), if_needed(Need::DeltaT, at.delta_t));
    std::iter::once(String::new()).chain(surroundings).collect::<Vec<_>>().join("; ")
}

/// What the added effects do to base and legs, in words.
fn acted(acts: &EffectMotion, at: &Condition) -> String {
    let base = 1e6 * body::largest(&acts.base);
    let (leg, longest) =
        acts.elongation.iter().enumerate().fold((0, 0.0_f64), |(leg, most), (k, e)| {
            if e.abs() > most.abs() { (k, *e) } else { (leg, most) }
        });
    let longest = longest * 1e6;
    let base = (base > bodies::LEAST_UM).then(|| {
        format!(" With the added effects the base joints move by up to {} um.", significant(base, 2))
    });
    let legs = (longest.abs() > bodies::LEAST_UM).then(|| {
        let how = if longest > 0.0 { "longer" } else { "shorter" };
        format!(
            " The added effects make leg {} {how} by {} um (force change {} N), more than any other; legs that they change by a third of that or \
             more are blue.",
            leg + 1,
            significant(longest.abs(), 2),
            significant(at.force_change()[leg], 2)
        )
    });
    [base, legs].into_iter().flatten().collect()
}
