//! The fields of the gallery that test the most of an external solver: a verification matrix for it.
//!
//! A field shows the terms of the equations that do not vanish in it, its dimension, its material and the kinds of its faces.
//! From the fields that a solver can run, this module chooses the smallest set that shows every term that one of them shows.
//! For terms that no such field shows, the report names a field that shows them and the abilities that the solver needs for it.

use std::collections::{BTreeMap, BTreeSet};

use anyhow::anyhow;
use mms_analysis::visibility::{Span, Status, Term, Visibility};
use mms_campaign::Capabilities;
use mms_campaign::coverage::{Candidate, smallest};
use mms_codegen::Options;
use mms_exact::gallery;
use mms_exact::wave::sound;
use mms_exact::{Input, Open};
use mms_mechanics::TooLarge;
use mms_runtime::Division;
use mms_spec::{Claim, FieldSpec};
use mms_symbolic::sorted::SortedMap;

/// The proposed studies, and the terms that none of them shows.
pub struct Suggestion {
    /// The fields, the cheapest first.
    pub fields: Vec<Proposed>,
    /// A motion without an error in space, to test time alone.
    pub affine: Option<Affine>,
    /// Terms that are absent from all fields that the solver can run.
    pub unseen: Vec<Unseen>,
}

/// A field with the meshes of a study.
pub struct Proposed {
    /// The name of the field.
    pub name: String,
    /// Cells along the longest edge of the body.
    pub cells: &'static [usize],
    /// The terms that no cheaper field of the set shows.
    pub shows: Vec<String>,
}

/// A field that linear shape functions represent exactly.
pub struct Affine {
    /// The name of the field.
    pub name: String,
    /// dt, halved from level to level.
    pub time_steps: Vec<f64>,
    /// Whether an integrator of constant acceleration is exact for it.
    pub is_quadratic: bool,
}

/// A field that the solver cannot run.
#[derive(Clone)]
pub struct Needing {
    /// The name of the field.
    pub field: String,
    /// The keys of `can` that exclude the field.
    pub keys: Vec<&'static str>,
}

/// A term that no proposed field shows.
pub struct Unseen {
    /// The term.
    pub term: String,
    /// The part of the solver that stays untested.
    pub means: &'static str,
    /// The field that shows it and needs the fewest keys.
    pub shown_by: Option<Needing>,
}

/// The cells in the study of a motion without an error in space.
const CELLS: usize = 4;

/// A field of the gallery, and the terms that it shows.
struct FieldTerms {
    input: Input,
    /// The keys of `can` that exclude the field.
    needs: Vec<&'static str>,
    terms: BTreeMap<String, &'static str>,
    visibility: Visibility,
    cells: &'static [usize],
}

/// Proposes studies of fields whose law the solver has. Opens and derives only these fields.
///
/// # Errors
/// A field of the gallery that does not compile.
pub fn suggest(can: &Capabilities, open: Open<'_>) -> anyhow::Result<Suggestion> {
    let mut shown = Vec::new();
    let is_known = |field: &FieldSpec| {
        let is_law = can.materials.iter().any(|it| it == material(field));
        // A solver in Cartesian coordinates need not test axisymmetric fields.
        is_law && (can.axisymmetric || !field.space.is_axisymmetric())
    };
    for field in gallery::fields().iter().filter(|field| is_known(field)) {
        shown.push(FieldTerms::new(field.name.raw(), can, open)?);
    }
    let allowed: Vec<&FieldTerms> = shown.iter().filter(|it| it.needs.is_empty()).collect();
    let candidates: Vec<Candidate> = allowed.iter().map(|it| it.candidate()).collect();
    let mut seen = BTreeSet::new();
    let mut fields = Vec::new();
    for at in smallest(&candidates) {
        let terms = candidates[at].terms.iter().filter(|term| !seen.contains(*term));
        let shows: Vec<String> = terms.cloned().collect();
        seen.extend(shows.iter().cloned());
        let it = allowed[at];
        fields.push(Proposed { name: it.input.name.raw().to_owned(), cells: it.cells, shows });
    }
    Ok(Suggestion { fields, affine: affine(&allowed), unseen: unseen(&shown, &seen, can) })
}

impl FieldTerms {
    fn new(name: &str, can: &Capabilities, open: Open<'_>) -> anyhow::Result<Self> {
        let input = Input::new(open(name)?, &Options::default())?;
        let visibility = Visibility::of(&input.compiled)
            .map_err(|TooLarge(what)| anyhow!("`{name}`: the {what} have too many terms"))?;
        let terms = terms(&input.compiled.field, &visibility);
        let needs = needs(&input.compiled.field, &visibility, can);
        let cells = input.scene::<f64>(&[], |code| code.double)?.default_cells();
        Ok(FieldTerms { input, needs, terms, visibility, cells })
    }

    /// The terms that the field shows, and an estimate of the cost of the finest mesh.
    fn candidate(&self) -> Candidate {
        let finest = self.cells.last().copied().unwrap_or(1) as f64;
        let cost = finest.powi(self.input.compiled.field.dimension as i32 + 1);
        Candidate { cost, terms: self.terms.keys().cloned().collect() }
    }
}

