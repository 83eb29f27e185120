//! Times a particle in a step: `cargo bench --bench runtime`, with `-- --json` for JSON, and with words to select
//! the cases whose names contain one of them: `cargo bench --bench runtime -- 3d_ugimp 2d`.
//!
//! An elastic block with 2 particles per cell and axis is released from a deformed state, without output; separate
//! rows add the field's forcing and walls. Threads are pinned, cases take turns, round by round, and the
//! least time counts, since nothing makes a machine faster than it is: CPU time for one thread,
//! wall time for more. The floor is the time of the multiply-adds alone, at the rate that was measured in the
//! same run; see [`roof`].

mod block;
mod roof;

use std::hint::black_box;
use std::time::Instant;

use block::{Block, Body};
use cpu_time::ThreadTime;
use mms_runtime::integrator::Leapfrog;
use mms_runtime::scene::Scene;
use mms_runtime::shape::{Cpdi, Cpgimp, Linear, QuadraticBspline, Shape, Ugimp};
use mms_runtime::{Division, FormulationName, ManufacturedField, Real, Setup, Solver, Transfer};
use roof::{Count, Roof};
use serde_json::json;

/// The number of turns of every case.
const ROUNDS: usize = 7;

/// The steps of a turn: a multiple of the steps between checks of the particles' order.
const STEPS: usize = 32;

/// The approximate number of particles of every case.
const PARTICLES: usize = 250_000;

/// A case in one precision, with a number of threads.
struct Row {
    case: &'static str,
    precision: &'static str,
    threads: usize,
    bytes: usize,
    /// The multiply-adds of a particle, if counted.
    count: Option<Count>,
    turn: Box<dyn FnMut() -> f64>,
    /// The least time so far.
    nanoseconds: f64,
}

