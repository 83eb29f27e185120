//! The arrays to read from a file, and the memory limit.

use std::cell::Cell;

use crate::Mistake;
use crate::snapshot::GHOSTS;

/// The way in which an array is read, by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// The array is skipped, with any content.
    No,
    /// The array is skipped, but a word among numbers of a table is a mistake.
    Sound,
    /// The array is read if it contains numbers, and skipped if it contains only words.
    Numbers,
    /// The array is read, and must contain numbers.
    Must,
}

/// The selection of arrays to read from files, and the memory for them.
pub struct Wanted<'a> {
    need: Box<dyn Fn(&str) -> Need + 'a>,
    /// The remaining bytes.
    room: Cell<u64>,
    /// The advice if there is too little memory.
    advice: &'static str,
    /// The names of the columns of tables without a header.
    columns: Vec<String>,
}

impl<'a> Wanted<'a> {
    /// Selects arrays by their names, without a memory limit.
    pub fn new(need: impl Fn(&str) -> Need + 'a) -> Self {
        let (room, columns) = (Cell::new(u64::MAX), Vec::new());
        Wanted { need: Box::new(need), room, advice: "", columns }
    }

    /// Limits the memory; `advice` is for messages if it is too little.
    pub fn within(self, bytes: u64, advice: &'static str) -> Self {
        Wanted { room: Cell::new(bytes), advice, ..self }
    }

    /// Names the columns of tables without a header.
    pub fn named(self, columns: &[String]) -> Self {
        Wanted { columns: columns.to_vec(), ..self }
    }

    /// The names of the columns of tables without a header; empty if they were not given.
    pub(crate) fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The remaining bytes.
    pub fn room(&self) -> u64 {
        self.room.get()
    }

    /// Whether an array of this name is needed. Marks of ghosts always are, since otherwise ghosts would count.
    pub(crate) fn need(&self, name: &str) -> Need {
        if GHOSTS.contains(&name) { Need::Must } else { (self.need)(name) }
    }

    /// Whether an array of this name is read.
    pub(crate) fn reads(&self, name: &str) -> bool {
        matches!(self.need(name), Need::Numbers | Need::Must)
    }

    /// Reserves memory for an array, and checks that as much again is free for decoding.
    ///
    /// # Errors
    /// Too little memory.
    pub(crate) fn reserve(&self, what: &str, numbers: usize) -> Result<(), Mistake> {
        let bytes = (numbers as u64).saturating_mul(8);
        let needed = bytes.saturating_mul(2);
        self.validate_room(what, needed)?;
        self.room.set(self.room.get() - bytes);
        Ok(())
    }

    /// Refuses to use more bytes than remain.
    fn validate_room(&self, what: &str, needed: u64) -> Result<(), Mistake> {
        let room = self.room.get();
        if needed <= room {
            return Ok(());
        }
        let (needed, room) = (needed.div_ceil(1_000_000), room / 1_000_000);
        Err(Mistake::new(format!(
            "{what} takes {needed} MB of memory to read, and there are {room} MB: {}",
            self.advice
        )))
    }

    /// Calls a function while bytes of a file are in memory.
    pub(crate) fn with_reserved<T>(
        &self,
        bytes: usize,
        make: impl FnOnce() -> Result<T, Mistake>,
    ) -> Result<T, Mistake> {
        let bytes = bytes as u64;
        self.validate_room("the file", bytes)?;
        self.room.set(self.room.get() - bytes);
        let made = make();
        self.room.set(self.room.get() + bytes);
        made
    }
}
