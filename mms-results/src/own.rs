//! The cells and points of a snapshot that count: ghosts belong to another rank, and duplicates count once.

use std::cmp::Ordering;

use crate::cell::CellShape;
use crate::snapshot::GHOSTS;
use crate::{Array, Cells, Mistake, Snapshot};

/// The numbers of cells and points that do not count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// Ghost cells.
    pub ghost_cells: usize,
    /// Ghost points, and points of ghost cells alone.
    pub ghost_points: usize,
    /// Duplicate cells.
    pub doubled: usize,
    /// Points that belong to no cell, if there are cells.
    pub unused: usize,
}

/// Bits of `vtkGhostType` (vtkDataSetAttributes.h of VTK) for cells that do not count: a duplicate, a cell covered by finer
/// ones, a hidden one.
const CELLS: u64 = 1 | 8 | 32;
/// Bits of `vtkGhostType` for points that do not count: a duplicate, a hidden one.
const POINTS: u64 = 1 | 2;

/// The largest accepted difference of values of two ranks, relative to the largest number.
const SAME: f64 = 1e-6;

/// Removes ghosts and duplicate cells.
///
/// # Errors
/// A duplicate cell with different values.
pub fn keep(snapshot: &mut Snapshot) -> Result<LeftOut, Mistake> {
    let [ghost_cells, ghost_points] = without_ghosts(snapshot);
    let doubled = doubled(snapshot).map_err(|mistake| mistake.of(&snapshot.path))?;
    keep_cells(snapshot, &doubled);
    let unused = unused(snapshot);
    keep_points(snapshot, &unused);
    Ok(LeftOut { ghost_cells, ghost_points, doubled: count(&doubled), unused: count(&unused) })
}

/// Marks the points that belong to no cell, such as the centre of an arc. All points count without cells, and with vertices and
/// lines alone, which may accompany particles.
fn unused(snapshot: &Snapshot) -> Vec<bool> {
    let is_of_body = |(kind, points): (u8, &[usize])| match CellShape::of(kind, points.len()) {
        Some(shape) => shape.dimension > 1,
        None => !matches!(kind, 1 | 2 | 4),
    };
    let mut is_unused = vec![snapshot.cells.iter().any(is_of_body); snapshot.rows()];
    snapshot.cells.points.iter().for_each(|&point| is_unused[point] = false);
    is_unused
}

fn count(is_out: &[bool]) -> usize {
    is_out.iter().filter(|it| **it).count()
}

/// The rows that the arrays of ghosts mark; removes these arrays.
fn marked(arrays: &mut Vec<Array>, rows: usize, bits: u64) -> Vec<bool> {
    let mut is_ghost = vec![false; rows];
    let is_mark = |array: &Array| GHOSTS.contains(&&*array.name);
    for array in arrays.iter().filter(|it| is_mark(it) && it.values.len() == rows) {
        // The older array counts the layers between a cell and its rank.
        let bits = if array.name == GHOSTS[1] { u64::MAX } else { bits };
        let marks = is_ghost.iter_mut().zip(&array.values);
        marks.for_each(|(it, value)| *it |= *value as u64 & bits != 0);
    }
    arrays.retain(|array| !is_mark(array));
    is_ghost
}

/// Removes ghost cells, points that only these have, and ghost points that no cell needs.
fn without_ghosts(snapshot: &mut Snapshot) -> [usize; 2] {
    let (cells, points) = (snapshot.cells.len(), snapshot.rows());
    let of_cells = marked(&mut snapshot.of_cells, cells, CELLS);
    let mut of_points = marked(&mut snapshot.of_points, points, POINTS);
    let used = |cells: &Cells| {
        let mut used = vec![false; points];
        cells.points.iter().for_each(|&point| used[point] = true);
        used
    };
    let before = used(&snapshot.cells);
    keep_cells(snapshot, &of_cells);
    let after = used(&snapshot.cells);
    for (is_out, (before, after)) in of_points.iter_mut().zip(before.iter().zip(&after)) {
        *is_out = !after && (*is_out || *before);
    }
    keep_points(snapshot, &of_points);
    [count(&of_cells), count(&of_points)]
}

