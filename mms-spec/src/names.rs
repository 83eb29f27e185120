//! The names that a file may define.
//!
//! Names are ASCII identifiers, and emitters rename words that a target reserves. The language reserves `X Y Z t pi` and the
//! functions; in an axisymmetric field also `R`, in a material also the invariants. All other names are free, including `F` and
//! `fn`.

use std::collections::BTreeMap;

use crate::diagnostic::{Diagnostic, quoted};
use crate::language::FUNCTIONS;
use crate::own::Part;
use crate::quantity::Quantity;
use crate::source::{Span, Spanned};
use crate::space::Space;
use crate::table::Reader;

/// The longest name that a file may define.
pub const MAX_NAME: usize = 100;

/// The names that are defined in every field.
pub const COORDINATES: &[(&str, &str)] = &[
    ("X", "the first reference coordinate"),
    ("Y", "the second reference coordinate"),
    ("Z", "the third reference coordinate"),
    ("t", "the time"),
    ("pi", "the circle's number"),
];

/// The names that are defined in an axisymmetric field, and the Cartesian coordinates, which it does not have.
pub const AXISYMMETRIC: &[(&str, &str)] = &[
    ("R", "the distance from the axis"),
    ("Z", "the coordinate along the axis"),
    ("t", "the time"),
    ("pi", "the circle's number"),
    ("X", "a Cartesian coordinate; this field is written in R and Z"),
    ("Y", "a Cartesian coordinate; this field is written in R and Z"),
];

/// The names in which a strain-energy density is written.
pub const INVARIANTS: &[(&str, &str)] = &[
    ("I1", "the first invariant, tr C"),
    ("I2", "the second invariant of C"),
    ("I3", "the third invariant, det C"),
    ("I4", "the squared stretch along the fibre"),
    ("J", "the Jacobian, det F"),
    ("eps_trace", "the trace of the small strain"),
    ("eps_squared", "the small strain contracted with itself"),
];

/// The kind of file that reserves names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReservingFile {
    /// A field file.
    Field,
    /// A field file that is written in R and Z.
    Axisymmetric,
    /// A material file, which also reserves the invariants.
    Material,
}

impl ReservingFile {
    /// The kind of a field file in a space.
    pub fn of(space: Space) -> ReservingFile {
        if space.is_axisymmetric() { ReservingFile::Axisymmetric } else { ReservingFile::Field }
    }
}

/// Whether a text is a name: a letter or `_`, then letters, digits and `_`, all ASCII.
pub fn is_identifier(text: &str) -> bool {
    let mut bytes = text.bytes();
    bytes.next().is_some_and(|first| first.is_ascii_alphabetic() || first == b'_')
        && bytes.all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}

/// The meaning of a reserved name, or `None` if users may define it.
pub fn reserved(name: &str, file: ReservingFile) -> Option<&'static str> {
    let among = |names: &[(&str, &'static str)]| {
        names.iter().find(|(kept, _)| *kept == name).map(|(_, meaning)| *meaning)
    };
    match file {
        _ if FUNCTIONS.contains(&name) => Some("a function"),
        ReservingFile::Field => among(COORDINATES),
        ReservingFile::Axisymmetric => among(AXISYMMETRIC),
        ReservingFile::Material => among(COORDINATES).or_else(|| among(INVARIANTS)),
    }
}

/// The names that one file has defined so far.
#[derive(Clone)]
pub(super) struct Names {
    file: ReservingFile,
    defined: BTreeMap<String, Span>,
    /// The names of the quantities that the file defines.
    own: BTreeMap<String, Span>,
}

impl Names {
    /// A file without names.
    pub fn new(file: ReservingFile) -> Self {
        Names { file, defined: BTreeMap::new(), own: BTreeMap::new() }
    }

