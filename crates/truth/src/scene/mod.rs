//! A scene: a machine, its hidden imperfections, a plan and an instrument, read from a folder.
//!
//! ```text
//! scene.toml           what it shows, where its numbers come from, seed, plan, instrument
//! hexapod.toml         the machine as its drawings describe it
//! sealed/truth.toml    true leg springs and hidden effects
//! ```
//!
//! Every row of a scene has its own random streams, derived from the seed and the number of the row, so rows can be
//! computed in any order and on any number of threads.

mod balls_file;
mod bench;
mod folder;
mod instrument;
mod laboratory;
mod loads_file;
mod part;
mod picture;
mod plan;
mod plan_table;
mod read;
mod sealed;
mod sealed_truth;
mod streams;

pub use bench::{Measured, RowError, VirtualBench};
pub use folder::{Existing, SimulationError};
pub use instrument::{Instrument, PoseNumbersRead};
pub use laboratory::SceneLaboratory;
pub use part::{PartName, PlanPart};
pub use plan::{PlanError, ScenePlan};
pub use sealed::stated_effect;
pub use streams::{ScenePurpose, Streams};

use hexbench_core::{Hexapod, Measurand, Pose};

use crate::{Mechanism, World, campaign::MeasurementPlan, metrology::InstrumentFrames};

/// A scene as read from its folder. SI units.
#[derive(Debug)]
pub struct Scene {
    /// Name of its folder.
    pub name: String,
    /// Files it was read from, relative to its folder.
    pub files: Vec<String>,
    /// One line.
    pub title: String,
    /// What it shows.
    pub shows: String,
    /// Where its numbers come from.
    pub source: String,
    /// Decides all that is drawn.
    pub seed: u64,
    /// Nominal machine; its metrology is what the instrument states.
    pub hexapod: Hexapod,
    /// What is done to it.
    pub plan: ScenePlan,
    /// What it is measured with.
    pub instrument: Instrument,
    /// True stiffness of each leg, N/m.
    pub leg_stiffness: [f64; 6],
    /// Hidden effects.
    pub mechanisms: Vec<Box<dyn Mechanism>>,
}

impl Scene {
    /// The machine with its hidden effects.
    pub fn world(&self) -> World {
        let mut world = World::new(self.hexapod.clone(), &self.leg_stiffness);
        world.mechanisms = self.mechanisms.iter().map(|m| m.scaled(1.0)).collect();
        world
    }

    /// Ids of the hidden effects; those outside the catalogue begin with `out:`.
    pub fn hidden_effects(&self) -> Vec<&'static str> {
        self.mechanisms.iter().map(|m| m.id()).collect()
    }

    /// What is read.
    pub fn measurand(&self) -> Measurand {
        self.plan.measurand()
    }

    /// The random streams of the seed.
    pub fn streams(&self) -> Streams {
        Streams::new(self.seed)
    }

    /// A part of the plan, whose rows can be asked for one by one.
    pub fn part(&self, name: PartName) -> PlanPart<'_> {
        self.plan.part(name, self.streams())
    }

    /// All rows of both parts.
    pub fn plan(&self) -> MeasurementPlan {
        let rows = |name| self.part(name).iter().collect();
        MeasurementPlan {
            measurand: self.measurand(),
            training: rows(PartName::Training),
            holdout: rows(PartName::Holdout),
        }
    }

    /// Frames of the instrument: that of the measuring machine is never quite that of the hexapod; that of the target
    /// matters for absolute poses only.
    pub fn frames(&self) -> InstrumentFrames {
        let drawn = InstrumentFrames::aligned(&mut self.streams().of(ScenePurpose::InstrumentFrames, 0));
        match (self.measurand(), &self.instrument) {
            (Measurand::AbsolutePose, _) => drawn,
            (_, Instrument::Balls(_)) => InstrumentFrames { target: Pose::default(), ..drawn },
            (_, Instrument::Numbers(_) | Instrument::Sensors(_)) => InstrumentFrames::default(),
        }
    }
}
