//! How far the readings of a fit reach: beyond them a model is extrapolated, and its uncertainty does not know what it misses there.

use hexbench_core::words::to_digits;
use hexbench_core::{Observation, Vector3, Wrench};
use serde::{Deserialize, Serialize};

use crate::estimation::campaign::Campaign;

/// Beyond so many times the largest value fitted, a prediction is an extrapolation.
const FAR: f64 = 1.5;
/// Share of the radius of the platform, and angle (rad), by which poses may leave those of the fit at least.
const NEAR: f64 = 0.1;
/// Digits of a ratio that people read.
const DIGITS: usize = 2;

/// Largest loads and motions of the readings fitted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reach {
    /// Force, N.
    #[serde(rename = "force_N")]
    pub force: f64,
    /// Moment, N m.
    #[serde(rename = "moment_Nm")]
    pub moment: f64,
    /// Distance of a pose from the zero pose, m.
    #[serde(rename = "shift_m")]
    pub shift: f64,
    /// Largest of the three angles of a pose, rad.
    #[serde(rename = "turn_rad")]
    pub turn: f64,
}

impl Reach {
    /// Of the readings of a campaign.
    pub fn of(campaign: &Campaign) -> Self {
        let rows = || campaign.groups.iter().map(|group| &group.mean);
        let largest = |of: &dyn Fn(&Observation) -> f64| rows().map(of).fold(0.0, f64::max);
        let either =
            |o: &Observation, of: fn(&Wrench) -> &Vector3| of(&o.wrench).norm().max(of(&o.reference).norm());
        Self {
            force: largest(&|o| either(o, |w| &w.force)),
            moment: largest(&|o| either(o, |w| &w.moment)),
            shift: largest(&|o| o.pose.translation.norm()),
            turn: largest(&|o| o.pose.angles.amax()),
        }
    }

    /// What of a row is far beyond them, in words; `radius`: of the platform, m. None where nothing is.
    pub fn exceeded(&self, row: &Observation, radius: f64) -> Option<String> {
        let times = |value: f64, most: f64| (value > FAR * most).then(|| to_digits(value / most, DIGITS));
        let force = row.wrench.force.norm();
        if let Some(times) = times(force, self.force) {
            return Some(format!("{force:.0} N is {times} times the largest force ({:.0} N)", self.force));
        }
        // A force beside the origin is a moment too.
        let (moment, most) = (row.wrench.moment.norm(), self.moment.max(self.force * radius));
        if let Some(times) = times(moment, most) {
            return Some(format!("{moment:.1} Nm is {times} times the largest moment ({most:.1} Nm)"));
        }
        let (shift, most) = (row.pose.translation.norm(), self.shift.max(NEAR * radius));
        if let Some(times) = times(shift, most) {
            let [shift, most] = [shift, most].map(|x| x * 1e3);
            return Some(format!(
                "the pose is {shift:.0} mm from the zero pose, {times} times as far as any ({most:.0} mm)"
            ));
        }
        let (turn, most) = (row.pose.angles.amax(), self.turn.max(NEAR));
        times(turn, most).map(|times| {
            let [turn, most] = [turn, most].map(f64::to_degrees);
            format!("the pose is turned by {turn:.1} deg, {times} times as far as any ({most:.1} deg)")
        })
    }
}

#[cfg(test)]
mod tests {
    use hexbench_core::Pose;

    use super::*;

    #[test]
    fn what_lies_far_beyond_the_readings_of_a_fit_is_told_with_both_numbers() {
        let reach = Reach { force: 200.0, moment: 10.0, shift: 0.02, turn: 0.1 };
        let row = |force: f64, moment: f64, shift: f64, turn: f64| {
            let wrench = Wrench { force: Vector3::z() * force, moment: Vector3::x() * moment };
            let pose = Pose { translation: Vector3::y() * shift, angles: Vector3::x() * turn };
            reach.exceeded(&Observation::unread(pose, wrench, Wrench::default()), 0.1)
        };
        assert_eq!(row(290.0, 29.0, 0.029, 0.149), None);
        for (told, words) in [
            (row(5000.0, 0.0, 0.0, 0.0), "5000 N is 25 times the largest force (200 N)"),
            (row(0.0, 60.0, 0.0, 0.0), "60.0 Nm is 3 times the largest moment (20.0 Nm)"),
            (row(0.0, 0.0, 0.06, 0.0), "the pose is 60 mm from the zero pose, 3 times as far as any (20 mm)"),
            (row(0.0, 0.0, 0.0, 0.2), "the pose is turned by 11.5 deg, 2 times as far as any (5.7 deg)"),
        ] {
            assert_eq!(told.as_deref(), Some(words));
        }
    }
}
