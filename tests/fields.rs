//! Properties that hold for every field. The build script finds the files in `fields/` and calls
//! `field_tests!` once for each.

mod current;
mod support;

use std::collections::BTreeSet;
use std::sync::Arc;

use mms_analysis::visibility::{Status, Term, Visibility};
use mms_codegen::certify::closed_form::{ClosedFormVerdict, compare};
use mms_codegen::{Compiled, Options};
use mms_interpreted::Interpretable;
use mms_mechanics::Output;
use mms_mechanics::invariant::InvariantKind;
use mms_mechanics::sample::Sample;
use mms_program::interpret::{Interpreter, Point};
use mms_runtime::convergence::{ExpectedOrder, TOLERANCE, Verdict};
use mms_runtime::math::Scalar as _;
use mms_runtime::scene::{Scene, Solvable};
use mms_runtime::study::judge;
use mms_runtime::{Method, StudyLevel};
use mms_spec::Form;
use mms_spec::StudySpec;
use mms_spec::quantity::Quantity;

use current::both_frames;
use support::dual::Dual;
use support::kernel::{Kernel, compiled, kernel, sample};

macro_rules! field_tests {
    ($name:ident) => {
        mod $name {
            crate::kernel!($name);

            #[test]
            fn displacement_gives_velocity_acceleration_and_gradient_by_dual_numbers() {
                crate::kinematics_by_dual_numbers::<Field>();
            }

            #[test]
            fn energy_gives_stress_by_dual_numbers() {
                crate::stress_by_dual_numbers::<Field>();
            }

            #[test]
            fn material_sees_no_rotation_and_is_free_of_stress_at_rest() {
                crate::objectivity::<Field>();
            }

            #[test]
            fn stress_measures_agree() {
                crate::stress_measures::<Field>();
            }

            #[test]
            fn strains_and_densities_agree() {
                crate::strains_and_densities::<Field>();
            }

            #[test]
            fn both_frames_agree_by_finite_differences() {
                crate::both_frames::<Field>();
            }

            #[test]
            fn momentum_balances_by_finite_differences() {
                crate::balance_by_finite_differences::<Field>();
            }

            #[test]
            fn emitted_code_agrees_with_the_interpreter() {
                crate::emitted_and_interpreted::<Field>();
            }

            #[test]
            fn closed_forms_hold() {
                crate::closed_forms::<Field>();
            }

            #[test]
            fn studies_show_their_order() {
                crate::studies::<Field>();
            }
        }
    };
}

include!(concat!(env!("OUT_DIR"), "/field_tests.rs"));

/// Largest magnitude of a quantity's components over points.
fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |largest, value| {
        assert!(value.is_finite(), "a value is {value}");
        value.abs().max(largest)
    })
}

/// v, a and H against derivatives of u by hyper-dual numbers. Both sides round some tens of
/// operations.
fn kinematics_by_dual_numbers<K: Kernel>() {
    let points = sample(compiled(K::NAME), 64);
    let constants = |point: &[f64]| point.iter().map(|x| Dual::constant(*x)).collect::<Vec<_>>();
    let displacement = |time, point: &[Dual]| K::quantity(Quantity::Displacement, time, point);
    let mut pairs = [const { Vec::<(f64, f64)>::new() }; 3];
    for point in &points {
        let (time, at) = (point.time, &point.coordinates);
        let moving = displacement(Dual::variable(time, 1.0, 1.0), &constants(at));
        let velocity = K::quantity(Quantity::Velocity, time, at);
        let acceleration = K::quantity(Quantity::Acceleration, time, at);
        pairs[0].extend(velocity.into_iter().zip(moving.iter().map(|u| u.0.eps1)));
        pairs[1].extend(acceleration.into_iter().zip(moving.iter().map(|u| u.0.eps1eps2)));
        let gradient = K::quantity(Quantity::DisplacementGradient, time, at);
        let rows = rows::<K>();
        for axis in 0..K::DIMENSION {
            let mut shifted = constants(at);
            shifted[axis] = Dual::variable(at[axis], 1.0, 0.0);
            let slope = displacement(Dual::constant(time), &shifted);
            let column = gradient.iter().skip(axis).step_by(rows).copied();
            pairs[2].extend(column.zip(slope.iter().map(|u| u.0.eps1)));
        }
        if rows > K::DIMENSION {
            let moved = K::quantity(Quantity::Displacement, time, at);
            pairs[2].push((gradient[rows * rows - 1], moved[0] / at[0]));
        }
    }
    for (what, pairs) in ["velocity", "acceleration", "displacement_gradient"].iter().zip(pairs) {
        let scale = largest(pairs.iter().map(|(_, dual)| *dual));
        for (symbolic, dual) in pairs {
            let bound = 256.0 * f64::EPSILON * scale;
            assert!(
                (symbolic - dual).abs() <= bound,
                "{what}: {symbolic:e}, by dual numbers {dual:e}"
            );
        }
    }
}

