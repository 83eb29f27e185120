//! The size of what is made grows with the size of the field, not faster: counted in nodes and
//! instructions, never in time.

#[path = "support/fields.rs"]
mod fields;

use fields::{Family, text};
use mms_codegen::{Compiled, compile};

fn compiled(family: Family, dimension: usize, terms: usize) -> Compiled {
    let load = |_: &str| Err("no files here".to_string());
    let text = text(family, dimension, terms);
    compile("x", "x.toml", &text, &load).unwrap_or_else(|failure| panic!("{failure}"))
}

/// Nodes with operands, and instructions.
fn size(family: Family, dimension: usize, terms: usize) -> [usize; 2] {
    let compiled = compiled(family, dimension, terms);
    [compiled.graph.size(), compiled.program.instrs.len()]
}

fn hold(family: Family) {
    for dimension in [1, 2, 3] {
        // Three components of 1000 terms would pass the bound of the graph.
        let counts: &[usize] = if dimension == 1 { &[1, 10, 100, 1000] } else { &[1, 10, 100] };
        let sizes: Vec<_> = counts.iter().map(|terms| size(family, dimension, *terms)).collect();
        for pair in sizes.windows(2) {
            // What every field has, whatever its size, makes the factor smaller.
            for (smaller, larger) in pair[0].iter().zip(pair[1]) {
                assert!(larger <= 10 * smaller, "{family:?} in {dimension}D: {sizes:?}");
            }
        }
    }
}

#[test]
fn ten_times_the_terms_make_at_most_ten_times_the_size_of_waves() {
    hold(Family::Waves);
}

#[test]
fn ten_times_the_terms_make_at_most_ten_times_the_size_of_polynomials() {
    hold(Family::Polynomial);
}
