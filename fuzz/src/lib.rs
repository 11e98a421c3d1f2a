//! The readers as functions of unchecked bytes, one per reader, for a fuzzer and for the tests.
//!
//! ```text
//! corpus/TARGET/*  --fuzz_targets/TARGET.rs, mutated by coverage (scripts/fuzz.sh)-->  Target::check
//! corpus/TARGET/*  --tests/replay.rs, as they are and mutated by a seed (./test)--->   Target::check
//! ```
//!
//! A target may refuse its input with any message. It must not panic, and whatever it accepts must fulfill a contract: written back
//! it is the same, its numbers are finite, and its prediction is a number or an error.

#![expect(clippy::expect_used, reason = "a panic is how a target says that a promise is broken")]

mod mutate;
mod scratch;
mod targets;

pub use mutate::mutate;
pub use targets::{TARGETS, Target, named};

/// A program of libFuzzer for one target: every second mutation knows lines, cells and numbers.
#[cfg(feature = "libfuzzer")]
#[macro_export]
macro_rules! fuzz {
    ($name:literal) => {
        use std::sync::LazyLock;

        static TARGET: LazyLock<&hexbench_fuzz::Target> =
            LazyLock::new(|| hexbench_fuzz::named($name).expect("a target of the list"));

        libfuzzer_sys::fuzz_target!(|data: &[u8]| {
            (TARGET.check)(data);
        });

        libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
            if seed % 2 == 0 {
                return libfuzzer_sys::fuzzer_mutate(data, size, max_size);
            }
            let mutated = hexbench_fuzz::mutate(&data[..size], u64::from(seed));
            let kept = mutated.len().min(max_size);
            data[..kept].copy_from_slice(&mutated[..kept]);
            kept
        });
    };
}
