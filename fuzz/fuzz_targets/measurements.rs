//! libFuzzer on the target `measurements`.
#![no_main]

hexbench_fuzz::fuzz!("measurements");
