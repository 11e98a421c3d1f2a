//! How the rows of a plan come about: poses, loads, surroundings, repeats.

use hexbench_core::{Approach, Hexapod, Measurand, Pose, Wrench};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::{PlanRow, pick, rounded};
use crate::Situation;

/// Where the poses come from.
#[derive(Debug, Clone, PartialEq)]
pub enum Poses {
    /// These.
    Listed(Vec<Pose>),
    /// So many, each drawn evenly within +-`half` of the zero pose.
    Drawn {
        /// Number of poses.
        count: u64,
        /// Half range `[a, b, c, alpha, beta, gamma]`, mm and deg.
        half_mm_deg: [f64; 6],
    },
}

impl Poses {
    /// Number of poses.
    pub fn count(&self) -> u64 {
        match self {
            Self::Listed(poses) => poses.len() as u64,
            Self::Drawn { count, .. } => *count,
        }
    }

    /// The pose of an index, which must be below the count when poses are listed.
    fn pose(&self, index: u64, rng: &mut Pcg64) -> Pose {
        match self {
            Self::Listed(poses) => {
                usize::try_from(index).ok().and_then(|i| poses.get(i)).copied().unwrap_or_default()
            }
            Self::Drawn { half_mm_deg, .. } => pose_of(half_mm_deg.map(|half| within(half, rng))),
        }
    }
}

/// A quantity of the surroundings from row to row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spread {
    /// Always this.
    Fixed(f64),
    /// Evenly between two limits.
    Even([f64; 2]),
    /// Normal about zero with this standard deviation.
    Normal(f64),
}

impl Spread {
    fn draw(self, rng: &mut Pcg64) -> f64 {
        match self {
            Self::Fixed(value) => value,
            Self::Even([low, high]) => rounded(rng.random_range(low..high)),
            Self::Normal(sigma) => {
                let x: f64 = StandardNormal.sample(rng);
                rounded(sigma * x)
            }
        }
    }
}

/// A plan before its rows are drawn. Every pose sees every load, every condition is read `repeats` times.
#[derive(Debug, Clone, PartialEq)]
pub struct Scheme {
    /// What is read.
    pub measurand: Measurand,
    /// Poses.
    pub poses: Poses,
    /// Wrenches in the loaded state.
    pub loads: Vec<Wrench>,
    /// Wrench in the reference state.
    pub reference: Wrench,
    /// Readings of each condition.
    pub repeats: u64,
    /// Ways to approach the load, one of which is drawn for each condition.
    pub approaches: Vec<Approach>,
    /// Change of temperature, K.
    pub delta_t: Spread,
    /// Waiting time, s.
    pub elapsed: Spread,
    /// Time the reference load had rested at the reference reading, s; none: left open, and not in the file.
    pub reference_age: Option<Spread>,
    /// True when every repeat has surroundings of its own.
    pub anew: bool,
    /// True when the loads at a pose are put on one after the other, in the order listed, under one reference reading for each repeat; the
    /// waiting times add up.
    pub in_sequence: bool,
}

impl Scheme {
    /// Deflections at no pose and under no load yet; each is read once, straight at the load, and nothing changes around the machine.
    pub fn plain() -> Self {
        Self {
            measurand: Measurand::DeflectionEuler,
            poses: Poses::Listed(Vec::new()),
            loads: Vec::new(),
            reference: Wrench::default(),
            repeats: 1,
            approaches: vec![Approach::Direct],
            delta_t: Spread::Fixed(0.0),
            elapsed: Spread::Fixed(0.0),
            reference_age: None,
            anew: false,
            in_sequence: false,
        }
    }

