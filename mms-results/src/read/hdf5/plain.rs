//! Arrays of any HDF5 or netCDF file by their paths, and variables of MATLAB.

use mms_hdf5::Set;

use super::super::numbers::by_rows;
use super::super::table::is_time;
use super::{File, MOST_TIMES, by_time};
use crate::{Array, Mistake, Snapshot};

/// The most numbers of a point at one time, if the first axis is the times.
const MOST_COMPONENTS: usize = 9;

/// Reads the wanted arrays. The first axis is the points; if there are several times, they precede it.
pub fn parse(file: &File<'_>, is_matlab: bool) -> Result<Vec<Snapshot>, Mistake> {
    let sets = file.store.sets().map_err(Mistake::new)?;
    let ends_with = |end: &str| sets.iter().any(|it| it.path.rsplit('/').next() == Some(end));
    if ends_with("cell_dofs") && ends_with("x_cell_dofs") {
        return Err(Mistake::new(
            "a checkpoint of dolfin holds degrees of freedom, and no values at points: give the .xdmf file beside it, or \
             write one with `XDMFFile.write`",
        ));
    }
    // An array of that name may be another quantity of points.
    let is_clock = |it: &Set| {
        let is_list = it.shape.len() < 2 || it.count() == Some(1);
        is_time(&it.path) && it.kind.bytes().is_some() && is_list && it.count() <= Some(MOST_TIMES)
    };
    let clock = sets.iter().find(|it| is_clock(it));
    let times = clock.map(|it| file.times(it)).transpose()?.unwrap_or_default();
    let layout = Layout::of(&sets, if is_matlab { 0 } else { times.len() });
    let (mut whole, mut by_times) = (Snapshot::default(), Vec::new());
    for set in sets.iter().filter(|it| clock.is_none_or(|clock| clock.path != it.path)) {
        let name = set.path.clone();
        let is_hidden = is_matlab && is_hidden(file, set);
        let found = if is_hidden { None } else { file.wanted(set, &name)? };
        match (found, layout.components(set)) {
            (None, _) => whole.unread.push(name),
            (Some(array), Some(components)) => by_times.push((array, components)),
            (Some(array), None) if is_matlab => whole.of_points.push(of_matlab(array, &set.shape)),
            (Some(array), None) => whole.of_points.push(array),
        }
    }
    if by_times.is_empty() {
        // With several times it is not known which of them the arrays have; they may be temperatures.
        let time = times.first().filter(|_| times.len() == 1).copied();
        if let Some(set) = clock.filter(|_| time.is_none()) {
            match file.wanted(set, &set.path)? {
                Some(array) => whole.of_points.push(array),
                None => whole.unread.push(set.path.clone()),
            }
        }
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

/// The number of times of a file, and the number of points of its arrays over times.
struct Layout {
    times: usize,
    points: Option<usize>,
}

impl Layout {
    /// Finds the layout from an array of times, points and components. Another array confirms the number of points, or excludes
    /// that it is a tensor with as many points as times.
    fn of(sets: &[Set], times: usize) -> Layout {
        let has_rows = |rows: usize| {
            sets.iter().any(|it| {
                it.kind.bytes().is_some() && matches!(it.shape[..], [it, _] if it == rows)
            })
        };
        let points = sets.iter().find_map(|it| match it.shape[..] {
            [first, points, components] if it.kind.bytes().is_some() => {
                let is_shown = has_rows(points) || times > 1 && !has_rows(first);
                let is_small = (1..=MOST_COMPONENTS).contains(&components);
                (first == times && is_shown && is_small).then_some(points)
            }
            _ => None,
        });
        Layout { times, points }
    }

    /// The number of components of a point at each time; `None` for an array not over times.
    fn components(&self, set: &Set) -> Option<usize> {
        match (&set.shape[..], self.points?) {
            (&[first, second, last], points) if first == self.times && second == points => {
                (1..=MOST_COMPONENTS).contains(&last).then_some(last)
            }
            (&[first, second], points) if first == self.times && second == points => Some(1),
            _ => None,
        }
    }
}

/// Whether a variable of MATLAB contains words or nothing, or belongs to a cell array.
fn is_hidden(file: &File<'_>, set: &Set) -> bool {
    let is_word = || file.word(&set.path, "MATLAB_class").is_some_and(|it| it == "char");
    set.path.starts_with('#') || is_word() || file.numbers(&set.path, "MATLAB_empty").is_some()
}

/// Converts a variable of MATLAB, whose first axis runs fastest, and is last in HDF5. A row of numbers becomes a column.
fn of_matlab(array: Array, shape: &[usize]) -> Array {
    let axes: Vec<usize> = shape.iter().rev().copied().collect();
    if array.values.is_empty() || matches!(axes[..], [_] | [1, _] | []) {
        return Array { components: 1, ..array };
    }
    let values = by_rows(&array.values, &axes);
    Array { components: array.values.len() / axes[0], values, ..array }
}
