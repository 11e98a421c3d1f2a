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
pub(super) fn round_down(x: f64, digits: usize) -> f64 {
    // A number with so few digits already must stay: 0.3 is not 0.2999...
    const SLACK: f64 = 1.0 + 1e-9;
    let text = format!("{:.17e}", x.abs() * SLACK);
    let Some((mantissa, exponent)) = text.split_once('e').filter(|_| x.is_finite()) else { return 0.0 };
    let kept = if digits > 1 { digits + 1 } else { 1 };
    let cut = format!("{}e{exponent}", &mantissa[..kept]);
    cut.parse::<f64>().unwrap_or(0.0) * x.signum() + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn same(a: f64, b: f64) -> bool {
        a.total_cmp(&b).is_eq()
    }

    #[test]
    fn numbers_are_cut_towards_zero_and_round_ones_stay() {
        for (x, digits, expected) in [
            (218.763, 1, 200.0),
            (218.763, 2, 210.0),
            (-98.0, 1, -90.0),
            (0.3, 1, 0.3),
            (0.0, 2, 0.0),
            (13.0, 2, 13.0),
        ] {
            assert!(same(round_down(x, digits), expected), "{x} to {digits}: {}", round_down(x, digits));
        }
    }

    #[test]
    fn numbers_go_to_the_nearest_multiple_of_a_step_and_stay_without_one() {
        assert!(same(snapped(0.74, 0.5), 0.5) && same(snapped(-0.76, 0.5), -1.0));
        assert!(same(snapped(0.74, 0.0), 0.74));
    }

    #[test]
    fn steps_are_a_millimetre_and_half_a_degree_and_finer_in_small_ranges() {
        assert!(same(step(0, 0.03), STEP_M));
        assert!(same(step(5, 0.1), STEP_RAD));
        assert!((step(0, 0.001) - 0.2e-3).abs() < 1e-12, "{}", step(0, 0.001));
    }
}
