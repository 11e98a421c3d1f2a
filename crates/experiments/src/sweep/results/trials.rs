//! `trials.parquet`.
//!
//! Row groups have a fixed number of rows whatever the shards; nothing in the file depends on the clock or the machine: equal
//! results are equal bytes. Results that a trial does not have are null.

use std::io::{self, Write};

use hexbench_core::words::to_digits;
use hexbench_report::table::parquet::{
    File, KeyValue, ParquetError, Physical, ROWS, RowGroup, begin, counts, double, int64, numbers, optional,
    other, required, text,
};
use parquet::basic::Encoding;
use parquet::data_type::ByteArray;
use parquet::file::properties::{WriterProperties, WriterPropertiesBuilder};
use parquet::schema::types::{ColumnPath, TypePtr};

use crate::sweep::cells::{AXES, AxisLevels};
use crate::sweep::columns::{ColumnKind, TrialColumn};
use crate::sweep::indices::PREFIX;
use crate::sweep::runner::Runner;
use crate::sweep::shard::{ColumnValues, EMPTY, Shard};

/// Format of the table.
const FORMAT: &str = "study-trials/1";

/// The table while it is written: at most one row group is in memory.
pub(super) struct Table<'a> {
    runner: &'a Runner,
    levels: [AxisLevels; AXES],
    file: File<'a>,
    buffer: Shard,
    /// Numbers of the buffered trials.
    numbers: Vec<u64>,
}

impl<'a> Table<'a> {
    pub(super) fn begin(runner: &'a Runner, out: &'a mut (dyn Write + Send)) -> io::Result<Self> {
        let levels = runner.study().axes.levels();
        let fields = fields_of(&levels, runner.columns()).map_err(other)?;
        let file = begin(out, "trials", fields, properties(runner)?)?;
        Ok(Self {
            runner,
            levels,
            file,
            buffer: Shard::empty(0, 0..0, runner.columns()),
            numbers: Vec::new(),
        })
    }

    /// Adds a shard; shards come in order.
    pub(super) fn add(&mut self, shard: &Shard) -> io::Result<()> {
        for (buffer, column) in self.buffer.columns.iter_mut().zip(&shard.columns) {
            match (buffer, column) {
                (ColumnValues::Numbers(all), ColumnValues::Numbers(new)) => all.extend(new),
                (ColumnValues::Codes(all), ColumnValues::Codes(new)) => all.extend(new),
                _ => return Err(io::Error::other("a shard of another task")),
            }
        }
        self.numbers.extend(shard.trials.clone());
        while self.buffer.rows() >= ROWS {
            self.flush(ROWS)?;
        }
        Ok(())
    }

    pub(super) fn end(mut self) -> io::Result<()> {
        let rest = self.buffer.rows();
        if rest > 0 {
            self.flush(rest)?;
        }
        self.file.close().map(drop).map_err(other)
    }

    /// Writes the first rows of the buffer as a row group.
    fn flush(&mut self, rows: usize) -> io::Result<()> {
        let trials: Vec<u64> = self.numbers.drain(..rows).collect();
        let mut group = self.file.next_row_group().map_err(other)?;
        let head = Head { runner: self.runner, levels: &self.levels, trials };
        head.write(&mut group).map_err(other)?;
        for (column, values) in self.runner.columns().iter().zip(&mut self.buffer.columns) {
            match values {
                ColumnValues::Numbers(all) => numbers(&mut group, &all.drain(..rows).collect::<Vec<_>>()),
                ColumnValues::Codes(all) => {
                    codes(&mut group, &all.drain(..rows).collect::<Vec<_>>(), &column.kind)
                }
            }
            .map_err(other)?;
        }
        group.close().map(drop).map_err(other)
    }
}

/// Columns that say what a trial was.
struct Head<'a> {
    runner: &'a Runner,
    levels: &'a [AxisLevels; AXES],
    trials: Vec<u64>,
}

impl Head<'_> {
    fn write(&self, group: &mut RowGroup<'_, '_>) -> Result<(), ParquetError> {
        let study = self.runner.study();
        let places: Vec<(usize, u64)> = self.trials.iter().map(|&t| study.place(t)).collect();
        let whole = |n: u64| i64::try_from(n).unwrap_or(i64::MAX);
        int64(group, &places.iter().map(|p| whole(p.0 as u64)).collect::<Vec<_>>())?;
        int64(group, &places.iter().map(|p| whole(p.1)).collect::<Vec<_>>())?;
        int64(group, &places.iter().map(|p| whole(p.1 / study.redraw)).collect::<Vec<_>>())?;
        for (k, axis) in self.levels.iter().enumerate() {
            let at = |p: &(usize, u64)| study.axes.cell(p.0).position[k];
            let at: Vec<usize> = places.iter().map(at).collect();
            if let Some(numbers) = axis.numbers() {
                double(group, &at.iter().map(|&k| numbers[k]).collect::<Vec<_>>())?;
            } else {
                let words = axis.levels.iter().map(|level| level.text().into_bytes().into());
                let words: Vec<ByteArray> = words.collect();
                text(group, &at.iter().map(|&k| words[k].clone()).collect::<Vec<_>>(), None)?;
            }
        }
        let sigma = |k: usize| {
            places.iter().map(|p| short(study.axes.cell(p.0).sigmas_um_urad()[k])).collect::<Vec<_>>()
        };
        numbers(group, &sigma(0))?;
        numbers(group, &sigma(1))
    }
}

