//! Tangents in closed form, typed by hand from the pushed-forward elasticities, with mistakes.

use mms_diagnosis::answer::Diagnosis;
use mms_diagnosis::exact::Exact;
use mms_diagnosis::hypothesis::all;
use mms_diagnosis::table::{self, Measure};
use mms_diagnosis::tangent::{self, TangentTable};
use mms_runtime::{Body, Domain, ManufacturedField, Material, Matrix, Vector};

use super::field::{self, LAMBDA, MU};
use super::{LOADED, Tensor, exact, name, points};

/// A tangent by rows, from the stress rates at unit rates of deformation.
fn rows<const D: usize>(
    places: &[[usize; 2]],
    rate: impl Fn(&Matrix<f64, D>) -> Matrix<f64, D>,
) -> Vec<f64> {
    let unit = |[k, l]: [usize; 2]| {
        let mut unit = Matrix::zeros();
        unit[(k, l)] += 0.5;
        unit[(l, k)] += 0.5;
        rate(&unit)
    };
    let columns: Vec<_> = places.iter().map(|it| unit(*it)).collect();
    places
        .iter()
        .flat_map(|[i, j]| columns.iter().map(|it| it[(*i, *j)]).collect::<Vec<_>>())
        .collect()
}

/// Neo-Hookean material at one F in plane strain.
struct At {
    f: Tensor,
    j: f64,
    tau: Tensor,
    moduli: [f64; 2],
}

impl At {
    fn new(h: &Tensor, moduli: [f64; 2]) -> Self {
        let f = h + Tensor::identity();
        At { f, j: f.determinant(), tau: field::first(h, moduli) * f.transpose(), moduli }
    }

    /// lambda C^-1 x C^-1 + 2 (mu - lambda ln J) C^-1 . C^-1 with C for dS/dE; the pushed-forward tangent has I in place of C.
    fn elasticity(&self, metric: &Tensor, strain: &Tensor) -> Tensor {
        let [lambda, mu] = self.moduli;
        let inverse = metric.try_inverse().unwrap();
        inverse * (lambda * (inverse * strain).trace())
            + inverse * strain * inverse * (2.0 * (mu - lambda * self.j.ln()))
    }

    /// Truesdell's rate of tau.
    fn lie(&self, rate: &Tensor) -> Tensor {
        self.elasticity(&Tensor::identity(), rate)
    }

    fn jaumann(&self, rate: &Tensor) -> Tensor {
        self.lie(rate) + rate * self.tau + self.tau * rate
    }
}

const PLANE: [[usize; 2]; 3] = [[0, 0], [1, 1], [0, 1]];

/// Diagnoses a law with these moduli and stress rates at unit rates of deformation.
fn of_moduli(moduli: [f64; 2], rate: impl Fn(&At, &Tensor) -> Tensor) -> Diagnosis {
    let exact = exact(&LOADED, 20.0);
    let reference = points(4);
    let gradient: Vec<Tensor> = reference.iter().map(|x| field::gradient(0.0, x) * 3.0).collect();
    let at = gradient.iter().map(|h| At::new(h, moduli));
    let tangent = at.flat_map(|at| rows(&PLANE, |unit| rate(&at, unit))).collect();
    let table = TangentTable { reference, gradient, tangent, rounding: 0.0 };
    tangent::diagnose(&exact, &table, all(&exact)).unwrap()
}

#[test]
fn a_tangent_is_named_to_round_off() {
    let of = |rate: &dyn Fn(&At, &Tensor) -> Tensor| name(&of_moduli([LAMBDA, MU], rate));
    let right = |at: &At, rate: &Tensor| at.jaumann(rate) / at.j;
    assert_eq!(of(&right), "nothing");
    assert_eq!(of(&|at, rate| at.jaumann(rate)), "tangent_volume");
    assert_eq!(of(&|at, rate| at.lie(rate) / at.j), "tangent_truesdell");
    let of_sigma = |at: &At, rate: &Tensor| (at.jaumann(rate) - at.tau * rate.trace()) / at.j;
    assert_eq!(of(&of_sigma), "tangent_cauchy");
    let material = |at: &At, strain: &Tensor| at.elasticity(&(at.f.transpose() * at.f), strain);
    assert_eq!(of(&material), "tangent_material");
    let small =
        |_: &At, rate: &Tensor| Tensor::identity() * (LAMBDA * rate.trace()) + rate * (2.0 * MU);
    assert_eq!(of(&small), "tangent_small_strain");
    assert_eq!(of(&|at, rate| -right(at, rate)), "tangent_sign");
    let shear =
        |at: &At, rate: &Tensor| right(at, rate) * if rate[(0, 1)] == 0.0 { 1.0 } else { 2.0 };
    assert_eq!(of(&shear), "tangent_shear_twice");
    assert_eq!(name(&of_moduli([MU, LAMBDA], right)), "moduli_swapped");
    assert_eq!(name(&of_moduli([LAMBDA + 2.0 / 3.0 * MU, MU], right)), "lambda_bulk");
    assert_eq!(name(&of_moduli([LAMBDA, 2.0 * MU], right)), "mu_twice");
    // A tangent by differences of the stress, as in many laws.
    let step = 1e-8;
    let differences = |at: &At, rate: &Tensor| {
        let h = at.f + rate * at.f * step - Tensor::identity();
        (At::new(&h, at.moduli).tau - at.tau) / (step * at.j)
    };
    assert_eq!(of(&differences), "nothing");
    // An addition that no hypothesis covers.
    assert_eq!(of(&|at, rate| right(at, rate) + at.f * rate * 50.0), "unexplained");
}

