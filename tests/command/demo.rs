//! `mms demo`: a broken solver whose mistake is named, and the same solver to break elsewhere.

use std::process::Command;

use super::mms::Folder;
use super::sampled::sampled;

/// Lines of the kept solver, the lines that replace them, and the mistakes that result.
const BROKEN: [(&str, &str, &str); 3] = [
    ("= 1e6 * 0.3 / (1.3 * 0.4);", "= 1e6 / (3.0 * 0.4);", "lambda_bulk"),
    ("let y_max = [p[2][0][1], p[2][1][1]];", "let y_max = [0.0, 0.0];", "traction_missing"),
    (
        "let inner = (p[i][0] * g[n][0] + p[i][1] * g[n][1]) / h;",
        "let inner = (p[0][i] * g[n][0] + p[1][i] * g[n][1]) / h;",
        "stress_transposed",
    ),
];

/// The meshes of the demo.
const CELLS: [&str; 3] = ["4", "8", "12"];

#[test]
fn the_broken_line_is_named_and_the_repaired_solver_passes() {
    let run = Folder::new().mms("demo").exits(0);
    run.prints("let x_max = [p[1][0][0], p[1][0][1]];")
        .prints("right   pass: observed order 2.03")
        .prints("broken  fail: observed order 0.31")
        .prints("named: traction_transposed on x_max, P^T N in place of P N, explains 99.4 % of the error")
        .prints("next: mms demo --keep demo");
    assert!(run.stdout.lines().count() <= 25, "{run}");
}

/// The files contain the results judged in memory; another program that is built from them gets the same verdict.
#[test]
fn another_broken_line_of_the_kept_solver_gets_another_name() {
    let folder = Folder::new();
    folder.mms("demo --keep kept").exits(0).prints("sh kept/commands.sh");
    folder.mms("demo --keep kept").exits(2).complains("`--keep kept`: the folder is not empty");
    let files = CELLS.map(|it| format!("kept/broken/{it}.csv")).join(" ");
    folder.mms(&format!("judge sheared_block_2d {files}")).exits(1).prints("observed order 0.31");
    let solver = folder.read("kept/solver.rs");
    let compute = || {
        let rustc = ["--edition", "2021", "-C", "opt-level=1", "kept/main.rs", "-o", "demo"];
        let built = Command::new("rustc").args(rustc).current_dir(folder.path("")).status();
        assert!(built.expect("rustc").success());
        for cells in CELLS {
            let printed = Command::new(folder.path("demo")).arg(cells).output().expect("a run");
            folder.write(&format!("{cells}.csv"), &String::from_utf8_lossy(&printed.stdout));
        }
    };
    let files = CELLS.map(|it| format!("{it}.csv")).join(" ");
    for (right, wrong, name) in sampled(BROKEN, 3) {
        assert_eq!(solver.matches(right).count(), 1, "{right}");
        folder.write("kept/solver.rs", &solver.replace(right, wrong));
        compute();
        folder.mms(&format!("judge sheared_block_2d {files}")).exits(1).prints("fail: observed");
        let run = folder.mms(&format!("diagnose sheared_block_2d {files} --json")).exits(1);
        assert_eq!(run.json()["ranked"][0]["hypothesis"], name, "{wrong}: {run}");
        assert_eq!(run.json()["finding"], "named", "{wrong}: {run}");
    }
    folder.write("kept/solver.rs", &solver);
    compute();
    folder.mms(&format!("judge sheared_block_2d {files}")).exits(0).prints("observed order 2.03");
}
