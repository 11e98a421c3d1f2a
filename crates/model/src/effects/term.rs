//! What a term is: a named physical effect with parameters, and where each of them acts.

use std::sync::Arc;

use hexbench_core::Vector6;

use crate::effects::chain::Action;
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

/// A physical effect the model can be given.
pub trait Term: Send + Sync {
    /// Name, physics, parameters, needs.
    fn info(&self) -> &TermInfo;

    /// One action per parameter at this condition, pushed to `out` in the order of the parameters.
    fn actions(&self, machine: &Machine, at: &Condition, shape: f64, out: &mut Vec<Action>);

    /// Elongations of each leg by the two parameters that it has for itself, where the term is a wave in every leg and nothing else: leg 1
    /// sine, leg 1 cosine, leg 2 sine and so on, of an angle in inverse proportion to the shape. A scan over periods asks for these alone.
    fn waves(&self, _at: &Condition, _shape: f64) -> Option<[Vector6; 2]> {
        None
    }

    /// For a term that is dear to ask: the same term, but it notes what it has no answer to yet, and gives no numbers there.
    fn noting(&self) -> Option<Arc<dyn Term>> {
        None
    }

    /// Finds all that was noted, for the term it was made from too; true when there was something.
    fn answer(&self) -> bool {
        false
    }

    /// Actions of the parameters of the richer form beyond the ideal one. Leg by leg unless the term says otherwise:
    /// each leg may deviate from the common size.
    fn rich_actions(&self, machine: &Machine, at: &Condition, shape: f64, out: &mut Vec<Action>) {
        if self.info().rich == Rich::PerLeg {
            let mut common = Vec::with_capacity(1);
            self.actions(machine, at, shape, &mut common);
            out.extend(common.iter().flat_map(|a| (0..6).filter_map(|leg| a.of_leg(leg))));
        }
    }

    /// What all parameters do together at these values (SI), ideal ones first, where that is one action; else none: the sum of
    /// what each of them does.
    fn together(&self, _machine: &Machine, _at: &Condition, _values: &[f64]) -> Option<Action> {
        None
    }

    /// Change the machine or its load by the parameter values (SI) when the term can do so exactly; such a term is part
    /// of the machine at the point of linearization, and other terms see what it does.
    fn calibrate(&self, _values: &[f64], _machine: &mut Machine) {}

    /// True when [`Term::calibrate`] does something.
    fn calibrates(&self) -> bool {
        false
    }

    /// True when the shape is the value of the first parameter: the fit makes the two agree.
    fn shape_is_parameter(&self) -> bool {
        false
    }

    /// Shape values a fit may reach from a start value.
    fn shape_bounds(&self, _start: f64) -> [f64; 2] {
        self.info().shape.map_or([0.0, f64::INFINITY], |s| s.bounds)
    }

    /// What makes the term impossible to compute at this condition, in words; `None` when nothing does.
    fn fault(&self, _machine: &Machine, _at: &Condition) -> Option<String> {
        None
    }

    /// Logarithm of its prior odds against an effect of the catalogue.
    fn log_prior(&self) -> f64 {
        0.0
    }

    /// The text that defines the term when it is not part of the catalogue.
    fn definition(&self) -> Option<&str> {
        None
    }

    /// True when the effect is in the measurement and not in the machine: no command can correct it.
    fn is_of_metrology(&self) -> bool {
        false
    }

    /// True when absolute poses estimate the effect as a part of their target frame.
    fn is_part_of_target_frame(&self) -> bool {
        false
    }

    /// True when the second parameter is a part of the first: both are positive, and it is not the larger one.
    fn second_is_part_of_first(&self) -> bool {
        false
    }

