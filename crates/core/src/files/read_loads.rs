//! Reading the loads of a campaign.

use std::io::BufRead;
use std::path::Path;

use super::FileError;
use super::Warning;
use super::column_names::ColumnNames;
use super::error::Fault;
use super::header::{GroupPurpose, Reads};
use super::load_columns::has_masses;
use super::read_measurements::rows_of;
use super::records::Records;
use super::source::{Noticed, of_records, read_source};
use crate::{Hexapod, LoadTable};

impl Noticed for LoadTable {
    fn warnings(&mut self) -> Option<&mut Vec<Warning>> {
        Some(&mut self.warnings)
    }
}

/// Reads `loads.csv`, whose columns may have other names: which record is loaded and which is its reference, the commanded pose, wrenches or masses, and covariates.
/// Angles are those of the machine's convention.
///
/// # Errors
/// The first thing that is wrong, with line, column, value and next step.
pub fn read_loads(
    path: &Path,
    names: &ColumnNames,
    machine: Option<&Hexapod>,
) -> Result<LoadTable, FileError> {
    let read = |input: Box<dyn BufRead>| table(input, names, machine, path);
    read_source(path, GroupPurpose::Loads.usual_sheet(), read).map_err(|fault| fault.in_file(path))
}

/// The same of records; `path` stands for the file in messages.
///
/// # Errors
/// As [`read_loads`].
pub fn read_loads_records(
    records: &Records,
    names: &ColumnNames,
    machine: Option<&Hexapod>,
    path: &Path,
) -> Result<LoadTable, FileError> {
    of_records(records, |input| table(input, names, machine, path)).map_err(|fault| fault.in_file(path))
}

fn table(
    input: impl BufRead,
    names: &ColumnNames,
    machine: Option<&Hexapod>,
    path: &Path,
) -> Result<LoadTable, Fault> {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    let reads = Reads { names: Some(names), ..Reads::of(GroupPurpose::Loads, machine) };
    let mut table = rows_of(input, reads)?;
    let rows = std::mem::take(&mut table.loads);
    let [_, of_reference] = has_masses(&table.table.plan.of_loads);
    let mut reading = table.finish(&name)?;
    reading.dataset.columns.reference |= of_reference;
    Ok(LoadTable { dataset: reading.dataset, rows, warnings: reading.warnings })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<LoadTable, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("loads.csv");
        std::fs::write(&path, text).unwrap();
        read_loads(&path, &ColumnNames::default(), None).map_err(|error| error.message())
    }

    const POSE: &str = "a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg";

    #[test]
    fn masses_may_stand_for_the_wrench_and_records_may_have_any_name() {
        let head = format!("record,ref_record,{POSE},mass_g,ref_mass [kg],load_x_mm,load_y_mm,load_z_mm");
        let table = read(&format!("{head}\nR-02,R-01,1,2,3,0,0,0,22300,12.2,0,0,40\n")).unwrap();
        let row = &table.rows[0];
        assert_eq!((row.record.as_str(), row.reference.as_deref(), row.line), ("R-02", Some("R-01"), 2));
        assert!((row.hung.loaded - 22.3).abs() < 1e-12 && (row.hung.reference - 12.2).abs() < 1e-12);
        assert!((row.hung.point.z - 0.04).abs() < 1e-15 && (row.hung.direction.z + 1.0).abs() < 1e-15);
        assert!(table.dataset.columns.reference && table.warnings.is_empty(), "{:?}", table.warnings);
    }

    #[test]
    fn a_pulley_may_stand_beside_a_wrench() {
        let wrench = "fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm";
        let head = format!("record;{POSE};{wrench};mass_kg;pull_x;pull_y;pull_z").replace(',', ";");
        let table = read(&format!("{head}\n7;0;0;0;0;0;0;0;0;-10,5;0;0;0;2,5;3;0;4\n")).unwrap();
        let row = &table.rows[0];
        assert!((row.hung.direction.x - 0.6).abs() < 1e-15 && (row.hung.loaded - 2.5).abs() < 1e-15);
        assert!((table.dataset.observations[0].wrench.force.z + 10.5).abs() < 1e-12);
        assert!(row.reference.is_none());
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let row = "0,0,0,0,0,0";
        let table = [
            (format!("{POSE},mass_kg\n{row},1\n"), "required columns are missing: record"),
            (format!("record,{POSE}\n1,{row}\n"), "required columns are missing: fx_N"),
            (format!("record,{POSE},mass\n1,{row},1\n"), "line 1, column 8 (mass): the name has no unit"),
            (format!("record,{POSE},mass_N\n1,{row},1\n"), "mass is a mass"),
            (format!("record,{POSE},mass_kg,pull_x\n1,{row},1,1\n"), "the pull_ columns must be complete"),
            (
                format!("record,{POSE},mass_kg\n1,{row},-1\n"),
                "line 2, column 8 (mass_kg): \"-1\": a mass is not",
            ),
            (format!("record,{POSE},mass_kg\n,{row},1\n"), "line 2, column 1 (record): the cell is empty"),
            (format!("record,{POSE},mass_kg,mass_g\n1,{row},1,1\n"), "mass is given twice"),
        ];
        for (text, message) in table {
            let complaint = read(&text).unwrap_err();
            assert!(complaint.contains(message), "{complaint}");
        }
    }
}
