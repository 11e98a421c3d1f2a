//! libFuzzer on the target `requests`.
#![no_main]

hexbench_fuzz::fuzz!("requests");
