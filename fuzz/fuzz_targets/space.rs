//! libFuzzer on the target `space`.
#![no_main]

hexbench_fuzz::fuzz!("space");
