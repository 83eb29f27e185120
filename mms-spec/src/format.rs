//! Format 1 as data: the keys of each table, the type of each value, and one sentence about it.
//!
//! The reader and the JSON Schema for editors are both made from this table, so they have the same keys. A schema checks form,
//! not meaning: it refuses the files that the reader refuses, except for wrong uses of names that the file itself defines, and
//! for numbers that do not increase. This table lacks conditions that depend on other values (the number of components, the
//! faces): the reader checks them, and `mms-command/src/schema/conditions.rs` states them for the schema. Tests compare both.

use crate::boundary::{Claim, Face};
use crate::domain::BodyShape;
use crate::names::ReservingFile;
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
    pub value_type: ValueType,
    /// The description, in a sentence or two.
    pub doc: &'static str,
}

/// The type of the value of a key.
#[derive(Debug)]
pub enum ValueType {
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
    Names(ReservingFile, &'static ValueType),
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

const fn required(name: &'static str, holds: ValueType, doc: &'static str) -> Key {
    Key { name, required: true, value_type: holds, doc }
}

const fn optional(name: &'static str, holds: ValueType, doc: &'static str) -> Key {
    Key { name, required: false, value_type: holds, doc }
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
    required("field", ValueType::Table(FIELD), "The field: its title, dimension and coordinates."),
    optional(
        "parameters",
        ValueType::Names(ReservingFile::Field, &ValueType::Table(PARAMETER)),
        "Numbers that users of the field may change.",
    ),
    optional(
        "let",
        ValueType::Names(ReservingFile::Field, &ValueType::Formula),
        "Names for formulas, in order: each may use those above it.",
    ),
    optional(
        "given",
        ValueType::Names(ReservingFile::Field, &ValueType::Table(GIVEN)),
        "Given fields of the file's own, such as a temperature: functions of X and t.",
    ),
    required(
        "displacement",
        ValueType::Table(DISPLACEMENT),
        "The displacement; every other quantity follows from it.",
    ),
    required(
        "material",
        ValueType::Material(MATERIAL),
        "The strain-energy density: a model, a formula for each of its parameters, the density.",
    ),
    required(
        "domain",
        ValueType::Table(DOMAIN),
        "The reference body, and the time window that all claims are about.",
    ),
    optional(
        "boundary",
        ValueType::Faces,
        "The claim about each face. An omitted face claims nothing.",
    ),
    optional(
        "balance",
        ValueType::Tables(BALANCE),
        "Further balances of a coupled code, such as the heat balance; their sources are derived.",
    ),
    optional("check", ValueType::Tables(CHECK), "Closed forms that were derived on paper."),
    optional(
        "study",
        ValueType::Tables(STUDY),
        "The orders that the solver must show on the field.",
    ),
    optional("extreme", ValueType::Tables(EXTREME), "Parameters at their limits."),
    optional(
        "rigid",
        ValueType::Table(RIGID),
        "A rigid motion of the whole on top of the displacement: the rigid twin of the field.",
    ),
];

/// `[field]`.
pub const FIELD: &[Key] = &[
    required("title", ValueType::Text, "A title for the field, in a few words."),
    required("dimension", ValueType::Dimension, "The number of reference coordinates: 1, 2 or 3."),
    optional(
        "coordinates",
        ValueType::Word(|| Space::WORDS.to_vec()),
        "The coordinates: cartesian by default; axisymmetric, which are R and Z, with dimension = 2.",
    ),
    optional("reference", ValueType::Text, "The authors and the publication."),
];

/// One of `[parameters]`.
pub const PARAMETER: &[Key] = &[
    required(
        "value",
        ValueType::Formula,
        "The value by default: a formula of numbers, pi and the parameters above.",
    ),
    optional("unit", ValueType::Text, "The unit, such as kg/m^3."),
    optional("symbol", ValueType::Text, "The symbol in LaTeX, such as E or \\lambda."),
    optional("doc", ValueType::Text, "A description, in a few words."),
    optional(
        "range",
        ValueType::Formulas(Length::Exactly(2)),
        "The least and the greatest value that it may take.",
    ),
];

/// One of `[given]`.
pub const GIVEN: &[Key] = &[
    required(
        "value",
        ValueType::Formula,
        "The function of X and t; it may use the names above it.",
    ),
    optional("unit", ValueType::Text, "The unit, such as K."),
    optional("doc", ValueType::Text, "A description, in a few words."),
];

/// `[[balance]]`.
pub const BALANCE: &[Key] = &[
    required("name", ValueType::Name, "The name; the names of its quantities start with it."),
    optional("storage", ValueType::Formula, "The amount that is stored per reference volume."),
    optional(
        "flux",
        ValueType::Formulas(Length::Dimension),
        "The flux through reference area: one formula per direction.",
    ),
    optional(
        "residual",
        ValueType::Formula,
        "The left side of a constraint, in place of the others.",
    ),
];

/// `[displacement]`.
pub const DISPLACEMENT: &[Key] = &[
    required(
        "u",
        ValueType::Formulas(Length::Dimension),
        "The displacement u(X, t): one formula per dimension.",
    ),
    optional(
        "swirl",
        ValueType::Formula,
        "The displacement along the hoop of an axisymmetric field: a length.",
    ),
];

/// `[material]` of a field, without the parameters of the model.
pub const MATERIAL: &[Key] = &[
    required(
        "model",
        ValueType::Model,
        "A shipped material, or the path of a material file, relative to this file.",
    ),
    optional(
        "density",
        ValueType::Formula,
        "The reference density; it may depend on X. A field without a time window may leave it out.",
    ),
    optional(
        "fibre",
        ValueType::Formulas(Length::Exactly(3)),
        "The unit reference direction, in space, of the fibres of a material that uses I4.",
    ),
];

/// `[domain]`.
pub const DOMAIN: &[Key] = &[
    required("shape", ValueType::Word(BodyShape::words), "The shape of the reference body."),
    optional(
        "lower",
        ValueType::Formulas(Length::Dimension),
        "The least coordinates of a box, one per dimension.",
    ),
    optional(
        "upper",
        ValueType::Formulas(Length::Dimension),
        "The greatest coordinates of a box, one per dimension.",
    ),
    optional(
        "inner",
        ValueType::Formula,
        "The inner radius of an annulus, a cylinder or a sphere around the origin; it may be 0.",
    ),
    optional(
        "outer",
        ValueType::Formula,
        "The outer radius of an annulus, a disk, a cylinder or a sphere around the origin.",
    ),
    optional(
        "theta",
        ValueType::Formulas(Length::Exactly(2)),
        "The first and the last angle about the axis Z of a sector; all around without them.",
    ),
    optional(
        "z",
        ValueType::Formulas(Length::Exactly(2)),
        "The lower and the upper end of a cylinder, whose axis is Z.",
    ),
    optional(
        "phi",
        ValueType::Formulas(Length::Exactly(2)),
        "The first and the last angle from +Z of a part of a sphere; from 0 to pi without them.",
    ),
    optional(
        "vertices",
        ValueType::Vertices,
        "The vertices of a polygon, in their order around it.",
    ),
    optional(
        "names",
        ValueType::Words,
        "The names of the edges of a polygon, in the order of the vertices that they start from.",
    ),
    optional(
        "time",
        ValueType::Formulas(Length::Exactly(2)),
        "The first and the last time; none of a static field, whose formulas have no t.",
    ),
];

/// `[[check]]`.
pub const CHECK: &[Key] = &[
    required("quantity", ValueType::Quantity, "The quantity that the closed form must equal."),
    required(
        "equals",
        ValueType::Formulas(Length::Quantity),
        "Its components, row by row; they must agree to a relative 1e-20.",
    ),
    optional(
        "let",
        ValueType::Names(ReservingFile::Field, &ValueType::Formula),
        "Names for formulas, for this check alone.",
    ),
    optional("source", ValueType::Text, "Where the closed form comes from."),
];

/// `[[study]]`.
pub const STUDY: &[Key] = &[
    optional(
        "shape",
        ValueType::Word(|| SHAPES.to_vec()),
        "The shape function; cpgimp by default.",
    ),
    optional(
        "integrator",
        ValueType::Word(|| INTEGRATORS.to_vec()),
        "The time integrator; leapfrog by default.",
    ),
    optional(
        "formulation",
        ValueType::Word(|| FORMULATIONS.to_vec()),
        "The formulation; updated by default.",
    ),
    optional("transfer", ValueType::Word(|| TRANSFERS.to_vec()), "The transfer; flip by default."),
    optional(
        "courant",
        ValueType::Positive,
        "time_step * c0 / cell_size, c0 the fastest wave speed.",
    ),
    optional("particles_per_cell", ValueType::Count, "Particles per cell and direction."),
    optional(
        "fill",
        ValueType::Word(|| FILLS.to_vec()),
        "How the body is filled with particles: on the cells, or fitted to the body.",
    ),
    optional("precision", ValueType::Word(|| PRECISIONS.to_vec()), "The solver's precision."),
    optional(
        "form",
        ValueType::Word(|| FORMS.to_vec()),
        "How the field's quantities are computed; stable by default.",
    ),
    optional(
        "cells",
        ValueType::Levels,
        "The levels, coarse to fine: cells along the longest edge of the body.",
    ),
    optional("order", ValueType::Positive, "The order that the levels must show; 2 by default."),
    optional("tolerance", ValueType::Positive, "By how much it may differ; 0.15 by default."),
    optional("reason", ValueType::Text, "Why theory says so."),
];

/// `[[extreme]]`.
pub const EXTREME: &[Key] = &[
    required(
        "name",
        ValueType::Text,
        "The extreme property, in a few words; each name is different.",
    ),
    required(
        "set",
        ValueType::Names(ReservingFile::Field, &ValueType::Formula),
        "The parameters that differ from their defaults.",
    ),
];

/// `[rigid]`.
pub const RIGID: &[Key] = &[
    optional(
        "rotation",
        ValueType::Rotation(ROTATION),
        "The rotation about the origin: an angle in 2-D, an axis and an angle in 3-D.",
    ),
    optional(
        "translation",
        ValueType::Formulas(Length::Dimension),
        "The translation: one formula per dimension.",
    ),
];

/// A text with a rigid motion alone.
pub(super) const RIGID_ALONE: &[Key] =
    &[required("rigid", ValueType::Table(RIGID), "The rigid motion.")];

/// `rotation` in space.
pub const ROTATION: &[Key] = &[
    required(
        "axis",
        ValueType::Formulas(Length::Exactly(3)),
        "The axis: three components, of any length.",
    ),
    required("angle", ValueType::Formula, "The angle, in radians."),
];

/// A material file.
pub const MATERIAL_FILE: &[Key] = &[
    required(
        "material",
        ValueType::Table(MATERIAL_HEADER),
        "The material: its title and its energy.",
    ),
    optional(
        "parameters",
        ValueType::Names(ReservingFile::Material, &ValueType::Table(MATERIAL_PARAMETER)),
        "The parameters; each field gives a formula for them.",
    ),
    optional(
        "given",
        ValueType::Names(ReservingFile::Material, &ValueType::Table(MATERIAL_GIVEN)),
        "The given fields that W uses, such as a pressure: each field gives a formula of X and t.",
    ),
    optional(
        "let",
        ValueType::Names(ReservingFile::Material, &ValueType::Formula),
        "Names for formulas, in order: each may use those above it.",
    ),
];

/// `[material]` of a material file.
pub const MATERIAL_HEADER: &[Key] = &[
    required("title", ValueType::Text, "A title for the material, in a few words."),
    optional("reference", ValueType::Text, "The authors and the publication."),
    required(
        "strain_energy",
        ValueType::Formula,
        "W per reference volume, in I1, I2, I3, J and I4, or in eps_trace and eps_squared.",
    ),
    optional(
        "frame_indifferent",
        ValueType::Flag,
        "Whether W stays the same under rotations; it does by default, unless it is written in the small strain.",
    ),
];

/// One of the `[parameters]` of a material.
pub const MATERIAL_PARAMETER: &[Key] = &[
    optional("unit", ValueType::Text, "The unit, such as Pa."),
    optional("doc", ValueType::Text, "A description, in a few words."),
];

/// One of the `[given]` of a material.
pub const MATERIAL_GIVEN: &[Key] = &[
    optional("unit", ValueType::Text, "The unit, such as Pa."),
    optional("doc", ValueType::Text, "A description, in a few words."),
    optional(
        "rest",
        ValueType::Formula,
        "The value in the state of rest, at which the material is judged; 0 if left out.",
    ),
];
