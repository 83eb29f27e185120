//! Rigid twins of every field: the same motion, followed by a rotation and a translation. The expected values are computed
//! here by plain arithmetic in 77 digits; and twins are solutions of their own.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use mms_codegen::{Compiled, Options, Selection};
use mms_exact::gallery::{Entry, FIELDS};
use mms_mechanics::Response;
use mms_mechanics::sample::{Sample, samples};
use mms_mechanics::{Bound, Output};
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_runtime::math::Scalar as _;
use mms_spec::quantity::Quantity;
use mms_spec::twin::Twin;
use rayon::prelude::*;

use crate::sampled::sampled;

/// The number of points per field.
const POINTS: usize = 3;

type Vector = Vec<Precise>;
/// Row-major.
type Matrix = Vec<Precise>;

fn number(value: f64) -> Precise {
    Precise::from_f64(value)
}

fn times(a: &Matrix, b: &Matrix, dimension: usize) -> Matrix {
    let entry = |k: usize| {
        let (row, column) = (k / dimension, k % dimension);
        (0..dimension).fold(number(0.0), |sum, m| {
            sum + a[row * dimension + m].clone() * b[m * dimension + column].clone()
        })
    };
    (0..dimension * dimension).map(entry).collect()
}

fn applied(a: &Matrix, v: &Vector) -> Vector {
    let rows = a.chunks_exact(v.len());
    rows.map(|row| row.iter().zip(v).fold(number(0.0), |sum, (a, v)| sum + a.clone() * v.clone()))
        .collect()
}

fn transposed(a: &Matrix, dimension: usize) -> Matrix {
    (0..dimension * dimension)
        .map(|k| a[k % dimension * dimension + k / dimension].clone())
        .collect()
}

fn scaled(a: &[Precise], factor: &Precise) -> Vec<Precise> {
    a.iter().map(|a| a.clone() * factor.clone()).collect()
}

fn plus(a: &[Precise], b: &[Precise]) -> Vec<Precise> {
    a.iter().zip(b).map(|(a, b)| a.clone() + b.clone()).collect()
}

/// A field evaluated in 77 digits, with the defaults of its parameters.
struct Field {
    compiled: Compiled,
    parameters: Vec<Precise>,
}

/// The name of each field that is tried and has a standard twin, the field, and the twin.
static TWINS: LazyLock<Vec<(&str, Field, Field)>> = LazyLock::new(|| {
    let twins = sampled(FIELDS, 4).into_par_iter().filter_map(|entry| {
        let (inner, twin) = with_twin(entry)?;
        Some((entry.name, inner, twin))
    });
    twins.collect()
});

/// A field and its standard twin; `None` if the field is static, or if the material is not frame-indifferent and says so.
fn with_twin(entry: &Entry) -> Option<(Field, Field)> {
    let inner = entry.compile().unwrap_or_else(|error| panic!("{error}"));
    if inner.field.space.is_axisymmetric() {
        // It is moved along its axis only: mms-codegen/tests/axisymmetric.rs.
        return None;
    }
    let options = Options::from(Selection { twin: Twin::Standard, ..Selection::default() });
    match entry.compile_with(&options) {
        Ok(twin) => {
            assert!(inner.material.frame_indifferent, "{}", entry.name);
            Some((Field::of(inner), Field::of(twin)))
        }
        Err(failure) if inner.field.is_static() => {
            assert!(failure.to_string().contains("has no standard twin"), "{failure}");
            None
        }
        Err(failure) => {
            assert!(!inner.material.frame_indifferent, "{failure}");
            assert!(failure.to_string().contains("it is not frame-indifferent"), "{failure}");
            None
        }
    }
}

impl Field {
    fn of(compiled: Compiled) -> Self {
        let parameters = compiled.parameters(&Default::default());
        Field { compiled, parameters }
    }

    fn quantity(&self, quantity: Quantity, time: &Precise, at: &[Precise]) -> Vec<Precise> {
        let mut interpreter = Interpreter::new(&self.compiled.program, &self.parameters);
        interpreter.set_time(time);
        let output = Output::Quantity(quantity);
        let plan = interpreter.plan(&[output]);
        interpreter
            .set_point(&plan, Point { coordinates: at, normal: &self.normal(), gradient: &[] });
        interpreter.output(output)
    }

