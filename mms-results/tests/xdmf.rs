//! XDMF with numbers in the XML or in raw files beside it, which need no reader of HDF5.

use std::path::{Path, PathBuf};

use mms_results::names::{KNOWN, everything};
use mms_results::{Contents, Snapshot, Stored, parse, read};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/hdf5").join(name)
}

fn open(path: &Path, _: u64) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|error| error.to_string())
}

fn from(text: &str) -> Result<Vec<Snapshot>, String> {
    let text = format!(
        "<?xml version=\"1.0\"?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf>{text}</Xdmf>"
    );
    match parse(text.as_bytes(), &everything(&KNOWN)) {
        Ok(Contents::Snapshots(found)) => Ok(found),
        Ok(other) => panic!("{other:?}"),
        Err(mistake) => Err(mistake.of("file").to_string()),
    }
}

const GEOMETRY: &str = "<Geometry GeometryType=\"XY\"><DataItem Dimensions=\"4 2\">0 0 1 0 0 1 1 1</DataItem></Geometry>";
const QUAD: &str = "<Topology TopologyType=\"Quadrilateral\"><DataItem NumberType=\"Int\" Dimensions=\"1 4\">0 1 3 2</DataItem></Topology>";

fn attribute(of: &str, dimensions: &str, numbers: &str) -> String {
    format!(
        "<Attribute Name=\"u\" {of}><DataItem Dimensions=\"{dimensions}\">{numbers}</DataItem></Attribute>"
    )
}

#[test]
fn meshio_writes_text_and_bytes_that_are_the_same() {
    for name in ["meshio_xml.xdmf", "meshio_binary.xdmf"] {
        let found =
            read(&data(name), &open, &everything(&KNOWN)).unwrap_or_else(|it| panic!("{it}"));
        let [only] = &found[..] else { panic!("{name}: {}", found.len()) };
        let points = only.points.as_ref().unwrap();
        assert_eq!((points.components, points.rows(), points.stored), (3, 9, Stored::Double));
        assert_eq!(points.values[24..], [1.0, 1.0, 0.0], "{name}");
        assert_eq!(only.cells.types, [9; 4], "{name}");
        assert_eq!(only.cells.iter().nth(3).unwrap().1, [4, 5, 8, 7], "{name}");
        let u = &only.of_points[0];
        assert_eq!((u.name.as_str(), u.components), ("u", 3), "{name}");
        for point in 0..9 {
            let [x, y] = [(point % 3) as f64 / 2.0, (point / 3) as f64 / 2.0];
            assert_eq!(u.values[3 * point..][..3], [0.1 * x * y, -0.2 * x, 0.0], "{name}");
        }
        assert_eq!(only.of_cells[0].values, [0.25, 0.75, 0.25, 0.75], "{name}");
    }
    let mixed = &read(&data("meshio_mixed.xdmf"), &open, &everything(&KNOWN)).unwrap()[0];
    assert_eq!(mixed.cells.types, [5, 5, 9, 9, 9]);
    assert_eq!(mixed.cells.iter().nth(1).unwrap().1, [0, 4, 3]);
    assert_eq!(mixed.points.as_ref().unwrap().components, 2);
}

#[test]
fn grids_are_at_times_or_pieces() {
    let u = |value: f64| attribute("Type=\"Scalar\"", "4", &format!("{value} 1 2 3.5"));
    let grid = |time: &str, value: f64| {
        let include = "<include xpointer=\"xpointer(//Grid[@Name='first']/*[self::Topology or self::Geometry])\"/>";
        format!("<Grid>{include}{time}{}</Grid>", u(value))
    };
    let own = format!("<Grid Name=\"first\">{QUAD}{GEOMETRY}</Grid>");
    let series = |inner: &str| {
        format!(
            "<Domain><Grid GridType=\"Collection\" CollectionType=\"Temporal\">{inner}</Grid>{own}</Domain>"
        )
    };
    let times = |found: &[Snapshot]| -> Vec<f64> {
        found.iter().map(|it| it.time.map_or(f64::NAN, |it| it.value)).collect()
    };
    let single =
        series(&(grid("<Time Value=\"2\"/>", 0.75) + &grid("<Time Value=\"0.5\"/>", 0.25)));
    let list = "<Time TimeType=\"List\"><DataItem Dimensions=\"2\">0.5 2</DataItem></Time>";
    let list = series(&format!("{list}{}{}", grid("", 0.25), grid("", 0.75)));
    let even =
        "<Time TimeType=\"HyperSlab\"><DataItem Dimensions=\"3\">0.5 1.5 2</DataItem></Time>";
    let even = series(&format!("{even}{}{}", grid("", 0.25), grid("", 0.75)));
    for text in [single, list, even] {
        let found = from(&text).unwrap_or_else(|it| panic!("{it}"));
        assert_eq!(times(&found), [0.5, 2.0], "{text}");
        assert_eq!(found[1].of_points[0].values, [0.75, 1.0, 2.0, 3.5]);
        assert_eq!(found[1].cells.points, [0, 1, 3, 2]);
    }
    let piece = format!("<Grid>{QUAD}{GEOMETRY}{}</Grid>", u(0.25));
    let spatial = format!(
        "<Domain><Grid GridType=\"Collection\" CollectionType=\"Spatial\"><Time Value=\"0.5\"/>{piece}{piece}</Grid></Domain>"
    );
    let found = from(&spatial).unwrap();
    assert_eq!((found.len(), found[0].rows(), found[0].cells.len()), (1, 8, 2));
    assert_eq!((times(&found), &found[0].cells.points[4..]), (vec![0.5], &[4, 5, 7, 6][..]));
    // Two functions at the same times on one mesh join one snapshot for each time.
    let other = grid("<Time Value=\"0.5\"/>", 0.5).replace("Name=\"u\"", "Name=\"w\"");
    let both = series(&grid("<Time Value=\"0.5\"/>", 0.25));
    let both = both.replace("<Grid Name=\"first\"", &format!(
        "<Grid GridType=\"Collection\" CollectionType=\"Temporal\">{other}</Grid><Grid Name=\"first\""
    ));
    let found = from(&both).unwrap();
    let names: Vec<_> = found[0].of_points.iter().map(|it| it.name.as_str()).collect();
    assert_eq!((found.len(), names), (1, vec!["u", "w"]));
}

