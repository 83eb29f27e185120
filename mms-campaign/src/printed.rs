//! Files with the output of a run. Each has a limit: it keeps the beginning and the end.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{self, Read, Seek as _, SeekFrom, Write as _};
use std::path::Path;

/// The bytes of the beginning that a file keeps.
pub const HEAD: u64 = 16 << 20;

/// The bytes of the end that a file keeps.
pub const TAIL: usize = 64 << 10;

/// Copies to a file until all writers have ended: the first `HEAD` bytes, the last `TAIL` bytes, and between them the number of
/// bytes left out.
///
/// # Errors
/// A file that cannot be written. All input is read nevertheless: a run must not wait for a full disk.
pub fn keep(mut from: impl Read, path: &Path) -> io::Result<()> {
    let mut file = File::create(path);
    let mut room = HEAD;
    let (mut tail, mut left_out) = (VecDeque::new(), 0_u64);
    let mut buffer = vec![0; TAIL];
    loop {
        let bytes = match from.read(&mut buffer) {
            Ok(0) => break,
            Ok(count) => &buffer[..count],
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(_) => break,
        };
        let (head, rest) = bytes.split_at(room.min(bytes.len() as u64) as usize);
        room -= head.len() as u64;
        file = file.and_then(|mut file| file.write_all(head).map(|()| file));
        tail.extend(rest);
        let surplus = tail.len().saturating_sub(TAIL);
        tail.drain(..surplus);
        left_out += surplus as u64;
    }
    let mut file = file?;
    if left_out > 0 {
        write!(file, "\n[{left_out} bytes are left out here]\n")?;
    }
    file.write_all(tail.make_contiguous())
}

/// The bytes at the end of a file that are searched for its last lines.
const BYTES: u64 = 4096;

/// The most lines that are returned.
const LINES: usize = 8;

/// The last lines of a file.
///
/// # Errors
/// A file that cannot be read.
pub fn last_lines(path: &Path) -> io::Result<Vec<String>> {
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