fn keep_cells(snapshot: &mut Snapshot, is_out: &[bool]) {
    if !is_out.contains(&true) {
        return;
    }
    let rows = is_out.len();
    let mut kept = Cells::default();
    for ((kind, points), _) in snapshot.cells.iter().zip(is_out).filter(|(_, is_out)| !**is_out) {
        kept.types.push(kind);
        kept.points.extend(points);
        kept.ends.push(kept.points.len());
    }
    snapshot.cells = kept;
    snapshot.of_cells.iter_mut().for_each(|array| keep_rows(array, rows, is_out));
}

fn keep_points(snapshot: &mut Snapshot, is_out: &[bool]) {
    if !is_out.contains(&true) {
        return;
    }
    let rows = is_out.len();
    let mut next = 0;
    let position = |is_out: &bool| {
        let position = next;
        next += usize::from(!is_out);
        position
    };
    let positions: Vec<usize> = is_out.iter().map(position).collect();
    snapshot.cells.points.iter_mut().for_each(|point| *point = positions[*point]);
    let arrays = snapshot.points.iter_mut().chain(&mut snapshot.of_points);
    arrays.for_each(|array| keep_rows(array, rows, is_out));
    let mut each = is_out.iter();
    snapshot.lines.retain(|_| each.next().is_none_or(|is_out| !is_out));
}

/// Removes rows from an array with this number of rows.
fn keep_rows(array: &mut Array, rows: usize, is_out: &[bool]) {
    if array.rows() == rows {
        let size = array.components;
        let mut at = 0;
        array.values.retain(|_| {
            at += 1;
            !is_out[(at - 1) / size]
        });
    }
}