    fn response(
        &self,
        response: Response,
        time: &Precise,
        at: &[Precise],
        gradient: &[Precise],
    ) -> Vec<Precise> {
        let mut interpreter = Interpreter::new(&self.compiled.program, &self.parameters);
        interpreter.set_time(time);
        let output = Output::Response(response);
        let plan = interpreter.plan(&[output]);
        interpreter.set_point(&plan, Point { coordinates: at, normal: &[], gradient });
        interpreter.output(output)
    }

    fn bound(&self, bound: Bound) -> Vec<Precise> {
        Interpreter::new(&self.compiled.program, &self.parameters).output(Output::Bound(bound))
    }

    fn normal(&self) -> Vec<Precise> {
        [0.48, 0.6, 0.64][..self.dimension()].iter().map(|n| number(*n)).collect()
    }

    fn dimension(&self) -> usize {
        self.compiled.field.dimension
    }

    fn points(&self) -> Vec<Sample<Precise>> {
        samples(&self.compiled.program, &self.parameters, POINTS)
    }

    /// The length of the body along X, or its outer radius.
    fn size(&self) -> Precise {
        match self.compiled.field.domain.body {
            mms_spec::BodySpec::Box { .. } => {
                self.bound(Bound::Upper)[0].clone() - self.bound(Bound::Lower)[0].clone()
            }
            _ => self.bound(Bound::Outer)[0].clone(),
        }
    }
}

/// Q, Q', Q'', d, d' and d'' of the standard motion at a time, by hand.
struct Motion {
    rotation: [Matrix; 3],
    translation: [Vector; 3],
}

impl Motion {
    /// With K the cross product with the unit axis (2, -1, 2)/3, a quarter turn in the plane:
    /// Q = I + sin a K + (1 - cos a) K^2, Q' = a' K Q, Q'' = (a'' K + a'^2 K^2) Q.
    fn standard(field: &Field, time: &Precise) -> Self {
        let dimension = field.dimension();
        let window = field.bound(Bound::Time);
        let duration = window[1].clone() - window[0].clone();
        let rate = number(1.0) / duration.clone();
        let s = (time.clone() - window[0].clone()) / duration;
        let third = number(1.0) / number(3.0);
        let quarter: Matrix = match dimension {
            1 => vec![number(0.0)],
            2 => [0.0, -1.0, 1.0, 0.0].map(number).to_vec(),
            _ => scaled(&[0.0, -2.0, -1.0, 2.0, 0.0, -2.0, 1.0, 2.0, 0.0].map(number), &third),
        };
        let square = times(&quarter, &quarter, dimension);
        let angle = s.clone() + s.clone() * s.clone();
        let swing = rate.clone() * (number(1.0) + number(2.0) * s.clone());
        let jerk = number(2.0) * rate.clone() * rate.clone();
        let identity: Matrix = (0..dimension * dimension)
            .map(|k| number(f64::from(u8::from(k / dimension == k % dimension))))
            .collect();
        let turned = plus(
            &scaled(&quarter, &angle.clone().sin()),
            &scaled(&square, &(number(1.0) - angle.cos())),
        );
        let rotation = plus(&identity, &turned);
        let first = times(&scaled(&quarter, &swing), &rotation, dimension);
        let rates = plus(&scaled(&quarter, &jerk), &scaled(&square, &(swing.clone() * swing)));
        let second = times(&rates, &rotation, dimension);
        Motion { rotation: [rotation, first, second], translation: drift(field, &s, &rate) }
    }
}

