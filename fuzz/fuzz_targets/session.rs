//! libFuzzer on the target `session`.
#![no_main]

hexbench_fuzz::fuzz!("session");
