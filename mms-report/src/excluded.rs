//! The mistakes that a pass excludes, as text.

use mms_diagnosis::excluded::{Excluded, VisibleSizes};
use mms_judge::Together;
use mms_judge::results::Exclusions;

/// The number of names that a line shows.
const SHOWN: usize = 12;

/// The number of excluded mistakes among all, and the first names of the open ones.
fn counted(excluded: usize, all: usize, open: &[String]) -> String {
    let more = open.len().saturating_sub(SHOWN);
    let names = listed(open.iter().take(SHOWN).cloned());
    let more = if more > 0 { format!(" and {more} more (--verbose)") } else { String::new() };
    let open = if open.is_empty() { String::new() } else { format!("; open: {names}{more}") };
    format!("excluded: {excluded} of {all} mistakes{open}")
}

/// The line of mistakes that several results exclude together.
pub fn counts_together(of: &Together) -> String {
    let open = of.all.iter().filter(|(_, by)| by.is_none());
    let open: Vec<String> = open.map(|(name, _)| name.clone()).collect();
    counted(of.all.len() - open.len(), of.all.len(), &open)
}

/// The line of the mistakes that a pass excludes, from some size on if they have one.
pub fn counts(exclusions: &Exclusions) -> String {
    let all = match &exclusions.all {
        Err(_) => return text(exclusions),
        Ok(all) => all,
    };
    let open = all.iter().filter(|it| !it.is_excluded());
    let open: Vec<String> = open.map(|it| it.title.clone()).collect();
    counted(all.len() - open.len(), all.len(), &open)
}

/// The lines of mistakes that several results exclude together.
pub fn together(of: &Together) -> String {
    let names = |is_excluded: bool| {
        let found = of.all.iter().filter(|(_, by)| by.is_some() == is_excluded);
        listed(found.map(|(name, _)| name.clone()))
    };
    let lines =
        [("excluded by the quantities that pass", names(true)), ("still open", names(false))];
    let lines = lines.iter().filter(|(_, names)| !names.is_empty());
    lines.map(|(head, names)| format!("{head}: {names}")).collect::<Vec<_>>().join("\n")
}

/// The head of a line, and the text of each mistake in it.
type Says = (&'static str, fn(&Excluded) -> Option<String>);

/// The lines of a text: excluded mistakes, mistakes excluded from a size on, open ones, and ones that the field does not see.
const LINES: [Says; 4] = [
    ("excluded", |it| matches!(it.shown, VisibleSizes::Always(_)).then(|| it.title.clone())),
    ("excluded from a size on", |it| match it.shown {
        VisibleSizes::From { right, least } => Some(format!("{} {}", it.title, size(right, least))),
        VisibleSizes::Always(_) | VisibleSizes::Never(_) => None,
    }),
    ("not excluded", |it| match it.shown {
        VisibleSizes::Never(times) if times > UNSEEN => {
            Some(format!("{} ({:.0} % of the error)", it.title, 100.0 * times))
        }
        _ => None,
    }),
    ("without effect on such results", |it| {
        matches!(it.shown, VisibleSizes::Never(times) if times <= UNSEEN).then(|| it.title.clone())
    }),
];

/// The size from which a mistake is excluded: for a factor, as a part of it.
pub fn size(right: f64, least: f64) -> String {
    if right == 1.0 { format!("{:.2} %", 100.0 * least) } else { format!("{least:.2e}") }
}

/// The largest part of an error that counts as none, because of rounding.
const UNSEEN: f64 = 1e-6;

/// Names separated by commas; a common subject is written once, as in `material [hencky, ogden]`.
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

/// The lines of the mistakes that a pass excludes.
pub fn text(exclusions: &Exclusions) -> String {
    let all = match &exclusions.all {
        Err(reason) => return format!("the excluded mistakes are not known: {reason}"),
        Ok(all) => all,
    };
    let line = |(head, says): &Says| {
        let names = listed(all.iter().filter_map(says));
        (!names.is_empty()).then(|| format!("  {head}: {names}"))
    };
    let mut lines =
        vec![format!("mistakes, by their error relative to the finest error, {}:", exclusions.of)];
    lines.extend(LINES.iter().filter_map(line));
    lines.join("\n")
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
