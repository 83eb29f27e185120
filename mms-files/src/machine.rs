//! The machine: its processor and its free memory.

use std::path::Path;

use mms_spec::MAX_FILE;

use crate::read;

/// The number of threads that run at the same time here.
pub fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, Into::into)
}

/// The bytes of free memory, within the limit of a container if there is one; `u64::MAX` if the system does not report them.
pub fn memory() -> u64 {
    let mut system = sysinfo::System::new();
    system.refresh_memory();
    let free = match system.cgroup_limits() {
        Some(limits) => system.available_memory().min(limits.free_memory),
        None => system.available_memory(),
    };
    if free == 0 { u64::MAX } else { free }
}

/// The name of the processor; if the system does not report it, the name of the architecture.
pub fn processor() -> String {
    let described = read::first(Path::new("/proc/cpuinfo"), MAX_FILE as u64);
    let described = described.unwrap_or_default();
    let described = String::from_utf8_lossy(&described);
    let name = described.lines().find_map(|line| {
        let (key, value) = line.split_once(':')?;
        (key.trim() == "model name").then(|| value.trim().to_owned())
    });
    name.unwrap_or_else(|| std::env::consts::ARCH.to_owned())
}
