//! Effects that could be missing from the paper's model, each at the size that its translation errors ask for.
//!
//! An effect is made as large as it must be for the paper's estimator, on the paper's plan, to miss the validation poses by the
//! paper's translation errors. What it then does to the rotations, and whether such a size is believable, sorts the suspects.

use hexbench_truth::Mechanism;
use hexbench_truth::mechanisms::{
    BaseBending, BaseCompliance, BracketCompliance, LegLengthCompliance, LoadOffset, LoadTilt, TargetOffset,
};

use super::bench::{PaperMachine, effective_load, ideal, identification, validation};
use super::error::PaperError;
use super::identify::{Identified, PaperEstimator, pooled, rms};
use super::published::PREDICTION_ERROR;
use hexbench_core::Vector6;

/// A suspect at the size it would need.
#[derive(Debug, Clone)]
pub struct SuspectedEffect {
    /// Id in the catalogue.
    pub id: &'static str,
    /// Size needed, in words.
    pub size: String,
    /// Error of prediction to be expected, noise included, um and urad.
    pub error: [f64; 6],
}

/// One family of effects: id, the effect of a size, the size in words, a size to start from.
struct Family {
    id: &'static str,
    effect: fn(f64) -> Box<dyn Mechanism>,
    words: fn(f64) -> String,
    start: f64,
}

/// Softness of usual base springs, of which a family takes multiples: N/m along, N m/rad about the axes.
const USUAL_BASE: [f64; 6] = [2e8, 2e8, 4e8, 5.12e6, 5.12e6, 5.12e6];

const FAMILIES: [Family; 7] = [
    Family {
        id: "leg-length-compliance",
        effect: |s| Box::new(LegLengthCompliance { slope: s }),
        words: |s| format!("{:.1} nm/N per mm", s * 1e6),
        start: 1e-6,
    },
    Family {
        id: "bracket-compliance",
        effect: |s| Box::new(BracketCompliance { lateral_compliance: s }),
        words: |s| format!("{:.1} N/um sideways", 1e-6 / s),
        start: 1e-7,
    },
    Family {
        id: "base-compliance",
        effect: |s| Box::new(BaseCompliance { stiffness: USUAL_BASE.map(|k| k / s) }),
        words: |s| format!("{:.0} N/um upright", USUAL_BASE[2] / s * 1e-6),
        start: 10.0,
    },
    Family {
        id: "load-offset",
        effect: |s| Box::new(LoadOffset { point: [s, s, 0.0] }),
        words: |s| format!("{:.0} mm off center", s * 1e3 * 2.0_f64.sqrt()),
        start: 0.02,
    },
    Family {
        id: "load-tilt",
        effect: |s| Box::new(LoadTilt { angles: [s, s] }),
        words: |s| format!("{:.1} deg off Z", (s * 2.0_f64.sqrt()).to_degrees()),
        start: 0.05,
    },
    Family {
        id: "target-offset",
        effect: |s| Box::new(TargetOffset { point: [s, -s, s] }),
        words: |s| format!("{:.0} mm off", s * 1e3 * 3.0_f64.sqrt()),
        start: 0.1,
    },
    Family {
        id: "skew support",
        effect: |s| skew_support([s, s, -s]),
        words: |s| format!("{:.1} um aslant", s * 1e6 * 3.0_f64.sqrt()),
        start: 2e-6,
    },
];

/// A support that gives along one direction, by `motion` (m) under the paper's load, and elsewhere as stiffly as usual.
///
/// Its compliance `d d' / (F |d_z|) + diag(1 / k)` is symmetric and positive, as that of any elastic body.
pub fn skew_support(motion: [f64; 3]) -> Box<dyn Mechanism> {
    let work = effective_load() * motion[2].abs();
    let aslant = |i: usize, j: usize| if i < 3 && j < 3 { motion[i] * motion[j] / work } else { 0.0 };
    let usual = |i: usize, j: usize| if i == j { 1.0 / USUAL_BASE[i] } else { 0.0 };
    let entry = |i: usize, j: usize| aslant(i, j) + usual(i, j);
    Box::new(BaseBending { compliance: std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))) })
}

/// Errors that the paper's estimator makes on the validation poses with an effect in the world and no noise, um and urad.
pub(crate) fn bias(bench: &PaperMachine, effect: Box<dyn Mechanism>) -> Result<[f64; 6], PaperError> {
    let world = bench.world(vec![effect]);
    let data = ideal(&world, &identification())?;
    let springs = Identified::from(bench, &data, PaperEstimator::Paper)?;
    Ok(springs.prediction_error(bench, &ideal(&world, &validation())?)?)
}

/// Every suspect at the size that gives the paper's translation errors beside the noise expected of springs alone.
pub(crate) fn suspects(bench: &PaperMachine, noise: &[f64; 6]) -> Result<Vec<SuspectedEffect>, PaperError> {
    FAMILIES.iter().map(|family| sized(bench, family, noise)).collect()
}

fn sized(bench: &PaperMachine, family: &Family, noise: &[f64; 6]) -> Result<SuspectedEffect, PaperError> {
    const ROUNDS: usize = 12;
    let (mut size, mut error) = (family.start, [0.0; 6]);
    let wanted = excess(pooled(&PREDICTION_ERROR, 0), pooled(noise, 0));
    for _ in 0..ROUNDS {
        error = bias(bench, (family.effect)(size))?;
        size *= step(wanted, pooled(&error, 0));
    }
    let error = std::array::from_fn(|k| error[k].hypot(noise[k]));
    Ok(SuspectedEffect { id: family.id, size: (family.words)(size), error })
}

/// What an error has beyond another when both add in squares.
fn excess(total: f64, part: f64) -> f64 {
    (total * total - part * part).max(0.0).sqrt()
}

/// Factor towards the wanted error, held back while the answer is far from linear.
fn step(wanted: f64, reached: f64) -> f64 {
    (wanted / reached).clamp(0.3, 3.0)
}

/// How far a skew support must give along X, Y and Z (m) for the errors of all three translations to be the paper's.
pub(crate) fn support_motion(bench: &PaperMachine, noise: &[f64; 6]) -> Result<[f64; 3], PaperError> {
    const ROUNDS: usize = 15;
    let mut motion = [2e-6, 2e-6, -2e-6];
    for _ in 0..ROUNDS {
        let reached = bias(bench, skew_support(motion))?;
        for k in 0..3 {
            motion[k] *= step(excess(PREDICTION_ERROR[k], noise[k]), reached[k]);
        }
    }
    Ok(motion)
}

/// Error of prediction without any model: the deflections themselves, um and urad.
pub fn uncorrected(data: &hexbench_core::Dataset) -> [f64; 6] {
    rms(data.observations.iter().map(|o| Vector6::from(o.measured)))
}
