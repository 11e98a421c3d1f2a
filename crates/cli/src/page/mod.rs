//! Pages of text for people: what was simulated, designed, located, validated.

mod calibration;
pub(crate) mod discriminated;
pub(crate) mod located;
mod recovery;
mod regress;
pub(crate) mod simulated;

pub(crate) use calibration::calibration;
pub(crate) use recovery::recovery;
pub(crate) use regress::regress;
