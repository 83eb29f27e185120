//! Files that meshio, VTK and NumPy wrote (`data/write.py`), each with the same numbers, and broken files.

use std::path::{Path, PathBuf};

use mms_results::cell::CellShape;
use mms_results::motion::{Motion, resolve, validate_distinct};
use mms_results::names::{KNOWN, Mapping, Names, Role, everything, recognise};
use mms_results::{Contents, Mistake, Snapshot, Stored, parse, read};
use proptest::prelude::*;

use crate::survive::{outside, survive};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

fn open(path: &Path, _: u64) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|error| error.to_string())
}

fn one(name: &str) -> Snapshot {
    let mut found = read(&data(name), &open, &everything(&KNOWN))
        .unwrap_or_else(|mistake| panic!("{name}: {mistake}"));
    assert_eq!(found.len(), 1, "{name}");
    found.remove(0)
}

/// The names of the files with these extensions.
fn files(ends: &[&str]) -> Vec<String> {
    let names = std::fs::read_dir(data("")).unwrap();
    let names = names.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<_> =
        names.filter(|name| ends.iter().any(|end| name.ends_with(end))).collect();
    names.sort();
    names
}

fn motion<'a>(snapshot: &'a Snapshot, map: &[&str]) -> Result<Motion<'a>, Mistake> {
    let map: Vec<Mapping> = map.iter().map(|it| it.parse().unwrap()).collect();
    let found = recognise(snapshot, &Names { map, ..Names::default() }, &|_| true)?;
    resolve(snapshot, &found, 2, &outside, None)
}

fn reference(point: usize) -> [f64; 2] {
    [(point % 3) as f64 / 2.0, (point / 3) as f64 / 2.0]
}

#[track_caller]
fn near(name: &str, computed: &[f64], exact: impl Fn(usize) -> f64, tolerance: f64) {
    for (at, value) in computed.iter().enumerate() {
        let exact = exact(at);
        assert!((value - exact).abs() <= tolerance, "{name}: {at}: {value} is not {exact}");
    }
}

/// Checks that X and u of a file are the written ones, to the precision that the file declares.
#[track_caller]
fn holds_the_mesh(name: &str, snapshot: &Snapshot, motion: &Motion<'_>) {
    assert_eq!(motion.reference.numbers.len(), 18, "{name}");
    let x = |at: usize| reference(at / 2)[at % 2];
    near(name, &motion.reference.numbers, x, 0.0);
    let u = motion.displacement.as_ref().unwrap();
    let exact = |at: usize| {
        let [x, y] = reference(at / 2);
        [0.1 * x * y, -0.2 * x][at % 2]
    };
    near(name, &u.numbers, exact, if u.stored == Stored::Single { u.rounding } else { 1e-16 });
    assert_eq!(
        snapshot.lines.len(),
        if name.starts_with("numpy") && !name.contains(".np") { 9 } else { 0 }
    );
}

#[test]
fn every_vtk_file_has_the_mesh_that_was_written() {
    let names = files(&[".vtu", ".vtp", ".pvtu", ".vtk"]);
    assert!(names.len() > 20);
    for name in names.iter().filter(|name| *name != "meshio_lzma.vtu") {
        let snapshot = one(name);
        let motion = motion(&snapshot, &["X=points"]).unwrap_or_else(|mistake| panic!("{mistake}"));
        holds_the_mesh(name, &snapshot, &motion);
        assert_eq!(snapshot.cells.types, [9; 4], "{name}");
        assert_eq!(snapshot.cells.iter().nth(3).unwrap().1, [4, 5, 8, 7], "{name}");
        let middle = &snapshot.of_cells[0];
        assert_eq!(
            (middle.name.as_str(), middle.values.as_slice()),
            ("middle", &[0.25, 0.75, 0.25, 0.75][..])
        );
        let time = snapshot.time.map(|time| time.value);
        assert_eq!(time, (!name.starts_with("meshio")).then_some(0.25), "{name}");
    }
}

