//! No text makes the compiler panic, hang or overflow a stack. The fuzzer in `fuzz/` calls the same function.

use mms_codegen::Options;
use proptest::prelude::*;

use crate::sampled::{all_is_tried, sampled, sampled_count};

/// Checks a text within the limits that users get.
fn survive(text: &str) {
    crate::survive::survive(text, &Options::default());
}

const BAR: &str = include_str!("data/pass/every_key_2d.toml");

/// An axisymmetric field with a swirl and its axis.
const SHAFT: &str = "[field]\ntitle = \"x\"\ndimension = 2\ncoordinates = \"axisymmetric\"\n\
    [let]\nA = \"0.1*sin(t)\"\n[displacement]\nu = [\"A*R*Z\", \"A*R^2\"]\nswirl = \"R*A\"\n\
    [material]\nmodel = \"neo_hookean\"\nlambda = 1\nmu = \"1 + R\"\ndensity = 1\n\
    [domain]\nshape = \"box\"\nlower = [0, 0]\nupper = [1, 1]\ntime = [0, 1]\n\
    [boundary]\nr_min = \"axis\"\nz_max = \"traction\"\n\
    [[balance]]\nname = \"heat\"\nflux = [\"F11*R\", \"u_theta\", \"v_r\"]\n\
    [rigid]\ntranslation = [0, \"t\"]\n";

/// The tables that complete a field of one dimension.
const REST: &str = "[material]\nmodel = \"neo_hookean\"\nlambda = 1\nmu = 1\ndensity = 1\n\
                    [domain]\nshape = \"box\"\nlower = [0]\nupper = [1]\ntime = [0, 1]\n";

/// Pieces of field files, so that random texts reach past the TOML.
fn fragments() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        Just("[field]\n"),
        Just("[let]\n"),
        Just("[displacement]\n"),
        Just("[material]\n"),
        Just("[[check]]\n"),
        Just("[[study]]\n"),
        Just("[domain]\n"),
        Just("[boundary]\n"),
        Just("[parameters]\n"),
        Just("[rigid]\n"),
        Just("[[extreme]]\n"),
        Just("dimension = 2\n"),
        Just("coordinates = \"axisymmetric\"\n"),
        Just("swirl = \"R\"\n"),
        Just("r_min = \"axis\"\n"),
        Just("u = [\"X\", 1]\n"),
        Just("a = "),
        Just("b."),
        Just("\"X^2\"\n"),
        Just("\"\\u03bb(\"\n"),
        Just("{ value = 1e-400 }\n"),
        Just("{ value = "),
        Just("a = { value = 1, unit = \"m\", range = [2, \"a\"] }\n"),
        Just("c = { value = \"a/2\", unit = \"kg/m^3\" }\n"),
        Just("unit = \"m^(1/0)\""),
        Just("[1, "),
        Just("'''\n"),
        Just("\"\"\""),
        Just("inf\n"),
        Just("0x1F\n"),
        Just("= "),
        Just("]"),
        Just("}"),
        Just("\n"),
        Just(" "),
        Just("shape = \"annulus\"\n"),
        Just("x_min = \"fixed\"\n"),
        Just("lower = [0]\n"),
        Just("\u{e9}"),
        Just("\r"),
        Just("\0"),
        Just("let = { F = \"1\" }\n"),
        Just("\"\\q\"\n"),
    ];
    prop::collection::vec(piece, 0..40).prop_map(|pieces| pieces.concat())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: sampled_count(256, 4) as u32, ..ProptestConfig::default() })]
    #[test]
    fn any_text(text in any::<String>()) {
        survive(&text);
    }

    #[test]
    fn any_pieces(text in fragments()) {
        survive(&text);
    }

    #[test]
    fn any_formula(text in "[-+*/^(),.0-9a-zX_ \u{3bb}]{0,60}") {
        survive(&format!("[field]\ndimension = 1\n[displacement]\nu = [\"{text}\"]\n{REST}"));
    }

    #[test]
    fn any_cut_of_a_good_file(
        good in prop::sample::select(vec![BAR, SHAFT]),
        at in 0..BAR.len(),
        length in 0_usize..40,
        with in any::<String>(),
    ) {
        let at = at % good.len();
        let at = (0..=at).rev().find(|at| good.is_char_boundary(*at)).unwrap_or(0);
        let end = (at + length).min(good.len());
        let end = (end..=good.len()).find(|end| good.is_char_boundary(*end)).unwrap_or(good.len());
        survive(&format!("{}{with}{}", &good[..at], &good[end..]));
    }
}

#[test]
fn long_and_deep_texts_are_answered() {
    let one_dimensional = |before: &str, middle: &str, after: &str| {
        format!(
            "[field]\ntitle = \"x\"\ndimension = 1\n[displacement]\n\
             u = [\"{before}{middle}{after}\"]\n{REST}"
        )
    };
    let formula = |text: String| format!("[displacement]\nu = [\"{text}\"]\n");
    let short_work = [
        "[".repeat(200_000),
        "a = ".to_string() + &"[".repeat(200_000),
        "a.".repeat(200_000),
        "[a]\n".repeat(20_000),
        "a = 1\n".repeat(20_000),
        (0..20_000).map(|index| format!("lenght{index} = 1\n")).collect(),
        "[let]\n".to_string()
            + &(0..20_000).map(|at| format!("X{at} = true\n")).collect::<String>(),
        formula("(".repeat(200_000)),
        formula("\\\\".repeat(100_000)),
        formula("1e1000*".repeat(20_000)),
        "x".repeat(2_000_000),
    ];
    let long_work = [
        one_dimensional(&"sin(".repeat(400), "X", &")".repeat(400)),
        one_dimensional("", &"X + t*".repeat(15_000), "X"),
        one_dimensional("", &"sin(X)*cos(t + X)^2*".repeat(4_000), "X"),
        one_dimensional(
            "X*(",
            &(1..if all_is_tried() { 2_000 } else { 500 })
                .map(|k| format!("sin({k}*X)/{k} + "))
                .collect::<String>(),
            "1)",
        ),
        one_dimensional("", &"(X + 1)^2^".repeat(60), "2"),
        one_dimensional("X^1000000 + sin(X)^(1/", "1000000", ")"),
    ];
    for text in short_work.into_iter().chain(sampled(long_work, 3)) {
        survive(&text);
    }
}
