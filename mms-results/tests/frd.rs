//! Results of CalculiX that its solver wrote (`data/write_frd.py`), and broken ones.

use mms_results::names::{KNOWN, Names, Role, everything, wanted};
use mms_results::{Contents, Snapshot, Stored, parse};

use crate::shared::{all, data, near, nodes_are_in_place, of_role, one, survives, values};

/// u = t (0.1 X Y, -0.2 X, 0.05 Z) at all nodes of a mesh.
fn moved(snapshot: &Snapshot, time: f64) -> Vec<f64> {
    let places = of_role(snapshot, Role::Reference, 3);
    let u = places.as_chunks::<3>().0.iter().map(|[x, y, z]| [0.1 * x * y, -0.2 * x, 0.05 * z]);
    u.flatten().map(|it| time * it).collect()
}

#[test]
fn text_and_binary_have_all_types_of_elements_at_two_times() {
    for name in ["calculix.frd", "calculix_binary.frd"] {
        let found = all(&data(name)).unwrap();
        let times: Vec<_> = found.iter().map(|it| it.time.unwrap().value).collect();
        assert_eq!(times, [0.5, 1.0], "{name}");
        for (snapshot, time) in found.iter().zip(times) {
            nodes_are_in_place(name, snapshot, &[12, 25, 10, 24, 13, 26]);
            let tolerance = 5.1e-6;
            near(
                name,
                &of_role(snapshot, Role::Displacement, 3),
                &moved(snapshot, time),
                tolerance,
            );
        }
        let is_binary = name.contains("binary");
        let stored = if is_binary { Stored::Single } else { Stored::Digits(6) };
        let u = found[0].of_points.iter().find(|it| it.name == "DISP").unwrap();
        assert_eq!((u.stored, u.components), (stored, 3), "{name}");
        let points = found[0].points.as_ref().unwrap().stored;
        assert_eq!(points, if is_binary { Stored::Double } else { Stored::Digits(6) });
    }
}

#[test]
fn tensors_have_an_array_for_each_entry() {
    let found = all(&data("calculix.frd")).unwrap();
    let names: Vec<_> = found[1].of_points.iter().map(|it| it.name.as_str()).collect();
    let entries = ["XX", "YY", "ZZ", "XY", "YZ", "ZX"].map(|it| format!("STRESS_{it}"));
    assert_eq!(names[1..7], entries);
    // The line of node 11 in the file, of the second time.
    let text = String::from_utf8(data("calculix.frd")).unwrap();
    let block = text.rsplit_once(" -4  STRESS").unwrap().1;
    let line = block.lines().find(|it| it.starts_with(" -1        11")).unwrap();
    for (at, name) in entries.iter().enumerate() {
        let written: f64 = line[13 + 12 * at..][..12].trim().parse().unwrap();
        assert_eq!(values(&found[1], name)[0], written, "{name}");
    }
    // CalculiX writes `stress`, which may be two quantities: a user chooses one.
    let names = Names { map: vec!["sigma=STRESS".parse().unwrap()], ..Names::default() };
    let meant = mms_results::names::recognise(&found[1], &names, &|_| true).unwrap();
    let sigma = meant.iter().find(|it| it.role == Role::CauchyStress).unwrap();
    let numbers = sigma.values(&found[1], 3).unwrap().numbers.into_owned();
    let entry = |at: usize| values(&found[1], &entries[at])[0];
    assert_eq!(numbers[..9], [0, 3, 5, 3, 1, 4, 5, 4, 2].map(entry));
}

#[test]
fn elements_of_a_plane_stay_in_it() {
    let snapshot = one("calculix_plane.frd");
    nodes_are_in_place("plane", &snapshot, &[5, 22, 9, 23]);
    let u = moved(&snapshot, 1.0);
    let u: Vec<f64> = u.chunks(3).flat_map(|it| [it[0], it[1]]).collect();
    near("u", &of_role(&snapshot, Role::Displacement, 2), &u, 5.1e-6);
}

