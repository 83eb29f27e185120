//! Files of VTK beyond lists of points and cells (`data/write_vtk_more.py`).

use std::path::{Path, PathBuf};

use mms_results::cell::CellShape;
use mms_results::mesh::Mesh;
use mms_results::motion::{Motion, resolve};
use mms_results::names::{KNOWN, Names, Role, everything, recognise};
use mms_results::own::keep;
use mms_results::{Contents, Snapshot, Stored, parse, read};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/vtk_more").join(name)
}

fn open(path: &Path, _: u64) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|error| error.to_string())
}

fn all(name: &str) -> Vec<Snapshot> {
    read(&data(name), &open, &everything(&KNOWN))
        .unwrap_or_else(|mistake| panic!("{name}: {mistake}"))
}

fn one(name: &str) -> Snapshot {
    let mut found = all(name);
    assert_eq!(found.len(), 1, "{name}");
    found.remove(0)
}

/// A user's mapping of names.
fn mapped(map: &[&str]) -> Names {
    let map = map.iter().map(|it| it.parse().unwrap()).collect();
    Names { map, ..Names::default() }
}

fn motion<'a>(snapshot: &'a Snapshot, dimension: usize) -> Motion<'a> {
    let found = recognise(snapshot, &mapped(&["X=points"]), &|_| true).unwrap();
    resolve(snapshot, &found, dimension, &|_: &[f64]| 0.0, None).unwrap()
}

/// Checks that X, u and the middles of cells are the written ones.
#[track_caller]
fn holds_the_mesh(name: &str, snapshot: &Snapshot, rows: usize, cells: usize) {
    assert_eq!((snapshot.rows(), snapshot.cells.len()), (rows, cells), "{name}");
    let points = &snapshot.points.as_ref().unwrap().values;
    let u = snapshot.of_points.iter().find(|it| it.name == "u").unwrap();
    for (at, (x, u)) in points.chunks(3).zip(u.values.chunks(3)).enumerate() {
        let exact = [0.1 * x[0] * x[1], -0.2 * x[0], 0.3 * x[2]];
        let off = (0..3).map(|it| (u[it] - exact[it]).abs()).fold(0.0, f64::max);
        assert!(off <= 1e-11, "{name}: {at}: {u:?} is not {exact:?}");
    }
    let middle = snapshot.of_cells.iter().find(|it| it.name == "middle").unwrap();
    for ((_, own), middle) in snapshot.cells.iter().zip(&middle.values) {
        let along = || own.iter().map(|it| points[3 * it]);
        let ends = [along().fold(f64::MAX, f64::min), along().fold(f64::MIN, f64::max)];
        assert!((middle - (ends[0] + ends[1]) / 2.0).abs() < 1e-11, "{name}: {middle} {ends:?}");
    }
    let time = snapshot.time.map(|it| it.value);
    assert_eq!(time, Some(0.25), "{name}");
}

/// The length, area or volume of a mesh.
fn measure(snapshot: &Snapshot, dimension: usize) -> f64 {
    let motion = motion(snapshot, dimension);
    let points = &motion.reference.numbers;
    Mesh { cells: &snapshot.cells, points, dimension, is_meridian: false }
        .volumes()
        .unwrap()
        .iter()
        .sum()
}

