//! libFuzzer on the target `study`.
#![no_main]

hexbench_fuzz::fuzz!("study");
