//! Misstatements: the file as its author may have meant it, with other signs, units, axes, legs, frames,
//! angles or rows.
//!
//! No effect explains a file with a misstatement, and yet some set of effects explains it best. Before any physics, springs alone
//! are therefore fitted to the file as written. If they explain it to within little more than the noise, nothing else is tried.
//! Otherwise every other reading of the file is tried in the same way, one by one and then two at once; those that explain it much
//! better become candidates, which the diagnosis compares with every effect of the catalogue.

mod change;
mod columns;
mod copies;
mod differences;
mod hypotheses;
mod name;
mod normal;
mod numbers;
mod part;
mod places;
mod pose;
mod refine;
mod row_order;
mod sample;
mod sensors;
mod text;
mod turn;
mod unwritten;
mod weights;

use std::borrow::Cow;
use std::collections::BTreeMap;

use hexbench_core::interrupt::go_on;
use hexbench_core::parallel;
use hexbench_core::{Dataset, Hexapod};

pub use self::change::{
    Change, Group, JointCoordinate, Multiple, ReadingColumn, ReferencePoint, Sensors, Signed, Target,
};
pub(crate) use self::columns::idle_columns;
pub use self::copies::{copies, held_in};
pub(crate) use self::differences::as_deflections;
pub use self::name::{ChangeError, KINDS, names};
pub use self::places::{Misplaced, PlacedWay, misplaced};
pub use self::pose::{PoseMistake, PoseNumbers, PoseOf};
pub use self::row_order::RowOrder;
use self::sample::{FEW_NUMBERS, Sample, Springs};
use self::text::meanings;
pub use self::text::{AgainstWritten, AsWritten, finding, misplaced_findings};
pub use self::turn::{AngleOrder, SignedAxes};
pub(crate) use self::unwritten::unwritten;

/// Springs that leave more than this many times the noise may be those of a misread file.
const SOUND_LEVEL: f64 = 1.1;
/// So may those whose chi-square is this many of its standard deviations above what the noise leaves: many readings show little.
const SOUND_SIGMAS: f64 = 2.0;
/// Repeats of a sound file scatter within this factor of the stated noise.
const SOUND_SCATTER: f64 = 6.0;
/// Springs that leave more than this many times the noise may be those of a file whose signs or units change within it.
const FAR_LEVEL: f64 = 3.0;
/// Twice the log-likelihood another reading of a file has to gain.
const GAIN: f64 = 40.0;
/// Readings of a file this close to one another, in twice the log-likelihood, explain it alike.
const ALIKE: f64 = 8.0;
/// What a number that is fitted costs, in twice the log-likelihood: the logarithm of some hundred readings.
const SIZE: f64 = 6.0;
/// Readings in their true unit have at least this share of the stated noise: in too large a unit they agree with anything.
const QUIETEST: f64 = 0.4;
/// Single mistakes beside which a second one is tried.
const FIRST_OF_TWO: usize = 5;
/// A second mistake is only believed when it leaves at most this share of what the first one leaves.
const SECOND_SHARE: f64 = 0.4;
/// Conditions that tell a column that is off from an effect, and one that is wrong from a file that means something else.
const FEWEST_CONDITIONS: usize = 12;
/// Poses of which the same is asked.
const FEWEST_POSES: usize = 6;
/// Of so many, one has no more than this share of what another reading of the file explains better.
const MOST_OF_ONE: f64 = 0.5;
/// Numbers of a file that tell what deserves a coarse look.
const FEWEST_NUMBERS: usize = 6 * 8;
/// What leaves so many times as much as the file as written, of a few numbers, is no better reading of all of them.
const HOPELESS: f64 = 4.0;
/// Readings of a file looked at closely.
const LOOKED_AT: usize = 72;
/// Readings of a file handed on.
const MOST_WAYS: usize = 8;

/// Machine and measurements as they are meant.
#[derive(Debug, Clone)]
pub struct AsMeant<'a> {
    /// The machine.
    pub hexapod: Cow<'a, Hexapod>,
    /// The readings.
    pub data: Cow<'a, Dataset>,
    /// Readings held out.
    pub holdout: Option<Cow<'a, Dataset>>,
}

