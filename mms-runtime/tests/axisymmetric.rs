//! Bodies of revolution: the weights of rings against quadrature, their volumes, and a uniform pressure in equilibrium.

use mms_runtime::axisymmetric::{energy_at_own_strain, stress_at_own_strain};
use mms_runtime::column::{Matrices, PACK, Pack as _};
use mms_runtime::lattice::Axis;
use mms_runtime::material::by_packs;
use mms_runtime::scene::Scene;
use mms_runtime::shape::{Shape, Ugimp};
use mms_runtime::stencil::Stencil as _;
use mms_runtime::{
    Axisymmetric, Body, Condition, Division, Domain, Face, FormulationName, IntegratorName,
    Lattice, ManufacturedField, Material, Matrix, Method, Setup, ShapeName, Solve, Vector,
};

type Point = Vector<f64, 2>;
type Tensor = Matrix<f64, 2>;

/// A rod or a tube that is stretched equally in all directions, at rest: u = e (R, Z). Its stress is a pressure, the same
/// everywhere, so that b = 0.
#[derive(Clone)]
struct Swollen {
    stretch: f64,
    inner: f64,
}

const RHO0: f64 = 2.0;
const LAMBDA: f64 = 3.0;
const MU: f64 = 1.0;

impl Swollen {
    /// tau = lambda ln J I + mu (B - I), of F in space.
    fn stress(h: &Tensor, hoop: f64) -> (Tensor, f64) {
        let f = Tensor::identity() + h;
        let jacobian = f.determinant() * (1.0 + hoop);
        let pull = LAMBDA * jacobian.ln();
        let meridian = (f * f.transpose() - Tensor::identity()) * MU + Tensor::identity() * pull;
        (meridian, pull + MU * ((1.0 + hoop).powi(2) - 1.0))
    }
}

impl Material<f64, 2> for Swollen {
    fn density(&self, _: &[Point], density: &mut [f64]) {
        density.fill(RHO0);
    }

    fn wave_speed(&self, _: &[Point], speed: &mut [f64]) {
        speed.fill(((LAMBDA + 2.0 * MU) / RHO0).sqrt());
    }

    fn axisymmetric(&self) -> Option<&dyn Axisymmetric<f64, 2>> {
        Some(self)
    }

    fn kirchhoff_stress(&self, time: f64, x: &[Point], h: &[Tensor], stress: &mut [Tensor]) {
        by_packs(self, time, x, h, stress);
    }

    fn kirchhoff_stress_of_packs(
        &self,
        time: f64,
        x: &[[Point; PACK]],
        h: &[Matrices<f64, 2>],
        stress: &mut [Matrices<f64, 2>],
    ) {
        stress_at_own_strain(self, time, x, h, stress);
    }

    fn strain_energy(&self, time: f64, x: &[Point], h: &[Tensor], energy: &mut [f64]) -> bool {
        energy_at_own_strain(self, time, x, h, energy)
    }
}

impl Axisymmetric<f64, 2> for Swollen {
    fn hoop_strain(&self, _: f64, _: &[Point], out: &mut [f64]) {
        out.fill(self.stretch);
    }

    fn kirchhoff_stress_of_packs(
        &self,
        _: f64,
        _: &[[Point; PACK]],
        (h, hoop): (&[Matrices<f64, 2>], &[[f64; PACK]]),
        (stress, hoop_stress): (&mut [Matrices<f64, 2>], &mut [[f64; PACK]]),
    ) {
        for b in 0..h.len() {
            for k in 0..PACK {
                let (meridian, around) = Self::stress(&h[b].get(k), hoop[b][k]);
                stress[b].set(k, &meridian);
                hoop_stress[b][k] = around;
            }
        }
    }

    fn strain_energy(&self, _: f64, _: &[Point], _: (&[Tensor], &[f64]), _: &mut [f64]) -> bool {
        false
    }
}

impl ManufacturedField<f64, 2> for Swollen {
    fn domain(&self) -> Domain<f64, 2> {
        let body = Body::Box { lower: Point::new(self.inner, 0.0), upper: Point::new(1.0, 0.75) };
        let mut faces = vec![(Face::Min(1), Condition::Roller)];
        if self.inner == 0.0 {
            faces.push((Face::Min(0), Condition::Roller));
        }
        Domain { body, time: [0.0, 1.0], faces }
    }

