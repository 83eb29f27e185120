//! Names in a derivation, structured so that each notation can set them well.

use mms_mechanics::invariant::INVARIANTS;
use mms_spec::Space;
use mms_spec::quantity::{Quantity, Shape};
use mms_symbolic::expr::Symbol;
use mms_symbolic::sorted::SortedSet;

/// The variable of a derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Along {
    /// The invariant of that position in [`INVARIANTS`].
    Invariant(usize),
    /// A Cartesian reference coordinate: 0 is X.
    Coordinate(usize),
    /// A coordinate of an axisymmetric field: 0 is R, 1 is Z.
    Meridian(usize),
    /// The time.
    Time,
}

impl Along {
    /// The coordinate of that position.
    pub fn coordinate(space: Space, axis: usize) -> Self {
        match space {
            Space::Cartesian(_) => Along::Coordinate(axis),
            Space::Axisymmetric { .. } => Along::Meridian(axis),
        }
    }

    /// The name in the language of field files.
    pub fn label(self) -> &'static str {
        match self {
            Along::Coordinate(0) => "X",
            Along::Coordinate(1) => "Y",
            Along::Meridian(0) => "R",
            Along::Coordinate(_) | Along::Meridian(_) => "Z",
            Along::Time => "t",
            Along::Invariant(position) => INVARIANTS[position].name,
        }
    }

    /// The leaf of an expression that a field is differentiated by; the invariants are no leaves.
    pub(super) fn leaf(self) -> Option<Symbol> {
        match self {
            Along::Coordinate(axis) | Along::Meridian(axis) => Some(Symbol::Coordinate(axis)),
            Along::Time => Some(Symbol::Time),
            Along::Invariant(_) => None,
        }
    }
}

/// A name: a stem, the index of its component, and the variables of its derivatives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// The word itself: an ASCII identifier.
    pub stem: String,
    /// The quantity that the stem is the symbol of.
    pub quantity: Option<Quantity>,
    /// Digits of a component, such as `12`; empty without one.
    pub index: String,
    /// The derivatives taken, in the order of their names.
    pub along: Vec<Along>,
}

impl Name {
    /// A name as a user wrote it.
    pub fn plain(stem: impl Into<String>) -> Self {
        Name { stem: stem.into(), quantity: None, index: String::new(), along: Vec::new() }
    }

    /// A component: F in 1-D, F_12 for a tensor, u_2 for a vector.
    pub fn component(quantity: Quantity, component: usize, dimension: usize) -> Self {
        let index = match quantity.shape() {
            _ if dimension == 1 => String::new(),
            Shape::Scalar => String::new(),
            Shape::Vector => (component + 1).to_string(),
            Shape::Tensor => format!("{}{}", component / dimension + 1, component % dimension + 1),
        };
        let stem = quantity.symbol().to_string();
        Name { stem, quantity: Some(quantity), index, along: Vec::new() }
    }

    /// A name with an index of its own, such as cof_12.
    pub fn indexed(stem: &str, index: impl Into<String>) -> Self {
        Name { index: index.into(), ..Name::plain(stem) }
    }

    /// The name of a further derivative.
    pub fn derivative(&self, along: Along) -> Self {
        let mut name = self.clone();
        name.along.push(along);
        name.along.sort();
        name
    }

    /// The name as an identifier of the language of field files.
    pub fn identifier(&self) -> String {
        let mut text = self.stem.clone();
        if !self.index.is_empty() {
            text.push('_');
            text.push_str(&self.index);
        }
        if !self.along.is_empty() {
            text.push('_');
            self.along.iter().for_each(|along| text.push_str(along.label()));
        }
        text
    }

    /// The name that is differentiated, and the variables: F_12 and X, Y for F_12_XY. A derivative by an invariant is a
    /// quantity of its own, as in W_JX.
    pub fn as_derivative(&self) -> Option<(Name, &[Along])> {
        let by_place = |along: &Along| along.leaf().is_some();
        let inner = self.along.iter().position(by_place).unwrap_or(0);
        let (kept, taken) = self.along.split_at(inner);
        let of = Name { along: kept.to_vec(), ..self.clone() };
        (!taken.is_empty()).then_some((of, taken))
    }

    /// Whether the name can carry a dot per derivative by time: Newton's notation.
    pub(super) fn is_dotted(&self) -> bool {
        let by_time = self.along.iter().all(|along| *along == Along::Time);
        let letter =
            self.stem.len() == 1 && self.stem.bytes().all(|byte| byte.is_ascii_alphabetic());
        letter && self.index.is_empty() && by_time && (1..=2).contains(&self.along.len())
    }

