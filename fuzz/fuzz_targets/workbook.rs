//! libFuzzer on the target `workbook`.
#![no_main]

hexbench_fuzz::fuzz!("workbook");
