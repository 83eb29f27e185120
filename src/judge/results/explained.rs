//! How a file is read, and why: what `mms judge --explain` prints.

use std::collections::BTreeMap;

use mms_results::Snapshot;
use mms_results::cell::Shape;
use mms_results::motion::resolve;
use mms_results::names::Role;
use mms_spec::foreign::shown;
use serde_json::{Value, json};

use super::level::Reading;
use super::{Results, placed};
use crate::session::exact::Exact;

/// How one file is read.
pub struct Explained {
    /// Keys and words: the times, the points, the cells, each quantity, and the arrays that are left out.
    rows: Vec<(String, String)>,
    /// The file.
    name: String,
}

impl Explained {
    /// How results are read; of several times the first.
    ///
    /// # Errors
    /// As of [`Reading::measure`].
    pub fn new(
        results: &mut Results,
        reading: &Reading<'_>,
        exact: &mut Exact,
    ) -> anyhow::Result<Self> {
        let left_out = results.keep_own()?;
        let mut rows = vec![("times".to_owned(), times(&results.snapshots))];
        if let Some(snapshot) = results.snapshots.first() {
            let time = snapshot.time.map_or(exact.window[0], |time| time.value);
            let meanings = reading.meanings(snapshot, exact)?;
            let outside = |point: &[f64]| exact.body.distance(point);
            let mut back = exact.back(time, snapshot.rows());
            let motion = resolve(snapshot, &meanings, exact.dimension, &outside, Some(&mut back))
                .map_err(placed)?;
            rows.insert(0, ("format".to_owned(), snapshot.format.to_owned()));
            rows.push(("points".to_owned(), format!("{}; {}", snapshot.rows(), motion.how)));
            rows.push(("cells".to_owned(), cells(snapshot)));
            let mut other = Vec::new();
            for meaning in &meanings {
                let place = matches!(meaning.role, Role::Place | Role::Position | Role::Reference);
                match reading.unlike(meaning, snapshot, &motion, exact.rows()) {
                    Some(why) if !place => other.push(why),
                    _ => rows.push((meaning.role.symbol().to_owned(), meaning.explained(snapshot))),
                }
            }
            let is_used = |name: &str| meanings.iter().any(|it| it.has_array(snapshot, name));
            let arrays = snapshot.of_points.iter().chain(&snapshot.of_cells);
            let names = arrays.map(|it| &it.name).chain(&snapshot.unread);
            other
                .extend(names.filter(|it| !is_used(it)).map(|it| format!("{it} (not a quantity)")));
            for (count, what) in
                [(left_out.ghost_cells, "ghost cells"), (left_out.ghost_points, "ghost points")]
            {
                if count > 0 {
                    other.push(format!("{count} {what}"));
                }
            }
            if other.is_empty() {
                other.push("nothing".to_owned());
            }
            rows.push(("left out".to_owned(), other.join(", ")));
        }
        Ok(Explained { rows, name: results.name.clone() })
    }

    /// The rows as text.
    pub fn text(&self) -> String {
        let width = self.rows.iter().map(|(key, _)| key.chars().count()).max().unwrap_or(0);
        let row = |(key, words): &(String, String)| format!("\n  {key:width$}  {words}");
        format!("{}{}", shown(&self.name), self.rows.iter().map(row).collect::<String>())
    }

    /// The rows as a document.
    pub fn document(&self) -> Value {
        let rows: Vec<Value> =
            self.rows.iter().map(|(key, words)| json!({ "what": key, "how": words })).collect();
        json!({ "file": self.name, "rows": rows })
    }
}

fn times(snapshots: &[Snapshot]) -> String {
    let times: Vec<f64> = snapshots.iter().filter_map(|it| it.time.map(|it| it.value)).collect();
    match times.as_slice() {
        [] => "none in the file: give it with `--time`".into(),
        [only] => format!("{only:?}"),
        [first, .., last] => format!("{} from {first:?} to {last:?}", times.len()),
    }
}

/// The cells of a snapshot by their types.
fn cells(snapshot: &Snapshot) -> String {
    let mut counts = BTreeMap::<u8, usize>::new();
    snapshot.cells.iter().for_each(|(kind, _)| *counts.entry(kind).or_default() += 1);
    let of = |(kind, count): (&u8, &usize)| match Shape::of(*kind) {
        Some(shape) => {
            format!("{count} of dimension {} and degree {}", shape.dimension, shape.degree())
        }
        None => format!("{count} of type {kind} of VTK"),
    };
    match counts.is_empty() {
        true => "none: norms are over points".into(),
        false => counts.iter().map(of).collect::<Vec<_>>().join(", "),
    }
}
