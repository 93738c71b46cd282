//! The command `creepage`.

use std::process::ExitCode;

fn main() -> ExitCode {
    creepage::cli::main()
}
