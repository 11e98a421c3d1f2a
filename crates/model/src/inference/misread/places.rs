//! Poses that do not mean what they say, by the frames that carry the commanded poses to the measured ones.
//!
//! A machine misses little of what it was sent, seen in the frames of its instrument, which poses themselves tell in closed form. A
//! sign, a unit or an axis that is not meant leaves a good part of it, and no frames make up for that. So poses
//! are read in every other way, and one that leaves a small share of what the file leaves as written is what was meant. No springs
//! take part: where two ways leave the same, as a sign of the commanded and of the measured pose do in axes that coincide, the loads tell.

use hexbench_core::interrupt::go_on;
use hexbench_core::parallel;
use hexbench_core::{Dataset, Hexapod, LineRange, Observation, Vector3, spread_of};

use super::AsMeant;
use super::change::{Change, Multiple};
use super::differences::{as_deflections, at_poses};
use super::hypotheses::{ANGLES, LENGTHS, row_orders};
use super::part::{best_range, is_part};
use super::pose::{PoseMistake, PoseNumbers, PoseOf};
use super::sample::Sample;
use super::turn::{AngleOrder, SignedAxes};
use crate::estimation::frames::{Frames, lever};

/// Rows looked at.
const MOST_ROWS: usize = 240;
/// Poses that tell frames from mistakes.
const LEAST_POSES: usize = 5;
/// Share of what was commanded that a machine may miss, for its joints are not where they are drawn.
const SOUND: f64 = 0.02;
/// The same as a share of a leg, however little was commanded.
const LEAST: f64 = 1e-4;
/// The same of a file read as it was meant.
const MEANT: f64 = 0.02;
/// Another way may leave this share of what the file leaves as written.
const SHARE: f64 = 0.2;
/// Ways of which none leaves so many times as much as the best are alike.
const ALIKE: f64 = 1.5;
/// One row in so many may be far from all others: blunders, which no way of reading explains.
const FAR_ROWS: usize = 50;
/// Mistakes beside which a second one is tried.
const FIRST_OF_TWO: usize = 4;
/// So many rows have to be concerned by what is not everywhere: fewer are single mistakes.
const LEAST_ROWS: usize = 4;
/// Stretches of a file of which some may be as it was meant.
const STRETCHES: usize = 3;
/// Times that frames and lines are found anew.
const ROUNDS: usize = 3;

/// Poses that seem to mean something else.
pub struct Misplaced {
    /// What frames leave of the poses as written, root mean square, m: positions, and angles times the length of a leg.
    pub written: f64,
    /// Ways of reading that leave far less, as little as the best of them; the likelier kinds first.
    pub ways: Vec<PlacedWay>,
}

/// A way to read poses.
#[derive(Debug, Clone)]
pub struct PlacedWay {
    /// What is read otherwise.
    pub changes: Vec<Change>,
    /// What frames leave then, as above, m.
    pub left: f64,
    /// The same in the unit of the measured numbers as the file holds them: in a smaller unit everything is small.
    cost: f64,
}

/// What is left of positions, and of angles times the length of a leg, root mean square, m.
#[derive(Debug, Clone, Copy)]
struct Left {
    positions: f64,
    angles: f64,
}

impl Left {
    fn both(self) -> f64 {
        self.positions.hypot(self.angles)
    }

    /// In the unit of the measured numbers before changes.
    fn as_written(self, changes: &[Change]) -> f64 {
        let factor = |change: &Change, of_angles: bool| match change {
            Change::Pose(PoseOf::Instrument, PoseMistake::Scaled(numbers, factor))
                if numbers.are_angles() == of_angles =>
            {
                *factor
            }
            _ => 1.0,
        };
        let times = |of_angles: bool| changes.iter().map(|change| factor(change, of_angles)).product::<f64>();
        (self.positions / times(false)).hypot(self.angles / times(true))
    }
}

/// Other ways to read the poses of absolute readings that no frames carry into each other; none where they do, or nothing else is better.
pub fn misplaced(hexapod: &Hexapod, data: &Dataset) -> Option<Misplaced> {
    if !data.is_absolute() || at_poses(&data.observations).len() < LEAST_POSES {
        return None;
    }
    let search = Search { hexapod, data, rows: thinned(data) };
    let written = search.left(&[])?.both();
    if written < (SOUND * commanded(hexapod, &data.observations)).max(LEAST * lever(hexapod)) {
        return None;
    }
    let most = Most { left: MEANT * lever(hexapod), cost: SHARE * written };
    let singles = search.singles();
    let mut ways = good(&singles, most);
    if ways.is_empty() {
        ways = good(&search.pairs(&singles), most);
    }
    if ways.is_empty() {
        ways = good(&search.parts(most), most);
    }
    (!ways.is_empty()).then(|| Misplaced { written, ways: told_by_loads(hexapod, data, ways) })
}

