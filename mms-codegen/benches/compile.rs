//! The time of a compilation against the number of terms of the displacement; it should be proportional: `cargo bench -p
//! mms-codegen`. The items of the table are terms.

#[path = "../tests/support/fields.rs"]
mod fields;

use divan::Bencher;
use divan::counter::ItemsCount;
use fields::{Family, text};
use mms_codegen::{Options, compile_with};

const TERMS: [usize; 4] = [1, 10, 100, 1000];

fn main() {
    divan::main();
}

fn bench(bencher: Bencher<'_, '_>, family: Family, dimension: usize, terms: usize) {
    let text = text(family, dimension, terms);
    let load = |_: &str| Err("no files here".to_string());
    // 1000 terms in each of three components exceed the default limit.
    let options = Options { max_nodes: 2_000_000, ..Options::default() };
    bencher
        .counter(ItemsCount::new(terms * dimension))
        .bench(|| compile_with("x", "x.toml", &text, &load, &options).expect("a right field"));
}

#[divan::bench(args = TERMS, max_time = 3)]
fn waves_in_1d(bencher: Bencher<'_, '_>, terms: usize) {
    bench(bencher, Family::Waves, 1, terms);
}

#[divan::bench(args = TERMS, max_time = 3)]
fn waves_in_3d(bencher: Bencher<'_, '_>, terms: usize) {
    bench(bencher, Family::Waves, 3, terms);
}

#[divan::bench(args = TERMS, max_time = 3)]
fn polynomial_in_1d(bencher: Bencher<'_, '_>, terms: usize) {
    bench(bencher, Family::Polynomial, 1, terms);
}

#[divan::bench(args = TERMS, max_time = 3)]
fn polynomial_in_3d(bencher: Bencher<'_, '_>, terms: usize) {
    bench(bencher, Family::Polynomial, 3, terms);
}
