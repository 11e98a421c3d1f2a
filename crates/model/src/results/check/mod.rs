//! The check of machine and files: how they are read, what looks wrong, what they can show.

mod machine;
mod readings;
mod stated;

use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod};
use serde::Serialize;

pub use self::machine::MachineCheck;
pub use self::readings::ReadingsCheck;
pub use self::stated::far_from_stated;
use crate::effects::term::Term;
use crate::effects::untestable::Untestable;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::fit_baseline;
use crate::inference::diagnosis::visible;
use crate::inference::examination::Finding;
use crate::inference::misread::{AsMeant, Change, copies, held_in, names};
use crate::inference::power::{Detectable, detectable};
use crate::results::diagnose::{TwoFiles, misread_findings, prepare};

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
    let remarks = measurements.remarks(&of_machine.machine, data);
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
