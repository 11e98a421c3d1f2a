//! The readings that remain when the user leaves some out.

use std::borrow::Cow;
use std::collections::HashMap;

use hexbench_core::{Dataset, LineRange};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::Fit;
use hexbench_model::estimation::foreseen::held_campaign;
use hexbench_model::estimation::linearization::Linearization;
use hexbench_model::estimation::residuals::Residual;
use hexbench_model::inference::selection::JudgedTask;
use hexbench_model::results::diagnose::prepare;

use super::LoadedCampaign;
use super::digits::short;
use super::refusal::Refusal;

/// The readings fitted, and their campaign.
pub(super) struct Counted<'a> {
    pub(super) data: Cow<'a, Dataset>,
    campaign: Cow<'a, Campaign>,
    of: &'a LoadedCampaign,
}

/// Lines of a file as a diagnosis takes them.
pub(super) fn ranges(lines: &[u64]) -> Vec<LineRange> {
    lines.iter().copied().map(LineRange::from).collect()
}

/// The readings of a file without these lines.
///
/// # Errors
/// [`Refusal`] for a line that holds no reading.
pub(super) fn without<'a>(data: &'a Dataset, lines: &[u64]) -> Result<Cow<'a, Dataset>, Refusal> {
    if lines.is_empty() {
        return Ok(Cow::Borrowed(data));
    }
    let none = |line: LineRange| {
        Refusal::bad_input(
            format!("{}: {line} contains no reading", data.source),
            "Leave out only lines that contain readings.",
        )
    };
    data.without(&ranges(lines)).map(|(rest, _)| Cow::Owned(rest)).map_err(none)
}

impl<'a> Counted<'a> {
    /// Without these lines.
    pub(super) fn of(bench: &'a LoadedCampaign, exclude: &[u64]) -> Result<Self, Refusal> {
        let c = &bench.contents;
        let data = without(&c.data, exclude)?;
        let campaign = match &data {
            Cow::Borrowed(_) => Cow::Borrowed(&bench.campaign),
            Cow::Owned(rest) => Cow::Owned(prepare(&c.hexapod, rest).map_err(|cause| bench.refused(&cause))?),
        };
        Ok(Self { data, campaign, of: bench })
    }

    /// What is fitted.
    pub(super) fn task(&self) -> JudgedTask<'_> {
        let c = &self.of.contents;
        JudgedTask {
            hexapod: &c.hexapod,
            data: &self.data,
            campaign: &self.campaign,
            holdout: c.holdout.as_ref(),
        }
    }

    /// Per condition among `of`, the number farthest from zero of its readings that count, over the noise of one reading; none where none
    /// counts.
    pub(super) fn extremes(&self, residuals: &[Residual], of: &[usize]) -> Vec<Option<f64>> {
        let line = |row: usize| self.data.observations[row].line;
        let known: HashMap<u64, f64> = residuals.iter().map(|r| (line(r.row), r.farthest())).collect();
        let all = &self.of.contents.data.observations;
        let extreme = |i: &usize| {
            let rows = self.of.campaign.groups[*i].rows.iter();
            let values = rows.filter_map(|&row| known.get(&all[row as usize].line).copied());
            values.max_by(|a, b| a.abs().total_cmp(&b.abs())).map(short)
        };
        of.iter().map(extreme).collect()
    }

    /// All readings beside a fit, those that are left out as well; none where nothing is left out.
    pub(super) fn all_beside(&self, fit: &Fit) -> Result<Option<(Campaign, Linearization)>, Refusal> {
        let data = &self.of.contents.data;
        if matches!(self.data, Cow::Borrowed(_)) {
            return Ok(None);
        }
        let refused = |cause| self.of.refused(&cause);
        let all = held_campaign(&self.campaign, data, &fit.point).map_err(refused)?;
        let lin = Linearization::at(&all, &fit.point).map_err(refused)?;
        Ok(Some((all, lin)))
    }
}
