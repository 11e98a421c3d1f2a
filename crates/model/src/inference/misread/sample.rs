//! How well springs explain a file read in one way or another, cheaply.
//!
//! Springs alone explain a sound file to within a few noises, a misread one to within hundreds. So the springs are fitted to first
//! order in the deflection, to averaged readings of at most a few hundred conditions:
//!
//! ```text
//! y = H P diag(P' (W - W0)) c,   P = L^-1
//! ```
//!
//! with the rows `H` by which the numbers look at the motion of the platform; readings of full poses are motions themselves. A way of reading
//! that changes what pose numbers mean is only for those.
//!
//! and a way of reading is weighed by twice the negative log-likelihood of the readings as the file holds them. Their noise may be
//! larger than stated by what springs do not explain; repeats may scatter a few times more or less than stated, not a thousand times.

use std::borrow::Cow;
use std::collections::BTreeMap;

use hexbench_core::{Channel, Dataset, Hexapod, LineRange, Measurand, Observation, UNREAD, Vector6, spread};
use nalgebra::DVector;

use super::AsMeant;
use super::change::{Change, Group, ReadingColumn};
use super::normal::{Normal, Whitened, non_negative};
use super::weights::{Factors, Floor, Over, Weights};
use crate::effects::intern;
use crate::estimation::campaign::{Campaign, ConditionReadings, row_sigma};
use crate::estimation::equilibrium::observer_of;
use crate::estimation::noise::Noise;
use crate::machine::geometry::Machine;
use crate::machine::kinematics::{Legs, euler_rate_matrix};

/// Averaged numbers looked at.
const MOST_NUMBERS: usize = 6 * 96;
/// Numbers of a coarse look, which tells what deserves a closer one.
pub(super) const FEW_NUMBERS: usize = 6 * 24;
/// Repeats may scatter so many times more or less than stated.
const NOISE_OFF: f64 = 3.0;
/// Repeats of a sensor that tell how much it scatters, as degrees of freedom.
const SOME_REPEATS: f64 = 12.0;

/// A file, thinned to what tells one way of reading it from another.
#[derive(Debug, Clone)]
pub(super) struct Sample {
    /// The machine.
    pub(super) hexapod: Hexapod,
    /// Averaged readings.
    pub(super) data: Dataset,
    /// True when they are full poses.
    pub(super) reads_poses: bool,
    /// Standard deviations of the averages.
    sigma: Vec<Vector6>,
    /// Conditions of the file for each one here.
    stands_for: f64,
    /// Repeats about their average, for each number that the file has.
    repeats: Vec<Repeats>,
    /// Legs at each pose; none at singular ones.
    legs: Vec<Option<Legs>>,
    /// Noise of a reading.
    noise: Noise,
    /// True where somebody has stated it.
    pub(super) noise_is_stated: bool,
}

/// Repeats of a number about their average.
#[derive(Debug, Clone, Copy)]
struct Repeats {
    channel: Channel,
    /// Their squares over the stated variance.
    squares: f64,
    /// Their degrees of freedom.
    dof: f64,
}

/// Springs fitted to a file read in one way.
#[derive(Debug, Clone)]
pub(super) struct Springs {
    /// Twice the negative log-likelihood, to a constant of the file.
    pub(super) cost: f64,
    /// The part of it that the residuals make.
    pub(super) lack: f64,
    /// Residuals over noise, root mean square.
    pub(super) level: f64,
    /// Legs whose compliance would be negative.
    pub(super) negative: usize,
    /// Repeats' scatter over what is stated.
    pub(super) scatter: f64,
}

impl Sample {
    /// Averages a file; none when it has nothing to average.
    pub(super) fn new(hexapod: &Hexapod, data: &Dataset) -> Option<Self> {
        Some(Self::of(hexapod, data, &Campaign::new(hexapod, data).ok()?.independent()))
    }

    /// The same with the noise of this sample: repeats that are none would excuse anything.
    pub(super) fn reordered(&self, hexapod: &Hexapod, data: &Dataset) -> Option<Self> {
        let campaign = Campaign::with_noise(hexapod, data, self.noise).ok()?.independent();
        Some(Self::of(hexapod, data, &campaign))
    }

