//! Figures of several runs, by case, as the baseline keeps them.

use std::collections::BTreeMap;

use hexbench_core::words::to_digits;
use serde::{Deserialize, Serialize};

use super::figure::FIGURES;
use crate::alarm::same_cases::RunValues;
use crate::challenge::score::CaseScore;

/// What stands for a case without the figure.
const NONE: &str = "-";

/// Figures by their names: one line for each run, with the value of every case, to six digits. Those that no case has are absent.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct GateValues(BTreeMap<String, Vec<String>>);

impl GateValues {
    /// Of the scores of runs over the same cases.
    pub fn of(runs: &[Vec<CaseScore>]) -> Self {
        let line = |run: &Vec<CaseScore>, value: fn(&CaseScore) -> Option<f64>| {
            run.iter().map(|case| value(case).map_or(NONE.to_owned(), written)).collect::<Vec<_>>().join(" ")
        };
        let lines =
            |f: &super::figure::GateFigure| runs.iter().map(|run| line(run, f.value)).collect::<Vec<_>>();
        let all = FIGURES.iter().map(|f| (f.id.to_owned(), lines(f)));
        let says = |lines: &Vec<String>| lines.iter().any(|l| l.split(' ').any(|cell| cell != NONE));
        Self(all.filter(|(_, lines)| says(lines)).collect())
    }

    /// Runs of a figure; none where no case has it.
    pub fn runs(&self, id: &str) -> Option<RunValues> {
        let cell = |cell: &str| cell.parse().ok();
        Some(self.0.get(id)?.iter().map(|line| line.split(' ').map(cell).collect()).collect())
    }

    /// Number of runs.
    pub fn count(&self) -> usize {
        self.0.values().map(Vec::len).next().unwrap_or(0)
    }

    /// True when all runs gave the same figures in every case.
    pub fn is_steady(&self) -> bool {
        self.0.values().all(|lines| lines.windows(2).all(|pair| pair[0] == pair[1]))
    }

    /// The first run alone.
    #[must_use]
    pub fn first(&self) -> Self {
        Self(self.0.iter().map(|(id, lines)| (id.clone(), lines[..1.min(lines.len())].to_vec())).collect())
    }

    /// One run with the smallest, which is the best, of the values that runs have.
    #[must_use]
    pub fn best_of(runs: &[Self]) -> Self {
        let mut best = runs.first().cloned().unwrap_or_default();
        for (id, lines) in &mut best.0 {
            let of_runs: Vec<Vec<&str>> =
                runs.iter().filter_map(|run| Some(run.0.get(id)?.first()?.split(' ').collect())).collect();
            let cases = of_runs.first().map_or(0, Vec::len);
            let smallest = |k: usize| {
                let cells = of_runs.iter().filter_map(|run| run.get(k).copied());
                cells.min_by(|a, b| number(a).total_cmp(&number(b))).unwrap_or(NONE)
            };
            *lines = vec![(0..cases).map(smallest).collect::<Vec<_>>().join(" ")];
        }
        best
    }

    /// Indices of the cases whose figures in the first run differ.
    pub fn differing(&self, other: &Self) -> Vec<usize> {
        let ids = self.0.keys().chain(other.0.keys());
        let mut all: Vec<usize> = ids.flat_map(|id| differing(self.0.get(id), other.0.get(id))).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Why it cannot be what it claims for so many cases and runs; none when it can.
    pub fn fault(&self, cases: usize, runs: usize) -> Option<String> {
        let unknown = self.0.keys().find(|id| !FIGURES.iter().any(|f| f.id == **id));
        if let Some(id) = unknown {
            return Some(format!("no figure is called `{id}`"));
        }
        self.0.iter().find_map(|(id, lines)| {
            if lines.len() != runs {
                return Some(format!("`{id}` has {} runs instead of {runs}", lines.len()));
            }
            lines.iter().find_map(|line| fault(line, cases)).map(|fault| format!("`{id}`: {fault}"))
        })
    }
}

/// Six digits, as short as they can be written: runs on other machines differ in the last bits of a number.
fn written(value: f64) -> String {
    let rounded = to_digits(value, 6);
    if rounded == 0.0 { "0".to_owned() } else { format!("{rounded}") }
}

/// What is absent is larger than everything.
fn number(cell: &str) -> f64 {
    cell.parse().unwrap_or(f64::INFINITY)
}

fn differing(a: Option<&Vec<String>>, b: Option<&Vec<String>>) -> Vec<usize> {
    let cells = |lines: Option<&Vec<String>>| -> Vec<String> {
        lines
            .and_then(|l| l.first())
            .map(|line| line.split(' ').map(str::to_owned).collect())
            .unwrap_or_default()
    };
    let (a, b) = (cells(a), cells(b));
    let cell = |cells: &[String], k: usize| cells.get(k).map_or(NONE, String::as_str).to_owned();
    (0..a.len().max(b.len())).filter(|&k| cell(&a, k) != cell(&b, k)).collect()
}

fn fault(line: &str, cases: usize) -> Option<String> {
    let cells: Vec<&str> = line.split(' ').collect();
    if cells.len() != cases {
        return Some(format!("{} values for {cases} cases", cells.len()));
    }
    let is_value =
        |cell: &&str| *cell == NONE || cell.parse::<f64>().is_ok_and(|v| v.is_finite() && v >= 0.0);
    cells.iter().find(|cell| !is_value(cell)).map(|cell| format!("`{cell}` is neither a value nor {NONE}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_written_to_six_digits_and_read_back() {
        for (value, expected) in [(0.0, "0"), (1.0, "1"), (0.012_345_67, "0.0123457"), (1.5e-7, "0.00000015")]
        {
            assert_eq!(written(value), expected);
        }
    }

    #[test]
    fn what_cannot_be_values_is_told() {
        let of = |line: &str| GateValues(BTreeMap::from([("wrong".to_owned(), vec![line.to_owned()])]));
        assert_eq!(of("0 1 -").fault(3, 1), None);
        for (line, expected) in
            [("0 1", "2 values for 3 cases"), ("0 x 1", "`x` is neither"), ("0 -1 1", "`-1`")]
        {
            assert!(
                of(line).fault(3, 1).is_some_and(|f| f.contains(expected)),
                "{line}: {:?}",
                of(line).fault(3, 1)
            );
        }
        assert!(of("0 1 -").fault(3, 2).is_some_and(|f| f.contains("1 runs instead of 2")));
    }
}
