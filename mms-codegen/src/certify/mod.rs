//! Proofs and checks of the claims of a field file.
//!
//! Proofs are over the body, the time window and the ranges of parameters; a parameter without a range has its default. This
//! domain is a box (`chart`): an annulus is a box in radius and angle, X = R cos theta, with sqrt(X^2 + Y^2) replaced by R; a
//! face is a box of one variable less. Before formulas are bounded, common factors are taken out and squares completed
//! (`forms`).
//!
//! | | how | is |
//! |---|---|---|
//! | claims | u, H and N on the face, P at that H, reduced modulo the relations: 0 for any parameters, or for those declared, is `proved`. Else 32 points in 77 digits: beyond 1e-40 of its scale it is `refuted`. Else bounds: within 1e-12 of the scale it is `enclosed`, a warning; the rest is `unproved`, and refused | exact; a refutation is certain |
//! | J > 0 | best-first bisection with mean-value forms and monotonicity, until the bound is within 20 % of a value of J (`sign`) | rigorous |
//! | rho0 > 0; mu > 0 and 3 lambda + 2 mu > 0 at F = I, where a range moves them | the same, after the corners; the moduli of fibres in their own basis (`sign`, `solid`) | rigorous; a refutation is certain |
//! | one analytic branch | the limits of every function that u, the density, the moduli, the fibres, the rigid motion and W are made of, each as a sign that intervals prove (`limits`, `branches`) | rigorous; a refutation is certain |
//! | every quantity is finite | interval arithmetic with J, which is known to be positive, replaced by a symbol. A place without a value is named if 77 digits find none there | rigorous |
//! | it is finite as computed | the scheduled program, with every intermediate value, in `f64` and in `f32` (`computed`) | rigorous for errors of functions up to 8 roundings |
//! | principal stretch, strain rate | bounds of C - I, H, J and of their rates (`rates`) | rigorous |
//! | wave speed | dP/dF by dual numbers over intervals (`rates`, `tangent`) | rigorous |
//! | strong ellipticity | the same, with null Lagrangians added (`ellipticity`); where that fails at one state, directions in which a wave grows there (`softening`) | rigorous; a refutation is certain |
//!
//! Every search has a limit of boxes, beside its budget of steps: 2000 for J, for the density and each modulus, for finite
//! values, for each limit and for each claim, 500 for each rate, 2000 for the wave speed that limits a time step. If J > 0 is
//! not proved by then, the field is refused as unproved. A rate whose search ends early is still a bound, only a coarser one:
//! for most fields of the gallery it is within 20 % of an attained value, for a few in three or four variables only within a
//! factor of 1.8, and for the strain rate of `quiet_boundary_2d` within 2.7 (`tests/certify.rs` pins these factors); more waves
//! in three dimensions cost more.
//!
//! Further checks compare closed forms of the file (`closed_form`), u as it is written (`undefined`), the declared numbers
//! (`crate::declared`), and the stress at rest (`rest`). `certificate` runs all proofs; `claims`, `finite` and `reach` (bounds
//! of x) are further ones; `motion` has the expressions that they bound, `matrix` bounds eigenvalues, and `message` words the
//! results.

pub mod branches;
pub mod certificate;
pub mod claims;
pub mod closed_form;
pub mod computed;
pub mod ellipticity;
pub mod finite;
pub mod limits;
pub mod matrix;
pub mod message;
pub mod motion;
pub mod rates;
pub mod reach;
pub mod rest;
pub mod sign;
pub mod softening;
pub mod solid;
mod tangent;
pub mod undefined;
