//! Mistakes on faces.

use mms_runtime::tensor::{cofactor, determinant};
use mms_runtime::{Condition, Face, Matrix};

use super::{Change, Given, Hypothesis, Known, OfTraction, force, inverse, of_first, of_swaps};
use crate::body::{faces, normal};
use crate::exact::Exact;

pub(super) fn all<const D: usize>(exact: &Exact<'_, D>) -> Vec<Hypothesis<D>> {
    let of = |face| match exact.domain.condition(face) {
        Condition::Traction => of_load(exact, face),
        Condition::Free => vec![held(face)],
        Condition::Roller => vec![free(face), held(face)],
        Condition::Fixed | Condition::Prescribed => vec![free(face)],
    };
    let faces = faces(&exact.domain.body);
    let is_loaded = |face: &&Face| exact.domain.condition(**face) == Condition::Traction;
    let loaded = faces.iter().filter(is_loaded).count();
    let mut all: Vec<_> = faces.iter().copied().flat_map(of).collect();
    if loaded > 0 {
        all.push(loads_late(exact));
    }
    if loaded > 1 {
        all.extend(of_tractions(exact).into_iter().map(|it| {
            let own = it.which.as_ref().map_or(String::new(), |own| format!("{own}, "));
            it.of(format!("{own}all faces"))
        }));
    }
    all
}

/// R of F = R U, by Newton's iteration (Higham, "Computing the polar decomposition, with applications", SIAM J. Sci. Stat.
/// Comput. 7 (1986)).
fn rotation<const D: usize>(f: &Matrix<f64, D>) -> Matrix<f64, D> {
    (0..ROUNDS).fold(*f, |r, _| (r + inverse(&r).transpose()) / 2.0)
}

/// Enough iterations for stretches up to 10.
const ROUNDS: usize = 10;

fn held<const D: usize>(face: Face) -> Hypothesis<D> {
    let says = "the face follows the field, although it is loaded or free";
    Hypothesis::fixed("held_face", says, Change::Condition(Condition::Prescribed)).on(face)
}

fn free<const D: usize>(face: Face) -> Hypothesis<D> {
    let says = "the face is free, although it should be held";
    Hypothesis::fixed("free_face", says, Change::Condition(Condition::Free)).on(face)
}

/// The mistakes on a loaded face.
fn of_load<const D: usize>(exact: &Exact<'_, D>, face: Face) -> Vec<Hypothesis<D>> {
    of_tractions(exact).into_iter().map(|it| it.on(face)).chain([held(face)]).collect()
}

/// Replaces tractions by those at a time earlier by the size.
fn earlier<const D: usize>(at: &Given<'_, D>, _: Face, tau: &mut [Matrix<f64, D>]) {
    let before = at.exact.gradient(at.time - at.size[0], at.reference);
    let stress = at.exact.stress(at.time - at.size[0], at.reference, &before);
    for (((tau, h), before), stress) in tau.iter_mut().zip(at.gradient).zip(before).zip(stress) {
        let f: Matrix<f64, D> = before + Matrix::identity();
        let p = stress * inverse(&f.transpose());
        *tau = p * (h + Matrix::identity()).transpose();
    }
}

/// The hypothesis that all loads, b and tractions, belong to an earlier time.
fn loads_late<const D: usize>(exact: &Exact<'_, D>) -> Hypothesis<D> {
    let says = "b and tractions of an earlier time; the size is the delay";
    let change = Change::Loads(force::earlier, earlier);
    Hypothesis::delay(exact, ["loads_late", "loads_early"], says, change)
}

/// The mistakes in tractions.
fn of_tractions<const D: usize>(exact: &Exact<'_, D>) -> Vec<Hypothesis<D>> {
    let factor = Hypothesis::factor(
        "traction_factor",
        "the traction times a factor",
        0.0,
        Change::Surface(|at, _, tau| tau.iter_mut().for_each(|tau| *tau *= at.size[0])),
        |_| {
            vec![
                Known::new(0.0, "traction_missing", "the traction is missing"),
                Known::new(-1.0, "traction_sign", "the traction has the other sign"),
                Known::new(2.0, "traction_twice", "the traction is added twice"),
            ]
        },
    );
    let made = |name, says, change| Hypothesis::fixed(name, says, Change::Surface(change));
    let says = "tractions of an earlier time; the size is the delay";
    let names = ["traction_late", "traction_early"];
    let late = Hypothesis::delay(exact, names, says, Change::Surface(earlier));
    let mut all = vec![
        factor,
        late,
        made("traction_transposed", "P^T N in place of P N", |at, _, tau| {
            of_first(at, tau, |f, p: Matrix<f64, D>| p.transpose() * f.transpose());
        }),
        made("traction_cauchy", "sigma N on the reference area in place of P N", |at, _, tau| {
            of_first(at, tau, |f, p| p * f.transpose() * f.transpose() / determinant(f));
        }),
        made("traction_second_piola", "S N in place of P N", |at, _, tau| {
            of_first(at, tau, |f, p| inverse(f) * p * f.transpose());
        }),
        made(
            "traction_follower",
            "R P N in place of P N: a load that turns with the face",
            |at, _, tau| {
                of_first(at, tau, |f, p| rotation(f) * p * f.transpose());
            },
        ),
        made("traction_present_area", "P N on the present area", |at, face, tau| {
            for ((tau, h), x) in tau.iter_mut().zip(at.gradient).zip(at.reference) {
                *tau *= cofactor(h)
                    .map_or(f64::NAN, |it| (it * normal(&at.exact.domain.body, face, x)).norm());
            }
        }),
    ];
    if D > 1 {
        all.push(made(
            "traction_normal",
            "the normal part of P N alone: a pressure",
            |at, face, tau| {
                for ((tau, h), x) in tau.iter_mut().zip(at.gradient).zip(at.reference) {
                    let (f, n) = (h + Matrix::identity(), normal(&at.exact.domain.body, face, x));
                    let p = *tau * inverse(&f.transpose());
                    *tau = n * (n.transpose() * p * n) * n.transpose() * f.transpose();
                }
            },
        ));
    }
    let says = "two components of P N are swapped";
    let swapped = |change| made("traction_swapped", says, change);
    let swaps: [OfTraction<D>; 3] = [swap::<D, 0, 1>, swap::<D, 1, 2>, swap::<D, 0, 2>];
    all.extend(of_swaps(swaps.map(swapped)));
    all
}

/// Swaps two components of P N, which are made by rows of P.
fn swap<const D: usize, const A: usize, const B: usize>(
    at: &Given<'_, D>,
    _: Face,
    tau: &mut [Matrix<f64, D>],
) {
    of_first(at, tau, |f, mut p: Matrix<f64, D>| {
        p.swap_rows(A, B);
        p * f.transpose()
    });
}
