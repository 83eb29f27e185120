//! Values that live as long as the program, each stored once, like the names in a compiler: for names from files, which are
//! copied and compared often.

use std::borrow::Borrow;
use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

/// The values of one kind.
pub struct Interner<T: ?Sized + 'static>(Mutex<BTreeSet<&'static T>>);

impl<T: ?Sized + Ord> Interner<T> {
    /// An interner without values.
    pub const fn new() -> Self {
        Interner(Mutex::new(BTreeSet::new()))
    }

    /// The one copy of a value.
    pub fn keep(&self, value: impl Borrow<T> + Into<Box<T>>) -> &'static T {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(kept) = known.get(value.borrow()) {
            return kept;
        }
        let kept: &'static T = Box::leak(value.into());
        known.insert(kept);
        kept
    }
}

/// The one copy of a text.
pub fn interned(text: &str) -> &'static str {
    static TEXTS: Interner<str> = Interner::new();
    TEXTS.keep(text)
}

#[cfg(test)]
mod tests {
    use super::interned;

    #[test]
    fn a_text_is_kept_once() {
        let kept = interned("crack_mouth");
        assert!(
            std::ptr::eq(kept, interned(&String::from("crack_mouth"))) && kept == "crack_mouth"
        );
    }
}
