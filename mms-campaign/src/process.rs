//! One run of a solver: a process in a folder of its own, with a limit of time.
//!
//! What it prints goes to files. The file of stdout is locked, and the lock belongs to whoever has the file open: to this
//! process, to the solver and to what that has started. So a folder in which something still writes, left of a process
//! that was killed, is never taken for another run.

use std::fs::{self, File, TryLockError};
use std::io::{self, Read as _, Seek as _, SeekFrom};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// The file with what a run prints.
pub const STDOUT: &str = "stdout.txt";

/// The file with what it says of itself.
pub const STDERR: &str = "stderr.txt";

/// What is run, and how.
pub struct Order<'a> {
    /// The program, and its arguments.
    pub words: &'a [String],
    /// Where.
    pub directory: &'a Path,
    /// Variables of its environment.
    pub variables: &'a [(&'a str, String)],
    /// How long it may take.
    pub limit: Duration,
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ended {
    /// As it should.
    Well,
    /// Otherwise, and how.
    Badly(String),
    /// Somebody wanted it to end.
    Interrupted,
}

/// A folder that nobody else writes to.
pub struct Folder {
    /// Where it is.
    pub path: PathBuf,
    stdout: File,
}

impl Folder {
    /// The first of the folders `1`, `2`, .. below another one in which no process is at work; emptied.
    ///
    /// # Errors
    /// It cannot be made or emptied.
    pub fn free(parent: &Path) -> io::Result<Self> {
        for number in 1.. {
            let path = parent.join(number.to_string());
            fs::create_dir_all(&path)?;
            let stdout = File::options().create(true).append(true).open(path.join(STDOUT))?;
            match stdout.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => continue,
                Err(TryLockError::Error(error)) => return Err(error),
            }
            empty(&path)?;
            stdout.set_len(0)?;
            return Ok(Folder { path, stdout });
        }
        Err(io::ErrorKind::AlreadyExists.into())
    }

    /// Runs something; what it prints is kept here.
    ///
    /// # Errors
    /// The files for it cannot be written, or nothing can be said of the process.
    pub fn run(&self, order: &Order<'_>, stop: &dyn Fn() -> bool) -> io::Result<Ended> {
        let [program, arguments @ ..] = order.words else {
            return Ok(Ended::Badly("no command".into()));
        };
        let mut command = Command::new(named(program, order.directory));
        command.args(arguments).current_dir(order.directory).stdin(Stdio::null());
        command.envs(order.variables.iter().map(|(name, value)| (name, value)));
        command.stdout(self.stdout.try_clone()?).stderr(File::create(self.path.join(STDERR))?);
        alone(&mut command);
        match command.spawn() {
            Ok(child) => wait(child, order.limit, stop),
            Err(error) => Ok(Ended::Badly(format!(
                "`{program}` cannot be started in `{}`: {error}",
                order.directory.display()
            ))),
        }
    }

    /// The last lines of what it said of itself, or else of what it printed.
    pub fn last_words(&self) -> Vec<String> {
        let of = |name: &str| last_lines(&self.path.join(name)).unwrap_or_default();
        let said = of(STDERR);
        if said.is_empty() { of(STDOUT) } else { said }
    }
}

/// A program that is named by a path has it from the folder that it is run in; another one is looked for.
fn named(program: &str, directory: &Path) -> PathBuf {
    let path = Path::new(program);
    if path.components().count() > 1 { directory.join(path) } else { path.to_owned() }
}

/// Removes all of a folder but the file of stdout.
fn empty(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_name() == STDOUT {
            continue;
        }
        match entry.file_type()?.is_dir() {
            true => fs::remove_dir_all(entry.path())?,
            false => fs::remove_file(entry.path())?,
        }
    }
    Ok(())
}

/// How often it is looked whether a run has ended, at most and at least.
const PAUSES: [Duration; 2] = [Duration::from_millis(1), Duration::from_millis(50)];

/// How long a process has to end by itself when it is asked to.
const GRACE: Duration = Duration::from_secs(2);

fn wait(mut child: Child, limit: Duration, stop: &dyn Fn() -> bool) -> io::Result<Ended> {
    let (started, mut pause) = (Instant::now(), PAUSES[0]);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(ended(status));
        }
        if stop() {
            end(&mut child)?;
            return Ok(Ended::Interrupted);
        }
        let left = limit.saturating_sub(started.elapsed());
        if left.is_zero() {
            end(&mut child)?;
            return Ok(Ended::Badly(format!(
                "stopped after {} s, its limit (`time_limit`)",
                limit.as_secs_f64()
            )));
        }
        sleep(pause.min(left));
        pause = (pause * 2).min(PAUSES[1]);
    }
}

fn ended(status: ExitStatus) -> Ended {
    if status.success() {
        return Ended::Well;
    }
    Ended::Badly(match status.code() {
        Some(code) => format!("it ended with exit code {code}"),
        None => format!("it was ended: {status}"),
    })
}

/// Ends a process and what it has started: first it is asked to, as programs that have started others need it.
fn end(child: &mut Child) -> io::Result<()> {
    signal(child, false);
    let asked = Instant::now();
    while asked.elapsed() < GRACE && child.try_wait()?.is_none() {
        sleep(PAUSES[1]);
    }
    signal(child, true);
    child.wait().map(drop)
}

/// Puts a process into a group of its own.
#[cfg(unix)]
fn alone(command: &mut Command) {
    use std::os::unix::process::CommandExt as _;
    command.process_group(0);
}

#[cfg(not(unix))]
fn alone(_: &mut Command) {}

/// Asks the group of a process to end, or ends it.
#[cfg(unix)]
fn signal(child: &mut Child, at_once: bool) {
    use nix::sys::signal::{Signal, killpg};
    let signal = if at_once { Signal::SIGKILL } else { Signal::SIGTERM };
    if let Ok(group) = i32::try_from(child.id()) {
        // Who has ended already needs no signal.
        let _ = killpg(nix::unistd::Pid::from_raw(group), signal);
    }
}

#[cfg(not(unix))]
fn signal(child: &mut Child, _: bool) {
    let _ = child.kill();
}

/// So much of the end of a file is looked at.
const BYTES: u64 = 4096;

/// So many lines of it are told.
const LINES: usize = 8;

fn last_lines(path: &Path) -> io::Result<Vec<String>> {
    let mut file = File::open(path)?;
    let length = file.metadata()?.len();
    file.seek(SeekFrom::Start(length.saturating_sub(BYTES)))?;
    let mut bytes = Vec::new();
    file.take(BYTES).read_to_end(&mut bytes)?;
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
    let first = lines.len().saturating_sub(LINES);
    Ok(lines[first..].iter().map(|line| (*line).to_owned()).collect())
}