/// The number of rows of a tensor: one per coordinate, and the hoop row of an axisymmetric field.
fn rows<K: Kernel>() -> usize {
    compiled(K::NAME).field.space.rows()
}

/// The displacement gradients of the field at its points.
fn gradients<K: Kernel>(count: usize) -> Vec<(Vec<f64>, f64, Vec<f64>)> {
    let points = sample(compiled(K::NAME), count).into_iter();
    points
        .map(|point| {
            let gradient =
                K::quantity(Quantity::DisplacementGradient, point.time, &point.coordinates);
            (point.coordinates, point.time, gradient)
        })
        .collect()
}

/// P_iJ = dW/dF_iJ against the derivative of W by dual numbers; F and H differ by a constant.
fn stress_by_dual_numbers<K: Kernel>() {
    let mut pairs = Vec::new();
    for (point, time, gradient) in gradients::<K>(64) {
        let constants =
            |values: &[f64]| values.iter().map(|v| Dual::constant(*v)).collect::<Vec<_>>();
        let stress = K::material_first_piola_kirchhoff(time, &point, &gradient);
        for (component, stress) in stress.into_iter().enumerate() {
            let mut strained = constants(&gradient);
            strained[component] = Dual::variable(gradient[component], 1.0, 0.0);
            let energy =
                K::material_strain_energy(Dual::constant(time), &constants(&point), &strained);
            pairs.push((stress, energy.0.eps1));
        }
    }
    // W is a difference of terms of the size of the modulus, whose rounding counts.
    let modulus = modulus::<K>();
    for (symbolic, dual) in pairs {
        let bound = 64.0 * f64::EPSILON * modulus;
        assert!((symbolic - dual).abs() <= bound, "P: {symbolic:e}, by dual numbers {dual:e}");
    }
}

/// P = 0 at F = I unless given fields press; and, unless the material declares otherwise, W(Q F) = W(F) and P(Q F) = Q P(F), at
/// the gradients of the field and for rotations Q in each plane.
fn objectivity<K: Kernel>() {
    let is_indifferent = compiled(K::NAME).material.frame_indifferent;
    // F rounds by eps, which changes W and P by the modulus times eps.
    let bound = 64.0 * f64::EPSILON * modulus::<K>();
    let is_free = compiled(K::NAME).model.givens.is_empty();
    for (index, (point, time, gradient)) in gradients::<K>(64).into_iter().enumerate() {
        let undeformed = vec![0.0; gradient.len()];
        for stress in K::material_first_piola_kirchhoff(time, &point, &undeformed) {
            assert!(!is_free || stress.abs() <= bound, "P = {stress:e} at F = I");
        }
        for plane in [[0, 1], [1, 2], [2, 0]] {
            if is_indifferent && plane.iter().all(|axis| *axis < rows::<K>()) {
                rotated_in_a_plane::<K>((&point, time), &gradient, plane, index as f64, bound);
            }
        }
    }
}

fn rotated_in_a_plane<K: Kernel>(
    (point, time): (&[f64], f64),
    gradient: &[f64],
    [first, second]: [usize; 2],
    angle: f64,
    bound: f64,
) {
    let (sin, cos) = angle.sin_cos();
    let dimension = rows::<K>();
    let rotated = |tensor: &[f64]| {
        let mut rotated = tensor.to_vec();
        for column in 0..dimension {
            let [k, l] = [first, second].map(|row| row * dimension + column);
            rotated[k] = cos * tensor[k] - sin * tensor[l];
            rotated[l] = sin * tensor[k] + cos * tensor[l];
        }
        rotated
    };
    let unit = |k: usize| if k / dimension == k % dimension { 1.0 } else { 0.0 };
    let deformation: Vec<_> = gradient.iter().enumerate().map(|(k, h)| h + unit(k)).collect();
    let turned = rotated(&deformation);
    let turned: Vec<_> = turned.iter().enumerate().map(|(k, f)| f - unit(k)).collect();
    let [before, after] =
        [gradient, &turned].map(|gradient| K::material_strain_energy(time, point, gradient));
    assert!((after - before).abs() <= bound, "W: {before:e}, of the rotated F {after:e}");
    let [before, after] = [gradient, &turned]
        .map(|gradient| K::material_first_piola_kirchhoff(time, point, gradient));
    for (before, after) in rotated(&before).into_iter().zip(after) {
        assert!((after - before).abs() <= bound, "Q P: {before:e}, P of Q F {after:e}");
    }
}

