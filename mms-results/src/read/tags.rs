//! The numbers by which files call nodes and elements, which may have gaps and stand in any order.

/// Where the numbers stand.
#[derive(Default)]
pub struct Tags {
    /// The first number, and how many there are, where each is one more than the one before.
    run: (u64, u64),
    /// Otherwise all numbers in order, each with its place.
    sorted: Vec<(u64, usize)>,
}

impl Tags {
    /// The places of these numbers.
    ///
    /// # Errors
    /// A number that stands there twice.
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

    /// The place of a number.
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
