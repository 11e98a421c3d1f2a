//! Levels of noise that differ: from number to number, or with the size of a reading.

use std::ops::Range;

use hexbench_core::Vector6;

use super::{Judge, Kind, LogOfProduct, MISSTATED, Statement};

/// Shares of a reading by which it scatters.
const SHARES: [f64; 12] = [1e-3, 1.5e-3, 2e-3, 3e-3, 4e-3, 6e-3, 8e-3, 0.012, 0.016, 0.024, 0.035, 0.05];

impl Judge {
    /// Some numbers have another level than the others: rotations come from other sensors than translations, one coordinate may be
    /// seen worse than the rest.
    pub(super) fn levels(&self) -> Vec<Statement> {
        if !self.is_stated || !self.reads_poses() {
            return Vec::new();
        }
        let alone = (0..6).map(|k| (k..k + 1, -(6.0_f64.ln())));
        let all = std::iter::once((3..6, 0.0)).chain(alone);
        all.filter_map(|(apart, odds)| self.levels_of(&apart, odds)).collect()
    }

    /// A level of these numbers, and another of the others.
    fn levels_of(&self, apart: &Range<usize>, odds: f64) -> Option<Statement> {
        let of = |is_apart: bool| {
            let read = |(row, read): (&Vector6, &[bool; 6])| {
                let own =
                    (0..6).filter(|k| read[*k] && apart.contains(k) == is_apart).map(|k| row[k] * row[k]);
                own.fold((0.0, 0.0), |(count, sum), square| (count + 1.0, sum + square))
            };
            let add = |a: (f64, f64), b: (f64, f64)| (a.0 + b.0, a.1 + b.1);
            let (count, squares) = self.rows.iter().zip(&self.read).map(read).fold((0.0, 0.0), add);
            let level = (squares / count).sqrt();
            (level, -count * level.ln() - 0.5 * count)
        };
        let (own, others) = (of(true), of(false));
        // A law of the machine moves more than one number.
        let surprise =
            if apart.len() == 1 { self.surprise(own.0).max(MISSTATED.ln()) } else { self.surprise(own.0) };
        let evidence = own.1 + others.1 + surprise + self.surprise(others.0) - self.penalty(2.0) + odds;
        let levels = std::array::from_fn(|k| if apart.contains(&k) { own.0 } else { others.0 });
        evidence.is_finite().then_some(Statement { kind: Kind::Levels(levels), level: 1.0, evidence })
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