    /// The word for this version of the effect, kebab-case; none for the usual one.
    fn version(&self) -> Option<&'static str> {
        None
    }

    /// Other versions of the effect, which compete under its id, with their prior shares of it: another law, one more parameter.
    /// They say nothing about conditions for which they have no shapes. One of fewer numbers is a special case of the usual version: it
    /// has some of its parameters.
    fn versions(&self) -> Vec<(f64, Arc<dyn Term>)> {
        Vec::new()
    }

    /// Natural sizes of its parameters at a shape, SI: those of their scales, unless the shape says how large a parameter means what.
    fn natural_sizes(&self, natural: &Natural, _shape: f64) -> Vec<f64> {
        self.info().parameters.iter().map(|p| natural.size(p.scale)).collect()
    }

    /// Grid of shape values worth trying for these conditions; empty when the term has no shape.
    fn shape_grid(&self, _conditions: &[Condition]) -> Vec<f64> {
        Vec::new()
    }
}

/// A term in its usual version and in the others, with their prior shares of it.
pub(crate) fn all_versions(term: &Arc<dyn Term>) -> Vec<(f64, Arc<dyn Term>)> {
    let others = term.versions();
    let own = 1.0 - others.iter().map(|(share, _)| share).sum::<f64>();
    std::iter::once((own, Arc::clone(term))).chain(others).collect()
}

/// The version of a term with this word.
pub fn version_named(term: &Arc<dyn Term>, word: &str) -> Option<Arc<dyn Term>> {
    term.versions().into_iter().map(|(_, version)| version).find(|v| v.version() == Some(word))
}

/// Name, physics, parameters and needs of a term.
#[derive(Debug, Clone, Copy)]
pub struct TermInfo {
    /// Kebab-case id.
    pub id: &'static str,
    /// A few words.
    pub title: &'static str,
    /// Part of the machine or of the measurement it belongs to.
    pub chapter: Chapter,
    /// What happens physically, one or two sentences.
    pub physics: &'static str,
    /// First-order equation.
    pub equation: &'static str,
    /// Where the physics is described.
    pub source: &'static str,
    /// What the data must contain for it to show.
    pub shows: &'static str,
    /// What to vary in the next measurement to see it alone, in words.
    pub how_to_isolate: &'static str,
    /// Parameters of the ideal form.
    pub parameters: &'static [ParameterInfo],
    /// Shape parameter, when there is one.
    pub shape: Option<Shape>,
    /// Columns it cannot do without.
    pub needs: &'static [Need],
    /// The richer form.
    pub rich: Rich,
}

/// Part of the machine or of the measurement an effect belongs to, in the order in which a bench is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Chapter {
    /// Foundation and platform.
    Structure,
    /// What lies between the two joints of a leg.
    Legs,
    /// Joints and what carries them.
    Joints,
    /// What hangs on the platform.
    Load,
    /// The instrument and its targets.
    Metrology,
    /// What shows in absolute poses only.
    AbsolutePoses,
    /// Terms from files of the user.
    Own,
}

impl Chapter {
    /// A word or two for people.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Structure => "Structure",
            Self::Legs => "Legs",
            Self::Joints => "Joints and brackets",
            Self::Load => "Load",
            Self::Metrology => "Metrology",
            Self::AbsolutePoses => "Absolute poses",
            Self::Own => "Your own formulas",
        }
    }
}

/// One linear parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterInfo {
    /// Name below the term's id, kebab-case.
    pub name: &'static str,
    /// Unit shown to people.
    pub unit: &'static str,
    /// Shown value = SI value * `per_si`.
    pub per_si: f64,
    /// Physically sensible size: prior widths span from a thousandth of it to twice it.
    pub scale: Scale,
    /// True when a negative value has no physical meaning.
    pub positive: bool,
    /// What to check when the value is clearly negative, where that is possible but rare.
    pub if_negative: Option<&'static str>,
}

impl ParameterInfo {
    /// A parameter of the catalogue.
    pub const fn new(
        name: &'static str,
        unit: &'static str,
        per_si: f64,
        scale: Scale,
        positive: bool,
    ) -> Self {
        Self { name, unit, per_si, scale, positive, if_negative: None }
    }

    /// The same with what to check when the value is clearly negative.
    #[must_use]
    pub const fn if_negative(self, check: &'static str) -> Self {
        Self { if_negative: Some(check), ..self }
    }
}

