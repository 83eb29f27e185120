//! Output formats: text, JSON, CSV, Markdown and LaTeX contain the same numbers.

use super::mms::Folder;

/// The cells of a Markdown table's rows, without its head.
fn markdown_rows(text: &str) -> Vec<Vec<String>> {
    let lines = text.lines().filter(|line| line.starts_with("| ")).skip(2);
    let cells = |line: &str| -> Vec<String> {
        let inner = line.trim_start_matches("| ").trim_end_matches(" |");
        inner.split(" | ").map(|cell| cell.replace('\\', "").trim().to_owned()).collect()
    };
    lines.map(cells).collect()
}

/// The cells of a CSV table's rows, without its head.
fn csv_rows(text: &str) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    let cells = |record: csv::StringRecord| record.iter().map(str::to_owned).collect();
    reader.records().map(|record| cells(record.expect("a row"))).collect()
}

#[test]
fn every_format_has_the_rows_of_the_table() {
    let folder = Folder::new();
    let of = |format: &str| {
        folder.mms(&format!("verify --list --row material --format {format}")).exits(0).stdout
    };
    let document = folder.mms("verify --list --row material --json").exits(0);
    let rows = document.json()["rows"].as_array().expect("rows").len();
    assert!(rows > 2);
    let (markdown, csv, latex) =
        (markdown_rows(&of("markdown")), csv_rows(&of("csv")), of("latex"));
    assert_eq!(markdown, csv);
    assert_eq!(csv.len(), rows);
    assert_eq!(latex.matches("\\\\\n").count(), rows + 1, "{latex}");
    assert!(latex.contains("\\toprule") && latex.contains("\\end{tabular}"), "{latex}");
    assert_eq!(of("json"), document.stdout);
    assert_eq!(of("text"), folder.mms("verify --list --row material").exits(0).stdout);
}

/// CSV of a study and of a judgement has all digits: it is the file that they write.
#[test]
fn the_csv_format_of_errors_is_the_file_of_errors() {
    let folder = Folder::new();
    let timeless = |text: &str| {
        let rows = csv_rows(text);
        rows.iter().map(|row| [&row[..11], &row[12..]].concat()).collect::<Vec<_>>()
    };
    let run = folder.mms("study bar_1d --cells 8,16,32 --format csv --output out").exits(0);
    assert_eq!(timeless(&run.stdout), timeless(&folder.read("out/convergence.csv")));
    let judged =
        folder.mms("judge --errors out/convergence.csv --format csv --output again").exits(0);
    assert_eq!(judged.stdout.trim(), folder.read("again/convergence.csv").trim());
    let text = folder.mms("judge --errors out/convergence.csv --format markdown").exits(0).stdout;
    assert!(text.starts_with("**out/convergence.csv: errors"), "{text}");
    assert_eq!(markdown_rows(&text).len(), 3, "{text}");
}

#[test]
fn a_format_without_a_table_is_refused() {
    let folder = Folder::new();
    folder
        .mms("list --format html")
        .exits(2)
        .complains("possible values: text, json, csv, markdown, latex");
    folder.mms("list --json --format csv").exits(2).complains("cannot be used with");
    folder.write("points.csv", "X,x\n0.0,0.0\n0.5,0.5\n1.0,1.0\n");
    folder
        .mms("judge bar_1d points.csv --time 0 --explain --format latex")
        .exits(2)
        .complains("`--format latex`: no table is printed here; expected text or json");
}