#[test]
fn the_short_form_has_numbers_that_touch_and_nodes_in_any_order() {
    let snapshot = one("calculix_short.frd");
    nodes_are_in_place("short", &snapshot, &[10]);
    assert_eq!(snapshot.time.unwrap().value, 0.25);
    let expected: Vec<f64> = (1..=4).flat_map(|at| [-0.1 * f64::from(at), -0.2, 1e-103]).collect();
    near("u", values(&snapshot, "DISP"), &expected, 1e-16);
    assert_eq!(values(&snapshot, "DISP")[2], 1e-103);
}

#[test]
fn velocities_are_known() {
    let found = all(&data("calculix_moving.frd")).unwrap();
    assert_eq!(found.len(), 2);
    let [u, v] = [Role::Displacement, Role::Velocity].map(|it| of_role(&found[1], it, 3));
    near("u", &u, &moved(&found[1], 1.0), 5.1e-6);
    assert_eq!(v, values(&found[1], "VELO"));
}

#[test]
fn results_of_some_nodes_and_of_modes_are_refused_where_they_are_wanted() {
    let said = |name: &str| all(&data(name)).unwrap_err().of("file").to_string();
    assert_eq!(
        said("calculix_some.frd"),
        "file:24: `DISP` is not there for 2 of 4 nodes: write it without `NSET`, for all nodes"
    );
    let v = |role: Role| role == Role::Velocity;
    let bytes = data("calculix_some.frd");
    let Ok(Contents::Snapshots(found)) = parse(&bytes, &wanted(&KNOWN, &v)) else { panic!() };
    assert_eq!(found[0].unread[0], "DISP");
    assert!(said("calculix_modes.frd").contains(
        "`DISP` is of a frequency, which are no displacements at a time: write results of a step"
    ));
}

#[test]
fn broken_files_are_mistakes_at_their_lines() {
    for name in ["calculix_short.frd", "calculix_some.frd"] {
        survives(name, &data(name));
    }
    let bytes = data("calculix_binary.frd");
    for length in 0..bytes.len() {
        let _ = parse(&bytes[..length], &everything(&KNOWN));
    }
    let text = String::from_utf8(data("calculix_short.frd")).unwrap();
    let changed = |from: &str, to: &str| {
        let text = text.replacen(from, to, 1);
        all(text.as_bytes()).unwrap_err().of("file").to_string()
    };
    let disp = text.find(" -4  DISP").unwrap();
    for (said, expected) in [
        (
            changed("    1    3    0", "    1   13    0"),
            "file:10: elements of type 13 are not known",
        ),
        (
            changed(" -2    1    2", " -2    1    7"),
            "file:11: an element has the node 7, which is not there",
        ),
        (changed("    2 1.00000E+00", "    1 1.00000E+00"), "file:8: the node 1 is there twice"),
        (changed(" 1.00000E+00", " 1.00000F+00"), "file:5: expected a number, found `1.00000F+00`"),
        (
            changed(" 4            ", " 5            "),
            "file:8: 4 rows in a block that says it has 5",
        ),
        (
            changed(&text[disp + 200..], ""),
            "file:19: the file ends within a block: was it cut off? copy or write it again",
        ),
        (changed("    3C", "    4C"), "file:9: expected a block 2C, 3C or 100C, found `4C"),
        (changed("2.50000E-01", "        now"), "file:13: expected a time, found `now`"),
    ] {
        assert!(said.starts_with(expected), "{said}");
    }
    let block = &text[text.find("  100CL").unwrap()..text.find(" 9999").unwrap()];
    for (name, expected) in [
        ("DISP ", "file:34: `DISP` is there twice at one time"),
        (
            "DISPI",
            "file:29: `DISPI` is the imaginary part of `DISP`: results of a vibration are not read",
        ),
    ] {
        let more = text.replace(" 9999", &block.replace("DISP ", name));
        assert_eq!(all(more.as_bytes()).unwrap_err().of("file").to_string(), expected);
    }
}