#[test]
fn structured_grids_have_points_and_cells_by_their_extents() {
    for end in ["vti", "vtr", "vts"] {
        // A plane of unit area, except the one with a longer side.
        let area = if end == "vts" { 1.05 } else { 1.0 };
        for name in [
            format!("flat.{end}"),
            format!("{end}_flat_ascii.vtk"),
            format!("{end}_flat_binary.vtk"),
        ] {
            let found = one(&name);
            holds_the_mesh(&name, &found, 25, 16);
            assert_eq!(found.cells.types, [9; 16], "{name}");
            assert!((measure(&found, 2) - area).abs() < 1e-10, "{name}");
        }
        for name in [
            format!("solid.{end}"),
            format!("{end}_solid_ascii.vtk"),
            format!("{end}_solid_binary.vtk"),
        ] {
            let found = one(&name);
            holds_the_mesh(&name, &found, 18, 4);
            assert_eq!(found.cells.types, [12; 4], "{name}");
            let volume = match end {
                "vti" => 0.5 * 0.25 * 0.5,
                "vtr" => 0.25 * 0.0625 * 0.25,
                _ => 0.5 * 0.25 * 0.5 * (1.0 + 0.1 * 0.125),
            };
            assert!((measure(&found, 3) - volume).abs() < 1e-10, "{name}");
        }
        let across = one(&format!("across.{end}"));
        holds_the_mesh("across", &across, 12, 6);
        assert_eq!(across.cells.types, [9; 6], "{end}");
    }
}

#[test]
fn pieces_of_structured_grids_share_their_points() {
    for (end, area) in [("vti", 1.0), ("vtr", 1.0), ("vts", 1.05)] {
        let mut found = one(&format!("pieces.p{end}"));
        holds_the_mesh(end, &found, 30, 16);
        assert_eq!(keep(&mut found).unwrap().doubled, 0, "{end}");
        assert!((measure(&found, 2) - area).abs() < 1e-10, "{end}");
    }
}

#[test]
fn ghosts_of_structured_grids_are_left_out() {
    for name in ["ghosts.vti", "ghosts.vtk"] {
        let mut found = one(name);
        let left_out = keep(&mut found).unwrap();
        assert_eq!([left_out.ghost_cells, left_out.ghost_points], [4, 5], "{name}");
        holds_the_mesh(name, &found, 25, 16);
    }
}

#[test]
fn images_have_axes_and_steps_as_exact_as_they_are_written() {
    let turned = one("turned.vti");
    holds_the_mesh("turned", &turned, 25, 16);
    assert_eq!(turned.points.as_ref().unwrap().values[..3], [1.0, 0.0, 0.0]);
    assert!((measure(&turned, 2) - 1.0).abs() < 1e-15);
    let stored = |name: &str| one(name).points.unwrap().stored;
    assert_eq!(stored("flat.vti"), Stored::Double);
    let thirds = one("thirds.vtk").points.unwrap();
    assert_eq!(thirds.stored, Stored::Fixed(5));
    assert!(thirds.values.iter().any(|it| *it > 0.0 && (it - 1.0).abs() < 2e-6));
}

#[test]
fn blocks_of_lz4_are_read() {
    for name in ["lz4_binary.vti", "lz4_appended.vti"] {
        holds_the_mesh(name, &one(name), 25, 16);
    }
}

/// The words of each line of a text.
fn words(name: &str) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(data(name)).unwrap();
    text.lines().map(|line| line.split(' ').map(str::to_owned).collect()).collect()
}

#[test]
fn nodes_of_higher_degree_are_where_vtk_has_them() {
    let mut count = 0;
    for line in words("steps.txt") {
        let numbers: Vec<f64> = line.iter().map(|it| it.parse().unwrap()).collect();
        let shape = CellShape::of(numbers[0] as u8, numbers[1] as usize).unwrap();
        let n = f64::from(shape.degree());
        let steps: Vec<f64> =
            shape.nodes.as_flattened().iter().map(|it| (it * n).round()).collect();
        assert_eq!(steps, &numbers[2..], "{} {n}", shape.kind());
        count += 1;
    }
    assert_eq!(count, 21);
}

#[test]
fn functions_have_the_values_that_vtk_has() {
    let mut count = 0;
    for line in words("functions.txt") {
        let numbers: Vec<f64> = line.iter().map(|it| it.parse().unwrap()).collect();
        let shape = CellShape::of(numbers[0] as u8, numbers.len() - 1).unwrap();
        let place = [0.3, 0.2, 0.1];
        let place = [0, 1, 2].map(|it| if it < shape.dimension { place[it] } else { 0.0 });
        for (own, theirs) in shape.values(place).iter().zip(&numbers[1..]) {
            assert!((own - theirs).abs() < 1e-11, "{}: {own} {theirs}", shape.kind());
        }
        count += 1;
    }
    assert_eq!(count, 32);
}

