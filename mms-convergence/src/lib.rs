//! What the errors of a study say: the observed order, the interval in which it lies, what hides behind it, and a
//! verdict.
//!
//! The exact solution is known, and so is every error. What is uncertain is the order that errors have, and not the
//! solution: there is no grid convergence index here. The manner is that of L. Eca and M. Hoekstra, A procedure for the
//! estimation of the numerical uncertainty of CFD calculations based on grid refinement studies, J. Comput. Phys. 262
//! (2014) 104-130: least squares, with the scatter of what is left as the measure of noise.
//!
//! Errors e_i of one norm on levels h_i (or dt_i) make a [`Sequence`]; several of one h are replicates.
//! [`Finding::of`] holds it to an [`Expected`] order p:
//!
//! | levels | fit | says |
//! |---|---|---|
//! | 2 | the order ln(e1/e2)/ln(h1/h2) | the order alone, which is held to the expected one, and not whether it is settled |
//! | 3 | two orders p1, p2 | the [interval](Estimate): p1, p2, and p2 + 1.25 (p2 - p1)/(r - 1), where the drift may lead |
//! | 4 and more, or replicates | ln e = ln C + p ln h | the interval of 95 % by Student's t, from the scatter |
//! | 3 and more | e = C h^p + D h^(p-1) + E h^(p+1) | the [share](Share) that D has of the finest error, which decides |
//! | 3 and more | e = C h^p + D h^q, q of 0, p - 1, p + 1, p + 2 | the [second term](Term) that explains a drift, its share and where it takes over |
//! | 4 and more | e = e0 + C h^p | the [limit](Limit): consistent, if the interval of e0 holds 0 |
//!
//! A share s of the term h^(p-1) lowers the order on the finest level by s. It is known to within u, three quarters of its
//! standard deviation. The scatter behind u is that about the fit, of a further level that is off by 2.5 %, and of
//! printed digits. Errors that follow a power law to 0.1 % are judged by its order instead of p - s, and two levels by theirs.
//!
//! * `pass`: s + u is the tolerance at most, and the order is not above.
//! * `fail`: s - u is more than the tolerance, and the order of the finest pair is low too. So it is if errors level off:
//!   e0 is known to a fifth, and lowers the order by twice the tolerance. A run that stopped is a `fail`.
//! * `not asymptotic`: else; so too if the order is above p by more than the tolerance and u.
//! * `exact to round-off`: who measured knows that every error is nothing but round-off ([`Sequence::exact`]).
//!
//! ```
//! use mms_convergence::{Expected, Finding, Sample, Sequence, Verdict};
//!
//! let hidden = |h: f64| Sample::new(h, 0.8 * h * h + 0.2 * h / 16.0);
//! let levels = Sequence::new([1.0, 0.5, 0.25, 0.125, 0.0625].map(hidden));
//! let finding = Finding::of(&levels, Expected::new(2.0, 0.15));
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

pub use finding::{Expected, Finding, Reason};
pub use grid::{Fit, fit};
pub use judgement::{Judged, Judgement};
pub use limit::Limit;
pub use order::{Basis, Estimate};
pub use sequence::{Level, Sample, Sequence, observed_order};
pub use share::Share;
pub use term::{Kind, Term};
pub use verdict::{CONSTANT_TOLERANCE, RULE, TOLERANCE, Verdict, is_near};
pub use words::{Name, bound};

/// How likely what is sought lies outside an interval.
pub(crate) const OUTSIDE: f64 = 0.05;
