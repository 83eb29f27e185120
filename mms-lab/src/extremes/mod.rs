//! The solver at its limits: each row meets its bound, or stops with the right diagnosis.
//!
//! `rows.toml` is data: what is extreme, the bound or the expected diagnoses, and why. The regimes are the same as for
//! `mms accuracy`: a row that does not apply to a field has a reason. Claims are checked again with the new values, and a box
//! elsewhere is a variation of its own. For `mms accuracy` J falls to a given value at the evaluated points, and for a run in
//! the whole body and time window.
//!
//! | step | from -> to | where |
//! |---|---|---|
//! | read | `rows.toml` -> rows | [`rows`] |
//! | make | a field and a row -> the field at that extreme, and the method | [`subject`] |
//! | run | these -> errors relative to the size of the motion, or the reason for missing ones | [`subject`] |
//! | judge | the result of a row -> its verdict | [`verdict`] |
//! | analyse | a method on an endless grid -> its largest stable Courant number | [`theory`] |
//! | bisect | a method on a body -> its largest stable Courant number, measured | [`stable`] |

pub mod rows;
pub mod stable;
pub mod subject;
pub mod theory;
pub mod verdict;