impl<'a> AsMeant<'a> {
    /// Files read with changes, one after the other; the files themselves when there are none.
    pub fn of(
        hexapod: &'a Hexapod,
        data: &'a Dataset,
        holdout: Option<&'a Dataset>,
        changes: &[Change],
    ) -> Self {
        let (hexapod, data) = (Cow::Borrowed(hexapod), Cow::Borrowed(data));
        let mut all = Self { hexapod, data, holdout: holdout.map(Cow::Borrowed) };
        for change in changes {
            // The machine of the holdout is that of the data: it changes once. Lines are those of the measurements.
            let is_everywhere = !matches!(change, Change::Within(..));
            if let Some(held) = all.holdout.as_mut().filter(|_| is_everywhere) {
                change.apply(&mut all.hexapod.clone().into_owned(), held.to_mut());
            }
            change.apply(all.hexapod.to_mut(), all.data.to_mut());
        }
        all
    }

    /// The same, held by itself.
    pub fn into_owned(self) -> AsMeant<'static> {
        AsMeant {
            hexapod: Cow::Owned(self.hexapod.into_owned()),
            data: Cow::Owned(self.data.into_owned()),
            holdout: self.holdout.map(|held| Cow::Owned(held.into_owned())),
        }
    }
}

/// A way to read a file.
#[derive(Debug, Clone)]
pub struct Way {
    /// What is read otherwise.
    pub changes: Vec<Change>,
    /// What springs alone leave of the readings that way, over the noise.
    pub level: f64,
    /// Twice the negative log-likelihood, to a constant of the file, with what so many alternatives cost.
    cost: f64,
    /// The part of it that is not what the springs leave, relative to the file as written: repeats, units, alternatives.
    pub beside_springs: f64,
    /// What springs alone gain by it over the file as written, in twice the log-likelihood; infinite where that is singular.
    pub gain: f64,
}

impl Way {
    /// What the author of the file meant, if this is what went wrong.
    pub fn meaning(&self) -> String {
        meanings(&self.changes)
    }

    /// Makes it dearer.
    fn charge(&mut self, cost: f64) {
        self.cost += cost;
        self.gain -= cost;
        self.beside_springs += cost;
    }

    /// True when nothing but signs changes.
    pub fn is_a_sign(&self) -> bool {
        self.changes.iter().all(|change| matches!(change, Change::Reversed(_) | Change::StatesExchanged))
    }

    /// True when one column, or some alike, are off by a factor or an amount that no unit explains.
    pub fn is_of_a_column(&self) -> bool {
        let is = |change: &Change| match change {
            Change::ZeroError(..) => true,
            Change::Scaled(..) | Change::SensorScaled(..) => change.sizes() > 0,
            _ => false,
        };
        self.changes.iter().any(is)
    }

    /// True when a column is off by an amount.
    pub fn is_a_zero_error(&self) -> bool {
        self.changes.iter().any(|change| matches!(change, Change::ZeroError(..)))
    }

    /// True when a number of it is fitted.
    pub fn has_size(&self) -> bool {
        self.changes.iter().any(|change| change.sizes() > 0)
    }
}

/// A file as it is written, and other ways to read it.
#[derive(Debug, Clone)]
pub struct Readings {
    /// What springs alone leave of the readings as written, over the noise; none where the machine is singular.
    pub level: Option<f64>,
    /// Some leg would have a negative stiffness as the file is written.
    pub is_negative: bool,
    /// Other ways that explain the file far better, best first.
    pub ways: Vec<Way>,
}

impl Readings {
    /// Ways found in some poses of a file, their lines moved to where they begin and end in all of it.
    #[must_use]
    pub fn to_the_line(mut self, hexapod: &Hexapod, data: &Dataset) -> Self {
        let mut sample = None;
        for change in self.ways.iter_mut().flat_map(|way| &mut way.changes) {
            let Change::Within(lines, multiple) = change else { continue };
            let sample = sample.get_or_insert_with(|| Sample::new(hexapod, data)).as_ref();
            let exact = sample.and_then(|sample| part::exact(sample, data, *multiple, lines.ends()));
            *lines = exact.unwrap_or(*lines);
        }
        self
    }

