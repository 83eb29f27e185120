//! The evenly spaced nodes of Lagrange cells in the order of VTK: vtkHigherOrderTriangle, vtkHigherOrderHexahedron and similar
//! classes in the documentation of VTK. Corners come first, then the nodes of edges, of faces, and inner nodes.

/// The highest degree that is read.
pub(super) const MOST: usize = 10;

/// The number of a curve in VTK; a triangle, a quadrilateral, a tetrahedron, a hexahedron and a wedge follow.
const CURVE: u8 = 68;

/// The number of kinds.
pub(super) const KINDS: usize = 6;

/// The faces of a tetrahedron by its corners.
const FACES: [[usize; 3]; 4] = [[0, 1, 3], [2, 3, 1], [0, 3, 2], [0, 2, 1]];

/// A node by its steps along the axes; from end to end there are as many steps as the degree.
type Steps = [usize; 3];

/// The position of a VTK type among these kinds. A cubic line is a curve of degree 3.
pub(super) fn position(kind: u8) -> Option<usize> {
    let kind = if kind == 35 { CURVE } else { kind };
    Some(usize::from(kind.checked_sub(CURVE)?)).filter(|it| *it < KINDS)
}

/// The degree of a cell with this number of points.
pub(super) fn degree(position: usize, points: usize) -> Option<usize> {
    (1..=MOST).find(|&degree| {
        let side = degree + 1;
        let triangle = side * (side + 1) / 2;
        let all = [
            side,
            triangle,
            side * side,
            triangle * (side + 2) / 3,
            side * side * side,
            triangle * side,
        ];
        all[position] == points
    })
}

/// The nodes of a cell of this degree.
pub(super) fn nodes(position: usize, n: usize) -> Vec<Steps> {
    match position {
        0 => [0, n].into_iter().chain(1..n).map(|x| [x, 0, 0]).collect(),
        1 => triangle(n).into_iter().map(|[_, x, y]| [x, y, 0]).collect(),
        2 => square(n).concat().into_iter().map(|[x, y]| [x, y, 0]).collect(),
        3 => tetrahedron(n).into_iter().map(|[_, x, y, z]| [x, y, z]).collect(),
        4 => hexahedron(n),
        _ => wedge(n),
    }
}

/// The nodes of a triangle by their barycentric coordinates. The inner nodes form a triangle again.
fn triangle(n: usize) -> Vec<[usize; 3]> {
    if n == 0 {
        return vec![[0; 3]];
    }
    let mut all = simplex_edges(n, &[[0, 1], [1, 2], [2, 0]]);
    all.extend(within(n, 3).map_or(Vec::new(), triangle).into_iter().map(|it| it.map(|at| at + 1)));
    all
}

fn tetrahedron(n: usize) -> Vec<[usize; 4]> {
    if n == 0 {
        return vec![[0; 4]];
    }
    let mut all = simplex_edges(n, &[[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]]);
    for face in FACES {
        for own in within(n, 3).map_or(Vec::new(), triangle) {
            let mut at = [0; 4];
            face.iter().zip(own).for_each(|(&corner, own)| at[corner] = own + 1);
            all.push(at);
        }
    }
    let inner = within(n, 4).map_or(Vec::new(), tetrahedron).into_iter();
    all.extend(inner.map(|it| it.map(|at| at + 1)));
    all
}

/// The degree of the inner nodes of a simplex with this number of corners.
fn within(n: usize, corners: usize) -> Option<usize> {
    n.checked_sub(corners)
}

/// The corners of a simplex, and the nodes of its edges.
fn simplex_edges<const N: usize>(n: usize, edges: &[[usize; 2]]) -> Vec<[usize; N]> {
    let corner = |at: usize| {
        let mut all = [0; N];
        all[at] = n;
        all
    };
    let between = |&[a, b]: &[usize; 2]| {
        (1..n).map(move |step| {
            let mut all = [0; N];
            (all[a], all[b]) = (n - step, step);
            all
        })
    };
    (0..N).map(corner).chain(edges.iter().flat_map(between)).collect()
}

/// The corners of a square, the nodes of its edges, and the inner nodes.
fn square(n: usize) -> [Vec<[usize; 2]>; 3] {
    let along = |at: fn(usize, usize) -> [usize; 2]| (1..n).map(move |step| at(step, n));
    let edges = along(|it, _| [it, 0])
        .chain(along(|it, n| [n, it]))
        .chain(along(|it, n| [it, n]))
        .chain(along(|it, _| [0, it]));
    let inner = (1..n).flat_map(|y| (1..n).map(move |x| [x, y]));
    [vec![[0, 0], [n, 0], [n, n], [0, n]], edges.collect(), inner.collect()]
}

fn hexahedron(n: usize) -> Vec<Steps> {
    let [corners, edges, inner] = square(n);
    let layer =
        |of: &[[usize; 2]], z: usize| of.iter().map(|&[x, y]| [x, y, z]).collect::<Vec<_>>();
    let ends = [0, n];
    let mut all = Vec::new();
    ends.iter().for_each(|&z| all.extend(layer(&corners, z)));
    ends.iter().for_each(|&z| all.extend(layer(&edges, z)));
    all.extend(corners.iter().flat_map(|&[x, y]| (1..n).map(move |z| [x, y, z])));
    ends.iter().for_each(|&x| all.extend(inner.iter().map(|&[y, z]| [x, y, z])));
    ends.iter().for_each(|&y| all.extend(inner.iter().map(|&[x, z]| [x, y, z])));
    ends.iter().for_each(|&z| all.extend(layer(&inner, z)));
    (1..n).for_each(|z| all.extend(layer(&inner, z)));
    all
}

fn wedge(n: usize) -> Vec<Steps> {
    let all_of_edges = simplex_edges::<3>(n, &[[0, 1], [1, 2], [2, 0]]);
    let plane: Vec<[usize; 2]> = all_of_edges.into_iter().map(|[_, x, y]| [x, y]).collect();
    let (corners, edges) = plane.split_at(3);
    let inner: Vec<[usize; 2]> =
        (1..n).flat_map(|y| (1..n.saturating_sub(y)).map(move |x| [x, y])).collect();
    let layer =
        |of: &[[usize; 2]], z: usize| of.iter().map(|&[x, y]| [x, y, z]).collect::<Vec<_>>();
    let ends = [0, n];
    let mut all = Vec::new();
    ends.iter().for_each(|&z| all.extend(layer(corners, z)));
    ends.iter().for_each(|&z| all.extend(layer(edges, z)));
    all.extend(corners.iter().flat_map(|&[x, y]| (1..n).map(move |z| [x, y, z])));
    ends.iter().for_each(|&z| all.extend(layer(&inner, z)));
    for edge in edges.chunks((n - 1).max(1)) {
        (1..n).for_each(|z| all.extend(layer(edge, z)));
    }
    (1..n).for_each(|z| all.extend(layer(&inner, z)));
    all
}

/// The positions of the nodes of the last two upright edges of a hexahedron: files of old versions swap them.
pub(crate) fn last_edges(kind: u8, points: usize) -> Option<[usize; 3]> {
    let degree = degree(position(kind).filter(|it| *it == 4)?, points)?;
    let start = 8 + 10 * (degree - 1);
    Some([start, start + degree - 1, start + 2 * (degree - 1)])
}
