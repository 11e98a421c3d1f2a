//! Patterns outside the catalogue: what the residual elongation of one leg, or of all, follows; a stiffness beside the legs; a load that
//! no column states; a frame of the readings that moves.

use std::f64::consts::TAU;

use hexbench_core::words::to_digits;
use hexbench_core::{Matrix6, Vector6, pairs_of_six};

use crate::effects::chain::Action;
use crate::effects::term::Natural;
use crate::estimation::campaign::Condition;

/// What a pattern follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PatternVariable {
    /// Time from the reference to the loaded reading.
    Elapsed,
    /// Temperature difference.
    DeltaT,
    /// Commanded leg length.
    LegLength,
    /// Leg force under the load.
    LegForce,
    /// Angle between the normals of platform and base.
    Tilt,
    /// Height of the mobile origin.
    Height,
    /// Order in which the readings were taken: the line of the file.
    Line,
    /// Side from which the load was reached.
    Approach,
}

impl PatternVariable {
    /// Name as in the files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Elapsed => "elapsed_s",
            Self::DeltaT => "delta_T_K",
            Self::LegLength => "leg_length",
            Self::LegForce => "leg_force",
            Self::Tilt => "tilt",
            Self::Height => "height",
            Self::Line => "line",
            Self::Approach => "approach",
        }
    }

    /// In words, and the unit of its values.
    fn words(self) -> [&'static str; 2] {
        match self {
            Self::Elapsed => ["the elapsed time", "s"],
            Self::DeltaT => ["the temperature difference", "K"],
            Self::LegLength => ["the leg length", "mm"],
            Self::LegForce => ["the leg force", "N"],
            Self::Tilt => ["the tilt of the platform", "deg"],
            Self::Height => ["the height of the platform", "mm"],
            Self::Line => ["the line of the file", ""],
            Self::Approach => ["the approach", ""],
        }
    }

    /// True when it is the same for all legs.
    fn is_common(self) -> bool {
        !matches!(self, Self::LegLength | Self::LegForce)
    }

    /// Value for one leg at a condition, SI.
    pub fn value(self, at: &Condition, leg: usize) -> f64 {
        match self {
            Self::Elapsed => at.elapsed,
            Self::DeltaT => at.delta_t,
            Self::LegLength => at.extension[leg],
            Self::LegForce => at.force[leg],
            Self::Tilt => at.place.tilt(),
            Self::Height => at.place.translation.z,
            Self::Line => at.line as f64,
            Self::Approach => at.approach.sign(),
        }
    }
}

/// How the elongation follows the variable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Course {
    /// In proportion.
    Linear,
    /// With its square.
    Quadratic,
    /// A jump at this value, SI.
    Step(f64),
    /// A wave with this period, SI.
    Periodic(f64),
}

impl Course {
    /// One word for files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Quadratic => "quadratic",
            Self::Step(_) => "step",
            Self::Periodic(_) => "periodic",
        }
    }

    /// At a value of the variable, of which `range` is the spread; the second is used by waves only.
    fn values(self, v: f64, range: f64) -> [f64; 2] {
        match self {
            Self::Linear => [v / range, 0.0],
            Self::Quadratic => [(v / range).powi(2), 0.0],
            Self::Step(at) => [f64::from(v > at), 0.0],
            Self::Periodic(period) => (TAU * v / period).sin_cos().into(),
        }
    }
}

