//! The readings that are tried: what the campaign shows the machine can do, in round numbers.
//!
//! Poses lie in the range of the campaign, never narrower than a tenth of the platform radius and three degrees: its middle, the
//! ends of each coordinate, and a scrambled Sobol sequence (Owen 1995, Burley 2020). Loads are those of the campaign, and forces
//! and moments along every axis, none so large that a leg carries more than it has carried. Both ways to approach, waits (longer
//! ones too) and temperatures vary where one of the explanations depends on them.

use hexbench_core::{Approach, Hexapod, Measurand, Observation, Pose, Vector6, Wrench};
use sobol_burley::sample;

use super::kind::{round_down, snapped, step};
use crate::effects::term::Need;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::Fit;
use crate::machine::kinematics::Legs;

/// Poses inside the range, beside its middle and its ends.
const INNER_POSES: u32 = 11;
/// Scrambling of their sequence: the same campaign gives the same poses.
const SCRAMBLING: u32 = 0;
/// Readings tried, about.
const MOST_READINGS: usize = 500;
/// Poses tried at least.
const FEWEST_POSES: usize = 6;
/// Own loads of the campaign that are tried.
const OWN_LOADS: usize = 6;
/// The smaller of two sizes of each load.
const SMALL_SHARE: f64 = 0.3;
/// Waits may be so much longer than the longest: they ask for patience only.
const LONGER: f64 = 5.0;
/// A leg may carry so much more than it has carried: rounding, and poses beside the middle.
const LEG_FORCE_SLACK: f64 = 1.05;

/// Readings to choose from; `fits` tell on what the explanations depend.
pub(super) fn candidate_readings(campaign: &Campaign, fits: &[&Fit]) -> Result<Vec<Observation>, ModelError> {
    let Some(first) = campaign.groups.first().map(|g| g.mean) else { return Ok(Vec::new()) };
    let needs = Needs::of(campaign, fits);
    let strongest = strongest(campaign)?;
    let loads = loads(campaign, strongest);
    let states = needs.states(campaign);
    let count = (MOST_READINGS / (loads.len() * states.len()).max(1)).max(FEWEST_POSES);
    let mut candidate_readings = Vec::new();
    for pose in poses(campaign).into_iter().take(count) {
        let Some(legs) = legs(campaign, &pose) else { continue };
        for wrench in &loads {
            if carried(&legs, [wrench, &first.reference]) > strongest * LEG_FORCE_SLACK {
                continue;
            }
            for &(approach, elapsed, delta_t) in &states {
                let measured = still(campaign, &pose);
                let row =
                    Observation { pose, wrench: *wrench, approach, elapsed, delta_t, measured, ..first };
                candidate_readings.push(row);
            }
        }
    }
    Ok(candidate_readings)
}

/// What is read of a pose that nothing deflects.
fn still(campaign: &Campaign, pose: &Pose) -> [f64; 6] {
    if campaign.is_absolute() { campaign.frames.seen(pose).to_array() } else { [0.0; 6] }
}

fn legs(campaign: &Campaign, pose: &Pose) -> Option<Legs> {
    let hexapod = &campaign.hexapod;
    let legs = Legs::at(&hexapod.base_joints, &hexapod.platform_joints, pose).ok()?;
    let fits = hexapod.stroke.is_none_or(|[low, high]| legs.lengths.iter().all(|q| (low..=high).contains(q)));
    fits.then_some(legs)
}

/// Largest force in a leg under some wrenches, N.
fn carried(legs: &Legs, wrenches: [&Wrench; 2]) -> f64 {
    wrenches.map(|w| legs.forces(&w.to_vector()).amax()).into_iter().fold(0.0, f64::max)
}

/// Largest force that any leg of the nominal machine has carried, N: the candidates are held against it without any effect, too.
fn strongest(campaign: &Campaign) -> Result<f64, ModelError> {
    let Hexapod { base_joints, platform_joints, .. } = &campaign.hexapod;
    campaign.groups.iter().map(|g| &g.mean).try_fold(0.0, |most: f64, o| {
        let legs = Legs::at(base_joints, platform_joints, &o.pose)?;
        Ok(most.max(carried(&legs, [&o.wrench, &o.reference])))
    })
}

/// On which covariates the explanations depend, and the file has.
struct Needs {
    approach: bool,
    elapsed: bool,
    delta_t: bool,
}

impl Needs {
    fn of(campaign: &Campaign, fits: &[&Fit]) -> Self {
        let terms = || fits.iter().flat_map(|f| &f.point.active);
        let has = |need: Need| terms().any(|a| a.term.info().needs.contains(&need));
        let columns = campaign.columns;
        Self {
            approach: columns.approach && has(Need::Approach),
            elapsed: columns.elapsed && has(Need::Elapsed),
            delta_t: columns.delta_t && has(Need::DeltaT),
        }
    }

