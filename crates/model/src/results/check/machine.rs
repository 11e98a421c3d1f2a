//! The machine as it is understood.

use hexbench_core::statistics::median;
use hexbench_core::words::to_digits;
use hexbench_core::{Hexapod, Pose, Vector3};
use serde::Serialize;

use crate::error::ModelError;
use crate::machine::geometry::Machine;

/// Condition number of the leg Jacobian, in units of the platform's radius, beyond which small errors of joints matter much.
const POOR_CONDITION: f64 = 30.0;
/// A machine lower than this share of its platform's radius is flat: the planes of the joints seem to coincide.
const FLAT: f64 = 0.1;

/// Share by which the length of a leg is far from that of all others, and by which those are alike.
const FAR_FROM_OTHERS: f64 = 0.05;
const LIKE_OTHERS: f64 = 0.01;

/// Radii of joints that few hexapods have: below, the joints may be in meters or inches, above, in micrometers, mm.
const USUAL_RADII_MM: [f64; 2] = [10.0, 20_000.0];
/// Ratio of the radii of base and platform from which one of them may be in another unit.
const UNEQUAL: f64 = 20.0;

/// The machine as the hexapod file describes it.
#[derive(Debug, Clone, Serialize)]
pub struct MachineCheck {
    /// Mean distance of the base joints from their center, mm.
    pub base_radius_mm: f64,
    /// Mean distance of the platform joints from their center, mm.
    pub platform_radius_mm: f64,
    /// From the mean of the base joints up to that of the platform joints at the zero pose, mm.
    pub height_mm: f64,
    /// Length of each leg at the zero pose, mm.
    pub home_lengths_mm: [f64; 6],
    /// Angle of each leg from the vertical at the zero pose, degrees.
    pub inclination_deg: [f64; 6],
    /// Condition number of the leg Jacobian at the zero pose, moments in units of the platform's radius.
    pub condition: f64,
    /// Stated shortest and longest leg, mm.
    pub stroke_mm: Option<[f64; 2]>,
}

impl MachineCheck {
    /// # Errors
    /// [`ModelError::SingularPose`] at the zero pose.
    pub(super) fn of(hexapod: &Hexapod) -> Result<Self, ModelError> {
        let legs = Machine::nominal(hexapod).legs(&Pose::default())?;
        let mean = |joints: &[Vector3; 6]| joints.iter().sum::<Vector3>() / 6.0;
        let (base, platform) = (mean(&hexapod.base_joints), mean(&hexapod.platform_joints));
        let radius = |joints: &[Vector3; 6], center: Vector3| {
            1e3 * joints.iter().map(|j| (j - center).norm()).sum::<f64>() / 6.0
        };
        let mut jacobian = legs.leg_jacobian;
        jacobian.fixed_columns_mut::<3>(3).unscale_mut(hexapod.platform_radius().max(1e-9));
        let singular = jacobian.singular_values();
        Ok(Self {
            base_radius_mm: radius(&hexapod.base_joints, base),
            platform_radius_mm: radius(&hexapod.platform_joints, platform),
            height_mm: 1e3 * (platform.z - base.z),
            home_lengths_mm: std::array::from_fn(|leg| 1e3 * legs.lengths[leg]),
            inclination_deg: std::array::from_fn(|leg| {
                legs.directions[leg].z.abs().clamp(0.0, 1.0).acos().to_degrees()
            }),
            condition: singular.max() / singular.min().max(f64::MIN_POSITIVE),
            stroke_mm: hexapod.stroke.map(|s| s.map(|x| 1e3 * x)),
        })
    }

    /// What looks odd.
    pub(super) fn remarks(&self) -> Vec<String> {
        let mut all = Vec::from_iter(self.odd_size());
        if self.height_mm.abs() < FLAT * self.platform_radius_mm {
            all.push(format!(
                "base and platform joints are {:.1} mm apart at the zero pose: if both are given from their own planes, the home height \
                 is missing; add it to the z of the platform joints, or take it off those of the base",
                self.height_mm
            ));
        }
        if self.height_mm < 0.0 {
            all.push(
                "the platform joints are below the base joints at the zero pose: check that z points up"
                    .to_owned(),
            );
        }
        all.extend(self.odd_legs());
        if self.condition > POOR_CONDITION {
            all.push(format!(
                "the condition number of the legs at the zero pose is {:.0}: errors of joints and loads are magnified by this factor",
                self.condition
            ));
        }
        let outside =
            |stroke: [f64; 2]| self.home_lengths_mm.iter().any(|q| *q < stroke[0] || *q > stroke[1]);
        if let Some([short, long]) = self.stroke_mm.filter(|s| outside(*s)) {
            all.push(format!(
                "legs are {:.1} to {:.1} mm long at the zero pose, outside the stated stroke of {:.1} to {:.1} mm",
                self.home_lengths_mm.iter().copied().fold(f64::INFINITY, f64::min),
                self.home_lengths_mm.iter().copied().fold(0.0, f64::max),
                short,
                long
            ));
        }
        all
    }

    /// That one or two legs are far from the length that all others have.
    fn odd_legs(&self) -> Option<String> {
        let usual = median(self.home_lengths_mm)?;
        let differs = |by: f64| move |leg: &usize| (self.home_lengths_mm[*leg] / usual - 1.0).abs() > by;
        let odd: Vec<usize> = (0..6).filter(differs(FAR_FROM_OTHERS)).collect();
        let is_between = (0..6).filter(differs(LIKE_OTHERS)).count() > odd.len();
        let length = |leg: usize| to_digits(self.home_lengths_mm[leg], 4);
        let legs = match *odd {
            [a] => format!("leg {} is {} mm", a + 1, length(a)),
            [a, b] => format!("legs {} and {} are {} and {} mm", a + 1, b + 1, length(a), length(b)),
            _ => return None,
        };
        (!is_between).then(|| {
            format!(
                "{legs} long at the zero pose, all others about {} mm: check that no joints are exchanged",
                to_digits(usual, 4)
            )
        })
    }

    /// That joints seem to be in another unit than their keys state.
    fn odd_size(&self) -> Option<String> {
        let radii = [self.base_radius_mm, self.platform_radius_mm];
        let [least, most] = [radii[0].min(radii[1]), radii[0].max(radii[1])];
        let is_odd = least < USUAL_RADII_MM[0] || most > USUAL_RADII_MM[1] || most > UNEQUAL * least;
        is_odd.then(|| {
            format!(
                "the mean radius of the joints is {} mm at the base and {} mm at the platform: check the units in the names \
                 base_joints_mm and platform_joints_mm",
                to_digits(radii[0], 3),
                to_digits(radii[1], 3)
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use hexbench_core::JointCircle;

    use super::*;

    #[test]
    fn legs_exchanged_on_one_side_are_noticed() {
        let gap = 20.0_f64.to_radians();
        let base = JointCircle::base_pairs(0.16, gap).joints(-0.165);
        let mut platform = JointCircle::platform_pairs(0.12, gap).joints(0.0);
        let remarks = |platform| {
            let machine = Hexapod::of_joints("rings", base, platform);
            MachineCheck::of(&machine).unwrap().remarks()
        };
        assert!(remarks(platform).is_empty(), "{:?}", remarks(platform));
        platform.swap(0, 1);
        let said = remarks(platform);
        assert!(said.iter().any(|remark| remark.starts_with("legs 1 and 2 are 2")), "{said:?}");
    }
}
