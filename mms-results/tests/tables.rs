//! Tables as programs write them: indices, comments, columns of words, and columns that depend on each other.

use mms_results::motion::{Motion, resolve};
use mms_results::names::{KNOWN, Names, Role, everything, recognise, wanted};
use mms_results::wanted::Wanted;
use mms_results::{Contents, Mistake, Snapshot, parse};

/// The one snapshot of a table, or a mistake with its line.
fn read(text: &str, wanted: &Wanted<'_>) -> Result<Snapshot, String> {
    match parse(text.as_bytes(), wanted).map_err(|mistake| mistake.of("file").to_string())? {
        Contents::Snapshots(mut found) => Ok(Snapshot { path: "file".into(), ..found.remove(0) }),
        other => panic!("{other:?}"),
    }
}

fn maps(map: &[&str]) -> Names {
    let map = map.iter().map(|it| it.parse().unwrap()).collect();
    Names { map, ..Names::default() }
}

fn names(snapshot: &Snapshot) -> Vec<&str> {
    snapshot.of_points.iter().map(|array| array.name.as_str()).collect()
}

#[test]
fn indices_and_comments_of_programs_are_passed_over() {
    let rows = "0.25,0.5,1,2\n0.75,0.5,3,4\n";
    let indexed = "0,0.25,0.5,1,2\n1,0.75,0.5,3,4\n";
    let blanks = rows.replace(',', "   ");
    for text in [
        format!("X,Y,ux,uy\n{rows}"),
        format!(",X,Y,ux,uy\n{indexed}"),
        format!("\"\",\"X\",\"Y\",\"ux\",\"uy\"\n{indexed}"),
        format!("\tX\tY\tux\tuy\n{}", indexed.replace(',', "\t")),
        format!(";X;Y;ux;uy\n{}", indexed.replace(',', ";")),
        format!("# run 3, of today\n\n# X,Y,ux,uy\n{rows}"),
        format!("# run 3\nX,Y,ux,uy\n# half\n{rows}"),
        format!("% run\n% X  Y  ux  uy\n{blanks}"),
        format!("#,X,Y,ux,uy\n{rows}"),
        format!("#,X,Y,ux,uy\n{indexed}"),
        format!("  X   Y  ux uy\n  {blanks}"),
        format!("** job 3\n// of today\n! X Y ux uy\n{blanks}"),
        format!("X,Y,ux,uy,\n{}", rows.replace('\n', ",\n")),
        format!("Index,Material,X,Y,ux,uy\n{}", indexed.replace(",0.", ",steel,0.")),
    ] {
        let text = text.replace("steel,0.5", "0.5");
        let snapshot =
            read(&text, &wanted(&KNOWN, &|_| true)).unwrap_or_else(|it| panic!("{text}: {it}"));
        assert_eq!(names(&snapshot), ["X", "Y", "ux", "uy"], "{text}");
        assert_eq!(snapshot.of_points[0].values, [0.25, 0.75], "{text}");
        assert_eq!(snapshot.of_points[3].values, [2.0, 4.0], "{text}");
        let line = text.lines().position(|line| line.contains("0.75")).unwrap() + 1;
        assert_eq!(snapshot.lines[1], line, "{text}");
    }
}

#[test]
fn numbers_are_read_as_programs_write_them() {
    let right = "X Y ux uy\n0.25 -0.5e-3 1 2\n0.75 -0.5e-3 3e-101 4\n";
    let expected = read(right, &everything(&KNOWN)).unwrap();
    let values =
        |it: &Snapshot| it.of_points.iter().map(|it| it.values.clone()).collect::<Vec<_>>();
    for text in [
        right.replace('e', "D"),
        right.replace("e-3", "E-003"),
        right.replace("e-101", "-101").replace("3-101", "3.-101"),
        right.replace(' ', ";").replace('.', ","),
        right.replace(' ', "\t").replace('.', ","),
        format!("# {}", right.replace('.', ",")),
        right.replace("\n0", "\n0 0").replace("0 0.75", "1 0.75"),
        right.replace("\n0", "\n7 0").replace("7 0.75", "8 0.75"),
        right.replace("uy\n", "uy\r\n").replace(" 2\n", " 2\r\n"),
        right.replace("0.75", "X Y ux uy\n0.75"),
    ] {
        let found = read(&text, &everything(&KNOWN)).unwrap_or_else(|it| panic!("{text}: {it}"));
        assert_eq!(values(&found), values(&expected), "{text}");
    }
    for (text, said) in [
        (
            "X;u\n0,5;1\n0.5;1\n",
            "file:3: numbers have a decimal point in line 3 and a comma in line 2: expected one of the two",
        ),
        (
            "X u\n0 0.5 1\n2 0.5 1\n",
            "file:3: the first column has no name, and `2` where it would count the point 1: expected a name for each column",
        ),
        (
            "X u\n0.5 0.5 1\n",
            "file:2: 3 columns, and 2 names in the header; separate columns by one comma, tab or semicolon, or by blanks",
        ),
        ("X;u\n1,000,5;1\n", "file:2: column `X`: expected a number, found `1,000,5`"),
    ] {
        assert_eq!(read(text, &everything(&KNOWN)).unwrap_err(), said);
    }
}

