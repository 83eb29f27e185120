//! The tables of the page: pairs of variants of a field, with the texts around them.

use mms_program::precision::Precision;
use mms_spec::quantity::Quantity;

/// A field, and the part of it that a scene uses.
#[derive(Clone, Copy)]
pub struct Variant {
    /// The name in the table.
    pub name: &'static str,
    /// The path of the field file.
    pub path: &'static str,
    /// Whether the body force is the only quantity.
    pub is_forcing: bool,
    /// Whether the parameters are constants.
    pub is_frozen: bool,
    /// Whether values that depend on X alone are kept for each point.
    pub is_kept: bool,
    /// The precision.
    pub precision: Precision,
}

impl Variant {
    /// The name of the field.
    pub fn field(&self) -> &'static str {
        self.path.rsplit('/').next().unwrap_or(self.path).trim_end_matches(".toml")
    }

    /// The quantities; `None` for all.
    pub fn quantities(&self) -> Option<&'static [Quantity]> {
        self.is_forcing.then_some(&[Quantity::BodyForce])
    }

    const fn called(self, name: &'static str) -> Self {
        Variant { name, ..self }
    }
}

/// The body force of a field, in double precision.
const fn forcing(path: &'static str) -> Variant {
    Variant {
        name: "body_force",
        path,
        is_forcing: true,
        is_frozen: false,
        is_kept: false,
        precision: Precision::F64,
    }
}

/// All quantities of a field, in double precision.
const fn everything(path: &'static str) -> Variant {
    Variant { name: "all quantities", is_forcing: false, ..forcing(path) }
}

/// A table with its texts.
pub struct Table {
    /// The heading.
    pub title: &'static str,
    /// The text above: the compared variants.
    pub about: &'static str,
    /// Pairs: more than a scene may require, and only the required part.
    pub pairs: &'static [[Variant; 2]],
    /// The text below: the conclusion.
    pub conclusion: &'static str,
}

/// A motion along one axis, in three dimensions and in one.
pub const ALONG_ONE_AXIS: [Variant; 2] = [forcing(LINE_IN_SPACE), forcing(LINE)];

const BAR: &str = "fields/bar_1d.toml";
const VORTEX: &str = "fields/generalized_vortex.toml";
const COLUMN: &str = "fields/twisted_column.toml";
const SHEAR: &str = "fields/cyclic_shear_3d.toml";
const WAVES: &str = "fields/axis_aligned_3d.toml";
const LINE: &str = "fields/axis_aligned_1d.toml";
const LINE_IN_SPACE: &str = "examples/fields/axis_aligned_1d_in_3d.toml";
const DYNAMIC: &str = "examples/fields/standing_wave_3d.toml";
const STATIC: &str = "examples/fields/static_3d.toml";

const fn alone(path: &'static str) -> [Variant; 2] {
    [everything(path), forcing(path)]
}

const fn frozen(path: &'static str) -> [Variant; 2] {
    let free = forcing(path);
    [free.called("free"), Variant { name: "frozen", is_frozen: true, ..free }]
}

const fn kept(path: &'static str) -> [Variant; 2] {
    let computed = forcing(path);
    [computed.called("computed"), Variant { name: "kept", is_kept: true, ..computed }]
}

const fn single(path: &'static str) -> [Variant; 2] {
    let double = forcing(path);
    [double.called("f64"), Variant { name: "f32", precision: Precision::F32, ..double }]
}

/// The tables, in their order.
pub const TABLES: &[Table] = &[
    Table {
        title: "The body force alone, or all quantities",
        about: "\
`quantities = [body_force]`, compared with a call for every quantity.",
        pairs: &[alone(BAR), alone(VORTEX), alone(COLUMN)],
        conclusion: "\
Request the quantities that the solver reads: in most columns b alone is a tenth of the whole or less. A
call costs no more if other functions are emitted beside it. So the selection saves code and build time;
functions that nothing calls take no time anyway.",
    },
    Table {
        title: "Parameters that are constants, or free",
        about: "`freeze`; b alone.",
        pairs: &[frozen(BAR), frozen(VORTEX), frozen(SHEAR)],
        conclusion: "\
The compiler folds terms that depend only on parameters, and emits no code for them: that is most of the
saving. A loop over many points computes these terms once, before it starts, whether they are frozen or not;
so freezing saves little or no time there. But the angle of a frozen `generalized_vortex` is proved to be less
than a quarter turn, and needs no reduction. Freezing may also add operations: in `twisted_column`,
`sheared_block_2d`, `self_weight_column` and `quiet_boundary_2d` folded numbers hide common factors, and a few
more operations depend on X.",
    },
    Table {
        title: "One dimension, or the same motion in three",
        about: "\
u = f(X, t) in a bar, compared with u = (f(X, t), 0, 0) in a cube; b alone.",
        pairs: &[ALONG_ONE_AXIS],
        conclusion: "\
The compiler removes terms that are 0: a motion along one axis takes the same operations in three dimensions,
and about the same code for a point. Only a batch differs: it reads three columns and writes three. So a scene
of one dimension needs no field of three, and loses little with it.",
    },
    Table {
        title: "At rest, or in motion",
        about: "\
The displacement of a standing wave at t = 0, compared with the wave; b alone.",
        pairs: &[[forcing(DYNAMIC), forcing(STATIC)]],
        conclusion: "\
A field without t has no velocity, no acceleration and no work at a new time, and one loop replaces two. The
divergence of P, which is most of b, remains; the next table shows how to save it.",
    },
    Table {
        title: "Values of X alone, kept or computed again",
        about: "\
`body_force_at` and `body_force_batch_at`, compared with `body_force` and `body_force_batch`. The bytes
include `at_point` and `at_points`, which run once per point; operations and times do not.",
        pairs: &[kept(BAR), kept(VORTEX), kept(WAVES), kept(COLUMN), kept(STATIC)],
        conclusion: "\
Keep the values that depend on X alone if they are sines, roots and exponentials; at rest they are all of b.
If they are five sums and products, as in the bar, reading takes as long as computing. The loops over kept
points are code too: up to a third more, in the bar twice as much. The 4096 points of this table are in the
cache. The compiler chooses the stored values (columns) for points in main memory, so that few bytes are read:
it does not store a number that at most three sums and products compute from others. That saves time if the
columns are in main memory, and may cost time if they are in the cache.",
    },
    Table {
        title: "Single precision, or double",
        about: "`f32`, compared with `f64`; b alone.",
        pairs: &[single(BAR), single(VORTEX), single(COLUMN)],
        conclusion: "\
The operations are the same, and twice as many numbers fit into a vector: many points take about half
of the time. [accuracy.md](accuracy.md) has the errors. `f32` has more code, since terms without X are
computed in `f64`, whose functions are compiled with it; `f64` computes them in twice its digits, with
functions in `mms-math`.",
    },
];
