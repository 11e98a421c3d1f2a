//! What columns are called in the tables of others: a map to the names that are read.

use std::path::Path;

use super::column_name::{Named, read_column_name, without_brackets};
use super::error::Fault;
use super::toml_file::{Format, read_toml};
use super::toml_value::{Item, KeyUnit};
use super::units::unit_named;
use super::{FileError, FileProblem};

/// Most rows of a table, unless more are asked for: a gigabyte of readings.
const MOST_ROWS: usize = 5_000_000;

/// What a table of others is called within, and how long it may be: names in it, and the names they stand for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ColumnNames {
    pairs: Vec<(String, String)>,
    most_rows: usize,
}

impl Default for ColumnNames {
    fn default() -> Self {
        Self { pairs: Vec::new(), most_rows: MOST_ROWS }
    }
}

const FORMAT: Format =
    Format { name: "columns/1", keys: &[KeyUnit::plain("format"), KeyUnit::plain("column")] };
const COLUMN: &[KeyUnit] = &[KeyUnit::plain("name"), KeyUnit::plain("is")];

impl ColumnNames {
    /// The name that is read for a name in a table.
    pub(crate) fn here<'a>(&'a self, text: &'a str) -> &'a str {
        let named = self.pairs.iter().find(|(name, _)| name.trim().eq_ignore_ascii_case(text.trim()));
        named.map_or(text, |(_, is)| is)
    }

    /// The same of a table that may have so many rows, in place of five million.
    #[must_use]
    pub fn with_most_rows(self, most_rows: usize) -> Self {
        Self { most_rows, ..self }
    }

    /// How many rows a table may have.
    pub(crate) fn most_rows(&self) -> usize {
        self.most_rows
    }
}

/// Reads a map of names, format `columns/1`.
///
/// # Errors
/// The first thing that is wrong, with line, value and next step; a name that is mapped twice, a unit that the name contradicts.
pub fn read_column_names(path: &Path) -> Result<ColumnNames, FileError> {
    read_toml(path, FORMAT, |top| {
        let columns = top.require("column")?.list()?;
        let pairs = columns.iter().map(pair).collect::<Result<Vec<_>, _>>()?;
        match (0..pairs.len()).find(|&k| pairs[..k].iter().any(|(name, _)| *name == pairs[k].0)) {
            None => Ok(ColumnNames { pairs, ..ColumnNames::default() }),
            Some(twice) => {
                let rule = format!("\"{}\" stands for two columns", pairs[twice].0);
                Err(columns[twice].breaks(rule, "Keep one of the two entries."))
            }
        }
    })
}

fn pair(item: &Item<'_>) -> Result<(String, String), Fault> {
    let section = item.section("[[column]]", COLUMN)?;
    let name = section.require("name")?.string()?.to_owned();
    let is = section.require("is")?;
    let here = is.string()?.to_owned();
    // The columns of sensors are known with their machine only.
    if let Named::Known(_, unit) = read_column_name(&here).map_err(|problem| is.fault(problem))? {
        let stated = without_brackets(&name).1.and_then(|text| unit_named(text, unit.kind));
        if stated.is_some_and(|stated| stated != unit) {
            return Err(is.fault(FileProblem::Rule {
                rule: format!("{name} has a different unit from {here}"),
                next: "Write the unit of the numbers in the table.".into(),
            }));
        }
    }
    Ok((name, here))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Hexapod;
    use crate::files::{read_campaign_named, read_measurements};

    fn map(text: &str) -> Result<ColumnNames, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("map.toml");
        std::fs::write(&path, format!("format = \"columns/1\"\n{text}")).unwrap();
        read_column_names(&path).map_err(|error| format!("{}; {}", error.message(), error.next_step()))
    }

    const HERE: &str = "a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,\
                        da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad";

    #[test]
    fn a_table_with_other_names_is_read_as_the_same() {
        let row = "1,2,3,0.1,0.2,0.3,0,0,-100,0,0,0,1,2,3,4,5,6";
        let folder = tempfile::tempdir().unwrap();
        let [here, theirs] = ["here.csv", "theirs.csv"].map(|name| folder.path().join(name));
        std::fs::write(&here, format!("{HERE}\n{row}\n")).unwrap();
        let other = HERE.replace("a_mm,b_mm,c_mm,alpha_deg", "X [mm],Y [mm],Z,Rx");
        std::fs::write(&theirs, format!("{other}\n{row}\n")).unwrap();
        let hint = read_measurements(&theirs).unwrap_err().next_step();
        assert!(
            hint.contains("--columns: X [mm] is a_mm, Y [mm] is b_mm, Z is c_mm, Rx is alpha_deg"),
            "{hint}"
        );
        let names = map("column = [{name = \"x [mm]\", is = \"a_mm\"}, {name = \"Y [mm]\", is = \"b_mm\"}, \
             {name = \"Z\", is = \"c_mm\"}, {name = \"Rx\", is = \"alpha_deg\"}]")
        .unwrap();
        let machine = Hexapod::of_joints("m", [crate::Vector3::zeros(); 6], [crate::Vector3::zeros(); 6]);
        let read = read_campaign_named(&machine, &theirs, &names).unwrap();
        let expected = read_measurements(&here).unwrap();
        assert_eq!(read.dataset.observations, expected.dataset.observations);
        assert!(read.warnings.is_empty(), "{:?}", read.warnings);
    }

    #[test]
    fn a_table_of_more_rows_than_asked_for_is_refused_at_the_first_of_them() {
        let row = "1,2,3,0.1,0.2,0.3,0,0,-100,0,0,0,1,2,3,4,5,6";
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("long.csv");
        std::fs::write(&path, format!("{HERE}\n{row}7\n\n{row}8\n{row}9\n")).unwrap();
        let machine = Hexapod::of_joints("m", [crate::Vector3::zeros(); 6], [crate::Vector3::zeros(); 6]);
        let read = |most| read_campaign_named(&machine, &path, &ColumnNames::default().with_most_rows(most));
        assert_eq!(read(3).unwrap().dataset.observations.len(), 3);
        let error = read(2).unwrap_err();
        assert_eq!(error.message(), "line 5: the table has more than 2 rows");
        assert!(error.next_step().contains("--max-rows"), "{}", error.next_step());
    }

    #[test]
    fn a_wrong_map_is_told_with_its_place() {
        let table = [
            ("column = [{name = \"X\", is = \"a\"}]", "has no unit"),
            ("column = [{name = \"X [um]\", is = \"a_mm\"}]", "X [um] has a different unit from a_mm"),
            (
                "column = [{name = \"X\", is = \"a_mm\"}, {name = \"X\", is = \"b_mm\"}]",
                "\"X\" stands for two columns",
            ),
            ("column = [{name = \"X\", is = \"dapha_urad\"}]", "probably \"dalpha_urad\""),
            ("", "the key \"column\" is missing"),
        ];
        for (text, message) in table {
            let said = map(text).unwrap_err();
            assert!(said.contains(message), "{said}");
        }
    }
}
