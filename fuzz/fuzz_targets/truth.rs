//! libFuzzer on the target `truth`.
#![no_main]

hexbench_fuzz::fuzz!("truth");
