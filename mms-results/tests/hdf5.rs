//! Files of HDF5 and netCDF, and of the formats over them, that other programs wrote (`data/write_hdf5.py`).

use std::path::{Path, PathBuf};

use allocation_counter::measure;
use mms_results::motion::resolve;
use mms_results::names::{KNOWN, Names, everything, recognise, wanted};
use mms_results::wanted::{Need, Wanted};
use mms_results::{Array, Contents, Snapshot, Stored, parse, read};
use proptest::prelude::*;

use crate::survive::{outside, survive};

mod survive;

const TIMES: [f64; 3] = [0.0, 0.5, 2.0];

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/hdf5").join(name)
}

fn open(path: &Path, _: u64) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|error| error.to_string())
}

fn all(name: &str, map: &[&str]) -> Vec<Snapshot> {
    read(&data(name), &open, &everything(&mapped(map))).unwrap_or_else(|it| panic!("{it}"))
}

/// A user's mapping of names.
fn mapped(map: &[&str]) -> Names {
    let map = map.iter().map(|it| it.parse().unwrap()).collect();
    Names { map, ..Names::default() }
}

fn reference(point: usize) -> [f64; 2] {
    [(point % 3) as f64 / 2.0, (point / 3) as f64 / 2.0]
}

fn displacement(time: f64, point: usize) -> [f64; 2] {
    let [x, y] = reference(point);
    [(1.0 + time) * (0.1 * x * y), (1.0 + time) * (-0.2 * x)]
}

/// Checks that X and u of a snapshot are the ones written for its time.
#[track_caller]
fn holds_the_motion(name: &str, snapshot: &Snapshot, map: &[&str], tolerance: f64) {
    let is_wanted = |role: mms_results::names::Role| role.symbol() == "u" || role.symbol() == "X";
    let found =
        recognise(snapshot, &mapped(map), &|role| is_wanted(role) || role.symbol() == "points");
    let found = found.unwrap_or_else(|it| panic!("{name}: {it}"));
    let motion = resolve(snapshot, &found, 2, &outside, None);
    let motion = motion.unwrap_or_else(|it| panic!("{name}: {it}"));
    let time = snapshot.time.map_or(0.0, |it| it.value);
    let u = motion.displacement.unwrap_or_else(|| panic!("{name}: no u"));
    assert_eq!((motion.reference.numbers.len(), u.numbers.len()), (18, 18), "{name}");
    for at in 0..18 {
        assert_eq!(motion.reference.numbers[at], reference(at / 2)[at % 2], "{name}: X {at}");
        let exact = displacement(time, at / 2)[at % 2];
        let found = u.numbers[at];
        assert!((found - exact).abs() <= tolerance, "{name}: {at}: {found} is not {exact}");
    }
}

fn times(found: &[Snapshot]) -> Vec<f64> {
    found.iter().map(|it| it.time.map_or(f64::NAN, |it| it.value)).collect()
}

#[track_caller]
fn named<'a>(arrays: &'a [Array], name: &str) -> &'a Array {
    arrays.iter().find(|it| it.name == name).unwrap_or_else(|| panic!("no {name} in {arrays:?}"))
}

const MIDDLE: [f64; 4] = [0.25, 0.75, 0.25, 0.75];

