//! libFuzzer on the target `campaign`.
#![no_main]

hexbench_fuzz::fuzz!("campaign");
