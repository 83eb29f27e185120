//! Mistakes at equilibrium of a rod whose stress follows on paper from its loads: P(X) = T + int rho0 b from X to the end. H
//! then follows by bisection, and u by integration.

use mms_diagnosis::evidence::{ComparisonFrame, DEGREE, Mesh, Snapshot};
use mms_diagnosis::exact::{Exact, Quantity};
use mms_diagnosis::excluded::{Study, VisibleSizes, excluded};
use mms_diagnosis::hypothesis::{Hypothesis, all};
use mms_diagnosis::ordinary;
use mms_diagnosis::run::Responses as _;
use mms_diagnosis::smooth::Smooth;
use mms_diagnosis::solver::Solver;
use mms_diagnosis::statics::{Equilibrium, Statics};
use mms_runtime::{Body, Condition, Domain, Face, ManufacturedField, Material, Matrix, Vector};
use std::sync::Arc;

use super::field::{DENSITY, LAMBDA, MU};
use super::name;

type Point = Vector<f64, 1>;
type Tensor = Matrix<f64, 1>;

/// A rod clamped at 0 and loaded at 1.
struct Rod;

fn stretch(x: f64) -> f64 {
    0.15 * (1.4 * x).cos() + 0.1 * x
}

fn displacement(x: f64) -> f64 {
    0.15 / 1.4 * (1.4 * x).sin() + 0.05 * x * x
}

/// P as a function of H: neo-Hookean, uniaxial strain.
fn stress(h: f64) -> f64 {
    let f = 1.0 + h;
    MU * (f - 1.0 / f) + LAMBDA * f.ln() / f
}

fn body_force(x: f64) -> f64 {
    let f = 1.0 + stretch(x);
    let stiffness = MU * (1.0 + 1.0 / (f * f)) + LAMBDA * (1.0 - f.ln()) / (f * f);
    -stiffness * (-0.15 * 1.4 * (1.4 * x).sin() + 0.1) / DENSITY
}

impl Material<f64, 1> for Rod {
    fn density(&self, _: &[Point], density: &mut [f64]) {
        density.fill(DENSITY);
    }

    fn wave_speed(&self, _: &[Point], speed: &mut [f64]) {
        speed.fill(((LAMBDA + 2.0 * MU) / DENSITY).sqrt());
    }

    fn kirchhoff_stress(&self, _: f64, _: &[Point], h: &[Tensor], tau: &mut [Tensor]) {
        h.iter().zip(tau).for_each(|(h, tau)| *tau = Tensor::new(stress(h.x) * (1.0 + h.x)));
    }
}

impl ManufacturedField<f64, 1> for Rod {
    fn domain(&self) -> Domain<f64, 1> {
        let faces = vec![(Face::Min(0), Condition::Fixed), (Face::Max(0), Condition::Traction)];
        let body = Body::Box { lower: Point::new(0.0), upper: Point::new(1.0) };
        Domain { body, time: [0.0, 1.0], faces }
    }

    fn displacement(&self, _: f64, x: &[Point], out: &mut [Point]) {
        x.iter().zip(out).for_each(|(x, out)| out.x = displacement(x.x));
    }

    fn velocity(&self, _: f64, _: &[Point], out: &mut [Point]) {
        out.fill(Point::zeros());
    }

    fn acceleration(&self, _: f64, _: &[Point], out: &mut [Point]) {
        out.fill(Point::zeros());
    }

    fn body_force(&self, _: f64, x: &[Point], out: &mut [Point]) {
        x.iter().zip(out).for_each(|(x, out)| out.x = body_force(x.x));
    }

    fn displacement_gradient(&self, _: f64, x: &[Point], out: &mut [Tensor]) {
        x.iter().zip(out).for_each(|(x, out)| out.x = stretch(x.x));
    }
}

/// Factors of b, of the traction and of the stress.
type Factors = [f64; 3];

