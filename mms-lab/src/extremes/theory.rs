//! The largest stable Courant number of a method on an endless grid of cubes, full of particles at rest.
//!
//! A mode v_j = V exp(i k.x_j) of the grid gives a particle the velocity sigma_p V and the velocity gradient V (x) gamma_p,
//! with sigma_p = sum_j w_jp exp(i k.(x_j - x_p)) and gamma_p likewise of grad w. Maps to the particles and back multiply it by
//! s = mean |sigma_p|^2, and elastic forces by -omega^2, the eigenvalues of mean conj(gamma_p) C gamma_p / rho. In a step V
//! becomes r V + s dt a, with
//!
//! | transfer | r |
//! |---|---|
//! | a fraction f of FLIP, the rest PIC | f + (1 - f) s |
//! | PIC | s |
//! | XPIC of order m | 1 - (1 - s)^m |
//! | APIC, weights of degree 1 | s, where s includes the linear part of the velocity |
//!
//! A step is then a matrix of order two, in V and the mode's elastic force, and its eigenvalues are at most 1 if
//!
//! | integrator | the strain follows | (omega dt)^2 at most |
//! |---|---|---|
//! | usl, leapfrog | V + dt a | 2 (1 + r)/(1 + r - s) |
//! | usf, musl | r V + s dt a, before or after the forces | 2 (1 + r)/s |
//!
//! With s = r = 1, as on a grid without particles, both are the central difference's omega dt <= 2 (Courant,
//! Friedrichs, Lewy, Math. Ann. 100 (1928) 32-74). Von Neumann's analysis of PIC and APIC is in Bai, Schroeder, "Stability
//! analysis of explicit MPM", Comput. Graph. Forum 41 (2022), doi 10.1111/cgf.14620, who note that faces are less stable
//! than the interior: the limit measured on a body may be lower.

use mms_runtime::nalgebra::{Complex, DMatrix};
use mms_runtime::scene::Scene;
use mms_runtime::{ManufacturedField, Matrix, Method, ShapeName, Transfer, Vector};

/// The number of wave numbers from 0 to pi along an axis.
const WAVES: i32 = 8;

/// The step of the difference quotient of stresses.
const STRAIN: f64 = 1e-6;

/// A linear elastic material.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearMaterial {
    /// The dimension of space.
    pub dimension: usize,
    /// dP_ab/dH_cd at F = I over rho c0^2, the last index running first.
    pub stiffness: Vec<f64>,
}

impl LinearMaterial {
    /// The elasticity of a field's material at F = I, at a point of the body.
    pub fn of(scene: &Scene<f64>, point: &[f64]) -> Self {
        match scene {
            Scene::Line(field) => stiffness(field.as_ref(), point),
            Scene::Plane(field) => stiffness(field.as_ref(), point),
            Scene::Space(field) => stiffness(field.as_ref(), point),
        }
    }
}

fn stiffness<const D: usize>(
    field: &dyn ManufacturedField<f64, D>,
    point: &[f64],
) -> LinearMaterial {
    let point = [Vector::<f64, D>::from_column_slice(point)];
    let (mut rho, mut c0) = ([0.0], [0.0]);
    field.density(&point, &mut rho);
    field.wave_speed(&point, &mut c0);
    let stress = |gradient: Matrix<f64, D>| {
        let mut stress = [Matrix::<f64, D>::zeros()];
        field.kirchhoff_stress(field.domain().time[0], &point, &[gradient], &mut stress);
        stress[0]
    };
    let mut all = vec![0.0; D * D * D * D];
    for (c, d) in (0..D).flat_map(|c| (0..D).map(move |d| (c, d))) {
        let mut gradient = Matrix::<f64, D>::zeros();
        gradient[(c, d)] = STRAIN;
        let change =
            (stress(gradient) - stress(-gradient)) / (2.0 * STRAIN * rho[0] * c0[0] * c0[0]);
        for (a, b) in (0..D).flat_map(|a| (0..D).map(move |b| (a, b))) {
            all[((a * D + b) * D + c) * D + d] = change[(a, b)];
        }
    }
    LinearMaterial { dimension: D, stiffness: all }
}

/// The position of a node relative to the particle, w and dw/dx; cells have length 1.
type Weight = [f64; 3];

/// The weights of a particle at x, from node 0, with a domain of half the width `half`; `None` for a shape function that is not
/// implemented here.
fn weights(shape: ShapeName, x: f64, half: f64) -> Option<Vec<Weight>> {
    let hat = |x: f64| (1.0 - x.abs()).max(0.0);
    let weight = |node: f64| {
        let at = x - node;
        let [w, slope] = match shape.name() {
            "linear" => [hat(at), if at.abs() < 1.0 { -at.signum() } else { 0.0 }],
            "ugimp" | "cpgimp" => {
                [(area(at + half) - area(at - half)) / (2.0 * half), slope(hat, at, half)]
            }
            "cpdi" => [(hat(at + half) + hat(at - half)) / 2.0, slope(hat, at, half)],
            "quadratic_bspline" => quadratic(at),
            "cubic_bspline" => cubic(at),
            _ => return None,
        };
        Some([node - x, w, slope])
    };
    // Nodes of splines of even degree lie in the middle of cells.
    let first = if shape == ShapeName::QuadraticBspline { 0.5 } else { 0.0 };
    (-4..=4).map(|node| weight(f64::from(node) + first)).collect()
}

