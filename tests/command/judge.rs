//! `mms judge --errors`: tables of errors with a known law, and tables without one.

use super::mms::{Folder, Run, keys};

/// Judges a table.
fn judge(table: &str, options: &str) -> Run {
    let folder = Folder::new();
    folder.write("errors.csv", table);
    folder.mms(&format!("judge --errors errors.csv {options}"))
}

/// A table of h = 1/8, 1/16, .. with errors that a law computes from 8 h.
fn table(header: &str, levels: i32, law: impl Fn(f64) -> Vec<f64>) -> String {
    let row = |k: i32| {
        let x = 0.5f64.powi(k);
        let errors: Vec<_> = law(x).iter().map(|e| format!("{e:.12e}")).collect();
        format!("{},{}\n", x / 8.0, errors.join(","))
    };
    format!("h,{header}\n") + &(0..levels).map(row).collect::<String>()
}

#[test]
fn the_exit_code_is_the_verdict() {
    let of = |law: fn(f64) -> f64| table("l2", 4, |x| vec![law(x)]);
    judge(&of(|x| x * x), "").exits(0).prints("pass: observed order 2.00, between 1.96 and 2.04");
    judge(&of(|x| x), "").exits(1).prints("fail: observed order 1.00, between 0.96 and 1.04");
    judge(&of(|x| x), "--expected-order 1").exits(0).prints("pass");
    let higher = judge(&of(|x| x * x * x), "").exits(1);
    higher.prints("not asymptotic: observed order 3.00").prints("changes its sign");
    judge(&of(|x| x.powf(1.9)), "--tolerance 1").exits(0);
    let two = judge(&table("l2", 2, |x| vec![x * x]), "").exits(0);
    two.prints("pass: observed order 2.00").prints("two levels cannot show");
}

/// The finest pair is within 0.15 of 2, and yet of first order in the limit.
#[test]
fn a_hidden_lower_order_does_not_pass() {
    let hidden = table("l2", 4, |x| vec![0.81 * 64.0 * x * x + 0.19 * 8.0 * x]);
    let run = judge(&hidden, "").exits(1);
    run.prints("a hidden error of order 1, 19.0 % of the finest error");
    run.prints("it takes over below h 3.665e-3");
    let plateau = table("l2", 4, |x| vec![0.8 * 64.0 * x * x + 0.2]);
    judge(&plateau, "").exits(1).prints("fail").prints("a plateau, 20.0 % of the finest error");
    let small = table("l2", 4, |x| vec![0.95 * 64.0 * x * x + 0.05 * 8.0 * x]);
    let run = judge(&small, "").exits(0);
    run.prints("a hidden error of order 1, 5.0 % of the finest error");
    run.prints("an error of order 1 that makes up less than 9 % at h 1.562e-2 is not excluded");
    judge(&small, "--tolerance 0.05").exits(1);
}

/// Columns that are not errors, as in tables of other codes, and errors with two digits.
#[test]
fn tables_of_other_codes_are_judged_by_their_errors() {
    let rates = "h,L2,L2 rate,H1,H1 rate\n0.1,1.2e-3,,3e-2,\n0.05,3e-4,2.0,1.5e-2,1.0\n0.025,7.5e-5,2.0,7.5e-3,1.0\n";
    let run = judge(rates, "").exits(0);
    run.prints("left out, because their names denote no errors: `L2 rate`, `H1 rate`");
    let times = "level,h,L2,CPU [s]\n1,0.1,1.2e-3,1.2\n2,0.05,3e-4,3.4\n3,0.025,7.5e-5,14\n";
    judge(times, "").exits(0).prints("pass: observed order 2.00");
    let index = ",h,L2\n0,0.1,1.2e-3\n1,0.05,3e-4\n2,0.025,7.5e-5\n";
    judge(index, "").exits(0).prints("pass: observed order 2.00");
    let close = judge("h,L2\n0.1,1.00e-3\n0.099,9.8e-4\n", "").exits(1);
    close.prints("not asymptotic: observed order 2.01, between 1.01 and 3.02");
    close.prints("the errors have too few digits to determine the order");
    for stopped in ["nan", "inf", ""] {
        let table = format!("h,L2\n0.1,1.2e-3\n0.05,3e-4\n0.025,{stopped}\n");
        judge(&table, "").exits(1).prints("fail: ").prints("a run stopped");
    }
    let one = judge("h,L2\n0.1,0\n", "").exits(1);
    one.prints("two levels above round-off are needed");
}