    /// Ways that explain the file like one of them, the best first; those that take more mistakes than others are none of them.
    pub fn like(&self, way: &Way) -> Vec<&Way> {
        let alike: Vec<&Way> = self.ways.iter().filter(|w| (w.cost - way.cost).abs() <= ALIKE).collect();
        let fewest = alike.iter().map(|w| w.changes.len()).min();
        alike.into_iter().filter(|w| Some(w.changes.len()) == fewest).collect()
    }
}

/// What deflections tell of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Readable {
    /// All that is written in it: they were read.
    Everything,
    /// Loads and legs: they are differences of absolute poses.
    LoadsAndLegs,
}

impl Readable {
    fn has(self, change: &Change) -> bool {
        self == Self::Everything || change.is_of_loads_or_legs()
    }
}

/// Other ways to read a file of deflections that springs alone do not explain as it is written; none when they do, or when no other way
/// is better.
pub fn other_readings(hexapod: &Hexapod, data: &Dataset, readable: Readable) -> Option<Readings> {
    if data.is_absolute() {
        return None;
    }
    let sample = Sample::new(hexapod, data)?;
    let written = sample.springs(&[]);
    if written.as_ref().is_some_and(|springs| is_sound(springs, &sample)) {
        return None;
    }
    let search = Search { sample: &sample, written: written.as_ref(), readable };
    let mut ways = search.singles(hexapod, data);
    if ways.first().is_none_or(|best| best.level > SOUND_LEVEL) {
        let second = search.pairs(hexapod, data, &ways);
        ways.extend(second);
        sort(&mut ways);
    }
    if ways.first().is_none_or(|best| best.level > SOUND_LEVEL) {
        ways.extend(search.parts(hexapod, data));
        sort(&mut ways);
    }
    ways.retain(|way| search.is_worth_a_look(way));
    drop_any_unit(&mut ways);
    drop_fuller_loads(&mut ways);
    let as_written = sample.squares(&[]);
    let of_all = |way: &Way| !search.rests_on_one_condition(way, as_written.as_deref());
    let ways: Vec<Way> = ways.into_iter().filter(of_all).take(MOST_WAYS).collect();
    if ways.is_empty() {
        return None;
    }
    let is_negative = written.as_ref().is_some_and(|w| w.negative > 0);
    Some(Readings { level: written.map(|w| w.level), is_negative, ways })
}

fn is_sound(springs: &Springs, sample: &Sample) -> bool {
    let excess = (springs.level.powi(2) - 1.0) / (2.0 / sample.freedom()).sqrt();
    springs.level < SOUND_LEVEL
        && excess < SOUND_SIGMAS
        && springs.negative == 0
        && (!sample.noise_is_stated || springs.scatter < SOUND_SCATTER)
}

/// Numbers that any small factor explains alike are in no other unit: they are only taken out of the account.
fn drop_any_unit(ways: &mut Vec<Way>) {
    let unit = |way: &Way| match way.changes[..] {
        [Change::Scaled(group, factor)] => Some((group, factor, way.cost)),
        _ => None,
    };
    let units: Vec<(Group, f64, f64)> = ways.iter().filter_map(unit).collect();
    ways.retain(|way| {
        let Some((group, factor, cost)) = unit(way) else { return true };
        let is_other = |f: f64| (f / factor).ln().abs() > std::f64::consts::LN_2;
        !units.iter().any(|(g, f, c)| *g == group && is_other(*f) && (c - cost).abs() < 2.0 * ALIKE)
    });
}

/// A load that a weight alone explains has no other components.
fn drop_fuller_loads(ways: &mut Vec<Way>) {
    let load = |way: &Way| match way.changes[..] {
        [Change::Preload(_)] => Some((way.changes[0].sizes(), way.cost)),
        _ => None,
    };
    let loads: Vec<(usize, f64)> = ways.iter().filter_map(load).collect();
    ways.retain(|way| {
        let Some((sizes, cost)) = load(way) else { return true };
        !loads.iter().any(|(fewer, c)| *fewer < sizes && *c < cost + ALIKE)
    });
}

