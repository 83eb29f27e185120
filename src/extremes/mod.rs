//! The solver at its limits: each row meets its bound, or stops with the right diagnosis.
//!
//! | step | from -> to | where |
//! |---|---|---|
//! | read | `rows.toml` -> rows | [`rows`] |
//! | make | a field and a row -> the field at that extreme, and the method | [`subject`] |
//! | run | these -> errors over the size of the motion, or why there are none | [`subject`] |
//! | judge | what is seen of a row -> its verdict | [`verdict`] |
//! | analyse | a method on an endless grid -> its largest stable Courant number | [`theory`] |
//! | bisect | the same, measured | [`stable`] |

pub mod rows;
pub mod stable;
pub mod subject;
pub mod theory;
pub mod verdict;
