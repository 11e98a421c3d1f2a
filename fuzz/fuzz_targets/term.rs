//! libFuzzer on the target `term`.
#![no_main]

hexbench_fuzz::fuzz!("term");
