//! The error on poses left out when the terms, too, are chosen without them.
//!
//! Terms that were chosen with all poses know something of those left out afterwards, and their error there is too small
//! (Cawley and Talbot 2010, Journal of Machine Learning Research 11). Here each part of the poses is left out of the search as well.
//! What is weighed anew are the members of the best sets of the whole search; findings and the noise level are those of all readings.

use hexbench_core::Observation;
use serde::Serialize;

use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Start, TermSpec};
use crate::estimation::folds::{FoldFit, FoldFits};
use crate::estimation::linearization::ModelPoint;
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
        let chosen = |_, kept: &[usize], _: &[usize]| {
            let part = campaign.part(kept);
            Ok(chosen_anew(&part, &outcome.lin.choose_of(&part, kept), outcome))
        };
        let chosen = each_part_left_out(campaign, MOST_PARTS, chosen).ok()?;
        let errors = errors(campaign, rows, &chosen, &outcome.best.point).ok()?;
        let names = |wanted: &Vec<TermSpec>| {
            let mut names: Vec<String> = wanted.iter().map(|w| w.term.info().id.to_owned()).collect();
            names.sort_unstable();
            names
        };
        Some(Self { error: summarise(&errors, None), chosen: chosen.iter().map(names).collect() })
    }

    /// Parts without which the same terms were chosen as with all poses.
    pub fn agreeing(&self, model: &[String]) -> usize {
        let same =
            |chosen: &&Vec<String>| chosen.len() == model.len() && chosen.iter().all(|id| model.contains(id));
        self.chosen.iter().filter(same).count()
    }
}

/// Errors of each part of the poses when the terms that were chosen without it are fitted without it. Most parts choose the same: the model
/// is linearized once for all of them.
fn errors(
    campaign: &Campaign,
    rows: &[Observation],
    chosen: &[Vec<TermSpec>],
    point: &ModelPoint,
) -> Result<Vec<Residual>, ModelError> {
    let mut all = vec![Vec::new(); chosen.len()];
    for (first, terms) in chosen.iter().enumerate().filter(|(k, terms)| !chosen[..*k].contains(terms)) {
        let fits = FoldFits::from(campaign, terms, Start::at(campaign, terms, point)?);
        let of_part = |part: usize, kept: &[usize], held: &[usize]| {
            if part < first || chosen[part] != *terms {
                return Ok(None);
            }
            let FoldFit { part, foreseen } = fits.without(kept, held)?;
            Ok(Some(errors_of(&foreseen.errors(), &part, rows)))
        };
        let some = each_part_left_out(campaign, MOST_PARTS, of_part)?;
        all.iter_mut().zip(some).for_each(|(all, one)| all.extend(one.into_iter().flatten()));
    }
    Ok(all.concat())
}