/// d2W/dF_11^2 at F = I.
fn modulus<K: Kernel>() -> f64 {
    let first = sample(compiled(K::NAME), 1).remove(0);
    let constants: Vec<_> = first.coordinates.iter().map(|x| Dual::constant(*x)).collect();
    let mut gradient = vec![Dual::constant(0.0); rows::<K>().pow(2)];
    gradient[0] = Dual::variable(0.0, 1.0, 1.0);
    K::material_strain_energy(Dual::constant(first.time), &constants, &gradient).0.eps1eps2
}

/// F and J in the definitions of stresses and densities: at small strain the present configuration is the reference.
fn carriers<K: Kernel>(deformation: &[f64], jacobian: f64) -> (Vec<f64>, f64) {
    let dimension = rows::<K>();
    match compiled(K::NAME).model.kind {
        InvariantKind::SmallStrain => {
            let unit = |k: usize| f64::from(u8::from(k / dimension == k % dimension));
            ((0..dimension * dimension).map(unit).collect(), 1.0)
        }
        _ => (deformation.to_vec(), jacobian),
    }
}

/// The field's stresses equal the stresses of its material at its gradient, and tau = P F^T, sigma = tau/J, nominal
/// stress = P^T, traction = P N; at small strain tau = sigma = P.
fn stress_measures<K: Kernel>() {
    let dimension = rows::<K>();
    let modulus = modulus::<K>();
    for (point, time, gradient) in gradients::<K>(64) {
        // The material gets a rounded H, and its stress changes by the modulus times |F|^2.
        let stretch: f64 = gradient.iter().map(|h| h * h).sum::<f64>() + 1.0;
        let bound = 64.0 * f64::EPSILON * modulus * stretch;
        let close = |what: &str, a: f64, b: f64| {
            assert!((a - b).abs() <= bound, "{what}: {a:e} and {b:e}");
        };
        let of = |quantity| K::quantity(quantity, time, &point);
        let (first, nominal) = (of(Quantity::FirstPiolaKirchhoff), of(Quantity::NominalStress));
        let (kirchhoff, cauchy) = (of(Quantity::KirchhoffStress), of(Quantity::CauchyStress));
        let (deformation, jacobian) =
            (of(Quantity::DeformationGradient), of(Quantity::Jacobian)[0]);
        let (carrier, volume) = carriers::<K>(&deformation, jacobian);
        let traction = of(Quantity::Traction);
        let response = K::material_first_piola_kirchhoff(time, &point, &gradient);
        let response_kirchhoff = K::material_kirchhoff_stress(time, &point, &gradient);
        for k in 0..dimension * dimension {
            let (row, column) = (k / dimension, k % dimension);
            let product = |by: &[f64]| -> f64 {
                let pairs =
                    (0..dimension).map(|axis| (row * dimension + axis, column * dimension + axis));
                pairs.map(|(a, b)| first[a] * by[b]).sum()
            };
            close("P of the field and of the material", first[k], response[k]);
            close("P F^T of the material", response_kirchhoff[k], product(&deformation));
            close("tau = P F^T", kirchhoff[k], product(&carrier));
            close("sigma = tau/J", cauchy[k] * volume, kirchhoff[k]);
            close("nominal stress = P^T", nominal[column * dimension + row], first[k]);
        }
        for row in 0..traction.len() {
            close("traction = P N, N along the first axis", traction[row], first[row * dimension]);
        }
    }
}