#[test]
fn a_layer_is_told_by_the_orders_of_the_norms() {
    let layer = table("mean,rms,max", 4, |x| vec![x * x, x.powf(1.5), x]);
    let run = judge(&layer, "").exits(1);
    run.prints("fail: observed order 1.50").prints("(l2; 4 levels, h 1.250e-1 to h 1.562e-2)");
    run.prints("a layer at a face where the order is 1.0");
}

#[test]
fn the_document_has_the_keys_of_a_study_and_its_own() {
    let norms = table("l1,l2,linf", 4, |x| vec![x * x, 2.0 * x * x, 3.0 * x * x]);
    let document = judge(&norms, "--json").exits(0).json();
    let expected = [
        "source",
        "refinement",
        "levels",
        "quantity",
        "norm",
        "expected_order",
        "tolerance",
        "observed_order",
        "order_interval",
        "quantities",
        "verdict",
        "rule",
        "notes",
        "provenance",
    ];
    assert_eq!(keys(&document), expected);
    let level = &document["levels"][3];
    let norms = ["l1", "l2", "linf", "order_l1", "order_l2", "order_linf"];
    assert_eq!(keys(level), [&["cell_size", "time_step", "runs"][..], &norms].concat());
    assert_eq!(level["cell_size"], 1.0 / 64.0);
    assert!(level["time_step"].is_null() && document["levels"][0]["order_l2"].is_null());
    for key in &norms[3..] {
        assert!(level[key].as_f64().is_some_and(|it| (it - 2.0).abs() < 1e-9), "{level:#}");
    }
    assert_eq!((&document["source"], &document["norm"]), (&"errors.csv".into(), &"l2".into()));
    assert_eq!((&document["verdict"], &document["refinement"]), (&"pass".into(), &"space".into()));
    let judged = &document["quantities"][0];
    assert_eq!(judged["norms"].as_array().map(Vec::len), Some(3));
    assert_eq!(judged["norms"][2]["interval_from"], "scatter");
    assert_eq!(document["provenance"]["kind"], "judge");
}

/// The worst of several quantities decides; each may have an order of its own, and H1 has one less.
#[test]
fn quantities_are_judged_each_by_itself() {
    let law = |x: f64| vec![x * x, x, x, x.sqrt()];
    let several = table("u_l2,u_H1,v_l2,\"far away\"", 4, law);
    let document = judge(&several, "--json").exits(1).json();
    let seen = |at: usize| {
        let judged = &document["quantities"][at];
        let text = |key: &str| judged[key].as_str().unwrap_or_default().to_owned();
        (text("name"), text("norm"), text("verdict"))
    };
    let named = |name: &str, norm: &str, verdict: &str| (name.into(), norm.into(), verdict.into());
    assert_eq!(seen(0), named("u", "l2", "pass"));
    assert_eq!(seen(1), named("v", "l2", "fail"));
    assert_eq!(seen(2), named("far away", "far away", "fail"));
    assert_eq!((&document["quantity"], &document["verdict"]), (&"v".into(), &"fail".into()));
    judge(&several, "").exits(1).prints("fail: 1 of 3 quantities pass");
    let folder = Folder::new();
    folder.write("errors.csv", &several);
    let orders = "2,v=1,far away=0.5";
    let arguments = ["judge", "--errors", "errors.csv", "--expected-order", orders];
    folder.run(&arguments).exits(0).prints("pass: 3 of 3 quantities pass");
}

/// If a quantity is named, H1 has one order less, unless its own order is named as well.
#[test]
fn the_order_of_a_quantity_is_that_of_its_values() {
    let rows = [1.0, 0.5, 0.25].map(|h: f64| format!("{h},{},{}\n", h.powi(3), h * h));
    let table = format!("h,u_l2,u_h1\n{}", rows.concat());
    for good in ["u=3", "u=3,u_h1=2", "u=1,u_l2=3,u_h1=2"] {
        judge(&table, &format!("--expected-order {good}")).exits(0).prints("pass");
    }
    for bad in ["u=4", "u=3,u_h1=3"] {
        judge(&table, &format!("--expected-order {bad}")).exits(1).prints("fail");
    }
}

