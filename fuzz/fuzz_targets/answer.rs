#![no_main]

hexbench_fuzz::fuzz!("answer");
