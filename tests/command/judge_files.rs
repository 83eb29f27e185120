//! `mms judge FIELD FILE..`: files of results as other programs write them. NumPy and VTK wrote the files in `data/`.

use super::mms::{Folder, Run};

const WAVE: &str = "judge travelling_wave_2d --time 0.0158";

/// A file of `data/`.
fn data(name: &str) -> String {
    let path = format!("{}/tests/command/data/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("a file of the tests")
}

fn with(names: &[&str]) -> Folder {
    let folder = Folder::new();
    names.iter().for_each(|name| folder.write(name, &data(name)));
    folder
}

fn passes(run: Run) -> Run {
    let run = run.exits(0);
    run.prints("pass: observed order 2.0");
    run
}

#[test]
fn each_advice_on_names_leads_to_a_verdict() {
    let folder = with(&["moose_4.csv", "moose_8.csv"]);
    let judge = |rest: &str| folder.mms(&format!("{WAVE} moose_4.csv moose_8.csv {rest}"));
    judge("").exits(2).complains("`--map sigma=stress` or `--map P=stress`");
    judge("--map sigma=stress").exits(2).complains("`--map X=x,y` or `--map x=x,y`");
    passes(judge("--map sigma=stress --map X=x,y")).prints("pass: 2 of 2 quantities pass");
    let named =
        "--map sigma=stress_xx,stress_xy,stress_xy,stress_yy --quantity u,sigma --map X=x,y";
    passes(judge(named)).prints("pass: 2 of 2 quantities pass");
}

#[test]
fn four_components_in_the_order_of_voigt_are_asked_for() {
    let folder = with(&["voigt4_4.vtu", "voigt4_8.vtu"]);
    let judge = |rest: &str| {
        let options = "--quantity u,sigma --map X=points";
        folder.mms(&format!("{WAVE} voigt4_4.vtu voigt4_8.vtu {options} {rest}"))
    };
    let order = "--map sigma=sigma:0,sigma:3,sigma:3,sigma:1";
    judge("").exits(2).complains(order);
    judge(order).exits(0).prints("pass: 2 of 2 quantities pass");
}

#[test]
fn moved_points_without_u_are_asked_for_and_found_by_the_inverse_motion() {
    let folder = with(&["moved_4.csv", "moved_8.csv"]);
    let judge = |rest: &str| {
        folder.mms(&format!("judge axis_aligned_2d moved_4.csv moved_8.csv --time 0.02 {rest}"))
    };
    judge("").exits(2).complains("`--map X=x,y` or `--map x=x,y`");
    let run = passes(judge("--map x=x,y"));
    run.prints("X: X computed from x by the inverse of the exact motion");
    // x was used to find X, and is not judged.
    assert!(!run.stdout.contains("displacement\n"), "{run}");
    judge("--map x=x,y --quantity x").exits(2).complains("no position that can be judged");
    judge("--map x=x,y --quantity v,u").exits(2).complains("no displacement that can be judged");
}

#[test]
fn numbers_that_are_missing_or_contradict_each_other_are_no_pass() {
    let folder = Folder::new();
    let points = |count: usize| (0..count).map(move |at| (at as f64 + 0.5) / count as f64);
    let write = |name: &str, count: usize, row: &dyn Fn(usize, f64) -> String| {
        let rows: String = points(count).enumerate().map(|(at, x)| row(at, x)).collect();
        folder.write(name, &format!("X,u,x,v\n{rows}"));
    };
    write("first.csv", 8, &|at, x| format!("{x},{},{x},0\n", if at == 0 { "N/A" } else { "0.05" }));
    let judge = |name: &str| folder.mms(&format!("judge bar_1d {name} --time 0.01"));
    let said = "first.csv:2: column `u`: expected a number, found `N/A`";
    judge("first.csv").exits(2).complains(said);
    write("x.csv", 8, &|_, x| format!("{x},0.125,{},0\n", x + 0.0625));
    judge("x.csv").exits(2).complains("x.csv:2: x = [0.125] contradicts X + u = [0.1875]");
    write("nan.csv", 8, &|at, x| format!("{x},{},{x},0\n", if at == 3 { "nan" } else { "0" }));
    let same = folder.mms("judge --same nan.csv nan.csv").exits(1);
    same.prints("nan.csv:5").prints("not finite");
    write("word.csv", 8, &|at, x| format!("{x},{},{x},0\n", if at == 3 { "-" } else { "0" }));
    folder.write("label.csv", "X,u,material\n0.5,1,steel\n");
    let same = folder.mms("judge --same label.csv label.csv --json").exits(0).json();
    assert_eq!(same["words"], serde_json::json!(["material"]));
    folder.mms("judge --same word.csv word.csv").exits(2).complains("word.csv:5: column `u`");
}

#[test]
fn a_mesh_that_ends_before_the_others_is_no_evidence() {
    let folder = Folder::new();
    let write = |name: &str, times: &[f64]| {
        let rows = times
            .iter()
            .flat_map(|t| (0..8).map(move |at| format!("{t},{},0\n", (f64::from(at) + 0.5) / 8.0)));
        folder.write(name, &format!("t,X,u\n{}", rows.collect::<String>()));
    };
    write("a.csv", &[0.01, 0.02, 0.03]);
    write("b.csv", &[0.01, 0.02]);
    write("c.csv", &[0.01, 0.026]);
    let judge = |rest: &str| folder.mms(&format!("judge bar_1d {rest} --h 2,1"));
    let said =
        "`b.csv`: its results end at t = 0.02, and those of `a.csv` at t = 0.03: did the run stop?";
    judge("a.csv b.csv").exits(2).complains(said);
    judge("b.csv a.csv").exits(2).complains(said);
    judge("a.csv b.csv --time 0.01,0.02").exits(1).prints("at 2 times");
    // Its next time would be beyond the last one of the other.
    judge("a.csv c.csv").exits(1).prints("at t = 0.01");
}

#[test]
fn indices_comments_and_moduli_are_passed_over() {
    let folder = with(&["moose_4.csv", "moose_8.csv"]);
    for cells in [4, 8] {
        let text = folder.read(&format!("moose_{cells}.csv"));
        let rows = text.lines().skip(1).enumerate().map(|(at, line)| {
            let all: Vec<&str> = line.split(',').collect();
            format!("{at},{},{},{},{},1e6\n", all[7], all[8], all[0], all[1])
        });
        let rows: String = rows.collect();
        folder.write(&format!("{cells}.csv"), &format!("# of run 3\n# ,X,Y,ux,uy,E\n{rows}"));
    }
    let run = passes(folder.mms(&format!("{WAVE} 4.csv 8.csv")));
    run.prints("found and not judged: E (one number, and no green_lagrange)");
    folder.mms(&format!("{WAVE} 4.csv 8.csv --quantity E")).exits(2).complains("`E`, read as");
}

#[test]
fn files_that_take_more_memory_than_they_may_are_refused_before_they_are_read() {
    let folder = with(&["moose_8.csv"]);
    let judge = |most: &str| {
        folder.mms(&format!("{WAVE} moose_8.csv --map X=x,y --quantity u --max-memory {most}"))
    };
    judge("0")
        .exits(2)
        .complains("moose_8.csv: cannot read it: it has 1 MB, and there are 0 MB of memory");
    // One mesh gives no order.
    judge("100").exits(1).prints("norms of u");
}

#[test]
fn columns_without_a_header_are_named_by_an_option() {
    let folder = Folder::new();
    let state = "state travelling_wave_2d --cells 4 --time 0.01 --quantity u -o u.csv";
    folder.mms(state).exits(0);
    let text = folder.read("u.csv");
    let rows: String = text.lines().skip(1).map(|line| line.replace(',', "\t") + "\n").collect();
    let names = text.lines().next().expect("a header");
    folder.write("bare.dat", &rows);
    let judge = |rest: &str| folder.mms(&format!("judge travelling_wave_2d bare.dat {rest}"));
    judge("").exits(2).complains("`--columns X,u,..`");
    judge(&format!("--columns {names}")).exits(0).prints("exact to round-off");
    let diagnose = format!("diagnose travelling_wave_2d bare.dat --columns {names}");
    folder.mms(&diagnose).exits(0).prints("nothing");
}

/// Exact states at the nodes of a grid, in the formats of Tecplot and LAMMPS.
#[test]
fn tecplot_and_dumps_are_judged_as_tables_are() {
    let folder = Folder::new();
    let nodes: String = (0..81)
        .map(|at| format!("{},{}\n", (at % 9) as f64 / 8.0, (at / 9) as f64 / 8.0))
        .collect();
    folder.write("nodes.csv", &format!("X,Y\n{nodes}"));
    let state = "state travelling_wave_2d --points nodes.csv --time 0.01 --quantity u -o exact.csv";
    folder.mms(state).exits(0);
    let text = folder.read("exact.csv");
    let (header, rows) = text.split_once('\n').expect("rows");
    let keep = |line: &str| {
        let names = header.split(',').zip(line.split(','));
        let own = names.filter(|(name, _)| ["X", "Y", "u_x", "u_y"].contains(name));
        own.map(|(_, value)| value).collect::<Vec<_>>().join(" ") + "\n"
    };
    let rows: String = rows.lines().map(keep).collect();
    let zone = "VARIABLES = X, Y, u_x, u_y\nZONE I=9, J=9, SOLUTIONTIME=0.01";
    folder.write("state.dat", &format!("{zone}\n{rows}"));
    // Between nodes values are interpolated.
    let cells = folder.mms("judge travelling_wave_2d state.dat").exits(1);
    cells.prints("`state.dat` of 64 cells").prints("since the mesh is known");
    let points = zone.replace("I=9, J=9", "I=81");
    folder.write("points.dat", &format!("{points}\n{rows}"));
    folder.mms("judge travelling_wave_2d points.dat").exits(0).prints("exact to round-off");
    let numbered: String =
        rows.lines().enumerate().map(|(at, row)| format!("{} 1 {row}\n", at + 1)).collect();
    let sizes = "ITEM: NUMBER OF ATOMS\n81\nITEM: BOX BOUNDS sm sm sm\n0 1\n0 1\n0 1";
    let dump = format!("ITEM: TIMESTEP\n0\n{sizes}\nITEM: ATOMS id type X Y u_x u_y\n{numbered}");
    folder.write("state.dump", &dump);
    folder.mms("judge travelling_wave_2d state.dump").exits(2).complains("`--time T,..`");
    folder
        .mms("judge travelling_wave_2d state.dump --time 0.01")
        .exits(0)
        .prints("exact to round-off");
}
