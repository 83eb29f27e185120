//! The order of a page, which is the same in every notation.

use std::borrow::Cow;

use super::document::{Document, Line, Section};
use super::name::Name;
use super::relation::{Part, Setting, relation};
use super::walk::Notation;
use mms_analysis::visibility::{NEGLIGIBLE, POINTS, Status, Visibility};
use mms_spec::quantity::Quantity;

/// A part of a page, from top to bottom.
pub(super) enum Block<'a> {
    /// The name of the field, and its description: escaped like all texts of a page.
    Title(String),
    /// A sentence.
    Note(String),
    /// The next heading.
    Heading {
        /// A word.
        name: &'a str,
        /// The definition of a quantity.
        relation: Option<Vec<Part>>,
        /// More about it.
        note: Option<String>,
        /// The cost to compute it, which belongs on a screen and not on paper.
        operations: Option<String>,
    },
    /// The word between a heading and the definitions that the formulas under it use.
    Where,
    /// Formulas.
    Lines {
        /// The formulas; never none.
        lines: Cow<'a, [Line]>,
        /// Whether they are only definitions for the lines that follow.
        is_where: bool,
    },
}

/// The page of a document.
pub(super) fn blocks(document: &Document) -> Vec<Block<'_>> {
    let mut blocks = vec![Block::Title(title(document))];
    blocks.extend(document.reference.iter().map(|it| Block::Note(it.shown())));
    if document.space.is_axisymmetric() {
        let note = "axisymmetric: components 1, 2 and 3 are along R, Z and the hoop, in the basis at the point";
        blocks.push(Block::Note(note.into()));
    }
    if !document.definitions.is_empty() {
        blocks.push(heading("with"));
        blocks.push(formulas(&document.definitions));
    }
    let material = &document.material;
    let note = Some(format!("{}: {}", material.name.shown(), material.title.shown()));
    blocks.push(Block::Heading { name: "material", relation: None, note, operations: None });
    blocks.extend(energy(document));
    for it in &document.sections {
        blocks.extend(section(document, it, it.quantity.name()));
    }
    if !document.claims.is_empty() {
        blocks.push(heading("boundary claims"));
        let claims = document.claims.iter();
        blocks.extend(claims.map(|(face, claim)| Block::Note(format!("{face}: {claim}"))));
    }
    blocks.extend(document.visibility.iter().flat_map(visibility));
    blocks.retain(|block| !matches!(block, Block::Lines { lines, .. } if lines.is_empty()));
    blocks
}

/// The derivation from u to b, as a paper shows it: each definition below the formula that uses it first.
pub(super) fn derivation(document: &Document) -> Vec<Block<'_>> {
    let is_motion = |it: &&Section| it.quantity == Quantity::Displacement;
    let mut blocks = Vec::new();
    for it in document.sections.iter().filter(is_motion) {
        blocks.extend(section(document, it, ""));
    }
    if !document.definitions.is_empty() {
        blocks.push(Block::Note("with".into()));
        blocks.push(formulas(&document.definitions));
    }
    let others: Vec<&Section> = document.sections.iter().filter(|it| !is_motion(it)).collect();
    // The first quantity that follows from W.
    let stress = others.iter().position(|it| it.quantity.unit().contains("Pa"));
    let (kinematics, kinetics) = others.split_at(stress.unwrap_or(others.len()));
    let has = |of| document.sections.iter().any(|it| it.quantity == of);
    if has(Quantity::DeformationGradient) && !has(Quantity::DisplacementGradient) {
        blocks.push(Block::Heading {
            name: "",
            relation: Some(relation(
                Quantity::DisplacementGradient,
                &document.material.kind,
                document.is_static,
            )),
            note: None,
            operations: None,
        });
    }
    kinematics.iter().for_each(|it| blocks.extend(section(document, it, "")));
    if !kinetics.is_empty() {
        blocks.push(Block::Note("with the strain-energy density".into()));
        blocks.extend(energy(document));
    }
    kinetics.iter().for_each(|it| blocks.extend(section(document, it, "")));
    blocks.retain(|block| !matches!(block, Block::Lines { lines, .. } if lines.is_empty()));
    blocks
}

