//! Deliberate mistakes, and the rows that caught them.

use maud::{Markup, html};
use mms_documents::verify::{ShownDefect, VerifyDefects};

use super::mark::{table, verdict, words};
use super::{Section, Verdicts};

/// The checks of the document, in the order of the columns.
const CHECKS: [&str; 5] = ["picture", "bounded", "symmetric", "energy", "settles"];

fn caught_by(defect: &ShownDefect) -> Vec<&str> {
    defect.rows.iter().filter(|row| row.caught).map(|row| row.name.as_str()).collect()
}

fn says(defect: &ShownDefect, check: &str) -> &'static str {
    match defect.pseudo.get(check).copied().flatten() {
        Some(true) => "objects",
        Some(false) => "content",
        None => "cannot tell",
    }
}

impl Section for VerifyDefects {
    fn title(&self) -> String {
        format!("{} deliberate mistakes", self.defects.len())
    }

    fn verdicts(&self) -> Verdicts {
        let all = self.defects.len();
        let expected = self.defects.iter().filter(|it| !caught_by(it).is_empty()).count();
        Verdicts::several(expected, all, "caught")
    }

    fn body(&self, _: &str) -> Markup {
        let mut columns = vec![words("defect"), words("in the"), words("caught by")];
        columns.extend(CHECKS.map(words));
        let rows = self.defects.iter().map(|defect| {
            let by = caught_by(defect);
            let shown = if by.is_empty() { "nothing".to_owned() } else { by.join(", ") };
            let mut cells = vec![
                html! { div.mode { (defect.name) p { (defect.what) } } },
                html! { (defect.place) },
                verdict(&shown, !by.is_empty()),
            ];
            cells.extend(CHECKS.map(|check| html! { (says(defect, check)) }));
            cells
        });
        html! {
            p {
                "Each mistake was made on purpose, and rows of the quick matrix were run with it: a verdict had to fail. "
                "The columns on the right are the results of looking at the same runs."
            }
            @for [row, defect] in &self.missed {
                p.alert { strong { (row) } " does not catch " (defect) ", although it claims to." }
            }
            @for row in &self.idle {
                p.alert { strong { (row) } " catches no defect that few other rows catch." }
            }
            (table("Deliberate mistakes and what caught them", &columns, rows))
        }
    }
}
