//! libFuzzer on the target `answer`.
#![no_main]

hexbench_fuzz::fuzz!("answer");
