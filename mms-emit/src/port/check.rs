//! What check programs have in common: what they say of themselves, and what they run.
//!
//! A check program calls a function at all points of one set of parameters, compares the results in one call, and
//! accepts 64 eps of their largest magnitude. Where the formulas lose more than half of that in the interpreter's
//! double precision, a set of parameters other than the defaults is left out, and with the defaults four times
//! that loss is accepted: a port is to be right, not better than its formulas.

use super::Port;
use super::callable::Callable;
use super::vectors::Sample;

/// A function that a check program runs.
pub struct Check<'a> {
    /// The function.
    pub callable: &'a Callable,
    /// Its place among the functions of the field.
    pub place: usize,
    /// What it must give: for each set of parameters, at its points or once.
    pub expected: Vec<&'a [Vec<f64>]>,
    /// The error that is accepted, in eps.
    pub accepted: u32,
    /// The same in single precision, where that has the range.
    pub accepted_in_single: Option<u32>,
}

impl Check<'_> {
    /// The error that is accepted in either precision.
    pub fn accepted_in_both(&self) -> u32 {
        self.accepted.max(self.accepted_in_single.unwrap_or(0))
    }
}

impl Port<'_> {
    /// The functions that have an expected value.
    pub fn checks(&self) -> Vec<Check<'_>> {
        let vectors = self.subject.vectors();
        let check = |(place, callable): (usize, _)| {
            let rows: &[Vec<f64>] = &vectors.expected[place];
            (!rows.is_empty()).then(|| Check {
                callable,
                place,
                expected: rows.chunks(rows.len() / vectors.sets.len()).collect(),
                accepted: vectors.accepted[place],
                accepted_in_single: vectors.accepted_in_single.as_ref().map(|it| it[place]),
            })
        };
        self.callables.iter().enumerate().filter_map(check).collect()
    }

    /// How many points each set of parameters has.
    pub fn points(&self) -> usize {
        let vectors = self.subject.vectors();
        vectors.samples.len() / vectors.sets.len()
    }

    /// The points of each set of parameters; none where no point has a value.
    pub fn samples(&self) -> Vec<&[Sample]> {
        self.subject.vectors().samples.chunks(self.points().max(1)).collect()
    }

    /// The first comment of a program that checks a file.
    pub fn check_header(&self, file: &str) -> Vec<String> {
        let mut header = self.header();
        header.push(format!(
            "Checks {file}: runs every function at the points below, prints its worst error, and fails where that is not accepted. {}",
            self.subject.vectors().meaning()
        ));
        header
    }
}

/// Rows of numbers as columns.
pub fn columns(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let width = rows.first().map_or(0, Vec::len);
    (0..width).map(|column| rows.iter().map(|row| row[column]).collect()).collect()
}

/// A program without its lines from one that begins so up to one that begins so.
pub fn without(program: &str, first: &str, end: &str) -> String {
    let lines = program.split_inclusive('\n');
    let mut is_left = true;
    let is_kept = |line: &&str| {
        is_left = (is_left && !line.starts_with(first)) || line.starts_with(end);
        is_left
    };
    lines.filter(is_kept).collect()
}