#[test]
fn arrays_are_read_however_they_are_stored() {
    for name in ["h5py_earliest.h5", "h5py_latest.h5"] {
        let found = all(name, &[]);
        let [one] = &found[..] else { panic!("{name}: {} snapshots", found.len()) };
        assert_eq!(one.time.unwrap().value, 0.25, "{name}");
        let arrays = &one.of_points;
        let u = |at: usize| displacement(0.0, at / 2)[at % 2];
        let exact: Vec<f64> = (0..18).map(u).collect();
        for kind in [
            "as_f8",
            "as_big_f8",
            "chunks",
            "one_chunk",
            "gzip",
            "filters",
            "grows",
            "grows_gzip",
            "grows_both",
            "compact",
            "early",
        ] {
            let array = named(arrays, &format!("stored/{kind}"));
            assert_eq!((array.components, array.stored), (2, Stored::Double), "{name}: {kind}");
            for (value, exact) in array.values.iter().zip(&exact) {
                assert!((value - exact).abs() < 1e-16, "{name}: {kind}");
            }
        }
        let link = named(arrays, "link");
        assert_eq!(link.values, named(arrays, "stored/compact").values);
        for kind in ["as_f4", "as_big_f4"] {
            let array = named(arrays, &format!("stored/{kind}"));
            let single: Vec<f64> = exact.iter().map(|it| f64::from(*it as f32)).collect();
            assert_eq!((array.stored, &array.values), (Stored::Single, &single), "{name}: {kind}");
        }
        let whole: Vec<f64> = (0..18).map(|at| 2.0 * reference(at / 2)[at % 2]).collect();
        for kind in ["i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", "big_i2", "big_u4", "big_i8"] {
            let array = named(arrays, &format!("stored/whole_{kind}"));
            assert_eq!((array.stored, &array.values), (Stored::Whole, &whole), "{name}: {kind}");
        }
        let truth: Vec<f64> = whole.iter().map(|it| f64::from(u8::from(*it > 1.0))).collect();
        assert_eq!(named(arrays, "stored/truth").values, truth);
        let lzf = named(arrays, "stored/lzf");
        assert!(lzf.values.iter().zip(&exact).all(|(a, b)| (a - b).abs() < 1e-16));
        let filled = &named(arrays, "stored/filled").values;
        assert_eq!((&filled[..6], &filled[12..]), (&[-7.5; 6][..], &[-7.5; 6][..]));
        assert_eq!(filled[6..12], named(arrays, "stored/as_f8").values[6..12]);
        assert_eq!(named(arrays, "stored/never").values, [1.5; 18]);
        let many: Vec<f64> = (0..400).map(f64::from).collect();
        assert_eq!(named(arrays, "many").values, many);
        for member in 0..60 {
            let array = named(arrays, &format!("members/m{member:02}"));
            assert_eq!(array.values, [f64::from(member)]);
        }
        let none = named(arrays, "v");
        assert_eq!((none.components, none.rows()), (1, 0), "{name}");
        let mut unread = one.unread.clone();
        unread.sort();
        assert_eq!(unread, ["name", "names", "record"], "{name}");
        holds_the_motion(name, &Snapshot { time: None, ..one.clone() }, &[], 1e-16);
    }
}

#[test]
fn paths_are_mapped_with_and_without_the_slash() {
    for slash in ["", "/"] {
        let texts = [format!("X={slash}run/mesh/X"), format!("u={slash}run/fields/u")];
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        holds_the_motion("groups.h5", &all("groups.h5", &texts)[0], &texts, 1e-16);
        let is_none = |_| false;
        let read = read(&data("groups.h5"), &open, &wanted(&mapped(&texts[1..]), &is_none));
        let read = read.unwrap();
        assert_eq!((read[0].of_points.len(), read[0].unread.len()), (1, 2));
        // T is a temperature.
        assert_eq!(named(&all("groups.h5", &texts)[0].of_points, "T").values[1], 300.5);
    }
}

/// Names in groups are not recognised: they are listed in the form for `--map`.
#[test]
fn paths_are_listed_where_nothing_is_known() {
    let found = &all("groups.h5", &[])[0];
    let meant = recognise(found, &KNOWN, &|_| true).unwrap();
    let said = resolve(found, &meant, 2, &|_: &[f64]| 0.0, None).unwrap_err().what;
    assert!(said.ends_with("the file has `T`, `run/fields/u`, `run/mesh/X`"), "{said}");
}

