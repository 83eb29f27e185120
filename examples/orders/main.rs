//! Writes docs/orders.md: the order of convergence that each method shows, and the order of theory.
//!
//! `cargo run --release --example orders > docs/orders.md` takes some minutes.

mod rows;

use std::error::Error;
use std::sync::Arc;

use mms_codegen::{Options, Selection};
use mms_exact::gallery::{self, Entry};
use mms_runtime::convergence::{ExpectedOrder, TOLERANCE};
use mms_runtime::scene::Scene;
use mms_runtime::study::{Watch, differences, judge, orders};
use mms_spec::twin::Twin;
use rows::{GROUPS, IN_TIME, InTime, Row, STANDARD};

/// The text before the tables.
const INTRODUCTION: &str = "\
# Observed orders

The orders that the solver shows on the fields of the gallery, and the orders of theory. Errors are errors
of the displacement: the largest over time of the root mean square (l2) and of the maximum (linf) over the
particles. Each order is between two neighbouring levels, from coarse to fine. The verdict of `mms study` is
against order 2; if a row gives a reason why order 2 is impossible, theory expects `fail`. The command is
`cargo run --release --example orders > docs/orders.md`.
";

/// The text before the orders in time.
const IN_TIME_TEXT: &str = "\
One grid, with ever smaller time steps. The error of the grid stays the same, so each run is compared with the
next finer one, as `mms study FIELD --refine time` does.";

/// The Courant number of the first level in time; each further level halves it.
const COARSEST: f64 = 0.4;

/// The number of equal parts of the time window at whose ends runs are compared.
const PARTS: usize = 16;

/// Levels in time.
const LEVELS_IN_TIME: usize = 5;

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
    println!("## In time\n\n{IN_TIME_TEXT}\n");
    println!(
        "| field | method | cells | steps | difference in l2, finest | orders in l2 | formal order | |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for row in IN_TIME {
        eprintln!("{} {}", row.field, row.method);
        println!("{}", line_in_time(row)?);
    }
    print!("\n{}", include_str!("usual.md"));
    Ok(())
}

/// A row of a table.
fn line(row: &Row) -> Result<String, Box<dyn Error>> {
    let entry = gallery::find(row.field).ok_or("no such field")?;
    let scene = scene(entry, row.twin)?;
    let mut levels = Vec::new();
    for &cells in row.levels {
        levels.push(scene.run_level(&row.method()?, &cells.into(), &mut ())?);
    }
    let judgement = judge(&levels, ExpectedOrder::new(2.0, TOLERANCE.max(row.tolerance)));
    let finest = levels.last().and_then(|level| level.errors.as_ref().ok());
    let observed = |norm: fn(&mms_runtime::study::ObservedOrders) -> Option<f64>| {
        words(levels.windows(2).map(|pair| norm(&orders(&pair[0], &pair[1]))))
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
        judgement.verdict(),
        row.reason
    ))
}

/// A row of the table in time.
fn line_in_time(row: &InTime) -> Result<String, Box<dyn Error>> {
    let entry = gallery::find(row.field).ok_or("no such field")?;
    let scene = scene(entry, "")?;
    let mut method = rows::method(row.method)?;
    let mut runs = Vec::new();
    for level in 0..LEVELS_IN_TIME {
        method.setup.courant = COARSEST / f64::from(1u32 << level);
        method.setup.parts = PARTS << level;
        runs.push(scene.run(&method, &row.cells.into(), Watch::Parts(PARTS), &mut ())?);
    }
    let series = differences(&runs.iter().collect::<Vec<_>>());
    let points = series.points();
    let finest = points.last().and_then(|point| point.errors.as_ref());
    let orders = points.windows(2).map(|pair| pair[1].orders_from(&pair[0]).l2);
    let steps: Vec<_> = runs.iter().map(|run| run.level.steps.to_string()).collect();
    Ok(format!(
        "| {} | {} | {} | {} | {} | {} | {} | {} |",
        row.field,
        row.method,
        row.cells,
        steps.join(", "),
        finest.map_or("stopped".into(), |errors| format!("{:.1e}", errors.l2)),
        words(orders),
        row.order,
        row.reason
    ))
}

/// The orders as text, `-` for a missing one.
fn words(orders: impl Iterator<Item = Option<f64>>) -> String {
    let words: Vec<_> =
        orders.map(|order| order.map_or("-".into(), |order| format!("{order:.2}"))).collect();
    words.join(", ")
}

/// The field, or its rigid twin.
fn scene(entry: &'static Entry, twin: &str) -> Result<Scene<f64>, Box<dyn Error>> {
    let twin = match twin {
        "" => Twin::Nothing,
        STANDARD => Twin::Standard,
        given => Twin::Given(given.into()),
    };
    let options =
        Options { selection: Selection { twin, ..Selection::default() }, ..Options::default() };
    let compiled = entry.compile_with(&options)?;
    Ok(mms_interpreted::scene(Arc::new(compiled), &Default::default())?)
}