    /// Defines the quantities of a given field or a balance. Returns whether the names are allowed: otherwise the reason has
    /// been reported.
    pub fn define_own(
        &mut self,
        name: &Spanned<String>,
        parts: &[Part],
        reader: &mut Reader<'_>,
    ) -> bool {
        let parts: Vec<_> = parts.iter().map(|part| part.name(&name.value)).collect();
        let taken = parts.iter().find_map(|part| {
            if Quantity::reserves(part) {
                let message = format!("the name {} is reserved", quoted(&name.value));
                let label = format!("`{part}` is a quantity of every field");
                return Some(Diagnostic::error(name.span, message).label(label));
            }
            let (line, _) = reader.sources.location(*self.own.get(part)?);
            let message = format!("the quantity `{part}` is defined twice");
            Some(Diagnostic::error(name.span, message).label(format!("first by line {line}")))
        });
        if let Some(diagnostic) = taken {
            reader.report(diagnostic.help("choose another name"));
            return false;
        }
        self.own.extend(parts.into_iter().map(|part| (part, name.span)));
        true
    }

    /// Defines a name. Returns whether it is allowed: otherwise the reason has been reported.
    pub fn define(&mut self, name: &Spanned<String>, reader: &mut Reader<'_>) -> bool {
        match self.refusal(name, reader) {
            None => {
                self.defined.insert(name.value.clone(), name.span);
                true
            }
            Some(diagnostic) => {
                if reserved(&name.value, self.file).is_some() {
                    reader.refused.push(name.value.clone());
                }
                reader.report(diagnostic);
                false
            }
        }
    }

    fn refusal(&self, name: &Spanned<String>, reader: &Reader<'_>) -> Option<Diagnostic> {
        let shown = quoted(&name.value);
        if let Some(refusal) = malformed(name) {
            return Some(refusal);
        }
        if let Some(meaning) = reserved(&name.value, self.file) {
            return Some(
                Diagnostic::error(name.span, format!("the name {shown} is reserved"))
                    .label(format!("means {meaning}"))
                    .help("choose another name"),
            );
        }
        let first = *self.defined.get(&name.value)?;
        let mut diagnostic =
            Diagnostic::error(name.span, format!("the name {shown} is defined twice"));
        if !reader.is_full() {
            let (line, _) = reader.sources.location(first);
            diagnostic = diagnostic.label(format!("first defined in line {line}"));
        }
        Some(diagnostic.help("parameters and definitions share one set of names: rename one"))
    }
}

/// The mistake of a text that is no name, or is too long.
pub(super) fn malformed(name: &Spanned<String>) -> Option<Diagnostic> {
    let shown = quoted(&name.value);
    if !is_identifier(&name.value) {
        return Some(
            Diagnostic::error(name.span, format!("{shown} is not a name"))
                .label("expected a letter or `_`, then letters, digits and `_`")
                .help("names are ASCII, because they become identifiers in other languages"),
        );
    }
    (name.value.len() > MAX_NAME).then(|| {
        let length = name.value.len();
        Diagnostic::error(name.span, format!("the name {shown} has {length} characters"))
            .label(format!("expected at most {MAX_NAME}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers() {
        for name in ["A", "_", "rho0", "eps_trace", "fn"] {
            assert!(is_identifier(name), "{name}");
        }
        for name in ["", "2a", "a b", "a\"); evil(", "\u{3bb}", "a-b"] {
            assert!(!is_identifier(name), "{name}");
        }
    }

    #[test]
    fn a_field_leaves_the_invariants_free() {
        assert!(reserved("J", ReservingFile::Field).is_none());
        assert!(reserved("J", ReservingFile::Material).is_some());
        assert!(reserved("X", ReservingFile::Material).is_some());
        assert!(reserved("atan2", ReservingFile::Field).is_some());
        assert!(reserved("F", ReservingFile::Field).is_none());
        assert!(reserved("R", ReservingFile::Field).is_none());
    }

    #[test]
    fn an_axisymmetric_field_keeps_its_coordinates_and_those_it_lacks() {
        for name in ["R", "Z", "X", "Y", "t"] {
            assert!(reserved(name, ReservingFile::Axisymmetric).is_some(), "{name}");
        }
        assert!(reserved("theta", ReservingFile::Axisymmetric).is_none());
    }
}
