//! `[[balance]]`: further equations of a coupled code, whose sources follow from the fields.

use crate::diagnostic::Diagnostic;
use crate::domain::one_per_direction;
use crate::formula::Formula;
use crate::names::{Names, malformed};
use crate::own::Part;
use crate::source::Spanned;
use crate::space::Space;
use crate::table::{Reader, Table};

/// A further balance, or a constraint.
#[derive(Clone, Debug)]
pub struct BalanceSpec {
    /// The name.
    pub name: Spanned<String>,
    /// The formulas.
    pub law: BalanceLaw,
}

/// The formulas of a further balance.
#[derive(Clone, Debug)]
pub enum BalanceLaw {
    /// A balance: source = d(storage)/dt + Div(flux), per reference volume.
    Flow {
        /// The amount per reference volume; absent if nothing is stored.
        storage: Option<Formula>,
        /// The flux through reference area: one component per direction; absent if nothing flows.
        flux: Option<Vec<Formula>>,
    },
    /// A constraint: the residual is 0 in the solution of a code without a source.
    Constraint {
        /// The left side.
        residual: Formula,
    },
}

impl BalanceSpec {
    /// The parts that become quantities.
    pub fn parts(&self) -> &'static [Part] {
        match self.law {
            BalanceLaw::Flow { flux: Some(_), .. } => &Part::OF_BALANCE,
            BalanceLaw::Flow { flux: None, .. } => &[Part::Source],
            BalanceLaw::Constraint { .. } => &[Part::Residual],
        }
    }

    /// Every formula.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        let (first, others): (Option<&Formula>, &[Formula]) = match &self.law {
            BalanceLaw::Flow { storage, flux } => {
                (storage.as_ref(), flux.as_deref().unwrap_or_default())
            }
            BalanceLaw::Constraint { residual } => (Some(residual), &[]),
        };
        first.into_iter().chain(others)
    }
}

/// Reads every `[[balance]]`.
pub(super) fn balances<'a>(
    tables: &[Table<'a>],
    space: Space,
    names: &mut Names,
    reader: &mut Reader<'a>,
) -> Vec<BalanceSpec> {
    tables.iter().filter_map(|table| balance(table, space, names, reader)).collect()
}

fn balance<'a>(
    table: &Table<'a>,
    space: Space,
    names: &mut Names,
    reader: &mut Reader<'a>,
) -> Option<BalanceSpec> {
    let name = reader.required_string(table, "name");
    let storage = table.get("storage").map(|it| reader.formula("storage", it.value));
    let flux = table
        .get("flux")
        .map(|flux| reader.formulas(&flux, space.vector(), &one_per_direction(space)));
    let residual = table.get("residual").map(|it| reader.formula("residual", it.value));
    let flow = || table.get("storage").or_else(|| table.get("flux"));
    let law = match (residual, flow()) {
        (Some(residual), None) => BalanceLaw::Constraint { residual },
        (None, Some(_)) => BalanceLaw::Flow { storage, flux },
        (Some(residual), Some(entry)) => {
            let message = format!("`{}` and `residual` do not go together", entry.key.value);
            reader.report(
                Diagnostic::error(entry.key.span, message)
                    .label("of a balance; a constraint has a residual alone")
                    .help("write two tables [[balance]]"),
            );
            reader
                .stray
                .extend(storage.into_iter().chain(flux.into_iter().flatten()).chain([residual]));
            return None;
        }
        (None, None) => {
            if !reader.is_incomplete() {
                reader.report(
                    Diagnostic::error(table.span, "this balance has no formula")
                        .label("[[balance]] needs `storage`, `flux`, or both; or `residual`")
                        .help("the source is d(storage)/dt + Div(flux), per reference volume"),
                );
            }
            return None;
        }
    };
    let name = name?;
    let spec = BalanceSpec { name, law };
    if let Some(mistake) = malformed(&spec.name) {
        reader.report(mistake);
    } else if names.define_own(&spec.name, spec.parts(), reader) {
        return Some(spec);
    }
    reader.stray.extend(spec.formulas().cloned());
    None
}