#[test]
fn cells_of_higher_degree_are_read_in_the_order_of_their_version() {
    let mut orders = std::collections::BTreeSet::new();
    for line in words("read_back.txt") {
        let points: Vec<usize> = line[1..].iter().map(|it| it.parse().unwrap()).collect();
        assert_eq!(one(&line[0]).cells.points, points, "{}", line[0]);
        orders.insert(points);
    }
    assert_eq!(orders.len(), 2);
    for name in ["lagrange.vtu", "lagrange.vtk"] {
        let found = one(name);
        assert_eq!(found.cells.types, [69, 69, 70, 70], "{name}");
        // Two triangles and two squares with edges bent so that the areas do not change.
        let area = measure(&found, 2);
        assert!((area - 3.0).abs() < 1e-10, "{name}: {area}");
    }
}

#[test]
fn cells_that_are_not_read_are_named() {
    for (kind, points, word) in [
        (79, 8, "a cell of Bezier, type 79 of VTK"),
        (72, 12, "a cell of Lagrange, type 72 of VTK, with 12 points"),
        (70, 144, "with 144 points"),
    ] {
        let list = |of: &dyn Fn(usize) -> usize, count: usize| {
            (0..count).map(|it| of(it).to_string()).collect::<Vec<_>>().join(" ")
        };
        let text = format!(
            "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {points} double\n{}\nCELLS 1 \
             {}\n{points} {}\nCELL_TYPES 1\n{kind}\n",
            list(&|it| it, 3 * points),
            points + 1,
            list(&|it| it, points),
        );
        let said = refused(text.as_bytes());
        assert!(said.contains(word), "{said}");
    }
}

/// In the form of Kratos: a vertex for each particle, and arrays of the vertices.
#[test]
fn arrays_of_vertices_are_arrays_of_points() {
    let file = |vertices: &str, cells: &str, more: &str| {
        format!(
            "# vtk DataFile Version 4.0\nvtk output\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n0.25 0.5 0\n0.5 0.5 \
             0\n0.75 0.5 0\n\nCELLS {vertices}\n\nCELL_TYPES {cells}\n{more}CELL_DATA 3\nFIELD FieldData 2\n\
             MP_DISPLACEMENT 3 3 float\n0.1 0.2 0\n0.3 0.4 0\n0.5 0.6 0\nMP_ID 1 3 int\n7 8 9\n"
        )
    };
    let parsed = |text: &str| match parse(text.as_bytes(), &everything(&KNOWN)).unwrap() {
        Contents::Snapshots(mut found) => found.remove(0),
        other => panic!("{other:?}"),
    };
    let u = |snapshot: &Snapshot| {
        let names = mapped(&["X=points", "u=MP_DISPLACEMENT"]);
        let found = recognise(snapshot, &names, &|_| true).unwrap();
        let motion = resolve(snapshot, &found, 2, &|_: &[f64]| 0.0, None).unwrap();
        motion.displacement.map(|it| it.numbers.iter().map(|it| *it as f32).collect::<Vec<_>>())
    };
    let in_order = parsed(&file("3 6\n1 0\n1 1\n1 2\n", "3\n1\n1\n1", ""));
    assert_eq!(u(&in_order), Some(vec![0.1, 0.2, 0.3, 0.4, 0.5, 0.6]));
    assert!(in_order.of_cells.is_empty());
    let turned = parsed(&file("3 6\n1 2\n1 0\n1 1\n", "3\n1\n2\n1", ""));
    assert_eq!(u(&turned), Some(vec![0.3, 0.4, 0.5, 0.6, 0.1, 0.2]));
    assert_eq!(turned.of_points[1].values, [8.0, 9.0, 7.0]);
    // A point with two vertices and one with none; cells that are no vertices; an array whose name points have, too.
    for text in [
        file("3 6\n1 2\n1 0\n1 2\n", "3\n1\n1\n1", ""),
        file("3 9\n2 0 1\n2 1 2\n2 2 0\n", "3\n3\n3\n3", ""),
        file(
            "3 6\n1 0\n1 1\n1 2\n",
            "3\n1\n1\n1",
            "POINT_DATA 3\nSCALARS MP_ID int\nLOOKUP_TABLE default\n1 2 3\n",
        ),
    ] {
        assert!(parsed(&text).of_cells.iter().any(|it| it.name == "MP_ID"), "{text}");
    }
}

