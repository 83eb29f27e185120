//! Motions with a known state: uniform F(t), rotation, and free vibration.

use crate::common::{Affine, levels, method, methods, spin::Spin, wave::Wave};
use mms_runtime::study::{Details, Watch};
use mms_runtime::{
    AnySolver, FormulationName, IntegratorName, ManufacturedField, Method, Setup, ShapeName, Solve,
};

/// The measurements of a run that reaches its end.
fn details<const D: usize>(
    field: &dyn ManufacturedField<f64, D>,
    method: &Method,
    cells: usize,
) -> Details
where
    f64: Solve<D>,
{
    let run = f64::run(field, method, &cells.into(), Watch::Everything, &mut ()).unwrap();
    run.details.unwrap_or_else(|| panic!("{method:?}: {:?}", run.level.errors))
}

const STRETCH: [[f64; 3]; 3] = [[0.3, 0.0, 0.0], [0.0, -0.2, 0.0], [0.0, 0.0, 0.1]];
const SHEAR: [[f64; 3]; 3] = [[0.3, 0.4, 0.0], [-0.1, -0.2, 0.1], [0.0, 0.0, 0.1]];

/// x = (I + t H1) X: velocities that are constant in time and linear in X. In the reference configuration hat functions
/// represent them, particles are symmetric about nodes, and every integrator is exact.
fn uniform_rates<const D: usize>()
where
    f64: Solve<D>,
{
    for rate in [STRETCH, SHEAR] {
        let field = Affine { h1: rate, ..Affine::patch(0.0) };
        for method in methods() {
            let hats = [ShapeName::Linear, ShapeName::Ugimp].contains(&method.shape);
            if method.formulation == FormulationName::Total && hats {
                let errors = details::<D>(&field, &method, 4).largest;
                for errors in [
                    errors.displacement,
                    errors.velocity,
                    errors.deformation_gradient,
                    errors.first_piola_kirchhoff,
                ] {
                    // About 20 steps, each with sums over the nodes.
                    assert!(errors.linf < 1e3 * f64::EPSILON, "{method:?}: {errors:?}");
                }
            }
        }
    }
}

#[test]
fn uniform_rates_of_deformation_are_exact_in_the_total_formulation() {
    uniform_rates::<1>();
    uniform_rates::<2>();
    uniform_rates::<3>();
}

/// In the updated formulation, particles are not symmetric about nodes, so that the grid's velocity has an error of O(h).
/// Errors are small and shrink if domains follow: boxes in a stretch, parallelepipeds in any F. The expected failure: boxes
/// leave gaps in a shear, and errors of F grow.
#[test]
fn uniform_rates_of_deformation_need_domains_that_follow() {
    let errors = |shape: ShapeName, rate: [[f64; 3]; 3]| {
        let field = Affine { h1: rate, ..Affine::patch(0.0) };
        [4, 16].map(|cells| {
            let method = method(shape, IntegratorName::Leapfrog);
            let Details { largest, .. } = details::<2>(&field, &method, cells);
            (largest.displacement.linf, largest.deformation_gradient.linf)
        })
    };
    for (shape, rate) in
        [(ShapeName::Cpgimp, STRETCH), (ShapeName::Cpdi, STRETCH), (ShapeName::Cpdi, SHEAR)]
    {
        let [coarse, fine] = errors(shape, rate);
        assert!(fine.0 < coarse.0 / 3.0 && fine.1 < coarse.1, "{shape}: {coarse:?} {fine:?}");
        assert!(fine.0 < 1e-4, "{shape}: {fine:?}");
    }
    let [coarse, fine] = errors(ShapeName::Cpgimp, SHEAR);
    assert!(fine.1 > 2.0 * coarse.1 && fine.0 > 3e-4, "{coarse:?} {fine:?}");
}

/// Half a turn without strain or stress, free on all sides: domains and particles turn with the body. The error is due to the
/// velocity's map to nodes at free faces, and large in meshes this coarse.
#[test]
fn bodies_turn() {
    let spin = Spin { frequency: 1.0, mu: 0.5, end: std::f64::consts::PI };
    for (shape, formulation) in [
        (ShapeName::Cpgimp, FormulationName::Updated),
        (ShapeName::Cpdi, FormulationName::Updated),
        (ShapeName::CubicBspline, FormulationName::Updated),
        (ShapeName::Linear, FormulationName::Total),
        (ShapeName::QuadraticBspline, FormulationName::Total),
    ] {
        let method = Method { formulation, ..method(shape, IntegratorName::Leapfrog) };
        let levels = levels::<f64, 2>(&spin, &method, &[8, 16]);
        let errors = [0, 1].map(|k| levels[k].errors.as_ref().unwrap().linf);
        let order = (errors[0] / errors[1]).log2();
        assert!((1.85..2.25).contains(&order), "{method:?}: {order} {errors:?}");
        assert!(errors[1] < 0.12, "of a path of 4.4: {method:?}: {errors:?}");
    }
}

/// The largest drift of kinetic plus strain energy of a wave on a ring without forcing, relative to the initial energy.
/// Velocities half a step apart are averaged.
fn energy_drift(shape: ShapeName, formulation: FormulationName, cells: usize) -> f64 {
    let wave = Wave { forced: false, ..Wave::bar() };
    let field: &dyn ManufacturedField<f64, 1> = &wave;
    let setup = Setup { periodic: [true; 3], ..Setup::default() };
    let method = Method { shape, formulation, setup, ..Method::default() };
    let mut solver = <f64 as Solve<1>>::solver(field, &method, &cells.into()).unwrap();
    let strain = |solver: &dyn AnySolver<f64, 1>| -> f64 {
        let particles = solver.present().particles;
        let gradients = particles.displacement_gradient.iter();
        let shares = gradients.zip(&particles.reference_volume);
        shares.map(|(h, volume)| wave.strain_energy(&h) * volume).sum()
    };
    let kinetic = |solver: &dyn AnySolver<f64, 1>| -> f64 {
        let particles = solver.present().particles;
        let shares = particles.mass.iter().zip(particles.velocity.iter());
        shares.map(|(m, v)| m * v.norm_squared() / 2.0).sum()
    };
    let start = kinetic(&*solver) + strain(&*solver);
    solver.step().unwrap();
    let mut drift = 0.0_f64;
    for _ in 1..solver.steps() {
        let (before, strained) = (kinetic(&*solver), strain(&*solver));
        solver.step().unwrap();
        let energy = (before + kinetic(&*solver)) / 2.0 + strained;
        drift = drift.max((energy / start - 1.0).abs());
    }
    drift
}

/// Maps between particles and grid lose the part that the grid does not represent, which vanishes faster than h^2 in a smooth
/// motion.
#[test]
fn energy_stays() {
    let (updated, total) = (FormulationName::Updated, FormulationName::Total);
    for (formulation, shape) in [
        (updated, ShapeName::Cpgimp),
        (updated, ShapeName::Cpdi),
        (total, ShapeName::Linear),
        (total, ShapeName::QuadraticBspline),
    ] {
        let [coarse, fine] = [32, 64].map(|cells| energy_drift(shape, formulation, cells));
        let order = (coarse / fine).log2();
        assert!(fine < 1e-3 && order > 1.9, "{shape}, {formulation}: {coarse:e} {fine:e}");
    }
}