/// The difference quotient over a particle's domain.
fn slope(of: impl Fn(f64) -> f64, at: f64, half: f64) -> f64 {
    (of(at + half) - of(at - half)) / (2.0 * half)
}

/// The integral of the hat function.
fn area(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    if x < 0.0 { (1.0 + x).powi(2) / 2.0 } else { 1.0 - (1.0 - x).powi(2) / 2.0 }
}

fn quadratic(x: f64) -> [f64; 2] {
    match x.abs() {
        a if a < 0.5 => [0.75 - a * a, -2.0 * x],
        a if a < 1.5 => [(1.5 - a).powi(2) / 2.0, -x.signum() * (1.5 - a)],
        _ => [0.0, 0.0],
    }
}

fn cubic(x: f64) -> [f64; 2] {
    match x.abs() {
        a if a < 1.0 => [2.0 / 3.0 - a * a + a.powi(3) / 2.0, x.signum() * (1.5 * a * a - 2.0 * a)],
        a if a < 2.0 => [(2.0 - a).powi(3) / 6.0, -x.signum() * (2.0 - a).powi(2) / 2.0],
        _ => [0.0, 0.0],
    }
}

/// A mode at a particle, along one axis: value, slope, and sum w (x_j - x_p) exp(i k (x_j - x_p)).
type Along = [Complex<f64>; 3];

fn along(weights: &[Weight], wave: f64) -> Along {
    weights.iter().fold([Complex::new(0.0, 0.0); 3], |[value, slope, moment], [at, w, dw]| {
        let phase = Complex::new(0.0, wave * at).exp();
        [value + phase * *w, slope + phase * *dw, moment + phase * (w * at)]
    })
}

/// A mode: its factors s after maps to the particles and back, without and with the linear part of the velocity, and omega^2.
struct GridMode {
    s: f64,
    s_linear: f64,
    omega_squared: f64,
}

/// The mode of a wave, given its values along each axis at each of the particles along it.
fn mode(elasticity: &LinearMaterial, axes: &[Vec<Along>]) -> GridMode {
    let (dimension, per_axis) = (elasticity.dimension, axes[0].len());
    let count = per_axis.pow(dimension as u32);
    let part = 1.0 / count as f64;
    let zero = Complex::new(0.0, 0.0);
    let (mut s, mut s_linear) = (0.0, 0.0);
    let mut operator = DMatrix::from_element(dimension, dimension, zero);
    for particle in 0..count {
        let at: Vec<&Along> = (0..dimension)
            .map(|axis| &axes[axis][particle / per_axis.pow(axis as u32) % per_axis])
            .collect();
        let product = |axis: usize, which: usize| {
            let factors = (0..dimension).map(|a| at[a][if a == axis { which } else { 0 }]);
            factors.product::<Complex<f64>>()
        };
        let gradient: Vec<_> = (0..dimension).map(|axis| product(axis, 1)).collect();
        let value = product(dimension, 0).norm_sqr();
        let linear: f64 =
            (0..dimension).map(|axis| (product(axis, 2).conj() * gradient[axis]).re).sum();
        s += part * value;
        s_linear += part * (value + linear);
        for (index, stiffness) in elasticity.stiffness.iter().enumerate() {
            let digit = |place: u32| index / dimension.pow(place) % dimension;
            let (a, b, c, d) = (digit(3), digit(2), digit(1), digit(0));
            operator[(a, c)] += gradient[b].conj() * gradient[d] * (part * stiffness);
        }
    }
    // A + i B has the eigenvalues of [A -B; B A].
    let real = DMatrix::from_fn(2 * dimension, 2 * dimension, |row, column| {
        let entry = operator[(row % dimension, column % dimension)];
        match (row < dimension, column < dimension) {
            (true, true) | (false, false) => entry.re,
            (true, false) => -entry.im,
            (false, true) => entry.im,
        }
    });
    GridMode { s, s_linear, omega_squared: real.symmetric_eigenvalues().max() }
}

