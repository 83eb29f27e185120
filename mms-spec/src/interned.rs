//! Texts that live as long as the program, each kept once: the names that files give to faces, which are used where a
//! face is, in data that is copied.

use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

static KNOWN: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());

/// The one copy of a text.
pub fn interned(text: &str) -> &'static str {
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(kept) = known.get(text) {
        return kept;
    }
    let kept: &'static str = Box::leak(text.into());
    known.insert(kept);
    kept
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
