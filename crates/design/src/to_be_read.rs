//! Readings that are planned: by the sensors of a machine, each as good as it states, or of full poses where it has none.

use hexbench_core::{Dataset, Hexapod, Observation, Pose, Vector6, Wrench};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::linearization::{Linearization, ModelPoint};
use hexbench_model::estimation::noise::{Noise, stated_or_repeated};
use nalgebra::DMatrix;

use crate::DesignError;

/// Noise of readings to come: of its sensors on the average, where a machine has some, else as it is stated of full poses.
pub fn noise_to_come(hexapod: &Hexapod) -> Option<Noise> {
    let one = Observation::unread(Pose::default(), Wrench::default(), Wrench::default());
    stated_or_repeated(hexapod, &unread(hexapod, vec![one]))
}

/// Planned readings, linearized at springs alone.
pub(crate) struct ToBeRead {
    pub(crate) campaign: Campaign,
    pub(crate) point: ModelPoint,
    pub(crate) lin: Linearization,
    readings: usize,
    /// Observations that each reading takes.
    blocks: usize,
}

impl ToBeRead {
    /// By springs of the given compliance (m/N), with the noise of [`noise_to_come`].
    ///
    /// # Errors
    /// A singular pose.
    pub(crate) fn of(
        hexapod: &Hexapod,
        springs: Vector6,
        noise: Noise,
        readings: impl IntoIterator<Item = Observation>,
    ) -> Result<Self, DesignError> {
        let readings: Vec<Observation> = readings.into_iter().collect();
        let (count, dataset) = (readings.len(), unread(hexapod, readings));
        let campaign = Campaign::with_noise(hexapod, &dataset, noise)?;
        let point = ModelPoint { compliances: springs, ..ModelPoint::start(&campaign) };
        let lin = Linearization::at(&campaign, &point)?;
        Ok(Self { campaign, point, lin, readings: count, blocks: dataset.blocks.len() })
    }

    /// Information of each reading by the whitened rows of all; equal readings, which are averaged, share theirs.
    pub(crate) fn informations(&self, rows: &DMatrix<f64>) -> Vec<DMatrix<f64>> {
        let width = rows.ncols();
        let mut all = vec![DMatrix::zeros(width, width); self.readings];
        for (i, group) in self.campaign.groups.iter().enumerate() {
            let own = rows.rows(6 * i, 6);
            let information = own.tr_mul(&own) / group.rows.len() as f64;
            for &row in &group.rows {
                all[row as usize / self.blocks] += &information;
            }
        }
        all
    }
}

fn unread(hexapod: &Hexapod, readings: Vec<Observation>) -> Dataset {
    let unread = |o: Observation| Observation { sigma: None, measured: [0.0; 6], ..o };
    let poses = Dataset::of_deflections("", readings.into_iter().map(unread).collect());
    if hexapod.sensors.is_empty() { poses } else { poses.to_be_read_by(&hexapod.sensors) }
}

#[cfg(test)]
mod tests {
    use hexbench_core::{Approach, Sensor, SensorKind, Vector3};
    use nalgebra::{DVector, Matrix6, RowVector6};

    use super::*;
    use crate::nominal;
    use crate::test_machine::machine;

    const SIGMA: f64 = 0.3e-6;

    fn gauge(k: usize) -> Sensor {
        let (s, c) = (0.9 * k as f64).sin_cos();
        let direction = Vector3::new(c, s, 0.4 * k as f64 - 1.0).normalize();
        let point = Vector3::new(0.1 * s, 0.12 * c, 0.05);
        Sensor::new(format!("g{k}"), SensorKind::Distance { point, direction, sigma: SIGMA })
    }

    fn relative(lin: &Linearization, springs: &Vector6) -> DMatrix<f64> {
        lin.common_block() * DMatrix::from_diagonal(&DVector::from_column_slice(springs.as_slice()))
    }

    /// Information of springs in relative changes of their compliances, reading by reading.
    fn informations(hexapod: &Hexapod, readings: &[Observation]) -> Vec<DMatrix<f64>> {
        let (springs, noise) = (Vector6::from(nominal::compliance(hexapod)), noise_to_come(hexapod).unwrap());
        let read = ToBeRead::of(hexapod, springs, noise, readings.iter().copied()).unwrap();
        read.informations(&relative(&read.lin, &springs))
    }

    #[test]
    fn gauges_read_what_a_full_pose_tells_of_them() {
        // Readings are linearized halfway between the states: 1e-5 of a deflection.
        const CLOSE: f64 = 1e-4;
        // Without beta and gamma the angles of a pose change as the platform turns.
        let pose = Pose::from_array([0.01, -0.005, 0.004, 0.1, 0.0, 0.0]);
        let load = |w| Observation {
            approach: Approach::default(),
            ..Observation::unread(pose, Wrench::from_array(w), Wrench::default())
        };
        let readings = [load([0.0, 0.0, -80.0, 0.0, 0.0, 0.0]), load([30.0, 0.0, 0.0, 0.0, 5.0, 0.0])];
        let of_pose = Hexapod {
            metrology: Some(hexbench_core::Metrology { sigma_translation: 1.0, sigma_rotation: 1.0 }),
            ..machine()
        };
        // Eight gauges fill two blocks of six numbers.
        let sensors: Vec<Sensor> = (0..8).map(gauge).collect();
        let sensed = informations(&Hexapod { sensors: sensors.clone(), ..machine() }, &readings);
        let (springs, noise) =
            (Vector6::from(nominal::compliance(&of_pose)), noise_to_come(&of_pose).unwrap());
        let read = ToBeRead::of(&of_pose, springs, noise, readings).unwrap();
        let motions = relative(&read.lin, &springs);
        for (k, found) in sensed.iter().enumerate() {
            let motion = motions.rows(6 * k, 6);
            let row = |sensor: &Sensor| {
                let SensorKind::Distance { point, direction, sigma } = &sensor.kind else { unreachable!() };
                let arm = pose.rotation() * point;
                let turned = arm.cross(direction);
                let looks = Vector6::new(direction.x, direction.y, direction.z, turned.x, turned.y, turned.z);
                RowVector6::from_iterator((looks.transpose() * motion / *sigma).iter().copied())
            };
            let square = |r: RowVector6<f64>| r.tr_mul(&r);
            let expected: Matrix6<f64> = sensors.iter().map(row).map(square).sum();
            assert!((found - expected).norm() < CLOSE * expected.norm(), "{found} {expected}");
        }
    }
}