/// Advances by some steps; returns the nanoseconds per particle and step.
fn turn<T, const D: usize, F>(solver: &mut Solver<'_, T, D, F>, steps: usize) -> f64
where
    T: Real,
    F: ManufacturedField<T, D> + ?Sized,
{
    let (passed, used) = (Instant::now(), ThreadTime::now());
    for _ in 0..steps {
        if let Err(failure) = solver.step::<Leapfrog>() {
            panic!("the block broke: {failure}");
        }
    }
    let alone = rayon::current_num_threads() == 1;
    let elapsed = if alone { used.elapsed() } else { passed.elapsed() };
    let particles = black_box(solver.particles().len());
    1e9 * elapsed.as_secs_f64() / (steps * particles) as f64
}

/// A row of one shape function and transfer; `None` if there are `words` and its name contains none of them.
fn row<T, const D: usize, S>(
    words: &[String],
    case: &'static str,
    body: &Body,
    transfer: Transfer,
    threads: usize,
    count: Option<Count>,
) -> Option<Row>
where
    T: Real,
    S: Shape,
    Scene<T>: block::Of<T, D>,
{
    if !words.is_empty() && !words.iter().any(|word| case.contains(word.as_str())) {
        return None;
    }
    // The block lives as long as the program.
    let block: &'static Block<T, D> = Box::leak(Box::new(Block::new(body)));
    let along = (PARTICLES as f64).powf(1.0 / D as f64) / 2.0;
    let setup = Setup { transfer, threads, courant: 0.2, ..Setup::default() };
    let cells = Division::Uniform(along.round() as usize);
    let solver =
        Solver::<T, D, Block<T, D>>::new::<S>(block, FormulationName::Updated, &setup, &cells);
    let mut solver = solver.unwrap_or_else(|refusal| panic!("{case}: {refusal}"));
    let bytes = solver.particles().bytes_per_particle();
    let pool =
        rayon::ThreadPoolBuilder::new().num_threads(threads).start_handler(roof::pin).build();
    let pool = pool.unwrap_or_else(|error| panic!("{threads} threads: {error}"));
    pool.install(|| turn(&mut solver, 2));
    let turn = move || pool.install(|| turn(&mut solver, STEPS));
    Some(Row {
        case,
        precision: if size_of::<T>() == 4 { "f32" } else { "f64" },
        threads,
        bytes,
        count,
        turn: Box::new(turn),
        nanoseconds: f64::INFINITY,
    })
}

/// The rows of a case in both precisions.
fn pair<const D: usize, S: Shape>(
    words: &[String],
    case: &'static str,
    body: &Body,
    transfer: Transfer,
    count: Option<Count>,
) -> impl Iterator<Item = Row>
where
    Scene<f32>: block::Of<f32, D>,
    Scene<f64>: block::Of<f64, D>,
{
    let double = row::<f64, D, S>(words, case, body, transfer, 1, count);
    let single = row::<f32, D, S>(words, case, body, transfer, 1, count);
    double.into_iter().chain(single)
}

fn rows(words: &[String]) -> Vec<Row> {
    let (flip, apic) = (Transfer::FLIP, Transfer::Apic);
    let (plane, space) = (Body::free("axis_aligned_2d"), Body::free("axis_aligned_3d"));
    let forced = Body { forced: true, ..space };
    let flips = |axes: usize, width: usize| Some(Count::flip(axes, width));
    let apics = |axes: usize| Some(Count::apic(axes, 3));
    let mut rows = Vec::new();
    let (quadratic, linear, ugimp) = ("3d_quadratic_apic", "3d_linear_flip", "3d_ugimp_flip");
    rows.extend(pair::<3, QuadraticBspline>(words, quadratic, &space, apic, apics(3)));
    rows.extend(pair::<3, Linear>(words, linear, &space, flip, flips(3, 2)));
    rows.extend(pair::<3, Ugimp>(words, ugimp, &space, flip, flips(3, 3)));
    rows.extend(pair::<2, QuadraticBspline>(words, "2d_quadratic_apic", &plane, apic, apics(2)));
    rows.extend(pair::<2, Linear>(words, "2d_linear_flip", &plane, flip, flips(2, 2)));
    rows.extend(pair::<2, Ugimp>(words, "2d_ugimp_flip", &plane, flip, flips(2, 3)));
    rows.extend(pair::<3, Cpgimp>(words, "3d_cpgimp_flip", &space, flip, None));
    rows.extend(pair::<3, Cpdi>(words, "3d_cpdi_flip", &space, flip, None));
    rows.extend(pair::<3, Ugimp>(words, "3d_ugimp_flip_forced", &forced, flip, None));
    rows.extend(row::<f64, 3, QuadraticBspline>(words, quadratic, &space, apic, 2, None));
    rows.extend(row::<f64, 3, Ugimp>(words, ugimp, &space, flip, 2, None));
    rows
}

fn main() {
    let (options, words): (Vec<_>, Vec<_>) =
        std::env::args().skip(1).partition(|argument| argument.starts_with("--"));
    let json = options.iter().any(|option| option == "--json");
    roof::pin(0);
    let mut roofs = [Roof::of::<f64>("f64"), Roof::of::<f32>("f32")];
    let mut rows = rows(&words);
    for _ in 0..ROUNDS {
        roofs.iter_mut().for_each(Roof::round);
        for row in &mut rows {
            row.nanoseconds = row.nanoseconds.min((row.turn)());
        }
    }
    let floor = |row: &Row| {
        let roof = roofs.iter().find(|roof| roof.precision == row.precision)?;
        Some(roof.nanoseconds(row.count?))
    };
    if json {
        let rows: Vec<_> = rows
            .iter()
            .map(|row| {
                json!({
                    "case": row.case,
                    "precision": row.precision,
                    "threads": row.threads,
                    "ns_per_particle_step": row.nanoseconds,
                    "floor_ns": floor(row),
                    "bytes_per_particle": row.bytes,
                })
            })
            .collect();
        let roofs: Vec<_> = roofs.iter().map(Roof::document).collect();
        println!("{}", json!({ "rows": rows, "roofs": roofs }));
        return;
    }
    for roof in &roofs {
        println!("{roof}");
    }
    println!(
        "{:<24} {:<5} {:>7} {:>9} {:>9} {:>9} {:>7}",
        "case", "", "threads", "ns", "floor", "of floor", "bytes"
    );
    for row in &rows {
        let floor = floor(row);
        let number = |value: Option<f64>| value.map_or("-".into(), |value| format!("{value:.1}"));
        println!(
            "{:<24} {:<5} {:>7} {:>9.1} {:>9} {:>9} {:>7}",
            row.case,
            row.precision,
            row.threads,
            row.nanoseconds,
            number(floor),
            number(floor.map(|floor| row.nanoseconds / floor)),
            row.bytes
        );
    }
}
