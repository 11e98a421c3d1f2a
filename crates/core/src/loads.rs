//! Loads of a campaign as they stand beside records of a measuring machine.

use crate::{Dataset, Vector3, files::Warning};

/// A table of loads: one row per loaded record.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadTable {
    /// Commanded poses, wrenches and covariates; nothing is measured yet.
    pub dataset: Dataset,
    /// Which records belong to each observation, and what hung on the platform.
    pub rows: Vec<LoadRow>,
    /// What was accepted but should be looked at.
    pub warnings: Vec<Warning>,
}

/// Records of one row, and its masses.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadRow {
    /// Line of the table.
    pub line: u64,
    /// Record of the loaded state.
    pub record: String,
    /// Record of the reference state; none: an absolute pose.
    pub reference: Option<String>,
    /// Masses on the platform, in the loaded and in the reference state.
    pub hung: HungMasses,
}

/// Masses that pull on one point of the platform, straight down or over a pulley. Their weight adds to the wrench of the row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HungMasses {
    /// In the loaded state, kg.
    pub loaded: f64,
    /// In the reference state, kg.
    pub reference: f64,
    /// Point on which they pull, mobile frame, m.
    pub point: Vector3,
    /// Direction in which they pull, fixed axes, of unit length.
    pub direction: Vector3,
}

impl Default for HungMasses {
    fn default() -> Self {
        Self { loaded: 0.0, reference: 0.0, point: Vector3::zeros(), direction: -Vector3::z() }
    }
}
