//! How many random poses are worth as much as designed ones.

use crate::sweep::axes::PlanSource;
use crate::sweep::page::marginal::marginal;
use crate::sweep::results::CellStatistics;
use crate::sweep::study::{SweepStudy, SweepTask};

const PLAN: usize = 1;
const POSES: usize = 2;

/// A designed plan and the random one with the same stiffness error.
#[derive(Debug, Clone, PartialEq)]
pub struct Equal {
    /// Name of the designed plan.
    pub plan: String,
    /// Its poses.
    pub poses: f64,
    /// Its stiffness error, percent rms.
    pub error_percent: f64,
    /// Error of as many random poses, percent rms.
    pub random_error_percent: f64,
    /// Random poses with the error of the designed ones.
    pub random_poses: Matching,
}

/// A number of poses between those that were tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Matching {
    /// About so many, by interpolation on logarithms.
    About(f64),
    /// More than were tried.
    MoreThan(f64),
    /// Fewer than were tried.
    FewerThan(f64),
}

/// Every designed plan of a study that also has random ones, over all other axes together.
pub fn equals(study: &SweepStudy, cells: &[CellStatistics]) -> Vec<Equal> {
    let plans = &study.axes.plan;
    let random = plans.iter().position(|p| p.source == PlanSource::Random);
    let has_curve = study.axes.poses.len() > 1 && !study.axes.is_ranged(POSES);
    let (Some(random), SweepTask::Springs, true) = (random, study.task, has_curve) else {
        return Vec::new();
    };
    let found = marginal(study, cells, POSES, Some(PLAN));
    let curve = |plan: usize| -> Vec<[f64; 2]> {
        let errors = found.groups[plan].iter().map(|c| c.springs.errors.rms());
        study.axes.poses.iter().map(|&n| n as f64).zip(errors).map(|(n, e)| [n, e]).collect()
    };
    let reference = curve(random);
    let designed = plans.iter().enumerate().filter(|(_, p)| matches!(p.source, PlanSource::Designed(_)));
    let mut all = Vec::new();
    for (index, plan) in designed {
        for (point, other) in curve(index).iter().zip(&reference) {
            let Some(random_poses) = matching(&reference, point[1]) else { continue };
            all.push(Equal {
                plan: plan.name.clone(),
                poses: point[0],
                error_percent: point[1],
                random_error_percent: other[1],
                random_poses,
            });
        }
    }
    all
}

/// Where a falling curve of `[poses, error]` has an error; none without a curve.
fn matching(curve: &[[f64; 2]], error: f64) -> Option<Matching> {
    let mut curve: Vec<[f64; 2]> = curve.iter().copied().filter(|p| p[1] > 0.0).collect();
    curve.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (first, last) = (curve.first()?, curve.last()?);
    if error.is_nan() || error <= 0.0 {
        return None;
    }
    if error > first[1] {
        return Some(Matching::FewerThan(first[0]));
    }
    for pair in curve.windows(2) {
        let [[n, e], [m, f]] = [pair[0], pair[1]];
        if (f..=e).contains(&error) && e > f {
            let share = (e / error).ln() / (e / f).ln();
            return Some(Matching::About(n * (m / n).powf(share)));
        }
    }
    Some(Matching::MoreThan(last[0]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_of_one_over_the_root_is_met_exactly() {
        let curve: Vec<[f64; 2]> = [2.0_f64, 8.0, 18.0].iter().map(|n| [*n, 1.0 / n.sqrt()]).collect();
        let Some(Matching::About(n)) = matching(&curve, 0.4) else { panic!() };
        assert!((n - 6.25).abs() < 1e-12, "{n}");
        assert_eq!(matching(&curve, 0.1), Some(Matching::MoreThan(18.0)));
        assert_eq!(matching(&curve, 0.9), Some(Matching::FewerThan(2.0)));
        assert_eq!(matching(&[], 0.9), None);
    }
}
