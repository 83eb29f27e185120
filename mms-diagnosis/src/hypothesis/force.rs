//! Mistakes in b.

use mms_runtime::Vector;
use mms_runtime::tensor::jacobian;

use super::{Change, Given, Hypothesis, Known, OfForce, of_swaps};
use crate::exact::Exact;

pub(super) fn all<const D: usize>(exact: &Exact<'_, D>) -> Vec<Hypothesis<D>> {
    let window = exact.domain.time[1] - exact.domain.time[0];
    let force = |name, says, change| Hypothesis::fixed(name, says, Change::Force(change));
    let says = "b of an earlier time; the size is the delay";
    let names = ["force_late", "force_early"];
    let delay = Hypothesis::delay(exact, names, says, Change::Force(earlier));
    let mut all = vec![
        Hypothesis::factor(
            "force_factor",
            "b times a factor",
            0.0,
            Change::Force(|at, b| b.iter_mut().for_each(|b| *b *= at.size[0])),
            factors,
        ),
        force("force_sign", "the sign of Div P in b: b = a + Div P/rho0", |at, b| {
            change(at, b, |right, inertia, _| inertia * 2.0 - right);
        }),
        force("inertia_missing", "b without a: b = -Div P/rho0", |at, b| {
            change(at, b, |right, inertia, _| right - inertia);
        }),
        force("force_present_density", "b with the present density: b = a - Div P/rho", |at, b| {
            change(at, b, |right, inertia, j| inertia + (right - inertia) * j)
        }),
        force("force_times_jacobian", "b J in place of b", |at, b| {
            change(at, b, |right, _, j| right * j);
        }),
        force("force_over_jacobian", "b/J in place of b", |at, b| {
            change(at, b, |right, _, j| right / j);
        }),
        force("force_at_present", "b at the present place x in place of X", |at, b| {
            let u = at.exact.displacement(at.time, at.reference);
            let places: Vec<_> = at.reference.iter().zip(&u).map(|(x, u)| x + u).collect();
            b.copy_from_slice(&at.exact.body_force(at.time, &places));
        }),
        delay,
        Hypothesis::amount(
            "constant_force",
            "a constant force per mass besides b, as gravity; the size is the vector",
            vec![scale(exact) * 0.1; D],
            Change::Force(|at, b| {
                b.iter_mut().for_each(|b| *b += Vector::from_column_slice(at.size))
            }),
        ),
        Hypothesis::amount(
            "damping",
            "a force against the velocity; the size is the rate",
            vec![0.3 / window],
            Change::Force(|at, b| {
                let v = at.exact.velocity(at.time, at.reference);
                b.iter_mut().zip(v).for_each(|(b, v)| *b -= v * at.size[0]);
            }),
        )
        .within([0.0, f64::MAX])
        .choice(),
        Hypothesis::amount(
            "damping_local",
            "Cundall's local damping, a part of |a| against the velocity, by components; the size is the part",
            vec![0.3],
            Change::Force(|at, b| {
                let a = at.exact.acceleration(at.time, at.reference);
                let v = at.exact.velocity(at.time, at.reference);
                for ((b, a), v) in b.iter_mut().zip(a).zip(v) {
                    // At rest the damping force has no direction.
                    let sign = |v: f64| v / v.abs().max(f64::MIN_POSITIVE);
                    *b -= Vector::from_fn(|i, _| a[i].abs() * sign(v[i])) * at.size[0];
                }
            }),
        )
        .within([0.0, 1.0])
        .choice(),
    ];
    if D > 1 {
        all.extend(of_rotating_frame(exact));
        all.extend(of_components());
    }
    let swapped = |change| force("force_swapped", "two components of b are swapped", change);
    let swaps: [OfForce<D>; 3] = [swap::<D, 0, 1>, swap::<D, 1, 2>, swap::<D, 0, 2>];
    all.extend(of_swaps(swaps.map(swapped)));
    all
}

/// Swaps two components of b.
fn swap<const D: usize, const A: usize, const B: usize>(
    _: &Given<'_, D>,
    b: &mut [Vector<f64, D>],
) {
    b.iter_mut().for_each(|b| b.swap_rows(A, B));
}

/// Replaces b by its value at a time earlier by the size.
pub(super) fn earlier<const D: usize>(at: &Given<'_, D>, b: &mut [Vector<f64, D>]) {
    b.copy_from_slice(&at.exact.body_force(at.time - at.size[0], at.reference));
}