#[test]
fn shapes_of_arrays_and_cells_are_those_of_the_format() {
    let grid = |inner: &str| format!("<Domain><Grid>{GEOMETRY}{inner}</Grid></Domain>");
    let one = |inner: &str| from(&grid(inner)).unwrap_or_else(|it| panic!("{it}")).remove(0);
    let six = attribute("AttributeType=\"Tensor6\"", "4 6", &"1 2 3 4 5 6 ".repeat(4));
    let six = &one(&six).of_points[0];
    assert_eq!((six.components, &six.values[..9]), (9, &[1., 2., 3., 2., 4., 5., 3., 5., 6.][..]));
    let of_cell = attribute("Center=\"Cell\" AttributeType=\"Vector\"", "1 3", "1 2 3");
    assert_eq!(one(&format!("{QUAD}{of_cell}")).of_cells[0].values, [1.0, 2.0, 3.0]);
    let of_face = attribute("Center=\"Face\"", "2", "1 2");
    let unread = one(&of_face.replace("Name=\"u\"", "Name=\"w\""));
    assert_eq!((unread.of_points.len(), &unread.unread[..]), (0, &["w".to_owned()][..]));
    let said = from(&grid(&of_face)).unwrap_err();
    assert!(said.contains("`u`: expected values of nodes or of cells"), "{said}");
    let mixed = "<Topology Type=\"Mixed\"><DataItem NumberType=\"Int\" Dimensions=\"15\">1 1 3 2 2 0 1 3 3 0 1 2 4 1 2</DataItem>";
    let said = from(&grid(&format!("{mixed}</Topology>"))).unwrap_err();
    assert!(said.contains("the list of cells ends within a cell"), "{said}");
    let mixed = mixed.replace("15\"", "16\"").replace("4 1 2", "4 1 2 3");
    let cells = one(&format!("{mixed}</Topology>")).cells;
    assert_eq!((cells.types, cells.ends), (vec![1, 3, 5, 5], vec![1, 3, 6, 9]));
    let alone = one("<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"4\"/>");
    assert!(alone.cells.is_empty() && alone.rows() == 4);
    let lines = "<Topology TopologyType=\"Polyline\" NodesPerElement=\"2\"><DataItem Dimensions=\"2 2\">0 1 2 3</DataItem></Topology>";
    assert_eq!(one(lines).cells.types, [3, 3]);
    let axes = "<DataItem Dimensions=\"2\">0 1</DataItem>".repeat(3);
    let apart =
        from(&format!("<Domain><Grid><Geometry Type=\"X_Y_Z\">{axes}</Geometry></Grid></Domain>"))
            .unwrap();
    assert_eq!(apart[0].points.as_ref().unwrap().values, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    let shared = format!(
        "<DataItem Name=\"shared\" Dimensions=\"4\">1 2 3 4</DataItem><Domain><Grid>{GEOMETRY}<Attribute Name=\"u\"><DataItem \
         Reference=\"XML\">/Xdmf/DataItem[@Name=\"shared\"]</DataItem></Attribute></Grid></Domain>"
    );
    assert_eq!(from(&shared).unwrap()[0].of_points[0].values, [1.0, 2.0, 3.0, 4.0]);
}

#[test]
fn mistakes_say_where_and_what() {
    let grid = |inner: &str| format!("<Domain><Grid>{GEOMETRY}{inner}</Grid></Domain>");
    let u = |dimensions: &str, numbers: &str| attribute("", dimensions, numbers);
    for (text, said) in [
        (String::new(), "file:3: expected a `<Grid>` in a `<Domain>`"),
        ("<Domain><Grid/></Domain>".into(), "file:3: expected a `<Geometry>` with points"),
        (grid(&u("4", "1 2 3")), "file:3: `u`: 3 numbers, and its Dimensions `4` are 4"),
        (grid(&u("3", "1 2 3")), "`u`: 3 numbers, and expected as many for each of 4 points or cells"),
        (grid(&u("4", "1 2 3 x")), "file:3: `u`: expected a number, found `x`"),
        (grid(&u("-4", "1")), "`u`: Dimensions `-4`: expected lengths"),
        (grid(&u("99999999999 99999999999", "1")), "expected lengths"),
        (grid(&u("4", "1 2 3 4").replace("<DataItem", "<DataItem ItemType=\"HyperSlab\"")), "`hyperslab` is not read: write the"),
        (grid(&u("4", "1 2 3 4").replace("<DataItem", "<DataItem ItemType=\"Function\"")), "`function` is not read: write the"),
        (grid(&u("4", "1 2 3 4").replace("<DataItem", "<DataItem Format=\"CSV\"")), "Format `csv`: expected XML, HDF or Binary"),
        (grid(&u("4", "a.bin").replace("<DataItem", "<DataItem Format=\"Binary\"")), "in the file `a.bin`, which is not given with it"),
        (grid(&u("4", "a.h5").replace("<DataItem", "<DataItem Format=\"HDF\"")), "`a.h5`: expected FILE:/PATH"),
        (grid(&QUAD.replace("0 1 3 2", "0 1 3 4")), "a cell has the point 4, counted from 0, but there are 4 points"),
        (grid(&QUAD.replace("Quadrilateral", "2DSMesh")), "a topology `2dsmesh` is not read"),
        (grid("<xi:include/>"), "not XML"),
        (grid("<include xpointer=\"xpointer(//Grid[3]/Topology)\"/>"), "points to nothing that is there"),
        (grid("<Time Value=\"soon\"/>"), "file:3: `soon`: expected a time"),
        (grid("").replace("\"XY\"", "\"ORIGIN_DXDYDZ\""), "a geometry `origin_dxdydz` is not read: write XY"),
        (
            grid(&u("4", "1 2 3 4").replace("Name", "ItemType=\"FiniteElementFunction\" ElementFamily=\"CG\" ElementDegree=\"2\" Center=\"Other\" Name")),
            "`u`: elements cg of degree 2 are not read: write the function interpolated to CG of degree 1",
        ),
    ] {
        let found = from(&text).unwrap_err();
        assert!(found.contains(said), "{text}\n{found}");
    }
    let deep = "<Grid GridType=\"Tree\">".repeat(50) + &"</Grid>".repeat(50);
    assert!(
        from(&format!("<Domain>{deep}</Domain>")).unwrap_err().contains("in more than 8 others")
    );
}

/// A file may name others in its own folder and below.
#[test]
fn other_files_are_beside_it() {
    let named = |file: &str| {
        let text = format!(
            "<Xdmf><Domain><Grid>{GEOMETRY}<Attribute Name=\"u\"><DataItem Format=\"Binary\" Precision=\"8\" Endian=\"Big\" Seek=\"8\" \
             Dimensions=\"4\">{file}</DataItem></Attribute></Grid></Domain></Xdmf>"
        );
        let open = |path: &Path, _: u64| match path.to_str() {
            Some("folder/own.xdmf") => Ok(text.clone().into_bytes()),
            Some("folder/part/numbers.bin") => {
                Ok([9.0, 1.0, 2.0, 3.0, 4.0_f64].iter().flat_map(|it| it.to_be_bytes()).collect())
            }
            Some("folder/short.bin") => Ok(vec![0; 39]),
            other => Err(format!("no file {other:?}")),
        };
        read(Path::new("folder/own.xdmf"), &open, &everything(&KNOWN)).map_err(|it| it.to_string())
    };
    assert_eq!(named("part/numbers.bin").unwrap()[0].of_points[0].values, [1.0, 2.0, 3.0, 4.0]);
    assert!(named("short.bin").unwrap_err().contains("the file `short.bin` ends before"));
    assert!(named("missing.bin").unwrap_err().contains("no file"));
    assert!(
        named("/etc/passwd")
            .unwrap_err()
            .contains("expected a path from the folder of this file on")
    );
}

#[cfg(not(feature = "hdf5"))]
#[test]
fn without_the_feature_files_say_how_to_have_it() {
    let said = |name: &str| read(&data(name), &open, &everything(&KNOWN)).unwrap_err().to_string();
    let feature = "`cargo install --path . --features hdf5`";
    for (name, format, other) in [
        ("h5py_latest.h5", "HDF5", "`numpy.savez`"),
        ("matlab.mat", "MATLAB 7.3", "`numpy.savez`"),
        ("netcdf3_classic.nc", "NetCDF", "`meshio convert results.e results.vtu`"),
        ("moose_netcdf3_64bit_offset.e", "Exodus", "`meshio convert results.e results.vtu`"),
        ("vtk_grid.vtkhdf", "HDF5", "`numpy.savez`"),
        ("meshio_hdf.xdmf", "XDMF", "`meshio.xdmf.TimeSeriesReader`"),
    ] {
        let said = said(name);
        assert!([format, feature, other].iter().all(|it| said.contains(it)), "{name}: {said}");
    }
}
