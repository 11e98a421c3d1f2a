//! Poses and readings that stand out.

use std::collections::BTreeMap;

use serde::Serialize;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::JudgedModel;
use crate::estimation::residuals::typical_square;

/// Poses listed.
const POSES: usize = 5;
/// Chance that a clean file of any size has a candidate.
const CHANCE: f64 = 0.01;

/// A pose with a large error.
#[derive(Debug, Clone, Serialize)]
pub struct WorstPose {
    /// Its number in the file.
    pub pose: i64,
    /// Line of its first reading.
    pub line: u64,
    /// Readings at it.
    pub readings: usize,
    /// Root mean square residual in units of the noise.
    pub whitened_rms: f64,
}

/// A reading far from the others.
#[derive(Debug, Clone, Serialize)]
pub struct Outlier {
    /// Line of the file.
    pub line: u64,
    /// Largest residual in units of the noise.
    pub z: f64,
    /// Chance of such a reading among all of them.
    pub p: f64,
}

/// Poses with the largest errors, worst first.
pub fn worst_poses(judged: &JudgedModel<'_>) -> Vec<WorstPose> {
    let mut poses: BTreeMap<i64, (u64, usize, f64)> = BTreeMap::new();
    let mut numbers: BTreeMap<i64, usize> = BTreeMap::new();
    for r in &judged.rows {
        let o = &judged.data.observations[r.row];
        let entry = poses.entry(o.pose_id).or_insert((o.line, 0, 0.0));
        entry.1 += 1;
        entry.2 += r.whitened.norm_squared();
        *numbers.entry(o.pose_id).or_default() += r.numbers();
    }
    let rms = |pose: i64, sum: f64| (sum / numbers[&pose].max(1) as f64).sqrt();
    let mut all: Vec<WorstPose> = poses
        .into_iter()
        .map(|(pose, (line, readings, sum))| WorstPose { pose, line, readings, whitened_rms: rms(pose, sum) })
        .collect();
    all.sort_by(|a, b| b.whitened_rms.total_cmp(&a.whitened_rms));
    all.truncate(POSES);
    all
}

/// Readings whose distance over six coordinates is beyond chance, against the typical distance in the file, so that a bad
/// model does not make every reading suspect.
pub fn outliers(judged: &JudgedModel<'_>) -> Vec<Outlier> {
    let laws: Vec<Option<ChiSquared>> = (0..=6).map(|n| ChiSquared::new(f64::from(n)).ok()).collect();
    let typical = typical_square(&judged.rows).max(1.0);
    let n = judged.rows.len() as f64;
    let candidate = |r: &crate::estimation::residuals::Residual| {
        let law = laws[r.numbers()].as_ref()?;
        let p = (n * law.sf(r.whitened.norm_squared() / typical)).min(1.0);
        let line = judged.data.observations[r.row].line;
        (p < CHANCE).then(|| Outlier { line, z: r.whitened.amax(), p })
    };
    let mut all: Vec<Outlier> = judged.rows.iter().filter_map(candidate).collect();
    all.sort_by(|a, b| a.p.total_cmp(&b.p).then(b.z.total_cmp(&a.z)));
    all
}
