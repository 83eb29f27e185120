//! Mistakes in writing and reading results of a right solver.

use mms_runtime::Vector;

use super::{Change, Given, Hypothesis, Known, law};
use crate::exact::{Exact, Quantity};

/// The most cells by which points of results may be off; more is another mistake.
const CELLS: f64 = 2.0;

/// The number of parts of the time window in which results of another time are searched.
const PARTS: i32 = 16;

/// Results of another time, at any distance in time, such as of another frame.
fn another_time<const D: usize>(exact: &Exact<'_, D>) -> Hypothesis<D> {
    let window = exact.domain.time[1] - exact.domain.time[0];
    let part = |k: i32| f64::from(k) * window / f64::from(PARTS);
    let says = "results of another time, as of another frame; the size is the delay in seconds";
    let change = Change::Output(|at: &Given<'_, D>, quantity| {
        let (time, [first, last]) = (at.time + at.size[0], at.exact.domain.time);
        let values = at.exact.values(quantity, time, at.reference);
        // No frame has a time outside the window.
        let is_within = first <= time && time <= last;
        if is_within { values } else { vec![f64::NAN; values.len()] }
    });
    let mut found = Hypothesis::amount("output_time", says, vec![part(1)], change);
    found.also = (2..=PARTS).flat_map(|k| [part(k), part(-k)]).collect();
    found.within([-window, window]).of("seconds")
}

pub(super) fn all<const D: usize>(exact: &Exact<'_, D>) -> Vec<Hypothesis<D>> {
    let length = CELLS * exact.cell_size;
    let mut all = vec![
        Hypothesis::amount(
            "output_time",
            "results belong to a later time than stated; the size is the delay",
            vec![exact.time_step],
            Change::Output(|at, quantity| {
                at.exact.values(quantity, at.time + at.size[0], at.reference)
            }),
        )
        .of_steps(exact),
        another_time(exact),
        Hypothesis::amount(
            "points_offset",
            "results belong to points beside X; the size is the offset",
            vec![exact.cell_size / 4.0; D],
            Change::Output(|at, quantity| {
                let offset = Vector::from_column_slice(at.size);
                let places: Vec<_> = at.reference.iter().map(|x| x + offset).collect();
                at.exact.values(quantity, at.time, &places)
            }),
        )
        .within([-length, length])
        .of_mesh(),
        Hypothesis::amount(
            "displacement_offset",
            "all displacements are off by one vector, as if the support were elsewhere",
            vec![exact.cell_size; D],
            Change::Output(|at, quantity| {
                let mut values = at.exact.values(quantity, at.time, at.reference);
                if quantity == Quantity::Displacement {
                    let parts = at.size.iter().cycle();
                    values.iter_mut().zip(parts).for_each(|(u, part)| *u += part);
                }
                values
            }),
        ),
        Hypothesis::fixed(
            "position_for_reference",
            "x is given as X",
            Change::Output(|at, quantity| {
                // To first order; for large displacements, points outside the body show the mistake.
                let u = at.exact.displacement(at.time, at.reference);
                let places: Vec<_> = at.reference.iter().zip(&u).map(|(x, u)| x - u).collect();
                at.exact.values(quantity, at.time, &places)
            }),
        ),
        Hypothesis::factor(
            "output_factor",
            "results times a factor",
            2.0,
            Change::Output(|at, quantity| {
                let mut values = at.exact.values(quantity, at.time, at.reference);
                values.iter_mut().for_each(|value| *value *= at.size[0]);
                values
            }),
            |_| {
                let mut known = law::units();
                known.push(Known::new(-1.0, "output_sign", "results have the other sign"));
                known
            },
        ),
        Hypothesis::fixed(
            "increment_for_total",
            "the displacement of the last step in place of all",
            Change::Output(|at, quantity| {
                let [now, before] = [0.0, at.exact.time_step]
                    .map(|step| at.exact.values(quantity, at.time - step, at.reference));
                match quantity {
                    Quantity::Displacement => now.iter().zip(before).map(|(a, b)| a - b).collect(),
                    _ => now,
                }
            }),
        ),
    ];
    all.push(Hypothesis {
        only: Some(Quantity::Displacement),
        ..Hypothesis::fixed(
            "position_for_displacement",
            "x is given as u",
            Change::Output(|at, quantity| {
                let mut values = at.exact.values(quantity, at.time, at.reference);
                if quantity == Quantity::Displacement {
                    let places = at.reference.iter().flat_map(|x| x.iter());
                    values.iter_mut().zip(places).for_each(|(u, x)| *u += x);
                }
                values
            }),
        )
    });
    if D > 1 {
        let fixed = |says, change| Hypothesis::fixed("components_swapped", says, change);
        all.push(fixed("components are in another order", Change::Output(swapped)));
        if D == 3 {
            let says = "the names of two components are swapped";
            all.extend([
                fixed(says, Change::Output(two_swapped::<D, 0, 1>)).of("x and y"),
                fixed(says, Change::Output(two_swapped::<D, 1, 2>)).of("y and z"),
                fixed(says, Change::Output(two_swapped::<D, 0, 2>)).of("x and z"),
            ]);
        }
        let only = [
            ("displacement", Change::Output(swapped_only::<D, 0>)),
            ("velocity", Change::Output(swapped_only::<D, 1>)),
            ("displacement_gradient", Change::Output(swapped_only::<D, 2>)),
        ];
        all.extend(only.into_iter().zip(QUANTITIES).map(|((which, change), quantity)| {
            let says =
                "components of this quantity are in another order, beside other quantities that are right";
            Hypothesis { only: Some(quantity), needs_other_quantities_right: true, ..fixed(says, change).of(which) }
        }));
        let transposed = Hypothesis::fixed(
            "gradient_transposed",
            "H or F is written by columns, in place of rows",
            Change::Output(|at, quantity| {
                let mut values = at.exact.values(quantity, at.time, at.reference);
                if quantity == Quantity::DisplacementGradient {
                    for tensor in values.chunks_mut(D * D) {
                        let rows = tensor.to_vec();
                        (0..D * D).for_each(|it| tensor[it] = rows[it % D * D + it / D]);
                    }
                }
                values
            }),
        );
        all.push(Hypothesis { only: Some(Quantity::DisplacementGradient), ..transposed });
    }
    all
}

