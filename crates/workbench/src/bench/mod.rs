//! One campaign on the bench: loaded once, evaluated for any selection of terms.
//!
//! The same functions as the command's: reading, fitting, judging, diagnosing, reporting. A bench never changes, so the answer to a
//! question depends on the question alone.

pub mod cases;
mod catalogue;
mod check;
mod conditions;
mod counted;
mod diagnosis;
mod digits;
mod export;
mod files;
mod fits;
mod followed;
mod more;
mod pictured;
mod planned;
mod read_as;
mod recent;
mod refusal;
mod session;
mod simulate;
mod trials;
mod view;

pub use catalogue::catalogue;
pub use refusal::{Refusal, RefusalKind};

use std::time::Instant;

use hexbench_model::effects::untestable::why_untestable;
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::linearization::{Linearization, ModelPoint};
use hexbench_model::results::diagnose::prepare;
use hexbench_model::terms;
use hexbench_report::words::subject::{describe, noise};

use self::counted::Counted;
use self::files::{Contents, Files};
use self::fits::Fits;
use self::planned::Doubt;
use self::recent::Recent;
use self::simulate::{Request, Truth};
use crate::wire::{Ask, FileText, NoiseLevels, Open, Opened, Selection, ServerLimits, UntestableTerm, View};

/// Files given on the command line, as text.
#[derive(Debug, Clone)]
pub struct Given {
    /// hexapod.toml
    pub hexapod: FileText,
    /// measurements.csv
    pub data: FileText,
    /// holdout.csv
    pub holdout: Option<FileText>,
}

/// A campaign on the bench.
#[derive(Debug)]
pub struct LoadedCampaign {
    files: Files,
    /// The files as they are meant; what they say, where that is something else.
    contents: Contents,
    written: Option<Contents>,
    campaign: Campaign,
    truth: Option<Truth>,
    /// Conditions that are shown.
    shown: Vec<usize>,
    /// That of the last diagnosis, so that a change of the plan weighs nothing again.
    doubts: Recent<Ask, Doubt>,
    fits: Fits,
    limits: ServerLimits,
}

impl LoadedCampaign {
    /// Loads, reads or simulates.
    ///
    /// # Errors
    /// [`Refusal`] with the place in the file, or what cannot be simulated.
    pub fn open(request: &Open, given: Option<&Given>, limits: &ServerLimits) -> Result<Self, Refusal> {
        let (files, truth) = source(request, given)?;
        let written = files.read(limits)?;
        let (contents, written) = match written.as_meant(&files.changes) {
            Some(meant) => (meant, Some(written)),
            None => (written, None),
        };
        let campaign = prepare(&contents.hexapod, &contents.data)
            .map_err(|cause| Refusal::model(&cause, &contents.data.source))?;
        let shown = conditions::shown(campaign.groups.len());
        let (doubts, fits) = (Recent::of(1), Fits::default());
        Ok(Self { files, contents, written, campaign, truth, shown, doubts, fits, limits: *limits })
    }

    /// What it is, and the springs alone.
    ///
    /// # Errors
    /// [`Refusal`] when not even the springs can be fitted.
    pub fn opened(&self, id: &str) -> Result<Opened, Refusal> {
        let since = Instant::now();
        let (c, counted) = (&self.contents, Counted::of(self, &[])?);
        let springs = self.in_detail(&counted, &Selection::default())?;
        let start = Linearization::at(&self.campaign, &ModelPoint::start(&self.campaign));
        let lin = start.map_err(|cause| self.refused(&cause))?;
        let level = self.campaign.noise;
        Ok(Opened {
            id: id.to_owned(),
            title: c.hexapod.name.clone(),
            about: self.about(),
            seed: self.truth.as_ref().map(|t| t.seed),
            contains: self.truth.as_ref().filter(|t| !t.sealed).map(|t| t.hidden.clone()),
            sealed: self.truth.as_ref().is_some_and(|t| t.sealed),
            absolute: c.data.is_absolute(),
            readings: c.data.observations.len(),
            read_as: self.read_as(),
            noise: NoiseLevels {
                translation_um: level.translation * 1e6,
                rotation_urad: level.rotation * 1e6,
                source: level.source,
            },
            untestable: self.untestable(&lin),
            base_joints_mm: c.hexapod.base_joints.map(|joint| (joint * 1e3).into()),
            conditions: conditions::columns(&lin, &self.shown, &self.campaign, &c.data),
            held_out: view::held_out(&counted.task(), &springs.judged.fit).zip(c.holdout.as_ref()).map(
                |((held, lin), data)| {
                    conditions::columns(&lin, &conditions::shown(lin.conditions.len()), &held, data)
                },
            ),
            view: view::view(&counted, &Selection::default(), &springs, &self.shown, since)?,
        })
    }

