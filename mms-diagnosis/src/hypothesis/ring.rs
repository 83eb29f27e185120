//! Mistakes about an axisymmetric field: mistakes about rings, and mistakes that occur in any coordinates.

use std::borrow::Cow;

use mms_runtime::{Condition, Face, Matrix};

use super::{Change, Given, Hypothesis, Of, OfStress};
use crate::exact::Exact;

/// The body that a solver uses in place of a ring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ring {
    /// The meridian section as a plane box: volumes and masses lack the radius.
    Box,
    /// A ring whose radius is larger than the radius of the middle, by the size.
    Wider,
    /// The meridian section as a plane box, without anything around the axis: F_tt is 1, and P_tt makes no force.
    Plane,
}

/// Hypotheses that mean something else around an axis, or nothing.
const OTHERS: [&str; 3] = ["constant_force", "coriolis", "centrifugal"];

/// Mistakes about rings; mistakes of b, stresses and tractions in space; and the other mistakes in the meridian.
pub(super) fn all<const D: usize>(
    exact: &Exact<'_, D>,
    space: &Exact<'_, 3>,
    in_space: impl Iterator<Item = Hypothesis<3>>,
    in_meridian: impl Iterator<Item = Hypothesis<D>>,
) -> Vec<Hypothesis<D>> {
    let is_shared = |it: &Hypothesis<3>| {
        let is_lifted = matches!(
            it.change,
            Change::Force(_) | Change::Stress(..) | Change::Surface(_) | Change::Loads(..)
        );
        is_lifted && !OTHERS.contains(&it.name) && it.which.as_deref().is_none_or(is_of_meridian)
    };
    let is_own = |it: &Hypothesis<D>| match it.change {
        Change::Force(_) => it.name == OTHERS[0],
        Change::Surface(_) | Change::Loads(..) => false,
        _ => true,
    };
    let shared = in_space.filter(is_shared).map(lifted);
    of_rings(exact, space).into_iter().chain(shared).chain(in_meridian.filter(is_own)).collect()
}

/// Whether a mistake of some components lies in the meridian.
fn is_of_meridian(which: &str) -> bool {
    !(which.contains('z') || which.contains('3'))
}

/// Wraps a mistake in space for the field of the meridian.
fn lifted<const D: usize>(it: Hypothesis<3>) -> Hypothesis<D> {
    let which = it.which.as_deref().map(|which| -> Cow<'static, str> {
        match which {
            "x" => "r".into(),
            "y" => "z".into(),
            "x and y" => "r and z".into(),
            other => other.replace("P12", "P_rz").replace("P21", "P_zr").into(),
        }
    });
    Hypothesis {
        name: it.name,
        says: it.says,
        kind: it.kind,
        size: it.size.clone(),
        also: it.also.clone(),
        known: |_| Vec::new(),
        below: it.below,
        face: it.face,
        which,
        only: it.only,
        needs_other_quantities_right: it.needs_other_quantities_right,
        is_of_mesh: it.is_of_mesh,
        change: Change::InSpace(Box::new(it)),
    }
}

fn of_rings<const D: usize>(exact: &Exact<'_, D>, space: &Exact<'_, 3>) -> Vec<Hypothesis<D>> {
    let hoop = |name, says, change: OfStress<3>| {
        lifted(Hypothesis::fixed(name, says, Change::Stress(Of::Motion, change)))
    };
    let ring = |name, says, ring| Hypothesis::fixed(name, says, Change::Ring(ring));
    let mut all = vec![
        hoop("hoop_force_missing", "Div P without -P_tt/R: the hoop stress causes no force", |_, tau| {
            tau.iter_mut().for_each(|tau| tau[(2, 2)] = 0.0);
        }),
        hoop("hoop_strain_missing", "F_tt = 1 in the law, in place of 1 + u_R/R", |at, tau| {
            tau.copy_from_slice(&of_plane(at));
        }),
        hoop(
            "hoop_missing",
            "F_tt = 1 in the law, and Div P without -P_tt/R: the weight R is the only trace of rings",
            |at, tau| {
                tau.copy_from_slice(&of_plane(at));
                tau.iter_mut().for_each(|tau| tau[(2, 2)] = 0.0);
            },
        ),
        ring(
            "radius_weight_missing",
            "masses and volumes of boxes in a plane: Div P without P_RR/R and P_ZR/R",
            Ring::Box,
        ),
        ring(
            "solved_as_plane",
            "plane strain: F_tt = 1, and Div P without its terms in 1/R",
            Ring::Plane,
        ),
        Hypothesis::amount(
            "ring_volume",
            "volumes, masses and faces of rings at another radius than the middle, such as an edge; the size is the offset",
            vec![exact.cell_size / 2.0],
            Change::Ring(Ring::Wider),
        )
        .within([-2.0 * exact.cell_size, 2.0 * exact.cell_size])
        .of_mesh(),
    ];
    let axis = Face::Min(0);
    let is_axis = space.places().iter().all(|x| x[0] > 0.0)
        && exact.domain.condition(axis) == Condition::Roller
        && exact.starts_at_axis();
    if is_axis {
        let says = "the axis is a fixed wall: u_Z = 0 there";
        let change = Change::Condition(Condition::Fixed);
        all.push(Hypothesis::fixed("axis_fixed", says, change).on(axis));
    }
    all
}

/// P F^T with the P that a law gives where F_tt is 1.
fn of_plane(at: &Given<'_, 3>) -> Vec<Matrix<f64, 3>> {
    let mut flat = at.gradient.to_vec();
    flat.iter_mut().for_each(|h| h[(2, 2)] = 0.0);
    let mut stress = at.exact.stress(at.time, at.reference, &flat);
    let all = stress.iter_mut().zip(at.gradient);
    all.for_each(|(tau, h)| tau[(2, 2)] *= 1.0 + h[(2, 2)]);
    stress
}
