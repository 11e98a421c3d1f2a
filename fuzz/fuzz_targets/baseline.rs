//! libFuzzer on the target `baseline`.
#![no_main]

hexbench_fuzz::fuzz!("baseline");
