//! How large the parameters of a term may sensibly be.

use hexbench_core::pairs_of_six;

use super::term::{Natural, Rich, Term};

/// Largest prior width as a multiple of the natural size of a parameter.
pub const WIDEST: f64 = 2.0;
/// Width of the deviations of a richer form relative to the ideal sizes.
const RICH_WIDTH: f64 = 0.5;

/// Natural sizes of the parameters of a term in one of its forms, at a shape, SI.
pub fn sizes(term: &dyn Term, rich: bool, shape: f64, natural: &Natural) -> Vec<f64> {
    let mut sizes = term.natural_sizes(natural, shape);
    let ideal = sizes.len();
    if rich {
        match term.info().rich {
            Rich::PerLeg => sizes.extend([RICH_WIDTH * sizes[0]; 6]),
            Rich::Full => sizes.extend(cross_sizes(&sizes[..ideal])),
            Rich::None => {}
        }
    }
    sizes
}

fn cross_sizes(direct: &[f64]) -> Vec<f64> {
    pairs_of_six().map(|(i, j)| RICH_WIDTH * (direct[i] * direct[j]).sqrt()).collect()
}
