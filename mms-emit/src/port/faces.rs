//! The faces of the body, and the claim on each.

use super::Port;
use mms_spec::{Claim, Face, FieldSpec};

/// The claim on each face of the body, in the order of faces.
pub fn claims(field: &FieldSpec) -> Vec<(Face, Claim)> {
    let claim = |face: Face| {
        let claimed = field.boundary.iter().find(|it| it.face.value == face);
        // A face without a claim is prescribed.
        claimed.map_or(Claim::Prescribed, |it| it.claim.value)
    };
    let faces = Face::of(&field.domain.body, field.space);
    faces.into_iter().map(|face| (face, claim(face))).collect()
}

/// The comment above the claims in emitted code.
pub const DOC: &str = "The claim on each face of the body.";

impl Port<'_> {
    /// The names of faces, each with the word for its claim.
    pub fn faces(&self) -> Vec<[&'static str; 2]> {
        let claims = claims(&self.compiled.field).into_iter();
        claims.map(|(face, claim)| [face.name(), claim.name()]).collect()
    }

    /// A line for each face.
    pub fn claims(&self, line: impl Fn(&str, &str) -> String) -> String {
        self.faces().into_iter().map(|[face, claim]| line(face, claim) + "\n").collect()
    }
}
