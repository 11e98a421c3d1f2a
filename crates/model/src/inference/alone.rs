//! Each effect alone, fitted from a machine of equal legs.
//!
//! The search for effects starts where springs alone end. Where an effect is ten times its usual size, that is far from the machine: legs
//! of negative stiffness, which no effect suits. From equal legs the effect that explains everything is found all the same.

use hexbench_core::interrupt::go_on;
use hexbench_core::parallel;
use std::sync::Arc;

use crate::effects::sizes::sizes;
use crate::effects::term::{Natural, Term};
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Fit, TermSpec, fit};
use crate::estimation::linearization::{Linearization, ModelPoint};

/// Prior widths of the parameters over their natural sizes: the data decide how large an effect is.
const WIDTH: f64 = 10.0;

/// The one effect that leaves least of a campaign; none where no fit ends. `terms`: those that the campaign can test.
pub(crate) fn best_alone(campaign: &Campaign, terms: &[Arc<dyn Term>], natural: &Natural) -> Option<Fit> {
    let mut start = ModelPoint::start(campaign);
    start.compliances.fill(natural.compliance);
    let lin = Linearization::at(campaign, &start).ok()?;
    let fits = parallel::filter_map(terms, |term| {
        go_on();
        let shape = middle_shape(term.as_ref(), &lin)?;
        let prior = sizes(term.as_ref(), false, shape, natural).iter().map(|s| s * WIDTH).collect();
        let spec = TermSpec { term: Arc::clone(term), rich: false, shape, prior };
        fit(campaign, &[spec], Some(&start)).ok()
    });
    fits.into_iter().min_by(|a, b| a.lack_of_fit.total_cmp(&b.lack_of_fit))
}

/// The shape to start from; none where no shape is sensible.
fn middle_shape(term: &dyn Term, lin: &Linearization) -> Option<f64> {
    if term.info().shape.is_none() {
        return Some(1.0);
    }
    let grid = term.shape_grid(&lin.conditions);
    grid.get(grid.len() / 2).copied()
}