/// x - X = u, C = F^T F, B = F F^T, 2 E = C - I, rho J = rho0, J div sigma = Div P and
/// J (rho b) = rho0 b; without J at small strain.
fn strains_and_densities<K: Kernel>() {
    let dimension = rows::<K>();
    let close = |what: &str, a: f64, b: f64, scale: f64| {
        let bound = 64.0 * f64::EPSILON * scale;
        assert!((a - b).abs() <= bound, "{what}: {a:e} and {b:e}");
    };
    let gradients = gradients::<K>(64);
    // Quantities from relations round like the largest values, not like the values at the point.
    let strain = largest(gradients.iter().flat_map(|(_, _, gradient)| gradient).copied());
    let stretch = (1.0 + strain) * (1.0 + strain);
    let [divergence, force] = [Quantity::DivP, Quantity::BodyForceDensity].map(|quantity| {
        let values = gradients.iter().map(|(point, time, _)| K::quantity(quantity, *time, point));
        largest(values.flatten())
    });
    for (point, time, gradient) in gradients {
        let of = |quantity| K::quantity(quantity, time, &point);
        let (displacement, position) = (of(Quantity::Displacement), of(Quantity::Position));
        for axis in 0..K::DIMENSION {
            let size = largest([position[axis], point[axis]]);
            close("x - X = u", position[axis] - point[axis], displacement[axis], size);
        }
        let deformation = of(Quantity::DeformationGradient);
        let (right, left) = (of(Quantity::RightCauchyGreen), of(Quantity::LeftCauchyGreen));
        let lagrange = of(Quantity::GreenLagrange);
        for k in 0..dimension * dimension {
            let (row, column) = (k / dimension, k % dimension);
            let at = |row: usize, column: usize| row * dimension + column;
            let product =
                |first: &dyn Fn(usize) -> usize, second: &dyn Fn(usize) -> usize| -> f64 {
                    (0..dimension).map(|j| deformation[first(j)] * deformation[second(j)]).sum()
                };
            let columns = product(&|j| at(j, row), &|j| at(j, column));
            let rows = product(&|j| at(row, j), &|j| at(column, j));
            close("C = F^T F", right[k], columns, stretch);
            close("B = F F^T", left[k], rows, stretch);
            let slope: f64 =
                (0..dimension).map(|j| gradient[at(j, row)] * gradient[at(j, column)]).sum();
            let twice = gradient[k] + gradient[at(column, row)] + slope;
            close("2 E = H + H^T + H^T H", 2.0 * lagrange[k], twice, strain * (1.0 + strain));
        }
        let (_, jacobian) = carriers::<K>(&deformation, of(Quantity::Jacobian)[0]);
        let density = K::density(&point);
        close("rho J = rho0", of(Quantity::MassDensity)[0] * jacobian, density, density);
        for (current, reference, size) in [
            (Quantity::DivSigma, Quantity::DivP, divergence),
            (Quantity::CurrentBodyForceDensity, Quantity::BodyForceDensity, force),
        ] {
            let (current, reference) = (of(current), of(reference));
            for (current, reference) in current.into_iter().zip(reference) {
                close("J times what is per current volume", current * jacobian, reference, size);
            }
        }
    }
}

/// rho0 a - Div P - rho0 b with Div P from central differences of P: the residual must vanish like the square of the step.
fn balance_by_finite_differences<K: Kernel>() {
    let points = sample(compiled(K::NAME), 32);
    let coordinates = points.iter().flat_map(|point| &point.coordinates).copied();
    let size = largest(coordinates);
    let residual = |step: f64| {
        let at =
            points.iter().map(|point| momentum_residual::<K>(&point.coordinates, point.time, step));
        at.fold([0.0; 2], |[residual, scale], [r, s]| [r.max(residual), s.max(scale)])
    };
    let [(coarse, scale), (fine, _)] = [size / 64.0, size / 128.0].map(|step| {
        let [residual, scale] = residual(step);
        (residual, scale)
    });
    // If P is at most quadratic in X, the differences are exact, and only rounding is left.
    if coarse > 1e-9 * scale {
        let order = (coarse / fine).log2();
        assert!(
            (order - 2.0).abs() < 0.2,
            "the residual {coarse:e} shrinks to {fine:e}: order {order}"
        );
    }
    assert!(fine < 0.02 * scale, "the residual is {fine:e}, the terms are {scale:e}");
}

/// The terms (P_RR - P_tt)/R and P_ZR/R of a divergence, at the distance R from the axis.
fn spreading(stress: &[f64], radius: f64) -> [f64; 2] {
    [(stress[0] - stress[8]) / radius, stress[3] / radius]
}

