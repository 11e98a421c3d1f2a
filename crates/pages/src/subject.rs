//! What a page is about.

use std::collections::BTreeSet;

use hexbench_core::{Dataset, Hexapod};
use hexbench_model::diagnose::Study;
use hexbench_model::noise::Noise;
use hexbench_report::number::significant;

use crate::text::Paper;

/// A machine, its measurements, and what was found.
pub struct Subject<'a> {
    /// The machine.
    pub hexapod: &'a Hexapod,
    /// The readings fitted.
    pub data: &'a Dataset,
    /// The readings held out, when they come from a file of their own.
    pub holdout: Option<&'a Dataset>,
    /// What was found.
    pub study: &'a Study,
}

impl Subject<'_> {
    /// Machine, files, noise.
    pub fn head(&self, paper: &mut Paper) {
        paper.heading(&format!("hexbench diagnose: {}", self.hexapod.name), "");
        paper.hanging("  data", LABEL, &describe(self.data));
        if let Some(holdout) = self.holdout {
            paper.hanging("  held out", LABEL, &describe(holdout));
        }
        paper.hanging("  noise", LABEL, &noise(&self.study.campaign.noise));
    }

    /// The same, a line each.
    pub fn lines(&self) -> Vec<String> {
        lines(self.data, self.holdout, &self.study.campaign.noise)
    }
}

/// Files and noise, a line each.
pub(crate) fn lines(data: &Dataset, holdout: Option<&Dataset>, level: &Noise) -> Vec<String> {
    let holdout = holdout.map(|h| format!("held out {}", describe(h)));
    let noise = format!("noise {}", noise(level));
    std::iter::once(describe(data)).chain(holdout).chain([noise]).collect()
}

const LABEL: usize = 12;

/// File, kind and number of readings.
pub fn describe(data: &Dataset) -> String {
    let kind = data.measurand.readings();
    format!("{}: {} {kind} at {} poses", data.source, data.observations.len(), poses(data))
}

/// Number of different commanded poses.
pub fn poses(data: &Dataset) -> usize {
    let key = |o: &hexbench_core::Observation| o.pose.to_array().map(|x| (x + 0.0).to_bits());
    data.observations.iter().map(key).collect::<BTreeSet<_>>().len()
}

/// Size and origin of the noise of one reading.
pub fn noise(noise: &Noise) -> String {
    let (t, r) = (significant(noise.translation * 1e6, 2), significant(noise.rotation * 1e6, 2));
    format!("{t} um and {r} urad per reading, {}", origin(noise.source.word()))
}

fn origin(source: &str) -> &str {
    match source {
        "metrology" => "stated in [metrology]",
        "sigma columns" => "stated in the sigma_* columns",
        "repeats" => "from repeated readings",
        _ => "taken from the residuals themselves",
    }
}
