//! One pose, or one load, of absolute poses that leads every explanation astray.
//!
//! A pose is read under a load or two. One that is not what the file says bends frames, joints and springs towards it, so that what is
//! left looks like several wrong poses, or like something that no catalogue has. Without it, the springs explain all others: each pose and each
//! condition is left out in turn.

use std::collections::HashMap;

use hexbench_core::words::joined;
use hexbench_core::{Dataset, Hexapod, Vector6, parallel};

use super::judged::{Judged, prepare};
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Fit, Start, fit_baseline, refit};
use crate::estimation::linearization::Linearization;
use crate::estimation::residuals::is_what_noise_gives;
use crate::inference::examination::{Finding, FindingKind};
use crate::inference::verdict::{Verdict, judge};

/// Poses without one of which the others still tell the machine.
const LEAST_POSES: usize = 12;
/// A pose that is the fault leaves this part of chi-square at most when it is left out, whatever else is wrong with the machine.
const LEFT_OF_FAR_OFF: f64 = 0.1;
/// Fall of chi-square beyond which one condition of a hundred is at fault, and not bad luck: twice the evidence that is asked of any fault.
const EVIDENT: f64 = 50.0;

/// Readings at one pose, or under one load there.
struct LeftOut {
    groups: Vec<usize>,
    /// The fit to all others.
    others: Fit,
}

/// The fault that explains why absolute poses contradict each other, or why nothing of the catalogue explains them.
pub(super) fn lone_fault(hexapod: &Hexapod, data: &Dataset, judged: &Judged) -> Option<Finding> {
    if !data.is_absolute() {
        return None;
    }
    let contradicts = judged.findings.iter().any(|f| f.kind == FindingKind::Inconsistent);
    let is_outside = || judge(&judged.outcome.sets, &judged.outcome.candidates).verdict == Verdict::Outside;
    if !contradicts && !is_outside() {
        return None;
    }
    let campaign = prepare(hexapod, data).ok()?;
    let all = fit_baseline(&campaign).ok()?;
    let poses = of_poses(&campaign);
    if poses.len() < LEAST_POSES {
        return None;
    }
    let conditions: Vec<Vec<usize>> = (0..campaign.groups.len()).map(|g| vec![g]).collect();
    let is_explained = |left: &LeftOut| {
        let Fit { lack_of_fit, lack_of_fit_dof: dof, .. } = left.others;
        is_what_noise_gives(lack_of_fit / dof.max(1.0), dof) && all.lack_of_fit - lack_of_fit > EVIDENT
    };
    let is_near = |left: &LeftOut| contradicts && left.others.lack_of_fit < LEFT_OF_FAR_OFF * all.lack_of_fit;
    // One condition rather than all at its pose.
    let best = |sets: &[Vec<usize>]| least(&campaign, &all, sets);
    let found = best(&conditions)
        .filter(is_explained)
        .or_else(|| best(&poses).filter(|p| is_explained(p) || is_near(p)));
    finding(&campaign, data, &found?)
}

/// Conditions at each pose.
fn of_poses(campaign: &Campaign) -> Vec<Vec<usize>> {
    let mut place = HashMap::new();
    let mut poses: Vec<Vec<usize>> = Vec::new();
    for (g, group) in campaign.groups.iter().enumerate() {
        let pose = *place.entry(group.mean.pose.bits()).or_insert(poses.len());
        poses.resize(poses.len().max(pose + 1), Vec::new());
        poses[pose].push(g);
    }
    poses
}

/// The set without which the springs leave least.
fn least(campaign: &Campaign, all: &Fit, sets: &[Vec<usize>]) -> Option<LeftOut> {
    let start = Start::at(campaign, &[], &all.point).ok()?;
    let without = |groups: &Vec<usize>| {
        let kept: Vec<usize> = (0..campaign.groups.len()).filter(|g| !groups.contains(g)).collect();
        let others = refit(campaign, &[], &start, &kept).ok()?;
        Some(LeftOut { groups: groups.clone(), others })
    };
    let left = parallel::map(sets, without);
    left.into_iter().flatten().min_by(|a, b| a.others.lack_of_fit.total_cmp(&b.others.lack_of_fit))
}

/// What is told of it: how far the readings are from what the others let expect.
fn finding(campaign: &Campaign, data: &Dataset, left: &LeftOut) -> Option<Finding> {
    let there = Linearization::at(&campaign.chosen(&left.groups), &left.others.point).ok()?;
    let off = |i: usize| there.conditions[i].weights.numbers(there.residual(i));
    let largest = |first: usize| {
        let size = |off: Vector6| off.fixed_rows::<3>(first).norm();
        (0..left.groups.len()).map(|i| size(off(i))).fold(0.0, f64::max)
    };
    let [far, turned] = [0, 3].map(largest);
    let rows = left.groups.iter().flat_map(|&g| campaign.groups[g].rows.iter());
    let mut lines: Vec<u64> = rows.map(|&i| data.observations[i as usize].line).collect();
    lines.sort_unstable();
    let named = joined(&lines.iter().map(u64::to_string).collect::<Vec<_>>());
    let size = format!("{:.3} mm and {:.4} deg", 1e3 * far, turned.to_degrees());
    Some(Finding {
        rows: lines,
        text: format!(
            "the readings in lines {named} are {size} from what all others let expect: their pose or their load is not what the file says, \
             or they were read wrong"
        ),
        size,
        next: "compare pose, load and readings of these lines with the record".to_owned(),
        ..Finding::of(FindingKind::Blunder)
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use std::path::Path;

    use hexbench_core::files::{read_hexapod, read_measurements};

    use super::*;
    use crate::inference::diagnosis::explain;

    /// A bundled case with a screw whose pitch errs, read at 40 poses, and what is found where its readings are said to contradict each other.
    fn found(change: impl Fn(&mut Dataset)) -> Option<Finding> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/cases/absolute-pitch");
        let hexapod = read_hexapod(&folder.join("hexapod.toml")).unwrap();
        let mut data = read_measurements(&folder.join("measurements.csv")).unwrap().dataset;
        change(&mut data);
        let campaign = prepare(&hexapod, &data).unwrap();
        let outcome = explain(&campaign, &[]).unwrap();
        let contradicts = vec![Finding::of(FindingKind::Inconsistent)];
        lone_fault(&hexapod, &data, &Judged::of(data.clone(), campaign, outcome, contradicts))
    }

    #[test]
    fn the_one_pose_without_which_the_others_belong_together_is_told_with_its_distance() {
        let finding = found(|data| {
            let wrong = data.observations[20].pose.bits();
            let rows = data.observations.iter_mut().filter(|o| o.pose.bits() == wrong);
            rows.for_each(|o| o.pose.translation.x += 4e-3);
        });
        let finding = finding.unwrap();
        assert!(finding.rows.contains(&22) && finding.rows.len() == 4, "{:?}", finding.rows);
        assert!(finding.size.starts_with("4.0") || finding.size.starts_with("3.9"), "{}", finding.size);
    }

    #[test]
    fn readings_of_which_no_single_pose_is_at_fault_are_left_alone() {
        assert!(found(|_| ()).is_none());
        let several = found(|data| {
            for (i, row) in data.observations.iter_mut().enumerate().filter(|(i, _)| i / 4 % 7 == 0) {
                row.measured[i / 4 % 3] += 2e-3;
            }
        });
        assert!(several.is_none(), "{several:?}");
    }
}
