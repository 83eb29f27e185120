//! `mms report`: the numbers of its page agree with the documents. The page is XML, so that a parser of XML reads it.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use roxmltree::{Document, Node, ParsingOptions};
use serde_json::Value;

use super::mms::Folder;

/// A folder with a result of each kind.
static RESULTS: LazyLock<Folder> = LazyLock::new(|| {
    let folder = Folder::new();
    folder.mms("study bar_1d --cells 4,8,16 --excluded --output all/bar").exits(0);
    let time =
        "--formulation total --shape linear --refine time --cells 64 --levels 4 --periods 1,2";
    folder.mms(&format!("study bar_1d {time} --output all/time")).exits(0);
    let methods = "--formulation total --shape linear,quadratic_bspline --cells 8,16,32";
    folder.mms(&format!("study bar_1d {methods} --output all/methods")).exits(0);
    folder.mms("verify --row time/usl --store store --output all/matrix").exits(0);
    folder
        .mms("run axis_aligned_2d --cells 4 --output all/run --vtk all/states --frames 3")
        .exits(0);
    let tradeoff = "tradeoff bar_1d --target-linf 1e-3 --cost particle-steps --most-work 1e5";
    folder.mms(&format!("{tradeoff} --store costs --output all/tradeoff")).exits(0);
    let extremes = "extremes bar_1d --quick --row units --row courant --row stability";
    folder.mms(&format!("{extremes} --output all/extremes")).exits(0);
    let accuracy =
        "accuracy bar_1d --quantity J,P --regime declared,displacement_1e-8 --points 40 --json";
    folder.write("all/accuracy/printed.json", &folder.mms(accuracy).exits(0).stdout);
    folder.write("all/defects.json", &defects("true"));
    folder.write("errors.csv", "h,u_l2,u_max,v_l2\n8,6400,1,64\n4,1600,0.25,16\n2,400,0.0625,4\n");
    folder.mms("judge --errors errors.csv --output all/judged").exits(0);
    folder.write("campaign.toml", CAMPAIGN);
    folder.mms("campaign campaign.toml --output all/campaign").exits(0);
    folder.mms("report all").exits(0);
    folder
});

/// A solver that writes the exact u of a bar at the end of its window, plus C h^2.
const CAMPAIGN: &str = r#"
[solver]
name = "a <solver>"
run = """awk -v n={cells} -v file={output}/u.csv 'BEGIN {{ print "X,u" > file
    for (i = 0; i < n; i++) {{ X = (i + 0.5)/n; print X "," 0.2*X*(2 - X) + 0.1/n^2 > file }} }}'"""
output = "{output}/u.csv"
[[study]]
field = "bar_1d"
cells = [4, 8, 16]
"#;

/// A document of `mms verify --defects` from a program with two defects; one row catches them as given.
fn defects(caught: &str) -> String {
    let defect = |name: &str, objects: &str| {
        format!(
            r#"{{"name": "{name}", "place": "solver", "what": "a <sign>",
            "rows": [{{"name": "time/usl", "caught": {caught}, "verdict": "fail", "reason": null}},
                     {{"name": "time/usf", "caught": false, "verdict": "pass", "reason": null}}],
            "pseudo": {{"picture": {objects}, "bounded": false, "symmetric": null, "energy": false, "settles": false}}}}"#
        )
    };
    let defects = [defect("first", "true"), defect("second", "null")].join(", ");
    format!(
        r#"{{"rows": ["time/usl", "time/usf"], "every_row": false, "defects": [{defects}],
        "uncaught": [], "missed": [], "idle": [], "provenance": {{"kind": "defects", "version": "0.1.0",
        "command": "mms verify --defects", "input": {{"field": null, "rigid": null, "set": [], "hash": "0"}},
        "machine": null}}}}"#
    )
}

/// The page of [`RESULTS`].
pub static PAGE: LazyLock<String> = LazyLock::new(|| RESULTS.read("all/report.html"));

pub fn document(name: &str) -> Value {
    serde_json::from_str(&RESULTS.read(&format!("all/{name}.json"))).expect("JSON")
}

pub fn parse(page: &str) -> Document<'_> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    Document::parse_with_options(page, options).expect("XML")
}

pub fn named<'a, 'b>(node: Node<'a, 'b>, tag: &str) -> impl Iterator<Item = Node<'a, 'b>> {
    let tag = tag.to_owned();
    node.descendants().filter(move |node| node.tag_name().name() == tag)
}

