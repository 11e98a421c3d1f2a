//! `loads.csv`: what was commanded and applied when the balls were touched, and which records belong together.

use std::io::{self, Write};

use hexbench_core::files::MeasurementsWriter;
use hexbench_core::{Columns, Dataset};

use super::Measured;

/// The line with the names of the columns.
pub(super) fn header(out: &mut dyn Write, of: &Dataset) -> io::Result<()> {
    let records: &[&str] = if of.is_absolute() { &["record"] } else { &["ref_record", "record"] };
    write!(out, "{},", records.join(","))?;
    writer(of).header(out)
}

/// The row `index` (from 0), after its records.
pub(super) fn row(out: &mut dyn Write, of: &Dataset, index: u64, row: &Measured) -> io::Result<()> {
    let count = row.records.len() as u64;
    for record in index * count + 1..=(index + 1) * count {
        write!(out, "{record},")?;
    }
    writer(of).rows(out, &[row.observation])
}

fn writer(of: &Dataset) -> MeasurementsWriter {
    MeasurementsWriter::conditions(Columns { reference_record: false, ..of.columns })
}
