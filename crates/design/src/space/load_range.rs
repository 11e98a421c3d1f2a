//! Loads whose parts are chosen between bounds, as poses are.

use hexbench_core::{Vector6, Wrench};
use sobol_burley::sample;

use super::{Loading, Setting, Space};
use crate::Visit;

/// Rounded amounts are this share of their range apart, or finer: a power of ten in the unit of the part.
const STEP_OF_RANGE: f64 = 1e-3;
/// Up to so many parts, all corners of their ranges are tried; of more, the ends of each with the others in the middle.
const MOST_FOR_CORNERS: usize = 4;
/// Coordinates of a pose in the sequence that loads continue.
const POSE_DIMENSIONS: u32 = 6;

/// A part of a load that is chosen: `amount` times a wrench.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChosenPart {
    /// What it is called: `mass`, `pull`, `fx` ... `mz`.
    pub name: &'static str,
    /// Unit of the amount: kg, N or Nm.
    pub unit: &'static str,
    /// Wrench of one unit, N and N m, fixed axes, at the mobile origin.
    pub direction: Vector6,
    /// Least and largest amount.
    pub bounds: [f64; 2],
}

impl ChosenPart {
    fn at(&self, share: f64) -> f64 {
        let [low, high] = self.bounds;
        low + share.clamp(0.0, 1.0) * (high - low)
    }

    /// The nearest of the round amounts within the bounds and of the bounds themselves.
    fn rounded(&self, amount: f64) -> f64 {
        let [low, high] = self.bounds;
        // Divided by a power of ten, not multiplied: 345 / 10 is the number nearest to 34.5.
        let digits = -((high - low) * STEP_OF_RANGE).log10().floor();
        let per_unit = 10.0_f64.powf(digits.abs());
        let round = if digits >= 0.0 {
            (amount * per_unit).round() / per_unit
        } else {
            (amount / per_unit).round() * per_unit
        };
        let inside = Some(round).filter(|x| (low..=high).contains(x));
        let far = |x: &f64| (x - amount).abs();
        inside.into_iter().chain([low, high]).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(amount)
    }
}

/// A load of a [`Space`] that is chosen: the sum of a fixed wrench and of its parts, whose directions are at right angles.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadRange {
    /// Its place in [`Space::loads`], which holds the wrench that is chosen.
    pub load: usize,
    /// What is not chosen of it.
    pub fixed: Wrench,
    /// What is.
    pub parts: Vec<ChosenPart>,
}

impl LoadRange {
    /// The load of amounts, one for each part.
    pub fn wrench(&self, amounts: impl IntoIterator<Item = f64>) -> Wrench {
        let parts = self.parts.iter().zip(amounts).map(|(part, amount)| part.direction * amount);
        Wrench::from_array((self.fixed.to_vector() + parts.sum::<Vector6>()).into())
    }

    /// Amounts of the parts in a load.
    pub fn amounts(&self, load: &Wrench) -> Vec<f64> {
        let chosen = load.to_vector() - self.fixed.to_vector();
        let amount = |part: &ChosenPart| chosen.dot(&part.direction) / part.direction.norm_squared();
        self.parts.iter().map(amount).collect()
    }

    /// The load farthest from a reference, part by part.
    pub fn farthest_from(&self, reference: &Wrench) -> Wrench {
        let there = self.amounts(reference);
        self.wrench(self.parts.iter().zip(there).map(|(part, there)| {
            let [low, high] = part.bounds;
            if there - low > high - there { low } else { high }
        }))
    }

    /// Amounts at which an exchange begins.
    fn corners(&self) -> Vec<Vec<f64>> {
        let n = self.parts.len();
        if n <= MOST_FOR_CORNERS {
            let corner = |ends: usize| {
                self.parts.iter().enumerate().map(|(k, part)| part.bounds[ends >> k & 1]).collect()
            };
            return (0..1 << n).map(corner).collect();
        }
        let middle: Vec<f64> = self.parts.iter().map(|part| part.at(0.5)).collect();
        let end = |(k, end): (usize, usize)| {
            let mut amounts = middle.clone();
            amounts[k] = self.parts[k].bounds[end];
            amounts
        };
        (0..n).flat_map(|k| [(k, 0), (k, 1)]).map(end).collect()
    }
}

impl Space {
    /// Number of parts of loads that are chosen.
    pub fn chosen_parts(&self) -> usize {
        self.load_ranges.iter().map(|range| range.parts.len()).sum()
    }

    /// Loads whose chosen parts are at these shares of their ranges, range by range, each from 0 to 1.
    pub fn loads_at(&self, shares: &[f64]) -> Vec<Loading> {
        let mut rest = shares.iter();
        self.replaced(|range, _| {
            range.wrench(range.parts.iter().zip(&mut rest).map(|(part, share)| part.at(*share)))
        })
    }

