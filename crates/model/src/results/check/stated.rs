//! Fitted stiffnesses beside those that the file of the machine states.

use hexbench_core::Hexapod;
use hexbench_core::statistics::median;

use crate::estimation::estimate::{Estimate, stiffness_of};

/// A fitted stiffness this many times the stated one, or this small a share of it, is no property of the legs.
const FAR_FROM_STATED: f64 = 3.0;

/// How many times as stiff as its file states a machine comes out, in the median of its legs, where no property of legs explains that: a
/// unit or a sign of all loads does that, and leaves no other trace.
pub fn far_from_stated(machine: &Hexapod, found: &[Estimate]) -> Option<f64> {
    let stated = machine.nominal_stiffness?;
    let of_leg = |leg: usize| stiffness_of(found, leg).map(|e| 1e6 * e.value / stated[leg]);
    far_ratio((0..6).filter_map(of_leg))
}

/// The median of fitted over stated stiffnesses, where it is far from one.
pub(super) fn far_ratio(ratios: impl Iterator<Item = f64>) -> Option<f64> {
    let ratio = median(ratios)?;
    (!(1.0 / FAR_FROM_STATED..=FAR_FROM_STATED).contains(&ratio)).then_some(ratio)
}

#[cfg(test)]
mod tests {
    use super::far_ratio;

    #[test]
    fn one_soft_leg_is_a_property_of_the_leg_and_a_factor_of_all_legs_is_not() {
        assert_eq!(far_ratio([0.9, 1.1, 1.0, 0.01, 1.2, 0.8].into_iter()), None);
        assert_eq!(far_ratio([900.0, 1100.0, 1000.0, 1.0, 1200.0, 1000.0].into_iter()), Some(1000.0));
        assert_eq!(far_ratio([-0.9; 6].into_iter()), Some(-0.9));
        assert_eq!(far_ratio(std::iter::empty()), None);
    }
}
