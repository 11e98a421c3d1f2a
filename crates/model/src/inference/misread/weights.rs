//! What the numbers of a file count when it is read in one way or another.

use hexbench_core::{Channel, Dataset, Hexapod, Sensor, UNREAD, Vector6};

use super::change::Change;

/// Error of the linear springs, relative to the readings: deflections are small, but not infinitely so.
const LINEAR_SHARE: f64 = 2e-3;

/// By what readings and noise are multiplied.
pub(super) struct Factors<'a> {
    pub(super) changes: &'a [Change],
    pub(super) sensors: &'a [Sensor],
    /// Of the noise; none where nobody has stated it, and it is as large as the readings make it.
    pub(super) noise: Option<f64>,
}

impl Factors<'_> {
    pub(super) fn reading(&self, channel: Channel) -> f64 {
        self.changes.iter().map(|change| change.factor(channel, self.sensors).abs()).product()
    }

    /// A stated noise is that of readings in their true unit. A calibration factor is in readings and noise alike: else the one of two
    /// columns would be preferred that makes its noise smaller.
    pub(super) fn noise(&self, channel: Channel) -> f64 {
        let fitted = || self.changes.iter().filter(|change| change.sizes() > 0);
        let calibration =
            || fitted().map(|change| change.factor(channel, self.sensors).abs()).product::<f64>();
        self.noise.map_or_else(|| self.reading(channel), |noise| noise * calibration())
    }
}

/// What the numbers of a condition count.
#[derive(Clone, Copy)]
pub(super) struct Weights {
    pub(super) channels: [Channel; 6],
    /// Stated standard deviations, m and rad.
    pub(super) sigma: Vector6,
    /// 1 / standard deviation of each, with what the springs may miss.
    pub(super) each: Vector6,
    /// Sum of their logarithms over those of the numbers as written.
    pub(super) density: f64,
}

impl Weights {
    pub(super) fn of(
        channels: [Channel; 6],
        sigma: Vector6,
        factors: &Factors<'_>,
        floor: &Floor,
        hexapod: &Hexapod,
    ) -> Self {
        let each = Vector6::from_fn(|k, _| {
            (sigma[k] * factors.noise(channels[k])).hypot(floor.under(channels[k], hexapod)).recip()
        });
        let density = |k: usize| (each[k] * sigma[k] * factors.reading(channels[k])).ln();
        let density = (0..6).filter(|&k| sigma[k] < UNREAD).map(density).sum();
        Self { channels, sigma, each, density }
    }
}

/// What residuals are weighed by.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Over {
    /// The noise alone.
    Noise,
    /// The noise, and what springs of the first order and sensors that stand to their tolerance miss.
    Model,
    /// The same, and no more than this is missed.
    AtMost(Floor),
}

/// What the linear springs may miss of lengths and of angles, m and rad.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Floor {
    length: f64,
    angle: f64,
}

impl Floor {
    /// The readings, root mean square, of which the model misses a share.
    pub(super) fn of(hexapod: &Hexapod, data: &Dataset, reads: &[Vector6], over: Over) -> Self {
        if over == Over::Noise {
            return Self { length: 0.0, angle: 0.0 };
        }
        let mut sums = [[0.0; 2]; 2];
        for (row, read) in data.observations.iter().zip(reads) {
            let channels = data.channels(row);
            for k in (0..6).filter(|&k| row.is_read(k)) {
                let [sum, count] = &mut sums[usize::from(channels[k].is_angle(&hexapod.sensors))];
                *sum += read[k].powi(2);
                *count += 1.0;
            }
        }
        let [length, angle] = sums.map(|[sum, count]: [f64; 2]| (sum / count.max(1.0)).sqrt());
        match over {
            Over::AtMost(most) => Self { length: length.min(most.length), angle: angle.min(most.angle) },
            _ => Self { length, angle },
        }
    }

    fn under(&self, channel: Channel, hexapod: &Hexapod) -> f64 {
        let size = if channel.is_angle(&hexapod.sensors) { self.angle } else { self.length };
        size * LINEAR_SHARE.hypot(off_by_tolerance(channel, hexapod))
    }
}

/// Share of a motion of the size of the platform that a sensor misses which stands, looks and shows to its tolerance.
fn off_by_tolerance(channel: Channel, hexapod: &Hexapod) -> f64 {
    let Channel::Sensor { sensor, .. } = channel else { return 0.0 };
    let Some(kind) = hexapod.sensors.get(sensor).map(|s| &s.kind) else { return 0.0 };
    let place = kind.point().map_or(0.0, |_| hexapod.tolerances.sensor_point / hexapod.platform_radius());
    let direction = kind.direction().map_or(0.0, |_| hexapod.tolerances.sensor_direction);
    place.hypot(direction).hypot(hexapod.tolerances.sensor_gain)
}

#[cfg(test)]
mod tests {
    use hexbench_core::Measurand;

    use super::super::change::Group;
    use super::*;
    use crate::test_machine::readings;

    #[test]
    fn a_number_counts_by_its_noise_and_by_what_first_order_springs_miss() {
        let (hexapod, data) = readings(Measurand::DeflectionRotationVector, Vec::new());
        let reads: Vec<Vector6> = data.observations.iter().map(|o| Vector6::from(o.measured)).collect();
        let sum: f64 = reads.iter().map(|read| read.fixed_rows::<3>(0).norm_squared()).sum();
        let length = (sum / (3 * reads.len()) as f64).sqrt();
        let sigma = 1e-9;
        let of = |changes: &[Change], noise, over| {
            let factors = Factors { changes, sensors: &[], noise };
            let floor = Floor::of(&hexapod, &data, &reads, over);
            Weights::of(Channel::POSE, Vector6::repeat(sigma), &factors, &floor, &hexapod)
        };
        // Readings in another unit, with the noise that they show.
        let half = of(&[Change::Scaled(Group::Translations, -0.5)], None, Over::Noise);
        assert!(
            (half.each[0] * 0.5 * sigma - 1.0).abs() < 1e-12 && (half.each[3] * sigma - 1.0).abs() < 1e-12
        );
        assert!(half.density.abs() < 1e-12, "{}", half.density);
        let calibrated = of(&[Change::Scaled(Group::Translations, 0.8)], Some(1.0), Over::Noise);
        assert!((calibrated.each[0] * 0.8 * sigma - 1.0).abs() < 1e-12 && calibrated.density.abs() < 1e-12);
        let inches = of(&[Change::Scaled(Group::Translations, 25.4)], Some(1.0), Over::Noise);
        assert!((inches.each[0] * sigma - 1.0).abs() < 1e-12);
        let model = of(&[], Some(1.0), Over::Model);
        let expected = sigma.hypot(2e-3 * length);
        assert!((model.each[0] * expected - 1.0).abs() < 1e-12, "two thousandths are missed");
    }
}
