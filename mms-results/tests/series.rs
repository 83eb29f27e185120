//! Archives of NumPy with several times and with odd members (`data/write_npz.py`).

use mms_results::Stored;
use mms_results::names::{KNOWN, Role, wanted};
use mms_results::{Contents, parse};

use crate::shared::{all, data, grid, near, of_role, one, survives};

const TIMES: [f64; 3] = [0.25, 0.5, 1.0];

#[test]
fn every_time_is_a_snapshot() {
    for name in ["times.npz", "times_everywhere.npz"] {
        let found = all(&data(name)).unwrap();
        let times: Vec<_> = found.iter().map(|it| it.time.unwrap().value).collect();
        assert_eq!(times, TIMES, "{name}");
        for (snapshot, time) in found.iter().zip(TIMES) {
            let [x, u] = grid(time);
            assert_eq!(snapshot.rows(), 9, "{name}");
            near(name, &of_role(snapshot, Role::Reference, 2), &x, 0.0);
            near(name, &of_role(snapshot, Role::Displacement, 2), &u, 1e-16);
        }
    }
    let found = all(&data("times.npz")).unwrap();
    assert_eq!(found[2].unread, ["cells"]);
    let [x, _] = grid(1.0);
    let of_f = x.chunks(2).flat_map(|it| [1.0 + 0.05 * it[1], 0.05 * it[0], -0.1, 1.0]);
    let gradient = of_role(&found[1], Role::DeformationGradient, 2);
    near("F", &gradient, &of_f.collect::<Vec<_>>(), 1e-15);
}

#[test]
fn odd_members_are_left_out_by_name() {
    let snapshot = one("odd.npz");
    let [x, u] = grid(0.25);
    assert_eq!(of_role(&snapshot, Role::Reference, 2), x);
    // Half precision has eleven bits.
    near("u", &of_role(&snapshot, Role::Displacement, 2), &u, 0.05 / 2048.0);
    let stored =
        |name: &str| snapshot.of_points.iter().find(|it| it.name == name).map(|it| it.stored);
    assert_eq!((stored("u"), stored("truth")), (Some(Stored::Digits(3)), Some(Stored::Whole)));
    assert_eq!(snapshot.time.map(|it| it.value), Some(0.25));
    let expected = [
        "note",
        "words",
        "objects",
        "structured",
        "complex",
        "long",
        "date",
        "number",
        "readme.txt",
    ];
    assert_eq!(snapshot.unread, expected);
}

/// A NumPy array with numbers that count from 0 in these steps.
fn npy(kind: &str, shape: &[usize], step: f64) -> Vec<u8> {
    let axes: String = shape.iter().map(|it| format!("{it},")).collect();
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({axes}), }}\n");
    let mut all = b"\x93NUMPY\x01\x00".to_vec();
    all.extend((header.len() as u16).to_le_bytes());
    all.extend(header.as_bytes());
    let count = shape.iter().product::<usize>();
    all.extend((0..count).flat_map(|it| (it as f64 * step).to_le_bytes()));
    all
}

/// Reads arrays of these shapes: returns the number of times, of components, and of points of `u`.
fn read(arrays: &[(&str, &str, &[usize])]) -> Result<(usize, usize, usize), String> {
    let arrays: Vec<_> = arrays
        .iter()
        .map(|(name, kind, shape)| {
            (*name, npy(kind, shape, if *name == "time" { 0.0 } else { 0.125 }))
        })
        .collect();
    let entries: Vec<_> = arrays.iter().map(|(name, bytes)| (*name, &bytes[..])).collect();
    let found = all(&crate::archives::archive(&entries)).map_err(|it| it.what)?;
    let u = found[0].of_points.iter().find(|it| it.name == "u").unwrap();
    Ok((found.len(), u.components, u.rows()))
}

