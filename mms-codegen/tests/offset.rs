//! Fields about a place far from the origin are derived in coordinates less that place.

use mms_codegen::compile::{Options, compile_unproved};
use mms_symbolic::expr::Node;
use mms_symbolic::expr::print::Names;

/// The offset of the coordinate in u of a bar, as it is derived.
fn displacement(parameters: &str, u: &str, bounds: [&str; 2]) -> String {
    let [lower, upper] = bounds;
    let text = format!(
        "[field]\ntitle = \"x\"\ndimension = 1\n[parameters]\n{parameters}\n[displacement]\nu = [\"{u}\"]\n\
         [material]\nmodel = \"neo_hookean\"\nlambda = 1\nmu = 1\ndensity = 1\n\
         [domain]\nshape = \"box\"\nlower = [\"{lower}\"]\nupper = [\"{upper}\"]\ntime = [0, 1]\n"
    );
    let load = |path: &str| Err(path.to_string());
    let compiled = compile_unproved("x", "x.toml", &text, &load, &Options::default());
    let compiled = compiled.unwrap_or_else(|failure| panic!("{failure}"));
    let parameters = ["a", "b"].map(String::from).into();
    let names = Names { parameters, ..Names::default() };
    let graph = &compiled.graph;
    let u = compiled.model.displacement[0];
    let offsets = graph
        .reachable(&[u])
        .into_iter()
        .filter(|expr| matches!(graph.node(*expr), Node::Offset(_)));
    offsets.map(|offset| graph.print(offset, &names)).collect::<Vec<_>>().join(", ")
}

#[test]
fn coordinates_are_taken_less_the_place_that_parameters_say() {
    let both = "a = { value = 0.1 }\nb = { value = 0.2 }";
    let near = ["0", "1"];
    assert_eq!(displacement(both, "b*sin(3*X - 3*a - t)", near), "X - a");
    // b is a wave number and a part of the offset, and a is b times another number.
    assert_eq!(displacement(both, "b*sin(X - a - b)", near), "X - a");
    assert_eq!(displacement(both, "a*sin(X - a)/9 + b/9", near), "");
    assert_eq!(displacement(both, "X*sin(X - a)/9 + b/9", near), "");
}

#[test]
fn coordinates_of_a_box_far_away_are_taken_less_its_corner() {
    let both = "a = { value = 0.1 }\nb = { value = 0.2 }";
    let u = "a*sin(X - 1000 - t) + b/9";
    assert_eq!(displacement(both, u, ["1000", "1001"]), "X - 1000");
    assert_eq!(displacement(both, u, ["0", "1000"]), "");
    assert_eq!(
        displacement(
            "a = { value = 1000 }\nb = { value = 1 }",
            "sin(X - a)/9 + b/9",
            ["1000", "1001"]
        ),
        "X - a"
    );
    assert_eq!(
        displacement(
            "a = { value = 2 }\nb = { value = 1 }",
            "sin(X - a)/9 + b/9",
            ["1000", "1001"]
        ),
        "X - 1000"
    );
    // A multiple of 1/2.
    assert_eq!(displacement(both, u, ["-1000 - 1/3", "-1000"]), "X - (-2001/2)");
}
