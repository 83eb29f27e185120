//! Scenes that are refused, and runs that stop: never a wrong number, always where, when and why.

mod common;

use std::cell::Cell;
use std::sync::atomic::{AtomicUsize, Ordering};

use common::{Affine, Bar, method};
use mms_runtime::shape::Cpgimp;
use mms_runtime::study::{Level, Method, run_level};
use mms_runtime::{
    Body, Cause, Condition, Domain, Face, Failure, IntegratorName, ManufacturedField, Material,
    Matrix, Real, Refusal, Resolution, ShapeName, Solver, Vector,
};

/// The bar, with something spoilt.
struct Spoilt {
    bar: Bar,
    domain: fn(&mut Domain<f64, 1>),
    /// From the evaluation of this number on, counted from 0, the body force is this.
    spoilt_from: usize,
    body_force: f64,
    evaluations: AtomicUsize,
}

impl Spoilt {
    fn domain(domain: fn(&mut Domain<f64, 1>)) -> Self {
        let evaluations = AtomicUsize::new(0);
        Self { bar: Bar::default(), domain, spoilt_from: usize::MAX, body_force: 0.0, evaluations }
    }
}

impl Material<f64, 1> for Spoilt {
    fn density(&self, x: &[Vector<f64, 1>], density: &mut [f64]) {
        self.bar.density(x, density);
    }
    fn wave_speed(&self, x: &[Vector<f64, 1>], speed: &mut [f64]) {
        self.bar.wave_speed(x, speed);
    }
    fn kirchhoff_stress(
        &self,
        x: &[Vector<f64, 1>],
        h: &[Matrix<f64, 1>],
        out: &mut [Matrix<f64, 1>],
    ) {
        self.bar.kirchhoff_stress(x, h, out);
    }
}

impl ManufacturedField<f64, 1> for Spoilt {
    fn domain(&self) -> Domain<f64, 1> {
        let mut domain = self.bar.domain();
        (self.domain)(&mut domain);
        domain
    }
    fn displacement(&self, time: f64, x: &[Vector<f64, 1>], out: &mut [Vector<f64, 1>]) {
        self.bar.displacement(time, x, out);
    }
    fn velocity(&self, time: f64, x: &[Vector<f64, 1>], out: &mut [Vector<f64, 1>]) {
        self.bar.velocity(time, x, out);
    }
    fn acceleration(&self, time: f64, x: &[Vector<f64, 1>], out: &mut [Vector<f64, 1>]) {
        self.bar.acceleration(time, x, out);
    }
    fn body_force(&self, time: f64, x: &[Vector<f64, 1>], out: &mut [Vector<f64, 1>]) {
        self.bar.body_force(time, x, out);
        if self.evaluations.fetch_add(1, Ordering::Relaxed) >= self.spoilt_from {
            out.fill(Vector::repeat(self.body_force));
        }
    }
    fn displacement_gradient(&self, time: f64, x: &[Vector<f64, 1>], out: &mut [Matrix<f64, 1>]) {
        self.bar.displacement_gradient(time, x, out);
    }
}

fn run<T: Real>(
    field: &dyn ManufacturedField<T, 1>,
    method: &Method,
    cells: usize,
) -> Result<Level, Refusal> {
    run_level(field, method, cells, &mut |_, _| {})
}

fn refusal(domain: fn(&mut Domain<f64, 1>)) -> Refusal {
    run(&Spoilt::domain(domain), &Method::default(), 8).unwrap_err()
}

fn failure(level: Level) -> Failure {
    level.errors.unwrap_err()
}

#[test]
fn unsupported_scenes_are_refused_by_name() {
    let traction = refusal(|domain| domain.faces[1].1 = Condition::Traction);
    let (face, condition) = (Face::Max(0), Condition::Traction);
    assert_eq!(traction, Refusal::UnsupportedCondition { face, condition });
    let text = traction.to_string();
    assert!(text.contains("x_max") && text.contains("not supported by this solver"), "{text}");

    let refused = refusal(|domain| {
        domain.body = Body::Annulus { inner: 0.4, outer: 0.6, theta: [0.0, 1.0] };
    });
    assert_eq!(refused, Refusal::UnsupportedBody);
    assert!(refused.to_string().contains("not supported by this solver"));

    let face = Face::Min(1);
    let refused = refusal(|domain| domain.faces.push((Face::Min(1), Condition::Free)));
    assert_eq!(refused, Refusal::NoSuchFace { face, dimension: 1 });
}

