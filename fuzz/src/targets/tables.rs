//! Tables: measurements, balls, loads, poses to predict; as text and in workbooks.

use std::collections::BTreeSet;

use hexbench_core::files::{
    ColumnNames, UNITS, measurements_to_csv, read_balls, read_column_names, read_conditions, read_joints,
    read_loads, read_measurements, read_measurements_from, read_plan,
};
use hexbench_core::{Dataset, Observation};

use crate::scratch;

fn assert_finite(data: &Dataset) {
    for row in &data.observations {
        let sigma = row.sigma.unwrap_or([1.0; 6]);
        let numbers =
            [row.pose.to_array(), row.wrench.to_array(), row.reference.to_array(), row.measured, sigma];
        assert!(numbers.as_flattened().iter().all(|x| x.is_finite()), "line {}", row.line);
        assert!(sigma.iter().all(|s| *s > 0.0), "line {}: {sigma:?}", row.line);
    }
}

/// Rows that differ: two with the same numbers in other digits are written alike, and one of them is read.
fn different(data: &Dataset) -> usize {
    let text = |row: &Observation| format!("{:?}", Observation { line: 0, ..*row });
    data.observations.iter().map(text).collect::<BTreeSet<_>>().len()
}

/// What is read of full poses is written so that it is read as the same number of readings.
pub(super) fn measurements(bytes: &[u8]) -> bool {
    let Ok(read) = read_measurements_from(bytes, "measurements.csv") else { return false };
    assert_finite(&read.dataset);
    let mut text = Vec::new();
    measurements_to_csv(&mut text, &read.dataset).expect("memory takes everything");
    let again = read_measurements_from(text.as_slice(), "again.csv");
    let rows = again.map(|again| different(&again.dataset));
    assert_eq!(rows.ok(), Some(different(&read.dataset)), "{}", String::from_utf8_lossy(&text));
    true
}

/// The same bytes as a packed sheet.
pub(super) fn workbook(bytes: &[u8]) -> bool {
    let Ok(read) = scratch::file("measurements.xlsx", bytes, read_measurements) else { return false };
    assert_finite(&read.dataset);
    true
}

pub(super) fn balls(bytes: &[u8]) -> bool {
    let read = |path: &std::path::Path| read_balls(path, &ColumnNames::default(), UNITS.first());
    let Ok(table) = scratch::file("balls.csv", bytes, read) else { return false };
    let mut balls = table.records.iter().flat_map(|record| &record.balls);
    assert!(balls.all(|ball| ball.centre.iter().all(|x| x.is_finite())));
    true
}

/// Tables of poses and loads in every sense a command takes them in, or as a map of their names.
pub(super) fn loads(bytes: &[u8]) -> bool {
    scratch::file("loads.csv", bytes, |path| {
        let names = read_column_names(path);
        let loads = read_loads(path, &ColumnNames::default(), None).map(|read| read.dataset);
        let conditions = read_conditions(path).map(|read| read.dataset);
        let plan = read_plan(path, None).map(|read| read.dataset);
        let tables = [loads, conditions, plan];
        tables.iter().flatten().for_each(assert_finite);
        let joints = read_joints(path);
        if let Ok(joints) = &joints {
            assert!(joints.as_flattened().iter().all(|joint| joint.iter().all(|x| x.is_finite())));
        }
        names.is_ok() || joints.is_ok() || tables.iter().any(Result::is_ok)
    })
}
