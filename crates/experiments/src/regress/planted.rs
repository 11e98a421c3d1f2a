//! Faults planted on purpose, and what a run made of each.

use std::io;
use std::path::Path;

use super::baseline::Baseline;
use super::comparison::{RunComparison, of_samples};
use super::gathered::LimitSample;
use super::limit::RegressLimit;
use super::sample::CondensedValues;
use super::suite::RegressSuite;
use crate::alarm::LimitVerdict;

/// One planted fault.
#[derive(Debug, Clone, PartialEq)]
pub struct Planted {
    /// Name of its patch.
    pub name: String,
    /// What it does, from the head of the patch.
    pub text: String,
    /// The run with it, judged beside the present baseline.
    pub comparison: RunComparison,
}

impl Planted {
    /// Limits that failed.
    pub fn failed(&self) -> usize {
        self.comparison.of(LimitVerdict::Worse).count()
    }
}

/// Every fault of a folder of patches with its run in `NAME.json` of a folder of results; the first line of a patch says what it
/// does. Faults without a run are left out.
///
/// # Errors
/// Those of the files; [`io::ErrorKind::InvalidData`] for a result that is none.
pub fn read(
    (patches, results): (&Path, &Path),
    suite: &RegressSuite,
    limits: &[RegressLimit],
    baseline: &Baseline,
) -> io::Result<Vec<Planted>> {
    let mut files: Vec<_> =
        std::fs::read_dir(patches)?.map(|f| f.map(|f| f.path())).collect::<Result<_, _>>()?;
    files.retain(|path| path.extension().is_some_and(|e| e == "patch"));
    files.sort();
    let mut all = Vec::new();
    for patch in files {
        let name = patch.file_stem().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        let result = results.join(format!("{name}.json"));
        if !result.is_file() {
            continue;
        }
        let text = std::fs::read_to_string(&patch)?.lines().next().unwrap_or_default().to_owned();
        let invalid = |e| io::Error::new(io::ErrorKind::InvalidData, e);
        let run: RunComparison = serde_json::from_str(&std::fs::read_to_string(&result)?).map_err(invalid)?;
        let samples: Vec<LimitSample> = limits.iter().map(|limit| sample_of(limit, &run)).collect();
        let comparison = of_samples(suite, limits, (&samples, run.seed), baseline, &run.hexbench);
        all.push(Planted { name, text, comparison });
    }
    Ok(all)
}

/// Sample of a limit in a run; nothing when the run did not have it.
fn sample_of(limit: &RegressLimit, run: &RunComparison) -> LimitSample {
    let found = run.findings.iter().find(|f| f.id == limit.id).map(|f| f.sample.clone());
    let sample = found.unwrap_or_else(|| CondensedValues::of(limit.test, &[]));
    LimitSample { first: sample.clone(), sample, fingerprint: String::new() }
}
