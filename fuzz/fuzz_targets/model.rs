//! libFuzzer on the target `model`.
#![no_main]

hexbench_fuzz::fuzz!("model");
