//! The form of computation of a quantity: with all its digits, or with the fewest operations.

use crate::diagnostic::quoted;
use crate::suggest::advice;

/// The formulas among which the compiler chooses for a quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Form {
    /// The formulas that fulfil the accuracy contract: for each quantity, at any strain down to 1e-12, an error of at most 64
    /// eps of its largest magnitude.
    #[default]
    Stable,
    /// All formulas. At a small strain e, the stress may lose eps/e, and the energy eps/e^2.
    Fast,
}

impl Form {
    /// Every form.
    pub const ALL: [Form; 2] = [Form::Stable, Form::Fast];

    /// The name in a field file, on the command line and in the macro.
    pub const fn name(self) -> &'static str {
        match self {
            Form::Stable => "stable",
            Form::Fast => "fast",
        }
    }

    /// The form with this name, or the mistake in one line.
    pub fn from_name(name: &str) -> Result<Form, String> {
        Self::ALL.into_iter().find(|form| form.name() == name).ok_or_else(|| {
            let known = Self::ALL.map(Form::name);
            let advice = advice(name, known, |all| format!("the forms are {all}"));
            format!("unknown form {}; {advice}", quoted(name))
        })
    }
}
