//! The error on poses left out when the terms, too, are chosen without them.
//!
//! Terms that were chosen with all poses know something of those left out afterwards, and their error there is too small
//! (Cawley and Talbot 2010, Journal of Machine Learning Research 11). Here each part of the poses is left out of the search as well.
//! What is weighed anew are the members of the best sets of the whole search; findings and the noise level are those of all readings.

use hexbench_core::Observation;
use serde::Serialize;

use crate::estimation::campaign::Campaign;
use crate::estimation::folds::{FoldFit, FoldFits};
use crate::estimation::residuals::{ErrorSummary, Residual, each_part_left_out, errors_of, summarise};
use crate::inference::diagnosis::{RankedSets, chosen_anew};

/// Most parts: each costs a search.
const MOST_PARTS: usize = 8;

/// Errors on poses left out of the choice of terms and of the fit.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct NestedReport {
    /// The errors.
    #[serde(flatten)]
    pub error: ErrorSummary,
    /// Terms chosen without each part of the poses, in the order of their names.
    pub chosen: Vec<Vec<String>>,
}

impl NestedReport {
    /// Of a campaign whose readings are `rows`; none where too few poses can be left out.
    pub(super) fn of(campaign: &Campaign, rows: &[Observation], outcome: &RankedSets) -> Option<Self> {
        let part = |kept: &[usize], held: &[usize]| {
            let part = campaign.part(kept);
            let wanted = chosen_anew(&part, &outcome.lin.choose_of(&part, kept), outcome);
            let fits = FoldFits::at(campaign, &wanted, &outcome.best.point)?;
            let FoldFit { part: left_out, foreseen } = fits.without(kept, held)?;
            let errors = errors_of(&foreseen, &left_out, rows);
            let mut names: Vec<String> = wanted.iter().map(|w| w.term.info().id.to_owned()).collect();
            names.sort_unstable();
            Ok((errors, names))
        };
        let parts: Vec<(Vec<Residual>, Vec<String>)> = each_part_left_out(campaign, MOST_PARTS, part).ok()?;
        let (errors, chosen): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
        Some(Self { error: summarise(&errors.concat(), None), chosen })
    }

    /// Parts without which the same terms were chosen as with all poses.
    pub fn agreeing(&self, model: &[String]) -> usize {
        let same =
            |chosen: &&Vec<String>| chosen.len() == model.len() && chosen.iter().all(|id| model.contains(id));
        self.chosen.iter().filter(same).count()
    }
}
