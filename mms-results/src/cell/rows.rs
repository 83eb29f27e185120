//! Kinds of cells as data.

use super::{Local, Space};

/// A kind of cell as data: its number in VTK, dimension, corners, the corners around each other node, and its polynomials.
pub(super) type CellType = (u8, usize, &'static [Local], &'static [&'static [usize]], Space);

const LINE: &[Local] = &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
const TRIANGLE: &[Local] = &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
const QUAD: &[Local] = &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
const PIXEL: &[Local] = &[QUAD[0], QUAD[1], QUAD[3], QUAD[2]];
const TETRA: &[Local] = &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
pub(super) const HEX: &[Local] = &[
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
];
const WEDGE: &[Local] = &[TETRA[0], TETRA[1], TETRA[2], HEX[4], HEX[5], HEX[7]];
const PYRAMID: &[Local] = &[HEX[0], HEX[1], HEX[2], HEX[3], HEX[4]];
const VOXEL: &[Local] = &[HEX[0], HEX[1], HEX[3], HEX[2], HEX[4], HEX[5], HEX[7], HEX[6]];
const QUAD_EDGES: [&[usize]; 4] = [&[0, 1], &[1, 2], &[2, 3], &[3, 0]];
const HEX_EDGES: [&[usize]; 12] = [
    &[0, 1],
    &[1, 2],
    &[2, 3],
    &[3, 0],
    &[4, 5],
    &[5, 6],
    &[6, 7],
    &[7, 4],
    &[0, 4],
    &[1, 5],
    &[2, 6],
    &[3, 7],
];
const HEX_MIDDLES: [&[usize]; 19] = {
    let mut all: [&[usize]; 19] = [&[]; 19];
    let mut edge = 0;
    while edge < 12 {
        all[edge] = HEX_EDGES[edge];
        edge += 1;
    }
    all[12] = &[0, 4, 7, 3];
    all[13] = &[1, 2, 6, 5];
    all[14] = &[0, 1, 5, 4];
    all[15] = &[3, 7, 6, 2];
    all[16] = &[0, 3, 2, 1];
    all[17] = &[4, 5, 6, 7];
    all[18] = &[0, 1, 2, 3, 4, 5, 6, 7];
    all
};

/// The edges of a wedge, and its upright sides.
const WEDGE_EDGES: [&[usize]; 12] = [
    &[0, 1],
    &[1, 2],
    &[2, 0],
    &[3, 4],
    &[4, 5],
    &[5, 3],
    &[0, 3],
    &[1, 4],
    &[2, 5],
    &[0, 1, 4, 3],
    &[1, 2, 5, 4],
    &[2, 0, 3, 5],
];
pub(super) const ROWS: &[CellType] = &[
    (3, 1, LINE, &[], Space::Product([1; 3])),
    (5, 2, TRIANGLE, &[], Space::Complete(1)),
    (8, 2, PIXEL, &[], Space::Product([1; 3])),
    (9, 2, QUAD, &[], Space::Product([1; 3])),
    (10, 3, TETRA, &[], Space::Complete(1)),
    (11, 3, VOXEL, &[], Space::Product([1; 3])),
    (12, 3, HEX, &[], Space::Product([1; 3])),
    (13, 3, WEDGE, &[], Space::Wedge([1, 1])),
    (14, 3, PYRAMID, &[], Space::Pyramid),
    (21, 1, LINE, &[&[0, 1]], Space::Product([2; 3])),
    (22, 2, TRIANGLE, &[&[0, 1], &[1, 2], &[2, 0]], Space::Complete(2)),
    (23, 2, QUAD, &QUAD_EDGES, Space::Serendipity),
    (24, 3, TETRA, &[&[0, 1], &[1, 2], &[2, 0], &[0, 3], &[1, 3], &[2, 3]], Space::Complete(2)),
    (25, 3, HEX, &HEX_EDGES, Space::Serendipity),
    (28, 2, QUAD, &[&[0, 1], &[1, 2], &[2, 3], &[3, 0], &[0, 1, 2, 3]], Space::Product([2; 3])),
    (29, 3, HEX, &HEX_MIDDLES, Space::Product([2; 3])),
    (26, 3, WEDGE, WEDGE_EDGES.split_at(9).0, Space::WedgeSerendipity),
    (30, 2, QUAD, &[&[0, 1], &[2, 3]], Space::Product([2, 1, 1])),
    (31, 3, WEDGE, WEDGE_EDGES.split_at(6).0, Space::Wedge([2, 1])),
    (32, 3, WEDGE, &WEDGE_EDGES, Space::Wedge([2, 2])),
    (33, 3, HEX, HEX_MIDDLES.split_at(16).0, Space::Sides),
];