#[test]
fn every_numpy_file_has_the_mesh_that_was_written() {
    for name in files(&[".npz", ".csv", ".tsv", ".txt"]) {
        if !name.starts_with("numpy") {
            continue;
        }
        let snapshot = one(&name);
        holds_the_mesh(&name, &snapshot, &motion(&snapshot, &[]).unwrap());
        assert_eq!(snapshot.time.map(|it| it.value), name.contains(".npz").then_some(0.25));
    }
    let snapshot = one("numpy.npy");
    let map = ["X=array:0,array:1", "u=array:2,array:3"];
    holds_the_mesh("numpy.npy", &snapshot, &motion(&snapshot, &map).unwrap());
}

#[test]
fn precision_is_that_of_the_file() {
    let stored =
        |name: &str| motion(&one(name), &["X=points"]).unwrap().displacement.unwrap().stored;
    assert_eq!(stored("vtk_single.vtu"), Stored::Single);
    assert_eq!(stored("vtk_appended_zlib_big.vtu"), Stored::Double);
    let stored = |name: &str| motion(&one(name), &[]).unwrap().displacement.unwrap().stored;
    assert_eq!(stored("numpy.csv"), Stored::Double);
    assert_eq!(stored("numpy_six.tsv"), Stored::Fixed(6));
    assert_eq!(stored("numpy_fortran_big_single.npz"), Stored::Single);
}

/// Compares the nodes of cells with VTK's own.
#[test]
fn nodes_are_where_vtk_has_them() {
    let text = std::fs::read_to_string(data("nodes.txt")).unwrap();
    let mut count = 0;
    for line in text.lines() {
        let numbers: Vec<f64> = line.split(' ').map(|it| it.parse().unwrap()).collect();
        let shape = crate::shape(numbers[0] as u8);
        assert_eq!(shape.nodes.as_flattened(), &numbers[1..], "{}", shape.kind());
        count += 1;
    }
    assert_eq!(count, CellShape::all().count());
}

/// A mesh of one line whose points have no places.
const WITHOUT_POINTS: &str = "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"2\" \
    NumberOfCells=\"1\"><Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1</DataArray>\
    <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">2</DataArray><DataArray type=\"UInt8\" \
    Name=\"types\" format=\"ascii\">3</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";

fn refused(text: &str) -> String {
    parse(text.as_bytes(), &everything(&KNOWN)).unwrap_err().of("file").to_string()
}

#[test]
fn what_is_not_read_is_named() {
    let said = read(&data("meshio_lzma.vtu"), &open, &everything(&KNOWN)).unwrap_err().to_string();
    assert!(said.contains("vtkLZMADataCompressor"), "{said}");
    for (text, word) in [
        ("", "empty"),
        ("CDF\u{1}", "etCDF"),
        ("$NOD\n", "Gmsh"),
        ("<Xdmf/>", "expected a `<Grid>`"),
        ("ADIOS-BP v2", "ADIOS2 is not read; write XDMF"),
        (
            "<VTKFile type=\"HyperTreeGrid\"><HyperTreeGrid/></VTKFile>",
            "`HyperTreeGrid` is not read",
        ),
        ("# vtk DataFile Version 3.0\n\nASCII\nDATASET FIELD\n", "`FIELD` is not read"),
        (WITHOUT_POINTS, "expected an element `<Points>`"),
        ("1,2\n3,4\n", "file:1: expected names"),
        ("X,u\n", "no line of numbers"),
        ("X,u\n1,2\n1,two\n", "file:3: column `u`: expected a number, found `two`"),
        ("X,u\n1,f64(2.5)\n", "file:2: column `u`: expected a number, found `f64(2.5)`"),
        ("X,u\n1,2\n1\n", "file:3: 1 columns, and 2 names"),
        ("X,X\n1,2\n", "two columns are called `X`"),
    ] {
        let said = refused(text);
        assert!(said.contains(word), "{text}: {said}");
    }
    let hdf = parse(b"\x89HDF\r\n\x1a\n", &everything(&KNOWN)).unwrap_err();
    assert!(hdf.what.contains("HDF5"));
    assert!(
        parse(b"\xff\xfe\x00", &everything(&KNOWN))
            .unwrap_err()
            .what
            .contains("neither text in UTF-8 nor")
    );
}

