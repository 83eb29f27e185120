//! The supervisor of a run: a process between a campaign and the program that it runs.
//!
//! The supervisor starts the program and keeps the program's output. It ends the program, and all processes that the program
//! has started, when the program has ended, when the time is over, on a signal, and when the supervisor's stdin ends, which is
//! a pipe from the campaign. So a run ends with its campaign for any cause. The supervisor's stderr is the file [`RUNNING`] of
//! the run, whose lock it shares. It writes there before the program starts, and empties the file when no process of the run
//! remains. Its stdout is a [`Report`].

use std::ffi::OsString;
use std::fs::File;
use std::io::{self, Read, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::thread::{sleep, spawn};
use std::time::{Duration, Instant};

use crate::descendants::{Process, adopt, living, remain, signal};
use crate::printed;

/// The first argument that turns a program into a supervisor.
pub const WORD: &str = "supervise-run";

/// The file that is locked and not empty while any process of a run may be at work.
pub const RUNNING: &str = "running";

/// The file with the stdout of a run.
pub const STDOUT: &str = "stdout.txt";

/// The file with the stderr of a run.
pub const STDERR: &str = "stderr.txt";

/// The end of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ended {
    /// With success.
    Well,
    /// With a failure, described here.
    Badly(String),
    /// By an interruption.
    Interrupted,
}

/// The report of a supervisor on a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// The end of the run.
    pub ended: Ended,
    /// The names of processes that were still at work after its program, and were ended.
    pub left_behind: Vec<String>,
}

impl Report {
    /// The report of a run that failed.
    pub fn badly(how: impl Into<String>) -> Self {
        Report { ended: Ended::Badly(how.into()), left_behind: Vec::new() }
    }

    /// The report as lines for a pipe.
    fn lines(&self) -> String {
        let ended = match &self.ended {
            Ended::Well => "well".to_owned(),
            Ended::Interrupted => "interrupted".to_owned(),
            Ended::Badly(how) => format!("badly {}", how.replace('\n', " ")),
        };
        let names = self.left_behind.iter().map(|name| format!("{name}\n"));
        format!("{ended}\n{}", names.collect::<String>())
    }

    /// Parses the lines of a report; `None` if they are incomplete.
    pub fn parse(text: &str) -> Option<Self> {
        let mut lines = text.strip_suffix('\n')?.split('\n');
        let ended = match lines.next()?.split_once(' ') {
            Some(("badly", how)) => Ended::Badly(how.to_owned()),
            None if text.starts_with("well\n") => Ended::Well,
            None if text.starts_with("interrupted\n") => Ended::Interrupted,
            _ => return None,
        };
        Some(Report { ended, left_behind: lines.map(str::to_owned).collect() })
    }
}

/// The arguments of a supervisor, if the first argument is [`WORD`].
pub fn supervisor_arguments(
    arguments: impl IntoIterator<Item = OsString>,
) -> Option<Vec<OsString>> {
    let mut arguments = arguments.into_iter().skip(1);
    (arguments.next()? == WORD).then(|| arguments.collect())
}

/// Supervises a run, and returns an exit code. The arguments are its folder, its working directory, its limit in seconds, its
/// program and the program's arguments.
pub fn run(arguments: &[OsString]) -> u8 {
    let [folder, directory, limit, words @ ..] = arguments else { return 2 };
    let seconds = limit.to_str().and_then(|it| it.parse::<f64>().ok()).unwrap_or(f64::INFINITY);
    let limit = Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX);
    let run =
        SupervisedRun { folder: Path::new(folder), directory: Path::new(directory), words, limit };
    let told = run.supervised().map(|report| report.lines());
    match told.and_then(|lines| io::stdout().write_all(lines.as_bytes())) {
        Ok(()) => 0,
        Err(_) => 1,
    }
}

/// The shortest and the longest pause between checks.
pub const PAUSES: [Duration; 2] = [Duration::from_millis(1), Duration::from_millis(50)];

