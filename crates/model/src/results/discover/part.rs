//! A large file: the law is searched in some hundred readings, and has to explain all of them.

use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod};

use super::{Attempt, Attempts, DiscoveryStudy, Way};
use crate::effects::term::Term;
use crate::estimation::fit::fit;
use crate::inference::diagnosis::{RankedSets, does_not_fit};
use crate::results::diagnose::{DiagnoseOptions, READINGS_OF_PART, diagnose_with, prepare};

/// Chance of what a law of a part leaves of all readings below which these are searched themselves: for one right law in so many the search
/// only takes longer.
const LEAST_CHANCE_OF_ALL: f64 = 0.01;

/// The part of a large file.
pub(super) fn of(data: &Dataset) -> Option<Dataset> {
    data.some_poses(READINGS_OF_PART)
}

/// A law found in some poses of a large file that explains every reading of it; none where the file is small, where the part shows no law
/// or leaves readings out, or where the readings that took no part in the search speak against it: then all of them are searched.
pub(super) fn found_in_part(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    terms: &[Arc<dyn Term>],
    options: &DiagnoseOptions,
    watch: &dyn Fn(),
) -> Option<DiscoveryStudy> {
    if !options.exclude.is_empty() {
        return None;
    }
    let part = of(data)?;
    let diagnosis = diagnose_with(hexapod, &part, holdout, terms, options).ok()?;
    watch();
    let attempts = Attempts { hexapod, holdout, terms, diagnosis: &diagnosis, watch };
    let way = attempts.made(&part, options).ok()?;
    let has_faults = diagnosis.diagnosis.findings.iter().any(|f| !f.is_as_stated());
    let way = match way {
        Way::AsStated(attempt) => Way::AsStated(in_all(&attempts, data, attempt)?),
        Way::AsExamined(attempt) if attempt.judged.convinces && !has_faults => {
            Way::AsExamined(in_all(&attempts, data, attempt)?)
        }
        Way::AsExamined(_) | Way::ForTheCatalogue(_) | Way::Needless => return None,
    };
    let mut study = way.study(diagnosis);
    study.discovery.warnings.push(format!(
        "the law was searched for in {} of {} readings; it is fitted to all of them, and explains all of them",
        part.observations.len(),
        data.observations.len()
    ));
    Some(study)
}

/// The laws of an attempt fitted to all readings; none where these are not explained.
fn in_all(attempts: &Attempts<'_>, data: &Dataset, attempt: Attempt) -> Option<Attempt> {
    let meant = attempts.diagnosis.as_meant.as_ref().map_or(data, |meant| &*meant.data);
    let campaign = prepare(attempts.machine(), meant).ok()?;
    let baseline = fit(&campaign, &[], Some(&attempt.outcome.baseline.point)).ok()?;
    let outcome = RankedSets { baseline, ..attempt.outcome };
    let judged = attempts.judged(meant, &campaign, &outcome, &attempt.laws, 0).ok()?;
    let explains = judged.convinces
        && judged.chance > LEAST_CHANCE_OF_ALL
        && judged.fits.last().is_some_and(|all| campaign.noise.allows_verdict() && !does_not_fit(all));
    explains.then_some(Attempt { outcome, judged, ..attempt })
}