/// The numbers of a quantity at all points or cells.
fn numbers(snapshot: &Snapshot, role: Role, dimension: usize, map: &[&str]) -> Vec<f64> {
    let found = recognise(snapshot, &mapped(map), &|it| it == role).unwrap();
    let meaning = found.iter().find(|it| it.role == role).unwrap();
    meaning.values(snapshot, dimension).unwrap().numbers.into_owned()
}

#[test]
fn components_are_told_by_their_names() {
    for name in ["names.vti", "names.vtk"] {
        let found = one(name);
        let points = &found.points.as_ref().unwrap().values;
        for map in ["sigma=Cauchy Stress", "tau=Cauchy Stress"] {
            let role =
                if map.starts_with('s') { Role::CauchyStress } else { Role::KirchhoffStress };
            let plane: Vec<f64> =
                points.chunks(3).flat_map(|x| [7.0 + x[0], x[1], x[1], 3.0 + x[0]]).collect();
            assert_eq!(numbers(&found, role, 2, &[map]), plane, "{name}");
            let space = numbers(&found, role, 3, &[map]);
            let exact =
                |x: &[f64]| [7.0 + x[0], x[1], x[0], x[1], 3.0 + x[0], 0.0, x[0], 0.0, 5.0 + x[1]];
            assert_eq!(space, points.chunks(3).flat_map(exact).collect::<Vec<_>>(), "{name}");
        }
        assert_eq!(numbers(&found, Role::CauchyStress, 2, &[]).len(), 36, "{name}");
    }
}

#[test]
fn matrices_have_as_many_components_as_there_are() {
    let rows = |count: usize| (0..count * 9).map(|it| it as f64).collect::<Vec<f64>>();
    for name in ["meshio_matrix_zlib.vtu", "meshio_matrix_ascii.vtu"] {
        let found = one(name);
        assert_eq!(
            (found.of_cells[0].components, &found.of_cells[0].values),
            (9, &rows(2)),
            "{name}"
        );
        let plane = numbers(&found, Role::DeformationGradient, 2, &[]);
        assert_eq!(plane, [0.0, 1.0, 3.0, 4.0, 9.0, 10.0, 12.0, 13.0], "{name}");
    }
    for name in ["tensors_1.vtk", "tensors_2.vtk"] {
        let array = one(name).of_points.into_iter().find(|it| it.name == "F").unwrap();
        assert_eq!((array.components, &array.values), (9, &rows(4)), "{name}");
    }
}

#[test]
fn pieces_without_points_are_nothing() {
    for name in ["some.pvtu", "in_one.vtu"] {
        holds_the_mesh(name, &one(name), 25, 16);
    }
    let empty = one("some_1.vtu");
    assert_eq!((empty.rows(), empty.cells.len()), (0, 0));
}

#[test]
fn blocks_are_one_mesh() {
    for name in ["blocks.vtm", "parts.vtpc", "part.vtpd"] {
        let found = one(name);
        holds_the_mesh(name, &found, 30, 16);
        assert!((measure(&found, 2) - 1.0).abs() < 1e-15, "{name}");
        assert!(found.of_points.iter().all(|it| it.name != "more"), "{name}");
        assert!(found.unread.contains(&"more".to_owned()), "{name}: {:?}", found.unread);
    }
}

