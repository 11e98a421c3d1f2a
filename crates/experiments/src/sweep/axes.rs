//! What a study varies.

use hexbench_core::Hexapod;
use hexbench_design::{Criterion, Space};
use hexbench_truth::campaign::{PlanKind, PlanRow};
use hexbench_truth::metrology::InstrumentNoise;

use crate::keys::{EffectSet, ReadingNoise, set_name};
use crate::sized::SizeUnit;
use crate::sweep::points::PointDesign;

/// Where the machine comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// Name in the study file.
    pub name: String,
    /// Family, or drawings from a file.
    pub source: Drawings,
    /// Where poses may lie, and under which loads; none: as suits the machine.
    pub space: Option<Space>,
}

/// Drawings of a machine.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawings {
    /// A family of `hexbench_truth::campaign::machines`.
    Family(&'static str),
    /// A hexapod file.
    File(Box<Hexapod>),
}

impl Geometry {
    /// True when the sensors of its file read it, instead of full poses.
    pub fn has_sensors(&self) -> bool {
        matches!(&self.source, Drawings::File(hexapod) if !hexapod.sensors.is_empty())
    }

    /// True when every block has the same drawings.
    pub fn is_fixed(&self) -> bool {
        match &self.source {
            Drawings::Family(name) => name.starts_with("ring_"),
            Drawings::File(_) => true,
        }
    }
}

/// Which readings are taken.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanChoice {
    /// Name in the study file.
    pub name: String,
    /// How its rows come about.
    pub source: PlanSource,
}

/// How the rows of a plan come about.
#[derive(Debug, Clone, PartialEq)]
pub enum PlanSource {
    /// A make of `hexbench_truth::campaign`.
    Make(PlanKind),
    /// Poses that are best by a criterion.
    Designed(Criterion),
    /// Poses drawn evenly from the space.
    Random,
    /// Rows of a table or scene.
    Rows(Vec<PlanRow>),
}

impl PlanSource {
    /// True when the study says how many poses there are.
    pub fn needs_poses(&self) -> bool {
        matches!(self, Self::Designed(_) | Self::Random)
    }

    /// True when the study may say so.
    pub fn takes_poses(&self) -> bool {
        match self {
            Self::Make(kind) => *kind != PlanKind::Paper,
            Self::Rows(_) => false,
            Self::Designed(_) | Self::Random => true,
        }
    }
}

/// How leg stiffness is estimated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SweepEstimator {
    /// Generalised least squares, rows weighted by the noise.
    Gls,
    /// The paper's: unweighted, at the commanded pose.
    Paper,
}

hexbench_core::worded! {
    /// Name in the study file.
    SweepEstimator::name {
        Gls => "gls",
        Paper => "paper",
    }
}

/// How large the effect is.
#[derive(Debug, Clone, PartialEq)]
pub enum Sizes {
    /// Its usual size.
    Usual,
    /// Distances in standard deviations beyond what six springs explain; zero: no effect.
    Sigmas(Vec<f64>),
    /// Factors of its usual size; zero: no effect.
    Factors(Vec<f64>),
    /// Sizes in a unit of the catalogue; zero: no effect.
    Physical(SizeUnit, Vec<f64>),
}

impl Sizes {
    /// The values; none when the study leaves them open.
    pub fn values(&self) -> &[f64] {
        match self {
            Self::Usual => &[],
            Self::Sigmas(values) | Self::Factors(values) | Self::Physical(_, values) => values,
        }
    }

    /// Name of the axis.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Sigmas(_) => "size_sigmas",
            Self::Usual | Self::Factors(_) => "size_factor",
            Self::Physical(unit, _) => unit.key,
        }
    }
}

/// How noisy the instrument is.
#[derive(Debug, Clone, PartialEq)]
pub enum Noises {
    /// Multiples of what the hexapod file states, of its sensors where it has some, else of 0.5 um and 3 urad.
    Scales(Vec<f64>),
    /// Standard deviations of one reading: translation (m), rotation (rad).
    Sigmas(Vec<[f64; 2]>),
}

impl Noises {
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::Scales(values) => values.len(),
            Self::Sigmas(values) => values.len(),
        }
    }

    /// True without values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A value.
    pub fn at(&self, index: usize) -> ReadingNoise {
        match self {
            Self::Scales(scales) => ReadingNoise::Scale(scales[index]),
            Self::Sigmas(pairs) => ReadingNoise::Sigmas(pairs[index]),
        }
    }

    /// The noise of a value on a machine that states some, or none.
    pub fn noise(&self, index: usize, geometry: &Geometry) -> InstrumentNoise {
        let stated = match &geometry.source {
            Drawings::File(hexapod) => hexapod.metrology,
            Drawings::Family(_) => None,
        };
        self.at(index).of(InstrumentNoise::stated_or_usual(stated))
    }
}

/// All axes; machines and plans are names until the files they stand for are read.
#[derive(Debug, Clone, PartialEq)]
pub struct Axes<G = Geometry, P = PlanChoice> {
    /// Machines.
    pub geometry: Vec<G>,
    /// Plans.
    pub plan: Vec<P>,
    /// Numbers of poses; empty: as the plan has them.
    pub poses: Vec<u64>,
    /// Readings of each condition; empty: as the plan has them.
    pub repeats: Vec<u64>,
    /// Estimators; empty where the task has its own.
    pub estimator: Vec<SweepEstimator>,
    /// Sets of hidden effects; an empty one: nothing hidden.
    pub effect: Vec<EffectSet>,
    /// Sizes of the effects.
    pub size: Sizes,
    /// Noise of the instrument.
    pub noise: Noises,
    /// Ids of what laboratories do to the data; empty: nothing.
    pub laboratory: Vec<&'static str>,
    /// Multiples of the tolerances that the hexapod file states, within which inputs are off; empty: inputs are exact.
    pub tolerance: Vec<f64>,
    /// Points over the axes that are ranges: these axes have a value for each point, by the place of each in the order here.
    pub points: Option<(PointDesign, Vec<usize>)>,
}

impl<G, P> Axes<G, P> {
    /// Names of the sets of effects, each another: laws of one's own are numbered.
    pub fn effect_names(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::with_capacity(self.effect.len());
        for set in &self.effect {
            let name = set_name(set);
            let others = (2..).map(|number| format!("{name} ({number})"));
            let free = std::iter::once(name.clone()).chain(others).find(|name| !names.contains(name));
            names.push(free.unwrap_or(name));
        }
        names
    }
}
