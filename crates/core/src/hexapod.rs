//! The machine as its drawings describe it.

use crate::{AngleConvention, Sensor, Tolerances, Vector3};

/// Nominal hexapod: joints, and what else its owner states about it. SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Hexapod {
    /// Name given by the user.
    pub name: String,
    /// `A_i`: base joints, fixed frame, m.
    pub base_joints: [Vector3; 6],
    /// `B_i`: platform joints, mobile frame, m.
    pub platform_joints: [Vector3; 6],
    /// Standard deviation of one reading, when stated.
    pub metrology: Option<Metrology>,
    /// Nominal stiffness of each leg, N/m, when stated.
    pub nominal_stiffness: Option<[f64; 6]>,
    /// Shortest and longest leg length, m, when stated.
    pub stroke: Option<[f64; 2]>,
    /// Pairs of legs (from zero) that share a bracket, when stated.
    pub brackets: Option<Vec<[usize; 2]>>,
    /// Height of the mounting plane in the fixed frame, m; mean z of the base joints unless stated.
    pub mounting_plane_z: Option<f64>,
    /// Center of gravity of the payload, mobile frame, m, when stated.
    pub payload_centre: Option<Vector3>,
    /// What reads deflections beside or instead of the full pose.
    pub sensors: Vec<Sensor>,
    /// What the three angles of a pose mean in the files of this machine.
    pub angles: AngleConvention,
    /// How well all of this, and the loads, are known.
    pub tolerances: Tolerances,
}

/// Standard deviation of ONE reading of a deflection or of an absolute pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Metrology {
    /// Of each translation, m.
    pub sigma_translation: f64,
    /// Of each rotation, rad.
    pub sigma_rotation: f64,
}

impl Hexapod {
    /// A machine of which nothing but the joints is stated: `A_i` in the fixed, `B_i` in the mobile frame, m.
    pub fn of_joints(
        name: impl Into<String>,
        base_joints: [Vector3; 6],
        platform_joints: [Vector3; 6],
    ) -> Self {
        Self {
            name: name.into(),
            base_joints,
            platform_joints,
            metrology: None,
            nominal_stiffness: None,
            stroke: None,
            brackets: None,
            mounting_plane_z: None,
            payload_centre: None,
            sensors: Vec::new(),
            angles: AngleConvention::default(),
            tolerances: Tolerances::default(),
        }
    }

    /// Pairs of legs that share a bracket: the stated ones, else each leg with its nearest neighbor at the base
    /// when the six pair up mutually, else none.
    pub fn bracket_pairs(&self) -> Vec<[usize; 2]> {
        if let Some(pairs) = &self.brackets {
            return pairs.clone();
        }
        let nearest = |i: usize| {
            (0..6).filter(|&j| j != i).min_by(|&j, &k| self.base_gap(i, j).total_cmp(&self.base_gap(i, k)))
        };
        let pairs: Vec<[usize; 2]> = (0..6)
            .filter_map(|i| nearest(i).filter(|&j| i < j && nearest(j) == Some(i)).map(|j| [i, j]))
            .collect();
        if pairs.len() == 3 { pairs } else { Vec::new() }
    }

    fn base_gap(&self, i: usize, j: usize) -> f64 {
        (self.base_joints[i] - self.base_joints[j]).norm()
    }

    /// Center of the base-joint plane: mean of the base joints in x and y, mounting plane in z. Fixed frame, m.
    pub fn base_centre(&self) -> Vector3 {
        let mean = self.base_joints.iter().sum::<Vector3>() / 6.0;
        Vector3::new(mean.x, mean.y, self.mounting_plane_z.unwrap_or(mean.z))
    }

    /// Mean distance of the platform joints from the mobile origin, m: the length that turns angles into distances.
    pub fn platform_radius(&self) -> f64 {
        self.platform_joints.iter().map(nalgebra::Matrix::norm).sum::<f64>() / 6.0
    }

    /// Standard deviation of every number of its sensors, sensor by sensor; m and rad.
    pub fn sensor_sigmas(&self) -> Vec<f64> {
        let sigmas =
            |sensor: &Sensor| (0..sensor.kind.numbers()).map(|k| sensor.kind.sigma(k)).collect::<Vec<_>>();
        self.sensors.iter().flat_map(sigmas).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring() -> Hexapod {
        let joint = |r: f64, deg: f64, z: f64| {
            let (s, c) = deg.to_radians().sin_cos();
            Vector3::new(r * c, r * s, z)
        };
        let base = [-10.0, 10.0, 110.0, 130.0, 230.0, 250.0].map(|d| joint(0.16, d, -0.165));
        let platform = [-50.0, 50.0, 70.0, 170.0, 190.0, 290.0].map(|d| joint(0.12, d, 0.0));
        Hexapod::of_joints("ring", base, platform)
    }

    #[test]
    fn neighbours_at_the_base_share_a_bracket() {
        assert_eq!(ring().bracket_pairs(), vec![[0, 1], [2, 3], [4, 5]]);
    }

    #[test]
    fn stated_brackets_win() {
        let hexapod = Hexapod { brackets: Some(vec![[0, 5]]), ..ring() };
        assert_eq!(hexapod.bracket_pairs(), vec![[0, 5]]);
    }

    #[test]
    fn base_centre_is_the_mean_unless_the_plane_is_stated() {
        assert!((ring().base_centre() - Vector3::new(0.0, 0.0, -0.165)).norm() < 1e-15);
        let raised = Hexapod { mounting_plane_z: Some(-0.2), ..ring() };
        assert!((raised.base_centre().z + 0.2).abs() < 1e-15);
    }

    #[test]
    fn the_radius_of_the_platform_is_the_mean_distance_of_its_joints() {
        let far = |r: f64| Vector3::new(0.0, r, 0.0);
        let platform = [0.1, 0.1, 0.1, 0.3, 0.3, 0.3].map(far);
        let hexapod = Hexapod::of_joints("", [far(1.0); 6], platform);
        assert!((hexapod.platform_radius() - 0.2).abs() < 1e-12);
    }
}
