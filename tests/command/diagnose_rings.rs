//! Mistakes about rings, in bilinear finite elements that share nothing with the solver of this project: each is named.

use mms_codegen::Options;
use mms_diagnosis::answer::{Diagnosis, DiagnosisFinding};
use mms_diagnosis::evidence::{Mesh, Snapshot};
use mms_diagnosis::exact::Quantity;
use mms_diagnosis::falls::Falls;
use mms_diagnosis::follow::Unfollowed;
use mms_diagnosis::material::Material;
use mms_diagnosis::scene::{Evidence, diagnose};
use mms_diagnosis::solver::Solver;
use mms_exact::Input;
use mms_options::field::open;
use mms_runtime::scene::Scene;
use mms_runtime::{ManufacturedField, Vector};

use super::sampled::sampled;

type Field = dyn ManufacturedField<f64, 2>;

/// The elements, with their mistakes about rings.
#[derive(Clone, Copy)]
struct Solid {
    /// Whether P_tt/R is in Div P.
    has_force: bool,
    /// Whether F_tt is 1 + u_R/R in the law.
    has_strain: bool,
    /// The weight of a point, by R and h.
    weight: fn(f64, f64) -> f64,
    /// Whether u_Z is fixed on the axis.
    axis_is_wall: bool,
}

const RIGHT: Solid =
    Solid { has_force: true, has_strain: true, weight: |r, _| r, axis_is_wall: false };

/// Young's modulus and the density of `axisymmetric_rod`, whose radius and length are 1; Poisson's ratio is 0.3.
const YOUNG: f64 = 1e6;
const DENSITY: f64 = 1000.0;

/// Almost half of the time window.
const END: f64 = 0.0158;

/// A Gauss point in its element.
struct Point {
    nodes: [usize; 4],
    values: [f64; 4],
    slopes: [[f64; 2]; 4],
    /// The area around it.
    area: f64,
}

impl Solid {
    /// u at the nodes of n x n elements, by central differences with a lumped mass.
    fn solved(self, field: &Field, n: usize) -> Mesh {
        let h = 1.0 / n as f64;
        let node = |i: usize, j: usize| j * (n + 1) + i;
        let all = || (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j)));
        let x: Vec<_> =
            all().map(|(i, j)| Vector::<f64, 2>::new(i as f64 * h, j as f64 * h)).collect();
        let away = 3.0_f64.sqrt() / 6.0;
        let gauss = [0.5 - away, 0.5 + away];
        let mut points = Vec::new();
        for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
            let nodes = [node(i, j), node(i + 1, j), node(i, j + 1), node(i + 1, j + 1)];
            for (a, b) in gauss.into_iter().flat_map(|b| gauss.map(|a| (a, b))) {
                let values = [(1.0 - a) * (1.0 - b), a * (1.0 - b), (1.0 - a) * b, a * b];
                let slopes = [[b - 1.0, a - 1.0], [1.0 - b, -a], [-b, 1.0 - a], [b, a]];
                let slopes = slopes.map(|it| it.map(|slope| slope / h));
                points.push(Point { nodes, values, slopes, area: h * h / 4.0 });
            }
        }
        let place = |point: &Point| -> Vector<f64, 2> {
            point.nodes.iter().zip(point.values).map(|(&node, n)| x[node] * n).sum()
        };
        let places: Vec<_> = points.iter().map(place).collect();
        let mut mass = vec![0.0; x.len()];
        for (point, place) in points.iter().zip(&places) {
            let volume = point.area * (self.weight)(place[0], h);
            let parts = point.nodes.iter().zip(point.values);
            parts.for_each(|(&node, n)| mass[node] += DENSITY * n * volume);
        }
        let is_held = |(i, j): (usize, usize)| {
            let is_wall = j == 0 || j == n || i == n;
            [is_wall || i == 0, is_wall || i == 0 && self.axis_is_wall]
        };
        let held: Vec<_> = all().map(is_held).collect();
        let acceleration = |time: f64, u: &[Vector<f64, 2>]| {
            let mut b = vec![Vector::zeros(); places.len()];
            field.body_force(time, &places, &mut b);
            let mut force = vec![Vector::<f64, 2>::zeros(); x.len()];
            for ((point, place), b) in points.iter().zip(&places).zip(&b) {
                self.add(point, place[0], h, (u, b), &mut force);
            }
            let each = force.iter().zip(&mass).zip(&held).map(|((force, mass), held)| {
                Vector::<f64, 2>::from_fn(|i, _| if held[i] { 0.0 } else { force[i] / mass })
            });
            each.collect::<Vec<_>>()
        };
        let start = field.domain().time[0];
        let (mut u, mut v) = (vec![Vector::zeros(); x.len()], vec![Vector::zeros(); x.len()]);
        field.displacement(start, &x, &mut u);
        field.velocity(start, &x, &mut v);
        for (v, held) in v.iter_mut().zip(&held) {
            (0..2).filter(|i| held[*i]).for_each(|i| v[i] = 0.0);
        }
        let steps = 6 * n;
        let dt = (END - start) / steps as f64;
        let mut part = 0.5;
        for step in 0..steps {
            let a = acceleration(start + step as f64 * dt, &u);
            v.iter_mut().zip(a).for_each(|(v, a)| *v += a * (part * dt));
            u.iter_mut().zip(&v).for_each(|(u, v)| *u += v * dt);
            part = 1.0;
        }
        let numbers = |all: &[Vector<f64, 2>]| all.iter().flat_map(|it| [it[0], it[1]]).collect();
        let snapshot = Snapshot {
            time: END,
            reference: numbers(&x),
            values: vec![(Quantity::Displacement, numbers(&u))],
            degree: Some(1),
            ..Snapshot::default()
        };
        Mesh { cell_size: h, time_step: None, snapshots: vec![snapshot] }
    }

    /// Adds rho0 b less Div P at a Gauss point: neo-Hookean, P = mu (F - F^-T) + lambda ln J F^-T.
    fn add(
        self,
        point: &Point,
        r: f64,
        h: f64,
        (u, b): (&[Vector<f64, 2>], &Vector<f64, 2>),
        force: &mut [Vector<f64, 2>],
    ) {
        let (mu, lambda) = (YOUNG / 2.6, 0.3 * YOUNG / (1.3 * 0.4));
        let (mut f, mut hoop) = ([[1.0, 0.0], [0.0, 1.0]], 1.0);
        for ((&node, slope), value) in point.nodes.iter().zip(point.slopes).zip(point.values) {
            (0..4).for_each(|at| f[at / 2][at % 2] += u[node][at / 2] * slope[at % 2]);
            hoop += if self.has_strain { value * u[node][0] / r } else { 0.0 };
        }
        let plane = f[0][0] * f[1][1] - f[0][1] * f[1][0];
        let rest = lambda * (plane * hoop).ln() - mu;
        let p = [
            [mu * f[0][0] + rest * f[1][1] / plane, mu * f[0][1] - rest * f[1][0] / plane],
            [mu * f[1][0] - rest * f[0][1] / plane, mu * f[1][1] + rest * f[0][0] / plane],
        ];
        let around = if self.has_force { mu * hoop + rest / hoop } else { 0.0 };
        let volume = point.area * (self.weight)(r, h);
        for ((&node, slope), value) in point.nodes.iter().zip(point.slopes).zip(point.values) {
            for i in 0..2 {
                let inner = p[i][0] * slope[0] + p[i][1] * slope[1];
                let hoop = if i == 0 { around * value / r } else { 0.0 };
                force[node][i] += (DENSITY * b[i] * value - inner - hoop) * volume;
            }
        }
    }
}

