//! What a particle costs in a step: `cargo bench --bench runtime`, with `-- --json` for a program.
//!
//! An elastic block with 2 particles per cell and axis is let go from a deformed state, without output; a
//! row of its own adds the field's forcing and walls. The thread is pinned, cases take turns, round by round, and the
//! least time counts, for nothing makes a machine faster than it is. The floor is what the multiply-adds
//! alone take at the rate that was measured in the same run; see [`roof`].

mod block;
mod roof;

use std::hint::black_box;
use std::time::Instant;

use block::{Block, Body};
use mms::scene::Scene;
use mms_runtime::integrator::Leapfrog;
use mms_runtime::shape::{Cpdi, Cpgimp, Linear, QuadraticBspline, Shape, Ugimp};
use mms_runtime::{Division, FormulationName, ManufacturedField, Real, Setup, Solver, Transfer};
use roof::{Count, Roof};
use serde_json::json;

/// How often every case takes a turn.
const ROUNDS: usize = 7;

/// Particles of every case, about.
const PARTICLES: usize = 250_000;

/// A case in one precision, with a number of threads.
struct Row {
    case: &'static str,
    precision: &'static str,
    threads: usize,
    bytes: usize,
    /// What a particle takes at least, if that was counted.
    count: Option<Count>,
    turn: Box<dyn FnMut() -> f64>,
    /// The least yet.
    nanoseconds: f64,
}

/// Advances by some steps. The time of a particle in a step, in nanoseconds.
fn turn<T, const D: usize, F, S>(solver: &mut Solver<'_, T, D, F, S>, steps: usize) -> f64
where
    T: Real,
    F: ManufacturedField<T, D> + ?Sized,
    S: Shape,
{
    let start = Instant::now();
    for _ in 0..steps {
        if let Err(failure) = solver.step::<Leapfrog>() {
            panic!("the block broke: {failure}");
        }
    }
    let particles = black_box(solver.particles().len());
    1e9 * start.elapsed().as_secs_f64() / (steps * particles) as f64
}

/// A row of one shape function and transfer.
fn row<T, const D: usize, S>(
    case: &'static str,
    body: &Body,
    transfer: Transfer,
    threads: usize,
    count: Option<Count>,
) -> Row
where
    T: Real,
    S: Shape,
    Scene<T>: block::Of<T, D>,
{
    // It lives as long as the program.
    let block: &'static Block<T, D> = Box::leak(Box::new(Block::new(body)));
    let along = (PARTICLES as f64).powf(1.0 / D as f64) / 2.0;
    let setup = Setup { transfer, threads, courant: 0.2, ..Setup::default() };
    let cells = Division::Uniform(along.round() as usize);
    let solver =
        Solver::<T, D, Block<T, D>, S>::new(block, FormulationName::Updated, &setup, &cells);
    let mut solver = solver.unwrap_or_else(|refusal| panic!("{case}: {refusal}"));
    let bytes = solver.particles().bytes_per_particle();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.unwrap_or_else(|error| panic!("{threads} threads: {error}"));
    pool.install(|| turn(&mut solver, 2));
    let turn = move || match threads {
        1 => turn(&mut solver, 4),
        _ => pool.install(|| turn(&mut solver, 4)),
    };
    Row {
        case,
        precision: if size_of::<T>() == 4 { "f32" } else { "f64" },
        threads,
        bytes,
        count,
        turn: Box::new(turn),
        nanoseconds: f64::INFINITY,
    }
}

/// Both precisions of a case.
fn pair<const D: usize, S: Shape>(
    case: &'static str,
    body: &Body,
    transfer: Transfer,
    count: Option<Count>,
) -> [Row; 2]
where
    Scene<f32>: block::Of<f32, D>,
    Scene<f64>: block::Of<f64, D>,
{
    [
        row::<f64, D, S>(case, body, transfer, 1, count),
        row::<f32, D, S>(case, body, transfer, 1, count),
    ]
}

fn rows() -> Vec<Row> {
    let (flip, apic) = (Transfer::FLIP, Transfer::Apic);
    let (plane, space) = (Body::free("axis_aligned_2d"), Body::free("axis_aligned_3d"));
    let forced = Body { forced: true, ..space };
    let mut rows = Vec::new();
    rows.extend(pair::<3, QuadraticBspline>(
        "3d_quadratic_apic",
        &space,
        apic,
        Some(Count::apic(3, 3)),
    ));
    rows.extend(pair::<3, Linear>("3d_linear_flip", &space, flip, Some(Count::flip(3, 2))));
    rows.extend(pair::<3, Ugimp>("3d_ugimp_flip", &space, flip, Some(Count::flip(3, 3))));
    rows.extend(pair::<2, QuadraticBspline>(
        "2d_quadratic_apic",
        &plane,
        apic,
        Some(Count::apic(2, 3)),
    ));
    rows.extend(pair::<2, Linear>("2d_linear_flip", &plane, flip, Some(Count::flip(2, 2))));
    rows.extend(pair::<2, Ugimp>("2d_ugimp_flip", &plane, flip, Some(Count::flip(2, 3))));
    rows.extend(pair::<3, Cpgimp>("3d_cpgimp_flip", &space, flip, None));
    rows.extend(pair::<3, Cpdi>("3d_cpdi_flip", &space, flip, None));
    rows.extend(pair::<3, Ugimp>("3d_ugimp_flip_forced", &forced, flip, None));
    rows.push(row::<f64, 3, QuadraticBspline>("3d_quadratic_apic", &space, apic, 2, None));
    rows.push(row::<f64, 3, Ugimp>("3d_ugimp_flip", &space, flip, 2, None));
    rows
}

fn main() {
    let json = std::env::args().any(|argument| argument == "--json");
    roof::pin();
    let mut roofs = [Roof::of::<f64>("f64"), Roof::of::<f32>("f32")];
    let mut rows = rows();
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