    fn of(hexapod: &Hexapod, data: &Dataset, campaign: &Campaign) -> Self {
        let means: usize = campaign.groups.iter().map(ConditionReadings::numbers).sum();
        let chosen: Vec<_> =
            some(campaign.groups.len(), means, MOST_NUMBERS).map(|i| &campaign.groups[i]).collect();
        let sigma: Vec<Vector6> = chosen.iter().map(|g| sigma_of(g)).collect();
        let means =
            chosen.iter().zip(&sigma).map(|(g, s)| Observation { sigma: Some((*s).into()), ..g.mean });
        let thinned = Dataset { observations: means.collect(), ..like(data) };
        let legs = legs(hexapod, &thinned);
        Self {
            hexapod: hexapod.clone(),
            data: thinned,
            reads_poses: !data.has_other_readings(),
            sigma,
            stands_for: campaign.groups.len() as f64 / chosen.len() as f64,
            repeats: repeats(data, campaign),
            legs,
            noise: campaign.noise,
            noise_is_stated: campaign.noise.is_stated(),
        }
    }

    /// Single rows instead of averages.
    pub(super) fn of_rows(&self, rows: &[Observation], data: &Dataset) -> Self {
        let sigma = rows.iter().map(|row| {
            let sigma = row_sigma(row, &self.noise);
            Vector6::from_fn(|k, _| if row.is_read(k) { sigma[k] } else { UNREAD })
        });
        let sigma = sigma.collect();
        let data = Dataset { observations: rows.to_vec(), ..like(data) };
        let legs = legs(&self.hexapod, &data);
        Self { data, sigma, legs, stands_for: 1.0, repeats: Vec::new(), ..self.clone() }
    }

    /// The same with conditions that have about so many numbers.
    pub(super) fn with_numbers(&self, most: usize) -> Self {
        let chosen: Vec<usize> = some(self.sigma.len(), self.numbers(), most).collect();
        let observations = chosen.iter().map(|&i| self.data.observations[i]).collect();
        Self {
            data: Dataset { observations, ..like(&self.data) },
            sigma: chosen.iter().map(|&i| self.sigma[i]).collect(),
            legs: chosen.iter().map(|&i| self.legs[i]).collect(),
            stands_for: self.stands_for * self.sigma.len() as f64 / chosen.len() as f64,
            ..self.clone()
        }
    }

    /// The springs of the file read with changes, one after the other; none where the machine is singular.
    pub(super) fn springs(&self, changes: &[Change]) -> Option<Springs> {
        let mut normal = Normal::default();
        self.whitened(changes, Over::Model, |row| normal.push(&row))?;
        self.judged(&normal, &self.factors(changes))
    }

    /// Columns of the springs and readings, row by row, of the file read with changes; none where the machine is singular. What the
    /// springs may miss is no more than of the file as written: a change of a part is none of all rows.
    pub(super) fn whitened_rows(&self, changes: &[Change]) -> Option<Vec<Whitened>> {
        let mut rows = Vec::with_capacity(self.data.observations.len());
        let reads = if self.reads_poses { motions(&self.data) } else { as_read(&self.data) };
        let as_written = Floor::of(&self.hexapod, &self.data, &reads, Over::Model);
        self.whitened(changes, Over::AtMost(as_written), |row| rows.push(row))?;
        Some(rows)
    }

    /// Twice the negative log-likelihood of springs, to a constant of the file, and the springs; none where the machine is singular or a
    /// leg would have a negative stiffness.
    pub(super) fn springs_of(&self, normal: &Normal) -> Option<(f64, Vector6)> {
        let (springs, chi2, negative) = non_negative(normal, self.freedom())?;
        (negative == 0).then(|| (self.lack(normal, chi2), springs))
    }

    /// What twice the negative log-likelihood gains when springs leave so many times as much.
    pub(super) fn cost_of(&self, times: f64) -> f64 {
        self.stands_for * self.numbers() as f64 * 2.0 * times.ln()
    }

    fn lack(&self, normal: &Normal, chi2: f64) -> f64 {
        let (numbers, freedom) = (self.numbers() as f64, self.freedom());
        let variance = (chi2 / freedom).max(1.0);
        let spread = numbers * (variance.ln() + chi2 / freedom / variance);
        self.stands_for * (spread - 2.0 * normal.density)
    }

    /// Logarithm of what a change multiplies the numbers of conditions by that lie within lines.
    pub(super) fn scale_within(&self, lines: LineRange, change: Change) -> f64 {
        let within =
            self.data.observations.iter().zip(&self.sigma).filter(|(row, _)| lines.contains(row.line));
        let logarithms = within.flat_map(|(row, sigma)| {
            let channels = self.data.channels(row);
            let read = (0..6).filter(|&k| sigma[k] < UNREAD);
            read.map(move |k| change.factor(channels[k], &self.hexapod.sensors).abs().ln())
                .collect::<Vec<_>>()
        });
        self.stands_for * logarithms.sum::<f64>()
    }

