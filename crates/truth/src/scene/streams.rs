//! One random stream for every purpose and number.

use rand_pcg::Pcg64;

/// What a stream decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Loads of the plan.
    Loads,
    /// A pose of a part.
    Pose(super::PartName),
    /// Approach and surroundings of a condition of a part.
    Surroundings(super::PartName),
    /// Noise of a row of a part.
    Noise(super::PartName),
    /// Frames of the instrument.
    Frames,
}

impl Purpose {
    fn number(self) -> u64 {
        match self {
            Self::Loads => 1,
            Self::Frames => 2,
            Self::Pose(part) => 10 + part as u64,
            Self::Surroundings(part) => 20 + part as u64,
            Self::Noise(part) => 30 + part as u64,
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
    pub fn of(self, purpose: Purpose, number: u64) -> Pcg64 {
        stream([self.seed, purpose.number(), number])
    }
}

/// The random stream of some numbers: a seed, what the stream decides, for which row or trial.
///
/// All are mixed into the state, because generators of this kind whose streams differ by the increment alone are not
/// independent.
pub fn stream<const N: usize>(numbers: [u64; N]) -> Pcg64 {
    let [mut state, last] = [numbers.first(), numbers.last()].map(|n| n.copied().unwrap_or(0));
    state = mixed(state);
    for &number in numbers.iter().skip(1) {
        state = mixed(state ^ mixed(number));
    }
    Pcg64::new(u128::from(state) << 64 | u128::from(mixed(!state)), u128::from(mixed(state ^ last)))
}

/// One step of `SplitMix64` (Steele, Lea, Flood, OOPSLA 2014): a bijection whose output bits all depend on all input bits.
fn mixed(word: u64) -> u64 {
    let mut z = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use rand_distr::{Distribution, StandardNormal};

    use super::super::PartName;
    use super::*;

    /// First normal values of neighbouring streams: mean, variance and correlation within 4.5 standard errors.
    #[test]
    fn neighbouring_streams_are_independent() {
        const STREAMS: u32 = 20_000;
        let first = |seed: u64, number: u32| -> f64 {
            let purpose = Purpose::Noise(PartName::Training);
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
            Purpose::Loads,
            Purpose::Frames,
            Purpose::Pose(a),
            Purpose::Pose(b),
            Purpose::Surroundings(a),
            Purpose::Surroundings(b),
            Purpose::Noise(a),
            Purpose::Noise(b),
        ];
        let streams: Vec<Pcg64> = all.iter().map(|p| Streams::new(1).of(*p, 0)).collect();
        for i in 0..streams.len() {
            assert!(!streams[..i].contains(&streams[i]), "{:?}", all[i]);
        }
    }
}
