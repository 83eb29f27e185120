//! What is compared with what.

use mms_program::precision::Precision;
use mms_spec::quantity::Quantity;

/// A field, and what of it a scene takes.
#[derive(Clone, Copy)]
pub struct Variant {
    /// What it is called in its table.
    pub name: &'static str,
    /// The path of the field file.
    pub path: &'static str,
    /// Whether the body force is all that is wanted.
    pub is_forcing: bool,
    /// Whether the parameters are constants.
    pub is_frozen: bool,
    /// Whether what X determines is kept of each point.
    pub is_kept: bool,
    /// The precision.
    pub precision: Precision,
}

impl Variant {
    /// The name of the field.
    pub fn field(&self) -> &'static str {
        self.path.rsplit('/').next().unwrap_or(self.path).trim_end_matches(".toml")
    }

    /// The quantities; none stands for all.
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

/// All quantities of it.
const fn everything(path: &'static str) -> Variant {
    Variant { name: "all quantities", is_forcing: false, ..forcing(path) }
}

/// What stands in a table.
pub struct Table {
    /// Its heading.
    pub title: &'static str,
    /// What is compared.
    pub about: &'static str,
    /// Each more than a scene may require, and what it does.
    pub pairs: &'static [[Variant; 2]],
    /// What follows from it.
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
`quantities = [body_force]`, beside a call for every quantity that there is.",
        pairs: &[alone(BAR), alone(VORTEX), alone(COLUMN)],
        conclusion: "\
Ask for what the solver reads: b alone is a tenth of the whole or less, in most columns. A call costs
no more where other functions are emitted beside it. So what the selection saves is code, and the time
of a build; what is not called takes no time anyway.",
    },
    Table {
        title: "Parameters that are constants, or free",
        about: "`freeze`, of b alone.",
        pairs: &[frozen(BAR), frozen(VORTEX), frozen(SHEAR)],
        conclusion: "\
What only parameters determine is folded, and its code is gone: that is most of what is saved. A loop
over many points has these numbers ready in either case, and gains little or nothing; but the angle of
`generalized_vortex` is then proved to be less than a quarter turn, and needs no reduction. Nor is it sure to
get shorter: in `twisted_column`, `sheared_block_2d`, `self_weight_column` and `quiet_boundary_2d`
numbers that are multiplied out hide what terms have in common, and a few more operations depend on X.",
    },
    Table {
        title: "One dimension, or the same motion in three",
        about: "\
u = f(X, t) in a bar, beside u = (f(X, t), 0, 0) in a cube, of b alone.",
        pairs: &[ALONG_ONE_AXIS],
        conclusion: "\
What is zero folds: the motion of one dimension takes the same operations in three, and about the same
code for a point. What is left are the columns of a batch, three to read and three to write. So a
scene of one dimension needs no field of three, and loses little with it.",
    },
    Table {
        title: "At rest, or in motion",
        about: "\
The displacement that a standing wave has at t = 0, beside the wave, of b alone.",
        pairs: &[[forcing(DYNAMIC), forcing(STATIC)]],
        conclusion: "\
Without t there are no velocity and no acceleration, nothing to do at a new time, and one loop in place
of two. The divergence of P, which is most of b, remains: it is the next table that saves that.",
    },
    Table {
        title: "What X determines kept, or computed again",
        about: "\
`body_force_at` and `body_force_batch_at`, beside `body_force` and `body_force_batch`. What is done
once per point, `at_point` and `at_points`, is among the bytes, and neither among the operations nor
in the times.",
        pairs: &[kept(BAR), kept(VORTEX), kept(WAVES), kept(COLUMN), kept(STATIC)],
        conclusion: "\
Keep what X determines where that is sines, roots and exponentials; at rest it is all of b. Where it is
five sums and products, as in the bar, reading takes as long as computing. The loops that keep points are
code too: up to a third more, in the bar twice as much. The 4096 points are near. Columns are chosen for
points that are not, and for few bytes: a number that up to three sums and products make of others is no
column. Near points may take longer for it; where columns come from memory, it takes less time.",
    },
    Table {
        title: "Single precision, or double",
        about: "`f32`, beside `f64`, of b alone.",
        pairs: &[single(BAR), single(VORTEX), single(COLUMN)],
        conclusion: "\
The operations are the same, and twice as many numbers fit into a vector: many points take about half
of the time. [accuracy.md](accuracy.md) has the errors. There is more code, since what needs no X is
computed in `f64`, whose functions are compiled with it, and for `f64` in twice its digits, whose
functions are in `mms-math`.",
    },
];
