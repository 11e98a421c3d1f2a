//! Levels of noise that differ: from number to number, or with the size of a reading.

use hexbench_core::Vector6;

use super::{Judge, Kind, LogOfProduct, MISSTATED, Statement};

/// Shares of a reading by which it scatters.
const SHARES: [f64; 12] = [1e-3, 1.5e-3, 2e-3, 3e-3, 4e-3, 6e-3, 8e-3, 0.012, 0.016, 0.024, 0.035, 0.05];

/// A level of some numbers of a reading, and another of the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::inference::examination) struct Levels {
    /// The number that has a level of its own; none: the three rotations.
    pub(in crate::inference::examination) alone: Option<usize>,
    /// Standard deviation over the stated one.
    pub(in crate::inference::examination) own: f64,
    /// The same of the others.
    pub(in crate::inference::examination) others: f64,
}

impl Levels {
    /// Of each of the six numbers.
    pub(in crate::inference::examination) fn of_numbers(&self) -> Vector6 {
        Vector6::from_fn(|k, _| if is_apart(self.alone, k) { self.own } else { self.others })
    }
}

fn is_apart(alone: Option<usize>, number: usize) -> bool {
    alone.map_or(number >= 3, |one| one == number)
}

impl Judge {
    /// Some numbers have another level than the others: rotations come from other sensors than translations, one coordinate may be
    /// seen worse than the rest.
    pub(super) fn levels(&self) -> Vec<Statement> {
        if self.tolerance.is_none() || !self.reads_poses() {
            return Vec::new();
        }
        let mut sums = [(0.0, 0.0); 6];
        for (row, read) in self.rows.iter().zip(&self.read) {
            for k in (0..6).filter(|&k| read[k]) {
                sums[k] = (sums[k].0 + 1.0, sums[k].1 + row[k] * row[k]);
            }
        }
        let all = std::iter::once(None).chain((0..6).map(Some));
        all.filter_map(|alone| self.levels_of(alone, &sums)).collect()
    }

    /// A level of one number, or of the rotations, and another of the others; `sums`: how many of each were read, and their squares.
    fn levels_of(&self, alone: Option<usize>, sums: &[(f64, f64); 6]) -> Option<Statement> {
        let of = |apart: bool| {
            let all = (0..6).filter(|&k| is_apart(alone, k) == apart).map(|k| sums[k]);
            let (count, squares) = all.fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
            let level = (squares / count).sqrt();
            (level, -count * level.ln() - 0.5 * count)
        };
        let ((own, fit), (others, rest)) = (of(true), of(false));
        // A law of the machine moves more than one number.
        let surprise = match alone {
            Some(_) => self.surprise(own).max(MISSTATED.ln()) - 6.0_f64.ln(),
            None => self.surprise(own),
        };
        let evidence = fit + rest + surprise + self.surprise(others) - self.penalty(2.0);
        let kind = Kind::Levels(Levels { alone, own, others });
        evidence.is_finite().then_some(Statement { kind, level: 1.0, evidence })
    }

    /// Readings scatter by a share of themselves, beside the noise; repeats tell that from a law, by which they agree.
    pub(super) fn proportional(&self) -> Option<Statement> {
        if !self.has_repeats || self.shares.is_empty() {
            return None;
        }
        let read = |i: usize| (0..6).filter(move |&k| self.read[i][k]).map(move |k| (i, k));
        let numbers: Vec<[f64; 2]> = (0..self.rows.len())
            .flat_map(read)
            .map(|(i, k)| [self.rows[i][k].powi(2), self.shares[i][k].powi(2)])
            .collect();
        let at = |share: f64, level: f64| {
            let (mut all, mut square) = (LogOfProduct::default(), 0.0);
            for [left, reading] in &numbers {
                let variance = level * level + share * share * reading;
                all.push(variance);
                square += left / variance;
            }
            let evidence = -0.5 * (all.value() + square) + self.surprise(level) - self.penalty(2.0);
            Statement { kind: Kind::Proportional(share), level, evidence: evidence + MISSTATED.ln() }
        };
        let levels = (-4..=4).map(|k| (0.1 * f64::from(k)).exp());
        let all = SHARES.iter().flat_map(|&share| levels.clone().map(move |level| (share, level)));
        all.map(|(share, level)| at(share, level)).max_by(|a, b| a.evidence.total_cmp(&b.evidence))
    }
}
