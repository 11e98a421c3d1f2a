//! The `hexbench` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    hexbench_cli::main()
}