#[test]
fn texts_in_utf_16_are_read() {
    let text = "\u{feff}X,u\n0.5,1\n";
    let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
    for bytes in [&little, &big] {
        match parse(bytes, &everything(&KNOWN)).unwrap() {
            Contents::Snapshots(found) => assert_eq!(found[0].of_points[1].values, [1.0]),
            other => panic!("{other:?}"),
        }
        let cut = parse(&bytes[..bytes.len() - 1], &everything(&KNOWN)).unwrap_err();
        assert!(cut.what.contains("neither text in UTF-8 nor"), "{cut}");
    }
    assert!(parse(b"\xff\xfe\0\0x\0\0\0", &everything(&KNOWN)).is_err());
}

#[test]
fn columns_may_be_named_beside_the_file() {
    let columns = ["X", "u"].map(String::from);
    let named = Names { columns: columns.to_vec(), ..Names::default() };
    let wanted = || everything(&named);
    for text in
        ["0.5 1\n0.75 2\n", "0.5,1\n0.75,2\n", "a b\n0.5 1\n0.75 2\n", "# a b\n0.5 1\n0.75 2\n"]
    {
        let found = read(text, &wanted()).unwrap_or_else(|it| panic!("{text}: {it}"));
        assert_eq!(names(&found), ["X", "u"], "{text}");
        assert_eq!(found.of_points[0].values, [0.5, 0.75], "{text}");
    }
    let more = read("0.5 1 2\n", &wanted()).unwrap_err();
    assert!(more.contains("3 columns, and 2 names in `--columns`"), "{more}");
    let twice = Names { columns: vec!["X".into(), "X".into()], ..Names::default() };
    let twice = read("0.5 1\n", &everything(&twice)).unwrap_err();
    assert_eq!(twice, "file: `--columns`: two columns are called `X`");
    let none = read("0.5 1\n", &everything(&KNOWN)).unwrap_err();
    assert!(none.contains("`--columns X,u,..`"), "{none}");
}

#[test]
fn comments_tell_the_times_of_blocks() {
    let times = |text: &str| -> Result<Vec<(Option<f64>, usize)>, String> {
        match parse(text.as_bytes(), &everything(&KNOWN)).map_err(|it| it.to_string())? {
            Contents::Snapshots(all) => {
                Ok(all.iter().map(|it| (it.time.map(|it| it.value), it.rows())).collect())
            }
            other => panic!("{other:?}"),
        }
    };
    let blocks = "# time = 0.1\n# X u\n0 1\n1 2\n\n# time = 0.2\n0 3\n1 4\n";
    assert_eq!(times(blocks), Ok(vec![(Some(0.1), 2), (Some(0.2), 2)]));
    let repeated = "X u\n% step 5, t: 1.0D-1 s\n0 1\n% step 6, t: 2.0D-1 s\nX u\n0 3\n";
    assert_eq!(times(repeated), Ok(vec![(Some(0.1), 1), (Some(0.2), 1)]));
    for other in
        ["# CPU time = 3.5 s", "# time: 12:30:05", "# time", "# Time 2026-11-29", "# t X u"]
    {
        assert_eq!(times(&format!("{other}\nX u\n0 1\n")), Ok(vec![(None, 1)]), "{other}");
    }
    // A column decides.
    assert_eq!(times("# time = 7\nt X u\n1 0 1\n"), Ok(vec![(Some(1.0), 1)]));
    // Lines without a mark that say a time are no rows either.
    for line in ["TIME 0.25", "time = 0.25", "Time: 2.5e-1 s", "t = 0.25"] {
        assert_eq!(times(&format!("{line}\nX u\n0 1\n")), Ok(vec![(Some(0.25), 1)]), "{line}");
        let later = format!("# time = 0.1\nX u\n0 1\n{line}\n0 1\n1 2\n");
        assert_eq!(times(&later), Ok(vec![(Some(0.1), 1), (Some(0.25), 2)]), "{line}");
    }
    assert_eq!(times("time u\n0.5 1\n"), Ok(vec![(Some(0.5), 1)]));
    let late = times("X u\n0 1\n# time = 1\n0 1\n").unwrap_err();
    assert!(late.contains("points before the first line that says"), "{late}");
}

