//! The check of machine and files: how they are read, what looks wrong, what they can show.

mod machine;
mod readings;
mod stated;

use std::sync::Arc;

use hexbench_core::words::joined;
use hexbench_core::{Dataset, Hexapod};
use serde::Serialize;

pub use self::machine::MachineCheck;
pub use self::readings::ReadingsCheck;
pub use self::stated::far_from_stated;
use crate::effects::term::Term;
use crate::effects::untestable::Untestable;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Fit, fit_baseline};
use crate::estimation::residuals::residuals_at;
use crate::inference::diagnosis::visible;
use crate::inference::examination::{Finding, FindingKind};
use crate::inference::misread::{AsMeant, Change, copies, held_in, names};
use crate::inference::power::{Detectable, detectable};
use crate::results::diagnose::{TwoFiles, misread_findings, prepare};
use crate::results::outliers::{SuspiciousReading, outliers};

/// Standard deviations by which a value is clearly negative.
const CLEARLY: f64 = 4.0;

/// What a check found.
#[derive(Debug, Clone, Serialize)]
pub struct Check {
    /// `check/1`.
    pub format: &'static str,
    /// True when nothing was found that has to be put right first.
    pub ready: bool,
    /// The machine.
    pub machine: MachineCheck,
    /// The measurements, when there are any.
    pub measurements: Option<ReadingsCheck>,
    /// The readings held out, when there are any.
    pub holdout: Option<ReadingsCheck>,
    /// What is wrong with the files.
    pub findings: Vec<Finding>,
    /// What looks odd, and may be right.
    pub remarks: Vec<String>,
    /// Smallest size of each effect that the measurements would show.
    pub detectable: Vec<Detectable>,
    /// Effects that the measurements cannot test.
    pub untestable: Vec<Untestable>,
    /// What the files were read as meaning otherwise than they say because somebody asked for it, as `KIND=VALUE`.
    pub read_as: Vec<String>,
}

/// Checks a machine, and what was measured on it.
///
/// # Errors
/// As [`prepare`], where nothing at all can be fitted; [`ModelError::SingularPose`] at the zero pose.
pub fn check(
    hexapod: &Hexapod,
    data: Option<&Dataset>,
    holdout: Option<&Dataset>,
    terms: &[Arc<dyn Term>],
    read_as: &[Change],
) -> Result<Check, ModelError> {
    let Some(data) = data else { return Ok(Check { read_as: names(read_as), ..Check::of(hexapod)? }) };
    let meant = AsMeant::of(hexapod, data, holdout, read_as);
    let (hexapod, data, holdout) = (&*meant.hexapod, &*meant.data, meant.holdout.as_deref());
    let of_machine = Check::of(hexapod)?;
    let mut findings = misread_findings(hexapod, data, terms);
    findings.extend(copies(data));
    let fitted = prepare(hexapod, data).and_then(|campaign| Ok((fit_baseline(&campaign)?, campaign)));
    let (springs, campaign) = match fitted {
        Ok(both) => both,
        // What the file seems to mean says more than that nothing can be fitted to it.
        Err(_) if !findings.is_empty() => return of_machine.with_unfitted(hexapod, data, findings, read_as),
        Err(cause) => return Err(cause),
    };
    let measurements = ReadingsCheck::of(hexapod, data, &campaign, Some(&springs));
    if let Some(held) = holdout {
        let own = held_in(data, held);
        let files = TwoFiles { hexapod, data, holdout: held, terms };
        let foreign = || files.finding_by_springs(&campaign, &springs).ok().flatten();
        findings.extend(own.or_else(|| if findings.is_empty() { foreign() } else { None }));
    }
    let held_out = |held: &Dataset| {
        let campaign = prepare(hexapod, held)?;
        Ok(ReadingsCheck::of(hexapod, held, &campaign, fit_baseline(&campaign).ok().as_ref()))
    };
    let holdout = holdout.map(held_out).transpose()?;
    let (gram, candidates, untestable) = visible(&campaign, &springs, terms)?;
    let rows = residuals_at(&campaign, &data.observations, &springs.point)?;
    let outlying = far_off(&outliers(&rows, data));
    let remarks = measurements.remarks(&of_machine.machine, data).into_iter().chain(outlying);
    // Joints that are off lead springs astray in absolute poses.
    if findings.is_empty() && !data.is_absolute() {
        findings.extend(negative(&springs));
    }
    Ok(Check {
        ready: findings.is_empty(),
        measurements: Some(measurements),
        holdout,
        remarks: of_machine.remarks.iter().cloned().chain(remarks).collect(),
        detectable: if findings.is_empty() { detectable(&gram, &candidates, &[]) } else { Vec::new() },
        findings,
        untestable,
        read_as: names(read_as),
        ..of_machine
    })
}

/// Legs that yield against their force, which no machine has.
fn negative(springs: &Fit) -> Option<Finding> {
    let is_negative = |leg: &usize| springs.point.compliances[*leg] < -CLEARLY * springs.std(*leg);
    let legs: Vec<String> = (0..6).filter(is_negative).map(|leg| (leg + 1).to_string()).collect();
    (!legs.is_empty()).then(|| Finding {
        size: format!("{} of 6 legs", legs.len()),
        text: format!("leg {} comes out with a negative stiffness, which no machine has", joined(&legs)),
        next: "check that the loads of every row are entered, and the signs and units of loads and readings"
            .to_owned(),
        ..Finding::of(FindingKind::Inconsistent)
    })
}

/// The reading that is farthest from what springs lead to.
fn far_off(outliers: &[SuspiciousReading]) -> Option<String> {
    let worst = outliers.iter().max_by(|a, b| a.z.total_cmp(&b.z))?;
    let others = match outliers.len() {
        1 => String::new(),
        n => format!(", the farthest of {n}"),
    };
    Some(format!(
        "the reading in line {} is {:.0} sigma from what springs alone lead to{others}: check the record; `hexbench diagnose` leaves a wrong \
         reading out",
        worst.row, worst.z
    ))
}

impl Check {
    /// With readings to which nothing can be fitted as they are written.
    fn with_unfitted(
        self,
        hexapod: &Hexapod,
        data: &Dataset,
        findings: Vec<Finding>,
        read_as: &[Change],
    ) -> Result<Self, ModelError> {
        let measurements = ReadingsCheck::of(hexapod, data, &Campaign::new(hexapod, data)?, None);
        let remarks = self.remarks.iter().cloned().chain(measurements.remarks(&self.machine, data)).collect();
        let (measurements, read_as) = (Some(measurements), names(read_as));
        Ok(Self { ready: false, measurements, remarks, findings, read_as, ..self })
    }

    /// Of a machine alone, and what looks odd about it.
    fn of(hexapod: &Hexapod) -> Result<Self, ModelError> {
        let machine = MachineCheck::of(hexapod)?;
        Ok(Self {
            format: "check/1",
            ready: true,
            remarks: machine.remarks(),
            machine,
            measurements: None,
            holdout: None,
            findings: Vec::new(),
            detectable: Vec::new(),
            untestable: Vec::new(),
            read_as: Vec::new(),
        })
    }
}
