//! From records of a measuring machine and a table of loads to readings: each loaded record against its reference.
//!
//! ```text
//! deflection = pose(loaded) - pose(reference)          covariance: the sum of both
//! wrench     = wrench of the table + m g [u; (R p) x u]  a mass on the point p of the platform, pulling along u
//! ```
//!
//! If the positions of the balls are unknown, they follow from the commanded poses of the reference records: `p = R^T (touched -
//! t)`, the median over the records. The position error of a machine is about a thousandth of the lever arm of a ball, and so is
//! the relative error of a reading.

mod moved;
mod order;
mod placing;
mod points;
mod shape;

use hexbench_core::{
    BallPlace, BallPlaces, BallRecord, Dataset, LoadRow, LoadTable, Matrix6, Measurand, Observation, Pose,
    Vector3, Wrench,
};

use super::{Places, Registered, RegisteredPose, RegistrationError, register_all};
pub use moved::MovedBall;
pub use placing::InstrumentAxes;
use placing::{Fixed, Placing};
use shape::by_commands;

/// Acceleration of free fall as agreed upon, m/s^2.
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// How records are read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RecordsRead<'a> {
    /// Where the balls should be; none: where the commanded poses of the reference records put them.
    pub places: Option<&'a BallPlaces>,
    /// Standard deviation of one coordinate, m; none: that of the places, else of the residuals.
    pub sigma: Option<f64>,
    /// Acceleration of free fall, m/s^2.
    pub gravity: f64,
    /// Whether the axes of the measuring machine are turned into those of the hexapod by the commanded poses.
    pub align: bool,
}

/// Readings out of records.
#[derive(Debug, Clone, PartialEq)]
pub struct BallCampaign {
    /// Readings as `measurements.csv` has them.
    pub dataset: Dataset,
    /// Covariance of the six numbers of each row, m and rad.
    pub covariances: Vec<Matrix6>,
    /// How far every ball moved in each row, fixed axes, m, in the order of the places.
    pub displacements: Vec<Vec<Vector3>>,
    /// Balls of the platform, mobile frame.
    pub balls: Vec<BallPlace>,
    /// True when the commanded poses told where the balls are.
    pub placed_by_commands: bool,
    /// Balls of the base, fixed frame.
    pub base: Vec<BallPlace>,
    /// Standard deviation of one coordinate that was used, m.
    pub sigma: f64,
    /// The same from the residuals; none when nothing is left over.
    pub estimated_sigma: Option<f64>,
    /// How the axes of the measuring machine stand to those of the hexapod; none with balls on the base.
    pub axes: Option<InstrumentAxes>,
    /// Balls that moved on the platform between a reference and its loaded record.
    pub moved: Vec<MovedBall>,
    /// Records that no row names.
    pub unused: Vec<String>,
}

/// Why records and loads give no readings.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BallCampaignError {
    /// Balls that give no pose.
    #[error("{0}")]
    Registration(#[from] RegistrationError),
    /// A record that does not exist.
    #[error("line {line} of the loads: there is no record {record} in the table of balls")]
    NoRecord {
        /// Line of the loads.
        line: u64,
        /// What was asked for.
        record: String,
    },
    /// A record against itself.
    #[error("line {line} of the loads: record {record} is used both as loaded and as reference state")]
    SameRecord {
        /// Line of the loads.
        line: u64,
        /// The record.
        record: String,
    },
    /// Absolute poses need to know where the balls are.
    #[error(
        "without the column ref_record the rows are absolute poses, and the positions of the balls are unknown"
    )]
    NoPlaces,
    /// Names of balls that were exchanged.
    #[error("line {line}: record {record}: the balls are named in a different order; with {} it matches the commanded pose", exchanged.join(", "))]
    Exchanged {
        /// Line where the record begins.
        line: u64,
        /// The record.
        record: String,
        /// `P1 for P2`, name in the file for name of the ball that stands there.
        exchanged: Vec<String>,
    },
    /// Left-handed coordinates.
    #[error(
        "the measured balls are a mirror image of their arrangement at the commanded poses ({left_mm:.3} mm apart as measured, {mirrored_mm:.3} mm mirrored)"
    )]
    Mirrored {
        /// Root mean square distance as touched, mm.
        left_mm: f64,
        /// The same of the mirror image, mm.
        mirrored_mm: f64,
    },
    /// Records that do not follow the commands.
    #[error(
        "line {line}: record {record}: the balls are {left_mm:.3} mm from their positions at the commanded pose"
    )]
    Astray {
        /// Line where the record begins.
        line: u64,
        /// The record that is farthest.
        record: String,
        /// Root mean square distance, mm.
        left_mm: f64,
    },
}

