//! A supervisor in place of `mms`.

use std::process::ExitCode;

use mms_campaign::supervisor;

fn main() -> ExitCode {
    let arguments = supervisor::supervisor_arguments(std::env::args_os()).unwrap_or_default();
    supervisor::run(&arguments).into()
}
