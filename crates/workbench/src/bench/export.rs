//! Files to download.

use std::io;

use hexbench_core::files::text_hash;
use hexbench_model::application::model_file::{DataOrigin, Estimator, Model};
use hexbench_model::estimation::fit_named::refuse_undetermined;
use hexbench_model::results::runs::{Origin, WithOrigin};
use hexbench_report::charts::{self, ReportError};
use hexbench_report::render::{PROGRAM, html};
use hexbench_report::table::run_sheet::{self, NothingToFillIn};
use hexbench_report::words::session::lines as lines_of;
use hexbench_report::words::{self, Provenance};
use serde::Serialize;

use super::counted::Counted;
use super::refusal::{Refusal, RefusalKind};
use super::{LoadedCampaign, files};
use crate::wire::{Ask, Export, Exported, Selection, What};

const TOML: &str = "application/toml";
const CSV: &str = "text/csv";

impl LoadedCampaign {
    /// A file to take home.
    ///
    /// # Errors
    /// [`Refusal`], also where there is no such file.
    pub fn export(&self, export: &Export) -> Result<Exported, Refusal> {
        let [hexapod, data, holdout] = &self.files.names;
        let held = || {
            let missing = || {
                Refusal::new(
                    RefusalKind::Conflict,
                    "these data have no holdout file",
                    "The held-out error comes from leaving out one pose after another.",
                )
            };
            self.files.holdout.clone().ok_or_else(missing)
        };
        match export.what {
            What::Model => Ok(exported("model.toml", TOML, self.model(&export.selection)?)),
            What::Report => Ok(exported("report.html", "text/html", self.report(&export.selection)?)),
            What::Diagnosis => {
                Ok(exported("diagnosis.json", "application/json", self.json(&export.selection)?))
            }
            What::Hexapod => Ok(exported(hexapod, TOML, self.files.hexapod.clone())),
            What::Measurements => Ok(exported(data, CSV, self.files.data.clone())),
            What::Holdout => Ok(exported(holdout, CSV, held()?)),
            What::RunSheet | What::RunSheetPage => self.run_sheet(export),
        }
    }

    fn model(&self, selection: &Selection) -> Result<String, Refusal> {
        let counted = Counted::of(self, &selection.exclude)?;
        let (data, task) = (&*counted.data, counted.task());
        let judged = self.judged(&counted, selection)?;
        refuse_undetermined(&judged.fit).map_err(|cause| self.refused(&cause))?;
        let origin = DataOrigin {
            file: data.source.clone(),
            sha256: text_hash(&self.files.data),
            readings: data.observations.len(),
            read_as: self.read_as(),
            excluded: selection.exclude.clone(),
        };
        let model = Model::new(task.campaign, &judged.fit, Estimator::Gls, origin);
        Ok(model.open_by(&judged.left.share).to_toml()?)
    }

    fn run_sheet(&self, export: &Export) -> Result<Exported, Refusal> {
        let ask = Ask { own: export.selection.own.clone(), exclude: export.selection.exclude.clone() };
        let mut chosen = self.next(&ask, &export.plan)?;
        chosen.readings.retain(|reading| reading.repeats > 0);
        let (c, next) = (&self.contents, &chosen.readings);
        let conflict =
            |none: NothingToFillIn| Refusal::new(RefusalKind::Conflict, none.to_string(), none.next_step());
        let rows = run_sheet::rows(&c.data, next).map_err(conflict)?;
        if export.what == What::RunSheet {
            let wrong = |cause: io::Error| Refusal::bad_input(cause.to_string(), "Correct the measurements.");
            let sheet = run_sheet::csv(&c.hexapod, &rows).map_err(wrong)?;
            return Ok(exported("run-sheet.csv", CSV, sheet));
        }
        let page = words::run_sheet::page(&c.hexapod.name, &rows, next, &chosen.separation);
        Ok(exported("run-sheet.html", "text/html", html(&page).map_err(ReportError::from)?))
    }

    fn report(&self, asked: &Selection) -> Result<String, Refusal> {
        let study = self.study(&files::terms_with(&asked.own, &self.limits)?, &asked.exclude)?;
        Ok(html(&charts::diagnosis(&self.subject(&study), &self.provenance(asked))?)
            .map_err(ReportError::from)?)
    }

    /// What a page was made of.
    pub(super) fn provenance(&self, asked: &Selection) -> Provenance {
        let texts = [Some(&self.files.hexapod), Some(&self.files.data), self.files.holdout.as_ref()];
        let named = self.files.names.iter().zip(texts);
        let read = named.filter_map(|(name, text)| text.map(|t| (name.clone(), text_hash(t))));
        let own = asked.own.iter().enumerate().map(|(k, text)| (format!("term {}", k + 1), text_hash(text)));
        let otherwise = (!self.files.changes.is_empty())
            .then(|| format!(", files read as {}", self.read_as().join(", then ")));
        let without = (!asked.exclude.is_empty()).then(|| format!(", without {}", lines_of(&asked.exclude)));
        let command: String =
            [Some("hexbench workbench".to_owned()), otherwise, without].into_iter().flatten().collect();
        Provenance { command, files: read.chain(own).collect() }
    }

    fn json(&self, asked: &Selection) -> Result<String, Refusal> {
        let (c, f) = (&self.contents, &self.files);
        let hexapod = (&c.hexapod, text_hash(&f.hexapod));
        let data = (&c.data, text_hash(&f.data));
        let run = Origin::new(PROGRAM, hexapod, data, f.holdout.as_deref().map(text_hash));
        let study = self.study(&files::terms_with(&asked.own, &self.limits)?, &asked.exclude)?;
        json(&WithOrigin { result: &study.diagnosis, run })
    }
}

pub(super) fn exported(name: &str, media: &'static str, text: String) -> Exported {
    Exported { name: name.to_owned(), media, text }
}

pub(super) fn json(result: &impl Serialize) -> Result<String, Refusal> {
    let failed = |e: serde_json::Error| {
        Refusal::bad_input(e.to_string(), "Check the data for readings of wrong size.")
    };
    Ok(serde_json::to_string_pretty(result).map_err(failed)? + "\n")
}
