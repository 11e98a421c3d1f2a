//! Fits of the springs with what is selected: a tick, and the questions about it that follow, rest on one fit.

use std::sync::Arc;

use hexbench_model::estimation::fit::{Fit, TermSpec};
use hexbench_model::estimation::fit_named::{Added, SpringsAlone, fit_wanted_from};
use hexbench_model::inference::selection::{FitInDetail, FitWithErrors};

use super::LoadedCampaign;
use super::counted::Counted;
use super::recent::Recent;
use super::refusal::Refusal;
use crate::wire::Selection;

/// Fits of the springs alone that are kept, each to the readings that count.
const SPRINGS_KEPT: usize = 2;
/// Judged fits that are kept: the springs, the step shown and the one before.
const JUDGED_KEPT: usize = 4;

/// The newest fits.
#[derive(Debug)]
pub(super) struct Fits {
    springs: Recent<Vec<u64>, SpringsAlone>,
    judged: Recent<Selection, FitWithErrors>,
}

impl Default for Fits {
    fn default() -> Self {
        Self { springs: Recent::of(SPRINGS_KEPT), judged: Recent::of(JUDGED_KEPT) }
    }
}

impl LoadedCampaign {
    /// Fits a selection to the readings that count and judges it.
    ///
    /// # Errors
    /// [`Refusal`] for a term that is unknown, and for a model that cannot be fitted.
    pub(super) fn judged(
        &self,
        counted: &Counted<'_>,
        selection: &Selection,
    ) -> Result<Arc<FitWithErrors>, Refusal> {
        self.fits.judged.answer(selection, || {
            let (wanted, fit) = self.fitted(counted, selection, &self.chosen(selection)?)?;
            counted.task().judge(fit, Some(&wanted)).map_err(|cause| self.refused(&cause))
        })
    }

    /// The same with every reading in detail.
    ///
    /// # Errors
    /// As [`Self::judged`].
    pub(super) fn in_detail(
        &self,
        counted: &Counted<'_>,
        selection: &Selection,
    ) -> Result<FitInDetail, Refusal> {
        let found = self.in_detail_of(counted, selection, &self.chosen(selection)?)?;
        self.fits.judged.keep(selection, found.judged.clone());
        Ok(found)
    }

    /// The same of terms that need not be those of the selection, for its readings; it is not kept.
    ///
    /// # Errors
    /// As [`Self::judged`].
    pub(super) fn in_detail_of(
        &self,
        counted: &Counted<'_>,
        selection: &Selection,
        terms: &[Added],
    ) -> Result<FitInDetail, Refusal> {
        let (wanted, fit) = self.fitted(counted, selection, terms)?;
        counted.task().judge_in_detail(fit, Some(&wanted)).map_err(|cause| self.refused(&cause))
    }

    fn fitted(
        &self,
        counted: &Counted<'_>,
        selection: &Selection,
        terms: &[Added],
    ) -> Result<(Vec<TermSpec>, Fit), Refusal> {
        let campaign = counted.task().campaign;
        let springs = self.fits.springs.answer(&selection.exclude, || SpringsAlone::fitted(campaign));
        let fitted = springs.and_then(|springs| fit_wanted_from(campaign, terms, &springs));
        fitted.map_err(|cause| self.refused(&cause))
    }
}
