//! The catalogue's terms in random circumstances on the paper's machine.

use std::sync::Arc;

use hexbench_core::{Approach, Dataset, Hexapod, Observation, Vector6};
use hexbench_model::effects::term::{Natural, Term};
use hexbench_model::estimation::campaign::{Campaign, Condition};
use hexbench_model::estimation::equilibrium::Tangents;
use hexbench_model::machine::geometry::Machine;
use hexbench_model::terms::catalogue;

use super::plan::{random_pose, random_wrench, reading};
use super::random::Random;
use super::{measured_machine, paper_machine};

/// Compliance of every leg, m/N.
pub(crate) const SPRING: f64 = 2.5e-7;
/// Sizes of the paper's machine under 100 N.
pub(crate) const NATURAL: Natural =
    Natural { compliance: SPRING, force: 100.0, radius: 0.12, length: 0.19, elapsed: 300.0 };

/// Readings with every covariate, measured values of the size of deflections.
pub(crate) fn rows(count: usize, seed: u64) -> Vec<Observation> {
    let mut random = Random::new(seed);
    let row = |id: i64| Observation {
        pose_id: id,
        approach: Approach::ALL[usize::from(id % 2 != 0)],
        delta_t: random.within(3.0),
        elapsed: 300.0 * random.unit(),
        measured: std::array::from_fn(|_| random.within(2e-5)),
        ..reading(
            random_pose(&mut random, 15.0, 8.0),
            random_wrench(&mut random, 300.0, 20.0),
            random_wrench(&mut random, 60.0, 5.0),
        )
    };
    (0..).take(count).map(row).collect()
}

/// Conditions of a file on a machine as drawn.
pub(crate) fn conditions_on(hexapod: &Hexapod, data: &Dataset) -> Vec<Condition> {
    let stated = Hexapod { metrology: measured_machine(0.5e-6, 3e-6).metrology, ..hexapod.clone() };
    let campaign = Campaign::new(&stated, data).unwrap();
    let (machine, springs) = (Machine::nominal(hexapod), Vector6::repeat(SPRING));
    campaign.conditions(&machine, &springs, &[], Tangents::ForFit).unwrap()
}

/// The paper's machine with its brackets stated.
pub(crate) fn drawn_with_pairs() -> Hexapod {
    let drawn = paper_machine();
    Hexapod { brackets: Some(drawn.bracket_pairs()), ..drawn }
}

/// A term of the catalogue.
pub(crate) fn by_id(id: &str) -> Arc<dyn Term> {
    catalogue().into_iter().find(|t| t.info().id == id).unwrap()
}

/// A shape of every term that has one, 1 for the others.
pub(crate) fn some_shape(term: &dyn Term, conditions: &[Condition]) -> f64 {
    let grid = term.shape_grid(conditions);
    grid.get(grid.len() / 3).copied().unwrap_or(1.0)
}
