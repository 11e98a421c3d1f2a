//! Correlations between neighboring streams.

use hexbench_core::streams::{Purpose, stream};
use rand::RngExt;
use rand_pcg::Pcg64;
use statrs::distribution::{ContinuousCDF, Normal};

/// Streams of a set, numbered from 0.
const STREAMS: u32 = 30_000;
/// Draws of each stream.
const DRAWS: usize = 12;
/// A stream is compared with the next ones, up to the fourth.
const LAGS: usize = 4;
/// A small one, a neighbor of it, and one of those the bench uses.
const SEEDS: [u64; 3] = [1, 2, 20_261];
/// Chance that independent streams break the bound in any comparison of a test.
const ALARM: f64 = 1e-3;
/// Comparisons of one set of streams.
const COMPARISONS: usize = LAGS * DRAWS * DRAWS;

/// The largest correlation of a set of streams.
struct Largest {
    /// Correlation over its standard error.
    z: f64,
    /// Everything about it.
    text: String,
}

/// Draws of some streams, evenly distributed with mean 0 and variance 1: for each place in the stream, one of every stream.
fn table(stream: impl Fn(u64) -> Pcg64) -> [Vec<f64>; DRAWS] {
    let mut table = [const { Vec::new() }; DRAWS];
    for mut rng in (0..STREAMS).map(|number| stream(number.into())) {
        for column in &mut table {
            column.push((rng.random::<f64>() - 0.5) * 12_f64.sqrt());
        }
    }
    table
}

/// The largest correlation of any draw with any draw of the next streams.
fn largest(table: &[Vec<f64>; DRAWS]) -> Largest {
    let mut largest = Largest { z: 0.0, text: String::new() };
    for lag in 1..=LAGS {
        for (i, first) in table.iter().enumerate() {
            for (j, later) in table.iter().enumerate() {
                let n = (first.len() - lag) as f64;
                let r = first.iter().zip(&later[lag..]).map(|(x, y)| x * y).sum::<f64>() / n;
                let z = r * n.sqrt();
                if z.abs() > largest.z.abs() {
                    let text = format!("draw {} with draw {} at lag {lag}: r {r:.4}, z {z:.2}", i + 1, j + 1);
                    largest = Largest { z, text };
                }
            }
        }
    }
    largest
}

/// Standard errors that the largest of so many correlations exceeds but for [`ALARM`] (Bonferroni).
fn bound(sets: usize) -> f64 {
    Normal::standard().inverse_cdf(1.0 - ALARM / (2 * sets * COMPARISONS) as f64)
}

#[test]
fn streams_of_neighboring_numbers_are_not_correlated() {
    let bound = bound(SEEDS.len());
    for seed in SEEDS {
        let found = largest(&table(|trial| stream(seed, Purpose::Test, [trial])));
        assert!(found.z.abs() < bound, "seed {seed}: {}, bound {bound:.2}", found.text);
    }
}

#[test]
fn streams_of_neighboring_seeds_are_not_correlated() {
    let bound = bound(SEEDS.len());
    for number in SEEDS {
        let found = largest(&table(|seed| stream(seed, Purpose::Test, [number])));
        assert!(found.z.abs() < bound, "number {number}: {}, bound {bound:.2}", found.text);
    }
}

/// The generator with the seed as its state and the number as its increment.
#[test]
fn without_a_hash_they_are() {
    let bound = bound(SEEDS.len());
    for seed in SEEDS {
        let found = largest(&table(|trial| Pcg64::new(seed.into(), trial.into())));
        assert!(found.z.abs() > bound, "seed {seed}: {}, bound {bound:.2}", found.text);
    }
}