/// What a way of reading may leave.
#[derive(Clone, Copy)]
struct Most {
    left: f64,
    cost: f64,
}

impl Most {
    fn allows(self, left: f64, cost: f64) -> bool {
        left <= self.left && cost <= self.cost
    }
}

/// Those that leave little, and not much more than the best of them.
fn good(all: &[PlacedWay], most: Most) -> Vec<PlacedWay> {
    let few: Vec<&PlacedWay> = all.iter().filter(|way| most.allows(way.left, way.cost)).collect();
    let best = few.iter().map(|way| way.cost).fold(f64::INFINITY, f64::min);
    few.into_iter().filter(|way| way.cost <= ALIKE * best).cloned().collect()
}

/// Those whose loads springs explain far better than the others, where loads tell.
fn told_by_loads(hexapod: &Hexapod, data: &Dataset, ways: Vec<PlacedWay>) -> Vec<PlacedWay> {
    let level = |way: &PlacedWay| {
        let meant = AsMeant::of(hexapod, data, None, &way.changes);
        let deflections = as_deflections(&meant.hexapod, &meant.data)?;
        let springs = Sample::new(&meant.hexapod, &deflections)?.springs(&[])?;
        Some(if springs.negative > 0 { f64::INFINITY } else { springs.level })
    };
    let levels: Vec<Option<f64>> = if ways.len() > 1 { parallel::map(&ways, level) } else { vec![None] };
    let least = levels.iter().flatten().copied().fold(f64::INFINITY, f64::min);
    let is_kept = |level: &Option<f64>| level.is_none_or(|level| level <= ALIKE * least);
    let kept = ways.into_iter().zip(&levels).filter(|(_, level)| is_kept(level));
    kept.map(|(way, _)| way).collect()
}

/// How far poses were commanded from their mean, root mean square, m: positions, and angles times the length of a leg.
fn commanded(hexapod: &Hexapod, rows: &[Observation]) -> f64 {
    let (count, lever) = (rows.len().max(1) as f64, lever(hexapod));
    let place = |row: &Observation| [row.pose.translation, row.pose.angles * lever];
    let places: Vec<[Vector3; 2]> = rows.iter().map(place).collect();
    let mean = [0, 1].map(|k| places.iter().map(|place| place[k]).sum::<Vector3>() / count);
    let square = |place: &[Vector3; 2]| (0..2).map(|k| (place[k] - mean[k]).norm_squared()).sum::<f64>();
    (places.iter().map(square).sum::<f64>() / count).sqrt()
}

fn thinned(data: &Dataset) -> Dataset {
    let observations = spread_of(&data.observations, MOST_ROWS).collect();
    Dataset { observations, ..super::sample::like(data) }
}

struct Search<'a> {
    hexapod: &'a Hexapod,
    data: &'a Dataset,
    /// Some rows of it.
    rows: Dataset,
}