/// The root mean square of the error of u over the nodes.
fn error(field: &Field, results: &Snapshot) -> f64 {
    let points: Vec<_> = results.reference.chunks(2).map(Vector::from_column_slice).collect();
    let mut u = vec![Vector::zeros(); points.len()];
    field.displacement(results.time, &points, &mut u);
    let computed = results.values[0].1.chunks(2).map(Vector::<f64, 2>::from_column_slice);
    let squares = computed.zip(&u).map(|(a, b)| (a - b).norm_squared());
    (squares.sum::<f64>() / u.len() as f64).sqrt()
}

#[test]
fn mistakes_about_rings_are_named() {
    let input = Input::new(open("axisymmetric_rod").expect("the field"), &Options::default());
    let scene = input.expect("the field").scene(&[], |code| code.double).expect("a scene");
    let Scene::Plane(field) = &scene else { panic!("a field of the meridian") };
    let of = |solid: Solid| -> Diagnosis {
        let meshes = [8, 16].map(|n| solid.solved(field.as_ref(), n));
        let [coarse, fine] = [0, 1].map(|at| error(field.as_ref(), &meshes[at].snapshots[0]));
        let order = (coarse / fine).log2();
        let falls = Falls {
            quantity: "displacement".into(),
            norm: "l2".into(),
            observed: Some(order),
            expected: 2.0,
            verdict: String::new(),
            is_right: (order - 2.0).abs() < 0.15,
        };
        let solver = Solver { falls: Some(falls), ..Solver::default() };
        let material = Material { names: Vec::new(), times: &|_, _| None };
        let evidence = Evidence::Results(meshes.to_vec());
        diagnose(&scene, &evidence, &solver, &material, &Unfollowed).expect("a diagnosis")
    };
    assert_eq!(of(RIGHT).finding, DiagnosisFinding::Nothing);
    let mistakes = [
        ("hoop_missing", Solid { has_force: false, has_strain: false, ..RIGHT }),
        ("hoop_force_missing", Solid { has_force: false, ..RIGHT }),
        ("hoop_strain_missing", Solid { has_strain: false, ..RIGHT }),
        ("radius_weight_missing", Solid { weight: |_, _| 1.0, ..RIGHT }),
        (
            "solved_as_plane",
            Solid { has_force: false, has_strain: false, weight: |_, _| 1.0, ..RIGHT },
        ),
        ("ring_volume", Solid { weight: |r, h| r + h / 2.0, ..RIGHT }),
        ("axis_fixed", Solid { axis_is_wall: true, ..RIGHT }),
    ];
    for (name, solid) in sampled(mistakes, 7) {
        let found = of(solid);
        let first = &found.ranked[0];
        assert_eq!(
            (found.finding, first.name),
            (DiagnosisFinding::Named, name),
            "{:?}",
            found.ranked
        );
        assert!(first.explained > 0.9, "{name}: {}", first.explained);
    }
}
