//! Files of VTK: in XML, in the legacy format, and lists of such.

mod arrays;
mod base64;
mod cursor;
pub mod legacy;
pub mod lists;
mod structured;
pub mod xml;
