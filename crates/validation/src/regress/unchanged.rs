//! Runs of the unchanged program with fresh seeds: how often do they fail?

use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::Path;

use hexbench_core::files::text_hash;
use serde::{Deserialize, Serialize};

use super::baseline::Baseline;
use super::comparison::{Comparison, Finding};
use super::rule::Verdict;

/// What became of one run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Unchanged {
    /// Its seed.
    pub seed: u64,
    /// Digest of the baseline it was compared with.
    pub baseline: String,
    /// Limits that failed.
    pub worse: Vec<String>,
    /// Limits better than chance explains.
    pub better: Vec<String>,
    /// Smallest probability among all limits.
    pub least: f64,
    /// Its limit.
    pub least_of: String,
    /// Probability of every limit in which chance takes part.
    pub chances: Vec<f64>,
}

/// Digest of a baseline, to tell runs beside it from runs beside another.
pub fn digest(baseline: &Baseline) -> String {
    const DIGITS: usize = 16;
    let text = serde_json::to_string(&baseline.limits).unwrap_or_default();
    text_hash(&text).chars().take(DIGITS).collect()
}

impl Unchanged {
    /// In short.
    pub fn of(comparison: &Comparison, baseline: &Baseline) -> Self {
        let titles = |verdict| comparison.of(verdict).map(|f: &Finding| f.title.clone()).collect();
        let least = comparison.least_probable();
        Self {
            seed: comparison.seed,
            baseline: digest(baseline),
            worse: titles(Verdict::Worse),
            better: titles(Verdict::Better),
            least: least.map_or(1.0, |l| l.0),
            least_of: least.map(|l| l.1.title.clone()).unwrap_or_default(),
            chances: comparison.findings.iter().filter_map(|f| f.chance).collect(),
        }
    }

    /// Adds a line to a log.
    ///
    /// # Errors
    /// Those of the file.
    pub fn append(&self, path: &Path) -> io::Result<()> {
        let line = serde_json::to_string(self)? + "\n";
        OpenOptions::new().create(true).append(true).open(path)?.write_all(line.as_bytes())
    }
}

/// Runs of a log beside this baseline; a last line that was cut off when a study was stopped is passed over.
///
/// # Errors
/// Those of the file; no log is no error.
pub fn logged(path: &Path, baseline: &Baseline) -> io::Result<Vec<Unchanged>> {
    let text = match std::fs::read_to_string(path) {
        Err(cause) if cause.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        text => text?,
    };
    let wanted = digest(baseline);
    let lines = text.lines().filter_map(|line| serde_json::from_str::<Unchanged>(line).ok());
    Ok(lines.filter(|run| run.baseline == wanted).collect())
}
