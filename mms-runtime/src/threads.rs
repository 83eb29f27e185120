//! Fork and join: runs two closures at once, if there are threads for it.
//!
//! The threads belong to the caller's pool ([`crate::study::run`] makes one). Results do not depend on the number of
//! threads: if results are joined, the cuts do not depend on that number; otherwise the parts are independent of each other.

/// The number of nodes that one thread processes at a time.
const NODES: usize = 2048;

/// Runs both closures, at the same time in a pool of more than one thread.
pub fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    if alone() { (first(), second()) } else { rayon::join(first, second) }
}

/// Whether there is one thread.
fn alone() -> bool {
    rayon::current_thread_index().is_none() || rayon::current_num_threads() == 1
}

/// Data that can be cut in two.
pub trait Parts: Sized + Send {
    /// The number of entries.
    fn len(&self) -> usize;
    /// The entries before `at`, and the rest.
    fn split(self, at: usize) -> [Self; 2];
}

impl<V: Sync> Parts for &[V] {
    fn len(&self) -> usize {
        (**self).len()
    }

    fn split(self, at: usize) -> [Self; 2] {
        self.split_at(at).into()
    }
}

impl<V: Send> Parts for &mut [V] {
    fn len(&self) -> usize {
        (**self).len()
    }

    fn split(self, at: usize) -> [Self; 2] {
        self.split_at_mut(at).into()
    }
}

impl Parts for std::ops::Range<usize> {
    fn len(&self) -> usize {
        ExactSizeIterator::len(self)
    }

    fn split(self, at: usize) -> [Self; 2] {
        let middle = self.start + at;
        [self.start..middle, middle..self.end]
    }
}

/// Two data of the same length, cut at the same place.
impl<A: Parts, B: Parts> Parts for (A, B) {
    fn len(&self) -> usize {
        self.0.len()
    }

    fn split(self, at: usize) -> [Self; 2] {
        let ([a, b], [others_of_a, others_of_b]) = (self.0.split(at), self.1.split(at));
        [(a, others_of_a), (b, others_of_b)]
    }
}

/// Does `work` for all data, in parts of at most `size`, and joins the results.
pub fn each_part<P: Parts, R: Send>(
    all: P,
    size: usize,
    work: &(dyn Fn(P) -> R + Sync),
    join: &(dyn Fn(R, R) -> R + Sync),
) -> R {
    let count = all.len();
    if count <= size {
        return work(all);
    }
    let [first, others] = all.split(count / 2);
    let (first, others) =
        both(|| each_part(first, size, work, join), || each_part(others, size, work, join));
    join(first, others)
}

/// Does `work` for all data, whose entries are independent of each other: in parts of at most `size` if there are threads for
/// them.
pub fn each<P: Parts>(all: P, size: usize, work: &(dyn Fn(P) + Sync)) {
    if alone() { work(all) } else { each_part(all, size, work, &|(), ()| ()) }
}

/// Does `work` for arrays of nodes, as [`each`] does.
pub fn each_node<P: Parts>(nodes: P, work: &(dyn Fn(P) + Sync)) {
    each(nodes, NODES, work);
}
