//! Dynamic relaxation of fields that do not move: orders of the equilibrium, its residual by another route.

use crate::common::{Affine, AxisAligned, Bar, Last, method, methods};
use mms_runtime::study::{Observer, Run, Solve, Watch};
use mms_runtime::{
    Cause, Domain, FormulationName, IntegratorName, ManufacturedField, Material, Matrix, Method,
    Real, ShapeName, Transfer, Vector,
};

/// A field that is constantly in the state of another field at a time.
struct Still<F> {
    moving: F,
    time: f64,
}

impl<T: Real, const D: usize, F: Material<T, D>> Material<T, D> for Still<F> {
    fn density(&self, x: &[Vector<T, D>], out: &mut [T]) {
        self.moving.density(x, out);
    }

    fn wave_speed(&self, x: &[Vector<T, D>], out: &mut [T]) {
        self.moving.wave_speed(x, out);
    }

    fn kirchhoff_stress(
        &self,
        time: T,
        x: &[Vector<T, D>],
        h: &[Matrix<T, D>],
        out: &mut [Matrix<T, D>],
    ) {
        self.moving.kirchhoff_stress(time, x, h, out);
    }
}

impl<T: Real, const D: usize, F: ManufacturedField<T, D>> ManufacturedField<T, D> for Still<F> {
    fn domain(&self) -> Domain<T, D> {
        self.moving.domain()
    }

    fn displacement(&self, _: T, x: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.moving.displacement(T::of(self.time), x, out);
    }

    fn velocity(&self, _: T, _: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        out.fill(Vector::zeros());
    }

    fn acceleration(&self, _: T, _: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        out.fill(Vector::zeros());
    }

    fn body_force(&self, _: T, x: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        // b - a = - Div P/rho0
        let mut acceleration = vec![Vector::zeros(); x.len()];
        self.moving.acceleration(T::of(self.time), x, &mut acceleration);
        self.moving.body_force(T::of(self.time), x, out);
        out.iter_mut().zip(acceleration).for_each(|(b, a)| *b -= a);
    }

    fn displacement_gradient(&self, _: T, x: &[Vector<T, D>], out: &mut [Matrix<T, D>]) {
        self.moving.displacement_gradient(T::of(self.time), x, out);
    }
}

/// The bar stretched by up to 40 %, fixed at one end and free at the other.
fn bar() -> Still<Bar> {
    Still { moving: Bar::default(), time: 0.0 }
}

/// A square or a cube between rollers.
fn block() -> Still<AxisAligned> {
    Still { moving: AxisAligned { amplitude: 0.1, lower: 0.0 }, time: 0.2 }
}

fn relaxing(formulation: FormulationName, shape: ShapeName) -> Method {
    let mut method = Method { formulation, ..method(shape, IntegratorName::Leapfrog) };
    method.setup.relax = true;
    method
}

fn run<T: Solve<D>, const D: usize>(
    field: &dyn ManufacturedField<T, D>,
    method: &Method,
    cells: usize,
    observer: &mut dyn Observer,
) -> Run {
    T::run(field, method, &cells.into(), Watch::Everything, observer).unwrap()
}

/// The orders of u, F and P on the two finest grids, in l2.
fn finest_orders<T: Solve<D>, const D: usize>(
    field: &dyn ManufacturedField<T, D>,
    method: &Method,
    cells: [usize; 2],
) -> [f64; 3] {
    let runs = cells.map(|cells| run(field, method, cells, &mut ()));
    let [coarse, fine] = runs.map(|run| {
        let details = run.details.unwrap_or_else(|| panic!("{:?}", run.level.errors));
        assert!(details.residual.is_some_and(|it| it.is_small()), "{:?}", details.residual);
        assert_eq!(details.last.velocity.linf, 0.0, "the body is at rest");
        [
            details.largest.displacement.l2,
            details.largest.deformation_gradient.l2,
            details.largest.first_piola_kirchhoff.l2,
        ]
    });
    let ratio = cells[1] as f64 / cells[0] as f64;
    std::array::from_fn(|k| (coarse[k] / fine[k]).ln() / ratio.ln())
}

