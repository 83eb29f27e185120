//! `[boundary]`: the faces of a body, and the claims of a field on them.

use crate::diagnostic::{Diagnostic, quoted};
use crate::domain::{BodySpec, is_zero};
use crate::language::instead_of_claim;
use crate::source::Spanned;
use crate::space::Space;
use crate::table::{Entry, Reader, list};
use crate::value::unknown_word;

/// A named part of a body's boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Face {
    /// The face of a box where the coordinate along this axis is least.
    Min(usize),
    /// The face of a box where the coordinate along this axis is greatest.
    Max(usize),
    /// The inner circle, cylinder or sphere.
    Inner,
    /// The outer circle, cylinder or sphere.
    Outer,
    /// The flat face of a sector at its first angle.
    ThetaMin,
    /// The flat face of a sector at its last angle.
    ThetaMax,
    /// The cone of a sphere at its first angle from +Z.
    PhiMin,
    /// The cone of a sphere at its last angle from +Z.
    PhiMax,
    /// The inner face of an axisymmetric box, where R is least.
    RadialMin,
    /// The outer face of an axisymmetric box, where R is greatest.
    RadialMax,
    /// The face of an axisymmetric box where Z is least.
    AxialMin,
    /// The face of an axisymmetric box where Z is greatest.
    AxialMax,
    /// The edge of a polygon after the vertex at this position, and its name.
    Edge(usize, &'static str),
}

impl Face {
    /// Every face of any body except edges of polygons, which have names of their own.
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
        Face::PhiMin,
        Face::PhiMax,
        Face::RadialMin,
        Face::RadialMax,
        Face::AxialMin,
        Face::AxialMax,
    ];

    /// The key of `[boundary]` that names the face.
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
            Face::PhiMin => "phi_min",
            Face::PhiMax => "phi_max",
            Face::RadialMin => "r_min",
            Face::RadialMax => "r_max",
            Face::AxialMin => "z_min",
            Face::AxialMax => "z_max",
            Face::Edge(_, name) => name,
        }
    }

    /// The faces of a body, in a fixed order.
    pub fn of(body: &BodySpec, space: Space) -> Vec<Face> {
        let mut faces = Face::declared(body, space);
        match body {
            BodySpec::Round(round) => faces.retain(|face| round.has_area(*face)),
            // If R is written as 0, the box ends at the axis, which has no area.
            BodySpec::Box { lower, .. } if lower.first().is_some_and(is_zero) => {
                faces.retain(|face| *face != Face::RadialMin);
            }
            _ => {}
        }
        faces
    }

    /// The faces that the keys of a body define, including those without an area.
    fn declared(body: &BodySpec, space: Space) -> Vec<Face> {
        match body {
            BodySpec::Box { .. } => Face::of_box(space),
            BodySpec::Round(round) => round.declared(),
            BodySpec::Polygon(polygon) => {
                polygon.names.iter().enumerate().map(|(at, name)| Face::Edge(at, name)).collect()
            }
            BodySpec::Nothing => Vec::new(),
        }
    }

    /// The faces of a box, in a fixed order.
    pub fn of_box(space: Space) -> Vec<Face> {
        match space {
            Space::Cartesian(dimension) => {
                (0..dimension).flat_map(|axis| [Face::Min(axis), Face::Max(axis)]).collect()
            }
            Space::Axisymmetric { .. } => {
                vec![Face::RadialMin, Face::RadialMax, Face::AxialMin, Face::AxialMax]
            }
        }
    }
}

/// A claim of a field about a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Claim {
    /// u = 0.
    Fixed,
    /// u.N = 0, and no tangential traction.
    Roller,
    /// P N = 0.
    Free,
    /// u is prescribed: the solver gets its values.
    Prescribed,
    /// P N is prescribed: the solver gets its values.
    Traction,
    /// R = 0, and no point leaves the axis.
    Axis,
}

impl Claim {
    /// Every claim about a face with an area.
    pub const ALL: &[Claim] =
        &[Claim::Fixed, Claim::Roller, Claim::Free, Claim::Prescribed, Claim::Traction];

