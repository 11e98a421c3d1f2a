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

use hexbench_core::{Channel, Dataset, Hexapod, Measurand, Observation, Sensor, Vector6};
use nalgebra::DMatrix;

use super::Examined;
use super::finding::{Finding, FindingKind, probability};
use super::remainder::{Remainder, explained};
use super::tolerance::{Reduced, WithinTolerances};
use crate::estimation::campaign::row_sigma;
use crate::estimation::noise::Noise;
use crate::inference::diagnosis::RankedSets;

/// Half widths that are tried, over the noise of a reading: the least, how many, and the ratio of each to the one before.
const LEAST: f64 = 0.25;
const WIDTHS: usize = 16;
const RATIO: f64 = 1.26;
/// Steps by which the widths found are made more exact.
const FINE: usize = 5;
/// Readings of more standard deviations of the noise have left the band.
const MOVED: f64 = 2.0;
/// Change of a width, relative, that changes no answer.
const SAME_WIDTH: f64 = 0.05;
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
    /// SI.
    widths: Vec<(Channel, f64)>,
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
        let beside = |known: Vec<DMatrix<f64>>| {
            let known = WithinTolerances::beside(rest, &known)?;
            let of = |sticking| Search { rest, known: &known, numbers: &numbers, sticking }.best();
            let both = [Sticking::AtZero, Sticking::Play].into_iter().filter_map(of);
            both.max_by(|a, b| a.evidence.total_cmp(&b.evidence))
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

    /// True for the same of the same numbers, to an uncertainty that changes no answer.
    pub(crate) fn resembles(&self, other: &Self) -> bool {
        let half = |of: &Self, channel| of.widths.iter().find(|(known, _)| *known == channel).map(|w| w.1);
        let is_same = |&(channel, own): &(Channel, f64)| {
            half(other, channel).is_some_and(|half| (own / half - 1.0).abs() < SAME_WIDTH)
        };
        self.sticking == other.sticking
            && self.widths.len() == other.widths.len()
            && self.widths.iter().all(is_same)
    }

    /// Readings as they would be without the band; what is within it is known to its width only.
    pub(crate) fn without(&self, data: &Dataset, noise: &Noise) -> Dataset {
        let mut all = data.clone();
        for &(channel, half) in &self.widths {
            let lost = self.sticking.seen(data, channel, noise);
            for (row, lost) in all.observations.iter_mut().zip(lost) {
                let Some(k) = data.place_of(row, channel) else { continue };
                row.measured[k] += lost.sides * half;
                if lost.unknown > 0.0 {
                    let mut sigma = row_sigma(row, noise);
                    sigma[k] = sigma[k].hypot(half * lost.unknown.sqrt());
                    row.sigma = Some(sigma);
                }
            }
        }
        all
    }
}

impl FoundBand {
    /// Readings as an instrument without the band would have shown them, and what was found.
    pub(super) fn taken_out(&self, hexapod: &Hexapod, whole: &Examined) -> Examined {
        let mut examined = whole.clone();
        examined.data = self.band.without(&whole.data, &whole.noise);
        examined.findings.push(self.finding(&hexapod.sensors, whole.data.measurand));
        examined.instrument.dead_band = Some(self.band.clone());
        examined
    }