    fn displacement(&self, _: f64, x: &[Point], out: &mut [Point]) {
        out.iter_mut().zip(x).for_each(|(u, x)| *u = x * self.stretch);
    }

    fn velocity(&self, _: f64, _: &[Point], out: &mut [Point]) {
        out.fill(Point::zeros());
    }

    fn acceleration(&self, _: f64, _: &[Point], out: &mut [Point]) {
        out.fill(Point::zeros());
    }

    fn body_force(&self, _: f64, _: &[Point], out: &mut [Point]) {
        out.fill(Point::zeros());
    }

    fn displacement_gradient(&self, _: f64, _: &[Point], out: &mut [Tensor]) {
        out.fill(Tensor::identity() * self.stretch);
    }
}

fn method(shape: ShapeName, formulation: FormulationName, particles: usize) -> Method {
    let setup = Setup { particles_per_cell: particles.into(), ..Setup::default() };
    Method { shape, formulation, integrator: IntegratorName::Usl, setup }
}

#[test]
fn a_uniform_pressure_moves_no_node_inside() {
    for (shape, formulation) in [
        (ShapeName::Linear, FormulationName::Total),
        (ShapeName::Ugimp, FormulationName::Total),
        (ShapeName::Cpgimp, FormulationName::Updated),
    ] {
        for (inner, particles) in [(0.0, 2), (0.0, 3), (0.25, 2)] {
            let field = Swollen { stretch: 0.1, inner };
            let method = method(shape, formulation, particles);
            let cells = Division::Uniform(8);
            let mut solver = f64::solver(&field, &method, &cells).expect("a solver");
            solver.step().expect("a step");
            let grid = solver.grid();
            let h = grid.lattice.cell_size[0];
            let (pressure, _) = Swollen::stress(&(Tensor::identity() * 0.1), 0.1);
            let scale = pressure[(0, 0)] * h * h;
            let size = if formulation == FormulationName::Updated { 1.1 } else { 1.0 };
            let mut seen = 0;
            for node in 0..grid.lattice.len() {
                let x = grid.lattice.position(node);
                let from = if inner == 0.0 { -0.5 * h } else { inner * size + 1.5 * h };
                let is_inside = x[0] > from
                    && x[0] < size - 1.5 * h
                    && x[1] > 1.5 * h
                    && x[1] < 0.75 * size - 1.5 * h;
                if !is_inside {
                    continue;
                }
                seen += 1;
                let force = grid.force[node].vector::<2>();
                // Nodes on the axis are constrained along R.
                let along = if x[0] < 0.5 * h { 0.0 } else { force[0] };
                assert!(
                    along.abs().max(force[1].abs()) < 1e-12 * scale,
                    "{shape} {formulation}, {particles} particles, at {x:?}: {force:?}, scale {scale:e}"
                );
            }
            assert!(seen > 8, "{seen} nodes");
        }
    }
}

#[test]
fn rings_fill_the_body() {
    for inner in [0.0, 0.25] {
        let field = Swollen { stretch: 0.0, inner };
        let volume = 0.75 * (1.0 - inner * inner) / 2.0;
        let moment = 0.75 * (1.0 - inner * inner * inner) / 3.0;
        for (shape, is_exact) in [(ShapeName::Linear, false), (ShapeName::Ugimp, true)] {
            let method = method(shape, FormulationName::Total, 2);
            let solver = f64::solver(&field, &method, &Division::Uniform(8)).expect("a solver");
            let particles = solver.present().particles;
            let sum: f64 = particles.reference_volume.iter().sum();
            assert!((sum - volume).abs() < 1e-14);
            let of = |(v, x): (&f64, &Point)| v * x[0];
            let pairs = particles.reference_volume.iter().zip(&particles.reference_position);
            let found: f64 = pairs.map(of).sum();
            // Centroids integrate R exactly, and middles do not.
            assert_eq!((found - moment).abs() < 1e-14, is_exact, "{shape}: {found} and {moment}");
        }
        let scene = Scene::Plane(Box::new(field));
        let layout = scene.layout(&Setup::default(), &Division::Uniform(8)).expect("a layout");
        assert!((layout.volume.iter().sum::<f64>() - volume).abs() < 1e-14);
    }
}