/// The quantities that results may have.
const QUANTITIES: [Quantity; 3] =
    [Quantity::Displacement, Quantity::Velocity, Quantity::DisplacementGradient];

/// Velocities of a time earlier by the size than their label, as leapfrog has them: that is no mistake.
pub fn earlier_velocity<const D: usize>() -> Hypothesis<D> {
    let change = Change::Output(|at, quantity| {
        let before = if quantity == Quantity::Velocity { at.size[0] } else { 0.0 };
        at.exact.values(quantity, at.time - before, at.reference)
    });
    Hypothesis::amount("earlier_velocity", "velocities of an earlier time", vec![0.0], change)
        .of_mesh()
}

/// Swaps two components; of a tensor, both rows and columns.
fn two_swapped<const D: usize, const A: usize, const B: usize>(
    at: &Given<'_, D>,
    quantity: Quantity,
) -> Vec<f64> {
    let mut values = at.exact.values(quantity, at.time, at.reference);
    for point in values.chunks_mut(quantity.components(D)) {
        if quantity == Quantity::DisplacementGradient {
            (0..D).for_each(|axis| point.swap(A * D + axis, B * D + axis));
            point.chunks_mut(D).for_each(|row| row.swap(A, B));
        } else {
            point.swap(A, B);
        }
    }
    values
}

/// Shifts the components of one quantity by one place.
fn swapped_only<const D: usize, const WHICH: usize>(
    at: &Given<'_, D>,
    quantity: Quantity,
) -> Vec<f64> {
    if quantity == QUANTITIES[WHICH] {
        swapped(at, quantity)
    } else {
        at.exact.values(quantity, at.time, at.reference)
    }
}

/// Shifts components by one place.
fn swapped<const D: usize>(at: &Given<'_, D>, quantity: Quantity) -> Vec<f64> {
    let mut values = at.exact.values(quantity, at.time, at.reference);
    for point in values.chunks_mut(quantity.components(D)) {
        match quantity {
            Quantity::DisplacementGradient => {
                point.chunks_mut(D).for_each(|row| row.rotate_left(1));
                point.rotate_left(D);
            }
            _ => point.rotate_left(1),
        }
    }
    values
}
