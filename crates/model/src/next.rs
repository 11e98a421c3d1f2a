//! The next measurement: the pose and load at which two rival models predict the most different readings.
//!
//! Gain of a reading = expected logarithm of the Bayes factor between the rivals,
//! `d' (Sigma + V_a + V_b)^-1 d / 2` with `d` the difference of their predictions, `Sigma` the noise and `V` the
//! uncertainty of each prediction. Source: Box and Hill 1967, Technometrics 9 (discrimination among models).

use hexbench_core::{Dataset, Matrix6, Measurand, Observation, Pose, Vector6, Wrench};
use rayon::prelude::*;

use crate::campaign::Campaign;
use crate::error::ModelError;
use crate::fit::{Fit, columns};
use crate::linearization::Linearization;

/// Poses tried.
const POSES: usize = 24;
/// Readings proposed.
const PROPOSALS: usize = 3;
/// Smallest gain worth proposing, nats.
const WORTHWHILE: f64 = 0.5;

/// One proposed reading.
#[derive(Debug, Clone, PartialEq)]
pub struct Proposal {
    /// What to set.
    pub observation: Observation,
    /// Expected logarithm of the Bayes factor, nats.
    pub gain: f64,
}

/// The readings that best separate two fits of the same campaign.
///
/// # Errors
/// [`ModelError::SingularPose`] when no pose can be evaluated.
pub fn separate(campaign: &Campaign, a: &Fit, b: &Fit) -> Result<Vec<Proposal>, ModelError> {
    let menu = menu(campaign);
    let scored: Vec<Proposal> =
        menu.par_chunks(16).flat_map_iter(|chunk| gains(campaign, chunk, a, b).unwrap_or_default()).collect();
    let mut scored: Vec<Proposal> = scored.into_iter().filter(|p| p.gain.is_finite()).collect();
    scored.sort_by(|x, y| y.gain.total_cmp(&x.gain));
    let mut chosen: Vec<Proposal> = Vec::new();
    for p in scored.into_iter().filter(|p| p.gain > WORTHWHILE) {
        let fresh = |c: &Proposal| {
            c.observation.wrench != p.observation.wrench && c.observation.pose != p.observation.pose
        };
        if chosen.iter().all(fresh) {
            chosen.push(p);
        }
        if chosen.len() == PROPOSALS {
            break;
        }
    }
    Ok(chosen)
}

fn gains(campaign: &Campaign, rows: &[Observation], a: &Fit, b: &Fit) -> Result<Vec<Proposal>, ModelError> {
    let dataset = Dataset {
        source: String::new(),
        measurand: campaign.measurand,
        columns: campaign.columns,
        observations: rows.to_vec(),
    };
    // One group per row: the rows differ in what is set.
    let plan = Campaign::with_noise(&campaign.hexapod, &dataset, campaign.noise)?;
    let (at_a, at_b) = (Linearization::at(&plan, &a.point)?, Linearization::at(&plan, &b.point)?);
    let (ya, yb) = (at_a.predictions(), at_b.predictions());
    let (ja, jb) = (columns(&at_a, &a.point), columns(&at_b, &b.point));
    let gain = |i: usize| {
        let d: Vector6 = (ya.rows(6 * i, 6) - yb.rows(6 * i, 6)).fixed_rows::<6>(0).into_owned();
        let va = ja.rows(6 * i, 6) * &a.covariance * ja.rows(6 * i, 6).transpose();
        let vb = jb.rows(6 * i, 6) * &b.covariance * jb.rows(6 * i, 6).transpose();
        let v = Matrix6::identity() + va.fixed_view::<6, 6>(0, 0) + vb.fixed_view::<6, 6>(0, 0);
        v.cholesky().map_or(0.0, |c| 0.5 * d.dot(&c.solve(&d)))
    };
    let proposals = plan.groups.iter().enumerate();
    Ok(proposals.map(|(i, g)| Proposal { observation: g.mean, gain: gain(i) }).collect())
}

/// Poses within the range of the campaign, a little widened, with loads of the size of the campaign's in every
/// direction; both approaches, short and long waits where the file has them.
fn menu(campaign: &Campaign) -> Vec<Observation> {
    let rows: Vec<&Observation> = campaign.groups.iter().map(|g| &g.mean).collect();
    let Some(first) = rows.first() else { return Vec::new() };
    let loads = loads(campaign, &rows);
    let approaches: &[f64] = if campaign.columns.approach { &[1.0, -1.0] } else { &[1.0] };
    let longest = rows.iter().map(|r| r.elapsed).fold(0.0, f64::max);
    let waits = if longest > 0.0 { vec![0.05 * longest, longest] } else { vec![0.0] };
    let mut menu = Vec::new();
    for pose in poses(campaign, &rows) {
        for wrench in &loads {
            for &approach in approaches {
                for &elapsed in &waits {
                    let measured = if campaign.is_absolute() { pose.to_array() } else { [0.0; 6] };
                    let row = Observation {
                        pose,
                        wrench: *wrench,
                        approach,
                        elapsed,
                        measured,
                        delta_t: 0.0,
                        ..**first
                    };
                    menu.push(row);
                }
            }
        }
    }
    menu
}

/// The zero pose, then a low-discrepancy sequence over the box of commanded poses, not narrower than a tenth of the
/// platform radius and three degrees.
fn poses(campaign: &Campaign, rows: &[&Observation]) -> Vec<Pose> {
    let radius = campaign.hexapod.platform_radius();
    let half: [f64; 6] = std::array::from_fn(|k| {
        let widest = rows.iter().map(|r| r.pose.to_array()[k].abs()).fold(0.0, f64::max);
        widest.max(if k < 3 { 0.1 * radius } else { 3f64.to_radians() })
    });
    let mut poses = vec![Pose::default()];
    poses.extend(
        (1..POSES).map(|i| Pose::from_array(std::array::from_fn(|k| half[k] * (2.0 * halton(i, k) - 1.0)))),
    );
    poses
}

/// Element of the Halton sequence (Halton 1960) in base of the k-th prime.
fn halton(index: usize, k: usize) -> f64 {
    let base: usize = [2, 3, 5, 7, 11, 13][k];
    let (mut fraction, mut value, mut i) = (1.0, 0.0, index);
    while i > 0 {
        fraction /= base as f64;
        value += fraction * (i % base) as f64;
        i /= base;
    }
    value
}

/// The campaign's own loads, and forces and moments of their size along every axis on top of the reference.
fn loads(campaign: &Campaign, rows: &[&Observation]) -> Vec<Wrench> {
    let reference = rows[0].reference.to_vector();
    let change = |r: &&Observation| (r.wrench.force - r.reference.force).norm();
    let force = rows.iter().map(change).fold(0.0, f64::max).max(1.0);
    let moment = 0.5 * force * campaign.hexapod.platform_radius();
    let mut loads: Vec<Wrench> = Vec::new();
    for axis in 0..6 {
        for sign in [1.0, -1.0] {
            let mut w =
                if campaign.measurand == Measurand::AbsolutePose { Vector6::zeros() } else { reference };
            w[axis] += sign * if axis < 3 { force } else { moment };
            loads.push(Wrench::from_array(std::array::from_fn(|k| w[k])));
        }
    }
    loads
}
