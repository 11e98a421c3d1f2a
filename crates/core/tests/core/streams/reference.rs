//! Streams against another implementation; scenes and studies keep their readings as long as this holds.

use hexbench_core::streams::{Purpose, derived_seed, stream};
use rand::RngExt;

/// `scripts/reference/streams.py`, Python 3.11, November 2026: first three words.
#[test]
fn streams_are_those_of_another_implementation() {
    let first = |mut rng: rand_pcg::Pcg64| -> [u64; 3] { rng.random() };
    for (found, expected) in [
        (
            stream(7, Purpose::SceneTrainingNoise, [5]),
            [0x80a8_7837_c533_bca9, 0xd48f_f89e_6d7e_8788, 0xa789_24de_1eb5_1d8f],
        ),
        (
            stream(1, Purpose::SceneFrames, [0]),
            [0x7db8_3b6f_cd90_ee34, 0x46b7_0303_125d_b837, 0xf5ee_57da_6a15_f601],
        ),
        (
            stream(3, Purpose::Study, [6, 2, 9]),
            [0xb8c8_3f61_ed6e_3951, 0x8886_f648_e18c_5b9c, 0x90de_ed00_c0df_b80e],
        ),
        (stream(7, Purpose::Test, []), [0x2391_8e4e_3e29_412a, 0xa04a_72d9_e868_9131, 0x2367_97f9_de61_3939]),
    ] {
        assert_eq!(first(found), expected);
    }
}

#[test]
fn parts_of_neighboring_seeds_have_seeds_of_their_own() {
    let seeds = (0..50).flat_map(|seed| (0..50).map(move |n| derived_seed(seed, Purpose::Test, [n])));
    let mut all: Vec<u64> =
        seeds.chain((0..50).map(|seed| derived_seed(seed, Purpose::Example, []))).collect();
    let count = all.len();
    all.sort_unstable();
    all.dedup();
    assert_eq!(all.len(), count);
}