/// The largest stable Courant number of a method; none of a method that is not analysed.
pub fn courant(method: &Method, elasticity: &LinearMaterial) -> Option<f64> {
    let dimension = elasticity.dimension;
    let per_axis = method.setup.particles_per_cell.numbers();
    let particles = match *per_axis.as_slice() {
        [one] => one,
        _ => return None,
    };
    let of_splines = matches!(method.shape, ShapeName::QuadraticBspline | ShapeName::CubicBspline);
    if of_splines && method.setup.transfer == Transfer::Apic {
        return None;
    }
    let half = 0.5 / particles as f64;
    let lines: Vec<Vec<Weight>> = (0..particles)
        .map(|p| weights(method.shape, (p as f64 + 0.5) / particles as f64, half))
        .collect::<Option<_>>()?;
    let waves =
        (-WAVES..=WAVES).map(|wave| std::f64::consts::PI * f64::from(wave) / f64::from(WAVES));
    let all: Vec<Vec<Along>> =
        waves.map(|wave| lines.iter().map(|line| along(line, wave)).collect()).collect();
    let mut least = f64::INFINITY;
    for index in 0..all.len().pow(dimension as u32) {
        let axes: Vec<_> = (0..dimension)
            .map(|axis| all[index / all.len().pow(axis as u32) % all.len()].clone())
            .collect();
        let GridMode { s: kept, s_linear: kept_linear, omega_squared: squared } =
            mode(elasticity, &axes);
        let s = if method.setup.transfer == Transfer::Apic { kept_linear } else { kept };
        let r = match method.setup.transfer {
            Transfer::Flip { fraction } => fraction + (1.0 - fraction) * s,
            Transfer::Pic | Transfer::Apic => s,
            Transfer::Xpic { order } => 1.0 - (1.0 - s).powi(order as i32),
        };
        let most = match method.integrator.name() {
            "usl" | "leapfrog" => 2.0 * (1.0 + r) / (1.0 + r - s),
            "usf" | "musl" => 2.0 * (1.0 + r) / s,
            _ => return None,
        };
        // A mode without elastic forces, such as a mode that vanishes at all particles, has no limit.
        let limit = (most / squared).sqrt();
        if squared > 1e-9 && limit.is_finite() {
            least = least.min(limit);
        }
    }
    least.is_finite().then_some(least)
}

#[cfg(test)]
mod tests {
    use mms_runtime::{Division, IntegratorName, Setup};

    use super::*;

    fn bar() -> LinearMaterial {
        LinearMaterial { dimension: 1, stiffness: vec![1.0] }
    }

    fn limit(shape: ShapeName, particles: usize, setup: Setup, integrator: IntegratorName) -> f64 {
        let particles_per_cell = Division::Uniform(particles);
        let setup = Setup { particles_per_cell, ..setup };
        let method = Method { shape, integrator, setup, ..Method::default() };
        courant(&method, &bar()).unwrap()
    }

    fn close(found: f64, expected: f64) {
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} is not {expected}");
    }

    /// A wave of k = pi, which has half its amplitude at particles at 1/4 and 3/4: s = 1/4, omega = 2.
    #[test]
    fn limits_of_two_particles_per_cell_are_those_on_paper() {
        let flip = || Setup::default();
        let pic = || Setup { transfer: Transfer::Pic, ..Setup::default() };
        let apic = || Setup { transfer: Transfer::Apic, ..Setup::default() };
        use IntegratorName::{Leapfrog, Musl, Usf, Usl};
        close(limit(ShapeName::Linear, 2, flip(), Leapfrog), (4.0 / 1.75_f64).sqrt() / 2.0);
        close(limit(ShapeName::Linear, 2, flip(), Usl), (4.0 / 1.75_f64).sqrt() / 2.0);
        close(limit(ShapeName::Linear, 2, pic(), Leapfrog), 2.5_f64.sqrt() / 2.0);
        // The linear part restores a part of the mode that the value loses: s is at most 1, and so is the limit.
        assert!(limit(ShapeName::Linear, 2, apic(), Leapfrog) <= 1.0 + 1e-9);
        for integrator in [Usf, Musl] {
            let found = limit(ShapeName::Linear, 2, flip(), integrator);
            assert!(found > 1.7 && found < 2.0, "{found}");
        }
    }

    /// One particle in the middle of a cell does not see the highest mode at all.
    #[test]
    fn a_mode_that_no_particle_sees_is_the_least_stable_one() {
        close(
            limit(ShapeName::Linear, 1, Setup::default(), IntegratorName::Leapfrog),
            0.5_f64.sqrt(),
        );
    }

    #[test]
    fn weights_add_up_and_reproduce_places() {
        for &shape in ShapeName::ALL {
            for x in [0.1, 0.25, 0.5, 0.9] {
                let all = weights(shape, x, 0.25).unwrap();
                let sum = |of: &dyn Fn(&Weight) -> f64| all.iter().map(of).sum::<f64>();
                let sums = [
                    sum(&|w| w[1]) - 1.0,
                    sum(&|w| w[2]),
                    sum(&|w| w[0] * w[1]),
                    sum(&|w| w[0] * w[2]) - 1.0,
                ];
                assert!(sums.iter().all(|sum| sum.abs() < 1e-12), "{shape}, {x}: {sums:?}");
            }
        }
    }

    /// Waves along an axis are the waves of the bar.
    #[test]
    fn a_plane_without_shear_is_as_stable_as_a_bar_or_less() {
        let mut stiffness = vec![0.0; 16];
        stiffness[0] = 1.0;
        let plane = LinearMaterial { dimension: 2, stiffness };
        let method = Method { shape: ShapeName::Linear, ..Method::default() };
        let [line, plane] = [bar(), plane].map(|it| courant(&method, &it).unwrap());
        assert!(plane <= line + 1e-9 && plane > 0.9 * line, "{plane}, {line}");
    }
}
