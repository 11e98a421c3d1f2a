//! Nothing is wrong: the control.

use super::{FaultEntry, LaboratoryFault};

/// Its entry in the registry.
pub(super) const FAULTS: [FaultEntry; 1] =
    [FaultEntry { id: "none", title: "control: nothing is wrong", findings: &[], fault: &Careful }];

/// A laboratory without faults.
#[derive(Debug)]
struct Careful;

impl LaboratoryFault for Careful {}