/// The nodes 1/8 apart on [-1/4, 1], with the axis at 0 or not.
fn lattice(is_meridian: bool) -> Lattice<f64, 2> {
    let axis = Axis { lower: -0.25, cell_size: 0.125, cells: 10, ends: [0, 10], body: [2.0, 8.0] };
    let lattice = Lattice::new([axis.clone(), axis], 1, [false; 2]).expect("a lattice");
    Lattice { is_meridian, ..lattice }
}

/// The integral over [from, to] of a polynomial of degree 3 between the nodes, by Simpson's rule.
fn integral(from: f64, to: f64, of: &dyn Fn(f64, f64) -> f64) -> f64 {
    let inner = (-2..9).map(|k| 0.125 * f64::from(k)).filter(|x| from < *x && *x < to);
    let ends: Vec<f64> = [from].into_iter().chain(inner).chain([to]).collect();
    let part = |ends: &[f64]| {
        let (a, b) = (ends[0], ends[1]);
        let middle = (a + b) / 2.0;
        (of(a, middle) + 4.0 * of(middle, middle) + of(b, middle)) * (b - a) / 6.0
    };
    ends.windows(2).map(part).sum()
}

#[test]
fn weights_of_rings_are_averages_over_them() {
    let lattice = lattice(true);
    // Narrow, as wide as a cell, nearly two cells wide; the last two would cross the axis.
    for (position, half_width) in [
        (0.04, 0.03),
        (0.06, 0.045),
        (0.2, 0.0625),
        (0.3, 0.06),
        (0.5, 0.11),
        (0.61, 0.124),
        (0.02, 0.03),
        (0.1, 0.1),
    ] {
        let widest = 0.75 * position;
        let l = f64::min(half_width, widest);
        let middle = (position + (position * position - 4.0 / 3.0 * l * l).sqrt()) / 2.0;
        assert!((middle + l * l / (3.0 * middle) - position).abs() < 1e-15);
        let (from, to) = (middle - l, middle + l);
        assert!(from > -1e-15);
        let stencil = Ugimp::stencil::<f64, 2>(
            &lattice,
            &Point::new(position, 0.4),
            &Point::new(half_width, 0.05),
            &Tensor::zeros(),
        );
        let stencil = stencil.expect("a stencil");
        let product = stencil.product().expect("weights along the axes");
        let around = product.around().expect("weights around the axis");
        assert!((product.radius()[0] - middle).abs() < 1e-15);
        let (mut sum, mut place) = (0.0, 0.0);
        let mut along = [[0.0; 3]; 11];
        stencil.each(0, |node, w, slope| {
            along[lattice.coordinates(node)[0]][0] += w;
            along[lattice.coordinates(node)[0]][1] += slope[0];
            sum += w;
            place += w * lattice.position(node)[0];
        });
        around.each(0, |node, w, _| along[lattice.coordinates(node)[0]][2] += w);
        assert!((sum - 1.0).abs() < 1e-14 && (place - position).abs() < 1e-14, "{sum} {place}");
        let ring = (to * to - from * from) / 2.0;
        for (node, found) in along.iter().enumerate() {
            let at = lattice.coordinate[0][node];
            let hat = |x: f64| (1.0 - (x - at).abs() / 0.125).max(0.0);
            let slope = |middle: f64| match (middle - at) / 0.125 {
                z if z.abs() > 1.0 => 0.0,
                z => -z.signum() / 0.125,
            };
            let expected = [
                integral(from, to, &|x, _| x * hat(x)) / ring,
                integral(from, to, &|x, middle| x * slope(middle)) / ring,
                integral(from, to, &|x, _| hat(x)) / ring * middle,
            ];
            for (found, expected) in found.iter().zip(expected) {
                let bound = 1e-12;
                assert!(
                    (found - expected).abs() < bound,
                    "node {node} of {position} +- {half_width}: {found}, by quadrature {expected}"
                );
            }
        }
    }
}
