//! Format 1 as data: the keys of each table, the type of each value, and one sentence about it.
//!
//! The reader and the JSON Schema for editors are both made from this table, so they have the same keys. A schema checks form,
//! not meaning: it refuses the files that the reader refuses, except for wrong uses of names that the file itself defines, and
//! for numbers that do not increase. This table lacks conditions that depend on other values (the number of components, the
//! faces): the reader checks them, and `mms-command/src/schema/conditions.rs` states them for the schema. Tests compare both.

use crate::boundary::{Claim, Face};
use crate::domain::Shape;
use crate::names::Keeper;
use crate::quantity::Quantity;
use crate::space::Space;
use crate::study::{FILLS, FORMS, FORMULATIONS, INTEGRATORS, PRECISIONS, SHAPES, TRANSFERS};

/// A key of a table.
#[derive(Debug)]
pub struct Key {
    /// The name of the key.
    pub name: &'static str,
    /// Whether every such table must have the key.
    pub required: bool,
    /// The type of its value.
    pub holds: Holds,
    /// The description, in a sentence or two.
    pub doc: &'static str,
}

/// The type of the value of a key.
#[derive(Debug)]
pub enum Holds {
    /// A string for people.
    Text,
    /// True or false.
    Flag,
    /// 1, 2 or 3.
    Dimension,
    /// A whole number from 1 on.
    Count,
    /// A positive number that is no part of the field's mathematics.
    Positive,
    /// The cells of each level, coarse to fine: at least two increasing whole numbers.
    Levels,
    /// The name of a quantity: one of every field, or of the file's own.
    Quantity,
    /// One of these words.
    Word(fn() -> Vec<&'static str>),
    /// A shipped material's name, or the path of a material file.
    Model,
    /// An expression as a string, or a bare number.
    Formula,
    /// An array of formulas.
    Formulas(Length),
    /// An array of pairs of formulas: points of a plane.
    Vertices,
    /// A name of the file's own, in small letters.
    Name,
    /// An array of such names, all different.
    Words,
    /// A table with these keys.
    Table(&'static [Key]),
    /// An array of tables with these keys.
    Tables(&'static [Key]),
    /// A table whose keys are names of the file's own.
    Names(Keeper, &'static Holds),
    /// A table with these keys, and a formula for each parameter of the material.
    Material(&'static [Key]),
    /// A claim for each face of the body.
    Faces,
    /// A formula in the plane, a table with these keys in space.
    Rotation(&'static [Key]),
}

/// The number of formulas of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Length {
    /// One per dimension of the field.
    Dimension,
    /// One per component of the table's quantity.
    Quantity,
    /// Exactly this number of formulas.
    Exactly(usize),
}

const fn required(name: &'static str, holds: Holds, doc: &'static str) -> Key {
    Key { name, required: true, holds, doc }
}

const fn optional(name: &'static str, holds: Holds, doc: &'static str) -> Key {
    Key { name, required: false, holds, doc }
}

/// The names of keys, in their order.
pub fn names(keys: &[Key]) -> Vec<&'static str> {
    keys.iter().map(|key| key.name).collect()
}

/// The words for a quantity in a `[[check]]`: identifiers, then symbols.
pub fn quantities() -> Vec<&'static str> {
    let symbols = Quantity::pointwise()
        .filter(|quantity| Quantity::from_name(quantity.symbol()) == Some(*quantity))
        .map(Quantity::symbol);
    let mut words: Vec<_> = Quantity::pointwise().map(Quantity::name).collect();
    for symbol in symbols {
        if !words.contains(&symbol) {
            words.push(symbol);
        }
    }
    words
}

/// The words for claims about a face.
pub fn claims(face: Face) -> Vec<&'static str> {
    Claim::about(face).into_iter().map(Claim::name).collect()
}

/// A field file.
pub const FIELD_FILE: &[Key] = &[
    required("field", Holds::Table(FIELD), "The field: its title, dimension and coordinates."),
    optional(
        "parameters",
        Holds::Names(Keeper::Field, &Holds::Table(PARAMETER)),
        "Numbers that users of the field may change.",
    ),
    optional(
        "let",
        Holds::Names(Keeper::Field, &Holds::Formula),
        "Names for formulas, in order: each may use those above it.",
    ),
    optional(
        "given",
        Holds::Names(Keeper::Field, &Holds::Table(GIVEN)),
        "Given fields of the file's own, such as a temperature: functions of X and t.",
    ),
    required(
        "displacement",
        Holds::Table(DISPLACEMENT),
        "The displacement; every other quantity follows from it.",
    ),
    required(
        "material",
        Holds::Material(MATERIAL),
        "The strain-energy density: a model, a formula for each of its parameters, the density.",
    ),
    required(
        "domain",
        Holds::Table(DOMAIN),
        "The reference body, and the time window that all claims are about.",
    ),
    optional(
        "boundary",
        Holds::Faces,
        "The claim about each face. An omitted face claims nothing.",
    ),
    optional(
        "balance",
        Holds::Tables(BALANCE),
        "Further balances of a coupled code, such as the heat balance; their sources are derived.",
    ),
    optional("check", Holds::Tables(CHECK), "Closed forms that were derived on paper."),
    optional("study", Holds::Tables(STUDY), "The orders that the solver must show on the field."),
    optional("extreme", Holds::Tables(EXTREME), "Parameters at their limits."),
    optional(
        "rigid",
        Holds::Table(RIGID),
        "A rigid motion of the whole on top of the displacement: the rigid twin of the field.",
    ),
];

/// `[field]`.
pub const FIELD: &[Key] = &[
    required("title", Holds::Text, "A title for the field, in a few words."),
    required("dimension", Holds::Dimension, "The number of reference coordinates: 1, 2 or 3."),
    optional(
        "coordinates",
        Holds::Word(|| Space::WORDS.to_vec()),
        "The coordinates: cartesian by default; axisymmetric, which are R and Z, with dimension = 2.",
    ),
    optional("reference", Holds::Text, "The authors and the publication."),
];

/// One of `[parameters]`.
pub const PARAMETER: &[Key] = &[
    required(
        "value",
        Holds::Formula,
        "The value by default: a formula of numbers, pi and the parameters above.",
    ),
    optional("unit", Holds::Text, "The unit, such as kg/m^3."),
    optional("symbol", Holds::Text, "The symbol in LaTeX, such as E or \\lambda."),
    optional("doc", Holds::Text, "A description, in a few words."),
    optional(
        "range",
        Holds::Formulas(Length::Exactly(2)),
        "The least and the greatest value that it may take.",
    ),
];

/// One of `[given]`.
pub const GIVEN: &[Key] = &[
    required("value", Holds::Formula, "The function of X and t; it may use the names above it."),
    optional("unit", Holds::Text, "The unit, such as K."),
    optional("doc", Holds::Text, "A description, in a few words."),
];

/// `[[balance]]`.
pub const BALANCE: &[Key] = &[
    required("name", Holds::Name, "The name; the names of its quantities start with it."),
    optional("storage", Holds::Formula, "The amount that is stored per reference volume."),
    optional(
        "flux",
        Holds::Formulas(Length::Dimension),
        "The flux through reference area: one formula per direction.",
    ),
    optional("residual", Holds::Formula, "The left side of a constraint, in place of the others."),
];

/// `[displacement]`.
pub const DISPLACEMENT: &[Key] = &[
    required(
        "u",
        Holds::Formulas(Length::Dimension),
        "The displacement u(X, t): one formula per dimension.",
    ),
    optional(
        "swirl",
        Holds::Formula,
        "The displacement along the hoop of an axisymmetric field: a length.",
    ),
];

/// `[material]` of a field, without the parameters of the model.
pub const MATERIAL: &[Key] = &[
    required(
        "model",
        Holds::Model,
        "A shipped material, or the path of a material file, relative to this file.",
    ),
    optional(
        "density",
        Holds::Formula,
        "The reference density; it may depend on X. A field without a time window may leave it out.",
    ),
    optional(
        "fibre",
        Holds::Formulas(Length::Exactly(3)),
        "The unit reference direction, in space, of the fibres of a material that uses I4.",
    ),
];

/// `[domain]`.
pub const DOMAIN: &[Key] = &[
    required("shape", Holds::Word(Shape::words), "The shape of the reference body."),
    optional(
        "lower",
        Holds::Formulas(Length::Dimension),
        "The least coordinates of a box, one per dimension.",
    ),
    optional(
        "upper",
        Holds::Formulas(Length::Dimension),
        "The greatest coordinates of a box, one per dimension.",
    ),
    optional(
        "inner",
        Holds::Formula,
        "The inner radius of an annulus, a cylinder or a sphere around the origin; it may be 0.",
    ),
    optional(
        "outer",
        Holds::Formula,
        "The outer radius of an annulus, a disk, a cylinder or a sphere around the origin.",
    ),
    optional(
        "theta",
        Holds::Formulas(Length::Exactly(2)),
        "The first and the last angle about the axis Z of a sector; all around without them.",
    ),
    optional(
        "z",
        Holds::Formulas(Length::Exactly(2)),
        "The lower and the upper end of a cylinder, whose axis is Z.",
    ),
    optional(
        "phi",
        Holds::Formulas(Length::Exactly(2)),
        "The first and the last angle from +Z of a part of a sphere; from 0 to pi without them.",
    ),
    optional("vertices", Holds::Vertices, "The vertices of a polygon, in their order around it."),
    optional(
        "names",
        Holds::Words,
        "The names of the edges of a polygon, in the order of the vertices that they start from.",
    ),
    optional(
        "time",
        Holds::Formulas(Length::Exactly(2)),
        "The first and the last time; none of a static field, whose formulas have no t.",
    ),
];

/// `[[check]]`.
pub const CHECK: &[Key] = &[
    required("quantity", Holds::Quantity, "The quantity that the closed form must equal."),
    required(
        "equals",
        Holds::Formulas(Length::Quantity),
        "Its components, row by row; they must agree to a relative 1e-20.",
    ),
    optional(
        "let",
        Holds::Names(Keeper::Field, &Holds::Formula),
        "Names for formulas, for this check alone.",
    ),
    optional("source", Holds::Text, "Where the closed form comes from."),
];

/// `[[study]]`.
pub const STUDY: &[Key] = &[
    optional("shape", Holds::Word(|| SHAPES.to_vec()), "The shape function; cpgimp by default."),
    optional(
        "integrator",
        Holds::Word(|| INTEGRATORS.to_vec()),
        "The time integrator; leapfrog by default.",
    ),
    optional(
        "formulation",
        Holds::Word(|| FORMULATIONS.to_vec()),
        "The formulation; updated by default.",
    ),
    optional("transfer", Holds::Word(|| TRANSFERS.to_vec()), "The transfer; flip by default."),
    optional("courant", Holds::Positive, "time_step * c0 / cell_size, c0 the fastest wave speed."),
    optional("particles_per_cell", Holds::Count, "Particles per cell and direction."),
    optional(
        "fill",
        Holds::Word(|| FILLS.to_vec()),
        "How the body is filled with particles: on the cells, or fitted to the body.",
    ),
    optional("precision", Holds::Word(|| PRECISIONS.to_vec()), "The solver's precision."),
    optional(
        "form",
        Holds::Word(|| FORMS.to_vec()),
        "How the field's quantities are computed; stable by default.",
    ),
    optional(
        "cells",
        Holds::Levels,
        "The levels, coarse to fine: cells along the longest edge of the body.",
    ),
    optional("order", Holds::Positive, "The order that the levels must show; 2 by default."),
    optional("tolerance", Holds::Positive, "By how much it may differ; 0.15 by default."),
    optional("reason", Holds::Text, "Why theory says so."),
];

/// `[[extreme]]`.
pub const EXTREME: &[Key] = &[
    required("name", Holds::Text, "The extreme property, in a few words; each name is different."),
    required(
        "set",
        Holds::Names(Keeper::Field, &Holds::Formula),
        "The parameters that differ from their defaults.",
    ),
];

/// `[rigid]`.
pub const RIGID: &[Key] = &[
    optional(
        "rotation",
        Holds::Rotation(ROTATION),
        "The rotation about the origin: an angle in 2-D, an axis and an angle in 3-D.",
    ),
    optional(
        "translation",
        Holds::Formulas(Length::Dimension),
        "The translation: one formula per dimension.",
    ),
];

/// A text with a rigid motion alone.
pub(super) const RIGID_ALONE: &[Key] =
    &[required("rigid", Holds::Table(RIGID), "The rigid motion.")];

/// `rotation` in space.
pub const ROTATION: &[Key] = &[
    required(
        "axis",
        Holds::Formulas(Length::Exactly(3)),
        "The axis: three components, of any length.",
    ),
    required("angle", Holds::Formula, "The angle, in radians."),
];

/// A material file.
pub const MATERIAL_FILE: &[Key] = &[
    required("material", Holds::Table(MATERIAL_HEADER), "The material: its title and its energy."),
    optional(
        "parameters",
        Holds::Names(Keeper::Material, &Holds::Table(MATERIAL_PARAMETER)),
        "The parameters; each field gives a formula for them.",
    ),
    optional(
        "given",
        Holds::Names(Keeper::Material, &Holds::Table(MATERIAL_GIVEN)),
        "The given fields that W uses, such as a pressure: each field gives a formula of X and t.",
    ),
    optional(
        "let",
        Holds::Names(Keeper::Material, &Holds::Formula),
        "Names for formulas, in order: each may use those above it.",
    ),
];

/// `[material]` of a material file.
pub const MATERIAL_HEADER: &[Key] = &[
    required("title", Holds::Text, "A title for the material, in a few words."),
    optional("reference", Holds::Text, "The authors and the publication."),
    required(
        "strain_energy",
        Holds::Formula,
        "W per reference volume, in I1, I2, I3, J and I4, or in eps_trace and eps_squared.",
    ),
    optional(
        "frame_indifferent",
        Holds::Flag,
        "Whether W stays the same under rotations; it does by default, unless it is written in the small strain.",
    ),
];

/// One of the `[parameters]` of a material.
pub const MATERIAL_PARAMETER: &[Key] = &[
    optional("unit", Holds::Text, "The unit, such as Pa."),
    optional("doc", Holds::Text, "A description, in a few words."),
];

/// One of the `[given]` of a material.
pub const MATERIAL_GIVEN: &[Key] = &[
    optional("unit", Holds::Text, "The unit, such as Pa."),
    optional("doc", Holds::Text, "A description, in a few words."),
    optional(
        "rest",
        Holds::Formula,
        "The value in the state of rest, at which the material is judged; 0 if left out.",
    ),
];