/// An unexplained pattern.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pattern {
    /// In the elongation of legs.
    Leg(LegPattern),
    /// Something beside the legs holds the platform with a stiffness constant in fixed axes: a cable, a hose, bellows. A full
    /// symmetric 6x6 matrix at the mobile origin.
    Beside,
    /// A constant force along these fixed axes, which the file does not state, acts on the loaded platform: a hook or tray that is applied
    /// with every load, the zero of a load cell.
    Load(&'static [usize]),
    /// The length of every leg changes with the force of the leg so many numbers further on.
    OtherLeg(usize),
    /// The length of every leg follows what is the same for all of them, each leg by its own size.
    EveryLeg(PatternVariable, Course),
    /// What the readings are taken from moves along these coordinates, in proportion to the temperature difference.
    WarmFrame(&'static [usize]),
}

/// Stiffness of what holds the platform beside the legs relative to one leg: its natural size.
const BESIDE: f64 = 0.05;
/// Weight of a mass that is not stated relative to the change of the leg forces, such as that of a tray or a hook: its natural size.
const UNSTATED_MASS: f64 = 0.25;
/// The same of a force in any direction: what pulls sideways is less than what hangs, and a larger one looks like loads that tilt.
const UNSTATED_FORCE: f64 = 0.05;

impl Pattern {
    /// Number of columns.
    pub fn width(&self) -> usize {
        match self {
            Self::Leg(p) => p.width(),
            Self::Beside => 21,
            Self::Load(axes) | Self::WarmFrame(axes) => axes.len(),
            Self::OtherLeg(_) => 1,
            Self::EveryLeg(..) => 6,
        }
    }

    /// Actions at a condition; `range` is the spread of the variable of a leg pattern.
    pub fn actions(&self, at: &Condition, range: f64, out: &mut Vec<Action>) {
        match self {
            Self::Leg(p) => p.actions(at, range, out),
            Self::Beside => {
                out.extend(entries().map(|(i, j)| {
                    let mut unit = Matrix6::zeros();
                    unit[(i, j)] = 1.0;
                    unit[(j, i)] = 1.0;
                    Action::Stiffness(Box::new(unit))
                }));
            }
            Self::Load(axes) => out.extend(axes.iter().map(|&k| Action::Wrench(Vector6::ith(k, 1.0)))),
            Self::OtherLeg(further) => {
                let change = at.force_change();
                out.push(Action::Elongation(Vector6::from_fn(|leg, _| change[(leg + further) % 6])));
            }
            Self::EveryLeg(variable, course) => {
                let [size, _] = course.values(variable.value(at, 0), range);
                out.extend((0..6).map(|leg| Action::Elongation(Vector6::ith(leg, size))));
            }
            Self::WarmFrame(axes) => {
                let motion = |&k: &usize| at.as_read(&Vector6::ith(k, at.delta_t / range));
                out.extend(axes.iter().map(|k| Action::Reading(motion(k))));
            }
        }
    }

    /// Natural sizes of its parameters, SI.
    pub fn sizes(&self, natural: &Natural) -> Vec<f64> {
        match self {
            Self::Leg(p) => vec![p.size(natural); p.width()],
            Self::Beside => {
                let arm = |k: usize| if k < 3 { 1.0 } else { natural.radius };
                entries().map(|(i, j)| BESIDE / natural.compliance * arm(i) * arm(j)).collect()
            }
            Self::Load(axes) => {
                let share = if axes.len() == 1 { UNSTATED_MASS } else { UNSTATED_FORCE };
                vec![share * natural.force; axes.len()]
            }
            Self::OtherLeg(_) => vec![natural.compliance],
            Self::EveryLeg(..) => vec![natural.compliance * natural.force; 6],
            Self::WarmFrame(axes) => {
                let elongation = natural.compliance * natural.force;
                axes.iter().map(|&k| if k < 3 { elongation } else { elongation / natural.radius }).collect()
            }
        }
    }

    /// Which parameters cannot be negative.
    pub fn positive(&self) -> Vec<bool> {
        match self {
            Self::Leg(p) => vec![false; p.width()],
            Self::Beside => entries().map(|(i, j)| i == j).collect(),
            Self::Load(_) | Self::OtherLeg(_) | Self::EveryLeg(..) | Self::WarmFrame(_) => {
                vec![false; self.width()]
            }
        }
    }

    /// What it follows, when that is one thing.
    pub fn variable(&self) -> Option<PatternVariable> {
        match self {
            Self::Leg(p) => Some(p.variable),
            Self::OtherLeg(_) => Some(PatternVariable::LegForce),
            Self::EveryLeg(variable, _) => Some(*variable),
            Self::WarmFrame(_) => Some(PatternVariable::DeltaT),
            Self::Beside | Self::Load(_) => None,
        }
    }

    /// Spread of what it follows; zero when the campaign cannot show it.
    pub fn spread(&self, conditions: &[Condition]) -> f64 {
        match self {
            Self::Leg(p) => spread(p.variable, conditions),
            Self::Beside | Self::Load(_) | Self::OtherLeg(_) => 1.0,
            Self::EveryLeg(variable, _) => spread(*variable, conditions),
            Self::WarmFrame(_) => spread(PatternVariable::DeltaT, conditions),
        }
    }

    /// One word for files.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Leg(p) => p.course.word(),
            Self::Beside => "stiffness-beside-the-legs",
            Self::Load(_) => "unstated-load",
            Self::OtherLeg(_) => "other-leg",
            Self::EveryLeg(_, course) => course.word(),
            Self::WarmFrame(_) => "moving-frame",
        }
    }

    /// A sentence for people.
    pub fn text(&self) -> String {
        match self {
            Self::Leg(p) => p.text(),
            Self::Beside => {
                "something in parallel with the legs holds the platform with its own stiffness".to_owned()
            }
            Self::Load(_) => {
                "a constant load that is missing in the file acts on the loaded platform".to_owned()
            }
            Self::OtherLeg(further) => {
                let which = match further {
                    1 => "next leg".to_owned(),
                    5 => "previous leg".to_owned(),
                    _ => format!("leg {further} numbers further on"),
                };
                format!("the length of every leg changes in proportion to the force of the {which}")
            }
            Self::EveryLeg(variable, course) => {
                let square = if *course == Course::Quadratic { "the square of " } else { "" };
                format!(
                    "the length of every leg follows {square}{}, each leg by its own size",
                    variable.words()[0]
                )
            }
            Self::WarmFrame(_) => {
                "what the readings are taken from moves in proportion to the temperature difference"
                    .to_owned()
            }
        }
    }
}

/// Entries of a symmetric 6x6 matrix: the diagonal, then those above it.
fn entries() -> impl Iterator<Item = (usize, usize)> {
    (0..6).map(|k| (k, k)).chain(pairs_of_six())
}

