//! libFuzzer on the target `ball_places`.
#![no_main]

hexbench_fuzz::fuzz!("ball_places");
