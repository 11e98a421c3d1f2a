//! libFuzzer on the target `suite`.
#![no_main]

hexbench_fuzz::fuzz!("suite");
