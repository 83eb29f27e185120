//! The arrays of a snapshot, and the parts of their names: the name of a quantity, and a component.

use crate::axes::Axes;
use crate::meaning::{ArrayPlace, Part};
use crate::role::{Form, Role, plain};
use crate::{Array, Snapshot};

/// Ambiguous names with two possible quantities.
const UNCLEAR: &[(&str, [Role; 2])] = &[
    ("stress", [Role::CauchyStress, Role::FirstPiolaKirchhoff]),
    ("stresses", [Role::CauchyStress, Role::FirstPiolaKirchhoff]),
    ("piola", [Role::FirstPiolaKirchhoff, Role::SecondPiolaKirchhoff]),
    (S, [Role::CauchyStress, Role::SecondPiolaKirchhoff]),
];

/// The Cauchy stress in Abaqus, and the second Piola-Kirchhoff stress in textbooks. In lower case the name is neither.
pub(crate) const S: &str = "S";

/// The two possible quantities of an ambiguous name; `None` for other names.
pub(crate) fn two_meanings(name: &str, axes: Axes) -> Option<[Role; 2]> {
    let stem = stem(name, axes);
    let plain = plain(stem);
    let is_it = |word: &str| if word == S { stem == S } else { word == plain };
    UNCLEAR.iter().find(|(word, _)| is_it(word)).map(|(_, roles)| *roles)
}

/// All arrays; the places of points come first.
pub(crate) fn arrays(snapshot: &Snapshot) -> impl Iterator<Item = (ArrayPlace, &Array)> + Clone {
    let grid = snapshot.points.iter().map(|array| (ArrayPlace::Grid, array));
    let points =
        snapshot.of_points.iter().enumerate().map(|(at, array)| (ArrayPlace::Points(at), array));
    let cells =
        snapshot.of_cells.iter().enumerate().map(|(at, array)| (ArrayPlace::Cells(at), array));
    grid.chain(points).chain(cells)
}

/// The most names in a message.
const MOST_LISTED: usize = 30;

/// The names of all arrays.
pub fn all_names(snapshot: &Snapshot) -> String {
    let names = arrays(snapshot).map(|(_, array)| &array.name).chain(&snapshot.unread);
    let listed: Vec<_> = names.clone().take(MOST_LISTED).map(|it| format!("`{it}`")).collect();
    match names.count() {
        0 => "no arrays".into(),
        count if count > listed.len() => {
            format!("{} and {} others", listed.join(", "), count - listed.len())
        }
        _ => listed.join(", "),
    }
}

/// A name without its component.
pub(crate) fn stem(name: &str, axes: Axes) -> &str {
    split(name, axes).map_or(name, |(base, _)| base)
}

/// Splits a name into the name of a quantity and a component; `None` if it has no component.
pub(crate) fn split(name: &str, axes: Axes) -> Option<(&str, Part)> {
    let name = name.strip_suffix([']', ')']).unwrap_or(name);
    let base = |text: &'_ str| -> usize { text.trim_end_matches(SEPARATORS).len() };
    if let (Axes::Axisymmetric { .. }, Some(before)) = (axes, name.strip_suffix(HOOP)) {
        let found = &before[..base(before)];
        return (!found.is_empty()).then_some((found, Part::Nth(2)));
    }
    let (before, last) = name.split_at_checked(name.len().checked_sub(1)?)?;
    let letter = last.bytes().next()?;
    let last = axes.of(letter)?;
    let of_entry =
        before.split_at_checked(before.len().saturating_sub(1)).and_then(|(rest, first)| {
            let first = axes.of(first.bytes().next()?)?;
            Some((&rest[..base(rest)], Part::Entry(first, last)))
        });
    let found = of_entry.filter(|(base, _)| has_entries(base));
    let found = found.unwrap_or((&before[..base(before)], Part::Nth(last)));
    // A time step is called dt.
    let is_hoop = letter.eq_ignore_ascii_case(&b't') && matches!(found.1, Part::Nth(_));
    let is_apart = !is_hoop || found.0.len() < before.len();
    (!found.0.is_empty() && is_apart).then_some(found)
}

/// The component that follows the name of a quantity, as in `pk1_stress_xx` for `pk1_stress`.
pub(crate) fn part_of(name: &str, quantity: &str, axes: Axes) -> Option<Part> {
    let rest = name.strip_prefix(quantity)?.trim_end_matches([']', ')']);
    let rest = rest.trim_start_matches(SEPARATORS);
    if let (Axes::Axisymmetric { .. }, HOOP) = (axes, rest) {
        return Some(Part::Nth(2));
    }
    let axes: Option<Vec<usize>> = rest.bytes().map(|it| axes.of(it)).collect();
    match axes?[..] {
        [one] => Some(Part::Nth(one)),
        [row, column] => Some(Part::Entry(row, column)),
        _ => None,
    }
}

/// The word for the direction around the axis.
const HOOP: &str = "theta";

/// The letters between the name of a quantity and a component.
const SEPARATORS: [char; 7] = ['_', ':', '.', '[', '(', '-', ' '];

/// Whether a quantity of this name may be a matrix.
fn has_entries(name: &str) -> bool {
    let is_matrix = |role: &Role| !matches!(role.form(), Form::Scalar | Form::Vector);
    Role::called(name).as_ref().is_some_and(is_matrix)
        || UNCLEAR.iter().any(|(word, _)| *word == plain(name))
}
