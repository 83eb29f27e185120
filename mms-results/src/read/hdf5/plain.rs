//! Arrays of any file of HDF5 or netCDF by their paths, and variables of MATLAB.

use mms_hdf5::{Set, Type};

use super::super::npy::by_rows;
use super::super::table::is_time;
use super::{File, by_time};
use crate::wanted::Need;
use crate::{Array, Mistake, Snapshot};

/// The most numbers that a point has at one time, where the first axis are the times.
const MOST_COMPONENTS: usize = 9;

/// Reads the arrays that are wanted. The first axis are the points; times, if there are more than one, come before it.
pub fn parse(file: &File<'_>, is_matlab: bool) -> Result<Vec<Snapshot>, Mistake> {
    let sets = file.store.sets().map_err(Mistake::new)?;
    let ends_with = |end: &str| sets.iter().any(|it| it.path.rsplit('/').next() == Some(end));
    if ends_with("cell_dofs") && ends_with("x_cell_dofs") {
        return Err(Mistake::new(
            "a checkpoint of dolfin holds degrees of freedom, and no values at points: give the .xdmf file beside it, or \
             write one with `XDMFFile.write`",
        ));
    }
    let (clocks, sets): (Vec<_>, Vec<_>) =
        sets.into_iter().partition(|it| is_time(&it.path) && it.kind.bytes().is_some());
    let times = match clocks.first() {
        Some(set) => file.times(set)?,
        None => Vec::new(),
    };
    let (mut whole, mut by_times) = (Snapshot::default(), Vec::new());
    for set in &sets {
        let name = name(file, &set.path);
        let need = file.wanted.need(&name);
        let is_read = match need {
            Need::No | Need::Sound => false,
            Need::Numbers => set.kind.bytes().is_some(),
            Need::Must => !is_left_out(file, set, is_matlab),
        };
        if !is_read || is_matlab && is_left_out(file, set, is_matlab) {
            whole.unread.push(name);
            continue;
        }
        let array = file.array(set, &name)?;
        match is_over_times(set, &sets, times.len()) && !is_matlab {
            true => by_times.push((array, set.shape[2])),
            false if is_matlab => whole.of_points.push(of_matlab(array, &set.shape)),
            false => whole.of_points.push(array),
        }
    }
    if by_times.is_empty() {
        // Of the times of a file without arrays over them, the only one is that of the arrays.
        let time = times.first().filter(|_| times.len() == 1).copied();
        return Ok(vec![Snapshot { time, ..whole }]);
    }
    let mut all = file.repeated(whole, &times)?;
    for (array, components) in by_times {
        for (snapshot, part) in all.iter_mut().zip(by_time(&array, components, times.len())) {
            snapshot.of_points.push(part);
        }
    }
    Ok(all)
}

/// The name of an array: its path, with the slash before it where a user maps it so.
fn name(file: &File<'_>, path: &str) -> String {
    let from_root = format!("/{path}");
    let is_mapped = |name: &str| file.wanted.need(name) == Need::Must;
    if !is_mapped(path) && is_mapped(&from_root) { from_root } else { path.to_owned() }
}

/// Whether it holds nothing by what MATLAB says of it, or belongs to cells and objects, or to other programs.
fn is_left_out(file: &File<'_>, set: &Set, is_matlab: bool) -> bool {
    let is_word = || file.word(&set.path, "MATLAB_class").is_some_and(|it| it == "char");
    let is_empty = || file.numbers(&set.path, "MATLAB_empty").is_some();
    is_matlab && (set.path.starts_with('#') || set.kind == Type::Other || is_word() || is_empty())
}

/// Whether an array has values of points at each time: its second axis are the points, which another array may show.
fn is_over_times(set: &Set, sets: &[Set], times: usize) -> bool {
    let &[first, points, components] = &set.shape[..] else { return false };
    let rows = |rows: usize| {
        sets.iter()
            .any(|it| it.shape.len() == 2 && it.shape[0] == rows && it.kind.bytes().is_some())
    };
    let is_tensor = rows(first) && !rows(points);
    times > 1 && first == times && (1..=MOST_COMPONENTS).contains(&components) && !is_tensor
}

/// A variable of MATLAB, whose first axis runs fastest: HDF5 shows its axes in reverse. A row of numbers is a column.
fn of_matlab(array: Array, shape: &[usize]) -> Array {
    let axes: Vec<usize> = shape.iter().rev().copied().collect();
    if array.values.is_empty() || matches!(axes[..], [_] | [1, _] | []) {
        return Array { components: 1, ..array };
    }
    let values = by_rows(&array.values, &axes);
    Array { components: array.values.len() / axes[0], values, ..array }
}
