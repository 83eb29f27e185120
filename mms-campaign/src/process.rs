//! One run of a solver: a process in a folder of its own, with a limit of time.
//!
//! The run has a [`supervisor`](crate::supervisor), which ends it when the campaign ends for any reason. If a supervisor was
//! killed, its folder is never used again, because the run may still write there.

use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::printed::last_lines;
use crate::supervisor::{PAUSES, RUNNING, Report, STDERR, STDOUT, WORD, in_own_group};

/// A program to run, its surroundings and its limit.
pub struct Launch<'a> {
    /// The words of the supervising program, to which [`WORD`] is added.
    pub supervisor: &'a [OsString],
    /// The program, and its arguments.
    pub words: &'a [String],
    /// The working directory.
    pub directory: &'a Path,
    /// Variables of its environment.
    pub variables: &'a [(&'a str, String)],
    /// The time limit.
    pub limit: Duration,
}

/// A folder to which no other process writes.
pub struct Folder {
    /// The path of the folder.
    pub path: PathBuf,
    /// Locked, and shared with the supervisor of a run.
    running: File,
}

impl Folder {
    /// Finds the first of the folders `1`, `2`, .. in `parent` in which no run can be at work, and empties it. Waits for a
    /// supervisor that is about to end a run there. Only one caller at a time may use the same `parent`.
    ///
    /// # Errors
    /// A folder that cannot be made or emptied.
    pub fn free(parent: &Path) -> io::Result<Self> {
        for number in 1.. {
            let path = parent.join(number.to_string());
            fs::create_dir_all(&path)?;
            let running = File::options().create(true).append(true).open(path.join(RUNNING))?;
            if is_locked(&running)? && running.metadata()?.len() == 0 {
                empty(&path)?;
                return Ok(Folder { path, running });
            }
        }
        Err(io::ErrorKind::AlreadyExists.into())
    }

    /// Runs a program, and keeps its output in the folder. Ends the run if `stop` returns true.
    ///
    /// # Errors
    /// A supervisor whose state cannot be read.
    pub fn run(&self, launch: &Launch<'_>, stop: &dyn Fn() -> bool) -> io::Result<Report> {
        let [program, words @ ..] = launch.supervisor else {
            return Ok(Report::badly("no supervisor"));
        };
        let mut command = Command::new(program);
        command.args(words).arg(WORD).arg(&self.path).arg(launch.directory);
        command.arg(launch.limit.as_secs_f64().to_string()).args(launch.words);
        command.envs(launch.variables.iter().map(|(name, value)| (name, value)));
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(self.running.try_clone()?);
        in_own_group(&mut command);
        match command.spawn() {
            Ok(supervisor) => followed(supervisor, stop),
            Err(error) => Ok(Report::badly(format!("its supervisor cannot be started: {error}"))),
        }
    }

    /// The last lines of its stderr, or, if that is empty, of its stdout.
    pub fn last_words(&self) -> Vec<String> {
        let of = |name: &str| last_lines(&self.path.join(name)).unwrap_or_default();
        let said = of(STDERR);
        if said.is_empty() { of(STDOUT) } else { said }
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if self.running.metadata().is_ok_and(|it| it.len() == 0) {
            let _ = fs::remove_file(self.path.join(RUNNING));
        }
    }
}

/// Waits for the report of a supervisor. Closing its stdin ends the run.
fn followed(mut supervisor: Child, stop: &dyn Fn() -> bool) -> io::Result<Report> {
    let (mut stdin, mut pause) = (supervisor.stdin.take(), PAUSES[0]);
    let status = loop {
        if let Some(status) = supervisor.try_wait()? {
            break status;
        }
        if stop() {
            stdin = None;
        }
        sleep(pause);
        pause = (pause * 2).min(PAUSES[1]);
    };
    drop(stdin);
    let mut told = String::new();
    if let Some(mut stdout) = supervisor.stdout {
        stdout.read_to_string(&mut told)?;
    }
    Ok(Report::parse(&told).unwrap_or_else(|| {
        Report::badly(format!("its supervisor ended first: {status}; the run may continue"))
    }))
}

/// The longest wait for a supervisor whose campaign has ended.
const PATIENCE: Duration = Duration::from_secs(60);

/// Tries for a while to lock a file; returns whether it is locked.
fn is_locked(file: &File) -> io::Result<bool> {
    let started = Instant::now();
    loop {
        match file.try_lock() {
            Ok(()) => return Ok(true),
            Err(TryLockError::WouldBlock) if started.elapsed() < PATIENCE => sleep(PAUSES[1]),
            Err(TryLockError::WouldBlock) => return Ok(false),
            Err(TryLockError::Error(error)) => return Err(error),
        }
    }
}

/// Removes everything in a folder except the locked file.
fn empty(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_name() == RUNNING {
            continue;
        }
        match entry.file_type()?.is_dir() {
            true => fs::remove_dir_all(entry.path())?,
            false => fs::remove_file(entry.path())?,
        }
    }
    Ok(())
}