#[test]
fn the_first_of_three_axes_may_be_times() {
    let found = all("times.h5", &[]);
    assert_eq!(times(&found), TIMES);
    for snapshot in &found {
        holds_the_motion("times.h5", snapshot, &[], 1e-15);
        let gradient = named(&snapshot.of_points, "F");
        assert_eq!((gradient.components, gradient.rows()), (4, 9));
        let exact: Vec<f64> =
            (0..9).map(|at| 1.0 + snapshot.time.unwrap().value * reference(at)[0]).collect();
        assert_eq!(named(&snapshot.of_points, "J").values, exact);
    }
}

#[test]
fn one_time_may_have_an_axis() {
    let found = all("one_time.h5", &[]);
    assert_eq!(times(&found), [0.5]);
    holds_the_motion("one_time.h5", &found[0], &[], 1e-16);
}

#[test]
fn every_version_of_netcdf_holds_the_same() {
    for kind in [
        "netcdf3_classic",
        "netcdf3_64bit_offset",
        "netcdf3_64bit_data",
        "netcdf4",
        "netcdf4_classic",
    ] {
        let name = format!("{kind}.nc");
        let found = all(&name, &[]);
        assert_eq!(times(&found), TIMES, "{name}");
        for snapshot in &found {
            holds_the_motion(&name, snapshot, &[], 1e-15);
            assert_eq!(named(&snapshot.of_points, "v").stored, Stored::Single, "{name}");
            let kinds: Vec<f64> = (0..9).map(f64::from).collect();
            assert_eq!(named(&snapshot.of_points, "kind").values, kinds, "{name}");
            assert_eq!(named(&snapshot.of_points, "odd").values, [0.0, 1.0, 2.0], "{name}");
            assert_eq!(snapshot.unread, ["words"], "{name}");
        }
    }
}

#[test]
fn variables_of_matlab_have_their_axes_in_reverse() {
    for (name, tolerance) in [("matlab.mat", 1e-16), ("matlab_single.mat", 1e-8)] {
        let found = all(name, &[]);
        assert_eq!(times(&found), [0.25]);
        let snapshot = Snapshot { time: None, ..found[0].clone() };
        holds_the_motion(name, &snapshot, &[], tolerance);
    }
    let single = &all("matlab_single.mat", &[])[0];
    assert_eq!(named(&single.of_points, "u").stored, Stored::Single);
    let gradient = named(&single.of_points, "F");
    let exact: Vec<f64> = (0..36).map(f64::from).collect();
    assert_eq!((gradient.components, &gradient.values), (4, &exact));
    let row = named(&single.of_points, "row");
    assert_eq!((row.components, row.rows()), (1, 9));
    assert_eq!(single.unread, ["none", "word", "#refs#/a"]);
    let other = &all("matlab.mat", &[])[0];
    assert_eq!(
        (named(&other.of_points, "J").components, &other.unread[..]),
        (1, &["name".into()][..])
    );
}

#[test]
fn exodus_has_the_reference_at_all_times() {
    for name in ["moose_netcdf3_64bit_offset.e", "moose_netcdf4.e", "old.exo"] {
        let found = all(name, &[]);
        assert_eq!(times(&found), TIMES, "{name}");
        for (snapshot, time) in found.iter().zip(TIMES) {
            holds_the_motion(name, snapshot, &[], 1e-15);
            assert_eq!(snapshot.cells.types, [9; 4], "{name}");
            assert_eq!(snapshot.cells.iter().nth(3).unwrap().1, [4, 5, 8, 7], "{name}");
            if name != "old.exo" {
                assert_eq!(named(&snapshot.of_points, "temp").values, [time; 9]);
                assert_eq!(named(&snapshot.of_cells, "middle").values, MIDDLE);
                assert_eq!(named(&snapshot.of_cells, "time_of").values, [time; 4]);
            }
        }
    }
    let found = all("meshio.e", &[]);
    holds_the_motion("meshio.e", &found[0], &[], 1e-16);
    let few = read(&data("moose_netcdf4.e"), &open, &wanted(&KNOWN, &|role| role.symbol() == "u"));
    let few = &few.unwrap()[0];
    assert_eq!((few.of_points.len(), few.of_cells.len()), (2, 0));
    assert_eq!(few.unread, ["temp", "middle", "time_of"]);
}

