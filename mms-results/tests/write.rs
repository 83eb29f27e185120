//! Written files are read back to the bit, by readers that are tested on files of meshio, VTK and NumPy (`files.rs`).

use mms_results::names::{Axes, KNOWN, Role, everything, recognise};
use mms_results::write::{ArrayShape, Column, Fact, Mesh, State, Value, csv, npz, vtu};
use mms_results::{Cells, Contents, Snapshot, Stored, parse};

const COUNT: usize = 7;

/// Numbers that need all their digits, of any size and sign.
fn number(seed: usize) -> f64 {
    let seed = seed as f64 + 1.0;
    (seed * 1.234_567_89).sin() * 10f64.powi((seed as i32 * 7) % 19 - 9)
}

fn column(name: &str, shape: ArrayShape, dimension: usize) -> Column {
    let count = COUNT * shape.components(dimension);
    let value = |at| if shape == ArrayShape::Whole { at as f64 } else { number(at + name.len()) };
    Column { name: name.into(), shape, values: (0..count).map(value).collect() }
}

/// A state with the names of tables, and one with the names of VTK.
fn state(dimension: usize, time: f64, [x, u, f]: [&str; 3]) -> State {
    let columns = vec![
        column(x, ArrayShape::Vector, dimension),
        column(u, ArrayShape::Vector, dimension),
        column(f, ArrayShape::Tensor, dimension),
        column("volume", ArrayShape::Scalar, dimension),
        column("particle", ArrayShape::Whole, dimension),
    ];
    let numbers = Value::Numbers(vec![number(0), number(1)]);
    let facts = [("time_window", numbers), ("face_x_min", Value::Word("fixed".into()))];
    let facts = facts.map(|(name, value)| Fact { name: name.into(), value }).to_vec();
    State { time, dimension, axes: Axes::Cartesian, facts, columns }
}

const SYMBOLS: [&str; 3] = ["X", "u", "F"];
const NAMES: [&str; 3] = ["reference_position", "displacement", "deformation_gradient"];

fn snapshots(bytes: &[u8]) -> Vec<Snapshot> {
    match parse(bytes, &everything(&KNOWN)).unwrap() {
        Contents::Snapshots(snapshots) => snapshots,
        other => panic!("{other:?}"),
    }
}

#[track_caller]
fn holds(snapshot: &Snapshot, state: &State) {
    let time = snapshot.time.unwrap();
    assert_eq!(time.value, state.time);
    assert!(time.rounding <= f64::EPSILON * time.value.abs(), "{time:?}");
    let found = recognise(snapshot, &KNOWN, &|_| true).unwrap();
    let roles = [Role::Reference, Role::Displacement, Role::DeformationGradient, Role::Volume];
    for (role, column) in roles.into_iter().zip(&state.columns) {
        let meaning = found.iter().find(|it| it.role == role).unwrap_or_else(|| panic!("{role:?}"));
        let values = meaning.values(snapshot, state.dimension).unwrap();
        assert_eq!(values.numbers, column.values, "{role:?}");
        assert_eq!(values.stored, Stored::Double, "{role:?}");
    }
    let particle = snapshot.of_points.iter().find(|it| it.name == "particle").unwrap();
    assert_eq!(particle.values, state.columns[4].values);
}

#[test]
fn tables_hold_all_times() {
    for dimension in 1..=3 {
        let states = [0.1, -3.0, 1e-300].map(|time| state(dimension, time, SYMBOLS));
        let mut text = Vec::new();
        csv(&states.each_ref(), &mut text).unwrap();
        let found = snapshots(&text);
        for (snapshot, time) in found.iter().zip([1, 2, 0]) {
            holds(snapshot, &states[time]);
        }
    }
}

#[test]
fn axes_have_their_letters_in_tables() {
    let header = |dimension| {
        let mut text = Vec::new();
        csv(&[&state(dimension, 0.0, SYMBOLS)], &mut text).unwrap();
        String::from_utf8(text).unwrap().lines().next().unwrap().to_owned()
    };
    assert_eq!(header(1), "time,X,u,F,volume,particle");
    assert_eq!(header(2), "time,X,Y,u_x,u_y,F_xx,F_xy,F_yx,F_yy,volume,particle");
}

#[test]
fn arrays_of_numpy_are_read_back() {
    for dimension in 1..=3 {
        let state = state(dimension, 0.125, SYMBOLS);
        let mut bytes = Vec::new();
        npz(&state, &mut bytes).unwrap();
        let found = &snapshots(&bytes)[0];
        holds(found, &state);
        // Properties do not change the number of points; words are skipped.
        let window = found.of_points.iter().find(|it| it.name == "time_window").unwrap();
        assert_eq!(window.values, [number(0), number(1)]);
        assert!(found.rows() == COUNT && found.of_points.iter().all(|it| it.name != "face_x_min"));
    }
}

#[test]
fn grids_of_vtk_are_read_back_with_their_cells() {
    let cells = Cells { types: vec![5, 3], points: vec![0, 1, 2, 3, 4], ends: vec![3, 5] };
    for dimension in 1..=3 {
        let state = state(dimension, 0.125, NAMES);
        let position = column("", ArrayShape::Vector, dimension).values;
        for given in [&Cells::default(), &cells] {
            let mut bytes = Vec::new();
            vtu(&state, Mesh { position: &position, cells: given }, &mut bytes).unwrap();
            let found = &snapshots(&bytes)[0];
            holds(found, &state);
            let points = found.points.as_ref().unwrap();
            let flat = points.values.chunks(3).flat_map(|point| &point[..dimension]);
            assert_eq!(flat.copied().collect::<Vec<_>>(), position);
            let expected = if given.is_empty() { vec![1; COUNT] } else { cells.types.clone() };
            assert_eq!(found.cells.types, expected);
        }
    }
}
