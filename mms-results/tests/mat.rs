//! Files of MATLAB that SciPy and Octave wrote (`data/write_mat.py`, `data/write_mat.m`), and broken ones.

use mms_results::Stored;
use mms_results::names::{KNOWN, Role, wanted};
use mms_results::parse;

use crate::shared::{all, data, grid, near, of_role, one, survives, values};

const NAMES: [&str; 8] = [
    "scipy.mat",
    "scipy_packed.mat",
    "scipy_4.mat",
    "big.mat",
    "big_4.mat",
    "octave_4.mat",
    "octave_6.mat",
    "octave_7.mat",
];

#[test]
fn every_version_has_the_points_that_were_written() {
    let [x, u] = grid(1.0);
    for name in NAMES {
        let snapshot = one(name);
        assert_eq!(snapshot.time.map(|it| it.value), Some(0.25), "{name}");
        near(name, &of_role(&snapshot, Role::Reference, 2), &x, 0.0);
        near(name, &of_role(&snapshot, Role::Displacement, 2), &u, 1e-16);
        let is_left_out = |it: &str| snapshot.unread.iter().any(|name| name == it);
        assert_eq!(is_left_out("words"), !name.starts_with("big"), "{name}");
    }
}

#[test]
fn variables_have_the_rows_and_the_class_that_were_written() {
    for name in ["scipy.mat", "scipy_packed.mat"] {
        let snapshot = one(name);
        let [x, u] = grid(1.0);
        let of_f = x.chunks(2).flat_map(|it| [1.0 + 0.1 * it[1], 0.1 * it[0], -0.2, 1.0]);
        let gradient = of_role(&snapshot, Role::DeformationGradient, 2);
        near(name, &gradient, &of_f.collect::<Vec<_>>(), 1e-15);
        let first: Vec<f64> = x.chunks(2).map(|it| it[0]).collect();
        assert_eq!(of_role(&snapshot, Role::Pressure, 2), first, "{name}");
        let twice: Vec<f64> = u.iter().map(|it| 2.0 * it).collect();
        near(name, values(&snapshot, "s.v"), &twice, 1e-16);
        assert_eq!(values(&snapshot, "whole"), (0..9).map(f64::from).collect::<Vec<_>>());
        let stored =
            |name: &str| snapshot.of_points.iter().find(|it| it.name == name).map(|it| it.stored);
        assert_eq!(stored("single"), Some(Stored::Single));
        assert_eq!(stored("whole"), Some(Stored::Whole));
        assert_eq!(stored("X"), Some(Stored::Double));
        let unread = ["words", "cell", "s.name", "s.deep", "complex", "sparse", "empty"];
        let mut found = snapshot.unread.clone();
        found.sort();
        let mut unread = unread.map(str::to_owned).to_vec();
        unread.sort();
        assert_eq!(found, unread, "{name}");
    }
}

#[test]
fn what_is_not_wanted_is_not_unpacked() {
    let mut bytes = data("scipy_packed.mat");
    let u = |role: Role| role == Role::Displacement;
    let good = parse(&bytes, &wanted(&KNOWN, &u)).unwrap();
    // The last packed variable is `empty`, the one before is `sparse`: damage in either does no harm.
    let last = bytes.len() - 5;
    bytes[last] ^= 0x55;
    assert_eq!(parse(&bytes, &wanted(&KNOWN, &u)).unwrap(), good);
}

#[test]
fn broken_files_are_mistakes() {
    for name in NAMES {
        survives(name, &data(name));
    }
    let said = |bytes: &[u8]| all(bytes).unwrap_err().what;
    let bytes = data("scipy.mat");
    assert_eq!(
        said(&bytes[..100]),
        "the file ends within its header: was it cut off? copy or write it again"
    );
    assert!(said(&bytes[..300]).starts_with("the file ends within `X`"), "{}", said(&bytes[..300]));
    let cut = data("scipy_4.mat");
    assert!(said(&cut[..60]).starts_with("the file ends within `X`"), "{}", said(&cut[..60]));
    // The rows of `X`, which follow its flags and the head of its axes.
    let mut wrong = bytes.clone();
    let rows = 128 + 8 + 16 + 8;
    assert_eq!(wrong[rows], 9);
    wrong[rows] = 8;
    assert_eq!(said(&wrong), "`X`: 144 bytes of numbers, and its axes need 128");
    wrong[rows..rows + 4].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(said(&wrong).contains("its axes need"), "{}", said(&wrong));
    // A displacement that contains words is named; words under another name are skipped.
    let mut words = bytes.clone();
    let at = words.windows(5).position(|it| it == b"words").unwrap();
    words[at..at + 5].copy_from_slice(b"displ");
    assert_eq!(
        said(&words),
        "`displ`: the variable is of class char; expected an array of real numbers"
    );
}