#[test]
fn an_equilibrium_is_of_second_order() {
    use FormulationName::{Total, Updated};
    let near = |orders: [f64; 3], least: [f64; 3]| {
        assert!(orders.iter().zip(least).all(|(it, least)| *it > least), "{orders:?}");
    };
    // F is interpolated by hat functions, and is as exact as u only in the middle of their cells.
    let linear = relaxing(Total, ShapeName::Linear);
    near(finest_orders::<f64, 1>(&bar(), &linear, [32, 64]), [1.95, 0.95, 0.95]);
    near(finest_orders::<f64, 2>(&block(), &linear, [16, 32]), [1.9, 0.95, 0.95]);
    near(finest_orders::<f64, 3>(&block(), &linear, [4, 8]), [1.8, 0.9, 0.9]);
    let spline = relaxing(Total, ShapeName::QuadraticBspline);
    // At the free end, where the spline ends, F is of first order, which reduces the order of l2 by a half.
    near(finest_orders::<f64, 1>(&bar(), &spline, [32, 64]), [1.95, 1.45, 1.45]);
    let mut domains = relaxing(Updated, ShapeName::Cpgimp);
    near(finest_orders::<f64, 1>(&bar(), &domains, [16, 32]), [1.9, 0.95, 0.95]);
    domains.setup.transfer = Transfer::Pic;
    near(finest_orders::<f64, 2>(&block(), &domains, [8, 16]), [1.9, 0.9, 0.9]);
}

/// Forces at nodes balance, from the particles of the last state alone: hat functions at X by hand, P and b by formulas.
#[test]
fn forces_at_the_nodes_balance_at_the_end() {
    let (cells, field) = (16, Bar::default());
    let mut last = Last::default();
    let found = run::<f64, 1>(
        &bar(),
        &relaxing(FormulationName::Total, ShapeName::Linear),
        cells,
        &mut last,
    );
    let frame = last.0.expect("a state");
    let h = field.length / cells as f64;
    let [mut stress, mut body] = [vec![0.0; cells + 1], vec![0.0; cells + 1]];
    for p in 0..2 * cells {
        let x = frame.position[p] - frame.displacement[p];
        let f = frame.deformation_gradient[p];
        let nominal = field.young / 2.0 * (f - 1.0 / f);
        // Div P = P'(F) F_X of the exact F = 1 + 2 (L - X) A/L^2
        let exact = 1.0 + 2.0 * (field.length - x) * field.amplitude / field.length.powi(2);
        let slope = -2.0 * field.amplitude / field.length.powi(2);
        let b = -field.young / 2.0 * (1.0 + exact.powi(-2)) * slope;
        let node = (x / h) as usize;
        let share = x / h - node as f64;
        for (node, weight, gradient) in [(node, 1.0 - share, -1.0 / h), (node + 1, share, 1.0 / h)]
        {
            stress[node] -= h / 2.0 * nominal * gradient;
            body[node] += h / 2.0 * b * weight;
        }
    }
    let norm = |forces: &[f64]| forces.iter().map(|it| it * it).sum::<f64>().sqrt();
    // The first node is constrained.
    let left: Vec<f64> = stress.iter().zip(&body).skip(1).map(|(a, b)| a + b).collect();
    let relative = norm(&left) / norm(&stress);
    assert!(relative < 1e-9, "{relative:e}");
    let told = found.details.and_then(|it| it.residual).expect("a residual").relative;
    // Both are the same number up to rounding.
    assert!((relative - told).abs() < 1e-3 * told + 1e-13, "{relative:e} {told:e}");
}

