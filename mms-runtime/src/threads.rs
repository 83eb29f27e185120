//! Fork and join: runs two things at once, if there are threads for it.
//!
//! Threads are those of the pool that the caller is in ([`crate::study::run`] makes one). Results do not depend on
//! their number: what is joined is cut into the same parts whatever it is, and other parts have nothing to do with
//! each other.

/// Nodes that are worked on by one thread at a time.
const NODES: usize = 2048;

/// Both results; at the same time in a pool of more than one thread.
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

/// What can be cut in two.
pub trait Parts: Sized + Send {
    /// How much there is of it.
    fn len(&self) -> usize;
    /// So much of it from its beginning, and what is left.
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

/// As long as each other.
impl<A: Parts, B: Parts> Parts for (A, B) {
    fn len(&self) -> usize {
        self.0.len()
    }

    fn split(self, at: usize) -> [Self; 2] {
        let ([a, b], [others_of_a, others_of_b]) = (self.0.split(at), self.1.split(at));
        [(a, others_of_a), (b, others_of_b)]
    }
}

/// Does `work` for all there is, in parts of at most `size`, and joins what comes of it.
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

/// Does `work` for all there is, whose entries have nothing to do with each other: in parts of at most `size` if there
/// are threads for them.
pub fn each<P: Parts>(all: P, size: usize, work: &(dyn Fn(P) + Sync)) {
    if alone() { work(all) } else { each_part(all, size, work, &|(), ()| ()) }
}

/// Does `work` for arrays of nodes, as [`each`] does.
pub fn each_node<P: Parts>(nodes: P, work: &(dyn Fn(P) + Sync)) {
    each(nodes, NODES, work);
}