/// Reads a file with some bytes changed, and returns the reason for the refusal.
fn refused(name: &str, from: &[u8], to: &[u8]) -> String {
    let mut bytes = std::fs::read(data(name)).unwrap();
    let at = bytes.windows(from.len()).position(|it| it == from).expect("these bytes");
    bytes[at..at + to.len()].copy_from_slice(to);
    parse(&bytes, &everything(&KNOWN)).unwrap_err().what
}

#[test]
fn mistakes_name_the_array_and_what_was_expected() {
    let exodus = "moose_netcdf3_64bit_offset.e";
    let said = refused(exodus, b"QUAD4", b"BLOB4");
    assert!(
        said.starts_with("`connect1`: elements `BLOB4` of 4 nodes are not read: write"),
        "{said}"
    );
    let nodes = |all: [i32; 4]| all.map(i32::to_be_bytes).concat();
    let said = refused(exodus, &nodes([1, 2, 5, 4]), &nodes([1, 2, 10, 4]));
    assert_eq!(said, "`connect1`: expected a node from 1 to 9, found 10");
    let said = refused(exodus, b"disp_y", b"disp_x");
    assert_eq!(said, "two variables are called `disp_x`");
    let said = refused(exodus, &2.0_f64.to_be_bytes(), &f64::NAN.to_be_bytes());
    assert_eq!(said, "`time_whole`: NaN is no time");
    let said = refused("vtk_grid.vtkhdf", b"UnstructuredGrid\0", b"HyperTreeGrid\0\0\0\0");
    assert!(
        said.starts_with("`HyperTreeGrid` of VTKHDF is not read: expected UnstructuredGrid"),
        "{said}"
    );
    let extent = |all: [i64; 6]| all.map(i64::to_le_bytes).concat();
    let own = extent([0, 2, 0, 2, 0, 0]);
    for other in [[0, 1 << 40, 0, 2, 0, 0], [0, 1 << 40, 0, 1 << 40, 0, -1]] {
        let said = refused("image.vtkhdf", &own, &extent(other));
        assert!(said.contains(" points: the file has other numbers of them"), "{said}");
    }
    let none = |_| false;
    let few = |map: &str| read(&data("zstd.h5"), &open, &wanted(&mapped(&[map]), &none));
    let said = few("u=u").unwrap_err().what;
    let why = "`u`: compressed in a way that is not read (unsupported filter: filter id 32015): write it with gzip";
    assert!(said.starts_with(why), "{said}");
    let read = parse(
        &std::fs::read(data("zstd.h5")).unwrap(),
        &Wanted::new(|name| match name {
            "X" => Need::Must,
            _ => Need::Numbers,
        }),
    );
    let Ok(Contents::Snapshots(read)) = read else { panic!() };
    assert_eq!(
        (read[0].of_points.len(), &read[0].unread[..]),
        (1, &["other".into(), "u".into()][..])
    );
    let said = refused("netcdf3_classic.nc", b"CDF\x01", b"CDF\x03");
    assert!(said.contains("version 3 of netCDF: expected 1, 2 or 5"), "{said}");
}

/// Compares the nodes of each element with VTK's, reading the same file.
#[test]
fn nodes_of_elements_are_where_vtk_has_them() {
    let found = all("elements.e", &[]);
    let snapshot = &found[0];
    assert_eq!(snapshot.time, None);
    let text = std::fs::read_to_string(data("elements.txt")).unwrap();
    let points = snapshot.points.as_ref().unwrap();
    let mut count = 0;
    for (line, (kind, nodes)) in text.lines().zip(snapshot.cells.iter()) {
        let expected: Vec<f64> = line.split(' ').map(|it| it.parse().unwrap()).collect();
        let places = nodes.iter().flat_map(|node| &points.values[3 * node..][..3]).copied();
        let found: Vec<f64> = [f64::from(kind)].into_iter().chain(places).collect();
        assert_eq!(found, expected, "{line}");
        count += 1;
    }
    assert_eq!((count, snapshot.cells.len()), (15, 15));
}

