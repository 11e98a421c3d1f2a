//! Readings under equal conditions, averaged.

use std::collections::HashMap;
use std::sync::Arc;

use hexbench_core::{Channel, Dataset, LoadSequence, Matrix6, Observation, UNREAD};

use super::seen::Seen;
use crate::estimation::frames::ReadingAxes;
use crate::estimation::noise::{Noise, SharedReference, Structure};
use crate::estimation::reading_weights::ReadingWeights;

/// Readings that share pose, loads, approach, temperature and time, averaged.
#[derive(Debug, Clone)]
pub struct ConditionReadings {
    /// Inputs, as of the first reading; `measured` is the weighted mean.
    pub mean: Observation,
    /// Loads that came before; none where the file states no sequence, or only the reference load came before.
    pub sequence: Option<Arc<LoadSequence>>,
    /// What the six numbers are.
    pub channels: [Channel; 6],
    /// How many readings each number was read in.
    pub reads: [u32; 6],
    /// Standard deviation of each mean value, without what it shares with others of its record.
    pub sigma: [f64; 6],
    /// Standard deviation of what it shares with them.
    pub shared: [f64; 6],
    /// Number of its record.
    pub record: usize,
    /// Indices of the readings in the dataset.
    pub rows: Vec<u32>,
    /// Sum of squared whitened differences between the readings and their mean.
    pub pure_error: f64,
    /// `L^-1` where the numbers over `sigma` have the covariance `L L'` by what is its own; none where they are independent.
    pub freed: Option<Arc<Matrix6>>,
}

impl ConditionReadings {
    fn of(first: &Observation, channels: [Channel; 6], sequence: Option<Arc<LoadSequence>>) -> Self {
        let rows = Vec::with_capacity(1);
        Self {
            mean: *first,
            sequence,
            channels,
            reads: [0; 6],
            sigma: [0.0; 6],
            shared: [0.0; 6],
            record: 0,
            rows,
            pure_error: 0.0,
            freed: None,
        }
    }

    /// How many of the six numbers were read at all.
    pub fn numbers(&self) -> usize {
        self.reads.iter().filter(|reads| **reads > 0).count()
    }

    /// Standard deviation of each mean value by all of its noise, without what it shares with others of its record.
    pub(crate) fn own_deviations(&self) -> [f64; 6] {
        let correlated = self.freed.as_ref().map(|_| self.weights().numbers(Matrix6::identity()));
        std::array::from_fn(|k| correlated.map_or(self.sigma[k], |root| root.row(k).norm()))
    }

    /// What makes its numbers independent with unit variance, but for what it shares with others.
    pub(crate) fn weights(&self) -> ReadingWeights {
        ReadingWeights::new(&self.sigma, self.freed.clone())
    }
}

/// Under how many conditions readings were taken: what a fit keeps memory of.
pub fn count_conditions(data: &Dataset) -> usize {
    let rows = &data.observations;
    let key_of = |i: usize| key(&rows[i], data.sequences.to(&rows[i]).map(Arc::as_ref));
    let mut known = Seen::with_room(rows.len());
    for i in 0..rows.len() {
        known.number(&key_of(i), i, key_of);
    }
    known.len()
}

/// Readings of a dataset in groups of equal inputs, in order of first appearance.
pub(super) fn group(data: &Dataset, noise: &Noise, axes: &ReadingAxes) -> Vec<ConditionReadings> {
    let rows = &data.observations;
    let mut known = Seen::with_room(rows.len());
    let mut groups: Vec<ConditionReadings> = Vec::new();
    // Neighbors that resemble each other are no repeats of each other.
    let drifts = matches!(noise.structure, Structure::Drift { .. });
    let is_named = noise.structure.has_named_records();
    for (i, row) in rows.iter().enumerate() {
        let next = groups.len();
        let sequence = data.sequences.to(row);
        let slot = if drifts {
            next
        } else {
            let key = |row: &Observation, sequence: Option<&Arc<LoadSequence>>| {
                (key(row, sequence.map(Arc::as_ref)), row.reference_record.filter(|_| is_named))
            };
            let key_of = |group: usize| key(&groups[group].mean, groups[group].sequence.as_ref());
            known.number(&key(row, sequence), next, key_of)
        };
        if slot == next {
            groups.push(ConditionReadings::of(row, data.channels(row), sequence.cloned()));
        }
        groups[slot].rows.push(u32::try_from(i).unwrap_or(u32::MAX));
    }
    let mut records: HashMap<(Record, usize), usize> = HashMap::new();
    for g in &mut groups {
        average(g, rows, noise, axes);
        let record = (Record::of(g, is_named), g.mean.block);
        let next = records.len();
        g.record = *records.entry(record).or_insert(next);
    }
    groups
}

