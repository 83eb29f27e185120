//! What a solver is given on the faces of a body: u where the field claims `prescribed` or nothing, N and P N
//! where it claims `traction`. They become functions of their own, such as `x_max_traction`.
//!
//! Normals are exact (`face`), and on a face of a box the coordinate that is constant there is put in before the
//! code is made, so that nothing is computed which a face does not need.

use crate::derivation::Derivation;
use crate::face::{normal, projection};
use crate::model::{Body, Model};
use mms_spec::quantity::Quantity;
use mms_spec::{Claim, Face, FieldSpec};
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;

/// What is given on a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Datum {
    /// The outward reference unit normal N.
    Normal,
    /// u, where it is prescribed.
    Displacement,
    /// P N, where it is.
    Traction,
}

impl Datum {
    /// The word for it in the names of functions.
    pub fn name(self) -> &'static str {
        match self {
            Datum::Normal => "normal",
            Datum::Displacement => "displacement",
            Datum::Traction => "traction",
        }
    }
}

/// What a field gives on each face: u where the file claims `prescribed` or nothing, N and P N where
/// it claims `traction`; N has a component for each coordinate. On a face of a box they do not depend on the coordinate
/// that is constant there.
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

/// With the coordinate replaced that is constant on a face of a box. To project on a circle would
/// cost what it cannot save.
fn on_face(graph: &mut Graph, body: &Body, face: Face, components: &[Expr]) -> Vec<Expr> {
    match body.box_bounds() {
        Some(_) => {
            let point = projection(graph, body, face);
            substitute(graph, components, &point)
        }
        None => components.to_vec(),
    }
}
