//! Polynomials in expressions: sums that are fully multiplied out, with exact coefficients.

use crate::expr::{Expr, Graph, Rational};
use crate::sorted::{SortedMap, SortedSet};

/// Factors with non-zero integer exponents, negative ones included, in order of handles.
pub(super) type Monomial = Vec<(Expr, i32)>;

/// The greatest exponent; a greater power is not multiplied out.
const MAX_EXPONENT: u32 = 1 << 20;

/// The largest number of terms of a polynomial.
const MAX_TERMS: usize = 200;

/// The largest number of terms of a polynomial whose square is sought.
const MAX_ROOT: usize = 8;

/// A sum of monomials with non-zero coefficients.
///
/// Operations return `None` if the result would have more than [`MAX_TERMS`] terms.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Polynomial {
    pub(super) terms: SortedMap<Monomial, Rational>,
}

impl Polynomial {
    /// A number.
    pub(super) fn constant(number: Rational) -> Self {
        Self::monomial(Monomial::new(), number)
    }

    /// A power of an expression, which is treated as an atom.
    pub(super) fn power_of(atom: Expr, exponent: i32) -> Self {
        let monomial = if exponent == 0 { Monomial::new() } else { vec![(atom, exponent)] };
        Self::monomial(monomial, Rational::ONE)
    }

    /// A single term.
    pub(super) fn monomial(monomial: Monomial, coefficient: Rational) -> Self {
        let mut polynomial = Polynomial::default();
        polynomial.add(monomial, coefficient);
        polynomial
    }

    /// Adds a term.
    pub(super) fn add(&mut self, monomial: Monomial, coefficient: Rational) {
        match self.terms.get_mut(&monomial) {
            Some(sum) => {
                *sum += coefficient;
                if sum.is_zero() {
                    self.terms.remove(&monomial);
                }
            }
            None if coefficient.is_zero() => {}
            None => drop(self.terms.insert(monomial, coefficient)),
        }
    }

    /// The only term, if there is exactly one.
    pub(super) fn single(&self) -> Option<(&Monomial, &Rational)> {
        if self.terms.len() == 1 { self.terms.iter().next() } else { None }
    }

    /// c and q with c q^2 = self and fewer terms in q; found in short polynomials of one expression.
    pub(super) fn as_square(&self) -> Option<(Rational, Polynomial)> {
        // The square of n terms has at most n (n + 1)/2 terms.
        if self.terms.len() > MAX_ROOT * (MAX_ROOT + 1) / 2 {
            return None;
        }
        let [atom] = Vec::from_iter(self.atoms())[..] else { return None };
        let leading = |polynomial: &Polynomial| {
            let terms = polynomial.terms.iter();
            let terms = terms.map(|(monomial, c)| (monomial.first().map_or(0, |it| it.1), c));
            terms.max_by_key(|(exponent, _)| *exponent).map(|(exponent, c)| (exponent, c.clone()))
        };
        let (degree, factor) = leading(self)?;
        if degree % 2 != 0 {
            return None;
        }
        let mut root = Polynomial::power_of(atom, degree / 2);
        while root.terms.len() < self.terms.len() && root.terms.len() <= MAX_ROOT {
            let rest = self.clone().plus(&root.times(&root)?, &-factor.clone())?;
            // Twice the next term of the root times x^(degree/2) is the leading term of the remainder.
            let Some((exponent, c)) = leading(&rest) else { return Some((factor, root)) };
            let next = Polynomial::power_of(atom, exponent - degree / 2);
            root = root.plus(&next, &(c / (&factor * Rational::from(2))))?;
        }
        None
    }

    /// Every expression of which the polynomial has a power.
    pub(super) fn atoms(&self) -> SortedSet<Expr> {
        self.terms.keys().flatten().map(|(atom, _)| *atom).collect()
    }

    /// `self + factor other`.
    pub(super) fn plus(mut self, other: &Polynomial, factor: &Rational) -> Option<Self> {
        for (monomial, coefficient) in &other.terms {
            self.add(monomial.clone(), coefficient * factor);
        }
        (self.terms.len() <= MAX_TERMS).then_some(self)
    }

    /// `self other`.
    pub(super) fn times(&self, other: &Polynomial) -> Option<Self> {
        if self.terms.len() * other.terms.len() > 8 * MAX_TERMS {
            return None;
        }
        let mut product = Polynomial::default();
        for (a, first) in &self.terms {
            for (b, second) in &other.terms {
                product.add(join(a, b)?, first * second);
            }
        }
        (product.terms.len() <= MAX_TERMS).then_some(product)
    }

    /// A power by repeated squaring; `reduce` is applied to every longer product.
    pub(super) fn power(
        &self,
        exponent: u32,
        reduce: impl Fn(Polynomial) -> Option<Polynomial>,
    ) -> Option<Self> {
        let mut power = Self::constant(Rational::ONE);
        for bit in (0..u32::BITS - exponent.leading_zeros()).rev() {
            power = reduce(power.times(&power)?)?;
            if exponent >> bit & 1 == 1 {
                power = reduce(power.times(self)?)?;
            }
        }
        Some(power)
    }
}

/// The expression of a monomial.
pub(super) fn product(graph: &mut Graph, monomial: &Monomial) -> Expr {
    graph.product(monomial.iter().map(|(atom, exponent)| (*atom, Rational::from(*exponent))))
}

/// The product of two monomials.
fn join(a: &Monomial, b: &Monomial) -> Option<Monomial> {
    let mut joined = [&a[..], b].concat();
    joined.sort_by_key(|(atom, _)| *atom);
    joined.dedup_by(|(atom, exponent), (last, total)| {
        let is_same = atom == last;
        if is_same {
            *total = total.saturating_add(*exponent);
        }
        is_same
    });
    joined.retain(|(_, exponent)| *exponent != 0);
    let is_short = |(_, exponent): &(Expr, i32)| exponent.unsigned_abs() <= MAX_EXPONENT;
    joined.iter().all(is_short).then_some(joined)
}
