//! Which bounds the study holds.

use super::noiseless::Bounded;
use super::study::{RecoveryRow, RecoveryStudy};
use super::tally::{Coverage, bounds};

/// Relative errors below this mean that world and model share their arithmetic.
const SHARED: f64 = 1e-12;
/// Largest share of sure answers that may be wrong: effects are named from a probability of 95 %.
const WRONG_SHARE: f64 = 0.05;

/// One bound.
#[derive(Debug, Clone, PartialEq)]
pub struct RecoveryBound {
    /// What is bounded, with the value found.
    pub text: String,
    /// True when the bound holds.
    pub holds: bool,
}

/// All bounds of a study.
pub fn checks(study: &RecoveryStudy) -> Vec<RecoveryBound> {
    let mut all: Vec<RecoveryBound> = study.rows.iter().flat_map(row).collect();
    all.extend(independence(study));
    let sums = [
        ("leg stiffness, all campaigns", study.stiffness),
        ("sizes of effects, all campaigns", study.sizes),
        ("shapes of effects, all campaigns", study.shapes),
        ("noise level from repeats", study.noise_by_repeats),
        ("noise level from residuals", study.noise_by_residuals),
    ];
    all.extend(sums.into_iter().filter_map(|(what, c)| covered(what, c)));
    let [sure, wrong] = study.sure;
    let most = bounds(sure as u64, WRONG_SHARE, 1)[1] * sure as f64;
    all.push(RecoveryBound {
        text: format!("{wrong} of {sure} sure answers are wrong, at most {most:.0} by chance"),
        holds: wrong as f64 <= most,
    });
    all.push(RecoveryBound {
        text: format!("{} campaigns could not be made or fitted", study.failures.len()),
        holds: study.failures.is_empty(),
    });
    all
}

fn row(row: &RecoveryRow) -> Vec<RecoveryBound> {
    let named = |what: &str| format!("{}: {what}", row.subject);
    let noiseless = [("leg stiffness", row.noiseless_stiffness), ("effect", row.noiseless_effect)];
    let mut all: Vec<RecoveryBound> =
        noiseless.into_iter().filter_map(|(what, b)| exact(&named(what), b)).collect();
    let shares = [
        ("intervals of leg stiffness", row.stiffness),
        ("intervals of sizes", row.sizes),
        ("intervals of shapes", row.shapes),
        ("predictions", row.predicted),
    ];
    all.extend(shares.into_iter().filter_map(|(what, c)| covered(&named(what), c)));
    all
}

fn exact(what: &str, bounded: Option<Bounded>) -> Option<RecoveryBound> {
    let b = bounded?;
    Some(RecoveryBound {
        text: format!("{what} without noise: error {:.1e}, bound {:.1e}", b.error, b.bound),
        holds: b.holds(),
    })
}

fn covered(what: &str, coverage: Option<Coverage>) -> Option<RecoveryBound> {
    let c = coverage?;
    Some(RecoveryBound {
        text: format!("{what}: {:.4} cover the truth, {:.4} to {:.4} by chance", c.share, c.low, c.high),
        holds: c.holds(),
    })
}

/// Deflections are linearized by the model and not by the world: they cannot agree to rounding.
fn independence(study: &RecoveryStudy) -> Option<RecoveryBound> {
    let springs = study.rows.iter().find(|r| r.subject == "springs")?.noiseless_stiffness?;
    Some(RecoveryBound {
        text: format!(
            "springs: the two worlds agree to {:.1e}, less than arithmetic they would share",
            springs.error
        ),
        holds: springs.error > SHARED,
    })
}
