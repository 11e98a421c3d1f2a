//! Joints on two rings, as drawings and catalogues of hexapods state them.

use crate::Vector3;

/// Joints of one side on a circle about the z axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointCircle {
    /// Radius of the circle, m.
    pub radius: f64,
    /// Direction of the joint of each leg from the x axis, about z, rad.
    pub angles: [f64; 6],
}

impl JointCircle {
    /// Joints of the base in three pairs `gap` apart, rad: legs 1 and 2 about the x axis, 3 and 4 a third of a turn on, then 5 and 6.
    pub fn base_pairs(radius: f64, gap: f64) -> Self {
        Self { radius, angles: std::array::from_fn(|leg| third(leg / 2) + side(leg) * gap / 2.0) }
    }

    /// Joints of the platform in three pairs `gap` apart, rad, between those of the base: legs 2 and 3, 4 and 5, 6 and 1.
    pub fn platform_pairs(radius: f64, gap: f64) -> Self {
        let sixth = std::f64::consts::FRAC_PI_3;
        Self { radius, angles: std::array::from_fn(|leg| third(leg / 2) + side(leg) * (sixth - gap / 2.0)) }
    }

    /// Joints at a height, m.
    pub fn joints(&self, height: f64) -> [Vector3; 6] {
        self.angles.map(|angle| Vector3::new(self.radius * angle.cos(), self.radius * angle.sin(), height))
    }
}

fn third(pair: usize) -> f64 {
    pair as f64 * std::f64::consts::TAU / 3.0
}

/// -1 for the first leg of a pair, 1 for the second.
fn side(leg: usize) -> f64 {
    if leg.is_multiple_of(2) { -1.0 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_of_the_platform_lie_between_those_of_the_base() {
        let degrees = |circle: JointCircle| circle.angles.map(|a| format!("{:.0}", a.to_degrees())).join(" ");
        let twenty = 20.0_f64.to_radians();
        assert_eq!(degrees(JointCircle::base_pairs(1.0, twenty)), "-10 10 110 130 230 250");
        assert_eq!(degrees(JointCircle::platform_pairs(1.0, twenty)), "-50 50 70 170 190 290");
        let [first, second] = [0, 1].map(|leg| JointCircle::base_pairs(2.0, twenty).joints(-0.5)[leg]);
        assert!((first - Vector3::new(first.x, -second.y, -0.5)).norm() < 1e-12 && first.y < 0.0);
    }
}