#[test]
fn lists_of_times_name_files_of_any_kind() {
    let found = all("flat.vti.series");
    let times: Vec<_> = found.iter().map(|it| it.time.unwrap().value).collect();
    assert_eq!(times, [0.1, 0.5]);
    assert!(found[0].path.ends_with("vti_flat_ascii.vtk"));
    let found = all("times.pvd");
    let of = |it: &Snapshot| (it.time.unwrap().value, it.rows(), it.cells.len());
    assert_eq!(
        found.iter().map(of).collect::<Vec<_>>(),
        [(0.125, 25, 16), (0.25, 30, 16), (0.5, 30, 16)]
    );
    for (text, word) in [
        ("{", "not JSON"),
        ("{}", "no list `files`"),
        ("{\"files\": []}", "the list has no files"),
        ("{\"files\": [{\"time\": 1}]}", "a file without a name"),
        ("{\"files\": [{\"name\": \"a\"}]}", "a file without a time"),
        ("{\"files\": [{\"name\": \"a\", \"time\": \"x\"}]}", "a file without a time"),
    ] {
        let said = refused(text.as_bytes());
        assert!(said.contains(word), "{text}: {said}");
    }
    let itself = b"<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet><DataSet file=\"flat.vtm\"/>\
        </vtkMultiBlockDataSet></VTKFile>";
    let open = |_: &Path, _: u64| Ok(itself.to_vec());
    let said = read(&data("flat.vtm"), &open, &everything(&KNOWN)).unwrap_err().what;
    assert!(said.contains("the block `flat.vtm` is itself a list of blocks"), "{said}");
}

/// The time of a file in the legacy format, in the forms of VisIt and others.
#[test]
fn legacy_files_have_their_time() {
    for (field, time) in [
        ("FIELD FieldData 2\nCYCLE 1 1 int\n7\nTIME 1 1 double\n0.375\n", Some(0.375)),
        ("FIELD FieldData 1\nTimeValue 1 1 float\n0.375\n", Some(0.375)),
        ("FIELD FieldData 1\nCYCLE 1 1 int\n7\n", None),
    ] {
        let text = format!(
            "# vtk DataFile Version 3.0\nvtk output\nASCII\nDATASET STRUCTURED_POINTS\n{field}DIMENSIONS 2 1 1\n\
             POINT_DATA 2\nSCALARS a%20b double\nLOOKUP_TABLE default\n1 2\n"
        );
        let Ok(Contents::Snapshots(found)) = parse(text.as_bytes(), &everything(&KNOWN)) else {
            panic!("{text}")
        };
        assert_eq!(found[0].time.map(|it| it.value), time, "{field}");
        assert_eq!(found[0].of_points[0].name, "a b");
    }
}

#[test]
fn odd_arrays_are_passed_over() {
    for name in ["odd_1.vtk", "odd_2.vtk", "odd.vti"] {
        let found = one(name);
        holds_the_mesh(name, &found, 9, 4);
        let last = found.of_points.iter().find(|it| it.name == "last").unwrap();
        assert_eq!(last.values, (0..9).map(f64::from).collect::<Vec<_>>(), "{name}");
        for odd in ["bits", "words"] {
            assert!(found.unread.contains(&odd.to_owned()), "{name}: {:?}", found.unread);
        }
    }
}

/// A file of VTK in XML with this content.
fn vtk(kind: &str, body: &str) -> Vec<u8> {
    format!("<VTKFile type=\"{kind}\">{body}</VTKFile>").into_bytes()
}

fn refused(bytes: &[u8]) -> String {
    match parse(bytes, &everything(&KNOWN)) {
        Ok(found) => panic!("{found:?}"),
        Err(mistake) => mistake.what,
    }
}