/// Twelve digits: what a file stated comes back as it was written.
fn short(x: f64) -> f64 {
    to_digits(x, 12)
}

/// Counts or words, [`EMPTY`] as null.
fn codes(group: &mut RowGroup<'_, '_>, values: &[u8], kind: &ColumnKind) -> Result<(), ParquetError> {
    let levels: Vec<i16> = values.iter().map(|code| i16::from(*code != EMPTY)).collect();
    let present = values.iter().filter(|code| **code != EMPTY);
    let ColumnKind::Word(words) = kind else {
        return counts(group, &present.map(|code| i32::from(*code)).collect::<Vec<_>>(), &levels);
    };
    let words: Vec<ByteArray> = words.iter().map(|word| word.clone().into_bytes().into()).collect();
    let present: Vec<ByteArray> = present.filter_map(|code| words.get(usize::from(*code)).cloned()).collect();
    text(group, &present, Some(&levels))
}

fn fields_of(levels: &[AxisLevels; AXES], columns: &[TrialColumn]) -> Result<Vec<TypePtr>, ParquetError> {
    let axis = |axis: &AxisLevels| match axis.numbers() {
        Some(_) => required(axis.name, Physical::DOUBLE),
        None => required(axis.name, Physical::BYTE_ARRAY),
    };
    let result = |column: &TrialColumn| match column.kind {
        ColumnKind::Number => optional(&column.name, Physical::DOUBLE),
        ColumnKind::Count => optional(&column.name, Physical::INT32),
        ColumnKind::Word(_) => optional(&column.name, Physical::BYTE_ARRAY),
    };
    let numbers = ["cell", "trial", "block"].into_iter().map(|name| required(name, Physical::INT64));
    let sigmas = ["sigma_translation_um", "sigma_rotation_urad"]
        .into_iter()
        .map(|name| optional(name, Physical::DOUBLE));
    numbers.chain(levels.iter().map(axis)).chain(sigmas).chain(columns.iter().map(result)).collect()
}

fn properties(runner: &Runner) -> io::Result<WriterProperties> {
    let study = runner.study();
    let pair = |key: &str, value: String| KeyValue::new(key.to_owned(), value);
    let mut metadata = vec![
        pair("format", FORMAT.to_owned()),
        pair("title", study.title.clone()),
        pair("study_sha256", study.hash().to_owned()),
        pair("program", format!("hexbench {}", env!("CARGO_PKG_VERSION"))),
        pair("seed", study.seed.to_string()),
        pair("trials_per_cell", study.trials.to_string()),
        pair("redraw", study.redraw.to_string()),
        pair("task", study.task.name().to_owned()),
        pair("fields", serde_json::to_string(&fields(runner))?),
    ];
    let files = study.inputs.iter().filter(|(name, _)| *name != crate::sweep::study::STUDY_FILE);
    metadata.extend(files.map(|(name, hash)| pair(&format!("sha256:{name}"), hash.clone())));
    let plain = |builder: WriterPropertiesBuilder, column: &TrialColumn| {
        let path = ColumnPath::from(column.name.as_str());
        builder.set_column_dictionary_enabled(path.clone(), false).set_column_encoding(path, Encoding::PLAIN)
    };
    // Numbers that are all different gain nothing from a dictionary; indices are those of a block.
    let noisy =
        runner.columns().iter().filter(|c| c.kind == ColumnKind::Number && !c.name.starts_with(PREFIX));
    Ok(noisy.fold(hexbench_report::table::parquet::properties(metadata), plain).build())
}

/// Name, unit and meaning of every column.
fn fields(runner: &Runner) -> serde_json::Value {
    let head = [
        ("cell", "1", "number of the cell, from 0"),
        ("trial", "1", "number of the trial within its cell, from 0"),
        (
            "block",
            "1",
            "trials of a cell with the same number share machine, random poses, surroundings and effect",
        ),
        (
            "sigma_translation_um",
            "um",
            "standard deviation of one reading of a translation; null where sensors read",
        ),
        (
            "sigma_rotation_urad",
            "urad",
            "standard deviation of one reading of a rotation; null where sensors read",
        ),
    ];
    let axes = runner.study().axes.levels().map(|axis| (axis.name, "", "value on this axis of the study"));
    let one = |(name, unit, meaning): (&str, &str, &str)| {
        (name.to_owned(), serde_json::json!({ "unit": unit, "meaning": meaning }))
    };
    let results = runner.columns().iter().map(|c| one((&c.name, c.unit, c.meaning)));
    head.into_iter().chain(axes).map(one).chain(results).collect::<serde_json::Map<_, _>>().into()
}
