//! Loads that scatter about what the file states, where all that the catalogue could explain hides it.
//!
//! Forces that are written and never act, as those of a load cell with noise, have effects of their own in the catalogue, which together
//! explain what they do. The search believes none of them, and finds something outside the catalogue.

use hexbench_core::{Dataset, Hexapod};

use super::remainder::Beside;
use super::scatter::Kind;
use super::{BELIEVED, Examined, MostRows, as_rounded, look, settled};
use crate::error::ModelError;
use crate::estimation::noise::{Noise, Structure};
use crate::inference::diagnosis::RankedSets;

/// Examines the loads beside the explanation found alone; none where their scatter is not far more probable than physics without a name.
///
/// # Errors
/// As [`examine`](super::examine).
pub(crate) fn examine_loads(
    hexapod: &Hexapod,
    data: &Dataset,
    noise: Noise,
    outcome: &RankedSets,
) -> Result<Option<Examined>, ModelError> {
    let (whole, _) = as_rounded(hexapod, data, noise);
    let mut beside = Beside::Explanation;
    let (_, look) = look(hexapod, &whole, outcome, MostRows::default(), &mut None, &mut beside)?;
    let is_of_loads = |kind| matches!(kind, Kind::Common(Structure::Loads { .. }));
    let best = look.best_on_the_whole().filter(|best| is_of_loads(best.kind));
    let scatters = best.filter(|best| best.evidence - look.physics.max(look.stated) > BELIEVED);
    Ok(scatters.map(|best| settled(whole.clone(), &whole, &look, &best)))
}