#[test]
fn extents_are_not_believed_without_arrays() {
    let huge = "0 99999 0 99999 0 9";
    let text = format!("<ImageData WholeExtent=\"{huge}\"><Piece Extent=\"{huge}\"/></ImageData>");
    let Ok(Contents::Snapshots(found)) = parse(&vtk("ImageData", &text), &everything(&KNOWN))
    else {
        panic!()
    };
    assert!(found[0].points.is_none() && found[0].cells.is_empty());
    let array = "<PointData><DataArray type=\"Int8\" Name=\"a\" format=\"ascii\">1 2</DataArray></PointData>";
    let piece = format!("<ImageData><Piece Extent=\"{huge}\">{array}</Piece></ImageData>");
    assert!(refused(&vtk("ImageData", &piece)).contains("`a`: 2 numbers"));
    for (extent, word) in [
        ("0 1 0 1", "expected the first and the last point along three axes"),
        ("0 9223372036854775807 0 9223372036854775807 0 1", "no file holds as many"),
    ] {
        let piece = format!("<ImageData><Piece Extent=\"{extent}\">{array}</Piece></ImageData>");
        let said = refused(&vtk("ImageData", &piece));
        assert!(said.contains(word), "{said}");
    }
    let piece = format!(
        "<ImageData Spacing=\"1 nan 1\"><Piece Extent=\"0 1 0 0 0 0\">{array}</Piece></ImageData>"
    );
    assert!(refused(&vtk("ImageData", &piece)).contains("expected 3 finite numbers"));
    let piece =
        format!("<RectilinearGrid><Piece Extent=\"0 1 0 0 0 0\">{array}</Piece></RectilinearGrid>");
    assert!(
        refused(&vtk("RectilinearGrid", &piece)).contains("expected an element `<Coordinates>`")
    );
    let piece =
        format!("<StructuredGrid><Piece Extent=\"0 1 0 0 0 0\">{array}</Piece></StructuredGrid>");
    assert!(refused(&vtk("StructuredGrid", &piece)).contains("expected an element `<Points>`"));
    let legacy = |body: &str| format!("# vtk DataFile Version 3.0\n\nASCII\nDATASET {body}");
    for (body, word) in [
        ("STRUCTURED_GRID\nDIMENSIONS 2 2 1\nPOINTS 1 double\n0 0 0\n", "1 points, and expected 4"),
        ("STRUCTURED_POINTS\nDIMENSIONS 2 2 1\nSPACING 1 x 1\n", "expected 3 finite numbers"),
        (
            "RECTILINEAR_GRID\nDIMENSIONS 2 1 1\nX_COORDINATES 2 double\n0 1\nPOINT_DATA 2\nSCALARS a int\n1 2\n",
            "expected coordinates along each of three axes",
        ),
        (
            "RECTILINEAR_GRID\nDIMENSIONS 2 1 1\nX_COORDINATES 1 double\n0\nY_COORDINATES 1 double\n0\nZ_COORDINATES \
             1 double\n0\nPOINT_DATA 2\nSCALARS a int\n1 2\n",
            "expected as many coordinates along each axis",
        ),
    ] {
        let said = refused(legacy(body).as_bytes());
        assert!(said.contains(word), "{body}: {said}");
    }
}

/// Cuts off each file of one mesh anywhere.
#[test]
fn files_that_are_cut_off_are_survived() {
    let mut count = 0;
    for entry in std::fs::read_dir(data("")).unwrap() {
        let Ok(bytes) = std::fs::read(entry.unwrap().path()) else { continue };
        let step = 1 + bytes.len() / 150;
        for end in (0..bytes.len()).step_by(step) {
            if let Ok(Contents::Snapshots(found)) = parse(&bytes[..end], &everything(&KNOWN)) {
                for snapshot in found {
                    snapshot.cells.iter().for_each(|(_, own)| {
                        assert!(own.iter().all(|it| *it < snapshot.rows()));
                    });
                }
            }
            count += 1;
        }
    }
    assert!(count > 4_000);
}
