//! The parts of a quantity in the components of an array, by the component names in the file.

use crate::axes::Axes;
use crate::meaning::{ArrayPlace, Column, Part, array};
use crate::{Array, Snapshot};

/// The part of each component: by its name if names give axes, as XX, YY, XY or x, y, z, otherwise by its position.
pub(crate) fn parts(array: &Array, axes: Axes) -> Vec<Part> {
    let by_order = || (0..array.components).map(Part::Nth).collect();
    by_name(&array.component_names, axes)
        .filter(|it| it.len() == array.components)
        .unwrap_or_else(by_order)
}

/// Whether the file names the components of an array by axes.
pub(crate) fn has_names(array: &Array, axes: Axes) -> bool {
    by_name(&array.component_names, axes).is_some_and(|it| it.len() == array.components)
}

/// The parts of columns by their names, if these are all components of one array and give axes.
pub(crate) fn of_columns(snapshot: &Snapshot, columns: &[Column], axes: Axes) -> Option<Vec<Part>> {
    let array: &Array = array(snapshot, columns.first()?.place);
    let place: ArrayPlace = columns[0].place;
    let is_next = |(at, it): (usize, &Column)| it.place == place && it.component == at;
    let is_whole = columns.len() == array.components && columns.iter().enumerate().all(is_next);
    by_name(&array.component_names, axes).filter(|it| is_whole && it.len() == columns.len())
}

/// Parts by names that differ only in their axes, each part once; for entries of a matrix two are on its diagonal.
fn by_name(names: &[String], letters: Axes) -> Option<Vec<Part>> {
    let first = names.first()?;
    [2, 1].into_iter().find_map(|count| {
        let stem = first.get(..first.len().checked_sub(count)?)?;
        let axes = |name: &String| -> Option<Vec<usize>> {
            let (base, axes) = name.split_at_checked(name.len().checked_sub(count)?)?;
            let of_space = |byte| letters.of(byte).filter(|it| *it <= 3);
            (base == stem).then(|| axes.bytes().map(of_space).collect())?
        };
        let all = names.iter().map(axes).collect::<Option<Vec<_>>>()?;
        let is_other = |(at, own): (usize, &Vec<usize>)| !all[..at].contains(own);
        let is_diagonal = |own: &&Vec<usize>| own[0] == own[1];
        let numbers = || all.iter().flatten();
        // Axes are counted from 0 or from 1, and there are three.
        let are_three = numbers().max()? - numbers().min()? < 3;
        let is_matrix = count == 1 || all.iter().filter(is_diagonal).count() > 1;
        let is_sound = all.iter().enumerate().all(is_other) && are_three && is_matrix;
        let part = |own: &Vec<usize>| match own[..] {
            [row, column] => Part::Entry(row, column),
            _ => Part::Nth(own[0]),
        };
        is_sound.then(|| all.iter().map(part).collect())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_tell_axes_are_known() {
        let parts = |names: &[&str]| {
            let names: Vec<String> = names.iter().map(|it| (*it).to_owned()).collect();
            by_name(&names, Axes::Cartesian)
        };
        let entries =
            |of: &[[usize; 2]]| Some(of.iter().map(|it| Part::Entry(it[0], it[1])).collect());
        assert_eq!(parts(&["XX", "YY", "XY"]), entries(&[[0, 0], [1, 1], [0, 1]]));
        assert_eq!(
            parts(&["s11", "s22", "s33", "s12"]),
            entries(&[[1, 1], [2, 2], [3, 3], [1, 2]])
        );
        assert_eq!(parts(&["Z", "Y", "X"]), Some([2, 1, 0].map(Part::Nth).to_vec()));
        for names in [
            &["0", "1", "2", "3", "4", "5"][..],
            &["00", "01", "02", "03"],
            &["XX", "YY", "XX"],
            &["XX", "YY", "12", "03"],
            &["aXX", "bYY"],
            &["red", "green", "blue"],
            &["", "", ""],
            &["é", "x"],
            &[],
        ] {
            assert_eq!(parts(names), None, "{names:?}");
        }
    }
}