/// The largest component of the residual, and of its terms.
fn momentum_residual<K: Kernel>(at: &[f64], time: f64, step: f64) -> [f64; 2] {
    let (dimension, width) = (K::DIMENSION, rows::<K>());
    let (mut divergence, mut slopes) = (vec![0.0; dimension], vec![0.0_f64; dimension]);
    if width > dimension {
        let stress = K::quantity(Quantity::FirstPiolaKirchhoff, time, at);
        let spread = spreading(&stress, at[0]);
        (divergence, slopes) = (spread.to_vec(), spread.map(f64::abs).to_vec());
    }
    for axis in 0..dimension {
        let stress = |sign: f64| {
            let mut shifted = at.to_vec();
            shifted[axis] += sign * step;
            K::quantity(Quantity::FirstPiolaKirchhoff, time, &shifted)
        };
        let (ahead, behind) = (stress(1.0), stress(-1.0));
        for (row, divergence) in divergence.iter_mut().enumerate() {
            let k = row * width + axis;
            let slope = (ahead[k] - behind[k]) / (2.0 * step);
            *divergence += slope;
            slopes[row] = slopes[row].max(slope.abs());
        }
    }
    let density = K::density(at);
    let acceleration = K::quantity(Quantity::Acceleration, time, at);
    let force = K::quantity(Quantity::BodyForce, time, at);
    let force_density = K::quantity(Quantity::BodyForceDensity, time, at);
    let rows = (0..dimension).map(|row| {
        let (inertia, body) = (density * acceleration[row], density * force[row]);
        let bound = 64.0 * f64::EPSILON * largest([inertia, body, divergence[row]]);
        assert!(
            (body - force_density[row]).abs() <= bound,
            "rho0 b: {body:e}, {:e}",
            force_density[row]
        );
        // In equilibrium without a force only the slopes of the stress are large.
        [(inertia - divergence[row] - body).abs(), largest([inertia, body, slopes[row]])]
    });
    rows.fold([0.0; 2], |[residual, scale], [r, s]| [r.max(residual), s.max(scale)])
}

/// Compiled code and the interpreter run the same program; they may differ only where the compiler contracts or reorders,
/// which Rust does not.
fn emitted_and_interpreted<K: Kernel>() {
    let compiled = compiled(K::NAME);
    let points = sample(compiled, 64);
    let late = points.iter().cloned().map(|point| Sample { time: 1e6 * point.time, ..point });
    let late: Vec<_> = late.collect();
    for quantity in Quantity::pointwise() {
        for (points, is_late) in [(&points, false), (&late, true)] {
            agree_in_double::<K>(compiled, points, quantity, is_late);
            agree_in_single::<K>(compiled, points, quantity, is_late);
        }
    }
}

type Points = [Sample<f64>];

fn agree_in_double<K: Kernel>(
    compiled: &Compiled,
    points: &Points,
    quantity: Quantity,
    is_late: bool,
) {
    let parameters = compiled.parameters::<f64>(&Default::default());
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    let plan = interpreter.plan(&[Output::Quantity(quantity)]);
    for point in points {
        interpreter.set_time(&point.time);
        interpreter.set_point(&plan, Point::at(&point.coordinates));
        let interpreted = interpreter.output(Output::Quantity(quantity));
        let emitted = K::quantity(quantity, point.time, &point.coordinates);
        assert!(are_same(&interpreted, &emitted, is_late), "{} in f64", quantity.name());
    }
}

fn agree_in_single<K: Kernel>(
    compiled: &Compiled,
    points: &Points,
    quantity: Quantity,
    is_late: bool,
) {
    let parameters = compiled.parameters::<f32>(&Default::default());
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    let plan = interpreter.plan(&[Output::Quantity(quantity)]);
    for point in points {
        let coordinates: Vec<_> = point.coordinates.iter().map(|x| f32::from_f64(*x)).collect();
        let time = f32::from_f64(point.time);
        interpreter.set_time(&time);
        interpreter.set_point(&plan, Point::at(&coordinates));
        let interpreted = interpreter.output(Output::Quantity(quantity));
        let emitted = K::quantity(quantity, time, &coordinates);
        assert!(are_same(&interpreted, &emitted, is_late), "{} in f32", quantity.name());
    }
}

