//! The names of the columns in a table of errors.

/// The content of a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Column {
    /// h.
    CellSize,
    /// dt.
    TimeStep,
    /// The part of the errors of a run that round-off alone makes.
    Floor,
    /// Other content: counts, orders, times, remarks.
    Other,
    /// Errors of a quantity in a norm.
    Error {
        /// The quantity; empty if the column's name is a norm alone.
        quantity: String,
        /// The norm; if the column names none, the column's name.
        norm: String,
    },
}

/// The known norms, and their usual names.
const NORMS: [(&str, &[&str]); 4] = [
    ("l1", &["l1", "mean", "average", "avg", "mae"]),
    ("l2", &["l2", "rms", "rmse"]),
    ("linf", &["linf", "loo", "inf", "max", "maximum"]),
    ("h1", &["h1"]),
];

/// Words without meaning.
const FILLERS: [&str; 7] = ["error", "errors", "err", "e", "norm", "of", "in"];

/// Words that mark a column as no error anywhere in its name: orders, and the cost of a run.
const NO_ERRORS: [&str; 24] = [
    "order",
    "orders",
    "rate",
    "rates",
    "eoc",
    "roc",
    "slope",
    "ratio",
    "cpu",
    "gpu",
    "wall",
    "walltime",
    "runtime",
    "elapsed",
    "timing",
    "duration",
    "seconds",
    "sec",
    "secs",
    "minutes",
    "hours",
    "memory",
    "iterations",
    "iters",
];

/// Words that mark a column as no error at the head of its name: counts, numbers and times.
const COUNTS: [&str; 41] = [
    "cells",
    "cell",
    "n",
    "nx",
    "ny",
    "nz",
    "ncells",
    "nel",
    "nelem",
    "nnodes",
    "elements",
    "elems",
    "element",
    "dof",
    "dofs",
    "ndof",
    "ndofs",
    "nodes",
    "vertices",
    "points",
    "npoints",
    "particles",
    "np",
    "steps",
    "nsteps",
    "level",
    "lvl",
    "levels",
    "refinement",
    "refinements",
    "cycle",
    "mesh",
    "grid",
    "run",
    "its",
    "id",
    "index",
    "unnamed",
    "number",
    "time",
    "failure",
];

/// Words before a count.
const ARTICLES: [&str; 5] = ["num", "no", "number", "total", "solve"];

impl Column {
    /// Recognises a column by its name.
    pub fn named(name: &str) -> Self {
        let lower = name.to_lowercase();
        match lower.as_str() {
            "h" | "dx" | "cell_size" => return Column::CellSize,
            "dt" | "time_step" => return Column::TimeStep,
            "round_off" | "floor" => return Column::Floor,
            _ => {}
        }
        let joined = ["1", "2", "inf"]
            .iter()
            .fold(lower, |name, which| name.replace(&format!("l_{which}"), &format!("l{which}")));
        let joined = joined.replace("h_1", "h1");
        let words: Vec<&str> =
            joined.split(|c: char| !c.is_alphanumeric()).filter(|it| !it.is_empty()).collect();
        let is_article = |word: &&&str| words.len() > 1 && ARTICLES.contains(*word);
        let head = words.iter().find(|word| !is_article(word) && !FILLERS.contains(*word));
        let is_count = head.is_some_and(|word| COUNTS.contains(word));
        if words.is_empty() || is_count || words.iter().any(|word| NO_ERRORS.contains(word)) {
            return Column::Other;
        }
        let norm_of = |word: &str| NORMS.iter().find(|(_, all)| all.contains(&word)).map(|it| it.0);
        let mut norms = words.iter().filter_map(|word| norm_of(word));
        match (norms.next(), norms.next()) {
            (Some(norm), None) => {
                let is_told = |word: &&&str| norm_of(word).is_none() && !FILLERS.contains(word);
                let rest: Vec<&str> = words.iter().filter(is_told).copied().collect();
                Column::Error { quantity: rest.join("_"), norm: norm.to_owned() }
            }
            _ => Column::Error { quantity: name.to_owned(), norm: name.to_owned() },
        }
    }
}