/// Loads too small for a preload are left to the laws, and with them zero errors that they explain alike.
fn drop_small_loads(ways: &mut Vec<Way>, sample: &Sample) {
    let is_small =
        |way: &Way| matches!(&way.changes[..], [Change::Preload(l)] if refine::is_small(l, sample));
    let least = ways.iter().filter(|way| is_small(way)).map(|way| way.cost).fold(f64::INFINITY, f64::min);
    let is_a_load = |way: &Way| is_small(way) || (way.is_a_zero_error() && least < way.cost + ALIKE);
    ways.retain(|way| !is_a_load(way));
}

fn sort(ways: &mut [Way]) {
    ways.sort_by(|a, b| a.cost.total_cmp(&b.cost));
}

/// The search among other ways to read a file.
struct Search<'a> {
    sample: &'a Sample,
    written: Option<&'a Springs>,
    readable: Readable,
}

impl Search<'_> {
    /// Every single mistake, best first.
    fn singles(&self, hexapod: &Hexapod, data: &Dataset) -> Vec<Way> {
        let is_of_sensors = data.has_other_readings();
        let all =
            if is_of_sensors { sensors::singles(hexapod, data) } else { hypotheses::singles(hexapod, data) };
        let is_readable = |change: &Change| self.readable.has(change);
        let mut ways = self
            .looked_at(&all.into_iter().filter(is_readable).map(|change| vec![change]).collect::<Vec<_>>());
        let refined = refine::refined(self.sample).into_iter().filter(is_readable);
        ways.extend(refined.filter_map(|change| self.way(vec![change])));
        let orders = hypotheses::row_orders().filter(is_readable);
        ways.extend(orders.filter_map(|change| self.reordered(hexapod, data, change)));
        drop_small_loads(&mut ways, self.sample);
        sort(&mut ways);
        ways
    }

    /// A second mistake beside each of the best single ones.
    fn pairs(&self, hexapod: &Hexapod, data: &Dataset, singles: &[Way]) -> Vec<Way> {
        let mut first: Vec<&Way> = Vec::new();
        for way in singles.iter().filter(|w| !matches!(w.changes[..], [Change::Rows(_)])) {
            let known = first.iter().any(|f| f.changes[0].is_like(&way.changes[0]));
            if !known && first.len() < FIRST_OF_TWO {
                first.push(way);
            }
        }
        let second = if data.has_other_readings() {
            sensors::cheap(hexapod, data)
        } else {
            hypotheses::cheap(hexapod, &self.sample.data)
        };
        let pairs = first.iter().flat_map(|f| {
            let others = second.iter().filter(|s| self.readable.has(s) && !s.is_like(&f.changes[0]));
            others.map(move |&s| vec![f.changes[0], s])
        });
        let pairs: Vec<_> = pairs.collect();
        let mut both = self.looked_at(&pairs);
        let best = singles.first().map_or(f64::INFINITY, |best| best.level);
        both.retain(|way| way.level < SECOND_SHARE * best);
        both
    }

    /// The best of many, by a coarse look at those that a glimpse does not rule out.
    fn looked_at(&self, all: &[Vec<Change>]) -> Vec<Way> {
        let [glimpse, coarse] = [FEWEST_NUMBERS, FEW_NUMBERS].map(|most| self.sample.with_numbers(most));
        let written = glimpse.springs(&[]).filter(|springs| springs.negative == 0);
        let most = written.map_or(f64::INFINITY, |written| written.cost + glimpse.cost_of(HOPELESS));
        let look = |changes: &Vec<Change>| {
            go_on();
            if glimpse.springs(changes).is_some_and(|springs| springs.cost > most) {
                return None;
            }
            let springs = admissible(&coarse, changes)?;
            Some((springs.cost + charge(changes), changes.clone()))
        };
        let mut looked = parallel::filter_map(all, look);
        looked.sort_by(|a, b| a.0.total_cmp(&b.0));
        looked.truncate(LOOKED_AT);
        parallel::filter_map(&looked, |(_, changes)| self.way(changes.clone()))
    }

    fn way(&self, changes: Vec<Change>) -> Option<Way> {
        go_on();
        let springs = admissible(self.sample, &changes)?;
        Some(self.of(&springs, changes))
    }

    /// A sign or a unit that changes in the file, where springs alone are far from it as it is written.
    fn parts(&self, hexapod: &Hexapod, data: &Dataset) -> Vec<Way> {
        if self.written.is_some_and(|written| written.level < FAR_LEVEL) {
            return Vec::new();
        }
        let found = part::parts(self.sample, data, self.readable);
        parallel::filter_map(&found, |found| {
            go_on();
            let mut way = self.reordered(hexapod, data, found.change)?;
            way.charge(found.cost);
            Some(way)
        })
    }

    /// The rows in another order, or some of them in another unit, make other averages.
    fn reordered(&self, hexapod: &Hexapod, data: &Dataset, change: Change) -> Option<Way> {
        let meant = AsMeant::of(hexapod, data, None, &[change]);
        let sample = self.sample.reordered(&meant.hexapod, &meant.data)?;
        let springs = sample.springs(&[]).filter(|springs| springs.negative == 0)?;
        Some(self.of(&springs, vec![change]))
    }

    fn of(&self, springs: &Springs, changes: Vec<Change>) -> Way {
        let charge = charge(&changes);
        let as_written = self.written.map_or(0.0, |w| w.cost - w.lack);
        Way {
            changes,
            level: springs.level,
            gain: self.written.map_or(f64::INFINITY, |w| w.cost - springs.cost - charge),
            cost: springs.cost + charge,
            beside_springs: springs.cost - springs.lack + charge - as_written,
        }
    }

    /// True where most of what a way explains better is one condition, or one pose of many: that is a wrong reading, and no file that
    /// means something else.
    /// `as_written`: squares over the noise that springs leave of each.
    fn rests_on_one_condition(&self, way: &Way, as_written: Option<&[f64]>) -> bool {
        let is_elsewhere = |change: &Change| matches!(change, Change::Rows(_) | Change::Within(..));
        let Some(before) = as_written else { return false };
        if before.len() < FEWEST_CONDITIONS || way.changes.iter().any(is_elsewhere) {
            return false;
        }
        let Some(after) = self.sample.squares(&way.changes) else { return false };
        let gains: Vec<f64> = before.iter().zip(&after).map(|(before, after)| before - after).collect();
        let mut of_poses = BTreeMap::<i64, f64>::new();
        for (row, gain) in self.sample.data.observations.iter().zip(&gains) {
            *of_poses.entry(row.pose_id).or_default() += gain;
        }
        let of_one =
            if of_poses.len() < FEWEST_POSES { gains.clone() } else { of_poses.into_values().collect() };
        let (all, most) = (gains.iter().sum::<f64>(), of_one.into_iter().fold(0.0, f64::max));
        all > 0.0 && most > MOST_OF_ONE * all
    }

    /// True for what explains the file far better; as written, legs of negative stiffness explain nothing.
    fn is_worth_a_look(&self, way: &Way) -> bool {
        way.gain > GAIN || self.written.is_some_and(|written| written.negative > 0)
    }
}

