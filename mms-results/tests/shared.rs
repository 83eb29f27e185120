//! What the tests of readers share: the mesh that most files hold, and how broken files are tried.

use std::path::Path;

use allocation_counter::measure;
use mms_results::names::{Role, everything, recognise, wanted};
use mms_results::{Contents, Mistake, Snapshot, parse};

pub fn data(name: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name);
    std::fs::read(&path).unwrap_or_else(|error| panic!("{name}: {error}"))
}

pub fn all(bytes: &[u8]) -> Result<Vec<Snapshot>, Mistake> {
    match parse(bytes, &everything(&[]))? {
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

/// The numbers that names say are of this quantity, in a plane.
#[track_caller]
pub fn of_role(snapshot: &Snapshot, role: Role, dimension: usize) -> Vec<f64> {
    let found = recognise(snapshot, &[], &|it| it == role).unwrap();
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

/// Reads a file that is cut off at every length, or changed at every byte: that ends, without more memory than such
/// a file may take, and with numbers where it says so.
#[track_caller]
pub fn survives(name: &str, bytes: &[u8]) {
    let u = |role: Role| role == Role::Displacement;
    let read = |bytes: &[u8]| {
        let taken = measure(|| drop(parse(bytes, &everything(&[])))).bytes_max as usize;
        assert!(taken < (1 << 20) + 80 * bytes.len(), "{name}: {taken} bytes");
        let _ = parse(bytes, &wanted(&[], &u));
        if let Ok(Contents::Snapshots(found)) = parse(bytes, &everything(&[]).within(1 << 12, "")) {
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
        for byte in [0, 0x7f, 0xff, b'9', bytes[at] ^ 1] {
            changed[at] = byte;
            read(&changed);
        }
        changed[at] = bytes[at];
    }
}