/// W, and the values that the field gives to the parameters of the material.
fn energy(document: &Document) -> [Block<'_>; 3] {
    let material = &document.material;
    // A line that equates a parameter of the material with the field's parameter of the same name is left out.
    let arguments = material.arguments.iter().chain(&material.density);
    let arguments: Vec<Line> =
        arguments.filter(|line| !document.is_identity(line)).cloned().collect();
    let arguments = Block::Lines { lines: arguments.into(), is_where: false };
    [formulas(&material.energy), formulas(&material.whereby), arguments]
}

/// A quantity: its definition, and its formulas below the ones that they use.
fn section<'a>(document: &'a Document, section: &'a Section, name: &'a str) -> Vec<Block<'a>> {
    let mut blocks = vec![Block::Heading {
        name,
        relation: Some(relation(section.quantity, &document.material.kind, document.is_static)),
        note: None,
        operations: Some(operations(section)),
    }];
    if !section.whereby.is_empty() {
        blocks.push(Block::Where);
        blocks.push(Block::Lines { lines: (&section.whereby).into(), is_where: true });
    }
    blocks.push(formulas(&section.lines));
    blocks
}

/// The name of the field, and its description.
pub(super) fn title(document: &Document) -> String {
    format!("{}: {}", document.name.shown(), document.title.shown())
}

/// The terms that a field sees, and the terms that it does not see, grouped by how that is known.
fn visibility(visibility: &Visibility) -> Vec<Block<'_>> {
    let negligible = format!("no more than {NEGLIGIBLE:e} of its size at {POINTS} points");
    let absent = |status, why: &str| {
        let found = visibility.telling().filter(move |(_, found)| *found == status);
        let lines = found.map(|(term, _)| format!("  {}: {}", term.words(), term.absence()));
        let lines: Vec<_> = lines.collect();
        let head = (!lines.is_empty()).then(|| format!("not seen, since {why}:"));
        head.into_iter().chain(lines)
    };
    let named = |status, head: &str| {
        let words: Vec<_> = visibility.with(status).map(|term| term.words()).collect();
        (!words.is_empty()).then(|| format!("{head}: {}", words.join(", ")))
    };
    let notes = (named(Status::Present, "seen").into_iter())
        .chain(absent(Status::Zero, "it is zero"))
        .chain(absent(Status::Negligible, &negligible))
        .chain(named(Status::Undecided, "without a value where it could be seen"));
    let note = Some("what a field does not see, a solver may do wrong".to_string());
    let head = Block::Heading { name: "visibility", relation: None, note, operations: None };
    [head].into_iter().chain(notes.map(Block::Note)).collect()
}

fn heading(name: &str) -> Block<'_> {
    Block::Heading { name, relation: None, note: None, operations: None }
}

fn formulas(lines: &[Line]) -> Block<'_> {
    Block::Lines { lines: lines.into(), is_where: false }
}

fn operations(section: &Section) -> String {
    let stages: Vec<_> = section
        .operations
        .iter()
        .map(|(stage, count)| format!("{count} {}", stage.name()))
        .collect();
    let stages = if stages.is_empty() { "none".into() } else { stages.join(", ") };
    format!("operations: {stages}")
}

/// The left-hand side of a line; for a derivative it includes the definition of the derivative.
pub(super) fn left<N: Notation + Setting>(line: &Line, notation: &N, equals: &str) -> String {
    let mut sides = Vec::new();
    for name in &line.left {
        sides.push(notation.name(name));
        if let Some((of, along)) = name.as_derivative() {
            let mut by: Vec<(String, usize)> = Vec::new();
            for along in along {
                let variable = notation.name(&Name::plain(along.label()));
                match by.last_mut().filter(|(last, _)| *last == variable) {
                    Some((_, times)) => *times += 1,
                    None => by.push((variable, 1)),
                }
            }
            sides.push(notation.derivative(&notation.name(&of), &by));
        }
    }
    sides.join(equals)
}
