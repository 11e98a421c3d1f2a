//! libFuzzer on the target `robot`.
#![no_main]

hexbench_fuzz::fuzz!("robot");
