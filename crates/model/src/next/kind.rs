//! Numbers that people like to set.

use hexbench_core::Observation;

/// Finest round step that is asked for, m: what a hexapod's controller takes for granted.
const STEP_M: f64 = 1e-3;
/// The same, rad.
const STEP_RAD: f64 = 0.5 * std::f64::consts::PI / 180.0;
/// Steps a half range must have at least.
const FEWEST_STEPS: f64 = 5.0;

/// Step of pose coordinate `k` whose half range is `half` (m or rad): 1 mm or 0.5 deg, finer in small ranges.
pub fn step(k: usize, half: f64) -> f64 {
    let usual = if k < 3 { STEP_M } else { STEP_RAD };
    let ratio = half / (FEWEST_STEPS * usual);
    if ratio >= 1.0 { usual } else { usual * round_down(ratio.max(1e-9), 1) }
}

/// How much has to be set for a reading: pose coordinates that are not zero.
pub fn effort(o: &Observation) -> usize {
    o.pose.to_array().iter().filter(|x| **x != 0.0).count()
}

/// To the nearest multiple of a step.
pub fn snapped(x: f64, step: f64) -> f64 {
    if step > 0.0 { (x / step).round() * step + 0.0 } else { x }
}

/// Towards zero, to so many significant digits.
pub(super) fn round_down(x: f64, digits: i32) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return 0.0;
    }
    // A number with so few digits already must stay: 0.3 is not 0.2999...
    const SLACK: f64 = 1.0 + 1e-9;
    let exponent = (x.abs() * SLACK).log10().floor() as i32 - (digits - 1);
    let scaled = (x.abs() * SLACK / 10f64.powi(exponent)).floor();
    let text = format!("{scaled}e{exponent}");
    text.parse().unwrap_or(0.0) * x.signum()
}
