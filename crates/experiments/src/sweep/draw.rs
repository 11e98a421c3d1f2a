//! Random streams: what is drawn once for a machine, and what for every trial.
//!
//! | drawn | once for | from |
//! |---|---|---|
//! | drawings of the machine, leg stiffness | a block of trials | seed, geometry, block |
//! | random poses, drawn loads | a block | seed, geometry, block |
//! | approach, temperature, waiting time | a block | seed, geometry, block |
//! | held-out readings | a block | seed, geometry, block |
//! | shape of the effect | a block | seed, effect, block |
//! | faults of the machine that a laboratory has | a block | seed, geometry, block |
//! | its other faults | a trial | seed, geometry, trial |
//! | how far inputs are off, in tolerances | a block | seed, geometry, block |
//! | noise | a trial | seed, cell, trial |
//! | points over ranges of axes | the study | seed, axis |
//!
//! Cells with the same geometry thus see the same machines, and a plan of more random poses begins with those of a smaller
//! one: differences between cells are differences of the choice. Noise is never shared.

use hexbench_core::streams::{self, stream};
use rand_pcg::Pcg64;

/// What a stream decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SweepPurpose {
    /// Drawings and leg stiffness.
    Machine = 1,
    /// Poses and loads of a plan.
    Plan = 2,
    /// Approach, temperature and waiting times.
    Surroundings = 3,
    /// Held-out readings.
    Holdout = 4,
    /// Shape of an effect.
    Effect = 5,
    /// Noise of a trial.
    Noise = 6,
    /// Approach, temperature and waiting times of held-out readings.
    HoldoutSurroundings = 7,
    /// How a laboratory makes the machine another than that of the file.
    LaboratoryMachine = 8,
    /// What it does to the errors of readings.
    LaboratoryErrors = 9,
    /// What it does to the errors of held-out readings.
    LaboratoryHoldout = 10,
    /// What it writes down wrongly.
    LaboratoryWriting = 11,
    /// Its slips.
    LaboratorySlips = 12,
    /// Points of a design.
    Points = 13,
    /// How far inputs are off.
    InputErrors = 14,
}

/// The stream of a purpose: `of` is the number of the geometry, effect or cell, `number` that of the block or trial.
pub fn generator(seed: u64, purpose: SweepPurpose, of: usize, number: u64) -> Pcg64 {
    stream(seed, streams::Purpose::Study, [purpose as u64, of as u64, number])
}