/// The time that processes have to end after the first signal.
const GRACE: Duration = Duration::from_secs(2);

/// The time that helpers of an ended program have to end, before they count as left behind.
const HELPERS: Duration = Duration::from_secs(1);

/// The time that the system has to end killed processes.
const KILLED: Duration = Duration::from_secs(5);

/// The longest wait for the last output of a run.
const LAST_WORDS: Duration = Duration::from_secs(1);

/// The most processes that are named.
const MOST_NAMES: usize = 16;

/// A program to run, its folders and its limit.
struct SupervisedRun<'a> {
    folder: &'a Path,
    directory: &'a Path,
    words: &'a [OsString],
    limit: Duration,
}

impl SupervisedRun<'_> {
    fn supervised(&self) -> io::Result<Report> {
        let [program, arguments @ ..] = self.words else { return Ok(Report::badly("no command")) };
        let stop = stop()?;
        adopt();
        let mut running = running()?;
        writeln!(running, "process {} supervises a run here", std::process::id())?;
        let mut command = Command::new(named(program, self.directory));
        command.args(arguments).current_dir(self.directory).stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        in_own_group(&mut command);
        let (report, is_over) = match command.spawn() {
            Ok(child) => self.followed(child, &stop)?,
            Err(error) => {
                let [program, directory] = [Path::new(program), self.directory].map(Path::display);
                let how = format!("`{program}` cannot be started in `{directory}`: {error}");
                (Report::badly(how), true)
            }
        };
        if is_over {
            running.set_len(0)?;
        }
        Ok(report)
    }

    /// Waits for a program, and ends the remaining processes of its run. Returns also whether none remain.
    fn followed(&self, mut child: Child, stop: &AtomicBool) -> io::Result<(Report, bool)> {
        let printed = self.printed(&mut child);
        let mut ended = self.wait_for_end(&mut child, stop)?;
        let mut left_behind = Vec::new();
        if child.try_wait()?.is_some() {
            left_behind = left(&mut child, HELPERS, false)?;
        }
        let staying = end(&mut child)?;
        let started = Instant::now();
        for file in printed {
            let _ = file.recv_timeout(LAST_WORDS.saturating_sub(started.elapsed()));
        }
        if !staying.is_empty() {
            let names = staying.iter().take(MOST_NAMES).map(Process::to_string);
            let names: Vec<String> = names.collect();
            ended = Ended::Badly(format!(
                "it left processes that cannot be ended: {}",
                names.join(", ")
            ));
        }
        let others = left_behind.len().saturating_sub(MOST_NAMES);
        let mut left_behind: Vec<String> =
            left_behind.into_iter().take(MOST_NAMES).map(|it| it.name).collect();
        left_behind.extend((others > 0).then(|| format!("{others} others")));
        Ok((Report { ended, left_behind }, staying.is_empty()))
    }

    /// Keeps the output of a program; each receiver reports a complete file.
    fn printed(&self, child: &mut Child) -> Vec<Receiver<()>> {
        let keep = |from: Option<Box<dyn Read + Send>>, name: &str| {
            let (sender, receiver) = channel();
            let path = self.folder.join(name);
            spawn(move || {
                let _ = from.map(|from| printed::keep(from, &path));
                let _ = sender.send(());
            });
            receiver
        };
        let stdout = child.stdout.take().map(|it| Box::new(it) as Box<dyn Read + Send>);
        let stderr = child.stderr.take().map(|it| Box::new(it) as Box<dyn Read + Send>);
        vec![keep(stdout, STDOUT), keep(stderr, STDERR)]
    }

    /// Waits until a program ends, or must be ended, and returns the reason.
    fn wait_for_end(&self, child: &mut Child, stop: &AtomicBool) -> io::Result<Ended> {
        let (started, mut pause) = (Instant::now(), PAUSES[0]);
        loop {
            if let Some(status) = child.try_wait()? {
                return Ok(ended_with(status));
            }
            if stop.load(Ordering::Relaxed) {
                return Ok(Ended::Interrupted);
            }
            let left = self.limit.saturating_sub(started.elapsed());
            if left.is_zero() {
                let seconds = self.limit.as_secs_f64();
                let how = format!("stopped after {seconds} s, its limit (`time_limit`)");
                return Ok(Ended::Badly(how));
            }
            remain(child.id());
            sleep(pause.min(left));
            pause = (pause * 2).min(PAUSES[1]);
        }
    }
}

