//! An instrument that does not show all of a motion: a gauge that sticks at zero, or the play of a gauge that goes to and fro.
//!
//! ```text
//! dead band   r = x - s d               s: side of zero, d: half of the band
//! play        r = x - (s + s') d        s': side of the reading before
//! ```
//!
//! A deflection is the difference of two readings. With play the first of them, at the reference, lags by the way in which the platform
//! came back from the load before: the same way up again loses twice, the other way nothing. No machine yields so: what legs, plates and
//! loads do shows in all numbers at once.

use std::ops::RangeInclusive;

use hexbench_core::{Channel, Dataset, Observation, Vector6};
use nalgebra::DMatrix;

use super::Examined;
use super::finding::{Finding, FindingKind, probability};
use super::remainder::{Remainder, explained};
use super::tolerance::{Reduced, Widest, WithinTolerances};
use crate::estimation::campaign::row_sigma;
use crate::estimation::noise::Noise;
use crate::inference::diagnosis::RankedSets;

/// Widths that are tried, over the noise of a reading.
const FACTORS: [f64; 3] = [1.0, 2.0, 4.0];
/// Readings of more standard deviations of the noise have left the band.
const MOVED: f64 = 2.0;
/// Widths over the noise that are told: less is none, and more would show at once as readings of zero.
const TOLD: RangeInclusive<f64> = 0.25..=8.0;
/// Chance that an instrument sticks.
const STICKS: f64 = 0.02;

/// How an instrument sticks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sticking {
    AtZero,
    Play,
}

/// Half of the dead band of each number that has one.
#[derive(Debug, Clone)]
pub(crate) struct DeadBand {
    sticking: Sticking,
    widths: Vec<Width>,
}

#[derive(Debug, Clone)]
struct Width {
    channel: Channel,
    name: String,
    /// SI.
    size: f64,
    is_angle: bool,
}

/// A dead band with its evidence over none, nats.
pub(super) struct FoundBand {
    pub(super) band: DeadBand,
    pub(super) evidence: f64,
}

impl DeadBand {
    /// The dead band that the readings show, beside the explanation found or in its place. Measured poses have no zero at which an
    /// instrument could rest.
    pub(super) fn of(rest: &Remainder<'_>, outcome: &RankedSets) -> Option<FoundBand> {
        if rest.campaign.is_absolute() {
            return None;
        }
        let numbers = numbers_of(rest);
        let each = [Sticking::AtZero, Sticking::Play];
        let lost = each.map(|sticking| (sticking, columns(rest, &numbers, sticking)));
        let beside = |known: Vec<DMatrix<f64>>| {
            let known = WithinTolerances::beside(rest, &known)?;
            let of = |(sticking, lost): &(Sticking, DMatrix<f64>)| {
                best_of(rest, &known.and(lost.clone()), &numbers, *sticking)
            };
            lost.iter().filter_map(of).max_by(|a, b| a.evidence.total_cmp(&b.evidence))
        };
        let found = beside(explained(rest.lin, rest.point));
        if rest.point.active.is_empty() {
            return found;
        }
        let explains = 0.5 * (outcome.baseline.lack_of_fit - outcome.best.lack_of_fit);
        let less = |found: FoundBand| FoundBand { evidence: found.evidence - explains, ..found };
        let instead = beside(vec![rest.lin.common_block()]).map(less);
        found.into_iter().chain(instead).max_by(|a, b| a.evidence.total_cmp(&b.evidence))
    }

    /// Readings as they would be without the band; what is within it is known to its width only.
    pub(crate) fn without(&self, data: &Dataset, noise: &Noise) -> Dataset {
        let mut all = data.clone();
        for width in &self.widths {
            let lost = self.sticking.lost(data, width.channel, noise);
            for (row, lost) in all.observations.iter_mut().zip(lost) {
                let Some(k) = place_of(data, row, width.channel) else { continue };
                row.measured[k] += lost.sides * width.size;
                if lost.unknown > 0.0 {
                    let mut sigma = row_sigma(row, noise);
                    sigma[k] = sigma[k].hypot(width.size * lost.unknown.sqrt());
                    row.sigma = Some(sigma);
                }
            }
        }
        all
    }
}

impl FoundBand {
    /// Readings as an instrument without the band would have shown them, and what was found.
    pub(super) fn taken_out(&self, whole: &Examined) -> Examined {
        let mut examined = whole.clone();
        examined.data = self.band.without(&whole.data, &whole.noise);
        examined.findings.push(self.finding());
        examined.dead_band = Some(self.band.clone());
        examined
    }

    fn finding(&self) -> Finding {
        let of_one = |width: &Width| {
            let (unit, size) = (if width.is_angle { "urad" } else { "um" }, 1e6 * width.size);
            format!("{} by {size:.2} {unit}", width.name)
        };
        let size = self.band.widths.iter().map(of_one).collect::<Vec<_>>().join(", ");
        let (what, next) = match self.band.sticking {
            Sticking::AtZero => (
                "readings fall short of the motion by the same amount, whatever the load",
                "tap the gauges before reading, and check them near zero against gauge blocks",
            ),
            Sticking::Play => (
                "readings fall short of the motion where it goes the same way as at the reading before, as those of a gauge with play do",
                "load alternately to and fro, or approach the reference and the load from the same side; check the play of the gauges",
            ),
        };
        Finding {
            probability: probability(self.evidence),
            text: format!("{what}: {size}. No machine yields so; the readings are judged without it"),
            size,
            next: next.to_owned(),
            ..Finding::of(FindingKind::DeadBand)
        }
    }
}