/// Replicates in a table with blanks: three rows of each h.
#[test]
fn rows_of_one_h_are_replicates() {
    let rows = (0..12).map(|k| {
        let (h, off) = (0.5f64.powi(k / 3), [1.0, 1.02, 0.98][k as usize % 3]);
        format!("{h}   {}\n", off * h * h)
    });
    let table = "# three offsets of the grid\nh    rms\n".to_owned() + &rows.collect::<String>();
    let document = judge(&table, "--json").exits(0).json();
    let levels = document["levels"].as_array().expect("levels");
    assert!(levels.len() == 4 && levels.iter().all(|level| level["runs"] == 3), "{document:#}");
    let interval = &document["order_interval"];
    let ends = [0, 1].map(|at: usize| interval[at].as_f64().expect("a number"));
    assert!(ends[0] < 1.97 && 2.03 < ends[1] && ends[1] - ends[0] < 0.1, "{ends:?}");
}

#[test]
fn space_and_time_are_told_apart() {
    let rows = (0..9).map(|k| {
        let (h, dt) = (0.5f64.powi(k / 3), 0.1 * 0.5f64.powi(k / 3 + k % 3));
        format!("{h}\t{dt}\t{}\n", 3.0 * h * h + 2.0 * dt)
    });
    let table = "h\tdt\tl2\n".to_owned() + &rows.collect::<String>();
    let run = judge(&table, "").exits(1);
    run.prints("fail: observed order 1.00").prints("l2 in dt");
    run.prints("l2 = 3.000e0 h^2.00 +2.000e0 dt^1.00 in all runs, within 0.0 %");
    judge(&table, "--expected-order 2,time=1").exits(0).prints("pass: observed order 2.00");
    // A table with a single h is a study in time.
    let in_time = "h,dt,l2\n1,0.4,16\n1,0.2,4\n1,0.1,1\n";
    judge(in_time, "").exits(0).prints("3 levels, dt 4.000e-1 to dt 1.000e-1");
}

#[test]
fn the_csv_file_of_a_study_is_judged_as_it_is() {
    let folder = Folder::new();
    folder.mms("study bar_1d --cells 8,16,32,64 --output study").exits(0);
    let run = folder.mms("judge --errors study/convergence.csv --output again").exits(0);
    run.prints("4 levels, h 1.250e-1 to h 1.562e-2").prints("again/convergence.svg");
    // The output can be judged again.
    folder.mms("judge --errors again/convergence.csv").exits(0);
    let picture = folder.read("again/convergence.svg");
    assert!(picture.contains("cell size h") && !picture.contains("stopped"));
    // A run that stopped has no errors, and a remark with commas.
    folder.mms("study bar_1d --cells 8,16,32 --courant 0.8 --output study").exits(1);
    let again = "judge --errors study/convergence.csv --output again";
    folder.mms(again).exits(1).prints("a run stopped");
    for picture in ["study/convergence.svg", "again/convergence.svg"] {
        assert!(folder.read(picture).contains("stopped"), "{picture}");
    }
}

#[test]
fn what_may_be_round_off_is_left_out() {
    let stalls = "h,l2,round_off\n8,64,0.1\n4,16,0.1\n2,4,0.1\n1,1,2\n0.5,1,2\n";
    judge(stalls, "").exits(0).prints("3 levels, h 8.000e0 to h 2.000e0");
}

