//! The surface impedance against closed forms and against the equation that defines it.

use crate::support::{neo_hookean, zero};
use mms_stability::elasticity::{Elasticity, unit};
use mms_stability::impedance::Impedance;
use nalgebra::{Complex, Matrix2, SMatrix, SVector};

/// The least eigenvalue for waves along X on a half space below Y = 0.
fn least(elasticity: &Elasticity<2>) -> f64 {
    let impedance = Impedance::new(elasticity, &unit(1), &unit(0)).expect("strongly elliptic");
    impedance.least_eigenvalue(&[unit(0), unit(1)])
}

/// A minus rho c^2 m m I: the elasticity for a wave that runs along m at speed c.
fn moving(elasticity: &Elasticity<2>, inertia: f64) -> Elasticity<2> {
    Elasticity::from_fn(|[i, j, k, l]| {
        let runs = i == k && (j, l) == (0, 0);
        elasticity.at([i, j, k, l]) - if runs { inertia } else { 0.0 }
    })
}

/// Rayleigh, Proc. London Math. Soc. 17, 1885: with x = (c/c_s)^2 and y = (c_s/c_p)^2 the speed c of waves on a free
/// surface solves x^3 - 8 x^2 + (24 - 16 y) x - 16 (1 - y) = 0.
#[test]
fn free_surfaces_carry_waves_of_the_speed_of_rayleigh() {
    for nu in [0.0, 0.1, 0.25, 0.3, 0.4, 0.49] {
        let (mu, y) = (3.0, (1.0 - 2.0 * nu) / (2.0 - 2.0 * nu));
        let lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu);
        let rest = neo_hookean(&Matrix2::identity(), 1.0, [lambda, mu]);
        let polynomial =
            |x: f64| x.powi(3) - 8.0 * x * x + (24.0 - 16.0 * y) * x - 16.0 * (1.0 - y);
        let expected = zero(0.1, 0.999, polynomial);
        let found = zero(0.1, 0.999, |x| least(&moving(&rest, x * mu)));
        assert!((found - expected).abs() < 1e-7, "nu = {nu}: {found} {expected}");
    }
}

/// Biot, Int. J. Eng. Sci. 1, 1963: a half space of incompressible neo-Hookean matter in plane strain is unstable beyond a
/// stretch of 0.5437 along its free surface. Here it is nearly incompressible, with a bulk modulus of 1e4 mu.
#[test]
fn a_compressed_half_space_wrinkles_at_the_stretch_of_biot() {
    let (lambda, mu) = (1e4, 1.0);
    let compressed = |stretch: f64| {
        let stress =
            |across: f64| lambda * (stretch * across).ln() / across + mu * (across - 1.0 / across);
        let across = zero(0.5 / stretch, 2.0 / stretch, stress);
        let f = Matrix2::new(stretch, 0.0, 0.0, across);
        least(&neo_hookean(&f, stretch * across, [lambda, mu]))
    };
    let lost = zero(0.45, 0.65, compressed);
    assert!((lost - 0.5437).abs() < 1e-3, "{lost}");
    assert!(compressed(0.65) > 0.0 && compressed(0.45) < 0.0);
}

/// At F = s I under a pressure that follows the surface, the body is as stable as an unloaded body with the moduli mu and
/// lambda' = lambda/s^2 + (mu - lambda ln J)/s^2 - mu: the two A differ by a null Lagrangian, whose traction is the pressure's.
/// The least impedance is 2 mu (lambda' + mu)/(lambda' + 3 mu).
#[test]
fn a_pressure_that_follows_the_surface_is_no_load_on_an_isotropic_body() {
    let (lambda, mu) = (1.5, 1.0);
    for stretch in [0.8_f64, 1.0, 1.3, 1.7] {
        let volume = stretch * stretch;
        let f = Matrix2::identity() * stretch;
        let elasticity = neo_hookean(&f, volume, [lambda, mu]);
        let stress = mu * stretch - (mu - lambda * volume.ln()) / stretch;
        let q = -stress * stretch;
        let [a, b] = [unit::<2>(1) / stretch, unit::<2>(0) / stretch];
        let impedance = Impedance::new(&elasticity, &unit(1), &unit(0)).expect("elliptic");
        let found = impedance.under_pressure(q, [a, b]).least_eigenvalue(&[unit(0), unit(1)]);
        let first = (lambda + mu - lambda * volume.ln()) / volume - mu;
        let expected = 2.0 * mu * (first + mu) / (first + 3.0 * mu);
        assert!((found - expected).abs() < 1e-8, "{stretch}: {found} {expected}");
    }
}

/// A strongly elliptic A that has only its own symmetries, of numbers that do not repeat.
fn uneven<const D: usize>(seed: u64) -> Elasticity<D> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as f64 / 2f64.powi(31) - 0.5
    };
    let half: Vec<f64> = (0..D.pow(4)).map(|_| next()).collect();
    Elasticity::from_fn(|[i, j, k, l]| {
        let (row, column) = (i * D + j, k * D + l);
        let both = half[row * D * D + column] + half[column * D * D + row];
        both + if row == column { 2.0 * D as f64 } else { 0.0 }
    })
}

/// With B = T^-1 (Z - i R^T) a wave is exp(B N.X) u on the surface. Tests that B solves (Z + i R) B = Q, and decays inwards (Fu
/// & Mielke, Proc. R. Soc. A 458, 2002, equation 3.8).
fn solves_its_equation<const D: usize>(seed: u64) {
    let elasticity = uneven::<D>(seed);
    let (normal, along): (SVector<f64, D>, SVector<f64, D>) = (unit(D - 1), unit(0));
    let impedance = Impedance::new(&elasticity, &normal, &along).expect("strongly elliptic");
    let complex = |real: &SMatrix<f64, D, D>, imaginary: &SMatrix<f64, D, D>| {
        real.zip_map(imaginary, Complex::new)
    };
    let zero = SMatrix::zeros();
    let z = complex(&impedance.real, &impedance.imaginary);
    let r = elasticity.contract(&along, &normal);
    let t = complex(&elasticity.contract(&normal, &normal), &zero);
    let inward = t.try_inverse().expect("an inverse") * (z - complex(&zero, &r.transpose()));
    let rest =
        (z + complex(&zero, &r)) * inward - complex(&elasticity.contract(&along, &along), &zero);
    assert!(rest.norm() < 1e-7, "{seed}: {rest}");
    let dynamic = nalgebra::DMatrix::from_fn(D, D, |row, column| inward[(row, column)]);
    let decays = dynamic.schur().unpack().1.diagonal();
    assert!(decays.iter().all(|rate| rate.re > 0.0), "{seed}: {decays}");
}

#[test]
fn impedances_solve_their_riccati_equation() {
    for seed in 1..20 {
        solves_its_equation::<2>(seed);
        solves_its_equation::<3>(seed);
    }
}

/// The impedance of a roller is the part of Z along the face; at rest that is 4 mu (lambda + 2 mu)/(lambda + 3 mu)/2.
#[test]
fn rollers_feel_the_impedance_along_the_face() {
    let (lambda, mu) = (1.5, 1.0);
    let rest = neo_hookean(&Matrix2::identity(), 1.0, [lambda, mu]);
    let impedance = Impedance::new(&rest, &unit(1), &unit(0)).expect("elliptic");
    let found = impedance.least_eigenvalue(&[unit(0)]);
    let expected = 2.0 * mu * (lambda + 2.0 * mu) / (lambda + 3.0 * mu);
    assert!((found - expected).abs() < 1e-9, "{found} {expected}");
}