    /// Readings less what the springs explain of them, over the noise, of the file read with changes; six for each condition.
    pub(super) fn residuals(&self, changes: &[Change]) -> Option<DVector<f64>> {
        self.residuals_over(changes, Over::Model)
    }

    /// Their squares, condition by condition.
    pub(super) fn squares(&self, changes: &[Change]) -> Option<Vec<f64>> {
        let all = self.residuals(changes)?;
        Some(all.as_slice().chunks(6).map(|one| one.iter().map(|x| x * x).sum()).collect())
    }

    fn residuals_over(&self, changes: &[Change], over: Over) -> Option<DVector<f64>> {
        let mut rows = Vec::with_capacity(self.data.observations.len());
        self.whitened(changes, over, |row| rows.push(row))?;
        let (compliances, ..) = non_negative(&Normal::of(&rows), self.freedom())?;
        let all = rows.iter().flat_map(|row| {
            let left: Vector6 = row.read - row.columns * compliances;
            (0..6).map(move |k| left[k])
        });
        Some(DVector::from_iterator(6 * rows.len(), all))
    }

    /// Columns of readings that the file has.
    pub(super) fn columns(&self) -> Vec<ReadingColumn> {
        let mut columns = Vec::new();
        for block in &self.data.blocks {
            let of_block = block.iter().filter_map(|channel| self.column(*channel));
            for column in of_block {
                if !columns.contains(&column) {
                    columns.push(column);
                }
            }
        }
        columns
    }

    fn column(&self, channel: Channel) -> Option<ReadingColumn> {
        match channel {
            Channel::Pose(k) => u8::try_from(k).ok().map(ReadingColumn::Pose),
            Channel::Sensor { sensor, number } => {
                let sensor = self.hexapod.sensors.get(sensor)?;
                Some(ReadingColumn::Sensor(intern::text(&sensor.column(number))))
            }
            Channel::Nothing => None,
        }
    }

