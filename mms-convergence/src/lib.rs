//! The statistics of the errors of a study: the observed order, its interval, the terms behind it, and a verdict.
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
//! | 2 | the order ln(e1/e2)/ln(h1/h2) | the order alone, which is compared with the expected one, without a test for settling |
//! | 3 | two orders p1, p2 | the [interval](Estimate): p1, p2, and p2 + 1.25 (p2 - p1)/(r - 1), the possible end of the drift |
//! | 4 and more, or replicates | ln e = ln C + p ln h | the 95 % interval by Student's t, from the scatter |
//! | 3 and more | e = C h^p + D h^(p-1) + E h^(p+1) | the [share](Share) of D in the finest error, which decides |
//! | 3 and more | e = C h^p + D h^q, q of 0, p - 1, p + 1, p + 2 | the [second term](ErrorTerm) that explains a drift, its share and the length at which it takes over |
//! | 4 and more | e = e0 + C h^p | the [limit](Limit): consistent, if the interval of e0 contains 0 |
//!
//! A share s of the term h^(p-1) lowers the order on the finest level by s. It is known to within u, three quarters of its
//! standard deviation. The scatter behind u includes the scatter about the fit, a further level with a deviation of 2.5 %, and
//! printed digits. If errors follow a power law to 0.1 %, its order is judged instead of p - s. For two levels, their order is
//! judged; beside an l2, their l1 and linf fail only if the order is too low by more than half an order.
//!
//! * `pass`: s + u is at most the tolerance, and the order is not above.
//! * `fail`: s - u is more than the tolerance, and the order of the finest pair is low too. Also if errors level off:
//!   e0 is known to a fifth, and lowers the order by twice the tolerance. Also if a run stopped.
//! * `not asymptotic`: otherwise; also if the order is above p by more than the tolerance and u.
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
