//! Quantities that a field file defines: of its given fields and of its further balances.
//!
//! | part | name | is |
//! |---|---|---|
//! | `Value` | `p` | the given field |
//! | `Gradient` | `p_gradient` | its gradient by X |
//! | `Rate` | `p_rate` | its rate at fixed X |
//! | `Source` | `heat_source` | d(storage)/dt + Div(flux), per reference volume |
//! | `Flux` | `heat_flux` | Q, the flux through reference area |
//! | `NormalFlux` | `heat_normal_flux` | Q.N on a face with the outward unit normal N |
//! | `Residual` | `volume_residual` | the left side of a constraint |
//!
//! Their descriptions are interned, so that a quantity stays something to copy and to compare.

use std::ops::Deref;

use crate::balance::{BalanceLaw, BalanceSpec};
use crate::diagnostic::Diagnostic;
use crate::field::FieldSpec;
use crate::foreign::Foreign;
use crate::interned::Interner;
use crate::material::MaterialSpec;
use crate::quantity::{Quantity, Shape};
use crate::source::Spanned;

/// A part of a given field or of a balance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Part {
    /// The value of a given field.
    Value,
    /// The gradient of a given field.
    Gradient,
    /// The rate of a given field.
    Rate,
    /// The source of a balance.
    Source,
    /// The flux of a balance.
    Flux,
    /// The outward normal flux of a balance.
    NormalFlux,
    /// The residual of a constraint.
    Residual,
}

impl Part {
    /// The parts of a given field; the rate is 0 in a static one.
    pub const OF_GIVEN: [Part; 3] = [Part::Value, Part::Gradient, Part::Rate];
    /// The parts of a balance with storage and flux.
    pub const OF_BALANCE: [Part; 3] = [Part::Source, Part::Flux, Part::NormalFlux];

    /// The name of the part for a given field or a balance of some name.
    pub fn name(self, of: &str) -> String {
        match self {
            Part::Value => of.to_owned(),
            Part::Gradient => format!("{of}_gradient"),
            Part::Rate => format!("{of}_rate"),
            Part::Source => format!("{of}_source"),
            Part::Flux => format!("{of}_flux"),
            Part::NormalFlux => format!("{of}_normal_flux"),
            Part::Residual => format!("{of}_residual"),
        }
    }

    /// The shape of the part.
    pub fn shape(self) -> Shape {
        match self {
            Part::Gradient | Part::Flux => Shape::Vector,
            _ => Shape::Scalar,
        }
    }
}

/// The description of a quantity that a field file defines.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Described {
    /// The position among the quantities that the file defines.
    pub place: usize,
    /// Which part of that.
    pub part: Part,
    /// The name of the given field or the balance.
    pub of: String,
    /// The identifier.
    pub name: String,
    /// The symbol.
    pub symbol: String,
    /// The unit; empty if the file states none.
    pub unit: String,
    /// One sentence.
    pub doc: String,
}

/// A handle to a description, equal for equal descriptions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Own(&'static Described);

impl Deref for Own {
    type Target = Described;

    fn deref(&self) -> &Described {
        self.0
    }
}

impl Own {
    /// The description.
    pub fn described(self) -> &'static Described {
        self.0
    }

    /// The handle of a description.
    pub fn new(described: Described) -> Own {
        static KNOWN: Interner<Described> = Interner::new();
        Own(KNOWN.keep(described))
    }
}

/// A given field of a field: the material's that the field sets, or one of its own.
#[derive(Clone, Copy, Debug)]
struct Given<'a> {
    name: &'a str,
    unit: Option<&'a Spanned<String>>,
    doc: Option<&'a Foreign>,
}

/// The given fields of a field: first those that its material takes, in the order of its file, then those of its own.
fn givens<'a>(field: &'a FieldSpec, material: Option<&'a MaterialSpec>) -> Vec<Given<'a>> {
    let taken = material.iter().flat_map(|material| &material.givens);
    let mut givens: Vec<_> = taken
        .map(|it| Given { name: &it.name.value, unit: it.unit.as_ref(), doc: it.doc.as_ref() })
        .collect();
    for own in &field.givens {
        if givens.iter().all(|taken| taken.name != own.name.value) {
            let (unit, doc) = (own.unit.as_ref(), own.doc.as_ref());
            givens.push(Given { name: &own.name.value, unit, doc });
        }
    }
    givens
}