#[test]
fn vtkhdf_has_steps_pieces_and_surfaces() {
    for name in ["vtk_grid.vtkhdf", "vtk_surface.vtkhdf", "image.vtkhdf"] {
        let found = all(name, &[]);
        assert_eq!(found.len(), 1, "{name}");
        let time = found[0].time.map(|it| it.value);
        assert_eq!(time, if name == "image.vtkhdf" { None } else { Some(0.0) }, "{name}");
        holds_the_motion(name, &found[0], &["X=points"], 1e-16);
        assert_eq!(found[0].cells.types, [9; 4], "{name}");
        assert_eq!(found[0].cells.iter().nth(3).unwrap().1, [4, 5, 8, 7], "{name}");
        assert_eq!(named(&found[0].of_cells, "middle").values, MIDDLE, "{name}");
    }
    for name in ["vtk_grid_times.vtkhdf", "vtk_surface_times.vtkhdf"] {
        let found = all(name, &[]);
        assert_eq!(times(&found), TIMES, "{name}");
        for snapshot in &found {
            holds_the_motion(name, snapshot, &["X=points"], 1e-15);
            assert_eq!(snapshot.cells.iter().nth(3).unwrap().1, [4, 5, 8, 7], "{name}");
            assert_eq!(named(&snapshot.of_cells, "middle").values, MIDDLE, "{name}");
        }
    }
    let found = all("pieces.vtkhdf", &[]);
    assert_eq!(times(&found), TIMES);
    for (snapshot, time) in found.iter().zip(TIMES) {
        assert_eq!((snapshot.rows(), snapshot.cells.len()), (12, 4));
        assert_eq!(snapshot.cells.iter().nth(3).unwrap().1, [7, 8, 11, 10]);
        assert_eq!(named(&snapshot.of_cells, "middle").values, MIDDLE);
        // Both pieces contain the middle row of points.
        let u = &named(&snapshot.of_points, "u").values;
        for (row, point) in [0, 1, 2, 3, 4, 5, 3, 4, 5, 6, 7, 8].into_iter().enumerate() {
            let exact = displacement(time, point);
            assert!((u[3 * row] - exact[0]).abs() + (u[3 * row + 1] - exact[1]).abs() < 1e-15);
        }
    }
}

#[test]
fn xdmf_takes_its_numbers_from_hdf5() {
    let found = all("meshio_hdf.xdmf", &[]);
    holds_the_motion("meshio_hdf.xdmf", &found[0], &["X=points"], 1e-16);
    assert_eq!(found[0].cells.types, [9; 4]);
    assert_eq!(named(&found[0].of_cells, "middle").values, MIDDLE);
    for name in ["meshio_times.xdmf", "dolfinx.xdmf", "dolfin.xdmf"] {
        let found = all(name, &[]);
        assert_eq!(times(&found), TIMES, "{name}");
        for snapshot in &found {
            holds_the_motion(name, snapshot, &["X=points"], 1e-15);
            let kind = if name == "meshio_times.xdmf" { 9 } else { 5 };
            assert!(
                snapshot.cells.types.iter().all(|it| *it == kind) && !snapshot.cells.is_empty()
            );
            if name == "dolfinx.xdmf" {
                assert_eq!(named(&snapshot.of_points, "J").values[2], 2.0);
            }
        }
    }
    holds_the_motion("checkpoint", &all("dolfin_checkpoint.xdmf", &[])[0], &["X=points"], 1e-16);
    let file = std::fs::read(data("dolfin.h5")).unwrap();
    let said = parse(&file, &everything(&KNOWN)).unwrap_err().what;
    assert!(said.contains("a checkpoint of dolfin") && said.contains("`XDMFFile.write`"), "{said}");
}

