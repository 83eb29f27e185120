//! Times b per point, and compares it with other ways to compute b: `cargo bench --bench forcing`, with
//! `-- --json` for JSON.
//!
//! Contenders take turns, round by round, so that all run under the same conditions; the median of a
//! contender's rounds counts. Errors compare the timed results with 77 digits. The floor is
//! the time of the arithmetic of a batch alone: see [`floor`].

mod dual;
mod floor;
mod hand;
mod interpreted;
mod ours;
mod peer;
mod single;

use std::error::Error;
use std::time::{Duration, Instant};

use floor::Slot;
use mms_codegen::compile;
use mms_mechanics::Output;
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_runtime::math::Scalar as _;
use mms_spec::quantity::Quantity;
use serde_json::json;

/// A field with its points.
pub struct Case {
    /// The name in reports.
    pub name: &'static str,
    /// The field file.
    pub text: &'static str,
    /// The values of the parameters.
    pub parameters: &'static [f64],
    /// The time.
    pub time: f64,
    /// The points, one column for each axis.
    pub points: Vec<Vec<f64>>,
}

/// The number of points.
const COUNT: usize = 100_000;

/// The number of points that are compared with 77 digits.
const COMPARED: usize = 1_000;

/// The number of turns of each contender.
const ROUNDS: usize = 15;

/// The time for which each contender runs untimed at the beginning of a turn, at least once. Another one has filled the
/// caches, and the processor has slept while a program ran.
const WARM: Duration = Duration::from_millis(1);