/// The name of a field's law.
fn material(field: &FieldSpec) -> &str {
    field.material.model.value.raw()
}

/// The names of the terms that a field shows, each with the consequence of its absence.
fn terms(field: &FieldSpec, visibility: &Visibility) -> BTreeMap<String, &'static str> {
    let name = |term: &Term| match term {
        Term::Traction(_) => term.kind().to_owned(),
        other => other.name(),
    };
    let mut terms: BTreeMap<String, &'static str> =
        visibility.with(Status::Present).map(|term| (name(term), term.absence())).collect();
    let mut add = |name: String, means| terms.insert(name, means);
    add(format!("dimension.{}", field.dimension), "no body of that dimension");
    add(format!("material.{}", material(field)), "that law is not tested");
    add(format!("body.{}", field.domain.body.name()), "no body of that shape");
    if field.space.is_axisymmetric() {
        add("hoop".into(), "neither F_tt nor P_tt/R is tested");
    }
    for face in &field.boundary {
        add(format!("face.{}", face.claim.value.name()), "no such condition on a face");
    }
    terms
}

/// The keys of `can` that exclude a field. A field at rest needs no start.
fn needs(field: &FieldSpec, visibility: &Visibility, can: &Capabilities) -> Vec<&'static str> {
    let claims = |claim: Claim| field.boundary.iter().any(|it| it.claim.value == claim);
    let sees = |term: Term| !visibility.lacks(&term);
    [
        ("dimensions", can.dimensions.contains(&field.dimension)),
        ("bodies", can.bodies.iter().any(|it| it == field.domain.body.name())),
        ("loads", can.tractions || !claims(Claim::Traction)),
        ("moving_walls", can.moving_walls || !claims(Claim::Prescribed)),
        ("start_moving", !can.dynamics || can.start_moving || !sees(Term::InitialVelocity)),
        ("start_deformed", !can.dynamics || can.start_deformed || !sees(Term::InitialDisplacement)),
        ("graded", can.graded || !(sees(Term::GradedModuli) || sees(Term::GradedDensity))),
        // A solver with dynamics runs no static fields, and one without runs no fields that move.
        ("dynamics", if can.dynamics { !field.is_static() } else { !sees(Term::Velocity) }),
    ]
    .into_iter()
    .filter(|(_, is_met)| !is_met)
    .map(|(key, _)| key)
    .collect()
}

/// The first field that linear shape functions represent exactly.
fn affine(allowed: &[&FieldTerms]) -> Option<Affine> {
    let is_affine = |it: &&&FieldTerms| {
        it.visibility.span() == Some(Span::Linear) && !it.visibility.lacks(&Term::Velocity)
    };
    let found = allowed.iter().find(is_affine)?;
    let speed = sound(&found.input.compiled, &SortedMap::new())[1];
    let scene = found.input.scene::<f64>(&[], |code| code.double).ok()?;
    let longest = 0.4 * scene.cell_size(&Division::Uniform(CELLS)) / speed;
    Some(Affine {
        name: found.input.name.raw().to_owned(),
        time_steps: (0..4).map(|level| rounded(longest / f64::from(1 << level))).collect(),
        is_quadratic: found.visibility.is_exact_in_time(),
    })
}

/// A number with three digits, for people.
fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// The terms of fields that the solver cannot run, without the terms of fields that it can run.
fn unseen(shown: &[FieldTerms], seen: &BTreeSet<String>, can: &Capabilities) -> Vec<Unseen> {
    let mut unseen: BTreeMap<String, Unseen> = BTreeMap::new();
    for it in shown {
        let by = Needing { field: it.input.name.raw().to_owned(), keys: it.needs.clone() };
        let own =
            it.terms.iter().filter(|(term, _)| !seen.contains(*term) && is_possible(term, can));
        for (term, means) in own {
            let new = || Unseen { term: term.clone(), means, shown_by: None };
            let known = unseen.entry(term.clone()).or_insert_with(new);
            if known.shown_by.as_ref().is_none_or(|known| by.keys.len() < known.keys.len()) {
                known.shown_by = Some(by.clone());
            }
        }
    }
    let named = can.materials.iter().map(|it| format!("material.{it}"));
    for term in named.filter(|term| !seen.contains(term)) {
        let means = "the gallery has no field of that law that it can run";
        let new = Unseen { term: term.clone(), means, shown_by: None };
        unseen.entry(term).or_insert(new);
    }
    unseen.into_values().collect()
}

/// Whether a term exists in the dimensions of a solver.
fn is_possible(term: &str, can: &Capabilities) -> bool {
    let has = |dimension: usize| can.dimensions.contains(&dimension);
    match term.strip_prefix("dimension.") {
        Some(dimension) => dimension.parse().is_ok_and(has),
        None => term != Term::OutOfPlane.kind() || has(3),
    }
}
