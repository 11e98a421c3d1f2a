//! The power of a plan, computed and simulated.
//!
//! What the linear model expects ([`hexbench_design::power`]) is held against campaigns in the simulated world: finite
//! deflections, mechanisms of its own, noise. Every effect gets the size that should be seen with the wanted power; counted are
//! how often the same test sees it, how often it sees something in campaigns without effects, what the diagnosis calls it, and
//! how far the leg stiffnesses go astray when it is left out.

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
