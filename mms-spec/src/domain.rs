//! `[domain]` and `[boundary]`: where and when a field lives, and what it claims on its faces.

use crate::diagnostic::Diagnostic;
use crate::format::DOMAIN;
use crate::formula::Formula;
use crate::source::{Span, Spanned};
use crate::table::{Entry, Reader, Table, list};
use crate::value::{plural, unknown_word};

/// The shape of the reference body.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "there is one in a file")]
pub enum Body {
    /// A box with edges along the axes.
    Box {
        /// The least coordinates, one per dimension.
        lower: Vec<Formula>,
        /// The greatest coordinates, one per dimension.
        upper: Vec<Formula>,
    },
    /// The plane region between two circles around the origin, or a sector of it.
    Annulus {
        /// The inner radius.
        inner: Formula,
        /// The outer radius.
        outer: Formula,
        /// The angles between which a sector lies; all around without them.
        theta: Option<[Formula; 2]>,
    },
}

impl Body {
    /// The word for it in a field file.
    pub fn name(&self) -> &'static str {
        match self {
            Body::Box { .. } => "box",
            Body::Annulus { .. } => "annulus",
        }
    }
}

/// The reference body and the time window that all claims are about.
#[derive(Clone, Debug)]
pub struct DomainSpec {
    /// The reference body.
    pub body: Body,
    /// The first and the last time; none of a static field.
    pub time: Option<[Formula; 2]>,
    /// Whether they are not the file's, but were given in its place: then a number is one in the unit of t.
    pub is_moved: bool,
}

/// A named part of a body's boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Face {
    /// The face of a box where the coordinate of that axis is least.
    Min(usize),
    /// The face of a box where the coordinate of that axis is greatest.
    Max(usize),
    /// The inner circle of an annulus.
    Inner,
    /// The outer circle of an annulus.
    Outer,
    /// The straight edge of a sector at its first angle.
    ThetaMin,
    /// The straight edge of a sector at its last angle.
    ThetaMax,
}

impl Face {
    /// Every face of any body.
    pub const ALL: &[Face] = &[
        Face::Min(0),
        Face::Max(0),
        Face::Min(1),
        Face::Max(1),
        Face::Min(2),
        Face::Max(2),
        Face::Inner,
        Face::Outer,
        Face::ThetaMin,
        Face::ThetaMax,
    ];

    /// The key of `[boundary]` that names it.
    pub fn name(self) -> &'static str {
        match self {
            Face::Min(0) => "x_min",
            Face::Max(0) => "x_max",
            Face::Min(1) => "y_min",
            Face::Max(1) => "y_max",
            Face::Min(_) => "z_min",
            Face::Max(_) => "z_max",
            Face::Inner => "inner",
            Face::Outer => "outer",
            Face::ThetaMin => "theta_min",
            Face::ThetaMax => "theta_max",
        }
    }

    /// The faces of a body, in a fixed order.
    pub fn of(body: &Body, dimension: usize) -> Vec<Face> {
        match body {
            Body::Box { .. } => Face::of_box(dimension),
            Body::Annulus { theta, .. } => Face::of_annulus(theta.is_some()),
        }
    }

    /// The faces of a box, in a fixed order.
    pub fn of_box(dimension: usize) -> Vec<Face> {
        (0..dimension).flat_map(|axis| [Face::Min(axis), Face::Max(axis)]).collect()
    }

    /// The faces of an annulus, whole or a sector, in a fixed order.
    pub fn of_annulus(is_sector: bool) -> Vec<Face> {
        let faces = [Face::Inner, Face::Outer, Face::ThetaMin, Face::ThetaMax];
        faces[..if is_sector { 4 } else { 2 }].to_vec()
    }
}

/// What a field claims on a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Claim {
    /// u = 0.
    Fixed,
    /// u.N = 0, and no tangential traction.
    Roller,
    /// P N = 0.
    Free,
    /// The solver is given u.
    Prescribed,
    /// The solver is given P N.
    Traction,
}

impl Claim {
    /// Every claim.
    pub const ALL: &[Claim] =
        &[Claim::Fixed, Claim::Roller, Claim::Free, Claim::Prescribed, Claim::Traction];

    /// The word for it in a field file.
    pub fn name(self) -> &'static str {
        match self {
            Claim::Fixed => "fixed",
            Claim::Roller => "roller",
            Claim::Free => "free",
            Claim::Prescribed => "prescribed",
            Claim::Traction => "traction",
        }
    }

    /// What it says, in a few words.
    pub fn meaning(self) -> &'static str {
        match self {
            Claim::Fixed => "u = 0",
            Claim::Roller => "u.N = 0 and no tangential traction",
            Claim::Free => "P N = 0",
            Claim::Prescribed => "u is given by the field",
            Claim::Traction => "P N is given by the field",
        }
    }
}

/// A claim about a face.
#[derive(Clone, Debug)]
pub struct BoundarySpec {
    /// The face.
    pub face: Spanned<Face>,
    /// What is claimed there.
    pub claim: Spanned<Claim>,
}