/// Runs `work` untimed, then returns the seconds of one more run.
pub fn timed(mut work: impl FnMut()) -> f64 {
    let start = Instant::now();
    work();
    while start.elapsed() < WARM {
        work();
    }
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// The results of a contender, and the times of its rounds.
pub struct Run {
    /// The name of the contender.
    pub contender: &'static str,
    /// `f64` or `f32`.
    pub precision: &'static str,
    /// `scalar`, `batch` or `cached`; `portable` rounds products by themselves.
    pub mode: &'static str,
    /// The seconds of each round.
    pub seconds: Vec<f64>,
    /// The operations at a point, if the loop was counted.
    pub slots: Option<usize>,
    /// b, one column for each component.
    pub results: Vec<Vec<f64>>,
}

/// A way to compute b that takes turns with others.
pub trait Contender {
    /// Runs one more round.
    fn round(&mut self) -> Result<(), Box<dyn Error>>;
    /// Returns the times and results.
    fn finish(self: Box<Self>) -> Run;
}

fn cases() -> Vec<Case> {
    let spread = |index: usize, step: f64| (index as f64 * step).fract();
    let column = |step: f64, from: f64, to: f64| -> Vec<f64> {
        (1..=COUNT).map(|index| from + (to - from) * spread(index, step)).collect()
    };
    // Fractional parts of multiples of irrational numbers are spread evenly (Weyl, 1916).
    let (first, second, third) =
        (0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_5);
    let (radius, angle) = (column(first, 0.75, 1.25), column(second, 0.0, core::f64::consts::TAU));
    let polar = |f: fn(f64) -> f64| radius.iter().zip(&angle).map(|(r, a)| r * f(*a)).collect();
    vec![
        Case {
            name: "A",
            text: include_str!("fields/a.toml"),
            parameters: &[1.25, 1e6, 1050.0, 0.2],
            time: 0.0123,
            points: vec![column(first, 0.0, 1.25)],
        },
        Case {
            name: "B",
            text: include_str!("fields/b.toml"),
            parameters: &[5.769e6, 3.846e6, 1000.0, 100.0, 0.05],
            time: 0.0137,
            points: [first, second, third].map(|step| column(step, 0.0, 1.0)).to_vec(),
        },
        Case {
            name: "C",
            text: include_str!("fields/c.toml"),
            parameters: &[577.0, 384.0, 1000.0],
            time: 0.35,
            points: vec![polar(f64::cos), polar(f64::sin)],
        },
    ]
}

/// b in 77 digits at the first points, component by component.
fn reference(case: &Case) -> Result<Vec<Vec<Precise>>, Box<dyn Error>> {
    let compiled = compile(case.name, "field", case.text, &|_| Err("no such file".into()))?;
    let output = Output::Quantity(Quantity::BodyForce);
    let parameters: Vec<Precise> =
        case.parameters.iter().map(|value| Precise::from_f64(*value)).collect();
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    interpreter.set_time(&Precise::from_f64(case.time));
    let plan = interpreter.plan(&[output]);
    let mut columns = vec![Vec::new(); case.points.len()];
    for index in 0..COMPARED {
        let point: Vec<Precise> =
            case.points.iter().map(|column| Precise::from_f64(column[index])).collect();
        interpreter.set_point(&plan, Point::at(&point));
        for (column, value) in columns.iter_mut().zip(interpreter.output(output)) {
            column.push(value);
        }
    }
    Ok(columns)
}

/// The median of |error| / |b|, and the greatest error over the greatest |b|, in eps.
fn errors(run: &Run, reference: &[Vec<Precise>]) -> (f64, f64) {
    let eps = if run.precision == "f32" { f64::from(f32::EPSILON) } else { f64::EPSILON };
    let (mut relative, mut greatest, mut scale) = (Vec::new(), 0.0_f64, 0.0_f64);
    for (found, expected) in run.results.iter().zip(reference) {
        for (found, expected) in found.iter().zip(expected) {
            let error = (Precise::from_f64(*found) - expected.clone()).to_f64().abs();
            let size = expected.to_f64().abs();
            relative.push(error / size / eps);
            (greatest, scale) = (greatest.max(error / eps), scale.max(size));
        }
    }
    (median(relative), greatest / scale)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() -> Result<(), Box<dyn Error>> {
    let json = std::env::args().any(|argument| argument == "--json");
    let mut rows = Vec::new();
    for case in cases() {
        let mut contenders = peer::contenders(&case)?;
        contenders.extend([hand::contender(&case), dual::contender(&case)]);
        contenders.extend(ours::contenders(&case));
        contenders.extend(interpreted::contenders(&case)?);
        let mut slots = Slot::all();
        for _ in 0..ROUNDS {
            for contender in &mut contenders {
                contender.round()?;
            }
            slots.iter_mut().for_each(Slot::round);
        }
        let runs: Vec<Run> = contenders.into_iter().map(Contender::finish).collect();
        let expected = reference(&case)?;
        let time = |run: &Run| 1e9 * median(run.seconds.clone()) / COUNT as f64;
        let floor = |run: &Run| {
            let slot = slots.iter().find(|slot| slot.precision == run.precision)?;
            Some(run.slots? as f64 * slot.nanoseconds())
        };
        let peer = runs.iter().find(|run| run.contender == peer::REFERENCE).map(time);
        for run in &runs {
            let (median_eps, max_scaled_eps) = errors(run, &expected);
            let nanoseconds = time(run);
            rows.push(json!({
                "field": case.name,
                "contender": run.contender,
                "precision": run.precision,
                "mode": run.mode,
                "ns_per_point": nanoseconds,
                "floor_ns": floor(run),
                "ratio": peer.map(|peer| peer / nanoseconds),
                "median_eps": median_eps,
                "max_scaled_eps": max_scaled_eps,
            }));
        }
    }
    if json {
        println!("{:#}", json!({ "rows": rows }));
    } else {
        print(&rows);
    }
    Ok(())
}

fn print(rows: &[serde_json::Value]) {
    let number = |value: &serde_json::Value, digits: usize| match value.as_f64() {
        Some(value) => format!("{value:.digits$}"),
        None => "-".into(),
    };
    let header = [
        "field",
        "contender",
        "precision",
        "mode",
        "ns/point",
        "floor",
        "reached",
        "ratio",
        "median eps",
        "max eps",
    ];
    let mut table = mms_report::table::TextTable::new("forcing", header);
    for row in rows {
        let text = |key: &str| row[key].as_str().unwrap_or_default().to_string();
        let reached = match (row["floor_ns"].as_f64(), row["ns_per_point"].as_f64()) {
            (Some(floor), Some(time)) => format!("{:.0} %", 100.0 * floor / time),
            _ => "-".into(),
        };
        table.add_row([
            text("field"),
            text("contender"),
            text("precision"),
            text("mode"),
            number(&row["ns_per_point"], 2),
            number(&row["floor_ns"], 2),
            reached,
            number(&row["ratio"], 1),
            number(&row["median_eps"], 2),
            number(&row["max_scaled_eps"], 1),
        ]);
    }
    println!("{table}");
    println!("\nfloor: additions and multiplications alone, none waiting for another, in ns.");
    println!("median eps: |error| / |b|. max eps: the greatest error over the greatest |b|.");
}
