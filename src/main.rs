//! The `mms` command.

use std::process::ExitCode;

use peak_alloc::PeakAlloc;

/// Counts what is allocated, so that a run can say what it takes.
#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

fn main() -> ExitCode {
    mms_command::run().into()
}
