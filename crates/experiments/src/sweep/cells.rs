//! The full factorial of the axes; those that are ranges move together, from point to point.

use hexbench_truth::laboratory::{self, CAREFUL, FaultEntry};

use crate::keys::HiddenEffect;
use crate::sweep::axes::{Axes, Geometry, Noises, PlanChoice, SweepEstimator};

/// A value of an axis, as people read it.
#[derive(Debug, Clone, PartialEq)]
pub enum AxisLevel {
    /// A number.
    Number(f64),
    /// A name.
    Word(String),
}

impl AxisLevel {
    /// As printed.
    pub fn text(&self) -> String {
        match self {
            Self::Number(x) => format!("{x}"),
            Self::Word(word) => word.clone(),
        }
    }
}

/// An axis with its values, as people read it.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisLevels {
    /// Name, as the key of the study file.
    pub name: &'static str,
    /// Values in the order of the study file; one for an axis that is left out.
    pub levels: Vec<AxisLevel>,
    /// True when the study file gives it.
    pub given: bool,
}

impl AxisLevels {
    /// True when it has more than one value.
    pub fn varies(&self) -> bool {
        self.levels.len() > 1
    }

    /// Its values as numbers, when they all are.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        let number = |level: &AxisLevel| match level {
            AxisLevel::Number(x) => Some(*x),
            AxisLevel::Word(_) => None,
        };
        self.levels.iter().map(number).collect()
    }
}

/// Name of the axis of tolerances.
pub(crate) const TOLERANCE_SCALE: &str = "tolerance_scale";

/// Number of axes.
pub const AXES: usize = 10;

/// Places of axes of numbers in the order of [`Axes`].
pub(crate) mod place {
    /// Poses of a plan.
    pub(crate) const POSES: usize = 2;
    /// Readings of a condition.
    pub(crate) const REPEATS: usize = 3;
    /// Size of the effects.
    pub(crate) const SIZE: usize = 6;
    /// Noise of the instrument.
    pub(crate) const NOISE: usize = 7;
    /// How far inputs are off.
    pub(crate) const TOLERANCE: usize = 9;
}

/// Position of a cell on every axis, in the order of [`Axes`]; the last changes fastest.
pub type Position = [usize; AXES];

/// One combination of values.
#[derive(Debug, Clone, Copy)]
pub struct GridCell<'a> {
    /// Number, from 0.
    pub index: usize,
    /// Position on every axis.
    pub position: Position,
    /// All axes.
    pub axes: &'a Axes,
}

impl<G, P> Axes<G, P> {
    /// Values on every axis, one where the study leaves it open.
    pub(super) fn counts(&self) -> [usize; AXES] {
        let open = |n: usize| n.max(1);
        [
            self.geometry.len(),
            self.plan.len(),
            open(self.poses.len()),
            open(self.repeats.len()),
            open(self.estimator.len()),
            self.effect.len(),
            open(self.size.values().len()),
            self.noise.len(),
            open(self.laboratory.len()),
            open(self.tolerance.len()),
        ]
    }

    /// True for an axis whose values are those of points.
    pub fn is_ranged(&self, axis: usize) -> bool {
        self.points.as_ref().is_some_and(|(_, ranged)| ranged.contains(&axis))
    }

    /// Values that are combined with all others: the first of the ranges stands for the points.
    pub(super) fn combined(&self) -> [usize; AXES] {
        let mut counts = self.counts();
        let others = self.points.iter().flat_map(|(_, ranged)| ranged.iter().skip(1));
        for &axis in others {
            counts[axis] = 1;
        }
        counts
    }
}

impl Axes {
    /// Number of cells; the reader has made sure that there are not too many.
    pub fn cells(&self) -> usize {
        self.combined().iter().product()
    }

