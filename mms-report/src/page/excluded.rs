//! The mistakes that a pass excludes.

use maud::{Markup, html};
use mms_documents::judge::Excluded;

use super::mark::{number, numbers, table, words};
use crate::excluded::size;

/// The excluded mistakes, and the ones that are not excluded.
pub fn exclusions(all: &[Excluded]) -> Markup {
    let columns =
        [words("mistake"), words("excluded"), numbers("adds, over the error"), words("what it is")];
    let rows = all.iter().map(|it| {
        let word = match (it.excluded, it.right, it.from) {
            (false, ..) => "no".to_owned(),
            (true, Some(right), Some(from)) => format!("from {} on", size(right, from)),
            (true, ..) => "yes".to_owned(),
        };
        vec![
            html! { (it.hypothesis) },
            html! { (word) },
            number(it.times, |it| format!("{it:.2}")),
            html! { (it.says) },
        ]
    });
    let open = all.iter().filter(|it| !it.excluded).count();
    html! {
        details {
            summary { "Mistakes that this excludes: " (all.len() - open) " of " (all.len()) }
            (table("Mistakes", &columns, rows))
        }
    }
}
