//! The numbers of nodes and elements in files, which may have gaps and be in any order.

/// The positions of numbers.
#[derive(Default)]
pub struct Tags {
    /// The first number and the count, if each number is one more than the one before.
    run: (u64, u64),
    /// Otherwise all numbers sorted, each with its position.
    sorted: Vec<(u64, usize)>,
}

impl Tags {
    /// Collects the positions of numbers.
    ///
    /// # Errors
    /// A number that occurs twice.
    pub fn of(tags: &[u64]) -> Result<Self, u64> {
        let first = tags.first().copied().unwrap_or(0);
        if tags.iter().enumerate().all(|(at, tag)| tag.checked_sub(first) == Some(at as u64)) {
            return Ok(Tags { run: (first, tags.len() as u64), sorted: Vec::new() });
        }
        let mut sorted: Vec<(u64, usize)> =
            tags.iter().enumerate().map(|(at, tag)| (*tag, at)).collect();
        sorted.sort_unstable();
        match sorted.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            Some(pair) => Err(pair[0].0),
            None => Ok(Tags { run: (0, 0), sorted }),
        }
    }

    /// The position of a number.
    pub fn place(&self, tag: u64) -> Option<usize> {
        match tag.checked_sub(self.run.0) {
            Some(at) if at < self.run.1 => Some(at as usize),
            _ => {
                let at = self.sorted.binary_search_by_key(&tag, |it| it.0).ok()?;
                Some(self.sorted[at].1)
            }
        }
    }
}
