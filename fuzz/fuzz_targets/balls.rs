//! libFuzzer on the target `balls`.
#![no_main]

hexbench_fuzz::fuzz!("balls");