/// The displacement that a mistake adds at each point, on paper.
fn moved([force, load, law]: Factors, points: &[f64]) -> Vec<f64> {
    let end = stress(stretch(1.0));
    let wrong = |x: f64| {
        let right = stress(stretch(x));
        let wanted = (load * end + force * (right - end)) / law;
        let (mut low, mut high) = (-0.9, 9.0);
        for _ in 0..80 {
            let middle = f64::midpoint(low, high);
            if stress(middle) < wanted { low = middle } else { high = middle }
        }
        low - stretch(x)
    };
    let to = |end: f64| -> f64 {
        // By Simpson's rule.
        let parts = 200;
        let at = |k: usize| wrong(end * k as f64 / f64::from(parts));
        let weight = |k: usize| if k % 2 == 1 { 4.0 } else { 2.0 };
        let inner: f64 = (1..parts as usize).map(|k| weight(k) * at(k)).sum();
        (at(0) + inner + at(parts as usize)) * end / f64::from(3 * parts)
    };
    points.iter().map(|x| to(*x)).collect()
}

const MISTAKES: [(&str, f64, Factors); 7] = [
    ("force_factor", 1.2, [1.2, 1.0, 1.0]),
    ("force_factor", -1.0, [-1.0, 1.0, 1.0]),
    ("force_factor", 3.0, [3.0, 1.0, 1.0]),
    ("traction_factor", 0.0, [1.0, 0.0, 1.0]),
    ("traction_factor", 0.98, [1.0, 0.98, 1.0]),
    ("moduli_factor", 2.0, [1.0, 1.0, 2.0]),
    ("moduli_factor", 0.6, [1.0, 1.0, 0.6]),
];

fn points(cells: usize) -> Vec<f64> {
    (0..=cells).map(|k| k as f64 / cells as f64).collect()
}

/// Results with `beside` added to the exact displacement, and an error that falls with h^2.
fn mesh(cells: usize, beside: &[f64]) -> Mesh {
    let (h, reference) = (1.0 / cells as f64, points(cells));
    let error = |x: f64| 0.02 * h * h * x * (1.0 + x);
    let each = reference.iter().zip(beside);
    let u = each.map(|(x, beside)| displacement(*x) + beside + error(*x)).collect();
    let values = vec![(Quantity::Displacement, u)];
    let snapshot = Snapshot { time: 0.5, reference, values, ..Snapshot::default() };
    Mesh { cell_size: h, time_step: None, snapshots: vec![snapshot] }
}

fn frame(exact: &Exact<'_, 1>, mesh: &Mesh) -> ComparisonFrame<1> {
    let smooth = Smooth::new(&exact.domain.body, mesh.snapshots[0].reference.len(), DEGREE);
    ComparisonFrame::new(exact, &[&mesh.snapshots[0]], smooth.unwrap())
}

#[test]
fn responses_are_those_of_paper() {
    let exact = Exact::new(&Rod, 1.0 / 32.0, 1e-3);
    assert!(exact.is_at_rest());
    let points = points(32);
    let mesh = mesh(32, &vec![0.0; 33]);
    let frame = frame(&exact, &mesh);
    let equilibrium = Arc::new(Equilibrium::new(&exact, &frame).unwrap().unwrap());
    let solver = Statics::new(equilibrium, &frame, &mesh);
    let right = solver.right(0).unwrap();
    let hypotheses = all(&exact);
    for (name, size, factors) in MISTAKES {
        let is_it = |it: &&Hypothesis<1>| it.name == name;
        let hypothesis = hypotheses.iter().find(is_it).unwrap();
        let found = solver.wrong(0, hypothesis, &[size]).unwrap();
        let expected = moved(factors, &points);
        let largest = expected.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
        for ((found, right), expected) in found[0].iter().zip(&right[0]).zip(&expected) {
            let off = (found - right - expected).abs() / largest;
            assert!(off < 1e-5, "{name} {size}: {off:e}");
        }
    }
}

