#![no_main]

hexbench_fuzz::fuzz!("ball_places");
