//! Reading poses and loads that have not been measured.

use super::FileError;
use super::column_names::ColumnNames;
use super::header::{GroupPurpose, Reads};
use super::read_measurements::read_named;
use super::table::TableReading;
use crate::Hexapod;
use std::path::Path;

/// Reads a table of poses and wrenches to predict: the columns of `measurements.csv` without the measured ones.
///
/// Measured values and standard deviations are passed over when they are there, so that a file of measurements may be
/// predicted as it is. Every row is kept, copies too. `measured` is zero in every row.
///
/// # Errors
/// The first thing that is wrong, with line, column, value and next step.
pub fn read_conditions(path: &Path) -> Result<TableReading, FileError> {
    read_conditions_named(path, &ColumnNames::default(), None)
}

/// The same of a table whose columns have other names, and of which the columns that sensors of a machine fill are passed over too.
///
/// # Errors
/// As [`read_conditions`].
pub fn read_conditions_named(
    path: &Path,
    names: &ColumnNames,
    machine: Option<&Hexapod>,
) -> Result<TableReading, FileError> {
    let reads = Reads { names: Some(names), ..Reads::of(GroupPurpose::Conditions, machine) };
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    read_named(path, &name, reads).map_err(|fault| fault.in_file(path))
}

/// Reads a plan: poses and loads that are to be measured.
///
/// As [`read_conditions_named`], but standard deviations are kept: they say how well the rows will be read.
///
/// # Errors
/// As [`read_conditions`].
pub fn read_plan(path: &Path, machine: Option<&Hexapod>) -> Result<TableReading, FileError> {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    read_named(path, &name, Reads::of(GroupPurpose::Plan, machine)).map_err(|fault| fault.in_file(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<TableReading, FileError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("poses.csv");
        std::fs::write(&path, text).unwrap();
        read_conditions(&path)
    }

    const HEADER: &str = "a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm";

    #[test]
    fn rows_need_no_measurement_and_copies_stay() {
        let row = "1,2,3,0,0,0,0,0,-100,0,0,0";
        let reading = read(&format!("{HEADER}\n{row}\n{row}\n")).unwrap();
        assert_eq!(reading.dataset.observations.len(), 2);
        assert!(reading.warnings.is_empty(), "{:?}", reading.warnings);
        assert_eq!(reading.dataset.observations[0].pose.to_array()[1].to_bits(), 0.002_f64.to_bits());
    }

    #[test]
    fn measured_columns_are_passed_over() {
        let reading = read(&format!("{HEADER},da_um,note\n1,2,3,0,0,0,0,0,-100,0,0,0,7,x\n")).unwrap();
        assert!(reading.dataset.observations[0].measured.iter().all(|m| *m == 0.0));
    }

    #[test]
    fn a_plan_keeps_its_standard_deviations() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan.csv");
        let columns = "da_um,sigma_translation_um,sigma_rotation_urad";
        std::fs::write(&path, format!("{HEADER},{columns}\n1,2,3,0,0,0,0,0,-100,0,0,0,7,0.5,3\n")).unwrap();
        let dataset = read_plan(&path, None).unwrap().dataset;
        let sigma = dataset.observations[0].sigma.unwrap();
        assert!(dataset.columns.sigma && (sigma[0] * 1e6 - 0.5).abs() < 1e-12, "{sigma:?}");
        assert!(read_conditions(&path).unwrap().dataset.observations[0].sigma.is_none());
    }

    #[test]
    fn a_missing_load_is_named() {
        let message =
            read("a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg\n0,0,0,0,0,0\n").unwrap_err().to_string();
        assert!(message.contains("fz_N"), "{message}");
    }
}
