//! The reference state is forgotten, exchanged with the loaded one, or counted twice.

use hexbench_core::{Dataset, Hexapod, Observation, Wrench};
use rand_pcg::Pcg64;

use super::numbers::{ALL, Numbers, Scaled};
use super::signs::AGAINST;
use super::{Misstatement, MisstatementEntry};

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Tables "states-exchanged" "The loaded wrench stands in the columns of the reference, and the other way round.",
        AGAINST => Reference::Exchanged;
    Tables "reference-missing" "There was a preload, but the table has no columns for it.",
        &["reference-missing"] => Reference::Missing;
    Tables "reference-added" "The preload is added to the loaded wrench, which holds it already.",
        &["reference-missing"] => Reference::Added;
    Tables "load-without-reference" "The loaded wrench is the increment over the preload, which has its columns too.",
        &["reference-missing"] => Reference::Subtracted;
    Tables "reference-negated" "The preload, but not the load, has the opposite sign.",
        &["wrench-sign", "reference-missing"] => Scaled { numbers: Numbers::Reference(ALL), factor: -1.0 };
];

/// What is done with the reference.
#[derive(Debug)]
enum Reference {
    Exchanged,
    Missing,
    Added,
    Subtracted,
}

impl Reference {
    fn of(&self, row: &Observation) -> [Wrench; 2] {
        let (load, reference) = (row.wrench.to_vector(), row.reference.to_vector());
        let wrench = |v: hexbench_core::Vector6| Wrench::from_array(v.into());
        match self {
            Self::Exchanged => [row.reference, row.wrench],
            Self::Missing => [row.wrench, Wrench::default()],
            Self::Added => [wrench(load + reference), row.reference],
            Self::Subtracted => [wrench(load - reference), row.reference],
        }
    }
}

impl Misstatement for Reference {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        data.columns.reference &= !matches!(self, Self::Missing);
        for row in &mut data.observations {
            [row.wrench, row.reference] = self.of(row);
        }
    }
}
