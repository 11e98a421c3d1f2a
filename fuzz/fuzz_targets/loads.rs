//! libFuzzer on the target `loads`.
#![no_main]

hexbench_fuzz::fuzz!("loads");
