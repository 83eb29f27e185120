//! Test of the page on savings by scenes: its operation counts are current, and a smaller part of a field never costs more.
//! Times are not compared.

#[path = "../examples/scene/cost.rs"]
mod cost;
#[allow(dead_code)]
#[path = "../examples/scene/page.rs"]
mod page;
#[path = "../examples/scene/table.rs"]
mod table;

use mms_lab::workbench::Workbench;

use crate::sampled::sampled;
use cost::{Subject, subjects};
use table::{ALONG_ONE_AXIS, TABLES, Variant};

#[test]
fn the_page_has_the_operations_that_its_command_counts() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/scene.md");
    let committed = std::fs::read_to_string(path).unwrap_or_default();
    let mut rows =
        committed.lines().filter(|line| line.starts_with("| ") && !page::COLUMNS.starts_with(line));
    for table in TABLES {
        for (variants, subjects) in table.pairs.iter().zip(subjects(table).expect("fields")) {
            for row in 0..2 {
                let expected = page::counted(variants, &subjects, row);
                assert!(
                    rows.next().is_some_and(|row| row.starts_with(&expected)),
                    "docs/scene.md lacks `{expected}`; after a look at the difference, commit what \
                     this writes:\n    cargo run --release --example scene > docs/scene.md"
                );
            }
        }
    }
    assert_eq!(rows.next(), None);
}

#[test]
fn less_of_a_field_takes_no_more_operations() {
    for table in TABLES {
        for [more, less] in subjects(table).expect("fields") {
            let [more, less] = [more.operations(), less.operations()];
            let is_less = less.all <= more.all && less.of_position <= more.of_position;
            assert!(is_less, "{}: {less:?}, {more:?}", table.title);
        }
    }
}

#[test]
fn a_motion_along_one_axis_takes_the_same_operations_in_three_dimensions() {
    let [space, line] = ALONG_ONE_AXIS.map(|variant| Subject::new(variant).expect("a field"));
    assert_eq!(space.operations(), line.operations());
}

#[test]
fn less_of_a_field_is_no_more_machine_code() {
    let bench = Workbench::open().expect("a workbench");
    // Caching points needs loops of its own, and another precision other functions.
    let is_part = |[more, less]: &[Variant; 2]| {
        less.is_kept == more.is_kept && less.precision == more.precision
    };
    let tables = TABLES.iter().filter(|table| table.pairs.iter().all(is_part));
    let pairs = tables.flat_map(|table| table.pairs.iter().map(move |pair| (table, pair)));
    for (table, pair) in sampled(pairs, 12) {
        let subjects = pair.map(|variant| Subject::new(variant).expect("a field"));
        let [more, less] = subjects.map(|subject| subject.bytes(&bench).expect("an object file"));
        let is_less = less[0] <= more[0] && less[1] <= more[1];
        assert!(is_less, "{}: {less:?} bytes, {more:?}", table.title);
    }
}