/// Leg elongation = size * course(variable), times the force change when it is a compliance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegPattern {
    /// The leg (from zero), or all six alike.
    pub leg: Option<usize>,
    /// What it follows.
    pub variable: PatternVariable,
    /// How.
    pub course: Course,
    /// True when it is a change of compliance (grows with the load), false when a change of length.
    pub compliance: bool,
}

impl LegPattern {
    /// Number of columns.
    pub fn width(&self) -> usize {
        if matches!(self.course, Course::Periodic(_)) { 2 } else { 1 }
    }

    /// Actions at a condition; `range` is the spread of the variable, so that sizes are elongations or compliances.
    pub fn actions(&self, at: &Condition, range: f64, out: &mut Vec<Action>) {
        out.extend(self.elongations(at, range).into_iter().take(self.width()).map(Action::Elongation));
    }

    /// Leg elongations per unit of each parameter; the second is used by waves only.
    pub fn elongations(&self, at: &Condition, range: f64) -> [Vector6; 2] {
        self.carried(at, self.courses(&self.values(at), range))
    }

    /// What it follows at a condition, for each leg.
    pub(crate) fn values(&self, at: &Condition) -> Vector6 {
        Vector6::from_fn(|leg, _| self.variable.value(at, leg))
    }

    /// How the elongations of the legs follow these values, one course for each parameter.
    pub(crate) fn courses(&self, values: &Vector6, range: f64) -> [Vector6; 2] {
        let mut courses = [Vector6::zeros(); 2];
        let shared = self.variable.is_common().then(|| self.course.values(values[0], range));
        for leg in self.leg.map_or(0..6, |l| l..l + 1) {
            let [first, second] = shared.unwrap_or_else(|| self.course.values(values[leg], range));
            (courses[0][leg], courses[1][leg]) = (first, second);
        }
        courses
    }

    /// Elongations by courses: a compliance carries the change of the force.
    pub(crate) fn carried(&self, at: &Condition, courses: [Vector6; 2]) -> [Vector6; 2] {
        if !self.compliance {
            return courses;
        }
        let force = at.force_change();
        courses.map(|course| course.component_mul(&force))
    }

    /// Natural size of its parameters, SI.
    pub fn size(&self, natural: &Natural) -> f64 {
        if self.compliance { natural.compliance } else { natural.compliance * natural.force }
    }

    /// A sentence for people.
    pub fn text(&self) -> String {
        let who = self.leg.map_or("all legs".to_owned(), |l| format!("leg {}", l + 1));
        let what = if self.compliance { "the compliance" } else { "the length" };
        let [variable, unit] = self.variable.words();
        let how = match self.course {
            Course::Linear => format!("changes in proportion to {variable}"),
            Course::Quadratic => format!("changes with the square of {variable}"),
            Course::Step(at) if self.variable == PatternVariable::LegLength => {
                let than = if at < 0.0 { "shorter" } else { "longer" };
                format!(
                    "jumps where the leg is {} {unit} {than} than at the zero pose",
                    to_digits(self.shown(at.abs()), 3)
                )
            }
            Course::Step(at) if self.variable == PatternVariable::Line => {
                format!("changes at line {} of the file", at.ceil())
            }
            Course::Step(at) => {
                format!("jumps where {variable} is {} {unit}", to_digits(self.shown(at), 3))
            }
            Course::Periodic(p) => format!("repeats with {variable} every {:.3} mm", p * 1e3),
        };
        format!("{what} of {who} {how}")
    }

    /// A value of the variable in the unit of the files.
    pub fn shown(&self, v: f64) -> f64 {
        match self.variable {
            PatternVariable::LegLength | PatternVariable::Height => v * 1e3,
            PatternVariable::Tilt => v.to_degrees(),
            _ => v,
        }
    }
}

/// Spread of a variable over conditions and legs: half its range; zero where it is not finite.
pub fn spread(variable: PatternVariable, conditions: &[Condition]) -> f64 {
    let values = conditions.iter().flat_map(|c| (0..6).map(move |leg| variable.value(c, leg)));
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let half = (high - low) / 2.0;
    if half.is_finite() && half > 0.0 { half } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_have_sizes_of_the_machine() {
        let natural = Natural { compliance: 2e-8, force: 100.0, radius: 0.1, length: 0.5, elapsed: 10.0 };
        let (variable, course) = (PatternVariable::Elapsed, Course::Linear);
        let leg = |compliance| Pattern::Leg(LegPattern { leg: None, variable, course, compliance });
        // A spring of a twentieth of a leg, for a push and for a turn at the radius.
        for (pattern, entry, size) in [
            (leg(true), 0, 2e-8),
            (leg(false), 0, 2e-6),
            (Pattern::Beside, 0, 2.5e6),
            (Pattern::Beside, 3, 2.5e4),
            (Pattern::Load(&[2]), 0, 25.0),
        ] {
            let found = pattern.sizes(&natural)[entry];
            assert!((found / size - 1.0).abs() < 1e-12, "{pattern:?}: {found} {size}");
        }
        assert!(PatternVariable::Elapsed.is_common() && !PatternVariable::LegLength.is_common());
    }
}
