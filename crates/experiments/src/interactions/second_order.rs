//! What the second order of the deflection leaves in readings without noise: `|d_i| <= nu_i^2 (s_i + e_i) + m_i b_i`.
//!
//! `nu`, `s` and `e` as in `recovery/noiseless.rs`; `b` is the part of effects by a base or plate that yields, which moves its own lever by the
//! share `m`.

use hexbench_model::effects::term::Chapter;
use hexbench_model::estimation::campaign;
use hexbench_model::estimation::fit::Fit;
use hexbench_model::estimation::linearization::Linearization;
use nalgebra::{DVector, Matrix6};

use crate::recovery::noiseless::{jacobian_change, responses};

/// `|d|` of a campaign of deflections.
pub(crate) fn second_order_error(
    lin: &Linearization,
    fit: &Fit,
    groups: &[campaign::ConditionReadings],
) -> f64 {
    let readers = lin.elongation_readers();
    let effects = effect_lengths(lin, fit);
    let of = |i: usize| {
        let at = &lin.conditions[i];
        let [both, change] = responses(&readers[i], fit, at);
        let by_force = readers[i] * Matrix6::from_diagonal(&fit.point.compliances);
        let (nu, _) = jacobian_change(lin, at, &groups[i].mean.pose, &by_force);
        // An effect acts in both states; its column is the difference of the two.
        let twice = (both / change).max(1.0);
        let Added { all, bodies, lever_share } = effects[i];
        nu * nu * (both + all * twice) + lever_share * bodies * twice
    };
    (0..lin.conditions.len()).map(|i| of(i).powi(2)).sum::<f64>().sqrt()
}

/// What effects add at a condition.
#[derive(Debug, Clone, Copy, Default)]
struct Added {
    /// Whitened length, parameter by parameter.
    all: f64,
    /// The same of a base or plate that yields.
    bodies: f64,
    /// Motion of those over the radius of the platform.
    lever_share: f64,
}

fn effect_lengths(lin: &Linearization, fit: &Fit) -> Vec<Added> {
    let mut lengths = vec![Added::default(); lin.conditions.len()];
    for a in &fit.point.active {
        let block = lin.term_block(a.term.as_ref(), a.rich, a.shape);
        let together = &block * DVector::from_column_slice(&a.values);
        for (i, added) in lengths.iter_mut().enumerate() {
            let column = |k: usize| block.view((6 * i, k), (6, 1)).norm() * a.values[k].abs();
            let length = (0..a.values.len()).map(column).sum::<f64>();
            added.all += length;
            if a.term.info().chapter == Chapter::Structure {
                let together = together.fixed_rows::<6>(6 * i).into_owned();
                let motion = lin.conditions[i].weights.numbers(together);
                let shift = motion.fixed_rows::<3>(0).norm() / lin.machine.nominal.platform_radius();
                added.bodies += length;
                added.lever_share += shift + motion.fixed_rows::<3>(3).norm();
            }
        }
    }
    lengths
}