pub fn text(node: Node) -> String {
    node.descendants().filter(|node| node.is_text()).filter_map(|node| node.text()).collect()
}

/// A cell: the text, and the number behind it.
type Cell = (String, Option<f64>);

/// A table: its columns and its rows.
struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<Cell>>,
}

/// The tables of the section whose heading begins like this, by their captions.
fn tables(page: &Document, heading: &str) -> BTreeMap<String, Table> {
    let section = named(page.root(), "section").find(|section| {
        section.children().any(|it| it.tag_name().name() == "h3" && text(it).starts_with(heading))
    });
    let section = section.unwrap_or_else(|| panic!("no section `{heading}`"));
    let cells = |row: Node| -> Vec<Cell> {
        let cells = row.children().filter(Node::is_element);
        cells
            .map(|cell| {
                let number = named(cell, "data").next().map(|data| {
                    data.attribute("value").and_then(|value| value.parse().ok()).expect("a number")
                });
                (text(cell), number)
            })
            .collect()
    };
    let table = |table: Node| {
        let mut rows = named(table, "tr").map(cells);
        let columns = rows.next().expect("a head").into_iter().map(|(name, _)| name).collect();
        let caption = text(named(table, "caption").next().expect("a caption"));
        (caption, Table { columns, rows: rows.collect() })
    };
    named(section, "table").map(table).collect()
}

/// Asserts that a cell shows a member of a document, to the displayed digits.
fn assert_shows((shown, number): &Cell, value: &Value, place: &str) {
    match value {
        Value::Null => assert!(matches!(shown.as_str(), "\u{2013}" | ""), "{place}: {shown}"),
        Value::Number(value) => {
            let value = value.as_f64().expect("a number");
            // Counts are shown as they are.
            let number = number.or_else(|| shown.parse().ok());
            assert_eq!(number, Some(value), "{place}");
            if let Ok(read) = shown.parse::<f64>() {
                // Half of the last displayed digit.
                let (digits, exponent) = shown.split_once('e').unwrap_or((shown, "0"));
                let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
                let exponent: i32 = exponent.parse().expect("an exponent");
                let last = 0.5 * 10f64.powi(exponent - decimals as i32);
                assert!(
                    (read - value).abs() <= last * (1.0 + 1e-9),
                    "{place}: {shown} for {value:e}"
                );
            }
        }
        Value::String(value) => assert!(shown.ends_with(value.as_str()), "{place}: {shown}"),
        other => panic!("{place}: {other}"),
    }
}

/// Asserts that the rows of a table are objects of a document, whose keys are its columns.
fn assert_rows(table: &Table, rows: &[Value], keys: &[&str]) {
    assert_eq!(table.columns.len(), keys.len(), "{:?}", table.columns);
    assert_eq!(table.rows.len(), rows.len());
    assert!(!rows.is_empty());
    for (cells, row) in table.rows.iter().zip(rows) {
        for (cell, key) in cells.iter().zip(keys).filter(|(_, key)| !key.is_empty()) {
            assert_shows(cell, &row[key], key);
        }
    }
}

fn array(value: &Value) -> &[Value] {
    value.as_array().expect("an array")
}

const NORMS: [&str; 6] = ["l1", "order_l1", "l2", "order_l2", "linf", "order_linf"];

