//! Poses of a chosen plan moved to where they tell most, one after the other, and its chosen loads, all together; the readings of each are kept.

use hexbench_core::{Hexapod, Pose};
use nalgebra::DMatrix;

use crate::continuous::Climb;
use crate::regressor::SettingRegressor;
use crate::space::Loading;
use crate::{DesignError, Objective, PoseProblem, Space};

/// Rounds over all poses.
const MOST_ROUNDS: usize = 4;
/// Relative gain of a round that is worth another.
const WORTHWHILE: f64 = 1e-4;

/// A pose and how often it is read under each setting.
#[derive(Debug, Clone, PartialEq)]
pub struct Visit {
    /// The pose.
    pub pose: Pose,
    /// Readings under each setting of the space.
    pub counts: Vec<usize>,
}

impl Visit {
    /// Adds the information of its readings, inputs included.
    ///
    /// # Errors
    /// A singular pose.
    pub fn inform<R: SettingRegressor>(
        &self,
        regressor: &R,
        information: &mut DMatrix<f64>,
    ) -> Result<(), DesignError> {
        regressor.repeated(&self.counts).inform(&self.pose, information)
    }
}

/// Sum of the information of visits, inputs included.
///
/// # Errors
/// A singular pose.
pub fn information<'v, R: SettingRegressor>(
    visits: impl IntoIterator<Item = &'v Visit>,
    regressor: &R,
) -> Result<DMatrix<f64>, DesignError> {
    let n = regressor.width();
    let mut sum = DMatrix::zeros(n, n);
    visits.into_iter().try_for_each(|visit| visit.inform(regressor, &mut sum))?;
    Ok(sum)
}

/// Moves the poses of visits within the limits of the space and its chosen loads within their bounds; the value of the criterion never
/// falls. Gives the loads.
///
/// # Errors
/// A singular pose.
pub fn refine<R: SettingRegressor>(
    hexapod: &Hexapod,
    space: &Space,
    regressor: &R,
    criterion: &Objective,
    visits: &mut [Visit],
) -> Result<Vec<Loading>, DesignError> {
    let value = |visits: &[Visit], regressor: &R| -> Result<f64, DesignError> {
        Ok(criterion.value(&information(visits, regressor)?, 1))
    };
    let (mut space, mut regressor) = (space.clone(), regressor.under(&space.settings()));
    let mut before = value(visits, &regressor)?;
    for _ in 0..MOST_ROUNDS {
        refine_poses(hexapod, &space, &regressor, criterion, visits)?;
        if let Some(loads) = better_loads(hexapod, &space, &regressor, criterion, visits)? {
            space = space.under(loads);
            regressor = regressor.under(&space.settings());
        }
        let after = value(visits, &regressor)?;
        if after <= before * (1.0 + WORTHWHILE) {
            break;
        }
        before = after;
    }
    Ok(space.loads)
}

fn refine_poses<R: SettingRegressor>(
    hexapod: &Hexapod,
    space: &Space,
    regressor: &R,
    criterion: &Objective,
    visits: &mut [Visit],
) -> Result<(), DesignError> {
    let space = &space.with_loads_fixed();
    for k in 0..visits.len() {
        let others = visits.iter().enumerate().filter(|(i, _)| *i != k).map(|(_, visit)| visit);
        let known = Some(&information(others, regressor)?);
        let own = &regressor.repeated(&visits[k].counts);
        let problem = PoseProblem { hexapod, space, regressor: own, criterion, poses: 1, known };
        let here = [visits[k].pose];
        let Some(moved) = problem.climb(&here).filter(|set| set.value > problem.value(&here)) else {
            continue;
        };
        visits[k].pose = moved.poses[0];
    }
    Ok(())
}

/// Loads that are better at the poses of visits; none where no load is chosen or none is better.
fn better_loads<R: SettingRegressor>(
    hexapod: &Hexapod,
    space: &Space,
    regressor: &R,
    criterion: &Objective,
    visits: &[Visit],
) -> Result<Option<Vec<Loading>>, DesignError> {
    if space.load_ranges.is_empty() {
        return Ok(None);
    }
    let before = criterion.value(&information(visits, regressor)?, 1);
    let poses: Vec<Pose> = visits.iter().map(|visit| visit.pose).collect();
    let each: Vec<R> = visits.iter().map(|visit| regressor.repeated(&visit.counts)).collect();
    let climb = Climb::new(hexapod, space, criterion, each.iter().collect(), &poses).of_loads();
    Ok(climb.end().filter(|end| end.value > before).map(|end| end.loads))
}

#[cfg(test)]
mod tests {
    use hexbench_core::Wrench;

    use super::*;
    use crate::Budget;
    use crate::Criterion;
    use crate::regressor::{PoseRegressor, SpringRegressor, Weights};
    use crate::space::{ChosenPart, Conditions, LoadRange};
    use crate::test_machine::machine;

