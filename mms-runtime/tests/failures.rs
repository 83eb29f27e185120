//! Scenes that are refused, and runs that stop: never a wrong number, always with place, time and cause.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::common::{Affine, Bar, method, methods, wave::Wave};
use mms_runtime::study::{StudyLevel, run_level};
use mms_runtime::{
    Body, Cause, Condition, Division, Domain, Face, Failure, Fill, FormulationName, IntegratorName,
    ManufacturedField, Material, Matrix, Method, Refusal, Setup, ShapeName, Solve, Transfer,
    Vector,
};

/// The bar, with something spoilt.
struct Spoilt {
    bar: Bar,
    domain: fn(&mut Domain<f64, 1>),
    /// From the evaluation with this number on, counted from 0, the body force has the value `body_force`.
    spoilt_from: usize,
    body_force: f64,
    evaluations: AtomicUsize,
    /// Multiplied by X, the relative increase of the wave speed.
    faster: f64,
}

impl Spoilt {
    fn domain(domain: fn(&mut Domain<f64, 1>)) -> Self {
        let evaluations = AtomicUsize::new(0);
        let (spoilt_from, body_force, faster) = (usize::MAX, 0.0, 0.0);
        Self { bar: Bar::default(), domain, spoilt_from, body_force, evaluations, faster }
    }
}

