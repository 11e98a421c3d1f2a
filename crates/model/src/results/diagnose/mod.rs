//! Diagnosis, from files to a verdict: search, held-out errors, parameters, next steps.

mod alternative;
mod answer;
mod averaged;
mod context;
mod foreign;
mod held;
mod judged;
mod lone_fault;
mod misread;
mod nested;
mod next;
mod notes;
mod options;
mod other_reading;
mod remainder;
mod report;

use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod};

pub use self::alternative::Alternative;
use self::answer::Answer;
pub(crate) use self::context::{Context, MOST_RIVALS};
pub use self::foreign::TwoFiles;
use self::judged::{BothWays, Judged, sound_alone};
pub use self::judged::{prepare, prepare_to_fit};
pub use self::misread::misread_findings;
use self::misread::{FirstLook, first_look};
pub use self::nested::NestedReport;
pub use self::next::NextReadings;
use self::notes::{outside, warnings};
pub use self::options::DiagnoseOptions;
pub use self::other_reading::OtherReading;
pub use self::remainder::{LegRemainder, RemainderReport};
pub use self::report::{
    AbsorbedReport, CandidateReport, Diagnosis, NextReport, NoiseReport, OutsideReport, SeparationReport,
    StepReport,
};
use crate::effects::term::Term;
use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, same_frames};
use crate::estimation::fit::Fit;
use crate::estimation::fit_named::asked_as;
use crate::estimation::residuals::residuals;
use crate::inference::candidates::Candidate;
use crate::inference::diagnosis::RankedSets;
use crate::inference::examination::{gross_readings, is_misread};
use crate::inference::explanation::Explanation;
use crate::inference::importance::gaussian_checks;
use crate::inference::misread::{AsMeant, held_in, names};
use crate::inference::power::detectable;
use crate::inference::selection::{HeldOut, same_kind};
use crate::inference::verdict::Judgement;
use crate::results::compare::coordinates::coordinates;
use crate::results::next::{ProposedReadings, RivalExplanation};
use crate::results::outliers::outliers;

/// Cosine beyond which two signatures count as indistinguishable.
const LOOK_ALIKE: f64 = 0.95;

/// Readings of the part of a large file that is looked at first.
pub(crate) const READINGS_OF_PART: usize = 432;

/// Everything behind a diagnosis, for plots and reports.
pub struct DiagnosisStudy {
    /// What people read.
    pub diagnosis: Diagnosis,
    /// The search behind it.
    pub outcome: RankedSets,
    /// The readings it rests on: those of the file without the ones left out.
    pub data: Dataset,
    /// They averaged.
    pub campaign: Campaign,
    /// Fits of the steps.
    pub fits: Vec<Fit>,
    /// Explanations that the proposed readings are to separate; none where the answer is sure.
    pub rivals: Vec<RivalExplanation>,
    /// The readings proposed.
    pub proposed: ProposedReadings,
    /// Machine and files as they were read, where somebody asked to read them otherwise than they say.
    pub as_meant: Option<AsMeant<'static>>,
}

/// Diagnose a dataset; held-out poses come from `holdout`, else poses are left out in turn.
///
/// # Errors
/// As [`diagnose_with`].
pub fn diagnose(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    terms: &[Arc<dyn Term>],
) -> Result<DiagnosisStudy, ModelError> {
    diagnose_with(hexapod, data, holdout, terms, &DiagnoseOptions::default())
}

/// The same with a say in which readings count.
///
/// # Errors
/// As [`fit`](crate::estimation::fit::fit); [`ModelError::Mismatch`] when the holdout is of another kind, [`ModelError::NoReading`]
/// for lines to be left out that hold no reading.
pub fn diagnose_with(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    terms: &[Arc<dyn Term>],
    options: &DiagnoseOptions,
) -> Result<DiagnosisStudy, ModelError> {
    let mut study = diagnosed(hexapod, data, holdout, terms, options)?;
    let other = OtherReading::of(&study.diagnosis, (hexapod, data, holdout), terms, options);
    study.diagnosis.added.extend(other.iter().flat_map(|other| other.added.clone()));
    study.diagnosis.other_reading = other;
    Ok(study)
}

