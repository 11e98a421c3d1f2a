//! A file of readings held out that is not of the machine, or not read like the measurements.

use hexbench_core::{Dataset, Hexapod};

use super::judged::prepare;
use super::report::StepReport;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Fit, fit_baseline};
use crate::estimation::residuals::{prediction_errors, summarise};
use crate::inference::examination::{Finding, FindingKind};
use crate::inference::misread::{Change, Way, other_readings};

/// Held-out readings missed by this many times what the fitted ones are missed by do not belong to them.
const FOREIGN: f64 = 3.0;
/// Springs of their own miss such readings by at most this share of it.
const OWN_SHARE: f64 = 0.4;
/// They explain a machine without effects: what springs cannot explain, the measurements may not have shown.
const OWN_LEVEL: f64 = 2.0;

/// What is wrong with the held-out readings, when neither springs nor effects of the measurements predict them, but springs of their
/// own do, or another reading of the file.
pub(super) fn foreign(hexapod: &Hexapod, holdout: &Dataset, steps: &[StepReport]) -> Option<Finding> {
    let last = steps.last()?;
    let missed = last.holdout.as_ref()?.chi2_reduced.sqrt();
    foreign_by(hexapod, holdout, missed, last.fitted.chi2_reduced.sqrt())
}

/// The same before anything but springs is fitted.
///
/// # Errors
/// As [`prediction_errors`].
pub fn held_out_finding(
    hexapod: &Hexapod,
    campaign: &Campaign,
    springs: &Fit,
    holdout: &Dataset,
) -> Result<Option<Finding>, ModelError> {
    let errors = prediction_errors(hexapod, holdout, campaign.noise, &springs.point)?;
    let missed = summarise(&errors, None).chi2_reduced.sqrt();
    Ok(foreign_by(hexapod, holdout, missed, springs.chi2_reduced().sqrt()))
}

/// `missed`, `fitted`: errors of the held-out and of the fitted readings over the noise.
fn foreign_by(hexapod: &Hexapod, holdout: &Dataset, missed: f64, fitted: f64) -> Option<Finding> {
    let fitted = fitted.max(1.0);
    if holdout.is_absolute() || missed < FOREIGN * fitted {
        return None;
    }
    let campaign = prepare(hexapod, holdout).ok()?;
    let own = fit_baseline(&campaign).ok()?.chi2_reduced().sqrt();
    let way = other_readings(hexapod, holdout).and_then(|r| r.ways.into_iter().next());
    // The machine is that of the measurements.
    let is_of_readings = |way: &Way| !way.has_size() && way.changes.iter().all(Change::keeps_legs);
    let better = way.filter(|way| is_of_readings(way) && way.level < OWN_SHARE * missed);
    if better.is_none() && own > OWN_LEVEL.min(OWN_SHARE * missed) {
        return None;
    }
    let why = better.map_or_else(
        || {
            format!(
                "springs fitted to them alone miss them by {own:.1}: they seem to be of another machine, or of this one after a change"
            )
        },
        |way| way.meaning(),
    );
    Some(Finding {
        kind: FindingKind::Holdout,
        probability: 1.0,
        rows: Vec::new(),
        size: format!("{missed:.1} times the noise"),
        text: format!(
            "the held-out readings are missed by {missed:.1} times the noise, the measurements by {fitted:.1}: the two files do not \
             belong together; {why}. The held-out file is set aside"
        ),
        next: "give a held-out file of the same machine, written like the measurements".to_owned(),
    })
}