impl Material<f64, 1> for Spoilt {
    fn density(&self, x: &[Vector<f64, 1>], density: &mut [f64]) {
        self.bar.density(x, density);
    }
    fn wave_speed(&self, x: &[Vector<f64, 1>], speed: &mut [f64]) {
        self.bar.wave_speed(x, speed);
        speed.iter_mut().zip(x).for_each(|(speed, x)| *speed *= 1.0 + self.faster * x[0]);
    }
    fn kirchhoff_stress(
        &self,
        time: f64,
        x: &[Vector<f64, 1>],
        h: &[Matrix<f64, 1>],
        out: &mut [Matrix<f64, 1>],
    ) {
        self.bar.kirchhoff_stress(time, x, h, out);
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

fn run<T: Solve<1>>(
    field: &dyn ManufacturedField<T, 1>,
    method: &Method,
    cells: usize,
) -> Result<StudyLevel, Refusal> {
    run_level(field, method, &cells.into(), &mut ())
}

fn refusal(domain: fn(&mut Domain<f64, 1>)) -> Refusal {
    run(&Spoilt::domain(domain), &Method::default(), 8).unwrap_err()
}

/// The default method with this setup.
fn with(setup: Setup) -> Method {
    Method { setup, ..Method::default() }
}

/// The refusal of the default method with this setup.
fn refused<const D: usize>(
    field: &dyn ManufacturedField<f64, D>,
    setup: Setup,
    cells: &Division,
) -> Refusal
where
    f64: Solve<D>,
{
    run_level(field, &with(setup), cells, &mut ()).unwrap_err()
}

fn failure(level: StudyLevel) -> Failure {
    level.errors.unwrap_err()
}

/// A quarter of a ring, with one claim.
fn sector(face: Face, condition: Condition) -> Wave<2> {
    let theta = [0.0, std::f64::consts::FRAC_PI_2];
    Wave::on(Body::Annulus { inner: 0.5, outer: 1.0, theta }).with_faces(&[(face, condition)])
}

/// The estimate is about right: a square of 10^6 particles needs more than 10^7 bytes, and less than 10^9.
#[test]
fn what_memory_cannot_hold_is_refused_before_it_is_taken() {
    let square = Wave::on_box([1.0, 1.0]);
    let within = |memory| Setup { memory: Some(memory), end_time: Some(1e-6), ..Setup::default() };
    match refused(&square, within(10_000_000), &500.into()) {
        Refusal::TooLittleMemory { needed, available: 10 } => {
            assert!((100..1000).contains(&needed), "{needed} MB");
        }
        other => panic!("{other:?}"),
    }
    let few = run_level(&square, &with(within(10_000_000)), &8.into(), &mut ());
    assert!(few.unwrap().errors.is_ok());
}

#[test]
fn a_body_too_light_for_the_precision_is_refused_and_a_light_one_moves_as_a_heavy_one() {
    // Moduli are proportional to the density, and so the motion is the same.
    let bar = |rho0: f64| Bar { rho0, young: 1e3 * rho0, ..Bar::default() };
    let errors = |rho0: f64| {
        let bar: &dyn ManufacturedField<f64, 1> = &bar(rho0);
        run_level(bar, &Method::default(), &8.into(), &mut ()).unwrap().errors.unwrap().linf
    };
    let (light, heavy) = (errors(2_f64.powi(-950)), errors(2_f64.powi(10)));
    assert!((light - heavy).abs() <= 1e-12 * heavy, "{light:e} and {heavy:e}");
    match refused(&bar(2_f64.powi(-980)), Setup::default(), &8.into()) {
        // A particle has 1/16 of that mass.
        Refusal::TooLight { mass, least } => assert!(mass == 2_f64.powi(-984) && mass < least),
        other => panic!("{other:?}"),
    }
}

/// Particles on a lattice of boxes do not lie along a circle; only boxes have rollers.
#[test]
fn conditions_that_an_annulus_cannot_meet_are_refused_by_name() {
    let cartesian = || Setup { fill: Some(Fill::Cartesian), ..Setup::default() };
    for face in [Face::Inner, Face::Outer, Face::ThetaMin, Face::ThetaMax] {
        let condition = Condition::Traction;
        let refusal = refused(&sector(face, condition), cartesian(), &8.into());
        assert_eq!(refusal, Refusal::RaggedFace { face, condition });
        let text = refusal.to_string();
        assert!(text.contains(&face.to_string()) && text.contains("--fill fitted"), "{text}");
        let fitted = run_level(&sector(face, condition), &Method::default(), &8.into(), &mut ());
        assert!(fitted.is_ok(), "{fitted:?}");

        let condition = Condition::Roller;
        let refusal = refused(&sector(face, condition), Setup::default(), &8.into());
        assert_eq!(refusal, Refusal::UnsupportedCondition { face, condition });
        assert!(refusal.to_string().contains("claim `prescribed` there"), "{refusal}");
    }
}

#[test]
fn claims_about_faces_that_the_body_lacks_are_refused() {
    let face = Face::Min(1);
    let missing = refusal(|domain| domain.faces.push((Face::Min(1), Condition::Free)));
    assert_eq!(missing, Refusal::NoSuchFace { face, dimension: 1 });
    assert!(missing.to_string().contains("y_min"), "{missing}");

    let face = Face::Max(0);
    let missing = refused(&sector(face, Condition::Free), Setup::default(), &8.into());
    assert_eq!(missing, Refusal::NoSuchFace { face, dimension: 2 });

    // A full ring has no first angle.
    let theta = [0.0, std::f64::consts::TAU];
    let ring = Wave::on(Body::Annulus { inner: 0.5, outer: 1.0, theta });
    let face = Face::ThetaMin;
    let ring = ring.with_faces(&[(face, Condition::Free)]);
    let missing = refused(&ring, Setup::default(), &8.into());
    assert_eq!(missing, Refusal::NoSuchFace { face, dimension: 2 });
}

/// In a formulation where nothing moves, a domain has nothing to follow; all other combinations are valid.
#[test]
fn a_domain_that_follows_is_refused_in_the_total_formulation() {
    for &shape in ShapeName::ALL {
        let formulation = FormulationName::Total;
        let method = Method { shape, formulation, ..Method::default() };
        let result = run::<f64>(&Bar::default(), &method, 8);
        if [ShapeName::Cpgimp, ShapeName::Cpdi].contains(&shape) {
            let refusal = result.unwrap_err();
            assert_eq!(refusal, Refusal::NothingToFollow { shape: shape.name() });
            assert!(refusal.to_string().contains("the nearest is `ugimp`"), "{refusal}");
        } else {
            assert!(result.is_ok(), "{shape}: {result:?}");
        }
    }
}

#[test]
fn numbers_for_another_dimension_are_refused() {
    let two = || "8x4".parse::<Division>().unwrap();
    let refusal = refused(&Wave::bar(), Setup::default(), &two());
    let (what, given) = ("cells", 2);
    assert_eq!(refusal, Refusal::WrongDimension { what, given, dimension: 1 });
    let setup = Setup { particles_per_cell: two(), ..Setup::default() };
    let refusal = refused(&Wave::bar(), setup, &8.into());
    let what = "particles per cell";
    assert_eq!(refusal, Refusal::WrongDimension { what, given, dimension: 1 });
}

#[test]
fn fractions_outside_their_range_are_refused() {
    for value in [-0.1, 1.1, f64::NAN] {
        let flip = Transfer::Flip { fraction: value };
        for setup in [
            Setup { transfer: flip, ..Setup::default() },
            Setup { jitter: value, ..Setup::default() },
            Setup { offset: [0.0, value, 0.0], ..Setup::default() },
        ] {
            let refusal = refused(&Wave::bar(), setup, &8.into());
            let Refusal::OutOfRange { value: found, .. } = refusal else { panic!("{refusal}") };
            assert!(found == value || found.is_nan() && value.is_nan(), "{found}");
        }
    }
}

/// A period has to be a whole number of cells of a box, and the field has to repeat itself.
#[test]
fn axes_that_are_not_periodic_are_refused() {
    let periodic =
        |axis: usize| Setup { periodic: std::array::from_fn(|a| a == axis), ..Setup::default() };
    let refusal = refused(&sector(Face::Outer, Condition::Free), periodic(0), &8.into());
    assert!(matches!(refusal, Refusal::NoPeriod { axis: 0, is_box: false, .. }), "{refusal}");
    let refusal = refused(&Wave::on_box([1.0, 0.55]), periodic(1), &8.into());
    assert!(matches!(refusal, Refusal::NoPeriod { axis: 1, is_box: true, .. }), "{refusal}");
    assert!(refusal.to_string().starts_with("axis y cannot be periodic"), "{refusal}");
    // Between two knots, for any origin of the grid.
    let offset = Setup { offset: [0.25; 3], ..periodic(1) };
    let refusal = refused(&Wave::on_box([1.0, 0.5]), offset, &1.into());
    assert!(matches!(refusal, Refusal::NoPeriod { axis: 1, is_box: true, .. }), "{refusal}");
    let refusal = refused(&Wave::on_box([1.0, 0.5]), periodic(1), &8.into());
    assert_eq!(refusal, Refusal::NotPeriodic { axis: 1 });
    // sin p = sin(q + p) at the start only.
    let phase = Vector::repeat((std::f64::consts::PI - 1.0) / 2.0);
    let once = Wave { vectors: Matrix::repeat(1.0), phase, ..Wave::bar() };
    assert_eq!(refused(&once, periodic(0), &8.into()), Refusal::NotPeriodic { axis: 0 });
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
    let of_bar = |setup: Setup, cells: usize| refused(&bar, setup, &cells.into());
    assert!(not_positive(of_bar(Setup::default(), 0)));
    let none = Division::Uniform(0);
    assert!(not_positive(of_bar(Setup { particles_per_cell: none, ..Setup::default() }, 8)));
    for number in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(not_positive(of_bar(Setup { courant: number, ..Setup::default() }, 8)), "{number}");
        let time_step = Some(number);
        assert!(not_positive(of_bar(Setup { time_step, ..Setup::default() }, 8)), "{number}");
    }
    let end_time = Some(0.0); // the window starts there
    assert!(not_positive(of_bar(Setup { end_time, ..Setup::default() }, 8)));
    let theta = [0.0, 1.0];
    let inside_out = Wave::on(Body::Annulus { inner: 1.0, outer: 0.5, theta });
    assert!(not_positive(refused(&inside_out, Setup::default(), &8.into())));
    let too_large = |refusal: Refusal| matches!(refusal, Refusal::TooLarge { .. });
    assert!(too_large(of_bar(Setup::default(), usize::MAX)));
    assert!(too_large(of_bar(Setup { courant: 1e-300, ..Setup::default() }, 8)));
    let amplitude = Bar { amplitude: 1e300, ..Bar::default() };
    assert!(too_large(refused(&amplitude, Setup::default(), &8.into())));
    let amplitude = Bar { amplitude: f64::NAN, ..Bar::default() };
    let odd = refused(&amplitude, Setup::default(), &8.into());
    assert!(matches!(odd, Refusal::FieldNotFinite { quantity: "displacement", .. }));
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
        let mut progress = 0;
        let level = run_level(&field, &method, &8.into(), &mut |step, _| progress = step).unwrap();
        assert_eq!(progress, 5, "{integrator}");
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

/// Waves are fastest at the far end of the bar.
#[test]
fn a_step_above_the_stable_one_is_blamed_on_the_fastest_particle() {
    let field = Spoilt { faster: 1.0, ..Spoilt::domain(|_| ()) };
    let fastest_wave = Some(4.0 * 1e3_f64.sqrt());
    let setup = Setup { fastest_wave, courant: 0.6, ..Setup::default() };
    let level = run(&field, &with(setup), 8).unwrap();
    let last = level.particles - 1;
    let failure = failure(level);
    assert!(matches!(failure.cause, Cause::UnstableStep { .. }), "{failure}");
    assert_eq!(failure.particle, Some(last));
}

/// The Courant number is far above every method's largest stable one.
#[test]
fn an_unstable_run_stops() {
    for mut method in methods() {
        method.setup.courant = 5.0;
        let failure = failure(run::<f64>(&Bar::default(), &method, 64).unwrap());
        assert!(failure.step > 0, "{method:?}: {failure}");
    }
}

/// One particle per cell and a stretch of more than two: the domain is wider than the stencil.
#[test]
fn a_domain_wider_than_the_stencil_stops_the_run() {
    let bar = Bar { amplitude: 0.9, ..Bar::default() };
    let method = with(Setup { particles_per_cell: 1.into(), ..Setup::default() });
    let failure = failure(run::<f64>(&bar, &method, 16).unwrap());
    assert!(matches!(failure.cause, Cause::HalfWidth { .. }), "{failure}");
    assert!(failure.to_string().contains("more particles per cell"));
}

/// A wall has to be on a plane of nodes, due to the number of cells or to the grid's offset.
#[test]
fn a_wall_between_nodes_is_refused() {
    let field = Affine { upper: [1.0, 0.55, 1.0], ..Affine::flight([0.0; 3]) };
    let field = Affine { faces: vec![(Face::Max(1), Condition::Roller)], ..field };
    let field: &dyn ManufacturedField<f64, 2> = &field;
    let solver = |cells: usize, offset: f64| {
        let setup = Setup { offset: [0.0, offset, 0.0], ..Setup::default() };
        let method = Method { setup, ..Method::default() };
        <f64 as Solve<2>>::solver(field, &method, &cells.into())
    };
    for (cells, offset) in [(8, 0.0), (20, 0.5)] {
        let refused = solver(cells, offset).err();
        assert!(matches!(refused, Some(Refusal::WallBetweenNodes { face: Face::Max(1), .. })));
    }
    // 4.4 cells, and 0.6 of one before them.
    for (cells, offset) in [(20, 0.0), (8, 0.6)] {
        let solver = solver(cells, offset).unwrap_or_else(|refusal| panic!("{refusal}"));
        let volume: f64 = solver.present().particles.reference_volume.iter().sum();
        assert!((volume - 0.55).abs() < 1e-12, "the particles' domains fill the body: {volume}");
    }
}
