//! Meshes and views that Gmsh and meshio wrote (`data/write_msh.py`), and broken ones.

use mms_results::names::{KNOWN, Role};
use mms_results::{Contents, Stored, parse};

use crate::shared::{all, data, grid, near, nodes_are_in_place, of_role, one, survives, values};

const FORMS: [&str; 5] = ["22_text", "22_binary", "40_text", "41_text", "41_binary"];

#[test]
fn every_version_has_all_types_of_elements_at_two_times() {
    let kinds = [3, 21, 5, 9, 22, 28, 23, 10, 12, 13, 14, 24, 29, 32, 25, 26, 27];
    for form in FORMS {
        let name = format!("gmsh_{form}.msh");
        let found = all(&data(&name)).unwrap_or_else(|mistake| panic!("{name}: {mistake}"));
        let times: Vec<_> = found.iter().map(|it| it.time.unwrap().value).collect();
        assert_eq!(times, [0.25, 0.5], "{name}");
        assert_eq!(
            [found[0].unread.as_slice(), &found[1].unread],
            [&["corners".to_owned()][..], &[]]
        );
        for (snapshot, time) in found.iter().zip(times) {
            nodes_are_in_place(&name, snapshot, &kinds);
            let places = values(snapshot, "Points").as_chunks::<3>().0;
            let u = places.iter().flat_map(|[x, y, z]| [0.1 * x * y, -0.2 * x, 0.05 * z]);
            let u: Vec<f64> = u.map(|it| time * it).collect();
            near(&name, &of_role(snapshot, Role::Displacement, 3), &u, 1e-15);
            let stored = snapshot.of_points[0].stored;
            assert_eq!(
                (stored, snapshot.points.as_ref().unwrap().stored),
                (Stored::Double, Stored::Double)
            );
        }
    }
}

#[test]
fn elements_of_higher_order_have_the_nodes_of_vtk() {
    let kinds = [68, 68, 68, 69, 69, 69, 70, 70, 70, 71, 71, 71, 72, 72, 72];
    nodes_are_in_place("higher", &one("gmsh_higher_41_binary.msh"), &kinds);
}

