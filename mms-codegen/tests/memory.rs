//! No text makes the compiler allocate more memory than a stated bound: counted by the allocator.

use allocation_counter::measure;
use mms_codegen::Options;

use crate::sampled::sampled;
use crate::survive::survive;

/// The largest allocation of a compilation. The graph has at most 200,000 nodes and operands of about 100 bytes each; the
/// programs and the texts that are made of it need several times as much.
const BOUND: u64 = 128 << 20;

/// The tables that complete a field of one dimension.
const REST: &str = "[material]\nmodel = \"neo_hookean\"\nlambda = 1\nmu = 1\ndensity = 1\n\
                    [domain]\nshape = \"box\"\nlower = [0]\nupper = [1]\ntime = [0, 1]\n";

fn field(lets: &str, u: &str) -> String {
    format!(
        "[field]\ntitle = \"x\"\ndimension = 1\n[let]\n{lets}[displacement]\nu = [\"{u}\"]\n{REST}"
    )
}

fn repeated(count: usize, piece: impl Fn(usize) -> String) -> String {
    (1..=count).map(piece).collect()
}

/// Asserts that no text of a sweep allocates more than the bound; each has a name.
fn hold(texts: &[(&str, String)]) {
    for (what, text) in sampled(texts, 5) {
        let taken = measure(|| survive(text, &Options::default())).bytes_max;
        println!("{what}: {} KiB for a text of {} KiB", taken >> 10, text.len() >> 10);
        assert!(taken < BOUND, "{what}: {taken} bytes");
    }
}

#[test]
fn no_text_takes_more_memory_than_the_bound() {
    let powers =
        "a1 = \"3/7\"\n".to_string() + &repeated(13, |k| format!("a{} = \"a{k}^2\"\n", k + 1));
    hold(&[
        ("nesting", field("", &"(".repeat(500_000))),
        ("a long sum", field("", &(repeated(45_000, |k| format!("{k}*X + ")) + "1"))),
        ("a long product", field("", &(repeated(45_000, |_| "X*".into()) + "1"))),
        ("waves", field("", &(repeated(2_000, |k| format!("sin({k}*X + t) + ")) + "1"))),
        ("a product of waves", field("", &(repeated(300, |k| format!("sin({k}*X + t)*")) + "1"))),
        (
            "longer numbers",
            field(&powers, &(repeated(4_000, |k| format!("(a14 + {k})*sin({k}*X) + ")) + "1")),
        ),
        ("keys", repeated(60_000, |k| format!("a{k} = 1\n"))),
        ("tables", "[[study]]\n".repeat(60_000)),
        ("brackets", "[".repeat(1_000_000)),
        ("names", field(&repeated(25_000, |k| format!("a{k} = \"X + {k}\"\n")), "a1")),
    ]);
}

/// The text that needs the most memory.
#[test]
#[ignore = "takes a minute: .ci/long runs it"]
fn long_numbers_take_no_more_memory_than_the_bound() {
    let long = "9".repeat(900);
    let sum = repeated(900, |k| format!("{long}.{k}*sin({k}*X) + "));
    hold(&[("long numbers", field("", &(sum + "1")))]);
}