fn with_norms<'a>(before: &[&'a str], after: &[&'a str]) -> Vec<&'a str> {
    before.iter().chain(&NORMS).chain(after).copied().collect()
}

#[test]
fn the_numbers_of_a_study_are_those_of_its_document() {
    let (page, study) = (parse(&PAGE), document("bar/convergence"));
    let mut tables = tables(&page, "bar_1d: cpgimp leapfrog");
    let levels =
        tables.remove("Errors of the displacement, the largest over time").expect("levels");
    let keys = with_norms(&["cells", "particles", "steps"], &["round_off", "seconds", "failure"]);
    assert_rows(&levels, array(&study["levels"]), &keys);
    for name in ["velocity", "deformation_gradient", "first_piola_kirchhoff"] {
        let caption = format!("Errors of the {name}");
        let table = tables.remove(&caption).expect("a table");
        assert_rows(&table, array(&study["quantities"][name]), &with_norms(&[""], &[]));
    }
    let mistakes = tables.remove("Mistakes").expect("mistakes");
    assert_rows(&mistakes, array(&study["excluded"]), &["hypothesis", "", "times", "says"]);
    assert!(tables.is_empty(), "{:?}", tables.keys());
}

#[test]
fn the_numbers_of_a_study_in_time_are_those_of_its_document() {
    let (page, study) = (parse(&PAGE), document("time/convergence"));
    let mut tables = tables(&page, "bar_1d: linear leapfrog, in time");
    let steps = tables.remove("Differences of displacements to the next level").expect("steps");
    assert_rows(&steps, array(&study["differences"]), &with_norms(&["time_step"], &[]));
    let keys = ["", "amplitude_error", "order_amplitude", "phase_lag", "order_phase"];
    for measured in array(&study["phase"]["measured"]) {
        let caption = format!("Amplitude and phase in period {}", measured["number"]);
        let table = tables.remove(&caption).expect("a period");
        assert_rows(&table, array(&measured["levels"]), &keys);
    }
    tables.remove("Errors of the displacement, the largest over time").expect("levels");
    assert!(tables.is_empty(), "{:?}", tables.keys());
}

#[test]
fn the_numbers_of_several_methods_are_those_of_their_document() {
    let (page, document) = (parse(&PAGE), document("methods/convergence"));
    let table = tables(&page, "bar_1d: 2 methods").remove("l2 of each method").expect("methods");
    let studies = array(&document["studies"]);
    assert_rows(
        &table,
        studies,
        &["name", "", "", "", "observed_order", "error_constant", "verdict"],
    );
    assert_eq!(table.columns[1..4], ["8 cells", "16 cells", "32 cells"]);
    for (cells, study) in table.rows.iter().zip(studies) {
        for (cell, level) in cells[1..].iter().zip(array(&study["levels"])) {
            assert_shows(cell, &level["l2"], "l2");
        }
    }
}

/// Asserts that a table has the levels of a judged quantity.
fn assert_judged(table: &Table, quantity: &Value) {
    let norms = array(&quantity["norms"]);
    assert_eq!(table.columns.len(), 2 + 2 * norms.len());
    for (at, norm) in norms.iter().enumerate() {
        assert_eq!(table.columns[2 + 2 * at], norm["norm"].as_str().expect("a norm"));
        let levels = array(&norm["levels"]);
        assert_eq!(table.rows.len(), levels.len());
        for (cells, level) in table.rows.iter().zip(levels) {
            assert_shows(&cells[0], &level["length"], "length");
            assert_shows(&cells[2 + 2 * at], &level["error"], "error");
            assert_shows(&cells[3 + 2 * at], &level["order"], "order");
        }
    }
}

#[test]
fn the_numbers_of_judged_errors_are_those_of_their_document() {
    let (page, judged) = (parse(&PAGE), document("judged/convergence"));
    let mut tables = tables(&page, "errors.csv");
    for quantity in array(&judged["quantities"]) {
        let name = quantity["name"].as_str().expect("a name");
        assert_judged(&tables.remove(&format!("Errors of {name}")).expect("levels"), quantity);
        for sentence in array(&quantity["says"]) {
            assert!(PAGE.contains(sentence.as_str().expect("a sentence")), "{sentence}");
        }
    }
    assert!(tables.is_empty(), "{:?}", tables.keys());
}

#[test]
fn the_numbers_of_a_campaign_are_those_of_its_document() {
    let (page, campaign) = (parse(&PAGE), document("campaign/campaign"));
    let mut tables = tables(&page, "a <solver>: 1 studies");
    let study = &campaign["studies"][0];
    let judgement = &study["judgement"];
    let matrix = tables.remove("Studies").expect("the matrix");
    assert_rows(
        &matrix,
        array(&campaign["studies"]),
        &["name", "field", "", "", "", "", "verdict"],
    );
    let row = &matrix.rows[0];
    assert_eq!(row[2].0, "3 of 3");
    assert_shows(&row[3], &judgement["expected_order"], "expected");
    assert_shows(&row[4], &judgement["observed_order"], "observed");
    assert_eq!(row[5].0, "displacement l2");
    let runs = tables.remove("Runs of bar_1d").expect("runs");
    let keys = ["level", "cells", "cell_size", "time_step", "seconds", "status"];
    assert_rows(&runs, array(&study["runs"]), &keys);
    let levels = tables.remove("Errors").expect("levels");
    assert_judged(&levels, &judgement["quantities"][0]);
    let mistakes = tables.remove("Mistakes").expect("mistakes");
    assert_rows(&mistakes, array(&judgement["excluded"]), &["hypothesis", "", "times", "says"]);
    let excluded = tables.remove("Excluded mistakes").expect("excluded mistakes");
    let is_excluded = |it: &&Value| !it["by"].is_null();
    let all: Vec<_> = array(&campaign["excluded"]).iter().filter(is_excluded).cloned().collect();
    assert_rows(&excluded, &all, &["hypothesis", "by"]);
    assert!(tables.is_empty(), "{:?}", tables.keys());
}

#[test]
fn the_numbers_of_the_matrix_are_those_of_its_document() {
    let (page, matrix) = (parse(&PAGE), document("matrix/verification"));
    let mut tables = tables(&page, "The full matrix");
    let table = tables.remove("Modes of time").expect("the group");
    let keys = [
        "study",
        "refined",
        "quantity",
        "formal_order",
        "observed_order",
        "",
        "error_constant",
        "expected_error_constant",
        "verdict",
        "seconds",
    ];
    assert_rows(&table, array(&matrix["rows"]), &keys);
    for (cells, row) in table.rows.iter().zip(array(&matrix["rows"])) {
        let levels = array(&row["levels"]);
        assert!(cells[0].0.contains(row["theory"].as_str().expect("a text")));
        assert_shows(&cells[5], &levels[levels.len() - 2]["order_l2"], "before");
    }
    assert!(tables.is_empty(), "{:?}", tables.keys());
}

#[test]
fn the_numbers_of_a_tradeoff_are_those_of_its_document() {
    let (page, found) = (parse(&PAGE), document("tradeoff/tradeoff"));
    let mut tables = tables(&page, "bar_1d: error against cost");
    let (mut front, others): (Vec<Value>, Vec<Value>) =
        array(&found["runs"]).iter().cloned().partition(|run| run["front"] == true);
    let cost = |run: &Value| run["particle_steps"].as_f64().expect("a cost");
    front.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    let keys = [
        "",
        "cells",
        "particles_per_cell",
        "courant",
        "precision",
        "form",
        "linf",
        "particle_steps",
        "seconds",
        "memory",
        "",
    ];
    for (caption, runs) in
        [("The Pareto front", &front), ("Runs that others beat, and runs that stopped", &others)]
    {
        let table = tables.remove(caption).expect("runs");
        assert_rows(&table, runs, &keys);
        for (cells, run) in table.rows.iter().zip(runs) {
            for word in ["formulation", "shape", "integrator", "transfer"] {
                assert!(cells[0].0.contains(run[word].as_str().expect("a word")), "{cells:?}");
            }
            let remark = match &run["failure"] {
                Value::String(failure) => failure,
                _ if run["command"] == found["choice"]["command"] => "chosen",
                _ => "",
            };
            assert_eq!(cells[10].0, remark);
        }
    }
    assert!(tables.is_empty(), "{:?}", tables.keys());
    assert!(PAGE.contains(found["choice"]["command"].as_str().expect("a command")));
}

#[test]
fn the_numbers_of_extremes_are_those_of_their_document() {
    let (page, found) = (parse(&PAGE), document("extremes/extremes"));
    let mut tables = tables(&page, "bar_1d: at the limits");
    let rows = array(&found["rows"]);
    let table =
        tables.remove("Extremes, errors relative to the largest displacement").expect("rows");
    assert_rows(&table, rows, &["", "l2", "bound", "diagnosis", "", "verdict"]);
    for (cells, row) in table.rows.iter().zip(rows) {
        for key in ["name", "theory", "setting"] {
            assert!(cells[0].0.contains(row[key].as_str().expect("a text")), "{cells:?}");
        }
        for diagnosis in array(&row["allowed_diagnoses"]) {
            assert!(cells[4].0.contains(diagnosis.as_str().expect("a word")), "{cells:?}");
        }
    }
    let limits = tables.remove("The largest stable Courant number").expect("limits");
    let keys = ["method", "theory", "measured", "verdict"];
    assert_rows(&limits, array(&found["stability"]), &keys);
    assert!(tables.is_empty(), "{:?}", tables.keys());
}

#[test]
fn deliberate_mistakes_stand_beside_what_caught_them() {
    let page = parse(&PAGE);
    let mut tables = tables(&page, "2 deliberate mistakes");
    let table = tables.remove("Deliberate mistakes and what caught them").expect("the table");
    let checks = ["picture", "bounded", "symmetric", "energy", "settles"];
    assert_eq!(table.columns[..3], ["defect", "in the", "caught by"]);
    assert_eq!(table.columns[3..], checks);
    let shown: Vec<Vec<&str>> =
        table.rows.iter().map(|row| row.iter().map(|cell| cell.0.trim()).collect()).collect();
    let row = |name, objects| {
        [
            name,
            "solver",
            "\u{2713} time/usl",
            objects,
            "content",
            "cannot tell",
            "content",
            "content",
        ]
    };
    assert_eq!(shown, [row("firsta <sign>", "objects"), row("seconda <sign>", "cannot tell")]);
    let folder = Folder::new();
    folder.write("bad/defects.json", &defects("false"));
    let run = folder.mms("report bad").exits(1);
    run.prints("verdicts are not as expected");
    assert!(folder.read("bad/report.html").contains("0 of 2 caught"));
}

#[test]
fn the_numbers_of_a_run_are_those_of_its_document() {
    let (page, run) = (parse(&PAGE), document("run/run"));
    let mut tables = tables(&page, "axis_aligned_2d: cpgimp leapfrog, 4 cells");
    let errors =
        tables.remove("Errors, the largest over time and those at the end").expect("errors");
    for row in &errors.rows {
        let of = &run["errors"][row[0].0.as_str()];
        let norms =
            ["over_time", "at_end"].map(|when| ["l1", "l2", "linf"].map(|norm| &of[when][norm]));
        for (cell, value) in row[1..].iter().zip(norms.concat()) {
            assert_shows(cell, value, &row[0].0);
        }
    }
    assert_eq!(errors.rows.len(), 4);
    let state = tables.remove("The state at the end").expect("the state");
    assert_shows(&state.rows[0][1], &run["diagnostics"]["mass"], "mass");
    assert_shows(&state.rows[2][1], &run["diagnostics"]["kinetic_energy"], "energy");
    let parts = tables.remove("Time taken").expect("times");
    for row in &parts.rows {
        assert_eq!(row[1].1, run["seconds"][row[0].0.as_str()].as_f64(), "{}", row[0].0);
    }
    assert!(tables.is_empty(), "{:?}", tables.keys());
}

#[test]
fn the_numbers_of_accuracy_are_those_of_its_document() {
    let (page, accuracy) = (parse(&PAGE), document("accuracy/printed"));
    let tables = tables(&page, "bar_1d: errors against arbitrary precision");
    let keys = [
        "quantity",
        "precision",
        "form",
        "regime",
        "median_eps",
        "p99_eps",
        "max_eps",
        "max_scaled_eps",
        "not_finite",
        "ns_per_point",
        "",
    ];
    let rows = array(&accuracy["rows"]);
    let regimes = &tables["Largest error of any quantity, in eps of its largest value"];
    assert_eq!(regimes.rows.len(), 2);
    for shown in &regimes.rows {
        for (cell, way) in shown[1..].iter().zip(&regimes.columns[1..]) {
            let (precision, form) = way.split_once(", ").expect("a precision and a form");
            let of = |row: &&Value| {
                row["regime"] == shown[0].0 && row["precision"] == precision && row["form"] == form
            };
            let errors = rows.iter().filter(of).filter_map(|row| row["max_scaled_eps"].as_f64());
            assert_eq!(cell.1, errors.reduce(f64::max), "{way}");
        }
    }
    assert_rows(&tables["Every regime"], rows, &keys);
    let worst = &tables["The regime with the largest error, of each quantity, precision and form"];
    assert_eq!(2 * worst.rows.len(), rows.len(), "two regimes");
    for shown in &worst.rows {
        let same = |row: &&Value| {
            row["quantity"] == shown[0].0
                && row["precision"] == shown[1].0
                && row["form"] == shown[2].0
        };
        let errors = rows.iter().filter(same).filter_map(|row| row["max_scaled_eps"].as_f64());
        assert_eq!(shown[7].1, Some(errors.fold(0.0, f64::max)));
    }
    assert_eq!(tables.len(), 3);
}