/// Springs of a file read with changes, where all of them are springs and the readings are no quieter than their noise.
fn admissible(sample: &Sample, changes: &[Change]) -> Option<Springs> {
    // Beside a noise that nobody has stated, readings of any size are springs of another stiffness.
    if !sample.noise_is_stated && changes.iter().any(Change::is_of_all_readings) {
        return None;
    }
    let springs = sample.springs(changes).filter(|springs| springs.negative == 0)?;
    let of_the_scale = sample.noise_is_stated && changes.iter().any(Change::is_of_the_scale);
    let too_quiet = of_the_scale && sample.quietest(changes)? < QUIETEST;
    (!too_quiet).then_some(springs)
}

/// Twice the logarithm of how many mistakes of the kind there are.
fn charge(changes: &[Change]) -> f64 {
    let of_kind = |change: &Change| match change {
        Change::LegOrder(_) => 720.0_f64,
        Change::Renamed(..) | Change::Scaled(..) => 300.0,
        _ => 60.0,
    };
    changes.iter().map(|change| 2.0 * of_kind(change).ln() + change.sizes() as f64 * SIZE).sum()
}

#[cfg(test)]
mod tests {
    use hexbench_core::{Measurand, Metrology, Wrench};

    use super::*;
    use crate::test_machine::readings;