/// What a row loses of a number, in half widths of the band.
#[derive(Clone, Copy, Default)]
struct Lost {
    /// Sum of the sides on which the readings behind it are.
    sides: f64,
    /// How many of them may be on either.
    unknown: f64,
}

impl Sticking {
    /// Of every row; nothing where the row does not have the number.
    fn lost(self, data: &Dataset, channel: Channel, noise: &Noise) -> Vec<Lost> {
        let mut before = None;
        let of_row = |row: &Observation| {
            let Some(k) = place_of(data, row, channel) else { return Lost::default() };
            let reading = row.measured[k];
            let side = if reading.abs() > MOVED * row_sigma(row, noise)[k] { reading.signum() } else { 0.0 };
            let last = before.replace(side).filter(|_| self == Self::Play);
            let unknown = |side: f64| f64::from(u8::from(side == 0.0));
            Lost { sides: side + last.unwrap_or(0.0), unknown: unknown(side) + last.map_or(0.0, unknown) }
        };
        data.observations.iter().map(of_row).collect()
    }
}

/// Where a row has a number, if it was read there.
fn place_of(data: &Dataset, row: &Observation, channel: Channel) -> Option<usize> {
    data.channels(row).iter().position(|own| *own == channel).filter(|&k| row.is_read(k))
}

/// One number of the readings.
struct Number {
    channel: Channel,
    /// Noise of one reading, root mean square.
    sigma: f64,
}

/// All numbers of the readings.
fn numbers_of(rest: &Remainder<'_>) -> Vec<Number> {
    let mut sums: Vec<(Channel, f64, f64)> = Vec::new();
    for row in &rest.data.observations {
        let sigma = row_sigma(row, &rest.campaign.noise);
        for (k, &channel) in rest.data.channels(row).iter().enumerate() {
            if channel == Channel::Nothing || !row.is_read(k) {
                continue;
            }
            let place = sums.iter().position(|(own, ..)| *own == channel).unwrap_or_else(|| {
                sums.push((channel, 0.0, 0.0));
                sums.len() - 1
            });
            sums[place].1 += sigma[k] * sigma[k];
            sums[place].2 += 1.0;
        }
    }
    let number =
        |(channel, squares, count): (Channel, f64, f64)| Number { channel, sigma: (squares / count).sqrt() };
    sums.into_iter().map(number).collect()
}

/// Numbers are added while that makes the band more evident. `lost`: normal equations of the bands of all numbers.
fn best_of(
    rest: &Remainder<'_>,
    lost: &Reduced,
    numbers: &[Number],
    sticking: Sticking,
) -> Option<FoundBand> {
    let found = |members: &[usize]| {
        let Widest { evidence, factor, errors } = lost.only(members).widest(&FACTORS)?;
        let is_band = errors.iter().all(|error| TOLD.contains(&(error * factor)));
        let width = |(error, &m): (&f64, &usize)| numbers[m].width(rest, error * factor);
        let widths = errors.iter().zip(members).map(width).collect();
        let evidence = evidence + (STICKS / 2.0).ln() - ways(numbers.len(), members.len());
        is_band.then_some(FoundBand { band: DeadBand { sticking, widths }, evidence })
    };
    let (mut best, mut members) = (None::<FoundBand>, Vec::new());
    loop {
        let with = |m: usize| -> Vec<usize> { members.iter().copied().chain([m]).collect() };
        let others = (0..numbers.len()).filter(|m| !members.contains(m));
        let more = others.filter_map(|m| Some((found(&with(m))?, m)));
        let next = more.max_by(|(a, _), (b, _)| a.evidence.total_cmp(&b.evidence));
        let is_more = |next: &FoundBand| best.as_ref().is_none_or(|best| next.evidence > best.evidence);
        let Some((next, m)) = next.filter(|(next, _)| is_more(next)) else { return best };
        members.push(m);
        best = Some(next);
    }
}

impl Number {
    /// A band of so many of its noises.
    fn width(&self, rest: &Remainder<'_>, size: f64) -> Width {
        let sensors = &rest.campaign.hexapod.sensors;
        let name = self.channel.name(sensors, rest.campaign.measurand);
        Width {
            channel: self.channel,
            name,
            size: size * self.sigma,
            is_angle: self.channel.is_angle(sensors),
        }
    }
}

/// Logarithm of the number of ways to choose so many of all numbers.
fn ways(all: usize, chosen: usize) -> f64 {
    (0..chosen).map(|k| ((all - k) as f64 / (k + 1) as f64).ln()).sum()
}

/// What the readings lose where each number has a band of its noise, over the standard deviation of what is their own; a column each.
fn columns(rest: &Remainder<'_>, numbers: &[Number], sticking: Sticking) -> DMatrix<f64> {
    let mut columns = DMatrix::zeros(rest.lin.equations(), numbers.len());
    for (number, mut column) in numbers.iter().zip(columns.column_iter_mut()) {
        let lost = sticking.lost(rest.data, number.channel, &rest.campaign.noise);
        for (g, (group, at)) in rest.campaign.groups.iter().zip(&rest.lin.conditions).enumerate() {
            let of_number = |k: usize, _| {
                if group.channels[k] != number.channel || group.reads[k] == 0 {
                    return 0.0;
                }
                let all: f64 = group.rows.iter().map(|&i| lost[i as usize].sides).sum();
                -all * number.sigma / f64::from(group.reads[k])
            };
            column.rows_mut(6 * g, 6).copy_from(&at.weights.of(Vector6::from_fn(of_number)));
        }
    }
    columns
}
