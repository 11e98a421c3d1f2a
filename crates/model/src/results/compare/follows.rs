//! What residual elongations of the legs may follow.

use hexbench_core::Vector6;

use crate::estimation::campaign::Condition;

/// What an elongation may follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Follows {
    /// Leg force.
    Force,
    /// Change of leg force.
    ForceChange,
    /// Leg length.
    Length,
    /// Time since the reference.
    Elapsed,
    /// Temperature since the reference.
    DeltaT,
    /// Direction of the load.
    Approach,
    /// A coordinate of the pose.
    Pose(usize),
}

/// Everything that is asked about.
pub(super) const VARIABLES: [Follows; 12] = [
    Follows::Force,
    Follows::ForceChange,
    Follows::Length,
    Follows::Elapsed,
    Follows::DeltaT,
    Follows::Approach,
    Follows::Pose(0),
    Follows::Pose(1),
    Follows::Pose(2),
    Follows::Pose(3),
    Follows::Pose(4),
    Follows::Pose(5),
];

impl Follows {
    /// Word for files.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Force => "leg_force",
            Self::ForceChange => "leg_force_change",
            Self::Length => "leg_length",
            Self::Elapsed => "elapsed_s",
            Self::DeltaT => "delta_T_K",
            Self::Approach => "approach",
            Self::Pose(k) => ["a_mm", "b_mm", "c_mm", "alpha_deg", "beta_deg", "gamma_deg"][k],
        }
    }

    /// The variable of this name.
    pub(super) fn named(name: &str) -> Option<Self> {
        VARIABLES.into_iter().find(|v| v.name() == name)
    }

    /// Words for people, and the unit of [`Self::drawn`].
    pub(super) fn shown(self) -> (&'static str, &'static str) {
        match self {
            Self::Force => ("leg force", "N"),
            Self::ForceChange => ("change of leg force", "N"),
            Self::Length => ("leg length", "mm"),
            Self::Elapsed => ("time since the reference", "s"),
            Self::DeltaT => ("temperature since the reference", "K"),
            Self::Approach => ("approach", ""),
            Self::Pose(k) => (
                ["pose a", "pose b", "pose c", "pose alpha", "pose beta", "pose gamma"][k],
                if k < 3 { "mm" } else { "deg" },
            ),
        }
    }

    /// Value as charts show it.
    pub(super) fn drawn(self, c: &Condition, leg: usize) -> f64 {
        match self {
            Self::Length => 1e3 * c.legs.lengths[leg],
            Self::Pose(k) if k < 3 => 1e3 * self.value(c, leg),
            Self::Pose(_) => self.value(c, leg).to_degrees(),
            _ => self.value(c, leg),
        }
    }

    /// Values of all variables under a condition, one for each leg.
    pub(super) fn values(c: &Condition) -> [Vector6; VARIABLES.len()] {
        let pose = c.place.pose().to_array();
        VARIABLES.map(|variable| match variable {
            Self::Pose(k) => Vector6::repeat(pose[k]),
            _ => Vector6::from_fn(|leg, _| variable.value(c, leg)),
        })
    }

    /// Value under a condition.
    pub(super) fn value(self, c: &Condition, leg: usize) -> f64 {
        match self {
            Self::Force => c.force[leg],
            Self::ForceChange => c.force_change()[leg],
            Self::Length => c.extension[leg],
            Self::Elapsed => c.elapsed,
            Self::DeltaT => c.delta_t,
            Self::Approach => c.approach.sign(),
            Self::Pose(k) => c.place.pose().to_array()[k],
        }
    }
}
