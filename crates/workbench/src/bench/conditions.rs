//! Conditions of the readings, as columns for charts.

use hexbench_core::{Dataset, Vector3, Vector6, spread};
use hexbench_model::estimation::campaign::{Campaign, Condition};
use hexbench_model::estimation::linearization::Linearization;

use super::digits::{all_short, short};
use crate::wire::ConditionLists;

/// Most conditions shown: more than an eye can tell apart, few enough to be drawn at once.
const MOST: usize = 1000;

/// Indices of the conditions shown among `count`.
pub(super) fn shown(count: usize) -> Vec<usize> {
    spread(count, MOST).collect()
}

/// Columns of the conditions shown, on the machine as drawn.
pub(super) fn columns(
    lin: &Linearization,
    shown: &[usize],
    campaign: &Campaign,
    data: &Dataset,
) -> ConditionLists {
    let mut all =
        ConditionLists { of: lin.conditions.len(), file: data.source.clone(), ..ConditionLists::default() };
    for (i, c) in shown.iter().map(|&i| (i, &lin.conditions[i])) {
        all.lines
            .push(campaign.groups[i].rows.iter().map(|&row| data.observations[row as usize].line).collect());
        all.pose.push(all_short(pose(c)));
        all.wrench.push(all_short(difference(&c.wrench.to_array(), &c.reference.to_array())));
        all.leg_force_n.push(all_short(c.force_change()));
        all.leg_length_mm.push(all_short(c.legs.lengths * 1e3));
        all.elapsed_s.push(c.elapsed);
        all.delta_t_k.push(c.delta_t);
        all.approach.push(c.approach.sign());
        all.platform_joints_mm.push(std::array::from_fn(|leg| joint_mm(c, leg)));
        all.measured.push(all_short(c.reading * 1e6));
        all.measured_motion.push(motion(c, &c.reading));
    }
    all
}

fn pose(c: &Condition) -> [f64; 6] {
    let x = c.place.pose().to_array();
    std::array::from_fn(|k| if k < 3 { x[k] * 1e3 } else { x[k].to_degrees() })
}

fn difference(a: &[f64; 6], b: &[f64; 6]) -> [f64; 6] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn joint_mm(c: &Condition, leg: usize) -> [f64; 3] {
    let joint: Vector3 = c.place.translation + c.legs.arms[leg];
    <[f64; 3]>::from(joint * 1e3).map(short)
}

/// Motion of the platform at its origin that reads like this: um, urad.
pub(super) fn motion(c: &Condition, reading: &Vector6) -> [f64; 6] {
    all_short(c.motion(reading) * 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_conditions_are_all_shown_and_of_many_both_that_alternate() {
        assert_eq!(shown(0), Vec::<usize>::new());
        assert_eq!(shown(MOST).len(), MOST);
        let many = shown(10 * MOST);
        let odd = many.iter().filter(|i| *i % 2 == 1).count();
        assert!(many.len() == MOST && (MOST / 3..2 * MOST / 3).contains(&odd), "{odd} of {}", many.len());
    }
}