/// The words for the shapes of a body.
pub const BODIES: &[&str] = &["box", "annulus"];

/// A domain without content, in place of one whose absence has been reported.
pub(super) fn reported(dimension: usize, span: Span) -> DomainSpec {
    let corner = vec![Formula::reported(span); dimension];
    let body = Body::Box { lower: corner.clone(), upper: corner };
    let time = Some([Formula::reported(span), Formula::reported(span)]);
    DomainSpec { body, time, is_moved: false }
}

/// Reads `[domain]`.
pub(super) fn domain<'a>(
    entry: &Entry<'a>,
    dimension: usize,
    reader: &mut Reader<'a>,
) -> DomainSpec {
    let Some(table) = reader.table(entry, "[domain]", DOMAIN) else {
        return reported(dimension, reader.span(entry.value));
    };
    let shape = reader.required(&table, "shape");
    let named = shape.as_ref().and_then(|shape| reader.word(shape, "shape", BODIES));
    // Without a valid shape the keys tell what was meant.
    let is_annulus = match &named {
        Some(shape) => shape.value == "annulus",
        None => table.get("inner").is_some() || table.get("outer").is_some(),
    };
    let body = if is_annulus {
        if let Some(shape) = named.filter(|_| dimension != 2) {
            let message = format!("an annulus is 2-dimensional, but the field is {dimension}-D");
            reader.report(Diagnostic::error(shape.span, message).label("needs `dimension = 2`"));
        }
        annulus(&table, reader)
    } else {
        cuboid(&table, dimension, reader)
    };
    // A key that was lost or misspelt is not missing.
    let is_lost = reader.is_incomplete() || table.misspelt.contains(&"time");
    let time = match table.get("time") {
        Some(time) => Some(reader.pair(&time, "expected the first and the last time")),
        None if is_lost => Some([Formula::reported(table.span), Formula::reported(table.span)]),
        None => None,
    };
    DomainSpec { body, time, is_moved: false }
}

fn cuboid<'a>(table: &Table<'a>, dimension: usize, reader: &mut Reader<'a>) -> Body {
    for key in ["inner", "outer", "theta"] {
        reader.refuse(table, key, "a box has `lower` and `upper`");
    }
    let reason = one_per_dimension(dimension);
    Body::Box {
        lower: reader.required_formulas(table, "lower", dimension, &reason),
        upper: reader.required_formulas(table, "upper", dimension, &reason),
    }
}

fn annulus<'a>(table: &Table<'a>, reader: &mut Reader<'a>) -> Body {
    for key in ["lower", "upper"] {
        reader.refuse(table, key, "an annulus has `inner`, `outer` and, for a sector, `theta`");
    }
    Body::Annulus {
        inner: reader.required_formula(table, "inner"),
        outer: reader.required_formula(table, "outer"),
        theta: table
            .get("theta")
            .map(|theta| reader.pair(&theta, "expected the first and the last angle")),
    }
}

/// Why a vector must have so many components.
pub(super) fn one_per_dimension(dimension: usize) -> String {
    format!("a {dimension}-D field has {}", plural(dimension, "component"))
}

/// Reads `[boundary]`. Without a body, any face of any body will do.
pub(super) fn boundary<'a>(
    entry: &Entry<'a>,
    body: Option<&Body>,
    dimension: usize,
    reader: &mut Reader<'a>,
) -> Vec<BoundarySpec> {
    let Some(table) = reader.open_table(entry, "[boundary]") else { return Vec::new() };
    let faces = body.map_or_else(|| Face::ALL.to_vec(), |body| Face::of(body, dimension));
    let claims: Vec<_> = Claim::ALL.iter().map(|claim| claim.name()).collect();
    let mut boundary = Vec::new();
    for entry in &table.entries {
        let face = face(&entry.key, &faces, reader);
        let claim = reader.word(entry, "claim", &claims).and_then(|word| {
            let claim = Claim::ALL.iter().find(|claim| claim.name() == word.value)?;
            Some(Spanned { value: *claim, span: word.span })
        });
        if let (Some(face), Some(claim)) = (face, claim) {
            boundary.push(BoundarySpec { face, claim });
        }
    }
    boundary
}

fn face(key: &Spanned<String>, faces: &[Face], reader: &mut Reader<'_>) -> Option<Spanned<Face>> {
    if let Some(face) = faces.iter().find(|face| face.name() == key.value) {
        return Some(Spanned { value: *face, span: key.span });
    }
    let names: Vec<_> = faces.iter().map(|face| face.name()).collect();
    let exists_elsewhere = Face::ALL.iter().any(|face| face.name() == key.value);
    reader.report(if exists_elsewhere {
        Diagnostic::error(key.span, format!("this body has no face `{}`", key.value))
            .label(format!("its faces are {}", list(&names)))
    } else {
        unknown_word(key, "face", &names)
    });
    None
}