#[test]
fn shapes_say_whether_there_are_times() {
    const F8: &str = "<f8";
    let of =
        |t: &[usize], x: &[usize], u: &[usize]| read(&[("t", F8, t), ("X", F8, x), ("u", F8, u)]);
    assert_eq!(of(&[3], &[7, 2], &[3, 7, 2]), Ok((3, 2, 7)));
    assert_eq!(of(&[3], &[3, 7, 2], &[3, 7, 2]), Ok((3, 2, 7)));
    assert_eq!(of(&[3], &[7], &[3, 7]), Ok((3, 1, 7)));
    assert_eq!(of(&[3], &[7, 1], &[3, 7]), Ok((3, 1, 7)));
    // Times that are no axis of any array, and one number for each point.
    assert_eq!(of(&[4], &[7, 2], &[7, 2]), Ok((1, 2, 7)));
    assert_eq!(of(&[7], &[7, 3], &[7, 2]), Ok((1, 2, 7)));
    assert_eq!(of(&[], &[7, 2], &[7, 2]), Ok((1, 2, 7)));
    assert_eq!(of(&[1], &[7, 2], &[1, 7, 2]), Ok((1, 2, 7)));
    assert_eq!(of(&[1], &[7, 2], &[7, 2]), Ok((1, 2, 7)));
    let said = of(&[7], &[7, 2], &[7, 2]).unwrap_err();
    let plain = "an array of shape (7, 2) may be 7 times of 2 points, or 7 points of 2 numbers, for `t` has 7 numbers: save one \
                 file for each time, with one number as `t`";
    assert_eq!(said, plain);
    let said = of(&[7], &[7, 2], &[7, 7, 2]).unwrap_err();
    assert!(
        said.starts_with(
            "an array of shape (7, 7, 2) may be 7 times of 7 points, or 7 points at 7 times"
        ),
        "{said}"
    );
    // A time for each point that does not increase is no axis.
    let said = read(&[("X", F8, &[7, 2]), ("u", F8, &[7, 2]), ("time", F8, &[7])]);
    assert_eq!(said, Ok((1, 2, 7)));
}

#[test]
fn a_number_for_each_point_and_time_is_an_array() {
    let [x, u, t] = [&[4, 1][..], &[3, 4], &[3]].map(|shape| npy("<f8", shape, 0.125));
    let found = all(&crate::archives::archive(&[("X", &x), ("u", &u), ("times", &t)])).unwrap();
    for (at, snapshot) in found.iter().enumerate() {
        assert_eq!(snapshot.time.unwrap().value, at as f64 / 8.0);
        let numbers = |from: usize| (from..from + 4).map(|it| it as f64 / 8.0).collect::<Vec<_>>();
        assert_eq!(of_role(snapshot, Role::Reference, 1), numbers(0));
        assert_eq!(of_role(snapshot, Role::Displacement, 1), numbers(4 * at));
    }
    assert_eq!(found.len(), 3);
}

#[test]
fn what_is_no_number_is_a_mistake_where_it_must_be_one() {
    for (kind, word) in [
        (
            "<f16",
            "`u`: numbers of type `<f16` are not read; expected floating-point numbers or integers; `longdouble` differs",
        ),
        ("<c16", "of complex numbers save the real part"),
        ("|O", "of objects save an array of numbers each"),
        ("<U2", "`u`: numbers of type `<U2` are not read"),
    ] {
        let said = read(&[("u", kind, &[2])]).unwrap_err();
        assert!(said.contains(word), "{said}");
    }
    let u = |role: Role| role == Role::Displacement;
    let bytes = crate::archives::archive(&[("u", &npy("<f8", &[2], 1.0)), ("sigma", b"no array")]);
    let Ok(Contents::Snapshots(found)) = parse(&bytes, &wanted(&KNOWN, &u)) else { panic!() };
    assert_eq!(found[0].unread, ["sigma"]);
    let said = all(b"PK\x05\x06\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0").unwrap_err().what;
    assert_eq!(said, "expected arrays of NumPy, as `numpy.savez` writes them");
}

#[test]
fn broken_files_are_survived() {
    // No rows of 10^12 numbers each, column by column.
    let empty = npy("<f8", &[0, 1_000_000, 1_000_000], 1.0);
    let empty = String::from_utf8_lossy(&empty[10..]).replace("False", "True ");
    let bytes =
        [b"\x93NUMPY\x01\x00", &(empty.len() as u16).to_le_bytes()[..], empty.as_bytes()].concat();
    assert_eq!(all(&bytes).unwrap()[0].of_points[0].rows(), 0);
    for name in ["times_everywhere.npz", "odd.npz"] {
        survives(name, &data(name));
    }
}