    /// The cell of a number.
    pub fn cell(&self, index: usize) -> GridCell<'_> {
        let mut rest = index;
        let mut position = [0; AXES];
        for (place, count) in position.iter_mut().zip(self.combined()).rev() {
            *place = rest % count;
            rest /= count;
        }
        if let Some((_, ranged)) = &self.points {
            for &axis in ranged {
                position[axis] = position[ranged[0]];
            }
        }
        GridCell { index, position, axes: self }
    }

    /// Every axis as people read it, in the order of a [`Position`].
    pub fn levels(&self) -> [AxisLevels; AXES] {
        let words = |names: Vec<String>| names.into_iter().map(AxisLevel::Word).collect::<Vec<_>>();
        let whole =
            |numbers: &[u64]| numbers.iter().map(|&n| AxisLevel::Number(n as f64)).collect::<Vec<_>>();
        let axis = |name, levels: Vec<AxisLevel>, usual: &str| AxisLevels {
            name,
            given: !levels.is_empty(),
            levels: if levels.is_empty() { vec![AxisLevel::Word(usual.to_owned())] } else { levels },
        };
        [
            axis("geometry", words(self.geometry.iter().map(|g| g.name.clone()).collect()), ""),
            axis("plan", words(self.plan.iter().map(|p| p.name.clone()).collect()), ""),
            axis("poses", whole(&self.poses), "of the plan"),
            axis("repeats", whole(&self.repeats), "of the plan"),
            axis("estimator", words(self.estimator.iter().map(|e| e.name().to_owned()).collect()), "gls"),
            axis("effect", words(self.effect_names()), "none"),
            axis(
                self.size.name(),
                self.size.values().iter().map(|&x| AxisLevel::Number(x)).collect(),
                "usual",
            ),
            axis(self.noise.name(), self.noise.levels(), ""),
            axis("laboratory", words(self.laboratory.iter().map(|&id| id.to_owned()).collect()), CAREFUL.id),
            axis(
                TOLERANCE_SCALE,
                self.tolerance.iter().map(|&x| AxisLevel::Number(x)).collect(),
                "inputs exact",
            ),
        ]
    }
}

impl Noises {
    /// Name of the axis.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Scales(_) => "noise_scale",
            Self::Sigmas(_) => "noise_um_urad",
        }
    }

    fn levels(&self) -> Vec<AxisLevel> {
        match self {
            Self::Scales(scales) => scales.iter().map(|&x| AxisLevel::Number(x)).collect(),
            // Products with 1e6 leave digits behind the ones that were written.
            Self::Sigmas(pairs) => {
                let shown = |x: f64| (x * 1e15).round() * 1e-9;
                pairs
                    .iter()
                    .map(|[t, r]| AxisLevel::Word(format!("{} um {} urad", shown(*t), shown(*r))))
                    .collect()
            }
        }
    }
}

