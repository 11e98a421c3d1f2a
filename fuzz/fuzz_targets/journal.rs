//! libFuzzer on the target `journal`.
#![no_main]

hexbench_fuzz::fuzz!("journal");
