//! The parameters of a field, which any thread may read and change at any time. They change as a whole.
//!
//! `interleavings/` tries this file with threads in every order.

use std::sync::PoisonError;

use crate::locks::{Arc, Mutex, RwLock};

/// The parameters of a field. A set `S` has the exact values of those that were set, by position. A panic leaves no
/// change half done, so that its poison means nothing.
#[derive(Debug)]
pub struct Settings<S> {
    /// Those that were set; the others are at their defaults, which may depend on these. Locked from
    /// the look at a change until it is made: of two changes at a time, the later one starts from what the other
    /// made.
    set: Mutex<S>,
    /// All values, in the order of the file. Locked no longer than it takes to copy or exchange the pointer, so
    /// that no evaluation waits for the look at a change.
    all: RwLock<Arc<Vec<f64>>>,
}

impl<S: Clone + Default> Settings<S> {
    /// Nothing is set; these are the defaults.
    pub fn new(defaults: Vec<f64>) -> Self {
        Settings { set: Mutex::new(S::default()), all: RwLock::new(Arc::new(defaults)) }
    }

    /// All values at this moment.
    pub fn now(&self) -> Arc<Vec<f64>> {
        self.all.read().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Sets parameters, where `values` finds the values of all for what is then set. On failure nothing
    /// changes.
    pub fn change<T, E>(
        &self,
        new: S,
        values: impl FnOnce(&S) -> Result<Vec<f64>, E>,
    ) -> Result<(), E>
    where
        S: IntoIterator<Item = T> + Extend<T>,
    {
        let mut set = self.set.lock().unwrap_or_else(PoisonError::into_inner);
        let mut changed = set.clone();
        changed.extend(new);
        let all = Arc::new(values(&changed)?);
        *self.all.write().unwrap_or_else(PoisonError::into_inner) = all;
        *set = changed;
        Ok(())
    }
}