    fn space() -> Space {
        let load = |x: [f64; 6]| Loading { reference: Wrench::default(), load: Wrench::from_array(x) };
        let reach = [0.03, 0.03, 0.02, 0.1, 0.1, 0.4];
        Space {
            low: reach.map(|x| -x),
            high: reach,
            stroke: Some([0.178, 0.211]),
            joint_angle: Some(0.3),
            least_dexterity: 0.1,
            load_ranges: Vec::new(),
            loads: vec![load([0.0, 0.0, -300.0, 0.0, 0.0, 0.0]), load([80.0, 0.0, 0.0, 0.0, 5.0, 0.0])],
            conditions: Conditions::default(),
            budget: Budget::default(),
        }
    }

    #[test]
    fn refined_poses_tell_more_within_the_limits_and_keep_their_readings() {
        /// As in the search for poses.
        const SLACK: f64 = 1e-6;
        let (hexapod, space) = (machine(), space());
        let regressor = SpringRegressor::new(&hexapod, &space.settings(), 1, Weights::UNWEIGHTED);
        let counts = [vec![2, 0], vec![1, 3], vec![0, 1]];
        let poses = space.poses(&hexapod, 3, 1).unwrap();
        let mut visits: Vec<Visit> =
            poses.into_iter().zip(counts.clone()).map(|(pose, counts)| Visit { pose, counts }).collect();
        let value = |visits: &[Visit]| {
            Objective::from(Criterion::A).value(&information(visits, &regressor).unwrap(), 1)
        };
        let before = value(&visits);
        refine(&hexapod, &space, &regressor, &Objective::from(Criterion::A), &mut visits).unwrap();
        assert!(value(&visits) > 1.2 * before, "{} from {before}", value(&visits));
        for (visit, counts) in visits.iter().zip(counts) {
            assert_eq!(visit.counts, counts);
            let worst = space.worst_limit(&hexapod, &visit.pose).unwrap();
            assert!(worst.excess <= SLACK, "{worst:?}");
        }
    }

    #[test]
    fn a_visit_informs_as_its_readings_one_by_one() {
        let (hexapod, space) = (machine(), space());
        let regressor = SpringRegressor::new(&hexapod, &space.settings(), 1, Weights::UNWEIGHTED);
        let visit = Visit { pose: Pose::from_array([0.01, 0.0, 0.0, 0.05, 0.0, 0.2]), counts: vec![2, 3] };
        let together = information([&visit], &regressor).unwrap();
        let each = regressor.each(&visit.pose).unwrap();
        let sum = &each[0] * 2.0 + &each[1] * 3.0;
        let off = (&together - &sum).amax() / sum.amax();
        assert!(off < 8.0 * f64::EPSILON, "{off:.1e}");
        assert_eq!(regressor.repeated(&visit.counts).readings(), 5);
    }

    #[test]
    fn refined_loads_tell_more_within_their_bounds_and_no_listed_load_moves() {
        let (hexapod, mut space) = (machine(), space());
        let part = |name, k: usize, bounds: [f64; 2]| {
            let mut direction = hexbench_core::Vector6::zeros();
            direction[k] = 1.0;
            ChosenPart { name, unit: "N", direction, bounds }
        };
        let parts = vec![part("fx", 0, [-90.0, 90.0]), part("my", 4, [-6.0, 6.0])];
        let fixed = Wrench::from_array([0.0, 0.0, -50.0, 0.0, 0.0, 0.0]);
        space.load_ranges = vec![LoadRange { load: 1, fixed, parts }];
        let space = space.under(space.loads_at(&[0.6, 0.4]));
        let regressor = SpringRegressor::new(&hexapod, &space.settings(), 1, Weights::UNWEIGHTED);
        let criterion = Objective::from(Criterion::A);
        let poses = space.poses(&hexapod, 3, 1).unwrap();
        let visits: Vec<Visit> = poses.into_iter().map(|pose| Visit { pose, counts: vec![1, 2] }).collect();
        let value = |visits: &[Visit], loads: &[Loading]| {
            let there = regressor.under(&space.under(loads.to_vec()).settings());
            criterion.value(&information(visits, &there).unwrap(), 1)
        };
        let (mut still, mut free) = (visits.clone(), visits);
        refine(&hexapod, &space.with_loads_fixed(), &regressor, &criterion, &mut still).unwrap();
        let loads = refine(&hexapod, &space, &regressor, &criterion, &mut free).unwrap();
        let (poses_only, both) = (value(&still, &space.loads), value(&free, &loads));
        assert!(both > 1.5 * poses_only, "{both} from {poses_only}");
        assert_eq!(loads[0], space.loads[0]);
        let [fx, my] = [loads[1].load.force.x, loads[1].load.moment.y];
        assert!(fx.abs() <= 90.0 && my.abs() <= 6.0, "{fx} {my}");
    }
}