    fn finding(&self, sensors: &[Sensor], measurand: Measurand) -> Finding {
        let of_one = |(channel, half): &(Channel, f64)| {
            format!("{} by {:.2} {}", channel.name(sensors, measurand), 1e6 * half, channel.unit(sensors))
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

/// What a row loses of a number as far as the readings tell, in half widths of the band.
#[derive(Clone, Copy, Default)]
struct Lost {
    /// Sum of the sides on which the readings behind it are.
    sides: f64,
    /// How many of them may be on either.
    unknown: f64,
}

impl Sticking {
    /// Of every row; nothing where the row does not have the number.
    fn seen(self, data: &Dataset, channel: Channel, noise: &Noise) -> Vec<Lost> {
        let mut before = None;
        let of_row = |row: &Observation| {
            let Some(k) = data.place_of(row, channel) else { return Lost::default() };
            let reading = row.measured[k];
            let has_moved = reading.abs() > MOVED * row_sigma(row, noise)[k];
            let own = if has_moved {
                Lost { sides: reading.signum(), unknown: 0.0 }
            } else {
                Lost { sides: 0.0, unknown: 1.0 }
            };
            let last = before.replace(own).filter(|_| self == Self::Play).unwrap_or_default();
            Lost { sides: own.sides + last.sides, unknown: own.unknown + last.unknown }
        };
        data.observations.iter().map(of_row).collect()
    }

    /// What an instrument with half a band does not show of motions, one after the other.
    fn lost(self, motions: impl Iterator<Item = f64>, half: f64) -> Vec<f64> {
        let mut shown = 0.0_f64;
        let of = |motion: f64| {
            let reference = if self == Self::Play { shown.clamp(-half, half) } else { 0.0 };
            shown = reference.clamp(motion - half, motion + half);
            motion - (shown - reference)
        };
        motions.map(of).collect()
    }
}

/// One number of the readings.
struct Number {
    channel: Channel,
    /// Noise of one reading, root mean square.
    sigma: f64,
    /// Rows that have it, its place there, and the motion as the model has it.
    rows: Vec<(usize, usize, f64)>,
}

/// All numbers of the readings.
fn numbers_of(rest: &Remainder<'_>) -> Vec<Number> {
    let predicted: Vec<Vector6> = (0..rest.campaign.groups.len()).map(|g| predicted(rest, g)).collect();
    let number = |channel| {
        let (mut rows, mut squares) = (Vec::new(), 0.0);
        for (i, row) in rest.data.observations.iter().enumerate() {
            let Some(k) = rest.data.place_of(row, channel) else { continue };
            squares += row_sigma(row, &rest.campaign.noise)[k].powi(2);
            rows.push((i, k, predicted[rest.group_of[i]][k]));
        }
        (!rows.is_empty()).then(|| Number { channel, sigma: (squares / rows.len() as f64).sqrt(), rows })
    };
    rest.data.all_channels().filter_map(number).collect()
}

/// Numbers of one condition as the model has them.
fn predicted(rest: &Remainder<'_>, group: usize) -> Vector6 {
    if rest.campaign.groups[group].channels == Channel::POSE {
        rest.lin.predicted(group)
    } else {
        rest.lin.conditions[group].observer * rest.lin.motion(group)
    }
}

/// A search for the numbers that have a band, and its width in each.
struct Search<'a> {
    rest: &'a Remainder<'a>,
    known: &'a WithinTolerances<'a>,
    numbers: &'a [Number],
    sticking: Sticking,
}

/// A band of one number: which, and half its width over the noise.
type Band = (usize, f64);

impl Search<'_> {
    /// Numbers are added while that makes the band more evident.
    fn best(&self) -> Option<FoundBand> {
        let all: Vec<Band> = (0..self.numbers.len())
            .flat_map(|m| (0..WIDTHS).map(move |k| (m, LEAST * RATIO.powf(k as f64))))
            .collect();
        let lost = self.lost(&all);
        let (mut best, mut chosen) = (0.0, Vec::new());
        loop {
            let is_new = |c: &usize| chosen.iter().all(|&other: &usize| all[other].0 != all[*c].0);
            let with = |c: usize| -> Vec<usize> { chosen.iter().copied().chain([c]).collect() };
            let more = (0..all.len()).filter(is_new).map(|c| (self.evidence(&lost, &with(c)), c));
            let Some((evidence, c)) =
                more.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(more, _)| *more > best)
            else {
                break;
            };
            chosen.push(c);
            best = evidence;
        }
        if chosen.is_empty() {
            return None;
        }
        let (evidence, bands) = self.refined(&chosen.iter().map(|&c| all[c]).collect::<Vec<Band>>());
        let width = |&(m, half): &Band| (self.numbers[m].channel, half * self.numbers[m].sigma);
        let widths = bands.iter().map(width).collect();
        Some(FoundBand { band: DeadBand { sticking: self.sticking, widths }, evidence })
    }

    /// The best widths near some.
    fn refined(&self, bands: &[Band]) -> (f64, Vec<Band>) {
        let steps = 2 * FINE + 1;
        let near =
            |&(m, half): &Band| (0..steps).map(move |k| (m, half * RATIO.powf(k as f64 / FINE as f64 - 1.0)));
        let all: Vec<Band> = bands.iter().flat_map(near).collect();
        let lost = self.lost(&all);
        let mut chosen: Vec<usize> = (0..bands.len()).map(|b| b * steps + FINE).collect();
        let mut best = self.evidence(&lost, &chosen);
        // One width after the other, twice: they hardly hang on each other.
        for b in (0..bands.len()).chain(0..bands.len()) {
            for c in b * steps..(b + 1) * steps {
                let mut tried = chosen.clone();
                tried[b] = c;
                let evidence = self.evidence(&lost, &tried);
                if evidence > best {
                    (best, chosen) = (evidence, tried);
                }
            }
        }
        (best, chosen.iter().map(|&c| all[c]).collect())
    }

    /// Evidence of some bands over none: one of all choices of numbers, each with one of all widths.
    fn evidence(&self, lost: &Reduced, chosen: &[usize]) -> f64 {
        let choices = ways(self.numbers.len(), chosen.len()) + chosen.len() as f64 * (WIDTHS as f64).ln();
        lost.gain(chosen) + (STICKS / 2.0).ln() - choices
    }

    /// Normal equations of what bands lose, over the standard deviation of what is the readings' own.
    fn lost(&self, bands: &[Band]) -> Reduced {
        let Self { rest, sticking, .. } = *self;
        let mut columns = DMatrix::zeros(rest.lin.equations(), bands.len());
        for (&(m, half), mut column) in bands.iter().zip(columns.column_iter_mut()) {
            let number = &self.numbers[m];
            let lost = sticking.lost(number.rows.iter().map(|row| row.2), half * number.sigma);
            let mut means = vec![Vector6::zeros(); rest.campaign.groups.len()];
            for (&(i, k, _), lost) in number.rows.iter().zip(lost) {
                let g = rest.group_of[i];
                means[g][k] -= lost / f64::from(rest.campaign.groups[g].reads[k]);
            }
            for (g, (mean, at)) in means.into_iter().zip(&rest.lin.conditions).enumerate() {
                column.rows_mut(6 * g, 6).copy_from(&at.weights.of(mean));
            }
        }
        self.known.and(columns)
    }
}

/// Logarithm of the number of ways to choose so many of all numbers.
fn ways(all: usize, chosen: usize) -> f64 {
    (0..chosen).map(|k| ((all - k) as f64 / (k + 1) as f64).ln()).sum()
}
