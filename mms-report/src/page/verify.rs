//! The verification matrix.

use maud::{Markup, html};
use mms_documents::verify::{VerifiedRow, Verify};

use super::mark::{numbers, order, seconds, small, table, verdict, words};
use super::{Section, Verdicts};

fn is_expected(row: &VerifiedRow) -> bool {
    row.verdict == row.expected_verdict
}

/// The parts of the name before and after the slash.
fn parts(row: &VerifiedRow) -> (&str, &str) {
    row.name.split_once('/').unwrap_or(("", &row.name))
}

fn place(row: &VerifiedRow, id: &str) -> String {
    format!("{id}-{}", row.name.replace('/', "-"))
}

impl Section for Verify {
    fn title(&self) -> String {
        format!("The {} matrix, {} modes", self.matrix, self.rows.len())
    }

    fn verdicts(&self) -> Verdicts {
        let (all, expected) =
            (self.rows.len(), self.rows.iter().filter(|row| is_expected(row)).count());
        Verdicts::several(expected, all, "as theory expects")
    }

    fn body(&self, id: &str) -> Markup {
        let groups = || self.rows.chunk_by(|a, b| parts(a).0 == parts(b).0);
        html! {
            p {
                "Each mode by the field that isolates it. Theory expects some modes not to converge: "
                "what counts is whether the verdict is the expected one."
            }
            dl.matrix {
                @for group in groups() {
                    div {
                        dt { (parts(&group[0]).0) }
                        @for row in group {
                            dd { a href=(format!("#{}", place(row, id))) { (verdict(parts(row).1, is_expected(row))) } }
                        }
                    }
                }
            }
            @for row in self.rows.iter().filter(|row| !is_expected(row)) {
                p.alert {
                    strong { (row.name) } ": " (row.verdict) ", expected " (row.expected_verdict) ": "
                    (row.reason.as_deref().unwrap_or("no reason is given")) ". " code { "mms study " (row.study) }
                }
            }
            @for group in groups() { (rows(group, id)) }
        }
    }
}

fn rows(group: &[VerifiedRow], id: &str) -> Markup {
    let columns = [
        words("mode"),
        words("refined"),
        words("error of"),
        numbers("formal order"),
        numbers("observed"),
        numbers("before"),
        numbers("constant"),
        numbers("expected"),
        words("verdict"),
        numbers("time"),
    ];
    let cells = group.iter().map(|row| {
        // The order of the finest pair is in the column beside it.
        let before = row.levels.len().checked_sub(2).and_then(|at| row.levels[at].errors.order_l2);
        vec![
            html! {
                div.mode id=(place(row, id)) {
                    (parts(row).1)
                    p { (row.theory) }
                    p { code { (row.study) } }
                }
            },
            html! { (row.refined) },
            html! { (row.quantity) },
            html! { (row.formal_order) },
            order(row.observed_order),
            order(before),
            small(row.error_constant),
            small(row.expected_error_constant),
            verdict(&row.verdict, is_expected(row)),
            seconds(Some(row.seconds)),
        ]
    });
    table(&format!("Modes of {}", parts(&group[0]).0), &columns, cells)
}
