//! Emitters: a program as text of one target language each. They print; they neither
//! differentiate nor reorder.

pub mod rust;