fn table(text: &str) -> Snapshot {
    match parse(text.as_bytes(), &everything(&KNOWN)).unwrap() {
        Contents::Snapshots(mut found) => found.remove(0),
        other => panic!("{other:?}"),
    }
}

/// X and u of one line of a table with these columns.
fn read_as(header: &str, numbers: &str, map: &[&str]) -> Result<(Vec<f64>, Vec<f64>), String> {
    let snapshot = table(&format!("{header}\n{numbers}\n"));
    let motion = motion(&snapshot, map).map_err(|mistake| mistake.what)?;
    let u = motion.displacement.map_or(Vec::new(), |it| it.numbers.into_owned());
    Ok((motion.reference.numbers.into_owned(), u))
}

#[test]
fn names_that_codes_use_are_known() {
    let expected = Ok((vec![0.25, 0.5], vec![0.5, -0.5]));
    for header in [
        "X,Y,ux,uy",
        "X,Y,u_x,u_y",
        "X_0,X_1,U1,U2",
        "X,Y,DISPLACEMENT_X,DISPLACEMENT_Y",
        "X,Y,displacement:0,displacement:1",
        "X[0],X[1],u.x,u.y",
        "x,y,disp_1,disp_2",
        "Points:0,Points:1,Displ-X,Displ-Y",
        "reference_position_x,reference_position_y,u0,u1",
    ] {
        let found = read_as(header, "0.25,0.5,0.5,-0.5", &[]);
        assert_eq!(found, expected, "{header}");
    }
    let third = read_as("X,Y,Z,ux,uy,uz", "0.25,0.5,0,0.5,-0.5,0", &[]);
    assert_eq!(third, expected);
    let mapped = read_as("x0,y0,a,b", "0.25,0.5,0.5,-0.5", &["X=x0,y0", "u=a,b"]);
    assert_eq!(mapped, expected);
}

#[test]
fn two_of_three_give_the_third() {
    let by_position = read_as("X,Y,x,y", "0.25,0.5,0.375,0", &[]);
    assert_eq!(by_position, Ok((vec![0.25, 0.5], vec![0.125, -0.5])));
    // Read as X, x = 1.25 would lie outside.
    let moved = read_as("x,y,ux,uy", "1.25,0.5,0.5,0.25", &[]);
    assert_eq!(moved, Ok((vec![0.75, 0.25], vec![0.5, 0.25])));
    // Read as x, it would come from outside.
    let fixed = read_as("x,y,ux,uy", "0.25,0.5,0.5,0.25", &[]);
    assert_eq!(fixed, Ok((vec![0.25, 0.5], vec![0.5, 0.25])));
    let either = ("x,y,ux,uy", "0.5,0.5,0.25,0.25");
    assert!(
        read_as(either.0, either.1, &[]).unwrap_err().contains("`--map X=x,y` or `--map x=x,y`")
    );
    let [mapped, other] =
        ["X=x,y", "x=x,y"].map(|map| read_as(either.0, either.1, &[map]).unwrap().0);
    assert_eq!((mapped, other), (vec![0.5, 0.5], vec![0.25, 0.25]));
}

