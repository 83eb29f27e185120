//! One run of a solver: a process in a folder of its own, with a limit of time.
//!
//! The run has a [`supervisor`](crate::supervisor), which ends it when the campaign ends, however that does. A folder whose
//! supervisor was killed itself is never used again: something may still write there.

use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::printed::last_lines;
use crate::supervisor::{PAUSES, RUNNING, Report, STDERR, STDOUT, WORD, alone};

/// A program to run, its surroundings and its limit.
pub struct Order<'a> {
    /// The words of the program that supervises if the next one is [`WORD`].
    pub supervisor: &'a [OsString],
    /// The program, and its arguments.
    pub words: &'a [String],
    /// Where.
    pub directory: &'a Path,
    /// Variables of its environment.
    pub variables: &'a [(&'a str, String)],
    /// How long it may take.
    pub limit: Duration,
}

/// A folder that nobody else writes to.
pub struct Folder {
    /// Where it is.
    pub path: PathBuf,
    /// Locked, and shared with the supervisor of a run.
    running: File,
}

impl Folder {
    /// The first of the folders `1`, `2`, .. below another one in which nothing can be at work; emptied. A supervisor that
    /// is about to end a run there is waited for. Only one caller at a time may ask for folders below the same one.
    ///
    /// # Errors
    /// It cannot be made or emptied.
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

    /// Runs something; what it prints is kept here. If `stop` asks for it, the run is ended.
    ///
    /// # Errors
    /// Nothing can be said of the supervisor.
    pub fn run(&self, order: &Order<'_>, stop: &dyn Fn() -> bool) -> io::Result<Report> {
        let [program, words @ ..] = order.supervisor else {
            return Ok(Report::badly("no supervisor"));
        };
        let mut command = Command::new(program);
        command.args(words).arg(WORD).arg(&self.path).arg(order.directory);
        command.arg(order.limit.as_secs_f64().to_string()).args(order.words);
        command.envs(order.variables.iter().map(|(name, value)| (name, value)));
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(self.running.try_clone()?);
        alone(&mut command);
        match command.spawn() {
            Ok(supervisor) => followed(supervisor, stop),
            Err(error) => Ok(Report::badly(format!("its supervisor cannot be started: {error}"))),
        }
    }

    /// The last lines of what it said of itself, or else of what it printed.
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

/// Waits for the report of a supervisor. Without its stdin that ends the run.
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
        Report::badly(format!("its supervisor ended first: {status}; the run may go on"))
    }))
}

/// How long a supervisor whose campaign has ended is waited for.
const PATIENCE: Duration = Duration::from_secs(60);

/// Whether a file could be locked, now or soon.
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

/// Removes all of a folder but the file that is locked.
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
