//! `mms run --vtk`: files that ParaView opens.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use roxmltree::{Document, Node};

use super::mms::Folder;

/// The first element of that name.
fn find<'a>(document: &'a Document<'a>, tag: &str) -> Node<'a, 'a> {
    let found = document.descendants().find(|node| node.has_tag_name(tag));
    found.unwrap_or_else(|| panic!("no <{tag}>"))
}

/// The numbers of an array, whose byte count is checked.
fn numbers(document: &Document, name: &str) -> Vec<f64> {
    let array = document.descendants().find(|node| node.attribute("Name") == Some(name));
    let array = array.unwrap_or_else(|| panic!("no array `{name}`"));
    assert_eq!(array.attribute("type"), Some("Float64"), "{name}");
    let bytes = STANDARD.decode(array.text().expect("a text").trim()).expect("base64");
    let (count, bytes) = bytes.split_first_chunk::<8>().expect("a count");
    assert_eq!(u64::from_le_bytes(*count), bytes.len() as u64, "{name}");
    bytes.as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect()
}

#[test]
fn states_are_written_for_paraview() {
    let folder = Folder::new();
    let run =
        folder.mms("run axis_aligned_2d --cells 8 --vtk out --frames 3 --json").exits(0).json();
    let list = folder.read("out/axis_aligned_2d.pvd");
    let list = Document::parse(&list).expect("XML");
    let states: Vec<_> = list.descendants().filter(|node| node.has_tag_name("DataSet")).collect();
    assert_eq!(states.len(), 4);
    let time = |state: &Node| state.attribute("timestep").and_then(|time| time.parse().ok());
    let times: Vec<f64> = states.iter().filter_map(time).collect();
    // The window of this field: eight quarters of a period, after the first, in 47 steps.
    let quarter = times[0];
    for (frame, time) in times.iter().enumerate() {
        let even = quarter * (1.0 + 8.0 * frame as f64 / 3.0);
        assert!((time - even).abs() <= quarter * 8.0 / 47.0, "{times:?}");
    }

    let last = states[3].attribute("file").expect("a file");
    let last = folder.read(&format!("out/{last}"));
    let last = Document::parse(&last).expect("XML");
    let particles = run["particles"].as_u64().expect("a number") as usize;
    let count = find(&last, "Piece").attribute("NumberOfPoints").map(str::parse);
    assert_eq!(count, Some(Ok(particles)));
    assert_eq!(numbers(&last, "position").len(), 3 * particles);
    assert_eq!(numbers(&last, "cauchy_stress").len(), 9 * particles);
    // The largest error is the one that the run reports.
    let error = numbers(&last, "displacement_error");
    let norms = error.chunks(3).map(|error| error[0].hypot(error[1]).hypot(error[2]));
    let largest = norms.fold(0.0, f64::max);
    let reported = run["errors"]["displacement"]["at_end"]["linf"].as_f64().expect("an error");
    assert!((largest - reported).abs() <= 1e-12 * reported, "{largest} and {reported}");
}

/// F by rows: here H_xy = A/L (1 + X/2L) and H_yx = - B Y^2/L^3, and the components out of the plane are 0.
#[test]
fn tensors_are_written_row_by_row() {
    let folder = Folder::new();
    folder
        .mms("run sheared_block_2d --formulation total --shape linear --cells 4 --vtk out")
        .exits(0);
    let first = folder.read("out/sheared_block_2d_0000.vtu");
    let f = numbers(&Document::parse(&first).expect("XML"), "deformation_gradient");
    assert!(f.chunks(9).all(|f| f[1] > 0.0 && f[3] < 0.0), "{f:?}");
    assert!(f.chunks(9).all(|f| [2, 5, 6, 7, 8].iter().all(|&k| f[k] == 0.0)), "{f:?}");
}

#[test]
fn a_folder_that_cannot_be_is_refused_before_the_run() {
    let folder = Folder::new();
    folder.write("file", "");
    let run = folder.mms("run bar_1d --cells 8 --vtk file/out").exits(2);
    assert!(run.stderr.contains("--vtk file/out"), "{}", run.stderr);
    assert_eq!(folder.read("file"), "");
    folder.mms("run bar_1d --cells 8 --frames 3").exits(2);
    folder.mms("run bar_1d --cells 8 --vtk out --frames 0").exits(2);
}

/// A state that cannot be written stops the run, and the files written before stay.
#[test]
#[cfg(unix)]
fn a_state_that_cannot_be_written_stops_the_run() {
    let folder = Folder::new();
    // The folder of the second state is in the way of its file.
    folder.write("out/bar_1d_0001.vtu/x", "");
    let run = folder.mms("run bar_1d --cells 8 --vtk out --frames 2").exits(3);
    assert!(run.stderr.contains("bar_1d_0001.vtu"), "{}", run.stderr);
    assert!(folder.read("out/bar_1d.pvd").contains("bar_1d_0000.vtu"));
}
