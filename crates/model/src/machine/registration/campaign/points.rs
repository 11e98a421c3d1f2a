//! The balls themselves as readings, with no pose in between.

use std::f64::consts::SQRT_2;

use hexbench_core::{
    BallPlace, Channel, Columns, Dataset, Hexapod, Matrix6, Measurand, Observation, Sensor, SensorKind,
    UNREAD, Vector3,
};

use super::super::rigid;
use super::BallCampaign;

impl BallCampaign {
    /// The machine with a sensor of kind `point` for every ball, and the displacements as their readings.
    ///
    /// With balls on the base, `[1, -p x]` carries the noise of their frame to the ball at p.
    ///
    /// Limits: that noise is common to all balls of a record; each ball is given its share, not what they have in common.
    pub fn as_points(&self, hexapod: &Hexapod) -> (Hexapod, Dataset) {
        let names = names(self.balls.iter().map(|place| place.ball.as_str()));
        let sigmas: Vec<[f64; 3]> = self.balls.iter().map(|place| self.noise_of(place)).collect();
        let sensor = |((name, place), sigma): ((String, &BallPlace), &[f64; 3])| {
            Sensor::new(name, SensorKind::Point { point: place.centre, sigma: *sigma })
        };
        let sensors: Vec<Sensor> = names.into_iter().zip(&self.balls).zip(&sigmas).map(sensor).collect();
        let sigmas = sigmas.concat();
        let channels = Channel::all([], &sensors);
        let blocks = Channel::in_blocks(&channels);
        let rows = self.dataset.observations.iter().zip(&self.displacements);
        let observations = rows.flat_map(|(row, moved)| {
            let numbers: Vec<f64> = moved.iter().flat_map(|d| d.iter().copied()).collect();
            let block = |(block, part): (usize, &[f64])| Observation {
                block,
                measured: std::array::from_fn(|k| part.get(k).copied().unwrap_or_default()),
                sigma: Some(std::array::from_fn(|k| sigmas.get(6 * block + k).copied().unwrap_or(UNREAD))),
                ..*row
            };
            numbers.chunks(6).enumerate().map(block).collect::<Vec<_>>()
        });
        let dataset = Dataset {
            source: self.dataset.source.clone(),
            measurand: Measurand::DeflectionRotationVector,
            columns: Columns { sigma: true, ..self.dataset.columns },
            observations: observations.collect(),
            sequences: self.dataset.sequences.clone(),
            drawn_from: self.dataset.drawn_from,
            blocks,
        };
        (Hexapod { sensors, ..hexapod.clone() }, dataset)
    }

    /// Standard deviation of a displacement of a ball, m: two readings of it, and of the base twice.
    fn noise_of(&self, place: &BallPlace) -> [f64; 3] {
        let base: Vec<Vector3> = self.base.iter().map(|place| place.centre).collect();
        let of_frame = rigid(&base, &base).map(|frame| {
            let mut carry = Matrix6::identity();
            carry.fixed_view_mut::<3, 3>(0, 3).copy_from(&-place.centre.cross_matrix());
            carry * frame.cofactors * carry.transpose()
        });
        let own = |k: usize| 1.0 + of_frame.map_or(0.0, |frame| frame[(k, k)]);
        std::array::from_fn(|k| self.sigma * SQRT_2 * own(k).sqrt())
    }
}

/// Names of sensors: small letters, digits and `_`, beginning with a letter, each once.
fn names<'a>(balls: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for ball in balls {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
        let mut name: String = ball.chars().map(plain).collect();
        if !name.starts_with(|c: char| c.is_ascii_lowercase()) {
            name.insert_str(0, "ball_");
        }
        while all.contains(&name) {
            name.push('_');
        }
        all.push(name);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::names;

    #[test]
    fn balls_of_any_name_make_sensors() {
        assert_eq!(names(["P1", "1", "Ball A", "ball-a"].into_iter()), ["p1", "ball_1", "ball_a", "ball_a_"]);
    }
}