/// Saint Venant-Kirchhoff material at rest.
struct Cube;

type Solid = Matrix<f64, 3>;
type Place = Vector<f64, 3>;

/// S as a function of E; since it is linear, also the rate of S as a function of the rate of E.
fn second(strain: &Solid) -> Solid {
    Solid::identity() * (LAMBDA * strain.trace()) + strain * (2.0 * MU)
}

fn kirchhoff(f: &Solid) -> Solid {
    f * second(&((f.transpose() * f - Solid::identity()) / 2.0)) * f.transpose()
}

impl Material<f64, 3> for Cube {
    fn density(&self, _: &[Place], density: &mut [f64]) {
        density.fill(1.0);
    }

    fn wave_speed(&self, _: &[Place], speed: &mut [f64]) {
        speed.fill((LAMBDA + 2.0 * MU).sqrt());
    }

    fn kirchhoff_stress(&self, _: f64, _: &[Place], h: &[Solid], stress: &mut [Solid]) {
        h.iter().zip(stress).for_each(|(h, out)| *out = kirchhoff(&(h + Solid::identity())));
    }
}

impl ManufacturedField<f64, 3> for Cube {
    fn domain(&self) -> Domain<f64, 3> {
        let body = Body::Box { lower: Place::zeros(), upper: Place::repeat(1.0) };
        Domain { body, time: [0.0, 1.0], faces: Vec::new() }
    }

    fn displacement(&self, _: f64, _: &[Place], out: &mut [Place]) {
        out.fill(Place::zeros());
    }

    fn velocity(&self, _: f64, _: &[Place], out: &mut [Place]) {
        out.fill(Place::zeros());
    }

    fn acceleration(&self, _: f64, _: &[Place], out: &mut [Place]) {
        out.fill(Place::zeros());
    }

    fn body_force(&self, _: f64, _: &[Place], out: &mut [Place]) {
        out.fill(Place::zeros());
    }

    fn displacement_gradient(&self, _: f64, _: &[Place], out: &mut [Solid]) {
        out.fill(Solid::zeros());
    }
}

fn gradients() -> Vec<Solid> {
    let entry = |k: usize, i: usize, j: usize| 0.2 * ((7 * k + 3 * i + j) as f64 * 1.3).sin();
    (0..9).map(|k| Solid::from_fn(|i, j| entry(k, i, j))).collect()
}

#[test]
fn orders_of_voigt_are_named_in_space() {
    let exact = Exact::new(&Cube, 0.1, 0.1);
    let gradient = gradients();
    let reference = vec![Place::repeat(0.5); gradient.len()];
    let of_tangent = |places: [[usize; 2]; 6]| {
        let at = |h: &Solid| {
            let f = h + Solid::identity();
            let tau = kirchhoff(&f);
            rows(&places, |d: &Solid| {
                let lie = f * second(&(f.transpose() * d * f)) * f.transpose();
                (lie + d * tau + tau * d) / f.determinant()
            })
        };
        let tangent = gradient.iter().flat_map(at).collect();
        let (reference, gradient) = (reference.clone(), gradient.clone());
        let table = TangentTable { reference, gradient, tangent, rounding: 0.0 };
        tangent::diagnose(&exact, &table, all(&exact)).unwrap()
    };
    let normal = [[0, 0], [1, 1], [2, 2]];
    let of = |shear: [[usize; 2]; 3]| {
        let [a, b, c] = normal;
        let [d, e, f] = shear;
        of_tangent([a, b, c, d, e, f])
    };
    assert_eq!(name(&of([[0, 1], [0, 2], [1, 2]])), "nothing");
    let other = of([[1, 2], [0, 2], [0, 1]]);
    assert_eq!(other.ranked[0].title(), "voigt_order [23, 13, 12]");
    assert_eq!(name(&other), "voigt_order");
    assert_eq!(of([[0, 1], [1, 2], [0, 2]]).ranked[0].title(), "voigt_order [12, 23, 13]");

    let of_stress = |measure: Measure, written: &dyn Fn(Solid) -> Solid| {
        let stress = gradient.iter().map(|h| {
            let f = h + Solid::identity();
            written(measure.of(&f, &kirchhoff(&f)))
        });
        let stress = stress.collect();
        let (reference, gradient) = (reference.clone(), gradient.clone());
        let table = table::StressTable {
            reference,
            gradient,
            measure,
            stress,
            rounding: 0.0,
            rounding_of_gradient: 0.0,
        };
        table::diagnose(&exact, &table, all(&exact)).unwrap()
    };
    // 11, 22, 33, 23, 12, 13 under the names 11, 22, 33, 12, 13, 23.
    let cyclic = |s: Solid| {
        let [a, b, c] = [s[(1, 2)], s[(0, 1)], s[(0, 2)]];
        Solid::new(s[(0, 0)], a, b, a, s[(1, 1)], c, b, c, s[(2, 2)])
    };
    for measure in [Measure::SecondPiola, Measure::Kirchhoff, Measure::Cauchy] {
        assert_eq!(name(&of_stress(measure, &|s| s)), "nothing");
        let found = of_stress(measure, &cyclic);
        assert_eq!(name(&found), "voigt_order");
        assert_eq!(found.ranked[0].title(), "voigt_order [23, 12, 13]");
    }
}