/// The end of a program with this status.
fn ended_with(status: ExitStatus) -> Ended {
    if status.success() {
        return Ended::Well;
    }
    Ended::Badly(match status.code() {
        Some(code) => format!("it ended with exit code {code}"),
        None => format!("it was ended: {status}"),
    })
}

/// Ends all processes of a run: first with a signal that they can handle, so that programs can end the processes that they have
/// started. Returns those that cannot be ended.
fn end(child: &mut Child) -> io::Result<Vec<Process>> {
    signal(&living(child.id()), false);
    let staying = left(child, GRACE, false)?;
    if staying.is_empty() { Ok(staying) } else { left(child, KILLED, true) }
}

/// Waits until all processes of a run have ended, for at most `patience`, and returns those that remain. Kills them while it
/// waits if `kill`.
fn left(child: &mut Child, patience: Duration, kill: bool) -> io::Result<Vec<Process>> {
    let (started, mut pause) = (Instant::now(), PAUSES[0]);
    loop {
        if kill {
            signal(&living(child.id()), true);
            #[cfg(not(unix))]
            let _ = child.kill();
        }
        if child.try_wait()?.is_some() && !remain(child.id()) {
            return Ok(Vec::new());
        }
        if started.elapsed() >= patience {
            let all = living(child.id());
            let unseen = || Process { number: 0, name: "an invisible process".into(), group: None };
            return Ok(if all.is_empty() { vec![unseen()] } else { all });
        }
        sleep(pause);
        pause = (pause * 2).min(PAUSES[1]);
    }
}

/// A program with a path is in the working directory of the run; another one is found on the PATH.
fn named(program: &OsString, directory: &Path) -> PathBuf {
    let path = Path::new(program);
    if path.components().count() > 1 { directory.join(path) } else { path.to_owned() }
}

/// A flag that becomes true when the campaign ends, or on a signal.
fn stop() -> io::Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    for signal in signals() {
        signal_hook::flag::register(signal, stop.clone())?;
    }
    let seen = stop.clone();
    spawn(move || {
        let _ = io::copy(&mut io::stdin(), &mut io::sink());
        seen.store(true, Ordering::Relaxed);
    });
    Ok(stop)
}

/// The signals for an end: Ctrl-C, Ctrl-\, `kill`, and a closed terminal unless `nohup` ignores it.
pub fn signals() -> impl Iterator<Item = i32> {
    #[cfg(unix)]
    let more = Some(signal_hook::consts::SIGHUP).filter(|signal| !is_ignored(*signal));
    #[cfg(not(unix))]
    let more = None;
    signal_hook::consts::TERM_SIGNALS.iter().copied().chain(more)
}

/// Whether this process ignores a signal, according to Linux.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|digits| u64::from_str_radix(digits.trim(), 16).ok());
    ignored.is_some_and(|signals| signals & (1 << (signal - 1)) != 0)
}

/// The stderr of a supervisor, which is the file that marks a run at work.
fn running() -> io::Result<File> {
    #[cfg(unix)]
    let file = std::os::fd::AsFd::as_fd(&io::stderr()).try_clone_to_owned()?;
    #[cfg(not(unix))]
    let file = std::os::windows::io::AsHandle::as_handle(&io::stderr()).try_clone_to_owned()?;
    Ok(file.into())
}

/// Puts a process into its own group, which Ctrl-C at a terminal does not reach.
pub fn in_own_group(command: &mut Command) {
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    #[cfg(not(unix))]
    let _ = command;
}
