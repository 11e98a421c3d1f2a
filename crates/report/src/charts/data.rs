//! What the charts are drawn from: one model, or two, beside the readings, per condition and leg.

use hexbench_core::{Dataset, Vector6, spread_of};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::{Campaign, Condition};
use hexbench_model::estimation::foreseen::held_out_residuals;
use hexbench_model::estimation::linearization::ModelPoint;
use hexbench_model::estimation::residuals::{Residual, prediction_errors};
use hexbench_model::inference::selection::JudgedTask;
use hexbench_model::results::compare::{ComparedModel, JudgedModel};

use crate::words::ReportSubject;

/// Conditions of which every leg has a panel of its own.
const MOST: usize = 150;
/// Conditions that a panel shows with all their legs.
const MOST_WITH_ALL_LEGS: usize = 60;

/// A model beside the readings.
pub(crate) struct Seen<'a> {
    pub(crate) judged: JudgedModel<'a>,
    pub(crate) point: &'a ModelPoint,
}

/// What a page calls the first model.
#[derive(Clone, Copy)]
pub(crate) struct Words {
    /// In a legend.
    pub(crate) name: &'static str,
    /// Its residuals in a legend.
    pub(crate) leaves: &'static str,
    /// Within a sentence: `the load that ...`.
    pub(crate) misses: &'static str,
}

impl Words {
    /// Within a sentence.
    pub(crate) fn subject(self) -> &'static str {
        if self.name == SPRINGS.name { "the springs alone" } else { self.name }
    }

    /// In a legend: `the springs miss`.
    pub(crate) fn misses_short(self) -> &'static str {
        if self.name == SPRINGS.name { "the springs miss" } else { "the model misses" }
    }
}

const SPRINGS: Words =
    Words { name: "springs alone", leaves: "springs alone leave", misses: "the springs alone miss" };
const MODEL: Words = Words { name: "the model", leaves: "the model leaves", misses: "the model misses" };

/// The readings, the model that is looked at, and the model with added effects.
pub(crate) struct Data<'a> {
    pub(crate) fitted: &'a Dataset,
    pub(crate) holdout: Option<&'a Dataset>,
    pub(crate) campaign: &'a Campaign,
    pub(crate) words: Words,
    /// True where a model is compared as it is, with the inputs that the file states.
    is_as_stated: bool,
    pub(crate) before: Seen<'a>,
    /// Absent when nothing was added.
    pub(crate) after: Option<Seen<'a>>,
}

/// A condition as it is drawn.
pub(crate) struct Shown<'a> {
    pub(crate) at: &'a Condition,
    /// Residual elongation of each leg, um.
    pub(crate) left: Vector6,
    /// What the added effects explain of it, um.
    pub(crate) explained: Option<Vector6>,
}

impl<'a> Data<'a> {
    /// The springs alone, and the final model of a diagnosis.
    pub(crate) fn of_study(subject: &ReportSubject<'a>) -> Result<Self, ModelError> {
        let (study, data) = (subject.study, &subject.study.data);
        let seen = |point: &'a ModelPoint| Seen::of(&study.campaign, data, point, true);
        let last = study.fits.last().filter(|_| study.fits.len() > 1);
        Ok(Self {
            fitted: data,
            holdout: subject.holdout,
            campaign: &study.campaign,
            words: SPRINGS,
            is_as_stated: false,
            before: seen(&study.outcome.baseline.point)?,
            after: last.map(|fit| seen(&fit.point)).transpose()?,
        })
    }

    /// The springs alone, and springs with terms, fitted to the same readings.
    pub(crate) fn of_fits(
        task: &JudgedTask<'a>,
        [springs, model]: [&'a ModelPoint; 2],
    ) -> Result<Self, ModelError> {
        let seen = |point| Seen::of(task.campaign, task.data, point, true);
        Ok(Self {
            fitted: task.data,
            holdout: task.holdout,
            campaign: task.campaign,
            words: SPRINGS,
            is_as_stated: false,
            before: seen(springs)?,
            after: if model.active.is_empty() { None } else { Some(seen(model)?) },
        })
    }

    /// The model of a comparison.
    pub(crate) fn of_comparison(
        data: &'a Dataset,
        holdout: Option<&'a Dataset>,
        compared: &'a ComparedModel,
    ) -> Result<Self, ModelError> {
        let fitted = compared.comparison.fitted_here;
        let words = if compared.point.active.is_empty() { SPRINGS } else { MODEL };
        let before = Seen::of(&compared.campaign, data, &compared.point, fitted)?;
        let campaign = &compared.campaign;
        Ok(Self { fitted: data, holdout, campaign, words, is_as_stated: true, before, after: None })
    }

    /// Both models with their names, the look of the first one first.
    pub(crate) fn models(&self) -> impl Iterator<Item = (&'static str, usize, &Seen<'a>)> {
        let after = self.after.as_ref().map(|seen| ("with the added effects", super::figures::FINAL, seen));
        std::iter::once((self.words.name, super::figures::SPRINGS, &self.before)).chain(after)
    }

    /// True where the readings of some condition tell the elongation of every leg.
    pub(crate) fn tells_of_legs(&self) -> bool {
        !self.before.judged.space.determined().is_empty()
    }

    /// Conditions for panels of single legs.
    pub(crate) fn conditions(&self) -> impl Iterator<Item = Shown<'_>> {
        self.thinned(MOST)
    }

    /// Conditions for panels of all legs.
    pub(crate) fn conditions_with_all_legs(&self) -> impl Iterator<Item = Shown<'_>> {
        self.thinned(MOST_WITH_ALL_LEGS)
    }

    fn thinned(&self, most: usize) -> impl Iterator<Item = Shown<'_>> {
        let judged = &self.before.judged;
        spread_of(judged.space.determined(), most).map(|i| {
            let left = judged.space.elongation[i] * 1e6;
            let after = self.after.as_ref().map(|a| left - a.judged.space.elongation[i] * 1e6);
            Shown { at: &judged.lin.conditions[i], left, explained: after }
        })
    }

    /// Errors of a model on readings it has not seen.
    pub(crate) fn errors(&self, seen: &Seen<'_>, rows: &Dataset) -> Result<Vec<Residual>, ModelError> {
        if self.is_as_stated {
            return prediction_errors(&self.campaign.hexapod, rows, self.campaign.noise, seen.point);
        }
        held_out_residuals(self.campaign, rows, seen.point)
    }
}

impl<'a> Seen<'a> {
    fn of(
        campaign: &'a Campaign,
        data: &'a Dataset,
        point: &'a ModelPoint,
        fitted: bool,
    ) -> Result<Self, ModelError> {
        Ok(Self { judged: JudgedModel::of(campaign, data, point, fitted)?, point })
    }
}