/// The files without companions, with their bytes.
fn files() -> Vec<(String, Vec<u8>)> {
    let entries = std::fs::read_dir(data("")).unwrap().map(|it| it.unwrap().path());
    let is_whole = |it: &PathBuf| it.extension().is_some_and(|end| end != "xdmf" && end != "txt");
    let named = |it: PathBuf| {
        (it.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read(&it).unwrap())
    };
    let mut all: Vec<_> = entries.filter(is_whole).map(named).collect();
    all.sort();
    all
}

/// A file that ends early is refused, or has lost nothing that was read.
#[test]
fn files_that_are_cut_off_are_refused() {
    let mut count = 0;
    for (name, bytes) in
        files().into_iter().filter(|(name, it)| it.len() < 7000 && !name.ends_with("bin"))
    {
        let Ok(Contents::Snapshots(whole)) = parse(&bytes, &everything(&KNOWN)) else { continue };
        for length in 0..bytes.len() {
            match parse(&bytes[..length], &everything(&KNOWN)) {
                Ok(Contents::Snapshots(found)) => assert_eq!(found, whole, "{name}: {length}"),
                Ok(other) => panic!("{name}: {length}: {other:?}"),
                Err(mistake) => assert!(!mistake.what.is_empty()),
            }
            count += 1;
        }
        let half = parse(&bytes[..bytes.len() / 2], &everything(&KNOWN));
        assert!(half.is_err(), "{name}");
    }
    assert!(count > 20_000, "{count}");
}

/// A header of netCDF that declares one variable with this many numbers.
fn classic(count: u32) -> Vec<u8> {
    let words = [
        0,
        10,
        1,
        1,
        u32::from_be_bytes(*b"n\0\0\0"),
        count,
        0,
        0,
        11,
        1,
        1,
        u32::from_be_bytes(*b"u\0\0\0"),
        1,
        0,
        0,
        0,
        6,
        0,
        80,
    ];
    let mut bytes = b"CDF\x01".to_vec();
    bytes.extend(words.iter().flat_map(|it: &u32| it.to_be_bytes()));
    bytes.extend(1.5_f64.to_be_bytes());
    bytes
}

#[test]
fn sizes_that_are_claimed_are_not_believed() {
    let found = parse(&classic(1), &everything(&KNOWN)).unwrap();
    let Contents::Snapshots(found) = found else { panic!() };
    assert_eq!(found[0].of_points[0].values, [1.5]);
    for count in [2, 1000, 1 << 20, u32::MAX] {
        let mut said = String::new();
        let bytes = classic(count);
        let taken =
            measure(|| said = parse(&bytes, &everything(&KNOWN)).unwrap_err().what).bytes_max;
        assert!(said.starts_with("`u`: ") && taken < 1 << 20, "{count}: {said} {taken}");
    }
    for (name, bytes) in files() {
        let taken = measure(|| drop(parse(&bytes, &everything(&KNOWN)))).bytes_max as usize;
        assert!(taken < (1 << 20) + 8 * bytes.len(), "{name}: {taken} bytes for {}", bytes.len());
        let little = everything(&KNOWN).within(100, "give it more");
        if let Err(mistake) = parse(&bytes, &little) {
            let what = mistake.what;
            assert!(
                what.contains("give it more")
                    || what.contains("checkpoint")
                    || name.ends_with("bin"),
                "{name}: {what}"
            );
        }
    }
}

proptest! {
    #[test]
    fn files_that_are_changed_are_survived(
        which: prop::sample::Index,
        cut in prop::option::of(any::<prop::sample::Index>()),
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let all = files();
        let mut bytes = all[which.index(all.len())].1.clone();
        // Headers are at the front, and small compared with the numbers.
        for (at, byte) in flips {
            let at = at.index(bytes.len().min(4096));
            bytes[at] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        let taken = measure(|| survive(&bytes)).bytes_max;
        // Deflate expands one byte to at most 1032, and a byte may become a number of 8 bytes.
        let most = (8 << 20) + 1032 * 10 * bytes.len() as u64;
        prop_assert!(taken < most, "{} bytes of {}", taken, bytes.len());
    }
}