#[test]
fn nonsense_is_refused() {
    let not_positive = |refusal: Refusal| matches!(refusal, Refusal::NotPositive { .. });
    assert!(not_positive(refusal(|domain| domain.time[1] = domain.time[0])));
    assert!(not_positive(refusal(|domain| domain.time[1] = f64::NAN)));
    assert!(not_positive(refusal(|domain| {
        domain.body = Body::Box { lower: Vector::zeros(), upper: Vector::zeros() };
    })));
    let bar = Bar::default();
    let refused = |method: &Method, cells: usize| run::<f64>(&bar, method, cells).unwrap_err();
    assert!(not_positive(refused(&Method::default(), 0)));
    assert!(not_positive(refused(&Method { particles_per_cell: 0, ..Method::default() }, 8)));
    for courant in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(not_positive(refused(&Method { courant, ..Method::default() }, 8)), "{courant}");
    }
    let too_large = |refusal: Refusal| matches!(refusal, Refusal::TooLarge { .. });
    assert!(too_large(refused(&Method::default(), usize::MAX)));
    assert!(too_large(refused(&Method { courant: 1e-300, ..Method::default() }, 8)));
    let amplitude = Bar { amplitude: 1e300, ..Bar::default() };
    assert!(too_large(run::<f64>(&amplitude, &Method::default(), 8).unwrap_err()));
    let amplitude = Bar { amplitude: f64::NAN, ..Bar::default() };
    let refused = run::<f64>(&amplitude, &Method::default(), 8).unwrap_err();
    assert!(matches!(refused, Refusal::FieldNotFinite { quantity: "displacement", .. }));
}

/// F = 1 + 2 (L - X) A/L^2 is negative near X = 0 for A = -0.6, half a period after the start.
#[test]
fn an_inverted_particle_stops_the_run() {
    let bar = Bar { amplitude: 0.6, ..Bar::default() };
    let Failure { step, time, particle, reference_position, cause } = failure(
        run::<f64>(&bar, &method(ShapeName::Linear, IntegratorName::Leapfrog), 16).unwrap(),
    );
    assert!(step > 0 && time > 0.0, "{step} {time}");
    assert!(particle.is_some() && reference_position.len() == 1);
    assert!(matches!(cause, Cause::Inverted { jacobian } if jacobian <= 0.0), "{cause:?}");
}

/// With A = -0.6 at the start the field itself is inverted.
#[test]
fn an_inverted_initial_state_stops_the_run_at_step_0() {
    let bar = Bar { amplitude: -0.6, ..Bar::default() };
    let failure = failure(run::<f64>(&bar, &Method::default(), 16).unwrap());
    assert_eq!((failure.step, failure.particle), (0, Some(0)));
    assert!(matches!(failure.cause, Cause::Inverted { .. }));
    let text = failure.to_string();
    for part in ["step 0", "particle 0", "X = [0.015625]", "inverted", "try"] {
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn a_value_that_is_not_a_number_stops_the_run_in_its_step() {
    for &integrator in IntegratorName::ALL {
        let field = Spoilt { spoilt_from: 5, body_force: f64::NAN, ..Spoilt::domain(|_| ()) };
        let method = method(ShapeName::Cpgimp, integrator);
        let progress = Cell::new(0);
        let level = run_level(&field, &method, 8, &mut |step, _| progress.set(step)).unwrap();
        assert_eq!(progress.get(), 5, "{integrator}");
        let failure = failure(level);
        assert_eq!(failure.step, 6);
        assert!(matches!(failure.cause, Cause::NotFinite { .. }), "{failure}");
    }
}

#[test]
fn a_particle_that_leaves_the_grid_is_lost() {
    let field = Spoilt { spoilt_from: 5, body_force: 1e9, ..Spoilt::domain(|_| ()) };
    let method = method(ShapeName::Linear, IntegratorName::Leapfrog);
    let failure = failure(run(&field, &method, 8).unwrap());
    assert!(matches!(failure.cause, Cause::Lost { .. }), "{failure}");
    assert!(failure.to_string().contains("left the grid"));
}

#[test]
fn an_unstable_run_stops() {
    for &shape in ShapeName::ALL {
        for &integrator in IntegratorName::ALL {
            let method = Method { courant: 5.0, ..method(shape, integrator) };
            let failure = failure(run::<f64>(&Bar::default(), &method, 64).unwrap());
            assert!(failure.step > 0, "{shape} {integrator}: {failure}");
        }
    }
}

/// One particle per cell and a stretch of more than two: the domain is wider than the stencil.
#[test]
fn a_domain_wider_than_the_stencil_stops_the_run() {
    let bar = Bar { amplitude: 0.9, ..Bar::default() };
    let method = Method { particles_per_cell: 1, ..Method::default() };
    let failure = failure(run::<f64>(&bar, &method, 16).unwrap());
    assert!(matches!(failure.cause, Cause::HalfWidth { .. }), "{failure}");
    assert!(failure.to_string().contains("more particles per cell"));
}

/// A wall on an upper face has to be on a plane of nodes.
#[test]
fn a_wall_between_nodes_is_refused() {
    let field = Affine { upper: [1.0, 0.55, 1.0], ..Affine::flight([0.0; 3]) };
    let field = Affine { faces: vec![(Face::Max(1), Condition::Roller)], ..field };
    let resolution = |cells| Resolution { cells, particles_per_cell: 2, courant: 0.4 };
    let field: &dyn ManufacturedField<f64, 2> = &field;
    let refused = Solver::<f64, 2, _, Cpgimp>::new(field, &resolution(8)).err();
    assert!(matches!(refused, Some(Refusal::WallBetweenNodes { face: Face::Max(1), .. })));
    let solver = Solver::<f64, 2, _, Cpgimp>::new(field, &resolution(20)).unwrap();
    let volume: f64 = solver.particles().reference_volume.iter().sum();
    assert!((volume - 0.55).abs() < 1e-12, "the particles' domains fill the body: {volume}");
}