/// 3 L s^2 in one dimension, else 3 L s, -2 L s^2 and L s (2 - s), with their derivatives.
fn drift(field: &Field, s: &Precise, rate: &Precise) -> [Vector; 3] {
    // The coefficients of s and s^2.
    let coefficients: &[[f64; 2]] = match field.dimension() {
        1 => &[[0.0, 3.0]],
        2 => &[[3.0, 0.0], [0.0, -2.0]],
        _ => &[[3.0, 0.0], [0.0, -2.0], [2.0, -1.0]],
    };
    let size = field.size();
    let along = |value: &dyn Fn(&[Precise; 2]) -> Precise| -> Vector {
        coefficients.iter().map(|c| size.clone() * value(&c.map(number))).collect()
    };
    [
        along(&|[a, b]| a.clone() * s.clone() + b.clone() * s.clone() * s.clone()),
        along(&|[a, b]| (a.clone() + number(2.0) * b.clone() * s.clone()) * rate.clone()),
        along(&|[_, b]| number(2.0) * b.clone() * rate.clone() * rate.clone()),
    ]
}

/// Values by two routes, grouped by quantity.
#[derive(Default)]
struct Pairs {
    of: BTreeMap<String, Vec<(Precise, Precise)>>,
}

impl Pairs {
    fn add(&mut self, what: &str, found: &[Precise], expected: &[Precise]) {
        assert_eq!(found.len(), expected.len(), "{what}");
        let pairs = found.iter().cloned().zip(expected.iter().cloned());
        self.of.entry(what.to_string()).or_default().extend(pairs);
    }

    /// Asserts that the two routes differ by no more than `part` of the largest value of their kind: where a value is 0 by
    /// chance, rounding is left.
    fn assert_agree(&self, field: &str, part: f64) {
        for (what, pairs) in &self.of {
            let expected = pairs.iter().map(|(_, expected)| expected.clone().magnitude());
            let larger = |a: Precise, b: Precise| if b.at_most(&a) { a } else { b };
            let allowed = expected.fold(number(0.0), larger) * number(part);
            for (found, expected) in pairs {
                let difference = (found.clone() - expected.clone()).magnitude();
                let (a, b) = (found.to_f64(), expected.to_f64());
                assert!(
                    difference.at_most(&allowed),
                    "{what} of the twin of {field}: {a:e} and {b:e}"
                );
            }
        }
    }
}

/// Every quantity of a twin, computed from the quantities of the field.
fn composed(inner: &Field, quantity: Quantity, at: &Sample<Precise>) -> Vec<Precise> {
    let motion = Motion::standard(inner, &at.time);
    let ([q, q1, q2], [d, d1, d2]) = (&motion.rotation, &motion.translation);
    let dimension = inner.dimension();
    let of = |quantity| inner.quantity(quantity, &at.time, &at.coordinates);
    let minus = |a: &[Precise]| scaled(a, &number(-1.0));
    let x = || plus(&at.coordinates, &of(Quantity::Displacement));
    let v = || of(Quantity::Velocity);
    let apparent =
        || plus(&plus(&applied(q2, &x()), &scaled(&applied(q1, &v()), &number(2.0))), d2);
    let value = of(quantity);
    let turned = |value: &Matrix| times(q, value, dimension);
    let back = transposed(q, dimension);
    match quantity {
        Quantity::Displacement => plus(&plus(&applied(q, &x()), d), &minus(&at.coordinates)),
        Quantity::Velocity => plus(&plus(&applied(q, &value), &applied(q1, &x())), d1),
        Quantity::Acceleration | Quantity::BodyForce => plus(&applied(q, &value), &apparent()),
        Quantity::BodyForceDensity => {
            let density =
                inner.response(Response::Density, &at.time, &at.coordinates, &[]).remove(0);
            plus(&applied(q, &value), &scaled(&apparent(), &density))
        }
        Quantity::CurrentBodyForceDensity => {
            let density = of(Quantity::MassDensity).remove(0);
            plus(&applied(q, &value), &scaled(&apparent(), &density))
        }
        Quantity::Position => plus(&applied(q, &x()), d),
        Quantity::DisplacementGradient => {
            let f = turned(&of(Quantity::DeformationGradient));
            let identity = times(q, &back, dimension);
            plus(&f, &minus(&identity))
        }
        Quantity::DeformationGradient | Quantity::FirstPiolaKirchhoff => turned(&value),
        Quantity::NominalStress => times(&value, &back, dimension),
        Quantity::LeftCauchyGreen | Quantity::CauchyStress | Quantity::KirchhoffStress => {
            times(&turned(&value), &back, dimension)
        }
        Quantity::DivP | Quantity::DivSigma | Quantity::Traction => applied(q, &value),
        Quantity::Jacobian
        | Quantity::RightCauchyGreen
        | Quantity::GreenLagrange
        | Quantity::MassDensity
        | Quantity::StrainEnergy
        | Quantity::SecondPiolaKirchhoff
        | Quantity::Pressure
        | Quantity::VonMises
        | Quantity::SmallStrain
        | Quantity::Own(_) => value,
    }
}

