//! Columns that only a table of loads has: records, and masses with the point and the direction of their pull.

use std::ops::Range;

use super::column_name::without_brackets;
use super::line::Line;
use super::stated_unit::stated_unit;
use super::units::Unit;
use super::{Dimension, FileProblem};
use crate::{HungMasses, LoadRow, Vector3};

/// A column of a table of loads.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LoadSource {
    place: usize,
    unit: &'static Unit,
}

/// Name, kind, and name with the usual unit.
const OWN: [(&str, Dimension, &str); 10] = [
    ("record", Dimension::Number, "record"),
    ("ref_record", Dimension::Number, "ref_record"),
    ("mass", Dimension::Mass, "mass_kg"),
    ("ref_mass", Dimension::Mass, "ref_mass_kg"),
    ("load_x", Dimension::Length, "load_x_mm"),
    ("load_y", Dimension::Length, "load_y_mm"),
    ("load_z", Dimension::Length, "load_z_mm"),
    ("pull_x", Dimension::Number, "pull_x"),
    ("pull_y", Dimension::Number, "pull_y"),
    ("pull_z", Dimension::Number, "pull_z"),
];
const RECORD: usize = 0;
const REF_RECORD: usize = 1;
const MASSES: Range<usize> = 2..4;
const POINT: Range<usize> = 4..7;
const PULL: Range<usize> = 7..10;

/// The column a header cell names; none when it is one that other tables have too.
pub(crate) fn load_column(text: &str) -> Option<Result<LoadSource, FileProblem>> {
    let (base, bracketed) = without_brackets(text.trim());
    let base = base.trim().replace([' ', '-'], "_");
    let lower = base.to_lowercase();
    let (place, unit) = OWN.iter().enumerate().find_map(|(place, (name, ..))| {
        let rest = lower.strip_prefix(name)?;
        let unit = if rest.is_empty() { bracketed } else { base[name.len()..].strip_prefix('_') };
        (rest.is_empty() || unit.is_some()).then_some((place, unit))
    })?;
    let (name, kind, usual) = OWN[place];
    Some(stated_unit(name, kind, usual.to_owned(), unit).map(|unit| LoadSource { place, unit }))
}

/// Whether masses are given, and whether those of the reference state are.
pub(crate) fn has_masses(sources: &[Option<LoadSource>]) -> [bool; 2] {
    [0, 1].map(|k| fills(sources, MASSES.start + k))
}

/// True when rows are pairs of records.
pub(crate) fn has_reference(sources: &[Option<LoadSource>]) -> bool {
    fills(sources, REF_RECORD)
}

fn fills(sources: &[Option<LoadSource>], place: usize) -> bool {
    sources.iter().flatten().any(|source| source.place == place)
}

/// Columns that are given twice, needed and not there, or of no use alone.
pub(crate) fn refuse_incomplete(sources: &[Option<LoadSource>]) -> Result<(), FileProblem> {
    if !fills(sources, RECORD) {
        return Err(FileProblem::MissingColumns { names: vec![OWN[RECORD].2.to_owned()] });
    }
    let twice = (0..OWN.len()).find(|p| sources.iter().flatten().filter(|s| s.place == *p).count() > 1);
    if let Some(place) = twice {
        return Err(FileProblem::Rule {
            rule: format!("{} is given twice", OWN[place].0),
            next: "Keep one of the two columns.".into(),
        });
    }
    for (group, range) in [("load_", POINT), ("pull_", PULL)] {
        let given = range.clone().filter(|place| fills(sources, *place)).count();
        if given > 0 && given < range.len() {
            let missing = range.filter(|place| !fills(sources, *place)).map(|place| OWN[place].2.to_owned());
            return Err(FileProblem::IncompleteGroup { group, names: missing.collect() });
        }
        if given > 0 && has_masses(sources) == [false; 2] {
            return Err(FileProblem::Rule {
                rule: format!("{group} columns say where and how masses pull, and no mass is given"),
                next: "Add mass_kg (and ref_mass_kg), or give the whole wrench as fx_N ... mz_Nm.".into(),
            });
        }
    }
    Ok(())
}

/// Reads the own cells of a row; `number` reads one cell as a number.
///
/// # Errors
/// The cell that is wrong, and why.
pub(crate) fn load_row(
    sources: &[Option<LoadSource>],
    line: &Line<'_>,
    mut number: impl FnMut(&str) -> Result<f64, FileProblem>,
) -> Result<LoadRow, (usize, FileProblem)> {
    let (mut names, mut values) = ([None, None], [0.0; OWN.len()]);
    values[PULL.end - 1] = -1.0;
    for (cell, source) in sources.iter().enumerate() {
        let Some(LoadSource { place, unit }) = source else { continue };
        let text = line.text(cell);
        if *place <= REF_RECORD {
            let name = Some(text.to_owned()).filter(|name| !name.is_empty());
            names[*place] = Some(name.ok_or((cell, FileProblem::EmptyCell))?);
            continue;
        }
        let value = number(text).map_err(|problem| (cell, problem))?;
        if MASSES.contains(place) && value < 0.0 {
            return Err((cell, negative_mass()));
        }
        values[*place] = unit.to_si(value);
    }
    let [record, reference] = names;
    let three = |range: Range<usize>| Vector3::from_column_slice(&values[range]);
    let pull = three(PULL);
    let hung = HungMasses {
        loaded: values[MASSES.start],
        reference: values[MASSES.start + 1],
        point: three(POINT),
        direction: pull.try_normalize(1e-9).ok_or((0, no_direction()))?,
    };
    Ok(LoadRow { line: line.number(), record: record.unwrap_or_default(), reference, hung })
}

fn negative_mass() -> FileProblem {
    FileProblem::Rule {
        rule: "a mass is not negative".into(),
        next: "Write 0 where nothing hangs; a pull upward is pull_z 1.".into(),
    }
}

fn no_direction() -> FileProblem {
    FileProblem::Rule {
        rule: "the direction of the pull has no length".into(),
        next: "Write the direction in which the rope leaves the platform, fixed axes; 0, 0, -1 is straight down.".into(),
    }
}
