//! Observability indices: how well poses and loads let the parameters be seen.

use hexbench_core::statistics::mean;
use serde::Serialize;

/// Singular values of a regressor and the indices of the literature made of them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Observability {
    /// Largest first.
    pub singular_values: Vec<f64>,
    /// `(s_1 ... s_p)^(1/p) / sqrt(N)`, N poses. Source: Borm and Menq 1991; Kalas et al. 2018, eq. 14.
    pub o1: f64,
    /// `s_p / s_1`. Source: Driels and Pathre 1990.
    pub o2: f64,
    /// `s_p`. Source: Nahvi et al. 1994.
    pub o3: f64,
    /// `s_p^2 / s_1`. Source: Nahvi and Hollerbach 1996.
    pub o4: f64,
    /// `1 / sum(1 / s_i)`. Source: Sun and Hollerbach 2008.
    pub o5: f64,
}

impl Observability {
    /// Indices of singular values in any order, for `poses` poses; O1, O3 and O5 have the unit of the regressor.
    pub fn new(values: impl IntoIterator<Item = f64>, poses: usize) -> Self {
        let mut s: Vec<f64> = values.into_iter().collect();
        s.sort_by(|a, b| b.total_cmp(a));
        let (first, last) = (s.first().copied().unwrap_or(0.0), s.last().copied().unwrap_or(0.0));
        let mean_log = mean(s.iter().map(|x| x.ln())).unwrap_or(0.0);
        Self {
            o1: mean_log.exp() / (poses.max(1) as f64).sqrt(),
            o2: last / first,
            o3: last,
            o4: last * last / first,
            o5: 1.0 / s.iter().map(|x| 1.0 / x).sum::<f64>(),
            singular_values: s,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_indices_of_known_singular_values() {
        let o = Observability::new([1.0, 4.0, 2.0], 4);
        let expected = [1.0, 0.25, 1.0, 0.25, 1.0 / 1.75];
        for (found, wanted) in [o.o1, o.o2, o.o3, o.o4, o.o5].iter().zip(expected) {
            assert!((found - wanted).abs() < 4.0 * f64::EPSILON, "{found} {wanted}");
        }
    }
}