/// A row of the loads with its records.
struct Pair<'a> {
    load: &'a LoadRow,
    row: &'a Observation,
    loaded: usize,
    reference: Option<usize>,
}

/// Readings of all rows of the loads.
///
/// # Errors
/// [`BallCampaignError`].
pub fn campaign_of_balls(
    records: &[BallRecord],
    loads: &LoadTable,
    how: &RecordsRead<'_>,
) -> Result<BallCampaign, BallCampaignError> {
    let pairs = pairs(records, loads)?;
    let known = match how.places {
        Some(places) => Places::nominal(places),
        None => by_commands(records, &pairs)?,
    };
    let used: Vec<usize> = pairs.iter().flat_map(|p| p.reference.into_iter().chain([p.loaded])).collect();
    let is_used = |k: &usize| used.contains(k);
    let in_use: Vec<BallRecord> = (0..records.len()).filter(is_used).map(|k| records[k].clone()).collect();
    let sigma = how.sigma.or_else(|| how.places.and_then(|places| places.sigma));
    let mut found = register_all(&in_use, &known, sigma)?;
    if let (None, None, Some(left)) = (how.places, sigma, found.estimated_sigma) {
        // The records have told the shape of the balls too: one of them is used up.
        let share = 1.0 - 1.0 / in_use.len() as f64;
        found = register_all(&in_use, &known, Some(left / share.sqrt()))?;
    }
    let placing = Placing::new(records, &known, &commands(&pairs))?;
    // The frame of the target is open where absolute poses are read: there the balls may stand anywhere on the platform.
    if pairs.iter().any(|pair| pair.reference.is_some()) {
        placing.refuse_other_orders()?;
    }
    let fixed = placing.fixed(how.align);
    let of_record = |k: usize| &found.poses[(0..k).filter(is_used).count()];
    let rows: Vec<Reading> = pairs.iter().map(|p| reading(p, &of_record, &fixed, how.gravity)).collect();
    let moved = pairs.iter().filter_map(|p| moved::between(records, &known, p, found.sigma)).collect();
    let displacements = pairs.iter().map(|p| displacements(&placing, &fixed, p)).collect();
    let unused = (0..records.len()).filter(|k| !is_used(k)).map(|k| records[k].id.clone()).collect();
    Ok(BallCampaign {
        dataset: dataset(loads, &pairs, &rows, &found),
        covariances: rows.iter().map(|row| row.covariance).collect(),
        displacements,
        axes: placing.axes(),
        base: known.base,
        balls: known.platform,
        placed_by_commands: how.places.is_none(),
        sigma: found.sigma,
        estimated_sigma: found.estimated_sigma,
        moved,
        unused,
    })
}

