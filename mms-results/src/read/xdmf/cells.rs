//! The cells of a topology, by names and by numbers.

use roxmltree::Node;

use super::said;
use crate::{Cells, Mistake};

/// Kinds of cells: names, number in a mixed list, type in VTK, and the number of nodes; 0 if the file states that number.
const CELLS: &[(&[&str], usize, u8, usize)] = &[
    (&["polyvertex"], 1, 1, 0),
    (&["polyline"], 2, 4, 0),
    (&["polygon"], 3, 7, 0),
    (&["triangle"], 4, 5, 3),
    (&["quadrilateral"], 5, 9, 4),
    (&["tetrahedron"], 6, 10, 4),
    (&["pyramid"], 7, 14, 5),
    (&["wedge"], 8, 13, 6),
    (&["hexahedron"], 9, 12, 8),
    (&["edge_3"], 34, 21, 3),
    (&["quadrilateral_9", "quad_9"], 35, 28, 9),
    (&["triangle_6", "tri_6"], 36, 22, 6),
    (&["quadrilateral_8", "quad_8"], 37, 23, 8),
    (&["tetrahedron_10", "tet_10"], 38, 24, 10),
    (&["hexahedron_20", "hex_20"], 48, 25, 20),
    (&["hexahedron_27", "hex_27"], 50, 29, 27),
];

/// Cells of one kind.
pub fn alike(name: &str, node: Node<'_, '_>, points: &[usize]) -> Result<Cells, Mistake> {
    let known = CELLS.iter().find(|(names, ..)| names.contains(&name));
    let &(_, _, kind, size) =
        known.ok_or_else(|| Mistake::new(format!("a topology `{name}` is not read")))?;
    let declared = said(node, ["NodesPerElement"; 2], "");
    let size = match (size, declared.parse()) {
        (0, Ok(size)) => size,
        (0, Err(_)) if kind == 1 => 1,
        (size, _) => size,
    };
    if size == 0 || !points.len().is_multiple_of(size) {
        let what = format!("{} points of cells, and each `{name}` has {size}", points.len());
        return Err(Mistake::new(what));
    }
    let cells = points.len() / size;
    Ok(Cells {
        types: vec![of_size(kind, size); cells],
        points: points.to_vec(),
        ends: (1..=cells).map(|it| it * size).collect(),
    })
}

/// The type in VTK of a cell with this number of nodes: a polyline of two is a line, a polygon of four a quadrilateral.
fn of_size(kind: u8, size: usize) -> u8 {
    match (kind, size) {
        (1, 2..) => 2,
        (4, 2) => 3,
        (7, 3) => 5,
        (7, 4) => 9,
        (kind, _) => kind,
    }
}

/// Cells of many kinds: the points of each follow its kind, and their number if the kind does not determine it.
pub fn mixed(all: &[usize]) -> Result<Cells, Mistake> {
    let ends = || Mistake::new("the list of cells ends within a cell");
    let (mut cells, mut rest) = (Cells::default(), all);
    while let Some((&number, after)) = rest.split_first() {
        let known = CELLS.iter().find(|(_, it, ..)| *it == number);
        let &(_, _, kind, size) =
            known.ok_or_else(|| Mistake::new(format!("cells of type {number} are not read")))?;
        let (size, after) = match size {
            0 => after.split_first().map(|(size, after)| (*size, after)).ok_or_else(ends)?,
            size => (size, after),
        };
        let (points, after) = after.split_at_checked(size).ok_or_else(ends)?;
        cells.types.push(of_size(kind, size));
        cells.points.extend(points);
        cells.ends.push(cells.points.len());
        rest = after;
    }
    Ok(cells)
}
