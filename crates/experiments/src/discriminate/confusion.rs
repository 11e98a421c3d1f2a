//! Pairs of effects that look alike, each under a plan that makes them so.

use hexbench_core::{Approach, Hexapod, Wrench};
use hexbench_truth::campaign::{Poses, Scheme, Spread, usual_half_range_mm_deg};

/// Preload and full load of the paper, N along z.
const PRELOAD_N: f64 = -119.682;
const FULL_LOAD_N: f64 = -338.445;

/// Two effects and a plan that confuses them.
#[derive(Debug, Clone, Copy)]
pub struct ConfusedPair {
    /// Ids of the two effects; either may be the truth.
    pub between: [&'static str; 2],
    /// What the plan lacks, in words.
    pub plan: &'static str,
    /// Loads of the plan, N along z.
    loads_n: &'static [f64],
    /// Number of poses.
    poses: u64,
    /// Largest turns of the platform, deg.
    turns_deg: [f64; 3],
    /// Waits, s.
    waits_s: [f64; 2],
}

/// The plans keep to the middle: this share of the usual travel.
const NARROW: f64 = 0.3;
const LEVEL: [f64; 3] = [0.0, 0.0, 8.0];
const TILTED: [f64; 3] = [8.0, 8.0, 8.0];
const SHORT_S: [f64; 2] = [20.0, 60.0];
const PRESSED: &[f64] = &[FULL_LOAD_N];
const PRESSED_AND_PULLED: &[f64] = &[FULL_LOAD_N, 100.0];

const VERTICAL_LEVEL: ConfusedPair = ConfusedPair {
    between: ["", ""],
    plan: "vertical loads, platform level",
    loads_n: PRESSED,
    poses: 3,
    turns_deg: LEVEL,
    waits_s: SHORT_S,
};
const VERTICAL_TILTED: ConfusedPair =
    ConfusedPair { plan: "vertical loads, platform tilted", turns_deg: TILTED, ..VERTICAL_LEVEL };
const TWO_LEVELS: ConfusedPair = ConfusedPair {
    plan: "one load that presses, one that pulls",
    loads_n: PRESSED_AND_PULLED,
    ..VERTICAL_TILTED
};
const HURRIED: ConfusedPair = ConfusedPair { plan: "vertical loads, waits of 20 to 60 s", ..VERTICAL_TILTED };

/// The pairs of the study.
pub const CONFUSIONS: [ConfusedPair; 9] = [
    ConfusedPair { between: ["base-compliance", "leg-coupling"], ..VERTICAL_LEVEL },
    ConfusedPair { between: ["base-compliance", "platform-compliance"], ..VERTICAL_LEVEL },
    ConfusedPair { between: ["platform-compliance", "joint-rotation-stiffness"], ..VERTICAL_LEVEL },
    ConfusedPair { between: ["leg-nonlinearity", "leg-asymmetry"], ..TWO_LEVELS },
    ConfusedPair { between: ["leg-nonlinearity", "leg-backlash"], ..TWO_LEVELS },
    ConfusedPair { between: ["creep", "metrology-drift"], ..HURRIED },
    ConfusedPair { between: ["creep", "joint-friction"], ..HURRIED },
    ConfusedPair { between: ["load-offset", "load-tilt"], ..VERTICAL_TILTED },
    ConfusedPair { between: ["target-offset", "base-compliance"], ..VERTICAL_TILTED },
];

impl ConfusedPair {
    /// Both names.
    pub fn name(&self) -> String {
        self.between.join(" or ")
    }

    /// The confusing plan for a machine.
    pub(super) fn scheme(&self, hexapod: &Hexapod) -> Scheme {
        let [a, b, c, ..] = usual_half_range_mm_deg(hexapod).map(|x| x * NARROW);
        let [x, y, z] = self.turns_deg;
        let along_z = |n: &f64| Wrench::from_array([0.0, 0.0, *n, 0.0, 0.0, 0.0]);
        Scheme {
            poses: Poses::Drawn { count: self.poses, half_mm_deg: [a, b, c, x, y, z] },
            loads: self.loads_n.iter().map(along_z).collect(),
            reference: along_z(&PRELOAD_N),
            repeats: 3,
            approaches: Approach::ALL.to_vec(),
            delta_t: Spread::Normal(0.1),
            elapsed: Spread::Even(self.waits_s),
            ..Scheme::plain()
        }
    }
}
