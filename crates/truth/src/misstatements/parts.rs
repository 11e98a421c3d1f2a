//! A sign or a unit that changes while the file is taken: another instrument, another operator, a setting.

use hexbench_core::{Dataset, Hexapod};
use rand::RngExt;
use rand_pcg::Pcg64;

use super::numbers::{ALL, FIRST, LAST, Numbers};
use super::signs::AGAINST;
use super::units::KGF_N;
use super::{Misstatement, MisstatementEntry};

/// At least one row in so many is written the other way, and as many are not.
const LEAST: usize = 7;

/// `x -> factor x` in the rows before or behind a drawn one.
#[derive(Debug)]
pub(super) struct Partly {
    pub(super) numbers: Numbers,
    /// Written over meant.
    pub(super) factor: f64,
}

impl Misstatement for Partly {
    fn write(&self, data: &mut Dataset, _: &Hexapod, rng: &mut Pcg64) {
        let rows = data.observations.len();
        let at = rng.random_range(rows / LEAST..=rows - rows / LEAST);
        let concerned = if rng.random_bool(0.5) { at..rows } else { 0..at };
        for row in &mut data.observations[concerned] {
            self.numbers.change(row, |x| x * self.factor);
        }
    }
}

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Measurements "deflection-negated-partly" "From some row on, or up to it, deflections are reference minus loaded.",
        AGAINST => Partly { numbers: Numbers::Reading(ALL), factor: -1.0 };
    Measurements "dx-negated-partly" "One lateral probe was turned round while the file was taken.",
        &["deflection-sign"] => Partly { numbers: Numbers::Reading(&[0]), factor: -1.0 };
    Measurements "dalpha-negated-partly" "From some row on, or up to it, the rotation about x is positive clockwise.",
        &["rotation-sign"] => Partly { numbers: Numbers::Reading(&[3]), factor: -1.0 };
    Measurements "forces-negated-partly" "From some row on, or up to it, forces are those of the platform on the load.",
        &["wrench-sign"] => Partly { numbers: Numbers::Load(FIRST), factor: -1.0 };
    Measurements "translations-mm-partly" "From some row on, or up to it, translations are written in mm.",
        &["unit"] => Partly { numbers: Numbers::Reading(FIRST), factor: 1e-3 };
    Measurements "rotations-mrad-partly" "From some row on, or up to it, rotations are written in mrad.", &["unit"]
        => Partly { numbers: Numbers::Reading(LAST), factor: 1e-3 };
    Measurements "forces-kgf-partly" "From some row on, or up to it, forces are written in kgf.", &["unit"]
        => Partly { numbers: Numbers::Load(FIRST), factor: 1.0 / KGF_N };
];
