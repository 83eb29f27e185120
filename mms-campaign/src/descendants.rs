//! The processes that a run has started, and their end.
//!
//! On Linux this process adopts descendants whose parent has ended (`PR_SET_CHILD_SUBREAPER`), so that none escapes by
//! `setsid` or by two forks. Elsewhere, or without `/proc`, only the process group of the run is known.

use std::fmt;

/// A process, or a process group.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Process {
    /// The number of the process; that of a group is negative, as `kill` takes it.
    pub number: i32,
    /// Its name, as the system has it.
    pub name: String,
}

impl fmt::Display for Process {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.name, self.number)
    }
}

/// Adopts orphans among the descendants of this process from now on.
pub fn adopt() {
    #[cfg(target_os = "linux")]
    {
        // Without it the process group is still ended.
        let _ = nix::sys::prctl::set_child_subreaper(true);
    }
}

/// Releases adopted processes that have ended; not the child of this number, which has its own waiter.
#[cfg(target_os = "linux")]
pub fn release(child: u32) {
    use nix::sys::wait::{Id, WaitPidFlag, waitid, waitpid};
    let look = WaitPidFlag::WEXITED | WaitPidFlag::WNOHANG | WaitPidFlag::WNOWAIT;
    while let Some(ended) = waitid(Id::All, look).ok().and_then(|status| status.pid()) {
        if ended.as_raw() == child as i32 || waitpid(ended, Some(WaitPidFlag::WNOHANG)).is_err() {
            break;
        }
    }
}

#[cfg(not(target_os = "linux"))]
pub fn release(_: u32) {}

/// The living descendants of this process; `group` is the process group of the run.
#[cfg(unix)]
pub fn living(group: u32) -> Vec<Process> {
    descendants().unwrap_or_else(|| {
        let group = Process { number: -(group as i32), name: "its process group".to_owned() };
        let is_there = nix::sys::signal::kill(nix::unistd::Pid::from_raw(group.number), None);
        is_there.map(|()| group).into_iter().collect()
    })
}

#[cfg(not(unix))]
pub fn living(_: u32) -> Vec<Process> {
    Vec::new()
}

/// The descendants of this process, as `/proc` has them.
#[cfg(unix)]
fn descendants() -> Option<Vec<Process>> {
    let own = i32::try_from(std::process::id()).ok()?;
    let entries = std::fs::read_dir("/proc").ok()?.flatten();
    let lines = entries.filter_map(|it| std::fs::read_to_string(it.path().join("stat")).ok());
    let all: Vec<(Process, i32)> = lines.filter_map(|line| parsed(&line)).collect();
    all.iter().find(|(process, _)| process.number == own)?;
    let mut found: Vec<Process> = Vec::new();
    let mut parents = vec![own];
    while let Some(parent) = parents.pop() {
        let children = all.iter().filter(|(_, of)| *of == parent).map(|(it, _)| it);
        parents.extend(children.clone().map(|it| it.number));
        found.extend(children.cloned());
    }
    Some(found)
}

/// A living process and the number of its parent, from a line such as `12 (name) S 11 ..`.
#[cfg(unix)]
fn parsed(stat: &str) -> Option<(Process, i32)> {
    // A name may hold blanks and brackets.
    let (head, rest) = stat.rsplit_once(')')?;
    let (number, name) = head.split_once(" (")?;
    let mut rest = rest.split_whitespace();
    let state = rest.next()?;
    let parent = rest.next()?.parse().ok()?;
    let process = Process { number: number.parse().ok()?, name: name.replace('\n', " ") };
    (!matches!(state, "Z" | "X")).then_some((process, parent))
}

/// Asks processes to end, or ends them.
#[cfg(unix)]
pub fn signal(processes: &[Process], at_once: bool) {
    use nix::sys::signal::{Signal, kill};
    let signal = if at_once { Signal::SIGKILL } else { Signal::SIGTERM };
    for process in processes {
        // It may have ended since.
        let _ = kill(nix::unistd::Pid::from_raw(process.number), signal);
    }
}

#[cfg(not(unix))]
pub fn signal(_: &[Process], _: bool) {}
