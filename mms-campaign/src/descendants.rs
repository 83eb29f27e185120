//! The processes that a run has started: finds and ends them.
//!
//! On Linux this process adopts descendants whose parent has ended (`PR_SET_CHILD_SUBREAPER`), so that none escapes by `setsid`
//! or by forking twice. On other systems, or without `/proc`, only the process group of the run is known.

use std::fmt;

/// A process.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Process {
    /// The process number.
    pub number: i32,
    /// The name that the system reports.
    pub name: String,
    /// The process group, if all members of it are descendants as well.
    pub group: Option<i32>,
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
        // If this fails, the process group is still ended.
        let _ = nix::sys::prctl::set_child_subreaper(true);
    }
}

/// Releases adopted processes that have ended, except the child of this number, which has its own waiter. Returns whether any
/// child remains. This is safer than a list of processes, which may change while it is made.
#[cfg(target_os = "linux")]
pub fn remain(child: u32) -> bool {
    use nix::sys::wait::{Id, WaitPidFlag, waitid, waitpid};
    let look = WaitPidFlag::WEXITED | WaitPidFlag::WNOHANG | WaitPidFlag::WNOWAIT;
    loop {
        let Ok(status) = waitid(Id::All, look) else { return false };
        match status.pid() {
            Some(ended) if ended.as_raw() != child as i32 => {
                let _ = waitpid(ended, Some(WaitPidFlag::WNOHANG));
            }
            _ => return true,
        }
    }
}

#[cfg(all(unix, not(target_os = "linux")))]
pub fn remain(child: u32) -> bool {
    nix::sys::signal::kill(pid(-(child as i32)), None).is_ok()
}

#[cfg(not(unix))]
pub fn remain(_: u32) -> bool {
    false
}

/// The visible living descendants of this process. The number of the run's process group is that group's first process.
#[cfg(unix)]
pub fn living(first: u32) -> Vec<Process> {
    let first = first as i32;
    descendants(first).unwrap_or_else(|| {
        let group = Some(first);
        vec![Process { number: first, name: "its process group".to_owned(), group }]
    })
}

#[cfg(not(unix))]
pub fn living(_: u32) -> Vec<Process> {
    Vec::new()
}

/// The descendants of this process from `/proc`.
#[cfg(unix)]
fn descendants(first: i32) -> Option<Vec<Process>> {
    let own = i32::try_from(std::process::id()).ok()?;
    let entries = std::fs::read_dir("/proc").ok()?.flatten();
    let lines = entries.filter_map(|it| std::fs::read_to_string(it.path().join("stat")).ok());
    let all: Vec<ProcessRow> = lines.filter_map(|line| ProcessRow::parse(&line)).collect();
    let session = all.iter().find(|row| row.number == own)?.session;
    let mut found: Vec<Process> = Vec::new();
    let mut parents = vec![own];
    while let Some(parent) = parents.pop() {
        for row in all.iter().filter(|row| row.parent == parent) {
            parents.push(row.number);
            // In this session other processes may have joined a group.
            let is_ours = row.session != session || row.group == first;
            let group = is_ours.then_some(row.group);
            found.push(Process { number: row.number, name: row.name.clone(), group });
        }
    }
    Some(found)
}

/// A living process from `/proc`.
#[cfg(unix)]
struct ProcessRow {
    number: i32,
    name: String,
    parent: i32,
    group: i32,
    session: i32,
}

#[cfg(unix)]
impl ProcessRow {
    /// Reads a line such as `12 (name) S 11 12 10 ..`.
    fn parse(line: &str) -> Option<Self> {
        // A name may contain blanks and brackets.
        let (head, rest) = line.rsplit_once(')')?;
        let (number, name) = head.split_once(" (")?;
        let mut rest = rest.split_whitespace();
        let state = rest.next()?;
        let mut next = || rest.next()?.parse::<i32>().ok();
        let (parent, group, session) = (next()?, next()?, next()?);
        let (number, name) = (number.parse().ok()?, name.replace('\n', " "));
        (!matches!(state, "Z" | "X")).then_some(ProcessRow { number, name, parent, group, session })
    }
}

/// Asks processes to end, or kills them if `at_once`. Signals their groups too, as a forking process may be gone by then.
#[cfg(unix)]
pub fn signal(processes: &[Process], at_once: bool) {
    use nix::sys::signal::{Signal, kill};
    let signal = if at_once { Signal::SIGKILL } else { Signal::SIGTERM };
    let mut groups: Vec<i32> = processes.iter().filter_map(|it| it.group).collect();
    groups.sort_unstable();
    groups.dedup();
    for group in groups {
        let _ = kill(pid(-group), signal);
    }
    for process in processes.iter().filter(|it| it.group.is_none()) {
        let _ = kill(pid(process.number), signal);
    }
}

#[cfg(not(unix))]
pub fn signal(_: &[Process], _: bool) {}

#[cfg(unix)]
fn pid(number: i32) -> nix::unistd::Pid {
    nix::unistd::Pid::from_raw(number)
}
