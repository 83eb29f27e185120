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
//! Their descriptions are interned, so that a quantity can be copied and compared.

use std::ops::Deref;

use crate::interned::Interner;
use crate::quantity::Shape;

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
    /// The part of the given field or of the balance.
    pub part: Part,
    /// The name of the given field or the balance.
    pub of: String,
    /// The identifier.
    pub name: String,
    /// The symbol.
    pub symbol: String,
    /// The unit; empty if the file states none.
    pub unit: String,
    /// The description, in one sentence.
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