impl Search<'_> {
    /// What frames leave of the file read with changes, without the rows that are far from all others.
    fn left(&self, changes: &[Change]) -> Option<Left> {
        go_on();
        // The order of rows is that of all.
        let is_order = changes.iter().any(|change| matches!(change, Change::Rows(_)));
        let data = if is_order { self.data } else { &self.rows };
        let meant = AsMeant::of(self.hexapod, data, None, changes);
        let rows: Vec<_> = spread_of(&meant.data.observations, MOST_ROWS).collect();
        let frames = Frames::closest(self.hexapod, &rows);
        self.left_of(&frames, &rows)
    }

    fn left_of(&self, frames: &Frames, rows: &[Observation]) -> Option<Left> {
        let mut squares = self.squares(frames, rows);
        squares.sort_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
        squares.truncate(squares.len() - squares.len() / FAR_ROWS);
        let mean =
            |k: usize| squares.iter().map(|square| square[k]).sum::<f64>() / squares.len().max(1) as f64;
        let left = Left { positions: mean(0).sqrt(), angles: mean(1).sqrt() };
        left.both().is_finite().then_some(left)
    }

    /// Squares of what frames leave of each row: position, and angle times the length of a leg, m^2.
    fn squares(&self, frames: &Frames, rows: &[Observation]) -> Vec<[f64; 2]> {
        let lever = lever(self.hexapod);
        let square = |row: &Observation| {
            let apart = frames.departure_at(row);
            [apart.translation.powi(2), (lever * apart.rotation).powi(2)]
        };
        rows.iter().map(square).collect()
    }

    fn tried(&self, all: &[Vec<Change>]) -> Vec<PlacedWay> {
        parallel::filter_map(all, |changes| {
            let left = self.left(changes)?;
            Some(PlacedWay { left: left.both(), cost: left.as_written(changes), changes: changes.clone() })
        })
    }

    fn singles(&self) -> Vec<PlacedWay> {
        let rows = row_orders().filter(|change| !change.is_of_loads_or_legs());
        let orders =
            AngleOrder::ALL.into_iter().filter(|order| order.convention() != Some(self.hexapod.angles));
        let conventions = orders.flat_map(|order| {
            [
                Change::Pose(PoseOf::Instrument, PoseMistake::Order(order)),
                Change::PoseAngles(order),
                Change::Angles(order),
            ]
        });
        // All positions reversed are left-handed axes, turned.
        let is_mirrored = |change: &Change| {
            matches!(change, Change::Pose(_, PoseMistake::Reversed(PoseNumbers::Positions)))
        };
        let signs = of_rows().into_iter().filter(|change| !is_mirrored(change));
        let all = signs.chain(of_files()).chain(conventions).chain(rows);
        self.tried(&all.map(|change| vec![change]).collect::<Vec<_>>())
    }

    /// A second mistake beside the best single ones.
    fn pairs(&self, singles: &[PlacedWay]) -> Vec<PlacedWay> {
        let mut first: Vec<&PlacedWay> = singles.iter().collect();
        first.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        first.truncate(FIRST_OF_TWO);
        let is_row_by_row = |way: &&PlacedWay| !matches!(way.changes[0], Change::Rows(_));
        let second: Vec<&PlacedWay> = singles.iter().filter(is_row_by_row).collect();
        let both = first.iter().flat_map(|f| second.iter().map(|s| vec![f.changes[0], s.changes[0]]));
        self.tried(&both.filter(|both| both[0] != both[1]).collect::<Vec<_>>())
    }

    /// A sign, a unit or an axis that changes within the file.
    fn parts(&self, most: Most) -> Vec<PlacedWay> {
        let rows = &self.rows.observations;
        let third = rows.len().div_ceil(STRETCHES).max(1);
        let starts: Vec<Frames> =
            rows.chunks(third).map(|stretch| Frames::closest(self.hexapod, stretch)).collect();
        let part = |&change: &Change| {
            go_on();
            let changed = self.read_so(change, &self.rows);
            let found = starts.iter().filter_map(|start| self.settled(*start, rows, &changed));
            let (left, frames) = found.min_by(|a, b| a.0.total_cmp(&b.0))?;
            if !most.allows(left, left) {
                return None;
            }
            let range = self.exact(&frames, change)?;
            Some(PlacedWay { changes: vec![Change::Within(range, Multiple::of(change)?)], left, cost: left })
        };
        parallel::filter_map(&of_rows(), part)
    }

    fn read_so(&self, change: Change, data: &Dataset) -> Vec<Observation> {
        AsMeant::of(self.hexapod, data, None, &[change]).data.into_owned().observations
    }

    /// Frames and the rows that have the change, found in turn; what is left, root mean square.
    fn settled(&self, start: Frames, rows: &[Observation], changed: &[Observation]) -> Option<(f64, Frames)> {
        let (mut frames, mut left, mut known) = (start, f64::INFINITY, None);
        for _ in 0..ROUNDS {
            let [first, last] = self.range(&frames, rows, changed)?;
            if known.replace([first, last]) == Some([first, last]) {
                break;
            }
            let mixed: Vec<Observation> = (0..rows.len())
                .map(|k| if (first..=last).contains(&k) { changed[k] } else { rows[k] })
                .collect();
            frames = Frames::closest(self.hexapod, &mixed);
            left = self.left_of(&frames, &mixed)?.both();
        }
        Some((left, frames))
    }

    fn range(&self, frames: &Frames, rows: &[Observation], changed: &[Observation]) -> Option<[usize; 2]> {
        let both = self.squares(frames, rows).into_iter().zip(self.squares(frames, changed));
        let gain =
            |(written, changed): ([f64; 2], [f64; 2])| written[0] + written[1] - changed[0] - changed[1];
        best_range(&both.map(gain).collect::<Vec<_>>())
    }

    /// The lines in all of the file; none where they are most of it, or hardly any.
    fn exact(&self, frames: &Frames, change: Change) -> Option<LineRange> {
        let rows = &self.data.observations;
        let [first, last] = self.range(frames, rows, &self.read_so(change, self.data))?;
        let (concerned, count) = (last + 1 - first, rows.len());
        (is_part(concerned, count) && concerned >= LEAST_ROWS)
            .then(|| LineRange::between(rows[first].line, rows[last].line))
    }
}