    /// Shares of the ranges at which the chosen parts of loads are.
    pub fn load_shares(&self, loads: &[Loading]) -> Vec<f64> {
        let share = |(part, amount): (&ChosenPart, f64)| {
            let [low, high] = part.bounds;
            ((amount - low) / (high - low)).clamp(0.0, 1.0)
        };
        let of = |range: &LoadRange| {
            let amounts = range.amounts(&loads[range.load].load);
            range.parts.iter().zip(amounts).map(share).collect::<Vec<_>>()
        };
        self.load_ranges.iter().flat_map(of).collect()
    }

    /// How each setting's load changes with the share of one part after the other: N and N m over the whole range.
    pub(crate) fn load_directions(&self) -> Vec<Vec<Vector6>> {
        let settings = self.settings().len();
        let each = settings / self.loads.len().max(1);
        let parts = self.load_ranges.iter().flat_map(|range| range.parts.iter().map(|p| (range.load, p)));
        parts
            .map(|(load, part)| {
                let whole = part.direction * (part.bounds[1] - part.bounds[0]);
                (0..settings).map(|s| if s / each == load { whole } else { Vector6::zeros() }).collect()
            })
            .collect()
    }

    /// The loads of the `index`-th start of a search: the dimensions of a scrambled Sobol sequence that follow those of
    /// [`Space::pose`].
    pub fn loads_of_start(&self, index: u32, seed: u32) -> Vec<Loading> {
        let dimensions = (POSE_DIMENSIONS..).take(self.chosen_parts());
        let shares: Vec<f64> = dimensions.map(|d| f64::from(sample(index, d, seed))).collect();
        self.loads_at(&shares)
    }

    /// The same with chosen parts in round amounts within their bounds; an amount at a bound stays there.
    #[must_use]
    pub fn with_rounded_loads(&self) -> Self {
        self.under(self.replaced(|range, chosen| {
            let amounts = range.amounts(&chosen);
            range.wrench(range.parts.iter().zip(amounts).map(|(part, amount)| part.rounded(amount)))
        }))
    }

    /// The same, in which only loads that are read are chosen further.
    #[must_use]
    pub fn choosing_of(&self, visits: &[Visit]) -> Self {
        let each = self.settings().len() / self.loads.len().max(1);
        let read =
            |load: usize| visits.iter().any(|v| v.counts[load * each..][..each].iter().any(|n| *n > 0));
        let load_ranges = self.load_ranges.iter().filter(|range| read(range.load)).cloned().collect();
        Self { load_ranges, ..self.clone() }
    }

    /// The same space under other loads, as many.
    #[must_use]
    pub fn under(&self, loads: Vec<Loading>) -> Self {
        Self { loads, ..self.clone() }
    }

    /// The same with the loads as they are.
    #[must_use]
    pub fn with_loads_fixed(&self) -> Self {
        Self { load_ranges: Vec::new(), ..self.clone() }
    }

    /// The same with every load that is chosen at all corners of its ranges (of more than four, at both ends of each): each is then a load of
    /// its own, that may be chosen further.
    #[must_use]
    pub fn at_corners(&self) -> Self {
        let (mut loads, mut load_ranges) = (Vec::new(), Vec::new());
        for (k, loading) in self.loads.iter().enumerate() {
            let Some(range) = self.load_ranges.iter().find(|range| range.load == k) else {
                loads.push(*loading);
                continue;
            };
            for amounts in range.corners() {
                load_ranges.push(LoadRange { load: loads.len(), ..range.clone() });
                loads.push(Loading { load: range.wrench(amounts), ..*loading });
            }
        }
        Self { loads, load_ranges, ..self.clone() }
    }

    fn replaced(&self, mut load: impl FnMut(&LoadRange, Wrench) -> Wrench) -> Vec<Loading> {
        let mut loads = self.loads.clone();
        for range in &self.load_ranges {
            loads[range.load].load = load(range, loads[range.load].load);
        }
        loads
    }

    /// Every one of some loads under every condition, in the order of [`Space::settings`].
    pub fn settings_of(&self, loads: &[Loading]) -> Vec<Setting> {
        let conditions = &self.conditions;
        let mut settings = Vec::new();
        for &loading in loads {
            for &approach in &conditions.approaches {
                for &delta_t in &conditions.delta_t {
                    let at = |&elapsed: &f64| Setting { loading, approach, delta_t, elapsed };
                    settings.extend(conditions.waits.iter().map(at));
                }
            }
        }
        settings
    }
}

#[cfg(test)]
mod tests;
