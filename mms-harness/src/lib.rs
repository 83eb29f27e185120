//! Campaigns: an external solver on the meshes of several studies, each judged as `mms judge` does it.
//!
//! [`plan`] makes the runs of a file, each with the data that its result depends on: the words of its command, the contents of
//! the files that these start, name or import (`dependencies` and `imports`, by their `digests`) and of files that the file lists
//! (`sources`), the field, and versions. [`work`] makes the runs that the store does not contain, each in a folder of its own below the store,
//! and keeps there a record of its results. [`judged`] measures them, and [`report`] makes the document. [`canary`] plans the
//! same runs with a wrong b. [`suggest`] finds the fields of the gallery that test the most of a solver.

pub mod canary;
mod dependencies;
mod digests;
mod imports;
pub mod judged;
pub mod only;
pub mod plan;
pub mod profile;
pub mod report;
mod sources;
pub mod suggest;
pub mod work;