    /// So many times nine conditions, of a stated noise.
    fn sample(times: u8) -> Sample {
        let (machine, mut data) = readings(Measurand::DeflectionRotationVector, Vec::new());
        let elsewhere = |k: u8| {
            let mut rows = data.observations.clone();
            for row in &mut rows {
                row.pose.translation.x += 1e-3 * f64::from(k);
            }
            rows
        };
        data.observations = (0..times).flat_map(elsewhere).collect();
        let metrology = Some(Metrology { sigma_translation: 1e-6, sigma_rotation: 1e-6 });
        Sample::new(&Hexapod { metrology, ..machine }, &data).unwrap()
    }

    fn way(change: Change, cost: f64) -> Way {
        Way { changes: vec![change], level: 1.0, cost, beside_springs: 0.0, gain: -cost }
    }

    #[test]
    fn a_file_is_sound_where_springs_leave_little_more_than_its_noise() {
        let [few, many] = [1, 8].map(sample);
        // The chi-square of 426 degrees of freedom is two standard deviations above them at a level of 1.066.
        for (level, negative, scatter, sample, sound) in [
            (1.09, 0, 5.9, &few, true),
            (1.11, 0, 1.0, &few, false),
            (1.06, 0, 1.0, &many, true),
            (1.08, 0, 1.0, &many, false),
            (1.0, 0, 6.1, &few, false),
            (1.0, 1, 1.0, &few, false),
        ] {
            let springs = Springs { cost: 0.0, lack: 0.0, level, negative, scatter };
            assert_eq!(is_sound(&springs, sample), sound, "{springs:?}");
        }
    }

    #[test]
    fn ways_alike_to_eight_in_twice_the_log_likelihood_are_not_told_apart() {
        let sign = Change::Reversed(Signed::Readings);
        let ways = vec![way(sign, 0.0), way(sign, 7.9), way(sign, 8.1)];
        let readings = Readings { level: None, is_negative: false, ways };
        assert_eq!(readings.like(&readings.ways[0]).len(), 2);
        // Units of any size, which explain alike, are none.
        for (apart, left) in [(15.9, 0), (16.1, 2)] {
            let mut units = [(10.0, 0.0), (1000.0, apart)]
                .map(|(factor, cost)| way(Change::Scaled(Group::Forces, factor), cost))
                .to_vec();
            drop_any_unit(&mut units);
            assert_eq!(units.len(), left, "{apart}");
        }
        // A weight is preferred to a load of six components.
        let load = |components: [f64; 6]| Change::Preload(Wrench::from_array(components));
        for (fuller, left) in [(-7.9, 1), (-8.1, 2)] {
            let weight = way(load([0.0, 0.0, -9.0, 0.0, 0.0, 0.0]), 0.0);
            let mut loads = vec![weight, way(load([1.0; 6]), fuller)];
            drop_fuller_loads(&mut loads);
            assert_eq!(loads.len(), left, "{fuller}");
        }
    }

    #[test]
    fn what_one_condition_says_is_no_unit_of_a_column() {
        let halved = way(Change::Scaled(Group::Reading(5), 0.5), 0.0);
        let rests = |times: u8, spoil: &dyn Fn(usize, &mut f64)| {
            let mut sample = sample(times);
            let rows = sample.data.observations.iter_mut().enumerate();
            rows.for_each(|(row, o)| spoil(row, &mut o.measured[5]));
            let search = Search { sample: &sample, written: None, readable: Readable::Everything };
            search.rests_on_one_condition(&halved, sample.squares(&[]).as_deref())
        };
        let one_off = |row: usize, x: &mut f64| *x += if row == 4 { 5e-3 } else { 0.0 };
        assert!(rests(2, &one_off) && !rests(2, &|_, x| *x *= 2.0));
        assert!(!rests(1, &one_off), "nine conditions are few");
    }

