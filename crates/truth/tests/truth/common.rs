//! Reads a case folder plainly, independent of the workspace's own readers.

use std::{collections::HashMap, fs, path::PathBuf};

use hexbench_core::{Approach, Hexapod, Metrology, Pose, Vector3, Vector6, Wrench};
use hexbench_truth::{Situation, World, campaign};
use serde_json::Value;

pub(crate) struct Row {
    pub(crate) situation: Situation,
    pub(crate) measured: Vector6,
}

pub(crate) fn folder(case: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(case)
}

pub(crate) fn truth(case: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(folder(case).join("truth.json")).unwrap()).unwrap()
}

pub(crate) fn stiffness(truth: &Value) -> [f64; 6] {
    numbers(&truth["leg_stiffness_N_per_um"]).map(|k| k * 1e6)
}

pub(crate) fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|i| value[i].as_f64().unwrap())
}

pub(crate) fn hexapod(case: &str) -> Hexapod {
    let text = fs::read_to_string(folder(case).join("hexapod.toml")).unwrap();
    let table: toml::Table = text.parse().unwrap();
    let joints = |key: &str| {
        let rows = table["geometry"][key].as_array().unwrap();
        std::array::from_fn(|i| {
            let number = |k: usize| {
                let v = &rows[i].as_array().unwrap()[k];
                v.as_float().unwrap_or_else(|| v.as_integer().unwrap() as f64) * 1e-3
            };
            Vector3::new(number(0), number(1), number(2))
        })
    };
    Hexapod {
        metrology: Some(Metrology { sigma_translation: 0.5e-6, sigma_rotation: 3e-6 }),
        ..Hexapod::of_joints(case, joints("base_joints_mm"), joints("platform_joints_mm"))
    }
}

pub(crate) fn rows(case: &str, file: &str) -> Vec<Row> {
    let text = fs::read_to_string(folder(case).join(file)).unwrap();
    let mut lines = text.lines();
    let head: Vec<&str> = lines.next().unwrap().split(',').collect();
    lines
        .map(|line| row(&head.iter().copied().zip(line.split(',').map(|x| x.parse().unwrap())).collect()))
        .collect()
}

fn row(cell: &HashMap<&str, f64>) -> Row {
    let six = |prefix: &str, names: [&str; 6], units: [f64; 6]| {
        std::array::from_fn(|k| {
            cell.get(&*format!("{prefix}{}", names[k])).copied().unwrap_or(0.0) * units[k]
        })
    };
    let (mm, deg, um) = (1e-3, 1_f64.to_radians(), 1e-6);
    let pose = ["a_mm", "b_mm", "c_mm", "alpha_deg", "beta_deg", "gamma_deg"];
    let wrench = ["fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm"];
    let absolute = cell.contains_key("measured_a_mm");
    let measured = if absolute {
        six("measured_", pose, [mm, mm, mm, deg, deg, deg])
    } else {
        six("d", ["a_um", "b_um", "c_um", "alpha_urad", "beta_urad", "gamma_urad"], [um; 6])
    };
    Row {
        situation: Situation {
            pose: Pose::from_array(six("", pose, [mm, mm, mm, deg, deg, deg])),
            wrench: Wrench::from_array(six("", wrench, [1.0; 6])),
            reference: Wrench::from_array(six("ref_", wrench, [1.0; 6])),
            approach: cell.get("approach").and_then(|sign| Approach::of_sign(*sign)).unwrap_or_default(),
            overload: Approach::OVERLOAD,
            delta_t: cell.get("delta_T_K").copied().unwrap_or(0.0),
            elapsed: cell.get("elapsed_s").copied().unwrap_or(0.0),
            reference_age: cell.get("ref_age_s").copied(),
        },
        measured: Vector6::from_column_slice(&measured),
    }
}

/// Sum of squared whitened errors over number of readings, in each of the six directions.
pub(crate) fn chi2_by_direction(world: &World, rows: &[Row]) -> [f64; 6] {
    let mut sum = [0.0; 6];
    for row in rows {
        let error = row.measured - world.deflection(&row.situation).unwrap();
        for k in 0..6 {
            sum[k] += (error[k] / if k < 3 { 0.5e-6 } else { 3e-6 }).powi(2) / rows.len() as f64;
        }
    }
    sum
}

/// The plan behind a measurement file.
pub(crate) fn plan_rows(case: &str, file: &str) -> Vec<campaign::PlanRow> {
    let rows = rows(case, file).into_iter();
    rows.map(|row| campaign::PlanRow::alone(0, 0, row.situation)).collect()
}

/// Six points of a truth file.
pub(crate) fn points(value: &Value) -> [[f64; 3]; 6] {
    std::array::from_fn(|i| numbers(&value[i]))
}