#[test]
fn no_column_of_a_known_name_vanishes() {
    let u_alone = |role: Role| role == Role::Displacement;
    for (text, said) in [
        ("X,u,v\n0,N/A,1\n1,2,3\n", "file:2: column `u`: expected a number, found `N/A`"),
        ("X,u,v\n0,,1\n1,2,3\n", "file:2: column `u`: expected a number, found nothing"),
        ("X,u,v\n0,1,1\n1,-,3\n", "file:3: column `u`: expected a number, found `-`"),
        ("X,u,v\n0,--,1\n1,--,3\n", "file:2: column `u`: expected a number, found `--`"),
        // The column is not requested, but it contains numbers, and its name is known.
        ("X,u,v\n0,1,n/a\n1,2,3\n", "file:2: column `v`: expected a number, found `n/a`"),
        ("X,u,sigma_xx\n0,1,5\n1,2,*\n", "file:3: column `sigma_xx`: expected a number, found `*`"),
        ("t,X,u\n0,0,1\nnow,0,1\n", "file:3: column `t`: expected a number, found `now`"),
    ] {
        assert_eq!(read(text, &wanted(&KNOWN, &u_alone)).unwrap_err(), said);
    }
    let map = maps(&["u=shift"]);
    let of_map = read("X,shift\n0,1\n1,?\n", &wanted(&map, &|_| false)).unwrap_err();
    assert_eq!(of_map, "file:3: column `shift`: expected a number, found `?`");
    // Columns of words are skipped unless requested, and so are columns with unknown names.
    let rest = "X,u,v,name\n0,1,left,a\n1,2,right,7\n";
    let read_of = |wanted: &Wanted<'_>| read(rest, wanted).map(|it| (names(&it).len(), it.unread));
    assert_eq!(
        read_of(&wanted(&KNOWN, &u_alone)),
        Ok((1, vec!["name".into(), "X".into(), "v".into()]))
    );
    assert!(read_of(&everything(&KNOWN)).unwrap_err().contains("column `v`"));
}

#[test]
fn a_table_that_ends_within_a_time_is_refused() {
    let row = |time: usize, point: usize| format!("{time},{point},0\n");
    let whole: String = (0..3).flat_map(|time| (0..4).map(move |point| row(time, point))).collect();
    let text = format!("t,X,u\n{whole}");
    assert!(read(&text, &everything(&KNOWN)).is_ok());
    for cut in [1, 3] {
        let lines: Vec<&str> = text.lines().collect();
        let said = read(&lines[..lines.len() - cut].join("\n"), &everything(&KNOWN)).unwrap_err();
        let expected = format!("file:{}: the table ends after {} points", 13 - cut, 4 - cut);
        assert!(said.starts_with(&expected), "{said}");
    }
    // Particles that leave do not return.
    let fewer = "t,X,u\n0,0,0\n0,1,0\n0,2,0\n1,0,0\n1,1,0\n2,0,0\n";
    assert!(read(fewer, &everything(&KNOWN)).is_ok());
}

fn found<'a>(
    snapshot: &'a Snapshot,
    map: &[&str],
    back: Option<mms_results::motion::Back<'_>>,
) -> Result<Motion<'a>, Mistake> {
    let meanings = recognise(snapshot, &maps(map), &|_| true)?;
    let outside =
        |point: &[f64]| point.iter().fold(0.0, |most, x| f64::max(most, (x - 1.0).max(-x)));
    resolve(snapshot, &meanings, 2, &outside, back)
}

