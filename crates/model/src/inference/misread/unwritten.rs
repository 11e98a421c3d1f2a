//! Loads that were applied beside others and not written down: a component that is zero in all rows, where readings tell another.
//!
//! Per condition the component is free beside the springs, five numbers of a pose remaining:
//!
//! ```text
//! y = H P diag(P' (W + w e_k)) c
//! ```
//!
//! At given springs each `w` follows by itself, and at given loads the springs do; so they are found in turn.

use hexbench_core::{Dataset, Hexapod, Observation, Vector6, Wrench};

use super::normal::{Normal, Whitened, non_negative};
use super::refine::typical_force;
use super::sample::Sample;
use crate::inference::examination::{Finding, FindingKind, name_and_range, states_nothing_of};

/// Turns at most.
const MOST_TURNS: usize = 40;
/// Gain of chi-square, relative, below which loads and springs have settled.
const SETTLED: f64 = 1e-3;
/// Spread of the loads found, over the typical load, below which they are none.
const LEAST_SPREAD: f64 = 0.02;
/// Share of the numbers read that has to be left beside the loads found.
const LEFT_SHARE: f64 = 0.5;

/// A component of the loads that no row states, and the error over the noise that springs leave with what the readings tell of it.
pub(crate) struct Unwritten {
    pub(crate) level: f64,
    pub(crate) finding: Finding,
}

/// The component that leaves least, of those that no row states; none where every component is stated.
pub(crate) fn unwritten(hexapod: &Hexapod, data: &Dataset) -> Option<Unwritten> {
    let is_zero = |k: &usize| states_nothing_of(*k, &data.observations);
    let components: Vec<usize> = (0..6).filter(is_zero).collect();
    let sample = if components.is_empty() { None } else { Sample::new(hexapod, data) }?;
    let told = components.into_iter().filter_map(|k| Told::of(&sample, k));
    let least = told.min_by(|a, b| a.level.total_cmp(&b.level))?;
    Some(Unwritten { level: least.level, finding: least.finding() })
}

/// What the readings tell of a component, condition by condition, N or N m.
struct Told {
    component: usize,
    level: f64,
    loads: Vec<f64>,
}

impl Told {
    /// None where too few numbers are left, or no load of any size is found.
    fn of(sample: &Sample, component: usize) -> Option<Self> {
        let rows = &sample.data.observations;
        let numbers = sample.numbers() as f64;
        let freedom = numbers - 6.0 - rows.len() as f64;
        if freedom < LEFT_SHARE * numbers {
            return None;
        }
        let lever = if component < 3 { 1.0 } else { sample.hexapod.platform_radius() };
        let unit = typical_force(sample) * lever;
        let mut loads = vec![0.0; rows.len()];
        let mut here = Left::of(sample, component, &loads, freedom)?;
        for _ in 0..MOST_TURNS {
            let further: Vec<f64> = loads.iter().map(|load| load + unit).collect();
            let there = with_loads(sample, component, &further)?;
            let step = |(row, left): (&Whitened, &Vector6)| {
                let change = left - (row.read - row.columns * here.springs);
                unit * change.dot(left) / change.norm_squared().max(f64::MIN_POSITIVE)
            };
            let steps: Vec<f64> = there.iter().zip(&here.residuals).map(step).collect();
            loads.iter_mut().zip(steps).for_each(|(load, step)| *load += step);
            let before = here.chi2;
            here = Left::of(sample, component, &loads, freedom)?;
            if before - here.chi2 < SETTLED * before {
                break;
            }
        }
        let spread = (loads.iter().map(|x| x * x).sum::<f64>() / rows.len() as f64).sqrt();
        let level = (here.chi2 / freedom).sqrt();
        (spread > LEAST_SPREAD * unit).then_some(Self { component, level, loads })
    }

    fn finding(&self) -> Finding {
        let (name, size) = name_and_range(self.component, self.loads.iter().copied());
        Finding {
            text: format!(
                "{name} is zero in every row of the file, yet the platform moves as under {size} beside the loads that are stated: it was \
                 applied, and not written down"
            ),
            next: format!("write {name} into the file as it was applied"),
            size,
            ..Finding::of(FindingKind::IdleColumn)
        }
    }
}

/// What springs leave of a file with loads of one component, over the noise.
struct Left {
    springs: Vector6,
    residuals: Vec<Vector6>,
    chi2: f64,
}

impl Left {
    fn of(sample: &Sample, component: usize, loads: &[f64], freedom: f64) -> Option<Self> {
        let rows = with_loads(sample, component, loads)?;
        let (springs, chi2, _) = non_negative(&Normal::of(&rows), freedom)?;
        let residuals = rows.into_iter().map(|row| row.read - row.columns * springs).collect();
        Some(Self { springs, residuals, chi2 })
    }
}

/// The equations of a sample with loads of one component.
fn with_loads(sample: &Sample, component: usize, loads: &[f64]) -> Option<Vec<Whitened>> {
    let loaded = |(row, load): (&Observation, &f64)| {
        let mut wrench = row.wrench.to_array();
        wrench[component] += load;
        Observation { wrench: Wrench::from_array(wrench), ..*row }
    };
    let rows: Vec<Observation> = sample.data.observations.iter().zip(loads).map(loaded).collect();
    sample.of_rows(&rows, &sample.data).whitened_rows(&[])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use std::path::Path;

    use hexbench_core::files::{read_hexapod, read_measurements};

    use super::*;

    #[test]
    fn a_component_that_was_applied_beside_others_is_found_with_its_size() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/cases/mujoco-clean");
        let hexapod = read_hexapod(&folder.join("hexapod.toml")).unwrap();
        let mut data = read_measurements(&folder.join("measurements.csv")).unwrap().dataset;
        let level = |data: &Dataset| unwritten(&hexapod, data).map(|found| found.level);
        // Forces along y and moments about z are not part of the plan: nothing better is found in the noise.
        assert!(level(&data).is_none_or(|level| level > 0.8), "{:?}", level(&data));
        for o in &mut data.observations {
            o.wrench.force.x = 0.0;
        }
        let found = unwritten(&hexapod, &data).unwrap();
        assert!(found.level < 1.5, "{}", found.level);
        let [name, _, least, _, most, unit] = found.finding.size.split(' ').collect::<Vec<_>>()[..] else {
            panic!("{}", found.finding.size)
        };
        let near = |text: &str, load: f64| (text.parse::<f64>().unwrap() - load).abs() < 10.0;
        assert!(
            name == "fx" && unit == "N" && near(least, 0.0) && near(most, 100.0),
            "{}",
            found.finding.size
        );
    }
}
