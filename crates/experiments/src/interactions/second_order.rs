//! What the second order of the deflection leaves in readings without noise: `|d_i| <= nu_i^2 (s_i + e_i) + m_i b_i`.
//!
//! `nu`, `s` and `e` as in `recovery/noiseless.rs`; `b` is the part of effects by a base or plate that yields, which moves its own lever by the
//! share `m`.

use hexbench_model::effects::term::Chapter;
use hexbench_model::estimation::campaign;
use hexbench_model::estimation::fit::Fit;
use hexbench_model::estimation::linearization::Linearization;
use nalgebra::{DVector, Matrix6};

use crate::recovery::noiseless::{effect_lengths, jacobian_change, length_at, responses};

/// `|d|` of a campaign of deflections.
pub(crate) fn second_order_error(
    lin: &Linearization,
    fit: &Fit,
    groups: &[campaign::ConditionReadings],
) -> f64 {
    let readers = lin.elongation_readers();
    let (effects, bodies) = (effect_lengths(lin, fit), bodies(lin, fit));
    let of = |i: usize| {
        let at = &lin.conditions[i];
        let [both, change] = responses(&readers[i], fit, at);
        let by_force = readers[i] * Matrix6::from_diagonal(&fit.point.compliances);
        let (nu, _) = jacobian_change(lin, at, &groups[i].mean.pose, &by_force);
        // An effect acts in both states; its column is the difference of the two.
        let twice = (both / change).max(1.0);
        let [length, lever_share] = bodies[i];
        nu * nu * (both + effects[i] * twice) + lever_share * length * twice
    };
    (0..lin.conditions.len()).map(|i| of(i).powi(2)).sum::<f64>().sqrt()
}

/// What bases and plates that yield add at every condition: whitened length, and motion over the radius of the platform.
fn bodies(lin: &Linearization, fit: &Fit) -> Vec<[f64; 2]> {
    let mut all = vec![[0.0; 2]; lin.conditions.len()];
    for a in fit.point.active.iter().filter(|a| a.term.info().chapter == Chapter::Structure) {
        let block = lin.term_block(a.term.as_ref(), a.rich, a.shape);
        let together = &block * DVector::from_column_slice(&a.values);
        for (i, [length, lever_share]) in all.iter_mut().enumerate() {
            let motion = lin.conditions[i].weights.numbers(together.fixed_rows::<6>(6 * i).into_owned());
            let shift = motion.fixed_rows::<3>(0).norm() / lin.machine.nominal.platform_radius();
            *length += length_at(i, &block, &a.values);
            *lever_share += shift + motion.fixed_rows::<3>(3).norm();
        }
    }
    all
}