/// Each bad table is refused at its position, with the expected content.
#[test]
fn bad_tables_are_refused_where_they_are_bad() {
    let cases = [
        (
            "",
            "errors.csv:1:1: expected a header with `h` and the names of errors; the file is empty",
        ),
        ("# nothing\n\n", "errors.csv:1:1: expected a header"),
        ("h,l2\n", "errors.csv:1:1: expected a row for each run below the header"),
        (
            "0.1,2\n0.05,1\n",
            "errors.csv:1:1: expected a header with `h` and the names of errors, and found a number",
        ),
        ("x,l2\n1,2\n", "errors.csv:1:1: expected a column `h`, the cell size"),
        ("h,cells\n1,2\n", "errors.csv:1:1: expected a column of errors, such as `l2`"),
        (
            "h,l2,rms\n1,2,3\n",
            "errors.csv:1:6: `rms` means what `l2` does; rename one of the columns",
        ),
        ("h,l2\n0.1,big\n", "errors.csv:2:5: `big`: expected an error, a finite number 0 or above"),
        ("# a\n\nh,l2\n# b\n\n0.1,1\n0.05,  -1\n", "errors.csv:7:8: `-1`: expected an error"),
        ("h;l2\n0;1\n", "errors.csv:2:1: `0`: expected a length, a finite number above 0"),
        ("h,failure,l2\n0.1,\"a,b\",x\n", "errors.csv:2:11: `x`: expected an error"),
        ("h,l2\n0.1\n", "errors.csv:2:1: expected 2 fields, as in the header, and found 1"),
        (
            "h dt l2\n1 .1 2\n1 .2 3\n2 .1 3\n2 .2 2\n",
            "errors.csv: 2 values of h and 2 of dt in 4 pairs",
        ),
    ];
    for (table, message) in cases {
        judge(table, "").exits(2).complains(message).prints_nothing();
    }
    let good = "h,l2\n1,1\n0.5,0.25\n";
    judge(good, "--expected-order l1=2").exits(2).complains("there is no such norm or column");
    judge(good, "--expected-order x").exits(2).complains("expected a finite number");
    judge(good, "--tolerance 0").exits(2).complains("--tolerance");
    let folder = Folder::new();
    folder.mms("judge --errors missing.csv").exits(2).complains("cannot read `missing.csv`");
    folder.mms("judge").exits(2).complains("<FIELD>");
    for name in ["\u{1b}[31m", "\"x\npass: all is well\""] {
        folder.write("odd.csv", &format!("h,{name}\n1,1\n"));
        let run = folder.mms("judge --errors odd.csv").exits(2);
        run.complains("odd.csv:1:3: `").complains("expected a name on one line");
    }
}

/// No table makes it panic, or print something that is not a number.
#[test]
fn extreme_numbers_are_judged_without_nonsense() {
    for errors in [[0.0; 4], [1.0; 4], [1e-320; 4], [1e300, 1e-300, 1e300, 1e-300], [1e308; 4]] {
        for lengths in [[8.0, 4.0, 2.0, 1.0], [1e300, 1.0, 1e-300, 1e-308], [1.0; 4]] {
            let rows = lengths.iter().zip(errors).map(|(h, e)| format!("{h:e},{e:e}\n"));
            let table = "h,l2\n".to_owned() + &rows.collect::<String>();
            let run = judge(&table, "");
            assert!(!run.stdout.contains("NaN"), "{}", run.stdout);
            judge(&table, "--json").json();
        }
    }
}

/// The table that a study of several methods writes.
#[test]
fn a_table_of_several_methods_is_judged_one_by_one() {
    let folder = Folder::new();
    folder.mms("study bar_1d --cells 8,16,32 --shape cpgimp,linear -o out").exits(1);
    let judge = "judge --errors out/convergence.csv";
    folder.mms(judge).exits(2).complains(
        "out/convergence.csv:1:1: a table of 2 methods: choose one with `--method NAME`: `cpgimp`, `linear`",
    );
    folder.mms(&format!("{judge} --method cpgimp")).exits(0).prints("observed order 2.00");
    folder.mms(&format!("{judge} --method linear")).exits(1);
    folder.mms(&format!("{judge} --method cpdi")).exits(2).complains("`cpdi` is none of them");
    folder.write("errors.csv", "h,l2\n0.25,1.6e-2\n0.125,4.0e-3\n");
    let without = folder.mms("judge --errors errors.csv --method cpdi").exits(2);
    without.complains("`errors.csv` has no column `method`");
    // The rows of a method need not be together.
    folder.write(
        "mixed.csv",
        "method,h,l2\nb,0.2,4.000e-3\na,0.2,2.000e-2\nb,0.1,1.000e-3\na,0.1,1.000e-2\n",
    );
    let judge = "judge --errors mixed.csv";
    folder
        .mms(judge)
        .exits(2)
        .complains("a table of 2 methods: choose one with `--method NAME`: `b`, `a`");
    folder.mms(&format!("{judge} --method b")).exits(0);
}

/// A bound that rounds to nothing has the digits that tell it from 0.
#[test]
fn no_sentence_says_less_than_0_percent() {
    let folder = Folder::new();
    let rows: Vec<String> =
        (0..6).map(|level| 0.5_f64.powi(level)).map(|h| format!("{h},{:.15e}", h * h)).collect();
    folder.write("errors.csv", &format!("h,l2\n{}\n", rows.join("\n")));
    let run = folder.mms("judge --errors errors.csv").exits(0);
    assert!(!run.stdout.contains("less than 0 %"), "{run}");
}