    /// Root mean square of a column as it is written, m or rad.
    pub(super) fn typical(&self, column: ReadingColumn) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for row in &self.data.observations {
            let channels = self.data.channels(row);
            for k in (0..6).filter(|&k| row.is_read(k) && column.is(channels[k], &self.hexapod.sensors)) {
                (sum, count) = (sum + row.measured[k].powi(2), count + 1.0);
            }
        }
        f64::sqrt(sum / f64::max(count, 1.0)).max(f64::MIN_POSITIVE)
    }

    /// Root mean square of the residuals over the stated noise, of the quietest of all columns.
    pub(super) fn quietest(&self, changes: &[Change]) -> Option<f64> {
        self.levels(changes)?.into_values().min_by(f64::total_cmp)
    }

    /// The same of the column of one channel, of the file as it is written.
    pub(super) fn level_of(&self, channel: Channel) -> Option<f64> {
        let mut levels = self.levels(&[])?.into_iter();
        let channels = |block: usize| self.data.blocks.get(block).copied().unwrap_or(Channel::POSE);
        levels.find_map(|((block, k), level)| (channels(block)[k] == channel).then_some(level))
    }

    /// Root mean square of the residuals over the stated noise, by block and place of the numbers.
    fn levels(&self, changes: &[Change]) -> Option<BTreeMap<(usize, usize), f64>> {
        let all = self.residuals_over(changes, Over::Noise)?;
        let mut columns: BTreeMap<(usize, usize), (f64, f64)> = BTreeMap::new();
        for (c, (row, sigma)) in self.data.observations.iter().zip(&self.sigma).enumerate() {
            for k in (0..6).filter(|&k| sigma[k] < UNREAD) {
                let (sum, count) = columns.entry((row.block, k)).or_default();
                (*sum, *count) = (*sum + all[6 * c + k].powi(2), *count + 1.0);
            }
        }
        let free = self.freedom() / self.numbers() as f64;
        Some(columns.into_iter().map(|(at, (sum, count))| (at, (sum / (count * free)).sqrt())).collect())
    }

    /// Columns of the springs and readings of every condition of the file read with changes; none at a singular pose.
    fn whitened(&self, changes: &[Change], over: Over, mut take: impl FnMut(Whitened)) -> Option<()> {
        let AsMeant { hexapod, data, .. } = AsMeant::of(&self.hexapod, &self.data, None, changes);
        let kept = changes.iter().all(Change::keeps_legs);
        let legs = if kept { Cow::Borrowed(&self.legs) } else { Cow::Owned(legs(&hexapod, &data)) };
        let factors = self.factors(changes);
        let reads = if self.reads_poses { motions(&data) } else { as_read(&data) };
        let floor = Floor::of(&hexapod, &data, &reads, over);
        let mut last: Option<Weights> = None;
        for (((row, read), legs), sigma) in
            data.observations.iter().zip(&reads).zip(legs.iter()).zip(&self.sigma)
        {
            let (legs, channels) = (legs.as_ref()?, data.channels(row));
            let force = legs.forces(&(row.wrench.to_vector() - row.reference.to_vector()));
            let mut columns = legs.platform_jacobian;
            if !self.reads_poses {
                columns = observer_of(&hexapod, data.measurand, &channels, &row.pose, legs) * columns;
            }
            // Most conditions are read alike.
            let known = last.filter(|known| known.channels == channels && known.sigma == *sigma);
            let weights = known.unwrap_or_else(|| Weights::of(channels, *sigma, &factors, &floor, &hexapod));
            last = Some(weights);
            for leg in 0..6 {
                let column = columns.column(leg).component_mul(&weights.each) * force[leg];
                columns.set_column(leg, &column);
            }
            take(Whitened { columns, read: read.component_mul(&weights.each), density: weights.density });
        }
        Some(())
    }

    fn factors<'a>(&'a self, changes: &'a [Change]) -> Factors<'a> {
        let of =
            |change: &Change| if let Change::Scaled(Group::Noise, factor) = change { *factor } else { 1.0 };
        let noise = self.noise_is_stated.then(|| changes.iter().map(of).product());
        Factors { changes, sensors: &self.hexapod.sensors, noise }
    }

    fn judged(&self, normal: &Normal, factors: &Factors) -> Option<Springs> {
        let freedom = self.freedom();
        let (_, chi2, negative) = non_negative(normal, freedom)?;
        let lack = self.lack(normal, chi2);
        let (repeats, scatter) = self.of_repeats(factors);
        let cost = lack + repeats;
        cost.is_finite().then_some(Springs { cost, lack, level: (chi2 / freedom).sqrt(), negative, scatter })
    }

    /// Twice the negative log-likelihood of the repeats, and by what factor those of the worst instrument scatter more or less than
    /// stated.
    fn of_repeats(&self, factors: &Factors) -> (f64, f64) {
        let mut cost = 0.0;
        let mut of_instrument: BTreeMap<Option<usize>, [f64; 2]> = BTreeMap::new();
        for &Repeats { channel, squares, dof } in &self.repeats {
            let times = factors.reading(channel) / factors.noise(channel);
            let variance = squares * times.powi(2) / dof;
            if self.noise_is_stated {
                let level = variance.clamp(NOISE_OFF.powi(-2), NOISE_OFF.powi(2));
                cost += dof * (level.ln() + variance / level);
            }
            cost -= 2.0 * dof * times.ln();
            let instrument = if let Channel::Sensor { sensor, .. } = channel { Some(sensor) } else { None };
            let [sum, all] = of_instrument.entry(instrument).or_default();
            (*sum, *all) = (*sum + dof * variance, *all + dof);
        }
        let of_some =
            of_instrument.into_iter().filter(|(sensor, [_, dof])| sensor.is_none() || *dof >= SOME_REPEATS);
        let scatter = of_some.map(|(_, [sum, dof])| (sum / dof).sqrt());
        (cost, scatter.map(|s| s.max(s.recip())).fold(1.0, f64::max))
    }

    /// Numbers of the readings.
    pub(super) fn numbers(&self) -> usize {
        self.sigma.iter().map(|s| s.iter().filter(|sigma| **sigma < UNREAD).count()).sum()
    }

    /// Degrees of freedom that the springs leave them.
    pub(super) fn freedom(&self) -> f64 {
        (self.numbers() as f64 - 6.0).max(1.0)
    }
}

/// Standard deviations of the averaged numbers of a condition; [`UNREAD`] of one that no repeat has.
fn sigma_of(group: &ConditionReadings) -> Vector6 {
    Vector6::from_fn(|k, _| if group.reads[k] > 0 { group.sigma[k] } else { UNREAD })
}

