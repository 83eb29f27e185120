//! The page of errors holds: every row is measured again, at fewer points and for some quantities.

#[path = "../examples/accuracy/table.rs"]
#[expect(dead_code, reason = "the example writes the page; here its numbers are measured again")]
mod table;

use mms_codegen::accuracy::Request;
use mms_codegen::quantity::Quantity;

/// By what factor an error may exceed the committed one: with fewer points the largest value of a
/// quantity is smaller, too.
const FACTOR: f64 = 16.0;

/// What may be added to it, in eps.
const MARGIN: f64 = 16.0;

/// At how many points.
const POINTS: usize = 8;

/// The quantities that each field is measured for: of each kind of derivation one.
const QUANTITIES: [Quantity; 3] =
    [Quantity::DisplacementGradient, Quantity::StrainEnergy, Quantity::BodyForce];

/// The committed rows of a field: regime and numbers, in the order of the page.
fn committed(page: &str, field: &str) -> Vec<(String, Vec<Option<f64>>)> {
    let rows = page.lines().map(|line| line.split('|').map(str::trim).collect::<Vec<_>>());
    let rows = rows.filter(|cells| cells.get(1) == Some(&field));
    let number = |cell: &&str| cell.split(' ').next().and_then(|number| number.parse().ok());
    rows.map(|cells| (cells[2].to_string(), cells[3..9].iter().map(number).collect())).collect()
}

/// The fields, every second one from that on, hold what the page says.
fn hold(first: usize) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/accuracy.md");
    let page = std::fs::read_to_string(path).expect("the page");
    let request = Request { points: POINTS, quantities: QUANTITIES.to_vec(), ..Request::default() };
    let mut beyond = Vec::new();
    for file in table::files().into_iter().skip(first).step_by(2) {
        let field = table::stem(&file);
        let accuracy = table::measured(&file, &request);
        let rows = committed(&page, &field);
        let known: Vec<&String> = rows.iter().map(|(regime, _)| regime).collect();
        assert_eq!(known, table::regimes(&accuracy).iter().collect::<Vec<_>>(), "{field}");
        for (regime, numbers) in &rows {
            for (column, number) in table::columns().zip(numbers) {
                let found = table::worst(&accuracy, regime, column);
                let found = found.map_or(0.0, |(row, _)| row.errors.max_scaled_eps);
                let bound = FACTOR * number.unwrap_or(0.0) + MARGIN;
                if found.is_nan() || found > bound {
                    beyond.push(format!("{field} {regime} {column:?}: {found:.3e} > {bound:.3e}"));
                }
            }
        }
    }
    assert!(
        beyond.is_empty(),
        "beyond what docs/accuracy.md says; after a look at the cause, commit what this writes:\n    \
         cargo run --release --example accuracy -- 1000 > docs/accuracy.md\n{}",
        beyond.join("\n")
    );
}

#[test]
fn every_row_of_the_page_holds_for_one_half_of_the_fields() {
    hold(0);
}

#[test]
fn every_row_of_the_page_holds_for_the_other_half() {
    hold(1);
}