    /// Springs with the selected terms.
    ///
    /// # Errors
    /// [`Refusal`] for a term that is unknown or cannot be tested with these data.
    pub fn view(&self, selection: &Selection) -> Result<View, Refusal> {
        let since = Instant::now();
        let counted = Counted::of(self, &selection.exclude)?;
        let fitted = self.in_detail(&counted, selection)?;
        view::view(&counted, selection, &fitted, &self.shown, since)
    }

    fn refused(&self, cause: &ModelError) -> Refusal {
        Refusal::model(cause, &self.contents.data.source)
    }

    /// Bytes of the texts it was made from: what it needs in memory is some ten times as much.
    pub fn bytes(&self) -> usize {
        let f = &self.files;
        f.hexapod.len() + f.data.len() + f.holdout.as_ref().map_or(0, String::len)
    }

    fn about(&self) -> Vec<String> {
        let c = &self.contents;
        let held = c.holdout.as_ref().map(|h| format!("held out {}", describe(h)));
        let level = format!("noise {}", noise(&self.campaign));
        std::iter::once(describe(&c.data))
            .chain(held)
            .chain([level])
            .chain(
                self.files
                    .changes
                    .iter()
                    .map(|change| format!("read differently from what the files say: {change}")),
            )
            .chain(c.warnings.iter().cloned())
            .collect()
    }

    fn untestable(&self, lin: &Linearization) -> Vec<UntestableTerm> {
        let reason = |t: &std::sync::Arc<dyn hexbench_model::effects::term::Term>| {
            let why = why_untestable(t.as_ref(), &self.campaign, lin)?;
            Some(UntestableTerm { term: t.info().id.to_owned(), why: why.to_string() })
        };
        terms::catalogue().iter().filter_map(reason).collect()
    }
}

fn source(request: &Open, given: Option<&Given>) -> Result<(Files, Option<Truth>), Refusal> {
    match request {
        Open::Case { id } => {
            let case = cases::named(id).ok_or_else(|| Refusal::unknown("case", id))?;
            Ok((Files::of_case(case), None))
        }
        Open::Given {} => {
            let none = || {
                Refusal::new(
                    RefusalKind::Unknown,
                    "no files were given on the command line",
                    "Open files in the page.",
                )
            };
            let given = given.ok_or_else(none)?;
            Ok((Files::of_texts(&given.hexapod, &given.data, given.holdout.as_ref()), None))
        }
        Open::Files { hexapod, data, holdout } => {
            Ok((Files::of_texts(hexapod, data, holdout.as_ref()), None))
        }
        Open::More { base, readings } => {
            let (files, truth) = source(base, given)?;
            Ok((files.with_more(readings)?, truth))
        }
        Open::ReadAs { base, changes } => {
            let (files, truth) = source(base, given)?;
            Ok((files.read_as(changes)?, truth))
        }
        Open::Simulation { machine, plan, effects, distance, seed } => {
            let request = Request { machine, plan, effects, distance: *distance, seed: *seed };
            simulate::simulate(&request).map(|(files, truth)| (files, Some(truth)))
        }
        Open::Game { level, seed } => {
            simulate::game(*level, *seed).map(|(files, truth)| (files, Some(truth)))
        }
    }
}
