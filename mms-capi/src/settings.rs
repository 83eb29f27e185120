//! The parameters of a field, which any thread may read and change at any time. They change as a whole.
//!
//! `interleavings/` tries this file with threads in every order.

use std::sync::PoisonError;

use crate::locks::{Arc, Mutex, RwLock};

/// The parameters of a field. A set `S` has the exact values of the parameters that were set, by index. No change is half done
/// after a panic, so a poisoned lock is ignored.
#[derive(Debug)]
pub struct Settings<S> {
    /// The set parameters; the others have their defaults, which may depend on these. Locked from the check of a change until
    /// it is made: of two concurrent changes, the later one starts from the result of the other.
    set: Mutex<S>,
    /// All values, in the order of the file. Locked only while the pointer is copied or exchanged, so that no evaluation waits
    /// for the check of a change.
    all: RwLock<Arc<Vec<f64>>>,
}

impl<S: Clone + Default> Settings<S> {
    /// No parameter is set; these are the defaults.
    pub fn new(defaults: Vec<f64>) -> Self {
        Settings { set: Mutex::new(S::default()), all: RwLock::new(Arc::new(defaults)) }
    }

    /// The present values.
    pub fn now(&self) -> Arc<Vec<f64>> {
        self.all.read().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Sets parameters; `values` computes the values of all parameters from the set ones. On failure nothing changes.
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
