//! ASCII files of Tecplot, as its guide describes them.

use mms_results::names::{KNOWN, everything};
use mms_results::{Contents, Snapshot, parse};

fn read(text: &str) -> Result<Vec<Snapshot>, String> {
    match parse(text.as_bytes(), &everything(&KNOWN))
        .map_err(|mistake| mistake.of("file").to_string())?
    {
        Contents::Snapshots(found) => Ok(found),
        other => panic!("{other:?}"),
    }
}

fn column<'a>(snapshot: &'a Snapshot, name: &str) -> &'a [f64] {
    let found = snapshot.of_points.iter().find(|it| it.name == name);
    &found.unwrap_or_else(|| panic!("no {name}")).values
}

fn cells(snapshot: &Snapshot) -> Vec<(u8, Vec<usize>)> {
    snapshot.cells.iter().map(|(kind, points)| (kind, points.to_vec())).collect()
}

const POINTS: &str = "0 0 1\n1 0 2\n0 1 3\n1 1 4\n";

#[test]
fn points_and_blocks_hold_the_same() {
    let point = format!(
        "TITLE = \"a run, with = and #\"\nVARIABLES = \"X\", \"Y\"\n\"u x\"\n# half\nZONE T=\"one\", I=2, J=2, F=POINT, SOLUTIONTIME=0.125\n{POINTS}"
    );
    let block = "variables = X Y \"u x\"\nzone i=2 j=2 datapacking=block\nstrandid=1 solutiontime=1.25D-1\n0 1 0\n1 0 0 1 1\n1 2 3 4\n";
    for text in [point.as_str(), block] {
        let found = read(text).unwrap_or_else(|it| panic!("{text}: {it}"));
        let [only] = &found[..] else { panic!("{found:?}") };
        assert_eq!(only.time.map(|it| it.value), Some(0.125), "{text}");
        assert_eq!(column(only, "X"), [0.0, 1.0, 0.0, 1.0], "{text}");
        assert_eq!(column(only, "u x"), [1.0, 2.0, 3.0, 4.0], "{text}");
        assert_eq!(cells(only), [(9, vec![0, 1, 3, 2])], "{text}");
    }
    assert_eq!(read(&point).unwrap()[0].lines, [6, 7, 8, 9]);
}

#[test]
fn zones_have_cells_times_and_pieces() {
    let zone = |time: &str, from: usize| {
        format!(
            "ZONE N=4, E=2, DATAPACKING=POINT, ZONETYPE=FETRIANGLE{time}\n{POINTS}{from} 2 3\n2 4 3\n"
        )
    };
    let head = "VARIABLES = X Y u\n";
    let found =
        read(&format!("{head}{}{}", zone(", SOLUTIONTIME=1", 1), zone(", SOLUTIONTIME=2", 1)))
            .unwrap();
    assert_eq!(found.len(), 2);
    assert_eq!(cells(&found[1]), [(5, vec![0, 1, 2]), (5, vec![1, 3, 2])]);
    let joined = read(&format!("{head}{}{}", zone("", 1), zone("", 1))).unwrap();
    assert_eq!((joined.len(), joined[0].rows(), joined[0].cells.len()), (1, 8, 4));
    assert_eq!(cells(&joined[0])[2].1, [4, 5, 6]);
    let mut brick = "VARIABLES = X Y Z\nZONE I=2 J=2 K=2\n".to_owned();
    (0..8).for_each(|k| brick += &format!("{} {} {}\n", k % 2, k / 2 % 2, k / 4));
    assert_eq!(cells(&read(&brick).unwrap()[0]), [(12, vec![0, 1, 3, 2, 4, 5, 7, 6])]);
    // Points along a line may be particles.
    let line = read(&format!("{head}ZONE I=4\n{POINTS}")).unwrap();
    assert!(line[0].cells.is_empty() && line[0].rows() == 4);
}

#[test]
fn mistakes_have_their_line_and_what_to_do() {
    let head = "VARIABLES = X Y u\n";
    for (text, said) in [
        (
            format!("{head}ZONE I=2, J=2\n0 0 1\n1 0 2\n"),
            "file:4: the file ends here: was it cut off?",
        ),
        (format!("{head}ZONE I=4\n0 0 one\n"), "file:3: expected a number, found `one`"),
        (
            format!("{head}ZONE T=\"a\"\n{POINTS}"),
            "file:2: a zone that does not say how many points it has, as I=.. or N=..",
        ),
        (
            format!("{head}ZONE N=4 E=1 ET=TRIANGLE\n{POINTS}1 2 9\n"),
            "file:7: expected a point from 1 to 4, found `9`",
        ),
        (
            format!("{head}ZONE N=4 E=1 ZONETYPE=FEPOLYGON\n"),
            "file:2: zones of type `FEPOLYGON` are not read; write one of ORDERED, FETRIANGLE, FEQUADRILATERAL, FETETRAHEDRON, FEBRICK",
        ),
        (format!("{head}ZONE I=1e3\n"), "file:2: `I`: expected a whole number, found `1e3`"),
        (
            format!("{head}ZONE I=2, VARLOCATION=([3]=CELLCENTERED)\n"),
            "file:2: values at the middles of cells are not read from Tecplot; write them at points, or VTK",
        ),
        (format!("ZONE I=4\n{POINTS}"), "file:1: a zone without VARIABLES before it"),
        (format!("VARIABLES = X X u\nZONE I=4\n{POINTS}"), "file:2: two variables are called `X`"),
        ("TITLE = \"t\"\nVARIABLES = X\n".into(), "file: a file of Tecplot without a ZONE"),
        (
            format!("{head}ZONE I=18446744073709551615\n"),
            "file:2: `I`: expected a whole number, found `18446744073709551615`",
        ),
    ] {
        assert_eq!(read(&text).unwrap_err(), said, "{text}");
    }
    // A table with a column of this name is still a table.
    let table = read("zone X u\n1 0.5 2\n").unwrap();
    assert_eq!(column(&table[0], "X"), [0.5]);
}
