//! A table of measurements while it is read, from text or from memory.

use std::hash::Hash;

use super::duplicates::{Fingerprints, drop_copies};
use super::error::Fault;
use super::header::{GroupPurpose, Plan, Reads, Source, read_header};
use super::line::Line;
use super::row::{FilledRow, no_sigma};
use super::source::Noticed;
use super::warning::Notice;
use super::{FilePlace, FileProblem, Warning};
use crate::load_sequence::doubled_order;
use crate::{AngleConvention, Dataset, LoadSequences, Measurand, Observation};

/// A table as read, and what the reader noticed on the way.
#[derive(Debug, Clone, PartialEq)]
pub struct TableReading {
    /// The measurements, SI.
    pub dataset: Dataset,
    /// What was accepted but should be looked at.
    pub warnings: Vec<Warning>,
}

impl Noticed for TableReading {
    fn warnings(&mut self) -> Option<&mut Vec<Warning>> {
        Some(&mut self.warnings)
    }
}

/// A table while it is read.
pub(crate) struct Table {
    purpose: GroupPurpose,
    pub(crate) plan: Plan,
    pub(crate) warnings: Vec<Warning>,
    angles: AngleConvention,
    observations: Vec<Observation>,
    rows: usize,
    fingerprints: Fingerprints,
    no_load_difference: Vec<u64>,
}

impl Table {
    /// A table of no rows yet.
    pub(crate) fn new(header: &Line<'_>, reads: Reads<'_>) -> Result<Self, Fault> {
        let mut warnings = Vec::new();
        let plan = read_header(header, reads, &mut warnings)?;
        Ok(Self {
            purpose: reads.purpose,
            plan,
            warnings,
            angles: reads.machine.map_or_else(AngleConvention::default, |machine| machine.angles),
            observations: Vec::new(),
            rows: 0,
            fingerprints: Fingerprints::default(),
            no_load_difference: Vec::new(),
        })
    }

    /// Number of the next row, from 1.
    fn running_number(&self) -> i64 {
        i64::try_from(self.rows + 1).unwrap_or(i64::MAX)
    }

    /// Adds a row; `cells` is what two copies have in common.
    ///
    /// # Errors
    /// As [`FilledRow::observations`].
    pub(crate) fn push(
        &mut self,
        row: &FilledRow,
        line: u64,
        cells: &(impl Hash + ?Sized),
    ) -> Result<(), FileProblem> {
        if self.compares_loads() && row.lacks_load() {
            self.no_load_difference.push(line);
        }
        let before = self.observations.len();
        row.observations(&self.plan, line, self.running_number(), &mut self.observations)?;
        self.rows += 1;
        for observation in &self.observations[before..] {
            self.fingerprints.note(&(observation.block, cells));
        }
        Ok(())
    }

    fn read_angles(&mut self) {
        if self.angles == AngleConvention::default() {
            return;
        }
        for row in &mut self.observations {
            self.angles.read(row, &self.plan.blocks[row.block], self.plan.measurand);
        }
    }

    fn compares_loads(&self) -> bool {
        self.purpose == GroupPurpose::Measurements && self.plan.measurand != Measurand::AbsolutePose
    }

    /// The table, and what was noticed.
    pub(crate) fn finish(mut self, name: &str) -> Result<TableReading, Fault> {
        if self.observations.is_empty() {
            return Err(Fault::new(FilePlace::file(), FileProblem::NoRows));
        }
        self.read_angles();
        if self.purpose == GroupPurpose::Measurements {
            self.warnings.extend(drop_copies(&mut self.observations, self.fingerprints, self.plan.has_pose));
        }
        if !self.no_load_difference.is_empty() {
            let notice = Notice::NoLoadDifference { lines: self.no_load_difference };
            self.warnings.push(Warning::new(FilePlace::file(), notice));
        }
        refuse_doubled_order(&self.observations)?;

        let Plan { measurand, columns, blocks, .. } = self.plan;
        let mut dataset = Dataset {
            source: name.to_owned(),
            measurand,
            columns,
            blocks,
            sequences: LoadSequences::of(&self.observations),
            drawn_from: None,
            observations: self.observations,
        };
        refuse_lone_angles(self.angles, &dataset)?;
        if dataset.has_other_readings() {
            state_sigmas(&mut dataset, &self.plan.stated)?;
        }
        Ok(TableReading { dataset, warnings: self.warnings })
    }
}

/// Differences of the angles of another convention are one turn only together.
fn refuse_lone_angles(angles: AngleConvention, dataset: &Dataset) -> Result<(), Fault> {
    let Some(line) = angles.lacks_an_angle(dataset) else { return Ok(()) };
    let place = FilePlace { line: Some(line), ..FilePlace::file() };
    Err(Fault::rule(
        place,
        format!("differences of {} angles need all three, and not all were read", angles.word()),
        "Fill in all three or none, give a rotation vector as drx_, dry_, drz_, or leave [conventions] out where the angles turn about fixed axes x, y, z.",
    ))
}

/// Two readings cannot have one place in the sequence of loads.
fn refuse_doubled_order(readings: &[Observation]) -> Result<(), Fault> {
    let Some([first, second]) = doubled_order(readings) else { return Ok(()) };
    let place = FilePlace { line: Some(second.line), ..FilePlace::file() }.with_name("order");
    Err(Fault::rule(
        place,
        format!("line {} has the same position in the sequence of loads", first.line),
        "Number the rows in the order in which the loads were applied, or omit the column if the order is unknown.",
    ))
}

/// Every number of a file with sensors or empty cells is weighed by its own standard deviation.
fn state_sigmas(dataset: &mut Dataset, stated: &[[Option<f64>; 6]]) -> Result<(), Fault> {
    for o in dataset.observations.iter_mut().filter(|o| o.sigma.is_none()) {
        let mut sigma = [0.0; 6];
        for (own, stated) in sigma.iter_mut().zip(&stated[o.block]) {
            *own = stated.ok_or_else(|| Fault::new(FilePlace::file(), no_sigma()))?;
        }
        o.sigma = Some(sigma);
    }
    dataset.columns.sigma = true;
    Ok(())
}

impl Source {
    /// Text in the column of a whole number is called that, and an empty cell of a column that may be absent likewise.
    pub(crate) fn sharpened(&self, problem: FileProblem) -> FileProblem {
        match problem {
            FileProblem::NotANumber if self.column.is_whole() => FileProblem::NotWhole,
            FileProblem::EmptyCell if self.column.is_optional() => FileProblem::EmptyOptionalCell,
            other => other,
        }
    }
}
