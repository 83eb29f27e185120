//! The mistakes that a pass excludes, in a JSON document.

use mms_diagnosis::excluded::{Excluded, VisibleSizes};
use mms_documents::campaign::ExcludedTogether;
use mms_documents::judge;

use crate::results::Exclusions;

/// The mistakes that several results exclude together.
pub struct Together {
    /// The name of each mistake, with the first results that exclude it.
    pub all: Vec<(String, Option<String>)>,
}

impl Together {
    /// Collects the mistakes of named results; `None` if no result has a list of them.
    pub fn new<'a>(of: impl Iterator<Item = (&'a str, &'a Exclusions)>) -> Option<Together> {
        let mut all: Vec<(String, Option<String>)> = Vec::new();
        for (source, exclusions) in of {
            for it in exclusions.all.iter().flatten() {
                let at = all.iter().position(|(name, _)| *name == it.name);
                let at = at.unwrap_or_else(|| {
                    all.push((it.name.clone(), None));
                    all.len() - 1
                });
                if it.is_excluded() {
                    all[at].1.get_or_insert_with(|| source.to_owned());
                }
            }
        }
        (!all.is_empty()).then_some(Together { all })
    }

    /// The list for a document.
    pub fn document(&self) -> Vec<ExcludedTogether> {
        let entry = |(name, by): &(String, Option<String>)| ExcludedTogether {
            hypothesis: name.clone(),
            by: by.clone(),
        };
        self.all.iter().map(entry).collect()
    }
}

impl Exclusions {
    /// The list for a document; `None` if the mistakes could not be run.
    pub fn document(&self) -> Option<Vec<judge::Excluded>> {
        Some(self.all.as_ref().ok()?.iter().map(document).collect())
    }
}

fn document(it: &Excluded) -> judge::Excluded {
    let (times, right, from) = match it.shown {
        VisibleSizes::Always(times) => (times, None, None),
        VisibleSizes::From { right, least } => (None, Some(right), Some(least)),
        VisibleSizes::Never(times) => (Some(times), None, None),
    };
    judge::Excluded {
        hypothesis: it.title.clone(),
        says: it.says.to_string(),
        kind: it.kind.name().to_owned(),
        excluded: it.is_excluded(),
        times,
        right,
        from,
    }
}