fn pairs<'a>(records: &[BallRecord], loads: &'a LoadTable) -> Result<Vec<Pair<'a>>, BallCampaignError> {
    let find = |load: &LoadRow, record: &String| {
        let at = records.iter().position(|r| r.id == *record);
        at.ok_or_else(|| BallCampaignError::NoRecord { line: load.line, record: record.clone() })
    };
    let pair = |(load, row): (&'a LoadRow, &'a Observation)| {
        let reference = load.reference.as_ref().map(|record| find(load, record)).transpose()?;
        let loaded = find(load, &load.record)?;
        if reference == Some(loaded) {
            return Err(BallCampaignError::SameRecord { line: load.line, record: load.record.clone() });
        }
        Ok(Pair { load, row, loaded, reference })
    };
    loads.rows.iter().zip(&loads.dataset.observations).map(pair).collect()
}

/// Records that stood at a commanded pose under the smaller load, and that pose.
fn commands(pairs: &[Pair<'_>]) -> Vec<(usize, Pose)> {
    pairs.iter().flat_map(|p| p.reference.into_iter().chain([p.loaded]).map(|k| (k, p.row.pose))).collect()
}

/// The six numbers of a row, and its wrenches.
struct Reading {
    measured: [f64; 6],
    covariance: Matrix6,
    wrenches: [Wrench; 2],
}

fn reading<'a>(
    pair: &Pair<'_>,
    of_record: &impl Fn(usize) -> &'a RegisteredPose,
    fixed: &Fixed,
    gravity: f64,
) -> Reading {
    let (loaded, mut covariance) = fixed.pose(of_record(pair.loaded));
    let mut measured = loaded.to_array();
    if let Some(reference) = pair.reference {
        let (from, its) = fixed.pose(of_record(reference));
        let start = from.to_array();
        for k in 0..6 {
            let change = measured[k] - start[k];
            measured[k] = if k < 3 { change } else { wrapped(change) };
        }
        covariance += its;
    }
    let hung = &pair.load.hung;
    let pull = |mass: f64| {
        let force = hung.direction * (mass * gravity);
        Wrench { force, moment: (pair.row.pose.rotation() * hung.point).cross(&force) }
    };
    let sum = |given: &Wrench, mass: f64| {
        let own = pull(mass);
        Wrench { force: given.force + own.force, moment: given.moment + own.moment }
    };
    let wrenches = [sum(&pair.row.wrench, hung.loaded), sum(&pair.row.reference, hung.reference)];
    Reading { measured, covariance, wrenches }
}

/// An angle within half a turn, rad.
fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::TAU;
    angle - TAU * (angle / TAU).round()
}

fn displacements(placing: &Placing<'_>, fixed: &Fixed, pair: &Pair<'_>) -> Vec<Vector3> {
    let loaded = placing.centres(pair.loaded);
    let Some(reference) = pair.reference else { return Vec::new() };
    loaded.iter().zip(placing.centres(reference)).map(|(l, r)| fixed.turned(&(l - r))).collect()
}

fn dataset(loads: &LoadTable, pairs: &[Pair<'_>], rows: &[Reading], found: &Registered) -> Dataset {
    let is_absolute = pairs.iter().all(|pair| pair.reference.is_none());
    let shared = |pair: &Pair<'_>| pairs.iter().filter(|other| other.reference == pair.reference).count() > 1;
    let shares = !is_absolute && pairs.iter().any(shared);
    let states_sigma = found.sigma > 0.0;
    let row = |(pair, row): (&Pair<'_>, &Reading)| Observation {
        wrench: row.wrenches[0],
        reference: row.wrenches[1],
        reference_record: pair.reference.filter(|_| shares).and_then(|k| i64::try_from(k + 1).ok()),
        measured: row.measured,
        sigma: states_sigma.then(|| std::array::from_fn(|k| row.covariance[(k, k)].sqrt())),
        ..*pair.row
    };
    let mut columns = loads.dataset.columns;
    columns.sigma = states_sigma;
    columns.reference_record = shares;
    columns.reference &= !is_absolute;
    let measurand = if is_absolute { Measurand::AbsolutePose } else { Measurand::DeflectionEuler };
    Dataset::of_poses(&loads.dataset.source, measurand, columns, pairs.iter().zip(rows).map(row).collect())
}