/// What each row has by itself: signs, units, and columns of one of the two poses.
fn of_rows() -> Vec<Change> {
    let signs = PoseNumbers::all().map(PoseMistake::Reversed);
    let groups = [(PoseNumbers::Positions, &LENGTHS[..]), (PoseNumbers::Angles, &ANGLES[..])];
    let units = groups.into_iter().flat_map(|(group, factors)| {
        factors
            .iter()
            .flat_map(move |f| [PoseMistake::Scaled(group, *f), PoseMistake::Scaled(group, f.recip())])
    });
    let columns = SignedAxes::all()
        .into_iter()
        .filter(|axes| !axes.is_a_sign())
        .flat_map(|axes| [PoseMistake::Positions(axes), PoseMistake::Angles(axes)]);
    let all: Vec<PoseMistake> = signs.chain(units).chain(columns).collect();
    let of = |of: PoseOf| all.iter().map(move |mistake| Change::Pose(of, *mistake));
    of(PoseOf::Instrument).chain(of(PoseOf::Command)).collect()
}

/// What a file has throughout; of the commanded poses it is the same.
fn of_files() -> [Change; 2] {
    [PoseMistake::LeftHanded, PoseMistake::Inverse].map(|mistake| Change::Pose(PoseOf::Instrument, mistake))
}

#[cfg(test)]
mod tests {
    use hexbench_core::{Columns, Measurand, Pose, Wrench};

    use super::*;
    use crate::test_machine::machine;

    fn way(cost: f64) -> PlacedWay {
        PlacedWay { changes: Vec::new(), left: cost, cost }
    }

    #[test]
    fn ways_that_leave_half_as_much_again_as_the_best_are_as_good() {
        let all = [1.0, 1.49, 1.51, 4.0].map(way);
        let count = |left, cost| good(&all, Most { left, cost }).len();
        assert_eq!([count(9.0, 9.0), count(1.2, 9.0), count(9.0, 0.5)], [2, 1, 0]);
        assert!((Left { positions: 3.0, angles: 4.0 }.both() - 5.0).abs() < 1e-12);
    }

    /// Poses of which every measured height has the other sign; the heights, m.
    fn other_side(height: f64) -> Dataset {
        let rows = (0..8_u8).map(|k| {
            let sign = |bit: u8| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
            let pose = |side: f64| {
                let height = side * height * sign(0) * sign(1);
                [0.05 * sign(0), 0.04 * sign(1), height, 0.02 * sign(2), 0.0, 0.0]
            };
            let commanded = Pose::from_array(pose(1.0));
            let mut row =
                Observation::unread(commanded, Wrench::from_array([0.0; 6]), Wrench::from_array([0.0; 6]));
            (row.measured, row.line) = (pose(-1.0), u64::from(k) + 2);
            row
        });
        Dataset::of_poses("", Measurand::AbsolutePose, Columns::default(), rows.collect())
    }

    #[test]
    fn poses_are_asked_for_mistakes_from_two_percent_of_what_was_commanded_on() {
        // 64 mm were commanded, root mean square, and twice the height is missed.
        assert!(misplaced(&machine(), &other_side(0.5e-3)).is_none());
        let found = misplaced(&machine(), &other_side(1e-3)).unwrap();
        assert!((found.written / 2e-3 - 1.0).abs() < 0.1 && found.ways[0].left < 1e-6, "{}", found.written);
    }
}