/// Names of leg-wise parameters.
pub(crate) const LEGS: [&str; 6] = ["leg-1", "leg-2", "leg-3", "leg-4", "leg-5", "leg-6"];

/// Parameters that differ in their names only.
pub(crate) const fn each<const N: usize>(
    names: &[&'static str; N],
    unit: &'static str,
    per_si: f64,
    scale: Scale,
    positive: bool,
) -> [ParameterInfo; N] {
    let mut all = [ParameterInfo::new(names[0], unit, per_si, scale, positive); N];
    let mut i = 1;
    while i < N {
        all[i].name = names[i];
        i += 1;
    }
    all
}

/// A shape parameter such as an exponent, a period or a time constant: profiled, not linear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// Name below the term's id.
    pub name: &'static str,
    /// Unit shown to people.
    pub unit: &'static str,
    /// Shown value = SI value * `per_si`.
    pub per_si: f64,
    /// Smallest and largest value, SI.
    pub bounds: [f64; 2],
}

/// Length up to which a leg weighs no more than usual, m.
const SHORT_LEG: f64 = 0.5;

/// Natural size of a parameter, resolved by [`Natural`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// A fixed SI value.
    Fixed(f64),
    /// Compliance of a typical leg, m/N.
    Compliance,
    /// The same, seen as rotation: compliance / platform radius^2, rad/(N m).
    AngularCompliance,
    /// Off-diagonal compliance: compliance / platform radius, rad/N.
    MixedCompliance,
    /// Compliance per leg extension: compliance / leg length, 1/N.
    CompliancePerLength,
    /// Rotational stiffness: leg stiffness * platform radius^2, N m/rad.
    AngularStiffness,
    /// Elongation of a typical leg under the typical load, m.
    Elongation,
    /// Typical leg force change, N.
    Force,
    /// So many newtons for a leg of up to half a meter; beyond, the weight grows with the square of the length, as at one stiffness.
    Weight(f64),
    /// Platform radius, m.
    Radius,
    /// This many meters (or radians) within the longest elapsed time, per second.
    PerElapsed(f64),
}

/// Typical sizes of a machine and campaign, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Natural {
    /// Compliance of a leg, m/N.
    pub compliance: f64,
    /// Leg force change, N.
    pub force: f64,
    /// Platform radius, m.
    pub radius: f64,
    /// Leg length, m.
    pub length: f64,
    /// Longest elapsed time, s.
    pub elapsed: f64,
}

impl Natural {
    /// Resolve a scale to an SI value.
    pub fn size(&self, scale: Scale) -> f64 {
        match scale {
            Scale::Fixed(value) => value,
            Scale::Compliance => self.compliance,
            Scale::AngularCompliance => self.compliance / self.radius.powi(2),
            Scale::MixedCompliance => self.compliance / self.radius,
            Scale::CompliancePerLength => self.compliance / self.length,
            Scale::AngularStiffness => self.radius.powi(2) / self.compliance,
            Scale::Elongation => self.compliance * self.force,
            Scale::Force => self.force,
            Scale::Weight(of_short_leg) => of_short_leg * (self.length / SHORT_LEG).max(1.0).powi(2),
            Scale::Radius => self.radius,
            Scale::PerElapsed(total) => total / self.elapsed.max(1.0),
        }
    }
}

/// A column or mode a term cannot do without.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Need {
    /// Absolute poses.
    Absolute,
    /// `approach`.
    Approach,
    /// `delta_T_K` that is not all zero.
    DeltaT,
    /// `elapsed_s` that is not all zero.
    Elapsed,
    /// Pairs of legs that share a bracket.
    Brackets,
    /// Two load states at the same pose (absolute mode).
    Loads,
}

/// What the richer form of a term allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rich {
    /// There is none.
    None,
    /// The size may differ from leg to leg.
    PerLeg,
    /// A full symmetric 6x6 compliance instead of six springs.
    Full,
}
