//! The node order of Gmsh for elements of order 3 and more ("Gmsh Reference Manual", section "Node ordering"): first the
//! corners, then the nodes of the edges, of the faces, and the inner nodes. The nodes inside a face, and the inner nodes, are
//! numbered like the nodes of a smaller element.

use crate::cell::CellShape;

/// A place by its steps along the axes; from end to end there are as many steps as the order.
type Steps = [i32; 3];

/// The corners of an element of one step, and its edges and faces by corners.
type Form = (&'static [Steps], &'static [[usize; 2]], &'static [&'static [usize]]);

const SQUARE: Form = (
    &[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
    &[[0, 1], [1, 2], [2, 3], [3, 0]],
    &[&[0, 1, 2, 3]],
);
const TRIANGLE: Form =
    (&[[0, 0, 0], [1, 0, 0], [0, 1, 0]], &[[0, 1], [1, 2], [2, 0]], &[&[0, 1, 2]]);
const TETRAHEDRON: Form = (
    &[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    &[[0, 1], [1, 2], [2, 0], [3, 0], [3, 2], [3, 1]],
    &[&[0, 2, 1], &[0, 1, 3], &[0, 3, 2], &[3, 1, 2]],
);
const HEXAHEDRON: Form = (
    &[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
    &[
        [0, 1],
        [0, 3],
        [0, 4],
        [1, 2],
        [1, 5],
        [2, 3],
        [2, 6],
        [3, 7],
        [4, 5],
        [4, 7],
        [5, 6],
        [6, 7],
    ],
    &[&[0, 3, 2, 1], &[0, 1, 5, 4], &[0, 4, 7, 3], &[1, 2, 6, 5], &[2, 3, 7, 6], &[4, 5, 6, 7]],
);

/// The nodes in the order of VTK, by their positions in Gmsh, for a Lagrange element of this VTK type.
pub fn order(of_vtk: u8, nodes: usize) -> Vec<usize> {
    let (form, inner) = match of_vtk {
        70 => (SQUARE, None),
        71 => (TETRAHEDRON, Some(4)),
        _ => (HEXAHEDRON, Some(2)),
    };
    let order = (1..).find(|order| volume(form, inner, *order).len() >= nodes).unwrap_or(1);
    let own = volume(form, inner, order);
    let shape = CellShape::of(of_vtk, nodes).expect("a cell of Lagrange that is known");
    let place = |at: &[f64; 3]| {
        let steps = at.map(|it| (it * f64::from(order)).round() as i32);
        own.iter().position(|it| *it == steps).expect("the same nodes in Gmsh and in VTK")
    };
    shape.nodes.iter().map(place).collect()
}

/// All nodes of an element. The inner nodes form an element whose order is lower by `inner`. `inner` is `None` for an element in
/// the plane: its inner nodes are the nodes of its face.
fn volume(form: Form, inner: Option<i32>, order: i32) -> Vec<Steps> {
    let corners: Vec<Steps> = form.0.iter().map(|it| it.map(|it| order * it)).collect();
    let mut all = frame(&corners, form, order);
    if let Some(inner) = inner.filter(|it| *it <= order && order > 0) {
        all.extend(
            volume(form, Some(inner), order - inner).into_iter().map(|it| it.map(|it| it + 1)),
        );
    }
    all
}

/// The nodes on corners, edges and faces of an element with these corners.
fn frame(corners: &[Steps], (_, edges, faces): Form, order: i32) -> Vec<Steps> {
    if order == 0 {
        return corners[..1].to_vec();
    }
    let step = |[a, b]: [usize; 2], count: i32| -> Steps {
        std::array::from_fn(|axis| (corners[b][axis] - corners[a][axis]) / order * count)
    };
    let moved = |from: Steps, by: Steps| -> Steps { std::array::from_fn(|it| from[it] + by[it]) };
    let mut all = corners.to_vec();
    for edge in edges {
        all.extend((1..order).map(|count| moved(corners[edge[0]], step(*edge, count))));
    }
    for face in faces {
        let (form, left) = match face.len() {
            3 => (TRIANGLE, order - 3),
            _ => (SQUARE, order - 2),
        };
        if left < 0 {
            continue;
        }
        let [one, other] = [[face[0], face[1]], [face[0], face[face.len() - 1]]];
        let start = moved(corners[face[0]], moved(step(one, 1), step(other, 1)));
        let corner =
            |at: &Steps| moved(start, moved(step(one, left * at[0]), step(other, left * at[1])));
        let inner: Vec<Steps> = form.0.iter().map(corner).collect();
        all.extend(frame(&inner, form, left));
    }
    all
}
