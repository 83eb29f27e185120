//! The mistakes that a pass excludes, as text and in a JSON document.

use mms_diagnosis::excluded::{Excluded, Shown};
use mms_documents::campaign::ExcludedTogether;
use mms_documents::judge;

use crate::judge::results::Exclusions;

/// The mistakes that several results exclude together.
pub struct Together {
    /// The name of each mistake, and which results exclude it.
    all: Vec<(String, Option<String>)>,
}

impl Together {
    /// Collects the mistakes of named results; nothing if no result has a list of them.
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

    /// The lines for a terminal.
    pub fn text(&self) -> String {
        let of = |is_excluded: bool| {
            let names = self.all.iter().filter(|(_, by)| by.is_some() == is_excluded);
            listed(names.map(|(name, _)| name.clone()))
        };
        let lines = [("excluded by what passes", of(true)), ("still open", of(false))];
        let lines = lines.iter().filter(|(_, names)| !names.is_empty());
        lines.map(|(head, names)| format!("{head}: {names}")).collect::<Vec<_>>().join("\n")
    }

    /// The list of a document.
    pub fn document(&self) -> Vec<ExcludedTogether> {
        let entry = |(name, by): &(String, Option<String>)| ExcludedTogether {
            hypothesis: name.clone(),
            by: by.clone(),
        };
        self.all.iter().map(entry).collect()
    }
}

/// The head of a line, and the text of each mistake in it.
type Says = (&'static str, fn(&Excluded) -> Option<String>);

/// The lines of a text: what is excluded, from which size on, what is not, and what the field does not see.
const LINES: [Says; 4] = [
    ("excluded", |it| matches!(it.shown, Shown::Always(_)).then(|| it.title.clone())),
    ("excluded from a size on", |it| match it.shown {
        Shown::From { right, least } => Some(format!("{} {}", it.title, size(right, least))),
        Shown::Always(_) | Shown::Never(_) => None,
    }),
    ("not excluded", |it| match it.shown {
        Shown::Never(times) if times > UNSEEN => {
            Some(format!("{} ({:.0} % of the error)", it.title, 100.0 * times))
        }
        _ => None,
    }),
    ("no error in such results", |it| {
        matches!(it.shown, Shown::Never(times) if times <= UNSEEN).then(|| it.title.clone())
    }),
];

/// The size from which a mistake is shown: of a factor as a part of it.
pub fn size(right: f64, least: f64) -> String {
    if right == 1.0 { format!("{:.2} %", 100.0 * least) } else { format!("{least:.2e}") }
}

/// The largest part of an error that counts as none, because of rounding.
const UNSEEN: f64 = 1e-6;

/// Names between commas: what they are of is said once, as in `material [hencky, ogden]`.
fn listed(names: impl IntoIterator<Item = String>) -> String {
    names.into_iter().fold(String::new(), |all, name| {
        let open = all.rfind('[').map(|at| all[..at].rsplit(", ").next().unwrap_or_default());
        match (all.strip_suffix(']'), name.split_once('['), open) {
            (Some(before), Some((of, which)), Some(last)) if of == last => {
                format!("{before}, {which}")
            }
            _ if all.is_empty() => name,
            _ => format!("{all}, {name}"),
        }
    })
}

impl Exclusions {
    /// The lines for a terminal.
    pub fn text(&self) -> String {
        let all = match &self.all {
            Err(reason) => return format!("which mistakes that excludes is not known: {reason}"),
            Ok(all) => all,
        };
        let line = |(head, says): &Says| {
            let names = listed(all.iter().filter_map(says));
            (!names.is_empty()).then(|| format!("  {head}: {names}"))
        };
        let mut lines =
            vec![format!("mistakes, by what they add to the finest error, {}:", self.of)];
        lines.extend(LINES.iter().filter_map(line));
        lines.join("\n")
    }

    /// The list of a document; nothing if the mistakes could not be run.
    pub fn document(&self) -> Option<Vec<judge::Excluded>> {
        Some(self.all.as_ref().ok()?.iter().map(document).collect())
    }
}

fn document(it: &Excluded) -> judge::Excluded {
    let (times, right, from) = match it.shown {
        Shown::Always(times) => (times, None, None),
        Shown::From { right, least } => (None, Some(right), Some(least)),
        Shown::Never(times) => (Some(times), None, None),
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

#[cfg(test)]
mod tests {
    use super::listed;

    #[test]
    fn what_names_are_of_is_said_once() {
        let names = ["a", "law [b]", "law [c]", "low [d]", "e", "law [f]"].map(String::from);
        assert_eq!(listed(names), "a, law [b, c], low [d], e, law [f]");
    }
}
