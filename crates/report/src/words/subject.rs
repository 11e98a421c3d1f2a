//! What a page is about.

use std::collections::BTreeSet;

use hexbench_core::{Dataset, Hexapod};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::noise::NoiseSource;
use hexbench_model::inference::selection::HeldOut;
use hexbench_model::results::diagnose::DiagnosisStudy;

use crate::number::counted;
use crate::page::Definition;

use super::plus_minus::{PlusMinus, Wide};
use super::units::both;

/// A machine, its measurements, and what was found.
pub struct ReportSubject<'a> {
    /// The machine.
    pub hexapod: &'a Hexapod,
    /// The readings fitted.
    pub data: &'a Dataset,
    /// The readings held out, when they come from a file of their own.
    pub holdout: Option<&'a Dataset>,
    /// What was found.
    pub study: &'a DiagnosisStudy,
    /// How wide every plus-minus is.
    pub plus_minus: PlusMinus,
    /// The command that saves the fitted model, where there is one.
    pub saving: Option<String>,
}

impl<'a> ReportSubject<'a> {
    /// A diagnosis of files, as it read them: otherwise than they say where somebody asked for it, without a held-out file that it set
    /// aside.
    pub fn of(
        hexapod: &'a Hexapod,
        data: &'a Dataset,
        holdout: Option<&'a Dataset>,
        study: &'a DiagnosisStudy,
    ) -> Self {
        let (is_used, plus_minus) = (study.diagnosis.holdout == HeldOut::File, PlusMinus::default());
        match &study.as_meant {
            Some(meant) => Self {
                hexapod: &meant.hexapod,
                data: &meant.data,
                holdout: meant.holdout.as_deref().filter(|_| is_used),
                study,
                plus_minus,
                saving: None,
            },
            None => {
                Self { hexapod, data, holdout: holdout.filter(|_| is_used), study, plus_minus, saving: None }
            }
        }
    }

    /// The same with every plus-minus so wide.
    #[must_use]
    pub fn with_plus_minus(self, plus_minus: PlusMinus) -> Self {
        Self { plus_minus, ..self }
    }

    /// The same where a command saves the fitted model.
    #[must_use]
    pub fn with_saving(self, saving: Option<String>) -> Self {
        Self { saving, ..self }
    }

    /// The plus-minus of this page: its factor and its words.
    pub(super) fn wide(&self) -> Wide {
        let of_fit = self.study.fits.last().map_or(0.0, |fit| fit.dof);
        self.plus_minus.of(self.study.campaign.noise.dof_beside(of_fit))
    }

    /// Files and noise.
    pub fn entries(&self) -> Vec<Definition> {
        let mut all = entries(self.data, self.holdout, &self.study.campaign);
        let found = self.study.diagnosis.findings.iter().filter(|f| f.kind.is_of_noise());
        all.extend(found.map(|f| Definition::new("found", format!("{}: {}", f.kind.title(), f.size))));
        all
    }
}

/// Files and noise.
pub fn entries(data: &Dataset, holdout: Option<&Dataset>, campaign: &Campaign) -> Vec<Definition> {
    let holdout = holdout.map(|h| Definition::new("held out", describe(h)));
    let noise = Definition::new("noise", noise(campaign));
    std::iter::once(Definition::new("data", describe(data))).chain(holdout).chain([noise]).collect()
}

/// File, kind and number of readings.
pub fn describe(data: &Dataset) -> String {
    let kind = data.measurand.readings();
    let one = kind.strip_suffix('s').unwrap_or(kind);
    let (used, poses) = (data.observations.len(), counted(poses(data), "pose"));
    match data.drawn_from {
        Some(all) => format!("{}: {used} of {all} {kind}, at {poses} drawn at random", data.source),
        None => format!("{}: {} at {poses}", data.source, counted(used, one)),
    }
}

/// Number of different commanded poses.
pub fn poses(data: &Dataset) -> usize {
    data.observations.iter().map(|o| o.pose.bits()).collect::<BTreeSet<_>>().len()
}

/// Size and origin of the noise of one reading.
pub fn noise(campaign: &Campaign) -> String {
    let levels = campaign.noise_read().map(|sigma| sigma.map(|s| s * 1e6));
    let adjusted = if campaign.has_adjusted_noise() { " and adjusted to the findings" } else { "" };
    format!("{} per reading, {}{adjusted}", both(levels, 2), origin_of(campaign))
}

/// Where the noise of a campaign comes from. Readings of a pose with empty cells are weighed like those of sensors, but there is no
/// sensor that states their noise.
fn origin_of(campaign: &Campaign) -> &'static str {
    let is_of_poses = campaign.hexapod.sensors.is_empty();
    origin(match campaign.noise.source {
        NoiseSource::Sensors if is_of_poses && campaign.has_noise_of_metrology() => NoiseSource::Metrology,
        NoiseSource::Sensors if is_of_poses => NoiseSource::Columns,
        source => source,
    })
}

/// Where a noise level comes from.
pub fn origin(source: NoiseSource) -> &'static str {
    match source {
        NoiseSource::Metrology => "stated in [metrology]",
        NoiseSource::Sensors => "average of the values stated for the sensors",
        NoiseSource::Columns => "stated in the sigma_* columns",
        NoiseSource::Repeats => "from repeated readings",
        NoiseSource::Residuals => "taken from the residuals themselves",
    }
}
