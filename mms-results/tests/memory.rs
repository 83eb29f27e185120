//! No file needs more memory than a few times its own numbers, as counted by the allocator.

use allocation_counter::measure;
use mms_results::names::{KNOWN, everything};
use mms_results::parse;

/// A number of a table has at least two bytes, and becomes eight; an element of XML has three, and becomes two hundred while
/// their list grows.
const FACTOR: usize = 80;
/// A table may have 10,000 times of about a hundred bytes each.
const BASE: usize = 8 << 20;

#[test]
fn no_file_takes_more_memory_than_it_honestly_asks_for() {
    let claimed = usize::MAX / 32;
    let vtk = "# vtk DataFile Version 3.0\n\nBINARY\nDATASET POLYDATA\n";
    let attributes: String = (0..100_000).map(|at| format!(" a{at}=\"\"")).collect();
    let nodes: String =
        (1..=1000).map(|it| format!(" -1{it:5}{:12}{:12}{:12}\n", 1, 2, 3)).collect();
    let frd = "    1C\n    2C\n".to_owned() + &nodes + " -3\n";
    let step = |it: usize| {
        format!("  100CL  101{it:12}\n -4  T           1    1\n -5  T           1    1\n -3\n")
    };
    let msh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    let view = |it: usize| format!("$NodeData\n1\n\"T\"\n1\n{it}\n3\n{it}\n1\n0\n$EndNodeData\n");
    let texts = [
        format!("    2C{:18}{claimed:12}{:37}2\n", "", ""),
        format!("    2C{:18}{claimed:12}{:37}1\n -1", "", ""),
        frd + &(0..3000).map(step).collect::<String>(),
        format!("{msh}$Nodes\n{claimed}\n1 0 0 0\n"),
        format!(
            "{msh}$Nodes\n1000\n{}$EndNodes\n{}",
            nodes.replace(" -1", ""),
            (0..5000).map(view).collect::<String>()
        ),
        format!("{vtk}POINTS {claimed} double\n"),
        format!("{vtk}VERTICES {claimed} {claimed}\n"),
        format!("{vtk}FIELD FieldData {claimed}\n"),
        format!("X,u\n{}", "1,2\n".repeat(100_000)),
        format!("t,u\n{}", (0..10_000).map(|at| format!("{at},2\n")).collect::<String>()),
        format!("t,u\n{}", (0..100_000).map(|at| format!("{at},2\n")).collect::<String>()),
        format!("<a{attributes}/>"),
        "<a/>".repeat(100_000),
        "<a>".repeat(100_000),
        "\u{93}".repeat(100_000),
        "# vtk DataFile Version 3.0\n\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 99999 99999 9\n".into(),
        "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 99999 0 99999 0 9\"><Piece/></ImageData></VTKFile>".into(),
        format!("{{\"files\": [{}0]}}", "[],".repeat(100_000)),
    ];
    for text in &texts {
        let taken =
            measure(|| drop(parse(text.as_bytes(), &everything(&KNOWN)))).bytes_max as usize;
        let name: String = text.chars().take(80).collect();
        assert!(taken <= BASE + FACTOR * text.len(), "{name}: {taken} bytes for {}", text.len());
    }
}
