//! The data for a solver on the faces of a body: u if the field claims `prescribed` or nothing, N and P N if it claims
//! `traction`. They become functions of their own, such as `x_max_traction`.
//!
//! Normals are exact (`face`). On a face of a box the constant coordinate is substituted before the code is made, so that the
//! code of a face computes nothing that the face does not need.

use crate::derivation::Derivation;
use crate::face::{normal, projection};
use crate::model::{Body, Model};
use mms_spec::quantity::Quantity;
use mms_spec::{Claim, Face, FieldSpec};
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;

/// One item of the data on a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Datum {
    /// The outward reference unit normal N.
    Normal,
    /// u, on a face with prescribed displacement.
    Displacement,
    /// P N, on a face with prescribed traction.
    Traction,
}

impl Datum {
    /// The name of the datum in the names of functions.
    pub fn name(self) -> &'static str {
        match self {
            Datum::Normal => "normal",
            Datum::Displacement => "displacement",
            Datum::Traction => "traction",
        }
    }
}

/// The data of a field on each face: u if the file claims `prescribed` or nothing, N and P N if it claims `traction`; N has a
/// component for each coordinate. On a face of a box they do not depend on the coordinate that is constant there.
pub fn data(
    graph: &mut Graph,
    model: &Model,
    field: &FieldSpec,
    derivation: &Derivation,
) -> SortedMap<(Face, Datum), Vec<Expr>> {
    let dimension = model.space.coordinates();
    let mut data = SortedMap::new();
    for face in Face::of(&field.domain.body, model.space) {
        let claim = field.boundary.iter().find(|boundary| boundary.face.value == face);
        match claim.map_or(Claim::Prescribed, |claim| claim.claim.value) {
            Claim::Fixed | Claim::Roller | Claim::Free | Claim::Axis => {}
            Claim::Prescribed => {
                let displacement = &derivation.quantities[&Quantity::Displacement];
                let given = on_face(graph, &model.domain.body, face, displacement);
                data.insert((face, Datum::Displacement), given);
            }
            Claim::Traction => {
                let normal = normal(graph, &model.domain.body, dimension, face);
                let components = (0..dimension).map(Symbol::Normal).zip(normal.iter().copied());
                let traction = &derivation.quantities[&Quantity::Traction];
                let traction = substitute(graph, traction, &components.collect());
                let given = on_face(graph, &model.domain.body, face, &traction);
                data.insert((face, Datum::Normal), normal);
                data.insert((face, Datum::Traction), given);
            }
        }
    }
    data
}

/// Replaces the coordinate that is constant on a face of a box. A projection on a circle would cost more than it saves.
fn on_face(graph: &mut Graph, body: &Body, face: Face, components: &[Expr]) -> Vec<Expr> {
    match body.box_bounds() {
        Some(_) => {
            let point = projection(graph, body, face);
            substitute(graph, components, &point)
        }
        None => components.to_vec(),
    }
}