#[test]
fn what_may_be_two_things_is_refused_with_both() {
    let both = read_as("X,Y,ux,uy,disp_x,disp_y", "0,0,0,0,0,0", &[]).unwrap_err();
    assert!(both.contains("both `u` and `disp` may be displacement"), "{both}");
    let stress = read_as("X,Y,stress_xx", "0,0,0", &[]).unwrap_err();
    assert!(stress.contains("cauchy_stress or first_piola_kirchhoff"), "{stress}");
    let dimension = read_as("X,Y,u,v", "0,0,0,0", &[]).unwrap_err();
    assert!(dimension.contains("`u`, read as displacement, has 1 component(s)"), "{dimension}");
    let solid = read_as("X,Y,Z,ux,uy,uz", "0,0,0,0,0,1", &[]).unwrap_err();
    assert!(solid.contains("component of 1 beyond the 2 of the field"), "{solid}");
    let missing = read_as("X,Y,u", "0,0,0", &["u=w"]).unwrap_err();
    assert!(missing.contains("no array `w`; the file has `X`, `Y`, `u`"), "{missing}");
}

#[test]
fn tensors_are_read_by_their_entries() {
    let snapshot =
        table("X,Y,F11,F12,F21,F22,sigma_xx,sigma_yy,sigma_xy,b:0,b:1\n0,0,1,2,3,4,5,6,7,8,9\n");
    let found = recognise(&snapshot, &KNOWN, &|_| true).unwrap();
    let values = |role: Role| {
        let meaning = found.iter().find(|it| it.role == role).unwrap();
        meaning.values(&snapshot, 2).unwrap().numbers.into_owned()
    };
    assert_eq!(values(Role::DeformationGradient), [1.0, 2.0, 3.0, 4.0]);
    assert_eq!(values(Role::CauchyStress), [5.0, 7.0, 7.0, 6.0]);
    assert_eq!(values(Role::BodyForce), [8.0, 9.0]);
}

#[test]
fn mistakes_name_their_lines() {
    let said = |text: &str| {
        let mut snapshot = table(text);
        snapshot.path = "file".into();
        let found = motion(&snapshot, &[])
            .and_then(|motion| validate_distinct(&snapshot, &motion.reference));
        found.unwrap_err().to_string()
    };
    let far = said("X,Y,ux,uy\n0,0,0,0\n1.25,0,0,0\n");
    assert!(far.starts_with("file:3: X = [1.25, 0.0] lies outside the body by 2.5e-1"), "{far}");
    let nan = said("X,Y,ux,uy\n0,0,0,0\n\n1,0,0,nan\n");
    assert!(nan.starts_with("file:4: u is NaN"), "{nan}");
    let twice = said("X,Y,ux,uy\n0,0,0,0\n1,0,0,0\n0,0,0,0\n");
    assert!(twice.starts_with("file:4: ") && twice.contains("file:2"), "{twice}");
}

/// A number of digits whose negative is no integer of 32 bits.
#[test]
fn numbers_with_long_exponents_are_rounded_to_nothing() {
    for (digits, rounding) in [(1 << 31, 0.0), (u32::MAX, 0.0), (3, 5e-4)] {
        assert_eq!(Stored::Fixed(digits).rounding(1.0), rounding);
        assert_eq!(Stored::Digits(digits).rounding(0.5), rounding);
    }
    let found = table("t,X,u\n0.000e-2147483645,0,0\n");
    assert_eq!(found.time.expect("a time").rounding, 0.0);
}

#[test]
fn times_of_a_table_are_snapshots() {
    let text = "t,X,Y,ux,uy\n0.5,0,0,1,2\n0.25,0,0,3,4\n0.5,1,0,5,6\n";
    let Contents::Snapshots(found) = parse(text.as_bytes(), &everything(&KNOWN)).unwrap() else {
        panic!()
    };
    let times: Vec<_> = found.iter().map(|it| it.time.unwrap().value).collect();
    assert_eq!(times, [0.25, 0.5]);
    assert_eq!(
        (found[1].lines.as_slice(), found[1].of_points[2].values.as_slice()),
        (&[2, 4][..], &[1.0, 5.0][..])
    );
}

