//! The verification matrix.

use maud::{Markup, html};
use serde::Deserialize;

use super::mark::{numbers, order, seconds, small, table, verdict, words};
use super::{Section, Verdicts};

/// What `mms verify` writes.
#[derive(Deserialize)]
pub struct Matrix {
    matrix: String,
    rows: Vec<Row>,
}

#[derive(Deserialize)]
struct Row {
    name: String,
    study: String,
    refined: String,
    quantity: String,
    formal_order: String,
    theory: String,
    levels: Vec<Level>,
    observed_order: Option<f64>,
    error_constant: Option<f64>,
    expected_error_constant: Option<f64>,
    verdict: String,
    expected_verdict: String,
    reason: Option<String>,
    seconds: Option<f64>,
}

#[derive(Deserialize)]
struct Level {
    order_l2: Option<f64>,
}

impl Row {
    fn is_expected(&self) -> bool {
        self.verdict == self.expected_verdict
    }

    /// What stands before the slash, and behind it.
    fn parts(&self) -> (&str, &str) {
        self.name.split_once('/').unwrap_or(("", &self.name))
    }

    fn place(&self, id: &str) -> String {
        format!("{id}-{}", self.name.replace('/', "-"))
    }
}

impl Section for Matrix {
    fn title(&self) -> String {
        format!("The {} matrix, {} modes", self.matrix, self.rows.len())
    }

    fn verdicts(&self) -> Verdicts {
        let (all, expected) =
            (self.rows.len(), self.rows.iter().filter(|row| row.is_expected()).count());
        Verdicts::several(expected, all, "as theory expects")
    }

    fn body(&self, id: &str) -> Markup {
        let groups = || self.rows.chunk_by(|a, b| a.parts().0 == b.parts().0);
        html! {
            p {
                "Each mode by the field that isolates it. Theory expects of some modes that they do not converge: "
                "what counts is whether the verdict is the expected one."
            }
            dl.matrix {
                @for group in groups() {
                    div {
                        dt { (group[0].parts().0) }
                        @for row in group {
                            dd { a href=(format!("#{}", row.place(id))) { (verdict(row.parts().1, row.is_expected())) } }
                        }
                    }
                }
            }
            @for row in self.rows.iter().filter(|row| !row.is_expected()) {
                p.alert {
                    strong { (row.name) } ": " (row.verdict) ", expected " (row.expected_verdict) ": "
                    (row.reason.as_deref().unwrap_or("no reason is given")) ". " code { "mms study " (row.study) }
                }
            }
            @for group in groups() { (rows(group, id)) }
        }
    }
}

fn rows(group: &[Row], id: &str) -> Markup {
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
        // That of the finest pair is the one beside it.
        let before = row.levels.len().checked_sub(2).and_then(|at| row.levels[at].order_l2);
        vec![
            html! {
                div.mode id=(row.place(id)) {
                    (row.parts().1)
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
            verdict(&row.verdict, row.is_expected()),
            seconds(row.seconds),
        ]
    });
    table(&format!("Modes of {}", group[0].parts().0), &columns, cells)
}
