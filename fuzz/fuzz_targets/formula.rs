//! libFuzzer on the target `formula`.
#![no_main]

hexbench_fuzz::fuzz!("formula");
