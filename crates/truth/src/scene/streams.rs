//! One random stream for every purpose and number.

use hexbench_core::streams::{self, stream};
use rand_pcg::Pcg64;

use super::PartName;

/// What a stream decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScenePurpose {
    /// Loads of the plan.
    Loads,
    /// A pose of a part.
    Pose(PartName),
    /// Approach and surroundings of a condition of a part.
    Surroundings(PartName),
    /// Noise of a row of a part.
    Noise(PartName),
    /// Noise of a reference reading that rows of a part share.
    ReferenceNoise(PartName),
    /// Frames of the instrument.
    InstrumentFrames,
}

impl ScenePurpose {
    fn in_core(self) -> streams::Purpose {
        use streams::Purpose as P;
        match self {
            Self::Loads => P::SceneLoads,
            Self::InstrumentFrames => P::SceneFrames,
            Self::Pose(PartName::Training) => P::SceneTrainingPose,
            Self::Pose(PartName::Holdout) => P::SceneHoldoutPose,
            Self::Surroundings(PartName::Training) => P::SceneTrainingSurroundings,
            Self::Surroundings(PartName::Holdout) => P::SceneHoldoutSurroundings,
            Self::Noise(PartName::Training) => P::SceneTrainingNoise,
            Self::Noise(PartName::Holdout) => P::SceneHoldoutNoise,
            Self::ReferenceNoise(PartName::Training) => P::SceneTrainingReferenceNoise,
            Self::ReferenceNoise(PartName::Holdout) => P::SceneHoldoutReferenceNoise,
        }
    }
}

/// Random streams of a seed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Streams {
    seed: u64,
}

impl Streams {
    /// The streams of a seed.
    pub fn new(seed: u64) -> Self {
        Self { seed }
    }

    /// The stream of a purpose and a number.
    pub fn of(self, purpose: ScenePurpose, number: u64) -> Pcg64 {
        stream(self.seed, purpose.in_core(), [number])
    }
}

#[cfg(test)]
mod tests {
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// First normal values of neighboring streams: mean, variance and correlation within 4.5 standard errors.
    #[test]
    fn neighbouring_streams_are_independent() {
        const STREAMS: u32 = 20_000;
        let first = |seed: u64, number: u32| -> f64 {
            let purpose = ScenePurpose::Noise(PartName::Training);
            StandardNormal.sample(&mut Streams::new(seed).of(purpose, u64::from(number)))
        };
        let draws: Vec<f64> = (0..=STREAMS).map(|number| first(7, number)).collect();
        let others: Vec<f64> = (0..=STREAMS).map(|number| first(8, number)).collect();
        let n = f64::from(STREAMS);
        let bound = 4.5 / n.sqrt();
        let mean = draws.iter().sum::<f64>() / n;
        let variance = draws.iter().map(|x| x * x).sum::<f64>() / n;
        let along = draws.windows(2).map(|w| w[0] * w[1]).sum::<f64>() / n;
        let across = draws.iter().zip(&others).map(|(x, y)| x * y).sum::<f64>() / n;
        for (what, value, size) in [
            ("mean", mean, 1.0),
            ("variance", variance - 1.0, 2_f64.sqrt()),
            ("from number to number", along, 1.0),
            ("from seed to seed", across, 1.0),
        ] {
            assert!(value.abs() < bound * size, "{what}: {value}, at most {}", bound * size);
        }
    }

    #[test]
    fn purposes_do_not_share_a_stream() {
        let [a, b] = [PartName::Training, PartName::Holdout];
        let all = [
            ScenePurpose::Loads,
            ScenePurpose::InstrumentFrames,
            ScenePurpose::Pose(a),
            ScenePurpose::Pose(b),
            ScenePurpose::Surroundings(a),
            ScenePurpose::Surroundings(b),
            ScenePurpose::Noise(a),
            ScenePurpose::Noise(b),
            ScenePurpose::ReferenceNoise(a),
            ScenePurpose::ReferenceNoise(b),
        ];
        let streams: Vec<Pcg64> = all.iter().map(|p| Streams::new(1).of(*p, 0)).collect();
        for i in 0..streams.len() {
            assert!(!streams[..i].contains(&streams[i]), "{:?}", all[i]);
        }
    }
}
