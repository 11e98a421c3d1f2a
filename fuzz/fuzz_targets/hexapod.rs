//! libFuzzer on the target `hexapod`.
#![no_main]

hexbench_fuzz::fuzz!("hexapod");
