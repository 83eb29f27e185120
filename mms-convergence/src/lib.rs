//! The statistics of the errors of a study: the observed order, its interval, the terms of the error that change it, and a
//! verdict.
//!
//! The exact solution is known, and so is every error. The uncertain quantity is the order of the errors, not the solution:
//! there is no grid convergence index here. The method follows L. Eca and M. Hoekstra, A procedure for the estimation of the
//! numerical uncertainty of CFD calculations based on grid refinement studies, J. Comput. Phys. 262 (2014) 104-130: least
//! squares, with the scatter of the residuals as the measure of noise.
//!
//! Errors e_i of one norm on levels h_i (or dt_i) make a [`Sequence`]; several errors of one h are replicates.
//! [`NormFinding::of`] compares it with an [`ExpectedOrder`] p:
//!
//! | levels | fit | result |
//! |---|---|---|
//! | 2 | the order ln(e1/e2)/ln(h1/h2) | the order, compared with p; two levels cannot show whether it still drifts |
//! | 3 | two orders p1, p2 | the [interval](Estimate) from the least to the greatest of p1, p2 and p2 + 1.25 (p2 - p1)/(r - 1) |
//! | 4 and more, or replicates | ln e = ln C + p ln h | the 95 % interval of the order by Student's t, from the scatter |
//! | 3 and more | e = C h^p + D h^(p-1) + E h^(p+1) | the [share](Share) s of the term D h^(p-1) in the finest error |
//! | 3 and more | e = C h^p + D h^q, q one of 0, p - 1, p + 1, p + 2 | the [second term](ErrorTerm) that explains a drift, its share, and the length at which both terms are equal |
//! | 4 and more | e = e0 + C h^p with free p | the [limit](Limit) e0: the method is consistent if the interval of e0 contains 0 |
//!
//! For three levels, r is the ratio h2/h3 of the two finer lengths, and the third number bounds the further drift of the order.
//!
//! With three levels or more, the share s decides the verdict: it lowers the order on the finest level by s. The interval of the
//! share is s - u to s + u, where u is three quarters of the standard deviation of s. This deviation is computed from the
//! residuals of the fit, from a scatter of 2.5 % with the weight of one more level, and from the rounding of printed digits. If
//! errors scatter about one power law by at most 0.1 %, the order of the power law is judged, and s is not used. With two
//! levels, the order of the pair is judged; if l2 is judged too, l1 and linf of two levels fail only if their order is more than
//! 0.5 too low.
//!
//! * `pass`: s + u is at most the tolerance, and the order is not above p by more than the tolerance and u.
//! * `fail`: s - u is more than the tolerance, and the order of the finest pair is low too. A study also fails if its errors
//!   level off: the half width of the interval of e0 is at most a fifth of e0, and e0 lowers the order by more than twice the
//!   tolerance. A study also fails if a run stopped.
//! * `not asymptotic`: otherwise.
//! * `exact to round-off`: the caller knows that every error is at round-off ([`Sequence::exact`]).
//!
//! ```
//! use mms_convergence::{ExpectedOrder, NormFinding, Sample, Sequence, Verdict};
//!
//! let hidden = |h: f64| Sample::new(h, 0.8 * h * h + 0.2 * h / 16.0);
//! let levels = Sequence::new([1.0, 0.5, 0.25, 0.125, 0.0625].map(hidden));
//! let finding = NormFinding::of(&levels, ExpectedOrder::new(2.0, 0.15));
//! assert_eq!(finding.verdict, Verdict::Fail);
//! let term = finding.term.expect("a second term");
//! assert!((term.order - 1.0).abs() < 1e-12 && (term.share - 0.2).abs() < 1e-9);
//! ```

mod finding;
mod grid;
mod judgement;
mod least;
mod limit;
mod order;
mod sequence;
mod share;
mod student;
mod term;
mod verdict;
mod words;

pub use finding::{ExpectedOrder, NormFinding, Reason};
pub use grid::{Fit, fit};
pub use judgement::{Judgement, NormJudgement};
pub use limit::Limit;
pub use order::{Basis, Estimate};
pub use sequence::{Sample, Sequence, SequenceLevel, observed_order};
pub use share::Share;
pub use term::{ErrorTerm, TermKind};
pub use verdict::{CONSTANT_TOLERANCE, RULE, TOLERANCE, Verdict, is_near};
pub use words::{Name, bound};

/// The probability that a value lies outside its interval.
pub(crate) const OUTSIDE: f64 = 0.05;
