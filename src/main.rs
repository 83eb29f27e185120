//! The `mms` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    mms::cli::run()
}
