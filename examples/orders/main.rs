//! Writes docs/orders.md: which order of convergence each method shows, beside what theory says.
//!
//! `cargo run --release --example orders > docs/orders.md`; some minutes.

mod rows;

use std::error::Error;
use std::sync::Arc;

use mms::gallery::{self, Entry};
use mms::scene::Scene;
use mms_codegen::twin::Twin;
use mms_codegen::{Options, Selection};
use mms_runtime::study::{TOLERANCE, judge, orders};
use rows::{GROUPS, Row, STANDARD};

/// What stands before the tables.
const INTRODUCTION: &str = "\
# Observed orders

What the solver shows on the fields of the gallery, and what theory says. Errors are those of the
displacement: the largest over time of the root mean square (l2) and of the maximum (linf) over the
particles. An order is that between two neighbouring levels, coarse to fine. The verdict is that of
`mms study` against order 2; where a row says why it cannot be, `fail` is what theory expects. Made by
`cargo run --release --example orders > docs/orders.md`.
";

fn main() -> Result<(), Box<dyn Error>> {
    println!("{INTRODUCTION}");
    for (title, text, rows) in GROUPS {
        println!("## {title}\n\n{text}\n");
        println!(
            "| field | method | cells | l2, finest | orders in l2 | orders in linf | verdict | |"
        );
        println!("|---|---|---|---|---|---|---|---|");
        for row in *rows {
            eprintln!("{} {}", row.field, row.method);
            println!("{}", line(row)?);
        }
        println!();
    }
    Ok(())
}

/// A row of a table.
fn line(row: &Row) -> Result<String, Box<dyn Error>> {
    let entry = gallery::find(row.field).ok_or("no such field")?;
    let scene = scene(entry, row)?;
    let mut levels = Vec::new();
    for &cells in row.levels {
        levels.push(scene.run_level(&row.method()?, &cells.into(), &mut ())?);
    }
    let judgement = judge(&levels, 2.0, TOLERANCE.max(row.tolerance));
    let finest = levels.last().and_then(|level| level.errors.as_ref().ok());
    let observed = |norm: fn(&mms_runtime::study::Orders) -> Option<f64>| {
        let pairs = levels.windows(2).map(|pair| norm(&orders(&pair[0], &pair[1])));
        let words: Vec<_> =
            pairs.map(|order| order.map_or("-".into(), |order| format!("{order:.2}"))).collect();
        words.join(", ")
    };
    let numbers: Vec<String> = row.levels.iter().map(usize::to_string).collect();
    Ok(format!(
        "| {}{} | {} | {} | {} | {} | {} | {} | {} |",
        row.field,
        if row.twin.is_empty() { "" } else { ", twin" },
        row.method,
        numbers.join(", "),
        finest.map_or("stopped".into(), |errors| format!("{:.1e}", errors.l2)),
        observed(|orders| orders.l2),
        observed(|orders| orders.linf),
        judgement.verdict,
        row.reason
    ))
}

/// The compiled field, or its rigid twin, interpreted.
fn scene(entry: &'static Entry, row: &Row) -> Result<Scene<f64>, Box<dyn Error>> {
    if row.twin.is_empty() {
        let compiled = entry.compile()?;
        let parameters = compiled.parameters(&Default::default());
        return (entry.double)(&parameters).ok_or_else(|| "build again".into());
    }
    let twin = if row.twin == STANDARD { Twin::Standard } else { Twin::Given(row.twin.into()) };
    let options =
        Options { selection: Selection { twin, ..Selection::default() }, ..Options::default() };
    let compiled = entry.compile_with(&options)?;
    Ok(mms::interpreted::scene(Arc::new(compiled), &Default::default()))
}