#[test]
fn what_has_no_numbers_and_needs_none_is_left_out() {
    for form in FORMS {
        let name = format!("gmsh_square_{form}.msh");
        let snapshot = one(&name);
        // The file has no time.
        assert_eq!(snapshot.time, None, "{name}");
        assert_eq!(snapshot.cells.types, [5, 5], "{name}: lines of the boundary have no `J`");
        let places = values(&snapshot, "Points").as_chunks::<3>().0;
        assert_eq!(places.len(), 4, "{name}: one node is of no element");
        let of_cells: Vec<_> = snapshot
            .cells
            .iter()
            .map(|(_, it)| it.iter().map(|it| places[*it][0]).sum::<f64>() / 3.0)
            .collect();
        let j: Vec<f64> = of_cells.iter().map(|it| 1.0 + it).collect();
        near(&name, values(&snapshot, "J"), &j, 1e-15);
        let u: Vec<f64> = places.iter().flat_map(|[x, y, _]| [0.1 * x * y, -0.2 * x]).collect();
        near(&name, &of_role(&snapshot, Role::Displacement, 2), &u, 1e-16);
        let first = places.iter().position(|it| *it == [0.0; 3]).unwrap();
        let sigma = of_role(&snapshot, Role::CauchyStress, 3);
        assert_eq!(sigma[9 * first..][..9], [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
    }
}

#[test]
fn parameters_of_nodes_are_passed_over() {
    for form in ["text", "binary"] {
        let name = format!("gmsh_parametric_41_{form}.msh");
        let bytes = data(&name);
        for section in [&b"$Periodic"[..], b"$Entities"] {
            assert!(bytes.windows(section.len()).any(|it| it == section), "{name}");
        }
        let snapshot = one(&name);
        let places = values(&snapshot, "Points").as_chunks::<3>().0;
        let mut sorted: Vec<_> = places.iter().map(|[x, y, z]| [*y, *x, *z]).collect();
        sorted.sort_by(|a, b| a.partial_cmp(b).unwrap());
        let [x, _] = grid(1.0);
        let found: Vec<f64> = sorted.iter().flat_map(|[y, x, _]| [*x, *y]).collect();
        near(&name, &found, &x, 1e-12);
        let u: Vec<f64> = places.iter().flat_map(|[x, y, _]| [0.1 * x * y, -0.2 * x]).collect();
        near(&name, &of_role(&snapshot, Role::Displacement, 2), &u, 1e-16);
        assert_eq!(snapshot.cells.types.iter().filter(|it| **it == 5).count(), 8, "{name}");
    }
}

#[test]
fn files_of_meshio_have_the_mesh_that_was_written() {
    let [x, u] = grid(1.0);
    for form in ["22_text", "22_binary", "40_text", "40_binary", "41_text", "41_binary"] {
        let name = format!("meshio_{form}.msh");
        let snapshot = one(&name);
        near(&name, &of_role(&snapshot, Role::Displacement, 2), &u, 1e-16);
        let places = values(&snapshot, "Points").as_chunks::<3>().0;
        assert_eq!(places.iter().flat_map(|it| [it[0], it[1]]).collect::<Vec<_>>(), x, "{name}");
        assert_eq!(snapshot.cells.iter().nth(3).unwrap(), (9, &[4, 5, 8, 7][..]), "{name}");
        // In its files of version 4.0 elements count from 0, and their numbers from 1.
        match form.starts_with("40") {
            true => assert_eq!(snapshot.unread, ["middle"]),
            false => assert_eq!(values(&snapshot, "middle"), [0.25, 0.75, 0.25, 0.75], "{name}"),
        }
    }
}

/// A square of one element, followed by sections.
fn square(more: &str) -> String {
    format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nany\n$EndComments\n$Nodes\n4\n7 0 0 0\n5 1 0 0\n6 1 1 0\n9 0 1 0\n\
         $EndNodes\n$Elements\n1\n3 3 2 0 0 7 5 6 9\n$EndElements\n{more}"
    )
}

fn view(name: &str, time: f64, step: usize, rows: &[(usize, f64)]) -> String {
    let text: String = rows.iter().map(|(tag, it)| format!("{tag} {it} 0 0\n")).collect();
    format!(
        "$NodeData\n1\n\"{name}\"\n1\n{time}\n4\n{step}\n3\n{}\n2\n{text}$EndNodeData\n",
        rows.len()
    )
}

#[test]
fn partitions_are_united_and_times_are_sorted() {
    let part = |from: usize, time: f64, step: usize, scale: f64| {
        let rows = [9, 6, 5, 7].into_iter().skip(from).take(2).map(|it| (it, scale * it as f64));
        view("u", time, step, &rows.collect::<Vec<_>>())
    };
    let text =
        [part(0, 0.5, 1, 2.0), part(0, 0.25, 0, 1.0), part(2, 0.25, 0, 1.0), part(2, 0.5, 1, 2.0)];
    let found = all(square(&text.concat()).as_bytes()).unwrap();
    let times: Vec<_> = found.iter().map(|it| it.time.unwrap().value).collect();
    assert_eq!(times, [0.25, 0.5]);
    let first = |at: usize| values(&found[at], "u").iter().step_by(3).copied().collect::<Vec<_>>();
    assert_eq!(
        [first(0), first(1)],
        [[7.0, 5.0, 6.0, 9.0], [14.0, 10.0, 12.0, 18.0]].map(|it| it.to_vec())
    );
    // Numbers of elements alone do not need a node that belongs to no element.
    let of_elements = "$ElementData\n1\n\"J\"\n1\n0.5\n3\n0\n1\n1\n3 2.5\n$EndElementData\n";
    let text = square(of_elements).replace("\n4\n7 0", "\n5\n8 3 3 3\n7 0");
    let found = all(text.as_bytes()).unwrap();
    assert_eq!(
        (found[0].rows(), values(&found[0], "J"), found[0].cells.points.as_slice()),
        (4, &[2.5][..], &[0, 1, 2, 3][..])
    );
    let mesh = all(square("").as_bytes()).unwrap();
    assert_eq!((mesh.len(), mesh[0].cells.types.as_slice(), mesh[0].time), (1, &[9][..], None));
}

#[test]
fn broken_files_are_mistakes() {
    for form in FORMS {
        let name = format!("gmsh_square_{form}.msh");
        survives(&name, &data(&name));
    }
    for name in ["meshio_40_binary.msh", "gmsh_parametric_41_binary.msh"] {
        survives(name, &data(name));
    }
    let full = [(7, 1.0), (5, 1.0), (6, 1.0), (9, 1.0)];
    let said = |text: &str| all(text.as_bytes()).unwrap_err().of("file").to_string();
    let changed = |from: &str, to: &str| said(&square("").replacen(from, to, 1));
    for (said, expected) in [
        (
            said(&square(&view("u", 1.0, 0, &full[..3]))),
            "file: `u` has no number for the node 9: write the view for all of them",
        ),
        (
            said(&square(&view("u", 1.0, 0, &[(8, 1.0)]))),
            "file: `u` has no or two numbers for the node 8, or it is not there",
        ),
        (
            said(&square(&(view("u", 0.0, 0, &full) + &view("u", 0.0, 1, &full)))),
            "file: `u` has the steps 0 and 1 at the time 0: write a time with each step of the view",
        ),
        (changed("2.2 0 8", "3 0 8"), "file:2: version 3 of Gmsh's format is not read; write 4.1"),
        (changed("7 5 6 9", "7 5 6 8"), "file: an element has the node 8, which is not there"),
        (changed("9 0 1 0", "5 0 1 0"), "file: the node 5 is there twice"),
        (changed("9 0 1 0", "9 0 one 0"), "file:12: expected a number, found `one`"),
        (
            changed("3 3 2 0", "3 90 2 0"),
            "file:16: elements of Gmsh's type 90 are not read; write elements of order 1 to 5",
        ),
        (changed("\n4\n", "\n3\n"), "file:12: more in `$Nodes` than it says: expected `$EndNodes`"),
        (
            changed("\n4\n", "\n400000000000\n"),
            "file:8: a section that says it has 400000000000 rows, and the file ends before: was it cut off?",
        ),
        (changed("$Nodes", "Nodes"), "file:7: expected a section, as `$Nodes`, found `Nodes`"),
        (said("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"), "file: a file of Gmsh without nodes"),
        (said("$NOD\n1\n"), "file: version 1 of Gmsh's format is not read"),
    ] {
        assert!(said.starts_with(expected), "{said}");
    }
    // An array that is not requested causes no error.
    let odd = square(&(view("u", 1.0, 0, &full) + &view("odd", 1.0, 0, &full[..3])));
    let Ok(Contents::Snapshots(found)) =
        parse(odd.as_bytes(), &mms_results::names::everything(&KNOWN))
    else {
        panic!()
    };
    assert_eq!(found[0].unread, ["odd"]);
}
