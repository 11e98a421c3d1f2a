//! Calibration: how far the stated probabilities can be trusted.
//!
//! A frozen protocol draws campaigns with a known truth: effects, sizes, plans, machines, noise. Each is diagnosed, and the
//! claims are compared with the truth: of all claims with probability `p`, a share `p` should be true, and an absent effect
//! should rarely be named.

mod charts;
mod claim;
mod confusion;
mod document;
mod fate;
mod power;
mod protocol;
mod record;
mod reliability;
pub mod sheets;
mod trials_csv;
mod trust;

pub use charts::{NamedChart, pictures};
pub use claim::{Claim, Claims, Mix};
pub use confusion::{ConfusionMatrix, WELL_VISIBLE, is_well_visible};
pub use document::{headlines, page};
pub use fate::Fate;
pub use power::{Curve, DistanceRange, SIZES};
pub use protocol::{Calibration, CalibrationProtocol, DISTANCES, SEED, TrialPortion, case};
pub use record::CalibrationRecord;
pub use reliability::{BORDERS, ClaimBin, ClaimScores, bins, scores};
pub use trials_csv::trials_csv;
pub(crate) use trust::COVERED;
pub use trust::{
    CREDIBLE, HeldOutQuantiles, MOST_FALSE_NAMES, credible_coverage, false_names, false_names_among_named,
    false_outside, prediction_coverage, stiffness_coverage,
};
