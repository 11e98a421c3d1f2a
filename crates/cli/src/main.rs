//! The hexbench command.

fn main() {}
