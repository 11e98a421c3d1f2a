//! The power of a plan, computed and simulated.
//!
//! The expectation of the linear model ([`hexbench_design::power`]) is compared with campaigns in the simulated world: finite
//! deflections, independent mechanisms, noise. Every effect gets the size that should be detected with the required power. The
//! study counts how often the test detects it, how often the test gives false alarms, what the diagnosis names, and how much
//! the leg stiffnesses are biased if the effect is omitted.

mod campaigns;
mod charts;
mod document;
mod faint;
mod page;
mod plan;
mod simulate;
mod study;
mod tables;
mod usual;

pub use campaigns::{Campaigns, PowerRecord, computed};
pub use charts::pictures;
pub use document::{Studied, document, plan_of};
pub use faint::Faint;
pub use page::PlanReport;
pub use plan::PowerPlan;
pub use simulate::{AnswerAndFate, Simulated, SimulatedAnswers};
pub use study::{Power, PowerCheck, PowerError, Simulation};
pub use usual::{Usual, usual};