/// How repeats scatter about their averages, number by number.
fn repeats(data: &Dataset, campaign: &Campaign) -> Vec<Repeats> {
    let mut all: Vec<Repeats> = Vec::new();
    for group in &campaign.groups {
        for k in (0..6).filter(|&k| group.reads[k] > 1) {
            let channel = group.channels[k];
            let square = |&i: &u32| {
                let row = &data.observations[i as usize];
                let off = campaign.axes.difference(&group.mean.measured, &row.measured)[k];
                if row.is_read(k) { (off / row_sigma(row, &campaign.noise)[k]).powi(2) } else { 0.0 }
            };
            let (squares, dof) = (group.rows.iter().map(square).sum::<f64>(), f64::from(group.reads[k] - 1));
            match all.iter_mut().find(|known| known.channel == channel) {
                Some(known) => (known.squares, known.dof) = (known.squares + squares, known.dof + dof),
                None => all.push(Repeats { channel, squares, dof }),
            }
        }
    }
    all
}

/// Some of all conditions with so many numbers that have at most about so many.
fn some(all: usize, numbers: usize, most: usize) -> impl Iterator<Item = usize> {
    spread(all, all.div_ceil(numbers.div_ceil(most).max(1)))
}

/// The same file without readings.
pub(super) fn like(data: &Dataset) -> Dataset {
    let (source, measurand, columns) = (data.source.clone(), data.measurand, data.columns);
    let (blocks, sequences) = (data.blocks.clone(), data.sequences.clone());
    Dataset { source, measurand, columns, blocks, sequences, drawn_from: None, observations: Vec::new() }
}

fn legs(hexapod: &Hexapod, data: &Dataset) -> Vec<Option<Legs>> {
    let machine = Machine::nominal(hexapod);
    let mut last: Option<(hexbench_core::Pose, Option<Legs>)> = None;
    let at = |row: &Observation| {
        if let Some((pose, legs)) = &last
            && *pose == row.pose
        {
            return *legs;
        }
        let legs = machine.legs(&row.pose).ok();
        last = Some((row.pose, legs));
        legs
    };
    data.observations.iter().map(at).collect()
}

/// Readings as geometric twists, m and rad.
fn motions(data: &Dataset) -> Vec<Vector6> {
    let euler = data.measurand == Measurand::DeflectionEuler;
    let motion = |row: &Observation| {
        let mut motion = Vector6::from_column_slice(&row.measured);
        if euler {
            let turn = euler_rate_matrix(&row.pose.angles) * motion.fixed_rows::<3>(3);
            motion.fixed_rows_mut::<3>(3).copy_from(&turn);
        }
        motion
    };
    data.observations.iter().map(motion).collect()
}

/// Readings as they stand, m and rad.
fn as_read(data: &Dataset) -> Vec<Vector6> {
    data.observations.iter().map(|row| Vector6::from_column_slice(&row.measured)).collect()
}

#[cfg(test)]
mod tests {
    use hexbench_core::Metrology;

    use super::*;
    use crate::test_machine::readings;

    #[test]
    fn repeats_count_by_a_noise_of_up_to_three_times_the_stated_one() {
        let (machine, data) = readings(Measurand::DeflectionRotationVector, Vec::new());
        let metrology = Some(Metrology { sigma_translation: 1e-6, sigma_rotation: 1e-6 });
        let sample = Sample::new(&Hexapod { metrology, ..machine }, &data).unwrap();
        assert!((sample.freedom() - 48.0).abs() < 1e-12, "nine conditions and six springs");
        assert!((sample.cost_of(2.0) - 108.0 * 2.0_f64.ln()).abs() < 1e-9);
        let of = |channel, times: f64, dof: f64| {
            let repeats = vec![Repeats { channel, squares: times * times * dof, dof }];
            Sample { repeats, ..sample.clone() }.of_repeats(&sample.factors(&[]))
        };
        for (times, level, scatter) in [(2.0, 4.0, 2.0), (5.0, 9.0, 5.0), (0.2, 1.0 / 9.0, 5.0)] {
            let (cost, found) = of(Channel::Pose(0), times, 10.0);
            let expected = 10.0 * (f64::ln(level) + times * times / level);
            assert!((cost - expected).abs() < 1e-9 && (found - scatter).abs() < 1e-9, "{times}");
        }
        // A few repeats of a sensor do not show how much it scatters.
        let sensor = Channel::Sensor { sensor: 0, number: 0 };
        assert!([(11.0, 1.0), (12.0, 5.0)].iter().all(|(dof, s)| (of(sensor, 5.0, *dof).1 - s).abs() < 1e-9));
    }
}
