//! The folder of a case.

use std::{fmt::Write as _, fs, path::Path};

use hexbench_core::{Dataset, Hexapod, Observation, Vector3};

use super::Case;
use crate::TruthError;

impl Case {
    /// Writes `hexapod.toml`, `measurements.csv`, `holdout.csv` and `truth.json` to a folder, which is made.
    ///
    /// # Errors
    /// [`TruthError::File`].
    pub fn write(&self, folder: &Path) -> Result<(), TruthError> {
        let failed = |path: &Path, why: &dyn ToString| TruthError::File {
            path: path.display().to_string(),
            why: why.to_string(),
        };
        fs::create_dir_all(folder).map_err(|e| failed(folder, &e))?;
        let truth = serde_json::to_string_pretty(&self.truth).map_err(|e| failed(folder, &e))?;
        let files = [
            ("hexapod.toml", hexapod_toml(&self.hexapod, &self.spec.id)),
            ("measurements.csv", csv(&self.measurements)),
            ("holdout.csv", csv(&self.holdout)),
            ("truth.json", truth + "\n"),
        ];
        for (name, text) in files {
            let path = folder.join(name);
            fs::write(&path, text).map_err(|e| failed(&path, &e))?;
        }
        Ok(())
    }
}

/// The nominal machine in the format `hexapod/1`.
fn hexapod_toml(hexapod: &Hexapod, id: &str) -> String {
    let joints = |points: &[Vector3; 6]| {
        points.iter().fold(String::new(), |mut text, p| {
            let [x, y, z] = [p.x, p.y, p.z].map(|v| decimal(v * 1e3, 6));
            let _ = writeln!(text, "  [{x}, {y}, {z}],");
            text
        })
    };
    let mut text = format!(
        "format = \"hexapod/1\"\nname = \"case {id}\"\n\n[geometry]\nbase_joints_mm = [\n{}]\nplatform_joints_mm = [\n{}]\n",
        joints(&hexapod.base_joints),
        joints(&hexapod.platform_joints)
    );
    if let Some(m) = hexapod.metrology {
        let _ = write!(
            text,
            "\n[metrology]\nsigma_translation_um = {}\nsigma_rotation_urad = {}\n",
            decimal(m.sigma_translation * 1e6, 6),
            decimal(m.sigma_rotation * 1e6, 6)
        );
    }
    text
}

const POSE: &str = "pose,repeat,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm";
const REFERENCE: &str = "ref_fx_N,ref_fy_N,ref_fz_N,ref_mx_Nm,ref_my_Nm,ref_mz_Nm,approach";
const SURROUNDINGS: &str = "delta_T_K,elapsed_s";
const DEFLECTION: &str = "da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad";
const ABSOLUTE: &str =
    "measured_a_mm,measured_b_mm,measured_c_mm,measured_alpha_deg,measured_beta_deg,measured_gamma_deg";

/// Measurements in the format of deflections or of absolute poses.
fn csv(data: &Dataset) -> String {
    let mut text = if data.is_absolute() {
        format!("{POSE},{SURROUNDINGS},{ABSOLUTE}\n")
    } else {
        format!("{POSE},{REFERENCE},{SURROUNDINGS},{DEFLECTION}\n")
    };
    for row in &data.observations {
        text += &line(row, data.is_absolute());
        text.push('\n');
    }
    text
}

fn line(row: &Observation, absolute: bool) -> String {
    let pose = row.pose.to_array();
    let mut cells = vec![row.pose_id.to_string(), row.repeat.to_string()];
    cells.extend((0..3).map(|k| decimal(pose[k] * 1e3, 6)));
    cells.extend((3..6).map(|k| decimal(pose[k].to_degrees(), 6)));
    cells.extend(row.wrench.to_array().map(|x| decimal(x, 6)));
    if !absolute {
        cells.extend(row.reference.to_array().map(|x| decimal(x, 6)));
        cells.push(decimal(row.approach, 0));
    }
    cells.extend([row.delta_t, row.elapsed].map(|x| decimal(x, 6)));
    let m = row.measured;
    if absolute {
        cells.extend((0..3).map(|k| format!("{:.7}", m[k] * 1e3)));
        cells.extend((3..6).map(|k| format!("{:.9}", m[k].to_degrees())));
    } else {
        cells.extend(m.map(|x| format!("{:.6}", x * 1e6)));
    }
    cells.join(",")
}

/// A number with at most so many decimals and no trailing zeros.
fn decimal(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let short = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::decimal;

    #[test]
    fn numbers_are_written_short_and_exact() {
        assert_eq!(decimal(-0.0, 6), "0");
        assert_eq!(decimal(-119.682, 6), "-119.682");
        assert_eq!(decimal(100.0, 6), "100");
        assert_eq!(decimal(26.546_471_800_000_003, 6), "26.546472");
    }
}