/// Whether numbers are equal. Long after the time window some may be NaN, whose bits are not compared.
fn are_same<T: PartialOrd>(found: &[T], expected: &[T], is_late: bool) -> bool {
    let is_none = |number: &T| is_late && number.partial_cmp(number).is_none();
    let same = |(a, b): (&T, &T)| a == b || is_none(a) && is_none(b);
    found.len() == expected.len() && found.iter().zip(expected).all(same)
}

/// Every `[[check]]` of the file, in arbitrary precision.
fn closed_forms<K: Kernel>() {
    for comparison in compare(compiled(K::NAME)) {
        assert!(matches!(comparison.verdict, ClosedFormVerdict::Agrees), "{comparison:?}");
    }
}

/// Every kind of term occurs in some field, and so do every parameter of a material and every face.
#[test]
fn the_gallery_leaves_no_term_unseen() {
    let mut asked: BTreeSet<String> = Term::KINDS.iter().map(|kind| kind.to_string()).collect();
    let mut seen = BTreeSet::new();
    for entry in mms_exact::gallery::FIELDS {
        let compiled = compiled(entry.name);
        let visibility = Visibility::of(compiled).expect("the gallery is within the bound");
        for (term, status) in &visibility.findings {
            let name = match term {
                Term::Parameter(name) => format!("{}.{name}", compiled.material.name.shown()),
                _ => term.name(),
            };
            if *status == Status::Present {
                seen.extend([name.clone(), term.kind().to_string()]);
            }
            asked.insert(name);
        }
    }
    let unseen: Vec<_> = asked.difference(&seen).collect();
    assert!(unseen.is_empty(), "no field of the gallery sees {unseen:?}");
}

/// Every `[[study]]` of the file, interpreted: to the bits of compiled code, which is not optimised here.
fn studies<K: Kernel>() {
    let field = &compiled(K::NAME).field;
    for study in &field.studies {
        let mut method = method(study);
        method.setup.relax = field.is_static();
        let levels = if study.precision.as_deref() == Some("f32") {
            levels(scene::<f32>(K::NAME, study), study, &method)
        } else {
            levels(scene::<f64>(K::NAME, study), study, &method)
        };
        let tolerance = study.tolerance.unwrap_or(TOLERANCE);
        let judgement = judge(&levels, ExpectedOrder::new(study.order, tolerance));
        assert_eq!(judgement.verdict(), Verdict::Pass, "{judgement:?}\n{levels:#?}");
    }
}

/// The field in the form that a study names.
fn scene<T: Interpretable>(name: &str, study: &StudySpec) -> Scene<T> {
    let form = study.form.as_deref().map(|form| Form::from_name(form).expect("a form"));
    let compiled = match form {
        None | Some(Form::Stable) => compiled(name).clone(),
        Some(form) => {
            let entry = mms_exact::gallery::find(name).expect("a field of the gallery");
            let options = Options { form, ..Options::default() };
            entry.compile_with(&options).expect("a field of the gallery")
        }
    };
    let scene = mms_interpreted::scene(Arc::new(compiled), &Default::default());
    scene.expect("a field without a swirl")
}

/// The method of a study, with the command's defaults for omitted keys.
fn method(study: &StudySpec) -> Method {
    /// The member of a family that the file names.
    fn named<N: std::str::FromStr>(word: &str) -> N {
        word.parse().unwrap_or_else(|_| panic!("the solver has no `{word}`"))
    }
    let mut method = Method {
        shape: named(&study.shape),
        integrator: named(&study.integrator),
        ..Method::default()
    };
    if let Some(formulation) = &study.formulation {
        method.formulation = named(formulation);
    }
    if let Some(transfer) = &study.transfer {
        method.setup.transfer = named(transfer);
    }
    method.setup.fill = study.fill.as_deref().map(named);
    if let Some(number) = study.particles_per_cell {
        method.setup.particles_per_cell = number.into();
    }
    method.setup.courant = study.courant.unwrap_or(method.setup.courant);
    method
}

fn levels<T: Solvable>(scene: Scene<T>, study: &StudySpec, method: &Method) -> Vec<StudyLevel> {
    let cells = if study.cells.is_empty() { scene.default_cells() } else { &study.cells };
    let level = |&cells: &usize| {
        let progress = &mut ();
        scene.run_level(method, &cells.into(), progress).expect("a scene for the solver")
    };
    cells.iter().map(level).collect()
}