/// Prescribed faces arrive at their exact places in any number of steps, and with them the whole body. Cubic splines are left
/// out: the outermost ones are not where their nodes are.
#[test]
fn a_uniform_stretch_comes_out_to_round_off() {
    let relaxes = |mut method: Method| {
        method.setup.relax = true;
        let is_total = method.formulation == FormulationName::Total;
        let is_exact = is_total && method.shape != ShapeName::CubicBspline;
        method.validate().map(|()| method).ok().filter(|_| is_exact)
    };
    for method in methods().into_iter().filter_map(relaxes) {
        let found = run::<f64, 2>(&Affine::patch(0.2), &method, 4, &mut ());
        let errors = found.level.errors.unwrap_or_else(|failure| panic!("{method:?}: {failure}"));
        assert!(errors.linf < 1e-8, "{method:?}: {errors:?}");
    }
}

#[test]
fn single_precision_ends_where_rounding_is_all_that_is_left() {
    let method = relaxing(FormulationName::Updated, ShapeName::Cpgimp);
    let [single, double] = [
        run::<f32, 2>(&block(), &method, 16, &mut ()),
        run::<f64, 2>(&block(), &method, 16, &mut ()),
    ]
    .map(|run| run.level.errors.unwrap().l2);
    assert!((single / double - 1.0).abs() < 0.05, "{single} {double}");
}

/// A bar whose stress is one of two numbers, neither of which balances b.
struct Jumping(Still<Bar>);

impl Material<f64, 1> for Jumping {
    fn density(&self, x: &[Vector<f64, 1>], out: &mut [f64]) {
        self.0.density(x, out);
    }

    fn wave_speed(&self, x: &[Vector<f64, 1>], out: &mut [f64]) {
        self.0.wave_speed(x, out);
    }

    fn kirchhoff_stress(
        &self,
        _: f64,
        _: &[Vector<f64, 1>],
        h: &[Matrix<f64, 1>],
        out: &mut [Matrix<f64, 1>],
    ) {
        for (out, h) in out.iter_mut().zip(h) {
            out[0] = if h[0] > 0.1 { 1e6 } else { -1e6 };
        }
    }
}

impl ManufacturedField<f64, 1> for Jumping {
    fn domain(&self) -> Domain<f64, 1> {
        self.0.domain()
    }

    fn displacement(&self, t: f64, x: &[Vector<f64, 1>], out: &mut [Vector<f64, 1>]) {
        self.0.displacement(t, x, out);
    }

    fn velocity(&self, t: f64, x: &[Vector<f64, 1>], out: &mut [Vector<f64, 1>]) {
        self.0.velocity(t, x, out);
    }

    fn acceleration(&self, t: f64, x: &[Vector<f64, 1>], out: &mut [Vector<f64, 1>]) {
        self.0.acceleration(t, x, out);
    }

    fn body_force(&self, t: f64, x: &[Vector<f64, 1>], out: &mut [Vector<f64, 1>]) {
        self.0.body_force(t, x, out);
    }

    fn displacement_gradient(&self, t: f64, x: &[Vector<f64, 1>], out: &mut [Matrix<f64, 1>]) {
        self.0.displacement_gradient(t, x, out);
    }
}

#[test]
fn a_run_that_finds_no_equilibrium_fails() {
    let method = relaxing(FormulationName::Total, ShapeName::Linear);
    let found = run::<f64, 1>(&Jumping(bar()), &method, 4, &mut ());
    let failure = found.level.errors.expect_err("no equilibrium");
    assert!(matches!(failure.cause, Cause::NotRelaxed { .. }), "{failure}");
    assert_eq!((found.details, found.level.steps), (None, failure.step));
    let text = failure.to_string();
    assert!(text.contains("has not come to equilibrium: its residual is"), "{text}");
}

#[test]
fn integrators_with_two_velocities_are_refused() {
    for integrator in [IntegratorName::Usf, IntegratorName::Musl] {
        let mut method = method(ShapeName::Cpgimp, integrator);
        assert_eq!(method.validate(), Ok(()));
        method.setup.relax = true;
        let refusal = method.validate().expect_err("refused");
        assert!(refusal.to_string().contains("use `leapfrog`"), "{refusal}");
    }
}