    /// The same with loads approached in every way, at changing temperatures, after changing times.
    pub fn varied() -> Self {
        Self {
            approaches: Approach::ALL.to_vec(),
            delta_t: Spread::Normal(0.3),
            elapsed: Spread::Even([5.0, 300.0]),
            ..Self::plain()
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> u64 {
        self.conditions() * self.repeats
    }

    /// Number of pairs of pose and load.
    pub fn conditions(&self) -> u64 {
        self.poses.count() * self.loads.len() as u64
    }

    /// The pose of an index.
    pub fn pose(&self, index: u64, rng: &mut Pcg64) -> Pose {
        self.poses.pose(index, rng)
    }

    /// A pose under a load, with approach and surroundings drawn.
    pub fn situation(&self, pose: Pose, wrench: Wrench, rng: &mut Pcg64) -> Situation {
        let approach = match *self.approaches.as_slice() {
            [] => Approach::default(),
            [only] => only,
            // Two ways are decided as a coin is tossed.
            [heads, tails] => [tails, heads][usize::from(rng.random_bool(0.5))],
            ref many => pick(rng, many),
        };
        Situation {
            reference: self.reference,
            approach,
            delta_t: self.delta_t.draw(rng),
            elapsed: self.elapsed.draw(rng),
            reference_age: self.reference_age.map(|age| age.draw(rng)),
            ..Situation::new(pose, wrench)
        }
    }

    /// All rows, drawn one after the other from one generator.
    pub fn draw(&self, rng: &mut Pcg64) -> Vec<PlanRow> {
        let mut rows = Vec::new();
        for (index, pose_id) in (0..self.poses.count()).zip(1..) {
            let pose = self.pose(index, rng);
            for (load, &wrench) in (0..).zip(&self.loads) {
                let first = rows.len();
                self.condition(pose_id, pose, wrench, rng, &mut rows);
                for (repeat, row) in (0..).zip(&mut rows[first..]) {
                    self.place(row, [index, repeat, load]);
                }
                if self.in_sequence && load > 0 {
                    let count = rows.len() - first;
                    for row in first..rows.len() {
                        rows[row].situation.elapsed += rows[row - count].situation.elapsed;
                    }
                }
            }
        }
        rows
    }

    /// Says when a row comes, and against which reference it is read; `[pose, repeat, load]` from 0.
    pub(crate) fn place(&self, row: &mut PlanRow, [pose, repeat, load]: [u64; 3]) {
        if !self.in_sequence {
            return;
        }
        let record = pose * self.repeats + repeat;
        let from_one = |n: u64| i64::try_from(n).unwrap_or(i64::MAX - 1) + 1;
        row.reference_record = Some(from_one(record));
        row.order = Some(from_one(record * self.loads.len() as u64 + load));
    }

    fn condition(&self, pose_id: i64, pose: Pose, wrench: Wrench, rng: &mut Pcg64, rows: &mut Vec<PlanRow>) {
        let mut situation = self.situation(pose, wrench, rng);
        for (repeat, _) in (1..).zip(0..self.repeats) {
            if self.anew && repeat > 1 {
                situation = self.situation(pose, wrench, rng);
            }
            rows.push(PlanRow::alone(pose_id, repeat, situation));
        }
    }
}

/// Half range of drawn poses: +-30 mm, +-15 mm along z and +-8 deg, for a machine of the paper's size.
pub fn usual_half_range_mm_deg(hexapod: &Hexapod) -> [f64; 6] {
    const PAPER_SIZE_M: f64 = 0.1;
    let height = -hexapod.base_centre().z;
    let size = (hexapod.platform_radius().min(0.8 * height) / PAPER_SIZE_M).clamp(0.4, 3.0);
    let travel = 30.0 * if (0.7..1.3).contains(&size) { 1.0 } else { size };
    [travel, travel, 0.5 * travel, 8.0, 8.0, 8.0]
}

/// A pose from mm and deg.
pub(crate) fn pose_of(mm_deg: [f64; 6]) -> Pose {
    let [a, b, c, x, y, z] = mm_deg;
    let [x, y, z] = [x, y, z].map(f64::to_radians);
    Pose::from_array([a * 1e-3, b * 1e-3, c * 1e-3, x, y, z])
}

fn within(half: f64, rng: &mut Pcg64) -> f64 {
    if half > 0.0 { rounded(rng.random_range(-half..half)) } else { 0.0 }
}