/// Marks the cells whose points are at the places of an earlier cell: they are in two pieces, or were written twice.
fn doubled(snapshot: &Snapshot) -> Result<Vec<bool>, Mistake> {
    let mut is_out = vec![false; snapshot.cells.len()];
    let Some(places) = &snapshot.points else { return Ok(is_out) };
    let size = places.components;
    let place = |point: usize| &places.values[point * size..][..size];
    let digest = |point: usize| {
        // -0 becomes 0.
        let mix = |all: u64, x: &f64| {
            let mixed = (all ^ (x + 0.0).to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            mixed ^ (mixed >> 32)
        };
        place(point).iter().fold(1, mix)
    };
    let all: Vec<(u8, &[usize])> = snapshot.cells.iter().collect();
    let is_known = |(kind, points): (u8, &[usize])| CellShape::of(kind, points.len()).is_some();
    let known = all.iter().enumerate().filter(|(_, cell)| is_known(**cell));
    let sum =
        |points: &[usize]| points.iter().fold(0, |sum: u64, &it| sum.wrapping_add(digest(it)));
    let mut digests: Vec<_> = known.map(|(at, (_, points))| (sum(points), at)).collect();
    digests.sort_unstable();
    let compare = |&a: &usize, &b: &usize| {
        let pairs = place(a).iter().zip(place(b));
        let each = pairs.map(|(a, b)| (a + 0.0).total_cmp(&(b + 0.0)));
        each.fold(Ordering::Equal, Ordering::then)
    };
    let sorted = |cell: usize| {
        let mut points = all[cell].1.to_vec();
        points.sort_by(compare);
        points
    };
    let largest = |arrays: &[Array]| -> Vec<f64> {
        let most = |it: &Array| it.values.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
        arrays.iter().map(most).collect()
    };
    let mut sizes = None;
    for group in digests.chunk_by(|a, b| a.0 == b.0).filter(|it| it.len() > 1) {
        for (at, &(_, cell)) in group.iter().enumerate() {
            let points = sorted(cell);
            let is_same = |other: usize| {
                let others = sorted(other);
                let is_alike = points.iter().zip(&others).all(|(a, b)| compare(a, b).is_eq());
                (all[cell].0 == all[other].0 && points.len() == others.len() && is_alike)
                    .then_some((other, others))
            };
            let before = group[..at].iter().map(|it| it.1).filter(|&it| !is_out[it]);
            let Some((first, others)) = before.into_iter().find_map(is_same) else { continue };
            let [of_points, of_cells] = sizes
                .get_or_insert_with(|| [largest(&snapshot.of_points), largest(&snapshot.of_cells)]);
            let differs = |array: &Array, most: f64, [a, b]: [usize; 2]| {
                let row = |row: usize| array.values.get(row * array.components..).unwrap_or(&[]);
                let pairs = row(a).iter().zip(row(b)).take(array.components);
                pairs.into_iter().any(|(a, b)| (a - b).abs() > SAME * most)
            };
            let of_points = snapshot.of_points.iter().zip(of_points).find(|(array, most)| {
                let mut pairs = points.iter().zip(&others);
                pairs.any(|(a, b)| a != b && differs(array, **most, [*a, *b]))
            });
            let of_cells = snapshot.of_cells.iter().zip(of_cells);
            let mut of_cells =
                of_cells.filter(|(array, most)| differs(array, **most, [first, cell]));
            if let Some((array, _)) = of_points.or_else(|| of_cells.next()) {
                return Err(Mistake::new(format!(
                    "cell {cell} has the places of cell {first}, and other values of `{}`: leave one of them out, or \
                     mark it as a ghost with an array `vtkGhostType` of cells",
                    array.name
                )));
            }
            is_out[cell] = true;
        }
    }
    Ok(is_out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Stored;

    fn array(name: &str, components: usize, values: &[f64]) -> Array {
        Array {
            name: name.into(),
            components,
            values: values.to_vec(),
            stored: Stored::Double,
            ..Array::default()
        }
    }

    /// Lines of a bar, by their points.
    fn bar(points: &[f64], lines: &[[usize; 2]]) -> Snapshot {
        Snapshot {
            points: Some(array("Points", 1, points)),
            cells: Cells {
                types: vec![3; lines.len()],
                points: lines.concat(),
                ends: (1..=lines.len()).map(|it| 2 * it).collect(),
            },
            of_points: vec![array("u", 1, points)],
            of_cells: vec![array("J", 1, &vec![1.0; lines.len()])],
            ..Snapshot::default()
        }
    }

    #[test]
    fn ghosts_are_left_out_with_the_points_that_only_they_have() {
        let mut bar = bar(&[0.0, 1.0, 2.0, 7.0], &[[0, 1], [1, 2], [2, 3]]);
        bar.of_cells.push(array("vtkGhostType", 1, &[0.0, 2.0, 1.0]));
        // Another rank owns point 1, which a cell of this rank needs.
        bar.of_points.push(array("vtkGhostType", 1, &[0.0, 1.0, 0.0, 0.0]));
        let left_out = keep(&mut bar).unwrap();
        assert_eq!(left_out, LeftOut { ghost_cells: 1, ghost_points: 1, ..LeftOut::default() });
        assert_eq!(bar.cells.points, [0, 1, 1, 2]);
        assert_eq!(bar.of_points, [array("u", 1, &[0.0, 1.0, 2.0])]);
        assert_eq!(bar.of_cells, [array("J", 1, &[1.0, 1.0])]);
        let mut free = Snapshot { cells: Cells::default(), of_cells: Vec::new(), ..bar };
        free.of_points.push(array("vtkGhostLevels", 1, &[0.0, 2.0, 0.0]));
        assert_eq!(keep(&mut free).unwrap().ghost_points, 1);
        assert_eq!(free.of_points, [array("u", 1, &[0.0, 2.0])]);
    }

    #[test]
    fn a_cell_counts_once_and_not_with_two_values() {
        // The second piece has copies of points.
        let mut twice = bar(&[0.0, 1.0, 2.0, 1.0, 2.0, 3.0], &[[0, 1], [1, 2], [4, 3], [4, 5]]);
        let left_out = keep(&mut twice).unwrap();
        assert_eq!((left_out.doubled, left_out.unused), (1, 0));
        assert_eq!(twice.cells.points, [0, 1, 1, 2, 4, 5]);
        let mut other = bar(&[0.0, 1.0, 2.0, 1.0, 2.0], &[[0, 1], [1, 2], [4, 3]]);
        other.of_points[0].values[4] = 2.1;
        let mistake = keep(&mut other.clone()).unwrap_err();
        assert!(mistake.what.contains("cell 2 has the places of cell 1, and other values of `u`"));
        other.of_points[0].values[4] = 2.0;
        other.of_cells[0].values[2] = 3.0;
        assert!(keep(&mut other).unwrap_err().what.contains("other values of `J`"));
    }
}
