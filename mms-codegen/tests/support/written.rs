//! Fields of every kind of motion and material, as texts.

use mms_codegen::{Compiled, Selection, compile_with};

/// A density that uses every invariant, so that no coefficient of the stress is zero.
const EVERY_INVARIANT: &str = r#"
[material]
title = "every invariant"
strain_energy = "k1*(I1 - 3)*(1 + (I1 - 3)/5) + k2*(I2 - 3 + (I1 - 3)*ln(J)) - k3*ln(J) + k4*(I3 - 1)^2"
[parameters]
k1 = { unit = "Pa" }
k2 = { unit = "Pa" }
k3 = { unit = "Pa" }
k4 = { unit = "Pa" }
"#;

pub const NEO_HOOKEAN: &str = "model = \"neo_hookean\"\nlambda = 3\nmu = 2";
/// A stress-free reference state needs 2 k1 + 4 k2 = k3; k1 and the density are graded.
pub const GRADED: &str =
    "model = \"./every.toml\"\nk1 = \"2 + X/3\"\nk2 = 1\nk3 = \"8 + 2*X/3\"\nk4 = 5";

/// A field with everything that a solver needs.
pub fn field(dimension: usize, displacement: &str, material: &str, density: &str) -> Compiled {
    field_of(dimension, displacement, material, density, Selection::default())
}

/// A field with selected quantities.
pub fn field_of(
    dimension: usize,
    displacement: &str,
    material: &str,
    density: &str,
    selection: Selection,
) -> Compiled {
    let corner = |value: &str| vec![value; dimension].join(", ");
    let text = format!(
        "[field]\ntitle = \"a field\"\ndimension = {dimension}\n[displacement]\nu = {displacement}\n\
         [material]\n{material}\ndensity = \"{density}\"\n[domain]\nshape = \"box\"\n\
         lower = [{}]\nupper = [{}]\ntime = [0, 1]\n",
        corner("0.25"),
        corner("1"),
    );
    let load = |_: &str| Ok(EVERY_INVARIANT.to_string());
    compile_with("field", "field.toml", &text, &load, &selection.into())
        .unwrap_or_else(|failure| panic!("{failure}"))
}

pub const PLANE: &str = "[\"0.1*sin(2*X + Y)*cos(t)\", \"0.2*X*Y^2*sin(t + X)\"]";
pub const SPACE: &str =
    "[\"0.1*sin(X*Y + Z)*cos(t)\", \"0.1*X*Z^2*sin(t + Y)\", \"0.1*exp(X - Y)*cos(Z + t)\"]";

/// A rotation that varies with the radius: its relations collapse det F to 1.
pub const VORTEX: &str = "[\"X*cos(t*exp(-hypot(X, Y))) - Y*sin(t*exp(-hypot(X, Y))) - X\", \
                      \"X*sin(t*exp(-hypot(X, Y))) + Y*cos(t*exp(-hypot(X, Y))) - Y\"]";
