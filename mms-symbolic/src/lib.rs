//! Exact expressions, and passes over them.
//!
//! [`expr`] is the graph: hash-consed, canonical, over exact rationals. [`pass`] rewrites and differentiates it. [`work`]
//! counts and limits the steps, [`sorted`] has the maps and sets of all crates above. Nothing here depends on mechanics, a
//! number format or a language.

pub mod expr;
pub mod pass;
pub mod sorted;
pub mod work;
