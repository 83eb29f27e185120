//! Two things at once, if there are threads for it.
//!
//! Threads are those of the pool that the caller is in ([`crate::study::run`] makes one). Everything is cut
//! into the same parts, whatever their number: so results do not depend on it.

use crate::Real;
use crate::particle::Columns;
use crate::stencil::BUNCH;

/// Particles that are worked on by one thread at a time.
const PART: usize = 2048;

/// And bunches.
const BUNCHES: usize = PART / BUNCH;

/// Both results; at the same time in a pool of more than one thread.
pub(super) fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    let alone = rayon::current_thread_index().is_none() || rayon::current_num_threads() == 1;
    if alone { (first(), second()) } else { rayon::join(first, second) }
}

/// Does `work` for all particles, part by part, and joins what comes of it.
pub(super) fn each_part<T: Real, R: Send, const D: usize>(
    particles: Columns<'_, T, D>,
    work: &(dyn Fn(Columns<'_, T, D>) -> R + Sync),
    join: &(dyn Fn(R, R) -> R + Sync),
) -> R {
    let count = particles.len();
    if count <= BUNCHES {
        return work(particles);
    }
    let [first, others] = particles.split((count / 2).next_multiple_of(BUNCHES));
    let (first, others) = both(|| each_part(first, work, join), || each_part(others, work, join));
    join(first, others)
}