    /// Approach, wait (s) and temperature (K): the usual state and, where it matters, the ends of the campaign's range and beyond the
    /// longest wait.
    fn states(&self, campaign: &Campaign) -> Vec<(Approach, f64, f64)> {
        let rows = || campaign.groups.iter().map(|g| &g.mean);
        let mut waits: Vec<f64> = rows().map(|r| r.elapsed).collect();
        waits.sort_by(f64::total_cmp);
        let (shortest, usual, longest) = (waits[0], waits[waits.len() / 2], waits[waits.len() - 1]);
        let waits = if self.elapsed { vec![shortest, longest, LONGER * longest] } else { vec![usual] };
        let coldest = rows().map(|r| r.delta_t).fold(0.0, f64::min);
        let warmest = rows().map(|r| r.delta_t).fold(0.0, f64::max);
        let temperatures = if self.delta_t { vec![0.0, coldest, warmest] } else { vec![0.0] };
        let approaches: &[Approach] = if self.approach { &Approach::ALL } else { &[Approach::Direct] };
        let mut states = Vec::new();
        for &approach in approaches {
            for &wait in &waits {
                states
                    .extend(temperatures.iter().map(|&t| (approach, round_down(wait, 2), round_down(t, 1))));
            }
        }
        states.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2)));
        states.dedup();
        states
    }
}

/// The middle, the ends of each coordinate, then poses all over the range; each coordinate a round number.
fn poses(campaign: &Campaign) -> Vec<Pose> {
    let half = half_ranges(campaign);
    let at = |share: [f64; 6]| {
        let coordinate = |k: usize| {
            let step = step(k, half[k]);
            let x = snapped(half[k] * share[k], step);
            if x.abs() > half[k] * (1.0 + 1e-9) { x - step.copysign(x) } else { x }
        };
        Pose::from_array(std::array::from_fn(coordinate))
    };
    let mut shares = vec![[0.0; 6]];
    for sign in [1.0, -1.0] {
        shares.extend((0..6).map(|k| std::array::from_fn(|i| if i == k { sign } else { 0.0 })));
    }
    let inner = (0..INNER_POSES).map(inner_shares);
    // Few poses must still be different in everything: ends and inner ones in turn.
    let mut mixed = vec![shares[0]];
    let mut ends = shares.into_iter().skip(1);
    for share in inner {
        mixed.push(share);
        mixed.extend(ends.next());
    }
    mixed.extend(ends);
    mixed.into_iter().map(at).collect()
}

/// Half range of each pose coordinate, m and rad.
pub(super) fn half_ranges(campaign: &Campaign) -> [f64; 6] {
    let radius = campaign.hexapod.platform_radius();
    std::array::from_fn(|k| {
        let rows = campaign.groups.iter().map(|g| g.mean.pose.to_array()[k].abs());
        rows.fold(0.0, f64::max).max(if k < 3 { 0.1 * radius } else { 3f64.to_radians() })
    })
}

/// A pose inside the range, as shares of its half, -1 to 1.
fn inner_shares(index: u32) -> [f64; 6] {
    [0, 1, 2, 3, 4, 5].map(|dimension| 2.0 * f64::from(sample(index, dimension, SCRAMBLING)) - 1.0)
}

/// The campaign's own loads, and two sizes of force and moment along every axis on top of the reference.
fn loads(campaign: &Campaign, strongest: f64) -> Vec<Wrench> {
    let rows = || campaign.groups.iter().map(|g| &g.mean);
    let mut loads: Vec<Wrench> = Vec::new();
    for row in rows().filter(|r| same(&r.reference, &campaign.groups[0].mean.reference)) {
        if loads.len() < OWN_LOADS && !loads.iter().any(|w| same(w, &row.wrench)) {
            loads.push(row.wrench);
        }
    }
    let absolute = campaign.measurand == Measurand::AbsolutePose;
    let reference = if absolute { Vector6::zeros() } else { campaign.groups[0].mean.reference.to_vector() };
    let change = |r: &Observation| (r.wrench.force - r.reference.force).norm();
    let moment_change = |r: &Observation| (r.wrench.moment - r.reference.moment).norm();
    let force = rows().map(change).fold(0.0, f64::max).max(1.0);
    let arm = 0.5 * campaign.hexapod.platform_radius();
    let moment = rows().map(moment_change).fold(0.0, f64::max).max(force * arm);
    let Some(legs) = legs(campaign, &Pose::default()) else { return loads };
    for axis in 0..6 {
        for sign in [1.0, -1.0] {
            let wanted = sign * if axis < 3 { force } else { moment };
            // Round is what is set, not its change.
            let with = |share: f64| {
                let mut w = reference;
                w[axis] = round_down(w[axis] + wanted * share, 2);
                w
            };
            let fits = |share: &f64| legs.forces(&with(*share)).amax() <= strongest;
            let Some(large) = [1.0, 0.8, 0.6, 0.4].into_iter().find(fits) else { continue };
            loads.extend([large, large * SMALL_SHARE].map(|share| wrench(&with(share))));
        }
    }
    loads
}

fn same(a: &Wrench, b: &Wrench) -> bool {
    a.to_array().map(f64::to_bits) == b.to_array().map(f64::to_bits)
}

fn wrench(w: &Vector6) -> Wrench {
    Wrench::from_array(std::array::from_fn(|k| w[k]))
}
