//! libFuzzer on the target `sensors`.
#![no_main]

hexbench_fuzz::fuzz!("sensors");
