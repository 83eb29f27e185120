//! A step allocates nothing, whether it sorts particles or not, and particles have the stated memory. The test has its own
//! program, since it counts the allocations of the whole process.

mod common;

use common::wave::Wave;
use mms_runtime::{
    Condition, Face, FormulationName, IntegratorName, Method, Setup, ShapeName, Solve, Transfer,
};
use peak_alloc::PeakAlloc;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Bytes that some steps allocate, at the peak and permanently.
fn allocated(
    shape: ShapeName,
    integrator: IntegratorName,
    formulation: FormulationName,
    transfer: Transfer,
) -> (usize, usize) {
    let faces = [(Face::Min(0), Condition::Traction), (Face::Max(1), Condition::Free)];
    let wave = Wave::on_box([1.0, 1.0]).with_faces(&faces);
    let setup = Setup { transfer, courant: 0.1, ..Setup::default() };
    let method = Method { shape, integrator, formulation, setup };
    let mut solver = <f64 as Solve<2>>::solver(&wave, &method, &40.into()).unwrap();
    solver.step().unwrap(); // allocates the kept data
    MEMORY.reset_peak_usage();
    let before = MEMORY.current_usage();
    for _ in 0..40 {
        solver.step().unwrap();
    }
    let seen = (MEMORY.peak_usage() - before, MEMORY.current_usage() - before);
    // Particles need the stated memory; their number is a multiple of a pack.
    let particles = solver.present().particles;
    let before = MEMORY.current_usage();
    let copy = particles.clone();
    let held = MEMORY.current_usage() - before;
    assert_eq!(held, particles.bytes_per_particle() * copy.len());
    seen
}

#[test]
fn a_step_allocates_nothing_and_particles_hold_what_they_say() {
    let (updated, total) = (FormulationName::Updated, FormulationName::Total);
    let xpic = Transfer::Xpic { order: 2 };
    let (leapfrog, musl) = (IntegratorName::Leapfrog, IntegratorName::Musl);
    for (shape, integrator, formulation, transfer) in [
        (ShapeName::Ugimp, leapfrog, updated, Transfer::FLIP),
        (ShapeName::Cpdi, musl, updated, Transfer::Apic),
        (ShapeName::QuadraticBspline, leapfrog, total, xpic),
    ] {
        assert_eq!(allocated(shape, integrator, formulation, transfer), (0, 0), "{shape}");
    }
    // The count includes memory that is allocated and freed.
    MEMORY.reset_peak_usage();
    let before = MEMORY.current_usage();
    drop(vec![0_u8; 4096]);
    assert!(MEMORY.peak_usage() >= before + 4096);
}