#[test]
fn a_list_of_times_reads_its_files() {
    let list = r#"<VTKFile type="Collection"><Collection>
        <DataSet timestep="0.5" file="vtk_single.vtu"/><DataSet timestep="0.125" file="vtk.vtp"/>
        </Collection></VTKFile>"#;
    let open = |path: &Path, room: u64| {
        if path.ends_with("list.pvd") { Ok(list.into()) } else { open(path, room) }
    };
    let found = read(&data("list.pvd"), &open, &everything(&KNOWN)).unwrap();
    let times: Vec<_> = found.iter().map(|it| it.time.unwrap().value).collect();
    assert_eq!(times, [0.125, 0.5]);
    assert!(found[0].path.ends_with("vtk.vtp"));
    let itself = list.replace("vtk.vtp", "list.pvd");
    let open = |path: &Path, room: u64| {
        if path.ends_with("list.pvd") { Ok(itself.clone().into()) } else { open(path, room) }
    };
    assert!(
        read(&data("list.pvd"), &open, &everything(&KNOWN))
            .unwrap_err()
            .what
            .contains("one mesh at one time")
    );
    let twice = list.replace("vtk.vtp", "vtk_single.vtu");
    assert!(refused(&twice).contains("file:2: the file `vtk_single.vtu` is listed twice"));
}

/// Headers that declare too much are refused before memory is allocated for them.
#[test]
fn sizes_that_are_claimed_are_not_believed() {
    let huge = usize::MAX / 16;
    for text in [
        format!("# vtk DataFile Version 3.0\n\nBINARY\nDATASET POLYDATA\nPOINTS {huge} double\n"),
        format!("# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS {huge} double\n1 2 3\n"),
        format!("# vtk DataFile Version 5.1\n\nBINARY\nDATASET POLYDATA\nVERTICES {huge} 1\nOFFSETS vtktypeint64\n"),
        format!(
            "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"{huge}\"><Points><DataArray \
             type=\"Float64\" NumberOfComponents=\"3\">1 2 3</DataArray></Points></Piece></PolyData></VTKFile>"
        ),
        "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"1\"><Points><DataArray type=\"Float64\" \
         NumberOfComponents=\"3\" format=\"binary\">////////////////</DataArray></Points></Piece></PolyData></VTKFile>"
            .to_owned(),
    ] {
        assert!(parse(text.as_bytes(), &everything(&KNOWN)).is_err(), "{text}");
    }
    let npy = |shape: &str| {
        let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend([0; 8]);
        parse(&bytes, &everything(&KNOWN))
    };
    assert!(npy("(1,)").is_ok());
    for shape in [
        "(2,)",
        "(4294967296, 4294967296, 4294967296)",
        "(0, 5)",
        "(-1,)",
        "(18446744073709551615,)",
    ] {
        assert!(npy(shape).is_err(), "{shape}");
    }
}

#[test]
fn deep_and_wide_xml_ends_soon() {
    let deep = "<a>".repeat(200_000);
    assert!(parse(deep.as_bytes(), &everything(&KNOWN)).is_err());
    let closed = format!("{deep}{}", "</a>".repeat(200_000));
    assert!(parse(closed.as_bytes(), &everything(&KNOWN)).is_err());
    let attributes: String = (0..200_000).map(|at| format!(" a{at}=\"\"")).collect();
    assert!(refused(&format!("<a{attributes}/>")).contains("a tag of more than"));
    assert!(refused("<!DOCTYPE a [<!ENTITY b \"c\">]><a>&b;</a>").contains("not XML"));
}

proptest! {
    #[test]
    fn files_that_are_cut_off_or_changed_are_survived(
        which: prop::sample::Index,
        cut in prop::option::of(any::<prop::sample::Index>()),
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
    ) {
        let names = files(&[".vtu", ".vtp", ".pvtu", ".vtk", ".npz", ".npy", ".csv", ".tsv", ".txt"]);
        let mut bytes = std::fs::read(data(&names[which.index(names.len())])).unwrap();
        for (at, byte) in flips {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        survive(&bytes);
    }
}