#[test]
fn mistakes_at_rest_are_named_with_their_sizes() {
    for (mistake, size, factors) in MISTAKES {
        let meshes = [16, 32].map(|cells| mesh(cells, &moved(factors, &points(cells))));
        let exact = Exact::new(&Rod, 1.0 / 32.0, 1e-3);
        let frame = frame(&exact, &meshes[1]);
        let found =
            ordinary::diagnose(&exact, &frame, &meshes, &all(&exact), &Solver::default()).unwrap();
        let best = found.ranked.iter().find(|it| {
            let class = &found.ranked[0];
            let alike = class.equivalent_here.iter().chain(&class.equivalent_always);
            let is_alike =
                it.title() == class.title() || alike.clone().any(|own| *own == it.title());
            is_alike && (it.factor[0] - size).abs() < 0.02 * size.abs().max(1.0)
        });
        assert_eq!(found.finding.name(), "named", "{mistake} {size}: {:?}", found.ranked[0]);
        assert!(
            best.is_some(),
            "{mistake} {size}: {:?} {:?}",
            found.ranked[0],
            found.ranked.iter().filter(|it| it.name.contains("moduli")).collect::<Vec<_>>()
        );
    }
}

#[test]
fn right_results_at_rest_are_nothing() {
    let meshes = [16, 32].map(|cells| mesh(cells, &vec![0.0; cells + 1]));
    let exact = Exact::new(&Rod, 1.0 / 32.0, 1e-3);
    let frame = frame(&exact, &meshes[1]);
    let found =
        ordinary::diagnose(&exact, &frame, &meshes, &all(&exact), &Solver::default()).unwrap();
    assert_eq!(name(&found), "nothing", "{:?}", found.ranked[0]);
}

#[test]
fn what_a_pass_excludes_adds_twice_its_error_on_paper() {
    let error = 2e-4;
    let exact = Exact::new(&Rod, 1.0 / 32.0, 1e-3);
    let study = Study {
        cell_size: 1.0 / 32.0,
        time_step: None,
        times: vec![0.5],
        errors: vec![(Quantity::Displacement, error)],
        is_static: true,
    };
    let found = excluded(&exact, &study, &all(&exact)).unwrap();
    let of = |name: &str| found.iter().find(|it| it.title.starts_with(name)).unwrap();
    let middles: Vec<f64> = (0..64).map(|k| (f64::from(k) + 0.5) / 64.0).collect();
    let mean = |factors| {
        let moved = moved(factors, &middles);
        (moved.iter().map(|it| it * it).sum::<f64>() / 64.0).sqrt()
    };
    let with = |name: &str, factor: f64| match name {
        "force_factor" => [factor, 1.0, 1.0],
        "traction_factor" => [1.0, factor, 1.0],
        _ => [1.0, 1.0, factor],
    };
    for name in ["force_factor", "traction_factor", "moduli_factor"] {
        let VisibleSizes::From { right, least } = of(name).shown else { panic!("{:?}", of(name)) };
        assert_eq!(right, 1.0);
        let [less, more] = [1.0 - least, 1.0 + least].map(|factor| mean(with(name, factor)));
        // The search accepts an error within a fifth of the noticed one.
        let nearest = (less / (2.0 * error) - 1.0).abs().min((more / (2.0 * error) - 1.0).abs());
        assert!(nearest < 0.2, "{name} {least:e}: {less:e} {more:e}");
    }
    // The sign of b is a mistake without a size.
    let VisibleSizes::Always(Some(times)) = of("force_sign").shown else {
        panic!("{:?}", of("force_sign"))
    };
    let expected = mean([-1.0, 1.0, 1.0]) / error;
    assert!((times / expected - 1.0).abs() < 1e-3, "{times} {expected}");
    // Without motion these mistakes add nothing, and in one dimension a transposed stress is the same.
    for name in ["damping", "start_at_rest", "force_late", "stress_transposed"] {
        assert_eq!(of(name).shown, VisibleSizes::Never(0.0), "{name}");
    }
}