/// What readings with a reference in common have in common.
#[derive(PartialEq, Eq, Hash)]
enum Record {
    Pose([u64; 6]),
    Named(i64),
    /// A file that names none says nothing of what its readings share.
    Own(u32),
}

impl Record {
    fn of(group: &ConditionReadings, is_named: bool) -> Self {
        match group.mean.reference_record {
            _ if !is_named => Self::Pose(group.mean.pose.bits()),
            Some(number) => Self::Named(number),
            None => Self::Own(group.rows[0]),
        }
    }
}

fn average(group: &mut ConditionReadings, rows: &[Observation], noise: &Noise, axes: &ReadingAxes) {
    let (mut weights, mut sums) = ([0.0; 6], [0.0; 6]);
    // Differences from the first reading keep the digits of absolute poses.
    let first = rows[group.rows[0] as usize].measured;
    for &i in &group.rows {
        let row = &rows[i as usize];
        let sigma = row_sigma(row, noise);
        let off = axes.difference(&first, &row.measured);
        for k in 0..6 {
            let w = sigma[k].powi(-2);
            weights[k] += w;
            sums[k] += w * off[k];
            group.reads[k] += u32::from(sigma[k] < UNREAD);
        }
    }
    let mean = axes.moved(&first, &std::array::from_fn(|k| sums[k] / weights[k]));
    group.mean.measured = mean;
    group.sigma = weights.map(|w| w.sqrt().recip());
    let square = |&i: &u32| whitened_square(&rows[i as usize], &mean, noise, axes);
    group.pure_error = group.rows.iter().map(square).sum();
    share_out(group, noise);
}

/// Splits the variance of a mean of independent readings into what is its own and what is shared.
fn share_out(group: &mut ConditionReadings, noise: &Noise) {
    let own = noise.structure.own_share();
    let each_has_its_own = match noise.structure {
        Structure::Reference { record: SharedReference::Named, .. } => group.mean.reference_record.is_none(),
        Structure::Reference { record, .. } => record == SharedReference::Repeat,
        _ => false,
    };
    for k in 0..6 {
        // As if every reading had the same level, which those of a record have to have.
        let readings = f64::from(group.reads[k].max(1));
        let one = group.sigma[k] * readings.sqrt();
        let (mean, shared) = match noise.structure {
            Structure::Independent
            | Structure::Axes { .. }
            | Structure::Loads { .. }
            | Structure::Lengths { .. } => continue,
            Structure::Drift { share, .. } => (own.sqrt(), share.sqrt()),
            Structure::Setup { share } => ((own / readings + share).sqrt(), 0.0),
            Structure::Reference { share, .. } if !each_has_its_own => {
                ((own / readings).sqrt(), share.sqrt())
            }
            Structure::Reference { share, .. } => ((own / readings).sqrt(), (share / readings).sqrt()),
        };
        group.sigma[k] = one * mean;
        group.shared[k] = one * shared;
    }
    // Repeats of one reference each scatter by all of their noise.
    if !each_has_its_own {
        group.pure_error /= own;
    }
}

/// Standard deviation of the six values of one reading.
pub fn row_sigma(row: &Observation, noise: &Noise) -> [f64; 6] {
    row.sigma.unwrap_or_else(|| noise.sigma())
}

fn whitened_square(row: &Observation, mean: &[f64; 6], noise: &Noise, axes: &ReadingAxes) -> f64 {
    let sigma = row_sigma(row, noise);
    let off = axes.difference(mean, &row.measured);
    (0..6).map(|k| (off[k] / sigma[k]).powi(2)).sum()
}

/// Inputs of a reading, bit by bit, and what came before.
type ConditionKey = ([u64; 25], Option<Vec<u64>>);

fn key(row: &Observation, sequence: Option<&LoadSequence>) -> ConditionKey {
    let mut key = [0; 25];
    key[21] = row.block as u64;
    key[22] = u64::from(row.reference_age.is_some());
    key[23] = (row.reference_age.unwrap_or(0.0) + 0.0).to_bits();
    key[24] = row.overload.to_bits();
    let parts = [row.pose.to_array(), row.wrench.to_array(), row.reference.to_array()];
    let rest = [row.approach.sign(), row.delta_t, row.elapsed];
    for (k, x) in key.iter_mut().zip(parts.iter().flatten().chain(&rest)) {
        *k = (x + 0.0).to_bits();
    }
    (key, sequence.map(LoadSequence::bits))
}