/// The quantities that a field file and its material define: of the given fields, then of the balances.
pub fn own_quantities(field: &FieldSpec, material: Option<&MaterialSpec>) -> Vec<Own> {
    quantities_of(field, givens(field, material))
}

/// The quantities that a field file may define, whatever its material is: any formula of `[material]` may set a given field.
pub(super) fn possible_quantities(field: &FieldSpec) -> Vec<Own> {
    let of_material = field.material.arguments.iter();
    let of_material =
        of_material.map(|(name, _)| Given { name: &name.value, unit: None, doc: None });
    quantities_of(field, of_material.chain(givens(field, None)).collect())
}

/// Makes the closed forms of a field be about the quantities that it has once its material is known. Reports those that are
/// about a parameter of the material.
pub fn settle_checks(field: &mut FieldSpec, own: &[Own], diagnostics: &mut Vec<Diagnostic>) {
    for check in &mut field.checks {
        let Quantity::Own(possible) = check.quantity.value else { continue };
        match own.iter().find(|own| own.name == possible.name) {
            Some(own) => check.quantity.value = Quantity::Own(*own),
            None => {
                let message = format!("`{}` is no given field of this field", possible.of);
                diagnostics.push(
                    Diagnostic::error(check.quantity.span, message)
                        .label("a parameter of the material is no quantity")
                        .help("a material file lists the given fields that it takes under [given]"),
                );
            }
        }
    }
    field.checks.retain(|check| match check.quantity.value {
        Quantity::Own(possible) => own.contains(&possible),
        _ => true,
    });
}

fn quantities_of(field: &FieldSpec, givens: Vec<Given<'_>>) -> Vec<Own> {
    let mut all = Vec::new();
    for given in givens {
        let parts = Part::OF_GIVEN.into_iter();
        for part in parts.filter(|part| *part != Part::Rate || !field.is_static()) {
            let unit = given.unit.map_or("", |unit| unit.value.as_str());
            let unit = match part {
                _ if unit.is_empty() => String::new(),
                Part::Gradient => format!("{unit}/m"),
                Part::Rate => format!("{unit}/s"),
                _ => unit.to_owned(),
            };
            let what = match given.doc {
                Some(doc) => format!("{}: {}", given.name, doc.in_a_comment()),
                None => given.name.to_owned(),
            };
            let doc = match part {
                Part::Gradient => format!("Gradient by X of the given field {what}."),
                Part::Rate => format!("Rate at fixed X of the given field {what}."),
                _ => format!("Given field {what}."),
            };
            all.push(described(&all, given.name, part, unit, doc));
        }
    }
    for balance in &field.balances {
        let name = &balance.name.value;
        for part in balance.parts() {
            let doc = doc_of_balance(balance, *part);
            all.push(described(&all, name, *part, String::new(), doc));
        }
    }
    all
}

fn described(before: &[Own], of: &str, part: Part, unit: String, doc: String) -> Own {
    let name = part.name(of);
    let symbol = match part {
        Part::Gradient => format!("grad_{of}"),
        Part::Rate => format!("d{of}_dt"),
        _ => name.clone(),
    };
    Own::new(Described { place: before.len(), part, of: of.to_owned(), name, symbol, unit, doc })
}

fn doc_of_balance(balance: &BalanceSpec, part: Part) -> String {
    let name = &balance.name.value;
    match (part, &balance.law) {
        (Part::Source, BalanceLaw::Flow { storage: Some(_), flux: Some(_) }) => format!(
            "Source of the balance of {name}, d(storage)/dt + Div(flux), per reference volume; a positive one supplies."
        ),
        (Part::Source, BalanceLaw::Flow { flux: None, .. }) => format!(
            "Source of the balance of {name}, d(storage)/dt, per reference volume; a positive one supplies."
        ),
        (Part::Source, _) => format!(
            "Source of the balance of {name}, Div(flux), per reference volume; a positive one supplies."
        ),
        (Part::Flux, _) => format!("Flux Q of {name} through reference area."),
        (Part::NormalFlux, _) => {
            format!(
                "Outward flux Q.N of {name} through reference area, for the reference unit normal N."
            )
        }
        _ => format!("Residual of the constraint {name}."),
    }
}
