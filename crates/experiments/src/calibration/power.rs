//! What becomes of an effect as it grows.

use hexbench_core::statistics::Proportion;
use hexbench_truth::campaign::CaseKind;

use super::{CalibrationRecord, Fate};

/// Borders of the distances, about equal steps of their logarithm.
pub const SIZES: [f64; 7] = [2.0, 3.5, 6.0, 10.0, 18.0, 33.0, 60.0];

/// Fates of one effect within a range of distances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DistanceRange {
    /// Borders of the distance.
    pub range: [f64; 2],
    /// Trials by fate, in the order of [`Fate::ALL`].
    pub fates: [usize; 7],
}

impl DistanceRange {
    fn of(records: &[&CalibrationRecord], range: [f64; 2]) -> Self {
        let mut fates = [0; 7];
        let inside = |r: &&&CalibrationRecord| r.distance.is_some_and(|d| (range[0]..range[1]).contains(&d));
        for r in records.iter().filter(inside) {
            fates[r.fate as usize] += 1;
        }
        Self { range, fates }
    }

    /// Trials with one of these fates, of all.
    pub fn share(&self, wanted: &[Fate]) -> Proportion {
        let hits = wanted.iter().map(|&fate| self.fates[fate as usize]).sum();
        Proportion { hits, of: self.fates.iter().sum() }
    }

    /// Geometric middle of the range.
    pub fn middle(&self) -> f64 {
        (self.range[0] * self.range[1]).sqrt()
    }
}

/// Fates of one effect, or of all of a kind together, over the distances.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// What was hidden.
    pub title: String,
    /// Its fates, smallest distances first.
    pub steps: Vec<DistanceRange>,
}

impl Curve {
    /// The curve of trials.
    pub fn of<'a>(title: &str, records: impl IntoIterator<Item = &'a CalibrationRecord>) -> Self {
        let all: Vec<&CalibrationRecord> = records.into_iter().collect();
        let step = |s: &[f64]| DistanceRange::of(&all, [s[0], s[1]]);
        Self { title: title.to_owned(), steps: SIZES.windows(2).map(step).collect() }
    }

    /// One curve for each hidden effect of a kind, in the order of first appearance.
    pub fn of_each(records: &[CalibrationRecord], kind: CaseKind) -> Vec<Self> {
        let of_kind = || records.iter().filter(move |r| r.kind == kind);
        let mut names: Vec<String> = Vec::new();
        for name in of_kind().map(CalibrationRecord::hidden_words) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names.iter().map(|name| Self::of(name, of_kind().filter(|r| r.hidden_words() == *name))).collect()
    }
}