#[test]
fn twins_are_the_field_turned_and_moved() {
    for (name, inner, twin) in TWINS.iter() {
        let mut pairs = Pairs::default();
        for point in inner.points() {
            for quantity in Quantity::ALL {
                let expected = composed(inner, *quantity, &point);
                let found = twin.quantity(*quantity, &point.time, &point.coordinates);
                pairs.add(quantity.name(), &found, &expected);
            }
        }
        pairs.assert_agree(name, 1e-60);
    }
}

/// The derivative of `f` by central differences with this step.
fn slope(step: &Precise, f: impl Fn(Precise) -> Vec<Precise>) -> Vec<Precise> {
    let (ahead, behind) = (f(step.clone()), f(-step.clone()));
    let per_width = number(0.5) / step.clone();
    scaled(&plus(&ahead, &scaled(&behind, &number(-1.0))), &per_width)
}

/// Without using rotations: H, v and a are derivatives of u, P is the derivative of W at the twin's own gradient, and b
/// balances. Central differences of relative step 1e-20 keep almost 40 digits.
#[test]
fn twins_are_solutions_of_their_own() {
    for (name, _, twin) in TWINS.iter() {
        let mut pairs = Pairs::default();
        for point in twin.points() {
            compare_with_differences(twin, &point, &mut pairs);
        }
        pairs.assert_agree(name, 1e-28);
    }
}

fn compare_with_differences(twin: &Field, point: &Sample<Precise>, pairs: &mut Pairs) {
    let Sample { coordinates: at, time } = point;
    let window = twin.bound(Bound::Time);
    let tick = (window[1].clone() - window[0].clone()) * number(1e-20);
    let inch = twin.size() * number(1e-20);
    let dimension = twin.dimension();
    let column = |entries: &[Precise], axis: usize| -> Vec<Precise> {
        entries.iter().skip(axis).step_by(dimension).cloned().collect()
    };
    let of = |quantity| twin.quantity(quantity, time, at);
    let by_time =
        |quantity| slope(&tick, |step| twin.quantity(quantity, &(time.clone() + step), at));
    let by_place = |quantity, axis: usize| {
        slope(&inch, |step| twin.quantity(quantity, time, &moved(at, axis, step)))
    };
    pairs.add("v", &of(Quantity::Velocity), &by_time(Quantity::Displacement));
    pairs.add("a", &of(Quantity::Acceleration), &by_time(Quantity::Velocity));
    let gradient = of(Quantity::DisplacementGradient);
    let mut divergence = vec![number(0.0); dimension];
    for axis in 0..dimension {
        pairs.add("H", &column(&gradient, axis), &by_place(Quantity::Displacement, axis));
        let slopes = by_place(Quantity::FirstPiolaKirchhoff, axis);
        divergence = plus(&divergence, &column(&slopes, axis));
    }
    let stress = of(Quantity::FirstPiolaKirchhoff);
    for (entry, stress) in stress.into_iter().enumerate() {
        let energy = slope(&number(1e-20), |step| {
            twin.response(Response::StrainEnergy, time, at, &moved(&gradient, entry, step))
        });
        pairs.add("P", &[stress], &energy);
    }
    let density = twin.response(Response::Density, time, at, &[]).remove(0);
    let inertia = scaled(&of(Quantity::Acceleration), &density);
    let force = scaled(&of(Quantity::BodyForce), &density);
    pairs.add("rho0 a", &plus(&force, &divergence), &inertia);
}

/// The numbers, with one of them increased by `step`.
fn moved(at: &[Precise], entry: usize, step: Precise) -> Vec<Precise> {
    let mut moved = at.to_vec();
    moved[entry] = moved[entry].clone() + step;
    moved
}