    /// The stem without the digits at its end, and those digits: rho0 is rho and 0. An underscore
    /// keeps a name whole.
    pub(super) fn split_digits(&self) -> (&str, &str) {
        let letters = self.stem.trim_end_matches(|last: char| last.is_ascii_digit());
        match letters.is_empty() || letters.contains('_') {
            true => (&self.stem, ""),
            false => self.stem.split_at(letters.len()),
        }
    }
}

/// The names given so far. Two names that some notation may set alike count as one.
#[derive(Clone, Debug, Default)]
pub(super) struct Taken(SortedSet<String>);

impl Taken {
    /// Keeps a name that must stay as it is.
    pub fn keep(&mut self, name: &str) {
        self.0.insert(Self::key(name));
    }

    /// The name, or the name with `suffix` at its stem where another one could be mistaken for it.
    pub fn fresh(&mut self, mut name: Name, suffix: &str) -> Name {
        let stem = name.stem.clone();
        let mut tries = 1;
        while !self.0.insert(Self::key(&name.identifier())) {
            let number = if tries == 1 { String::new() } else { tries.to_string() };
            name.stem = format!("{stem}_{suffix}{number}");
            tries += 1;
        }
        name
    }

    /// Whether nothing could be mistaken for the name.
    pub fn is_free(&self, name: &Name) -> bool {
        !self.0.contains(&Self::key(&name.identifier()))
    }

    /// F_11 and F11 may look alike.
    fn key(identifier: &str) -> String {
        identifier.replace('_', "")
    }
}

/// A letter that is written out in the language of field files, and how the notations set it.
pub(super) struct Letter {
    /// The word.
    pub word: &'static str,
    /// The letter.
    pub letter: char,
    /// LaTeX's command.
    pub latex: &'static str,
}

/// The Greek letter of a word.
pub(super) fn greek(word: &str) -> Option<&'static Letter> {
    GREEK.iter().find(|letter| letter.word == word)
}

macro_rules! greek {
    ($($word:literal $letter:literal $latex:literal,)*) => {
        &[$(Letter { word: $word, letter: $letter, latex: $latex },)*]
    };
}

const GREEK: &[Letter] = greek! {
    "alpha" '\u{3b1}' "\\alpha", "beta" '\u{3b2}' "\\beta", "gamma" '\u{3b3}' "\\gamma",
    "delta" '\u{3b4}' "\\delta", "epsilon" '\u{3b5}' "\\varepsilon", "zeta" '\u{3b6}' "\\zeta",
    "eta" '\u{3b7}' "\\eta", "theta" '\u{3b8}' "\\theta", "iota" '\u{3b9}' "\\iota",
    "kappa" '\u{3ba}' "\\kappa", "lambda" '\u{3bb}' "\\lambda", "mu" '\u{3bc}' "\\mu",
    "nu" '\u{3bd}' "\\nu", "xi" '\u{3be}' "\\xi", "rho" '\u{3c1}' "\\rho",
    "sigma" '\u{3c3}' "\\sigma", "tau" '\u{3c4}' "\\tau", "upsilon" '\u{3c5}' "\\upsilon",
    "phi" '\u{3c6}' "\\varphi", "chi" '\u{3c7}' "\\chi", "psi" '\u{3c8}' "\\psi",
    "omega" '\u{3c9}' "\\omega", "Gamma" '\u{393}' "\\Gamma", "Delta" '\u{394}' "\\Delta",
    "Theta" '\u{398}' "\\Theta", "Lambda" '\u{39b}' "\\Lambda", "Xi" '\u{39e}' "\\Xi",
    "Sigma" '\u{3a3}' "\\Sigma", "Phi" '\u{3a6}' "\\Phi", "Psi" '\u{3a8}' "\\Psi",
    "Omega" '\u{3a9}' "\\Omega",
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_an_identifier() {
        let shear = Name::component(Quantity::DeformationGradient, 1, 2);
        assert_eq!(shear.identifier(), "F_12");
        let slope = shear.derivative(Along::Time).derivative(Along::Coordinate(0));
        assert_eq!(slope.identifier(), "F_12_Xt");
        assert_eq!(Name::component(Quantity::BodyForce, 0, 1).identifier(), "b");
    }

    #[test]
    fn names_that_may_look_alike_are_told_apart() {
        let mut taken = Taken::default();
        taken.keep("F11");
        taken.keep("k1");
        let mut fresh = |name| taken.fresh(name, "derived").identifier();
        let component = Name::component(Quantity::DeformationGradient, 0, 2);
        assert_eq!(fresh(component.clone()), "F_derived_11");
        assert_eq!(fresh(component), "F_derived2_11");
        assert_eq!(fresh(Name::plain("k2")), "k2");
    }
}