    #[test]
    fn a_small_load_is_left_to_the_laws_with_the_zero_errors_that_it_explains_alike() {
        let sample = sample(1);
        let forces: f64 = sample.data.observations.iter().map(|o| o.wrench.force.norm_squared()).sum();
        let typical = (forces / sample.data.observations.len() as f64).sqrt();
        let load =
            |share: f64| Change::Preload(Wrench::from_array([0.0, 0.0, -share * typical, 0.0, 0.0, 0.0]));
        let zero = Change::ZeroError(ReadingColumn::Pose(2), 1e-5);
        for (share, cost, left) in
            [(0.24, 7.9, vec![]), (0.24, 8.1, vec![zero]), (0.26, 7.9, vec![zero, load(0.26)])]
        {
            let mut ways = vec![way(zero, 0.0), way(load(share), cost)];
            drop_small_loads(&mut ways, &sample);
            assert_eq!(
                ways.into_iter().map(|way| way.changes[0]).collect::<Vec<_>>(),
                left,
                "{share}, {cost}"
            );
        }
    }

    #[test]
    fn a_factor_is_fitted_unless_it_is_that_of_two_units() {
        let sizes = [25.4, 1.0 / 25.4, 9.806_65, 1.2].map(|f| Change::Scaled(Group::Load(0), f).sizes());
        assert_eq!(sizes, [1, 1, 0, 1]);
        let of_sensor = |f| Change::SensorScaled(Sensors::One("g1"), f);
        assert_eq!([25.4, 1.0 / 25.4, 0.83].map(|f| of_sensor(f).sizes()), [0, 0, 1]);
        let of_a_column =
            [Change::ZeroError(ReadingColumn::Sensor("g1"), 1e-6), of_sensor(0.83), of_sensor(25.4)];
        assert_eq!(of_a_column.map(|change| way(change, 0.0).is_of_a_column()), [true, true, false]);
    }

    #[test]
    fn a_change_costs_what_its_kind_and_its_sizes_do_and_has_to_gain_forty() {
        let load = Change::Preload(Wrench::from_array([1.0, 2.0, 3.0, 0.0, 0.0, 0.0]));
        assert!((charge(&[load]) - (2.0 * 60.0_f64.ln() + 18.0)).abs() < 1e-12);
        let order = Change::LegOrder([1, 0, 2, 3, 4, 5]);
        assert!((charge(&[order, load]) - charge(&[load]) - 2.0 * 720.0_f64.ln()).abs() < 1e-12);
        let sample = sample(1);
        let search = Search { sample: &sample, written: None, readable: Readable::Everything };
        assert_eq!([-39.9, -40.1].map(|cost| search.is_worth_a_look(&way(load, cost))), [false, true]);
        let springs = Springs { cost: 0.0, lack: 0.0, level: 1.0, negative: 1, scatter: 1.0 };
        let search = Search { written: Some(&springs), ..search };
        assert!(search.is_worth_a_look(&way(load, 0.0)), "a leg of negative stiffness explains nothing");
    }

    #[test]
    fn ways_tell_signs_sizes_and_what_deflections_show_of_them() {
        let [readings, loads] = [Signed::Readings, Signed::Wrench].map(Change::Reversed);
        let load = Change::Preload(Wrench::from_array([1.0; 6]));
        assert_eq!([readings, load].map(|c| way(c, 0.0).is_a_sign()), [true, false]);
        assert_eq!([readings, load].map(|c| way(c, 0.0).has_size()), [false, true]);
        assert_eq!([&readings, &loads].map(|c| Readable::LoadsAndLegs.has(c)), [false, true]);
        assert_eq!([&readings, &loads].map(|c| Readable::Everything.has(c)), [true; 2]);
    }
}
