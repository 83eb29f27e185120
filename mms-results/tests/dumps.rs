//! Dumps of particles as LAMMPS and Karamelo write them.

use mms_results::names::{KNOWN, Names, everything, recognise};
use mms_results::{Contents, Snapshot, parse};

fn read(text: &str) -> Result<Vec<Snapshot>, String> {
    match parse(text.as_bytes(), &everything(&KNOWN))
        .map_err(|mistake| mistake.of("file").to_string())?
    {
        Contents::Snapshots(found) => Ok(found),
        other => panic!("{other:?}"),
    }
}

/// A block as Karamelo writes it: blanks at the ends of lines, and always step 0.
const KARAMELO: &str = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS sm sm sm\n0 1\n0 1\n0 1\n\
    ITEM: ATOMS id type tag x y z x0 y0 z0 vx vy vz \n1 1 1 0.1 0.2 0 0.1 0.25 0 1 2 0 \n2 1 2 0.3 0.2 0 0.3 0.25 0 3 4 0 \n";

#[test]
fn particles_have_their_names_and_lines() {
    let found = read(KARAMELO).unwrap();
    let [only] = &found[..] else { panic!("{found:?}") };
    assert_eq!(only.time, None, "a step is no time");
    assert_eq!(only.lines, [10, 11]);
    let y0 = only.of_points.iter().find(|it| it.name == "y0").unwrap();
    assert_eq!(y0.values, [0.25, 0.25]);
    let names = Names { map: vec!["X=x0,y0".parse().unwrap()], ..Names::default() };
    assert!(recognise(only, &names, &|_| true).is_ok());
}

#[test]
fn blocks_have_the_times_that_they_say() {
    let block = |time: &str, value: f64| {
        format!(
            "ITEM: UNITS\nsi\nITEM: TIME\n{time}\nITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n\
             0 1 0\n0 1 0\n0 1 0\nITEM: ATOMS id xu yu c_u[1]\n7 0.5 0.5 {value}\n"
        )
    };
    let found = read(&format!("{}{}", block("0.125", 1.0), block("0.25", 2.0))).unwrap();
    let times: Vec<_> = found.iter().map(|it| it.time.map(|it| it.value)).collect();
    assert_eq!(times, [Some(0.125), Some(0.25)]);
    let last = found[1].of_points.iter().find(|it| it.name == "c_u[1]");
    assert_eq!(last.map(|it| it.values.as_slice()), Some(&[2.0][..]));
}

#[test]
fn dumps_that_are_cut_or_odd_are_refused_with_their_line() {
    let cut = KARAMELO.rsplit_once("2 1 2").unwrap().0;
    let early = KARAMELO.replace("ATOMS\n2\n", "ATOMS\n3\n") + KARAMELO;
    for (text, said) in [
        (cut.to_owned(), "file:10: the dump ends after 1 of 2 particles: was it cut off?"),
        (early, "file:12: expected 3 particles before the next `ITEM:`"),
        (
            KARAMELO.replace("1 2 0 ", "1 two 0 "),
            "file:10: column `vy`: expected a number, found `two`",
        ),
        (
            KARAMELO.replace("ATOMS\n2\n", "ATOMS\nmany\n"),
            "file:4: expected how many particles there are, found `many`",
        ),
        ("ITEM: TIMESTEP\n0\n".into(), "file: a dump without `ITEM: ATOMS`: it holds no particles"),
        ("ITEM: TIME\nnoon\n".into(), "file:2: expected a time, found `noon`"),
        (
            "ITEM: ATOMS id x\n1 2\n".into(),
            "file:1: expected `ITEM: NUMBER OF ATOMS` before the particles",
        ),
        ("ITEM: FLAVOUR\n".into(), "file:1: `ITEM: FLAVOUR` is not known"),
    ] {
        assert_eq!(read(&text).unwrap_err(), said);
    }
}
