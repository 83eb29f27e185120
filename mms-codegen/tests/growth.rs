//! The output grows with the size of the field, not faster: counted in nodes and instructions, never in time.

#[path = "support/fields.rs"]
mod fields;

use fields::{Family, text};
use mms_codegen::{Compiled, compile};

use crate::sampled::all_is_tried;

fn compiled(family: Family, dimension: usize, terms: usize) -> Compiled {
    let load = |_: &str| Err("no files here".to_string());
    let text = text(family, dimension, terms);
    compile("x", "x.toml", &text, &load).unwrap_or_else(|failure| panic!("{failure}"))
}

const FEW: [&[usize]; 3] = [&[1, 10, 100], &[1, 10], &[1, 10]];

/// Three components of 1000 terms would exceed the limit of the graph.
const MANY: [&[usize]; 3] = [&[100, 1000], &[10, 100], &[10, 100]];

/// Nodes with operands, and instructions.
fn size(family: Family, dimension: usize, terms: usize) -> [usize; 2] {
    let compiled = compiled(family, dimension, terms);
    [compiled.graph.size(), compiled.program.instrs.len()]
}

/// Asserts linear growth for fields of one to three components, each with these numbers of terms.
fn hold(family: Family, counts: [&[usize]; 3]) {
    for (dimension, counts) in (1..).zip(counts) {
        let sizes: Vec<_> = counts.iter().map(|terms| size(family, dimension, *terms)).collect();
        for pair in sizes.windows(2) {
            // The constant part of every field makes the factor smaller.
            for (smaller, larger) in pair[0].iter().zip(pair[1]) {
                assert!(larger <= 10 * smaller, "{family:?} in {dimension}D: {sizes:?}");
            }
        }
    }
}

#[test]
fn ten_times_the_terms_make_at_most_ten_times_the_size_of_waves() {
    hold(Family::Waves, FEW);
}

#[test]
fn ten_times_the_terms_make_at_most_ten_times_the_size_of_polynomials() {
    hold(Family::Polynomial, FEW);
}

#[test]
#[ignore = "takes a minute: .ci/long runs it"]
fn so_they_do_for_as_many_terms_as_a_graph_holds() {
    hold(Family::Waves, MANY);
    hold(Family::Polynomial, MANY);
}

/// Each definition uses the one before it twice: walking every use would take 2^45 steps, and 2^60 if all cases are tried.
#[test]
fn what_is_used_twice_is_walked_once() {
    let levels = if all_is_tried() { 60 } else { 45 };
    let lines: String =
        (1..levels).map(|level| format!("p{level} = \"p{0} + p{0}*X\"\n", level - 1)).collect();
    let text = format!(
        "[field]\ntitle = \"x\"\ndimension = 1\n[let]\np0 = \"X + 1\"\n{lines}[displacement]\n\
         u = [\"p{}*1e-30\"]\n[material]\nmodel = \"neo_hookean\"\nlambda = 1\nmu = 1\ndensity = 1\n\
         [domain]\nshape = \"box\"\nlower = [0]\nupper = [1]\ntime = [0, 1]\n",
        levels - 1
    );
    let load = |_: &str| Err("no files here".to_string());
    let compiled =
        compile("x", "x.toml", &text, &load).unwrap_or_else(|failure| panic!("{failure}"));
    assert!(compiled.graph.size() < 20_000, "{}", compiled.graph.size());
}
