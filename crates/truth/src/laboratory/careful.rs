//! Nothing is wrong: the control.

use super::{FaultEntry, LaboratoryFault};

/// Its entry in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "none" "control: nothing is wrong", &[] => Careful;
];

/// A laboratory without faults.
#[derive(Debug)]
struct Careful;

impl LaboratoryFault for Careful {}