/// The same of files as they are read.
fn diagnosed(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    terms: &[Arc<dyn Term>],
    options: &DiagnoseOptions,
) -> Result<DiagnosisStudy, ModelError> {
    let meant = AsMeant::of(hexapod, data, holdout, &options.read_as);
    let (hexapod, data, holdout) = (&*meant.hexapod, &*meant.data, meant.holdout.as_deref());
    holdout.map_or(Ok(()), |held| same_kind(data, held))?;
    let (data, excluded) = options.applied(data)?;
    let held_in = holdout.and_then(|held| held_in(&data, held));
    let mut holdout = holdout.filter(|_| held_in.is_none());
    let in_frames = holdout.map_or(Ok(()), |held| same_frames(hexapod, &data, held));
    let gross = gross_readings(hexapod, &data);
    let sound = holdout.and_then(|held| sound_alone(held, &data, &gross));
    holdout = sound.as_ref().or(holdout);
    let BothWays { answer: judged, other } = match first_look(hexapod, &data, terms, &gross)? {
        FirstLook::Misread(answer) => {
            holdout = holdout.filter(|_| in_frames.is_ok());
            BothWays { answer: *answer, other: None }
        }
        FirstLook::Sound(explained) => {
            in_frames?;
            BothWays::of(hexapod, &data, terms, explained, gross, options.keep_all)?
        }
    };
    let (alike, mistaken) = holdout.map(|held| judged.soundly_held(held)).unzip();
    holdout = alike.as_ref().or(holdout);
    let Judged { data, campaign, outcome, mut findings, rival, .. } = judged;
    findings.extend(held_in.into_iter().chain(mistaken.flatten()));
    let mut context = Context { hexapod, data: &data, holdout, campaign: &campaign, outcome: &outcome };
    let mut answer = Answer::of(&context, &findings)?;
    let is_misread = is_misread(&findings);
    let foreign = |held| TwoFiles { hexapod, data: &data, holdout: held, terms }.finding(&answer.steps);
    if let Some(finding) = holdout.filter(|_| !is_misread).and_then(foreign) {
        findings.push(finding);
        context.holdout = None;
        answer = Answer::of(&context, &findings)?;
    }
    let holdout = context.holdout;
    let (alternative, unknown) = alternative::of(hexapod, holdout, other);
    let Answer { judgement, order, fits, lin, steps, added, small, left, numbers } = answer;
    let last = fits.last().unwrap_or(&outcome.baseline);
    let rows = residuals(&campaign, &data.observations, |i| lin.residual(i));
    let sensors = if campaign.reads_poses {
        Vec::new()
    } else {
        coordinates(&campaign, &rows, &data.observations, &lin)
    };
    let model: Vec<String> = order.iter().map(|w| w.term.info().id.to_owned()).collect();
    let richer = order.iter().filter(|w| w.rich).map(|w| w.term.info().id.to_owned()).collect();
    let add = order.iter().map(|w| asked_as(w.term.info().id, w.rich)).collect();
    let best = outcome.sets.sets.first();
    let rivals = context.rivals_of(&judgement);
    let proposed = context.proposed(&rivals);
    let next = NextReadings::of(&proposed, &rivals);
    let remainder = RemainderReport::of(&left, (last, lin), steps.last(), &campaign, &data);
    let diagnosis = Diagnosis {
        format: "diagnosis/1",
        verdict: judgement.verdict,
        added,
        model,
        small,
        richer,
        add,
        candidates: candidates(&judgement, &outcome),
        present: judgement.present.clone(),
        gaussian_checks: if is_misread { Vec::new() } else { gaussian_checks(&campaign, &outcome) },
        credible_set: judgement.credible.clone(),
        steps,
        nested: if holdout.is_none() && !is_misread {
            NestedReport::of(&campaign, &data.observations, &outcome)
        } else {
            None
        },
        holdout: if holdout.is_some() { HeldOut::File } else { HeldOut::PosesInTurn },
        noise: NoiseReport::of(&campaign),
        parameters: numbers.determined,
        not_determined: numbers.not_determined,
        untestable: outcome.untestable.clone(),
        detectable: detectable(
            &outcome.gram,
            &outcome.candidates,
            &best.map(|s| s.variants.clone()).unwrap_or_default(),
        ),
        next: next.readings,
        separation: next.separation,
        absorbed: context.absorbed(&order, &judgement),
        sensors,
        suspects: outliers(&rows, &data),
        outside: outside(&judgement, &outcome, rival.as_ref()),
        law: None,
        remainder,
        warnings: warnings(&campaign, &data, last, &judgement, &outcome.natural, rival.as_ref())
            .into_iter()
            .chain(unknown)
            .collect(),
        findings,
        excluded,
        keep_all: options.keep_all,
        read_as: names(&options.read_as),
        alternative,
        other_reading: None,
    };
    let as_meant = (!options.read_as.is_empty()).then(|| meant.into_owned());
    Ok(DiagnosisStudy { diagnosis, outcome, data, campaign, fits, rivals, proposed, as_meant })
}

