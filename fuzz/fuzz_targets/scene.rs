//! libFuzzer on the target `scene`.
#![no_main]

hexbench_fuzz::fuzz!("scene");