impl<'a> GridCell<'a> {
    /// The machine.
    pub fn geometry(&self) -> &'a Geometry {
        &self.axes.geometry[self.position[0]]
    }

    /// The plan.
    pub fn plan(&self) -> &'a PlanChoice {
        &self.axes.plan[self.position[1]]
    }

    /// Number of poses, unless the plan has its own.
    pub fn poses(&self) -> Option<u64> {
        self.axes.poses.get(self.position[2]).copied()
    }

    /// Readings of each condition, unless the plan has its own.
    pub fn repeats(&self) -> Option<u64> {
        self.axes.repeats.get(self.position[3]).copied()
    }

    /// The estimator.
    pub fn estimator(&self) -> SweepEstimator {
        self.axes.estimator.get(self.position[4]).copied().unwrap_or(SweepEstimator::Gls)
    }

    /// The hidden effects.
    pub fn effects(&self) -> &'a [HiddenEffect] {
        let nothing = self.size().is_some_and(|size| size <= 0.0);
        if nothing { &[] } else { &self.axes.effect[self.position[5]] }
    }

    /// Its size, in what the axis counts.
    pub fn size(&self) -> Option<f64> {
        self.axes.size.values().get(self.position[6]).copied()
    }

    /// What the laboratory does to the data.
    pub fn laboratory(&self) -> &'static FaultEntry {
        self.axes.laboratory.get(self.position[8]).and_then(|id| laboratory::entry(id)).unwrap_or(&CAREFUL)
    }

    /// How far inputs are off, as a multiple of the stated tolerances; none where they are exact.
    pub fn tolerance(&self) -> Option<f64> {
        self.axes.tolerance.get(self.position[place::TOLERANCE]).copied()
    }

    /// By how much the noise of sensors is scaled.
    pub fn noise_scale(&self) -> f64 {
        self.axes.noise.at(self.position[7]).scale()
    }

    /// Standard deviations of a translation (um) and a rotation (urad); not a number where sensors read.
    pub fn sigmas_um_urad(&self) -> [f64; 2] {
        let noise = self.noise();
        let of_pose = |sigma: f64| if self.geometry().has_sensors() { f64::NAN } else { sigma * 1e6 };
        [noise.sigma_translation, noise.sigma_rotation].map(of_pose)
    }

    /// Standard deviations of a translation (m) and a rotation (rad) of a full pose.
    pub fn sigmas(&self) -> [f64; 2] {
        let noise = self.noise();
        [noise.sigma_translation, noise.sigma_rotation]
    }

    /// Noise of the instrument where it reads full poses.
    pub fn noise(&self) -> hexbench_truth::metrology::InstrumentNoise {
        self.axes.noise.noise(self.position[7], self.geometry())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::axes::{Drawings, PlanSource, Sizes};
    use crate::sweep::points::{PointDesign, PointKind};

    fn axes() -> Axes {
        Axes {
            geometry: vec![Geometry {
                name: "ring_a".into(),
                source: Drawings::Family("ring_a"),
                space: None,
            }],
            plan: vec![PlanChoice { name: "random".into(), source: PlanSource::Random }],
            poses: vec![3, 6, 9],
            repeats: Vec::new(),
            estimator: Vec::new(),
            effect: vec![vec![HiddenEffect::usual("creep")]],
            size: Sizes::Sigmas(vec![0.0, 5.0]),
            noise: Noises::Scales(vec![1.0, 2.0]),
            laboratory: Vec::new(),
            tolerance: Vec::new(),
            points: None,
        }
    }

    #[test]
    fn every_combination_has_one_cell_and_the_last_axis_changes_fastest() {
        let axes = axes();
        let all: Vec<Position> = (0..axes.cells()).map(|i| axes.cell(i).position).collect();
        assert_eq!(all.len(), 12);
        assert!(all.windows(2).all(|pair| pair[0] < pair[1]), "{all:?}");
        assert_eq!(axes.cell(1).position, [0, 0, 0, 0, 0, 0, 0, 1, 0, 0]);
    }

    #[test]
    fn axes_that_are_ranges_move_together_and_meet_every_value_of_the_others() {
        let design = PointDesign { kind: PointKind::Sobol, points: 3, seed: 1 };
        let noise = Noises::Scales(vec![1.0, 2.0, 3.0]);
        let axes = Axes { noise, points: Some((design, vec![2, 7])), ..axes() };
        let all: Vec<Position> = (0..axes.cells()).map(|i| axes.cell(i).position).collect();
        assert_eq!(all.len(), 3 * 2);
        assert!(all.iter().all(|position| position[2] == position[7]), "{all:?}");
        assert_eq!([all[0], all[1], all[2]].map(|p| [p[2], p[6]]), [[0, 0], [0, 1], [1, 0]]);
    }

    #[test]
    fn an_effect_of_size_zero_is_none() {
        let axes = axes();
        assert!(axes.cell(0).effects().is_empty());
        assert_eq!(axes.cell(2).effects(), [HiddenEffect::usual("creep")]);
    }
}