/// The mistakes in one component of b.
fn of_components<const D: usize>() -> Vec<Hypothesis<D>> {
    let of = |which, change| {
        let says = "one component of b times a factor";
        let known = |_: &Exact<'_, D>| {
            vec![
                Known::new(0.0, "force_component_missing", "one component of b is missing"),
                Known::new(-1.0, "force_component_sign", "one component of b has the other sign"),
            ]
        };
        Hypothesis::factor("force_component", says, 0.0, Change::Force(change), known).of(which)
    };
    let all: [(&str, OfForce<D>); 3] = [
        ("x", |at, b| b.iter_mut().for_each(|b| b[0] *= at.size[0])),
        ("y", |at, b| b.iter_mut().for_each(|b| b[1] *= at.size[0])),
        ("z", |at, b| b.iter_mut().for_each(|b| b[2] *= at.size[0])),
    ];
    all.into_iter().take(D).map(|(which, change)| of(which, change)).collect()
}

/// The inertial forces besides b in a frame that rotates about axes through the origin.
fn of_rotating_frame<const D: usize>(exact: &Exact<'_, D>) -> [Hypothesis<D>; 2] {
    let window = exact.domain.time[1] - exact.domain.time[0];
    let radius = exact.places().iter().map(|x| x.norm()).fold(f64::MIN_POSITIVE, f64::max);
    let axes = if D == 2 { 1 } else { D };
    [
        Hypothesis::amount(
            "coriolis",
            "the Coriolis force -2 omega x v besides b; the size is omega, in space the vector",
            vec![0.15 / window; axes],
            Change::Force(|at, b| {
                let v = at.exact.velocity(at.time, at.reference);
                b.iter_mut().zip(v).for_each(|(b, v)| *b -= cross(at.size, &v) * 2.0);
            }),
        )
        .choice(),
        Hypothesis::amount(
            "centrifugal",
            "the centrifugal force omega^2 x besides b; the size is omega^2, in space about each axis",
            vec![scale(exact) / radius * 0.1; axes],
            Change::Force(|at, b| {
                let all: f64 = at.size.iter().sum();
                let u = at.exact.displacement(at.time, at.reference);
                for ((b, x), u) in b.iter_mut().zip(at.reference).zip(u) {
                    let along = |i: usize| if D == 2 { 0.0 } else { at.size[i] };
                    *b += Vector::from_fn(|i, _| (all - along(i)) * (x[i] + u[i]));
                }
            }),
        )
        .choice(),
    ]
}

/// omega x v; in a plane omega is normal to it.
fn cross<const D: usize>(omega: &[f64], v: &Vector<f64, D>) -> Vector<f64, D> {
    Vector::from_fn(|i, _| match omega {
        [omega] => omega * if i == 0 { -v[1] } else { v[0] },
        omega => {
            let [j, k] = [(i + 1) % D, (i + 2) % D];
            omega[j] * v[k] - omega[k] * v[j]
        }
    })
}

/// Replaces each b by a function of b, a and J.
fn change<const D: usize>(
    at: &Given<'_, D>,
    b: &mut [Vector<f64, D>],
    made: impl Fn(Vector<f64, D>, Vector<f64, D>, f64) -> Vector<f64, D>,
) {
    let inertia = at.exact.acceleration(at.time, at.reference);
    let gradients = at.exact.gradient(at.time, at.reference);
    for ((b, a), h) in b.iter_mut().zip(inertia).zip(&gradients) {
        *b = made(*b, a, jacobian(h));
    }
}

fn factors<const D: usize>(exact: &Exact<'_, D>) -> Vec<Known> {
    let mut known = vec![
        Known::new(0.0, "force_missing", "b is missing"),
        Known::new(2.0, "force_twice", "b is added twice"),
        Known::new(-1.0, "force_reversed", "b has the other sign"),
        Known::new(0.5, "force_half", "half of b"),
    ];
    if let Some(density) = exact.uniform_density() {
        known.push(Known::new(density, "force_per_volume", "rho0 b, a force per volume, for b"));
        known.push(Known::new(1.0 / density, "force_per_density", "b divided by rho0"));
    }
    known
}

/// The size of b in the body.
fn scale<const D: usize>(exact: &Exact<'_, D>) -> f64 {
    let [first, last] = exact.domain.time;
    let places = exact.places();
    let sizes = [0.3, 0.6, 0.9].iter().flat_map(|part| {
        exact.body_force(first + part * (last - first), &places).into_iter().map(|b| b.norm())
    });
    let largest = sizes.filter(|it| it.is_finite()).fold(0.0, f64::max);
    if largest > 0.0 { largest } else { 1.0 }
}