    /// The claims that a file may make about a face.
    pub fn about(face: Face) -> Vec<Claim> {
        let axis = (face == Face::RadialMin).then_some(Claim::Axis);
        Claim::ALL.iter().copied().chain(axis).collect()
    }

    /// The word for the claim in a field file.
    pub fn name(self) -> &'static str {
        match self {
            Claim::Fixed => "fixed",
            Claim::Roller => "roller",
            Claim::Free => "free",
            Claim::Prescribed => "prescribed",
            Claim::Traction => "traction",
            Claim::Axis => "axis",
        }
    }

    /// The meaning of the claim, in a few words.
    pub fn meaning(self) -> &'static str {
        match self {
            Claim::Fixed => "u = 0",
            Claim::Roller => "u.N = 0 and no tangential traction",
            Claim::Free => "P N = 0",
            Claim::Prescribed => "u is given by the field",
            Claim::Traction => "P N is given by the field",
            Claim::Axis => "R = 0, with u_R = 0 and no swirl",
        }
    }
}

/// A claim about a face.
#[derive(Clone, Debug)]
pub struct BoundarySpec {
    /// The face.
    pub face: Spanned<Face>,
    /// The claim.
    pub claim: Spanned<Claim>,
}

/// Reads `[boundary]`. Without a body, any face of any body is accepted.
pub(super) fn boundary<'a>(
    entry: &Entry<'a>,
    body: Option<&BodySpec>,
    space: Space,
    reader: &mut Reader<'a>,
) -> Vec<BoundarySpec> {
    let Some(table) = reader.open_table(entry, "[boundary]") else { return Vec::new() };
    if body.is_some_and(BodySpec::is_nothing) {
        reader.report(
            Diagnostic::error(entry.key.span, "a field without a body has no faces")
                .label("claims are about faces, and `shape = \"none\"` has none")
                .help("remove [boundary], or add the body of its claims"),
        );
        return Vec::new();
    }
    let faces = body.map_or_else(|| Face::ALL.to_vec(), |body| Face::declared(body, space));
    let mut boundary = Vec::new();
    for entry in &table.entries {
        let face = face(&entry.key, &faces, reader);
        let claims = match &face {
            Some(face) => Claim::about(face.value),
            None => Claim::about(Face::RadialMin),
        };
        let words: Vec<_> = claims.iter().map(|claim| claim.name()).collect();
        let claim = reader.string(entry).and_then(|word| {
            let claim = claims.iter().find(|claim| claim.name() == word.value);
            if claim.is_none() {
                reader.report(unknown_claim(&word, &words));
            }
            Some(Spanned { value: *claim?, span: word.span })
        });
        if let (Some(face), Some(claim)) = (face, claim) {
            boundary.push(BoundarySpec { face, claim });
        }
    }
    boundary
}

fn unknown_claim(word: &Spanned<String>, words: &[&str]) -> Diagnostic {
    let Some(advice) = instead_of_claim(&word.value) else {
        return unknown_word(word, "claim", words);
    };
    let message = format!("unknown claim {}", quoted(&word.value));
    Diagnostic::error(word.span, message).label("no such claim").help(advice)
}

fn face(key: &Spanned<String>, faces: &[Face], reader: &mut Reader<'_>) -> Option<Spanned<Face>> {
    if let Some(face) = faces.iter().find(|face| face.name() == key.value) {
        return Some(Spanned { value: *face, span: key.span });
    }
    let names: Vec<_> = faces.iter().map(|face| face.name()).collect();
    let exists_elsewhere = Face::ALL.iter().any(|face| face.name() == key.value)
        || key.value.strip_prefix("edge_").is_some_and(|number| number.parse::<usize>().is_ok());
    reader.report(if exists_elsewhere {
        Diagnostic::error(key.span, format!("this body has no face `{}`", key.value))
            .label(format!("its faces are {}", list(&names)))
    } else {
        unknown_word(key, "face", &names)
    });
    None
}
