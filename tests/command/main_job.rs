//! `mms` without arguments: the convergence study of the slides' bar.

use super::mms::Folder;

#[test]
fn the_main_job_shows_second_order_on_stdout_and_progress_on_stderr() {
    let folder = Folder::new();
    let run = folder.mms("").exits(0);
    run.prints("bar_1d: Body force on a 1D bar").prints("cpgimp leapfrog, f64");
    run.prints("pass: observed order 2.00, between 1.96 and 2.03 (l2; 5 levels, 8 cells to 128 cells), expected 2");
    assert!(run.stderr.starts_with("5 runs of 40, 80, 160, 320, 640 time steps\n"), "{run}");
    for cells in ["8", "16", "32", "64", "128"] {
        run.complains(&format!("{cells} cells: "));
        let row = run.stdout.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
        let row = row.filter(|words| words.first() == Some(&cells)).count();
        assert_eq!(row, 1, "one row for {cells} cells: {run}");
    }
    assert!(!run.stdout.contains('\u{1b}'), "colours only on a terminal: {run}");
    for extension in ["svg", "csv", "json"] {
        let written = format!("target/mms/bar_1d/convergence.{extension}");
        run.prints(&written);
        assert!(!folder.read(&written).is_empty(), "{written}");
    }
}
