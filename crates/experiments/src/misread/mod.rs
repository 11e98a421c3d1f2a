//! Tests whether misstatements of files are detected.
//!
//! Campaigns are measured as they should be, and one convention of their files is broken as users break it
//! ([`hexbench_truth::misstatements`]): signs, units, axes, leg orders, frames, angles, rows. They are read and diagnosed like
//! any other file, and the findings are compared with the misstatement. Correct campaigns, with effects of all sizes, count
//! false alarms.
//!
//! Whether a misstatement matters at all is decided once, by [`PlainChange`]: springs alone fitted to the files as meant and as written.

mod case;
mod document;
mod false_alarms;
mod fate;
mod files;
mod group;
mod job;
mod plain;
mod protocol;
mod record;
mod scene;
pub mod sheets;

pub use case::{MisreadCampaign, case};
pub use document::{headlines, page};
pub(crate) use false_alarms::is_blamed;
pub use fate::{MisreadFate, WHOLE_FILE};
pub use group::MisreadGroup;
pub use job::MisreadJob;
pub use plain::PlainChange;
pub use protocol::{Misread, MisreadProtocol, SEED, SOUND, TRIALS};
pub use record::{MeasuredCampaign, MisreadRecord};
pub use scene::MisreadScene;
