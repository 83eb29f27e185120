//! Which arrays of a file are read, and how much memory they may take.

use std::cell::Cell;

use crate::Mistake;
use crate::snapshot::GHOSTS;

/// Whether an array is read, by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// It is left out, whatever it holds.
    No,
    /// It is left out. A word among numbers of a table is a mistake all the same.
    Sound,
    /// It is read if it holds numbers, and left out if it holds words alone.
    Numbers,
    /// It is read, and must hold numbers.
    Must,
}

/// The arrays that are read of files, and the memory for them.
pub struct Wanted<'a> {
    need: Box<dyn Fn(&str) -> Need + 'a>,
    /// Bytes that are left.
    room: Cell<u64>,
    /// The advice if they are too few.
    advice: &'static str,
    /// The names of the columns of tables without a header.
    columns: Vec<String>,
}

impl<'a> Wanted<'a> {
    /// Reads arrays by their names, in any memory.
    pub fn new(need: impl Fn(&str) -> Need + 'a) -> Self {
        let (room, columns) = (Cell::new(u64::MAX), Vec::new());
        Wanted { need: Box::new(need), room, advice: "", columns }
    }

    /// The same, in so many bytes; and what to do if they are too few.
    pub fn within(self, bytes: u64, advice: &'static str) -> Self {
        Wanted { room: Cell::new(bytes), advice, ..self }
    }

    /// Names the columns of tables without a header.
    pub fn named(self, columns: &[String]) -> Self {
        Wanted { columns: columns.to_vec(), ..self }
    }

    /// The names of the columns of tables without a header; none, if they were not given.
    pub(crate) fn columns(&self) -> &[String] {
        &self.columns
    }

    /// How many bytes are left.
    pub fn room(&self) -> u64 {
        self.room.get()
    }

    /// Whether an array of this name is needed. Marks of ghosts always are: without them ghosts would count.
    pub(crate) fn need(&self, name: &str) -> Need {
        if GHOSTS.contains(&name) { Need::Must } else { (self.need)(name) }
    }

    /// Whether an array of this name is read.
    pub(crate) fn reads(&self, name: &str) -> bool {
        matches!(self.need(name), Need::Numbers | Need::Must)
    }

    /// Takes room for an array, and holds as much again, in which it is decoded.
    ///
    /// # Errors
    /// There is not as much.
    pub(crate) fn take(&self, what: &str, numbers: usize) -> Result<(), Mistake> {
        let bytes = (numbers as u64).saturating_mul(8);
        let needed = bytes.saturating_mul(2);
        self.hold(what, needed)?;
        self.room.set(self.room.get() - bytes);
        Ok(())
    }

    /// Refuses what takes more bytes than are left.
    fn hold(&self, what: &str, needed: u64) -> Result<(), Mistake> {
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

    /// Makes something while so many bytes of a file are in memory.
    pub(crate) fn beside<T>(
        &self,
        bytes: usize,
        make: impl FnOnce() -> Result<T, Mistake>,
    ) -> Result<T, Mistake> {
        let bytes = bytes as u64;
        self.hold("the file", bytes)?;
        self.room.set(self.room.get() - bytes);
        let made = make();
        self.room.set(self.room.get() + bytes);
        made
    }
}