#[test]
fn an_x_that_contradicts_u_is_refused_by_its_line() {
    let header = "X,Y,current_position_x,current_position_y,ux,uy,digits";
    let text = |x: &str| {
        format!("{header}\n0,0,0.1,0,0.1,0,0.12345678901234567\n0.5,0.5,{x},0.25,-0.25,0\n")
    };
    let motion = |text: &str| {
        let snapshot = read(text, &everything(&KNOWN)).unwrap();
        found(&snapshot, &[], None).map(|it| it.how).map_err(|it| it.to_string())
    };
    assert_eq!(motion(&text("0.75,0.25")), Ok("X as given".into()));
    let said = motion(&text("0.75,0.2501")).unwrap_err();
    assert!(
        said.starts_with("file:3: x = [0.75, 0.2501] contradicts X + u = [0.75, 0.25]"),
        "{said}"
    );
    // Points are X or x, and x is no X.
    let points = |x: &str| text(x).replace("current_position_x,current_position_y", "pos_x,pos_y");
    assert!(motion(&points("0.75,0.25")).is_ok());
    assert!(motion(&points("0.75,0.75")).unwrap_err().starts_with("file:3: x = [0.75, 0.75]"));
    let still =
        |names: &str| format!("X,Y,{names},ux,uy\n0,0,0,0,0,0\n0.5,0.5,0.5,0.5,0.25,-0.25\n");
    assert!(motion(&still("pos_x,pos_y")).is_ok());
    assert!(motion(&still("x,y")).unwrap_err().starts_with("file:3: x = [0.5, 0.5] contradicts"));
}

#[test]
fn x_without_u_is_x_by_the_inverse_motion_or_asked() {
    // x = X/2.
    let mut back = |x: &[f64], _: f64| {
        let reference: Vec<f64> = x.iter().map(|x| 2.0 * x).collect();
        Ok(reference.iter().all(|it| (0.0..=1.0).contains(it)).then_some(reference))
    };
    let snapshot = |text: &str| read(text, &everything(&KNOWN)).unwrap();
    let both = snapshot("x,y,vx,vy\n0.25,0.125,0,0\n0.5,0.25,0,0\n");
    let asked = found(&both, &[], Some(&mut back)).unwrap_err().what;
    assert!(asked.contains("`--map X=x,y` or `--map x=x,y`"), "{asked}");
    let motion = found(&both, &["x=x,y"], Some(&mut back)).unwrap();
    assert_eq!(*motion.reference.numbers, [0.5, 0.25, 1.0, 0.5]);
    assert!(motion.displacement.is_none() && motion.how.contains("inverse"));
    let motion = found(&both, &["X=x,y"], Some(&mut back)).unwrap();
    assert_eq!(*motion.reference.numbers, [0.25, 0.125, 0.5, 0.25]);
    // No point of the body is at x = 0.75.
    let fixed = snapshot("x,y,vx,vy\n0.25,0.125,0,0\n0.75,0.25,0,0\n");
    let motion = found(&fixed, &[], Some(&mut back)).unwrap();
    assert!(motion.how.starts_with("points taken as X, since some"), "{}", motion.how);
    let said = found(&fixed, &["x=x,y"], Some(&mut back)).unwrap_err().to_string();
    assert!(said.starts_with("file:3: x = [0.75, 0.25]: no point of the body is there"), "{said}");
}

#[test]
fn advice_on_names_leads_to_what_it_says() {
    let text = "disp_x,disp_y,id,stress_xx,stress_xy,stress_yy,stress_zz,x,y,z\n0,0,7,1,2,3,4,0.5,0.25,0\n";
    let snapshot = read(text, &everything(&KNOWN)).unwrap();
    let asked = |map: &[&str]| found(&snapshot, map, None).map(|_| ()).unwrap_err().what;
    assert!(asked(&[]).contains("`--map sigma=stress` or `--map P=stress`"));
    for sigma in ["sigma=stress", "sigma=stress_xx,stress_xy,stress_xy,stress_yy"] {
        let map = maps(&[sigma, "X=x,y"]);
        let meanings = recognise(&snapshot, &map, &|_| true).unwrap();
        let stress = meanings.iter().find(|it| it.role == Role::CauchyStress).unwrap();
        assert_eq!(*stress.values(&snapshot, 2).unwrap().numbers, [1.0, 2.0, 2.0, 3.0]);
        assert!(found(&snapshot, &[sigma, "X=x,y"], None).is_ok());
    }
    // The rest of a group is no other quantity; a column with the group's name alone is.
    let rest = read("X,Y,u,u_1\n0,0,1,2\n", &everything(&KNOWN)).unwrap();
    let of_rest = recognise(&rest, &maps(&["W=u_1"]), &|_| true).unwrap();
    assert!(of_rest.iter().any(|it| it.role == Role::Displacement));
    let twice = read("X,Y,ux,u_x,uy\n0,0,0,0,0\n", &everything(&KNOWN)).unwrap();
    assert!(found(&twice, &[], None).unwrap_err().what.contains("both `u` and `u_x`"));
    let many: String = (0..1000).map(|at| format!(",n{at}")).collect();
    let row = ",0".repeat(1000);
    let wide = read(&format!("X{many}\n0{row}\n"), &wanted(&KNOWN, &|_| true)).unwrap();
    let said = found(&wide, &["u=w"], None).unwrap_err().what;
    assert!(said.ends_with("`n28` and 971 others"), "{said}");
}

