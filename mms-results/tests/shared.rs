//! Helpers for the tests of readers: the common mesh of most files, and the test with broken files.

use std::path::Path;

use allocation_counter::measure;
use mms_results::cell::CellShape;
use mms_results::names::{KNOWN, Role, everything, recognise, wanted};
use mms_results::{Contents, Mistake, Snapshot, parse};

pub fn data(name: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name);
    std::fs::read(&path).unwrap_or_else(|error| panic!("{name}: {error}"))
}

pub fn all(bytes: &[u8]) -> Result<Vec<Snapshot>, Mistake> {
    match parse(bytes, &everything(&KNOWN))? {
        Contents::Snapshots(found) => Ok(found),
        other => panic!("{other:?}"),
    }
}

#[track_caller]
pub fn one(name: &str) -> Snapshot {
    let mut found = all(&data(name)).unwrap_or_else(|mistake| panic!("{name}: {mistake}"));
    assert_eq!(found.len(), 1, "{name}");
    found.remove(0)
}

#[track_caller]
pub fn values<'a>(snapshot: &'a Snapshot, name: &str) -> &'a [f64] {
    let arrays = snapshot.points.iter().chain(&snapshot.of_points).chain(&snapshot.of_cells);
    let found = arrays.into_iter().find(|it| it.name == name);
    &found.unwrap_or_else(|| panic!("no `{name}`")).values
}

/// The numbers of this quantity by name, in a plane.
#[track_caller]
pub fn of_role(snapshot: &Snapshot, role: Role, dimension: usize) -> Vec<f64> {
    let found = recognise(snapshot, &KNOWN, &|it| it == role).unwrap();
    let [meaning] = &found[..] else { panic!("{role:?}: {found:?}") };
    meaning.values(snapshot, dimension).unwrap().numbers.into_owned()
}

/// X and u of the grid of three by three points in the unit square: u = scale (0.1 X Y, -0.2 X).
pub fn grid(scale: f64) -> [Vec<f64>; 2] {
    let x: Vec<[f64; 2]> = (0..9).map(|it| [it % 3, it / 3].map(|it| it as f64 / 2.0)).collect();
    let u = x.iter().map(|[x, y]| [scale * 0.1 * x * y, scale * -0.2 * x]);
    [x.concat(), u.collect::<Vec<_>>().concat()]
}

#[track_caller]
pub fn near(name: &str, found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{name}");
    let far = found.iter().zip(expected).position(|(a, b)| (a - b).abs() > tolerance);
    assert!(far.is_none(), "{name}: {far:?}: {found:?} is not {expected:?}");
}

/// Reads a file cut off at every length, or changed at every byte. Checks that reading ends, uses no more memory than such a
/// file may need, and returns numbers if it succeeds.
#[track_caller]
pub fn survives(name: &str, bytes: &[u8]) {
    let u = |role: Role| role == Role::Displacement;
    let read = |bytes: &[u8]| {
        let taken = measure(|| drop(parse(bytes, &everything(&KNOWN)))).bytes_max as usize;
        assert!(taken < (1 << 20) + 80 * bytes.len(), "{name}: {taken} bytes");
        let _ = parse(bytes, &wanted(&KNOWN, &u));
        if let Ok(Contents::Snapshots(found)) =
            parse(bytes, &everything(&KNOWN).within(1 << 12, ""))
        {
            for snapshot in found {
                let points = snapshot.rows().max(snapshot.points.map_or(0, |it| it.rows()));
                assert!(snapshot.cells.points.iter().all(|it| *it < points), "{name}");
            }
        }
    };
    let mut failed = 0;
    for length in 0..bytes.len() {
        failed += usize::from(all(&bytes[..length]).is_err());
        read(&bytes[..length]);
    }
    assert!(failed > bytes.len() / 2, "{name}: {failed} of {} are mistakes", bytes.len());
    let mut changed = bytes.to_vec();
    for at in 0..bytes.len() {
        changed[at] = [0xff, b'9', bytes[at] ^ 1][at % 3];
        read(&changed);
        changed[at] = bytes[at];
    }
}

/// The nodes of a cell of this type in VTK (`vtkQuadraticWedge.h` and others for types that are no shape here).
pub fn nodes(kind: u8, points: usize) -> Vec<[f64; 3]> {
    if let Some(shape) = CellShape::of(kind, points) {
        return shape.nodes.clone();
    }
    let corners = if kind == 27 { &PYRAMID[..] } else { &PRISM };
    let middles: &[&[usize]] = match kind {
        26 => &WEDGE[..9],
        27 => &[&[0, 1], &[1, 2], &[2, 3], &[3, 0], &[0, 4], &[1, 4], &[2, 4], &[3, 4]],
        32 => &WEDGE,
        _ => panic!("type {kind}"),
    };
    let middle = |of: &&[usize]| {
        [0, 1, 2].map(|axis| of.iter().map(|it| corners[*it][axis]).sum::<f64>() / of.len() as f64)
    };
    corners.iter().copied().chain(middles.iter().map(middle)).collect()
}

const PYRAMID: [[f64; 3]; 5] =
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

const PRISM: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
];

const WEDGE: [&[usize]; 12] = [
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

/// Checks that reference cells, one beside the other along X, have their nodes at the places of VTK.
#[track_caller]
pub fn nodes_are_in_place(name: &str, snapshot: &Snapshot, kinds: &[u8]) {
    let places = snapshot.points.as_ref().unwrap().values.as_chunks::<3>().0;
    let mut found: Vec<(f64, u8)> = Vec::new();
    for (kind, points) in snapshot.cells.iter() {
        let mut own: Vec<_> = points.iter().map(|it| places[*it]).collect();
        let start = own.iter().fold(f64::INFINITY, |least, it| least.min(it[0]));
        own.iter_mut().for_each(|it| it[0] -= start);
        let expected = nodes(kind, points.len());
        near(&format!("{name}: type {kind}"), own.as_flattened(), expected.as_flattened(), 1e-12);
        found.push((start, kind));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(found.iter().map(|it| it.1).collect::<Vec<_>>(), kinds, "{name}");
}