fn candidates(judgement: &Judgement, outcome: &RankedSets) -> Vec<CandidateReport> {
    let report = |(term, probability): &(Explanation, f64)| CandidateReport {
        term: term.clone(),
        // A sum of shares may pass one by its rounding.
        probability: probability.min(1.0),
        indistinguishable: term.term().map_or(Vec::new(), |id| look_alikes(id, outcome)),
    };
    let mut reports: Vec<CandidateReport> = judgement.first.iter().map(report).collect();
    // Looking alike has no direction: what imitates is imitated.
    for k in 0..reports.len() {
        let Some(name) = reports[k].term.term().map(str::to_owned) else { continue };
        for other in reports[k].indistinguishable.clone() {
            let twin = reports.iter_mut().find(|r| r.term.is_term(&other));
            if let Some(twin) = twin.filter(|t| !t.indistinguishable.contains(&name)) {
                twin.indistinguishable.push(name.clone());
            }
        }
    }
    reports
}

/// Terms that imitate the signature a term has in these data, beside the rest of the best set.
fn look_alikes(term: &str, outcome: &RankedSets) -> Vec<String> {
    let index = |c: &Candidate| c.id() == Some(term);
    let Some(own) = outcome.candidates.iter().position(index) else { return Vec::new() };
    let best = outcome.sets.sets.first();
    let others: Vec<_> = best.map_or(Vec::new(), |s| {
        let kept = s.members.iter().zip(&s.variants).filter(|(m, _)| **m != own);
        kept.map(|(_, v)| *v).collect()
    });
    let profile = outcome.gram.profile(&others, &outcome.candidates[own].blocks);
    let Some(&(variant, _)) = profile.first() else { return Vec::new() };
    let mut set = others.clone();
    set.push(variant);
    let Some(posterior) = outcome.gram.posterior(&set, 1.0) else { return Vec::new() };
    let width = outcome.gram.blocks[variant.block].width();
    let values: Vec<f64> = posterior.mean.iter().skip(posterior.mean.len() - width).copied().collect();
    let imitates = |c: &&Candidate| {
        let known = |b: &usize| outcome.gram.imitation(&others, variant.block, &values, *b) > LOOK_ALIKE;
        c.id().is_some_and(|id| id != term) && c.blocks.iter().any(known)
    };
    let in_best = |c: &&Candidate| !others.iter().any(|v| c.blocks.contains(&v.block));
    let like = outcome.candidates.iter().filter(in_best).filter(imitates);
    like.filter_map(|c| c.id().map(str::to_owned)).collect()
}