#[test]
fn four_components_of_a_symmetric_tensor_are_asked_for_unless_they_are_rows() {
    let read_as = |numbers: &str, map: &[&str]| {
        let text = format!("sigma:0,sigma:1,sigma:2,sigma:3\n{numbers}\n");
        let snapshot = read(&text, &everything(&KNOWN)).unwrap();
        let meanings = recognise(&snapshot, &maps(map), &|_| true).unwrap();
        meanings[0].values(&snapshot, 2).map(|it| it.numbers.to_vec()).map_err(|it| it.what)
    };
    assert_eq!(read_as("1,2,2,3", &[]), Ok(vec![1.0, 2.0, 2.0, 3.0]));
    // 12 differs from 21; and 11, 22 = 33 without shear is likelier than a stress 22 that is 0 everywhere.
    for numbers in ["1,2,3,4", "5,2,2,0"] {
        let said = read_as(numbers, &[]).unwrap_err();
        assert!(said.contains("`--map sigma=sigma:0,sigma:3,sigma:3,sigma:1`"), "{said}");
    }
    let voigt = read_as("1,2,3,4", &["sigma=sigma:0,sigma:3,sigma:3,sigma:1"]);
    assert_eq!(voigt, Ok(vec![1.0, 4.0, 4.0, 2.0]));
    for (names, order) in [("s_0,s_1,s_2", "s_0,s_2,s_2,s_1"), ("s1,s2,s3,s4,s5,s6", "s1,s4,s4,s2")]
    {
        let text = format!("{names}\n{}\n", ["1"].repeat(names.split(',').count()).join(","));
        let snapshot = read(&text.replace('s', "sig"), &everything(&KNOWN)).unwrap();
        let meanings = recognise(&snapshot, &KNOWN, &|_| true).unwrap();
        let said = meanings[0].values(&snapshot, 2).unwrap_err().what;
        let option = format!("say `--map sigma={}`;", order.replace('s', "sig"));
        assert!(said.contains(&option), "{said}");
    }
    let rows = read_as("1,2,3,4", &["sigma=sigma:0,sigma:1,sigma:2,sigma:3"]);
    assert_eq!(rows, Ok(vec![1.0, 2.0, 3.0, 4.0]));
}

/// The time and memory for wide headers and rows grow linearly: otherwise these would take minutes.
#[test]
fn wide_tables_are_read_in_linear_time() {
    let names: String = (0..100_000).map(|at| format!("n{at},")).collect();
    let text = format!("{names}X\n{}1\n", "0,".repeat(100_000));
    assert_eq!(names_of(&text, &everything(&KNOWN)), 100_001);
    let commas = ",".repeat(4 << 20);
    let said = read(&format!("X,u\n{commas}\n"), &everything(&KNOWN)).unwrap_err();
    assert!(said.starts_with("file:2: 4194305 columns, and 2 names in the header"), "{said}");
    let said = read(&format!("{commas}\n0\n"), &everything(&KNOWN)).unwrap_err();
    assert!(said.contains("4194305 columns; expected 1000000 at most"), "{said}");
}

fn names_of(text: &str, wanted: &Wanted<'_>) -> usize {
    names(&read(text, wanted).unwrap()).len()
}

#[test]
fn one_number_called_e_is_no_strain_of_a_plane() {
    let other = |text: &str, map: &[&str], dimension: usize| {
        let snapshot = read(text, &everything(&KNOWN)).unwrap();
        let meanings = recognise(&snapshot, &maps(map), &|_| true).unwrap();
        let found = meanings.iter().find(|it| it.role == Role::GreenLagrange).unwrap();
        found.mismatch(&snapshot, dimension, None).is_some()
    };
    assert!(other("X,Y,E\n0,0,1\n", &[], 2));
    assert!(!other("X,Y,E\n0,0,1\n", &["E=E"], 2));
    assert!(!other("X,E\n0,0.25\n", &[], 1));
    assert!(other("X,E\n0,2e5\n", &[], 1));
    assert!(!other("X,Y,E11,E12,E21,E22\n0,0,1,1,1,1\n", &[], 2));
}
