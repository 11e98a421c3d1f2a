//! Which entry a fault hits.

use hexbench_core::{Dataset, Observation, Vector6};
use rand::RngExt;
use rand_pcg::Pcg64;

/// One of so many, at random; none of none.
pub(super) fn index(count: usize, rng: &mut Pcg64) -> Option<usize> {
    (count > 0).then(|| rng.random_range(0..count))
}

/// +1 or -1.
pub(super) fn side(rng: &mut Pcg64) -> f64 {
    if rng.random_bool(0.5) { 1.0 } else { -1.0 }
}

/// A row and a number of it, out of those `components`, whose value is at least so many standard deviations: a slip in a
/// smaller one would not be one.
pub(super) fn number(
    data: &Dataset,
    components: std::ops::Range<usize>,
    least: f64,
    sigma: &Vector6,
    rng: &mut Pcg64,
) -> Option<(usize, usize)> {
    let rows = data.observations.iter().enumerate();
    let large = rows.flat_map(|(i, o)| {
        let is_large = move |k: &usize| o.measured[*k].abs() >= least * sigma[*k];
        components.clone().filter(is_large).map(move |k| (i, k))
    });
    let large: Vec<_> = large.collect();
    index(large.len(), rng).map(|i| large[i])
}

/// True for readings of the same pose under the same load.
pub(super) fn same_condition(a: &Observation, b: &Observation) -> bool {
    a.pose_id == b.pose_id && a.wrench == b.wrench && a.approach == b.approach
}

/// Rows of one condition, at random.
pub(super) fn condition(data: &Dataset, rng: &mut Pcg64) -> Vec<usize> {
    let all = &data.observations;
    let Some(one) = index(all.len(), rng) else { return Vec::new() };
    (0..all.len()).filter(|&i| same_condition(&all[i], &all[one])).collect()
}
