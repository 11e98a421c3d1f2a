//! The balls themselves as readings, with no pose in between.

use std::f64::consts::SQRT_2;

use hexbench_core::{Channel, Columns, Dataset, Hexapod, Measurand, Observation, Sensor, SensorKind, UNREAD};

use super::BallCampaign;

impl BallCampaign {
    /// The machine with a sensor of kind `point` for every ball, and the displacements as their readings.
    ///
    /// Limits: with balls on the base, the noise of their frame is common to all balls of a record and not in the stated one.
    pub fn as_points(&self, hexapod: &Hexapod) -> (Hexapod, Dataset) {
        let names = names(self.balls.iter().map(|place| place.ball.as_str()));
        let sigma = [self.sigma * SQRT_2; 3];
        let sensor = |(name, place): (String, &hexbench_core::BallPlace)| {
            Sensor::new(name, SensorKind::Point { point: place.centre, sigma })
        };
        let sensors: Vec<Sensor> = names.into_iter().zip(&self.balls).map(sensor).collect();
        let channels = Channel::all([], &sensors);
        let blocks = Channel::in_blocks(&channels);
        let rows = self.dataset.observations.iter().zip(&self.displacements);
        let observations = rows.flat_map(|(row, moved)| {
            let numbers: Vec<f64> = moved.iter().flat_map(|d| d.iter().copied()).collect();
            let block = |(block, part): (usize, &[f64])| Observation {
                block,
                measured: std::array::from_fn(|k| part.get(k).copied().unwrap_or_default()),
                sigma: Some(std::array::from_fn(|k| if k < part.len() { sigma[0] } else { UNREAD })),
                ..*row
            };
            numbers.chunks(6).enumerate().map(block).collect::<Vec<_>>()
        });
        let dataset = Dataset {
            source: self.dataset.source.clone(),
            measurand: Measurand::DeflectionRotationVector,
            columns: Columns { sigma: true, ..self.dataset.columns },
            observations: observations.collect(),
            blocks,
        };
        (Hexapod { sensors, ..hexapod.clone() }, dataset)
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
