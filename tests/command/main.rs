//! The `mms` command as a user meets it: the built program, run in a folder of its own.

mod accuracy;
mod bound;
mod check;
mod checkpoint;
mod emit;
mod eval;
mod extremes;
mod files;
mod form;
mod main_job;
mod material;
mod mms;
mod new;
mod overview;
mod report;
mod rigid;
mod run;
mod saved;
mod show;
mod study;
mod study_files;
mod study_methods;
mod tradeoff;
mod verify;
mod vtk;
