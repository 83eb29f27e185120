//! The reading of a file, with reasons, as `mms judge --explain` prints it.

use std::collections::BTreeMap;

use anyhow::Context as _;
use mms_documents::judge::{ExplainedFile, ExplainedQuantity};
use mms_exact::Exact;
use mms_results::Snapshot;
use mms_results::cell::CellShape;
use mms_results::names::Role;
use mms_results::own::LeftOut;
use mms_spec::foreign::shown;

use super::Results;
use super::extent::motion;
use super::level::{Reading, values};

/// The reading of one file.
pub struct Explained {
    /// The file.
    file: String,
    /// The name of the format.
    format: &'static str,
    /// The times of the results.
    times: Vec<f64>,
    /// The file of each result, in the order of times.
    paths: Vec<String>,
    /// The number of points.
    points: usize,
    /// The source of X.
    positions: String,
    /// The cells by kinds, in words.
    cells: Vec<String>,
    /// The quantities, each with its arrays and the reason.
    quantities: Vec<(Role, String)>,
    /// The arrays, cells and points that are left out, and why.
    left_out: Vec<String>,
}

impl Explained {
    /// Explains how results are read, by their first time.
    ///
    /// # Errors
    /// Positions or names that cannot be read, or no results.
    pub fn new(
        results: &mut Results,
        reading: &Reading<'_>,
        exact: &mut Exact,
    ) -> anyhow::Result<Self> {
        let ghosts = results.keep_own()?;
        let file = results.name.clone();
        let snapshot = results.snapshots.first();
        let snapshot = snapshot.with_context(|| format!("{}: no results", shown(&file)))?;
        let time = snapshot.time.map_or(exact.window[0], |time| time.value);
        let meanings = reading.meanings(snapshot, exact)?;
        let motion = motion(snapshot, &meanings, time, (exact, reading.is_part))?;
        let (mut quantities, mut left_out) = (Vec::new(), Vec::new());
        for meaning in &meanings {
            let place = matches!(meaning.role, Role::Place | Role::Position | Role::Reference);
            match reading.unlike(meaning, snapshot, &motion, exact) {
                Some(why) if !place => left_out.push(why),
                _ => {
                    let mut how = meaning.explained(snapshot);
                    if let Err(error) = values(meaning, snapshot, exact) {
                        how += &format!("; OPEN: {error:#}");
                    }
                    quantities.push((meaning.role, how));
                }
            }
        }
        let is_used = |name: &str| meanings.iter().any(|it| it.has_array(snapshot, name));
        let arrays = snapshot.of_points.iter().chain(&snapshot.of_cells);
        let names = arrays.map(|it| &it.name).chain(&snapshot.unread);
        left_out.extend(names.filter(|it| !is_used(it)).map(|it| format!("{it} (not a quantity)")));
        let LeftOut { ghost_cells, ghost_points, doubled, unused } = ghosts;
        let counts = [
            (ghost_cells, "ghost cells"),
            (ghost_points, "ghost points"),
            (doubled, "duplicate cells"),
            (unused, "points of no cell"),
        ];
        let counts = counts.into_iter().filter(|(count, _)| *count > 0);
        left_out.extend(counts.map(|(count, of)| format!("{count} {of}")));
        Ok(Explained {
            format: snapshot.format,
            times: results.snapshots.iter().filter_map(|it| Some(it.time?.value)).collect(),
            paths: results.snapshots.iter().map(|it| it.path.clone()).collect(),
            points: snapshot.rows(),
            positions: motion.how.clone(),
            cells: cells(snapshot),
            quantities,
            left_out,
            file,
        })
    }

    /// The explanation as text, a row for each item.
    pub fn text(&self) -> String {
        let times = match self.times.as_slice() {
            [] => "none in the file: give them with `--time`".into(),
            [only] => format!("{only:?}"),
            [first, .., last] => format!("{} from {first:?} to {last:?}", self.times.len()),
        };
        let cells = if self.cells.is_empty() { "none".into() } else { self.cells.join(", ") };
        let left_out =
            if self.left_out.is_empty() { "nothing".into() } else { self.left_out.join(", ") };
        let mut rows = vec![("format", self.format.to_owned()), ("times", times)];
        rows.extend(self.each_file().map(|it| ("file", it)));
        rows.extend([("points", format!("{}; {}", self.points, self.positions)), ("cells", cells)]);
        rows.extend(self.quantities.iter().map(|(role, how)| (role.symbol(), how.clone())));
        rows.push(("left out", left_out));
        let width = rows.iter().map(|(key, _)| key.len()).max().unwrap_or(0);
        let row = |(key, words): &(&str, String)| format!("\n  {key:width$}  {words}");
        format!("{}{}", shown(&self.file), rows.iter().map(row).collect::<String>())
    }

    /// The files of a folder or a pattern, each with its times; none, if the name means one file.
    fn each_file(&self) -> impl Iterator<Item = String> {
        let mut files: Vec<(&str, Vec<f64>)> = Vec::new();
        for (at, path) in self.paths.iter().enumerate() {
            let path = path.trim_matches('`');
            let time = self.times.get(at).filter(|_| self.times.len() == self.paths.len());
            match files.last_mut().filter(|it| it.0 == path) {
                Some((_, times)) => times.extend(time),
                None => files.push((path, time.copied().into_iter().collect())),
            }
        }
        let are_several = files.len() > 1;
        files.into_iter().filter(move |_| are_several).map(|(path, times)| match times.as_slice() {
            [] => path.to_owned(),
            [only] => format!("{path}, t = {only:?}"),
            [first, .., last] => {
                format!("{path}, {} times from {first:?} to {last:?}", times.len())
            }
        })
    }

    /// The explanation as a document.
    pub fn document(&self) -> ExplainedFile {
        let quantity = |(role, how): &(Role, String)| ExplainedQuantity {
            quantity: role.name().to_owned(),
            how: how.clone(),
        };
        ExplainedFile {
            file: self.file.clone(),
            format: self.format.to_owned(),
            times: self.times.clone(),
            paths: self.paths.iter().map(|it| it.trim_matches('`').to_owned()).collect(),
            points: self.points,
            positions: self.positions.clone(),
            cells: self.cells.clone(),
            quantities: self.quantities.iter().map(quantity).collect(),
            left_out: self.left_out.clone(),
        }
    }
}

/// The cells of a snapshot by their types.
fn cells(snapshot: &Snapshot) -> Vec<String> {
    let mut counts = BTreeMap::<(u8, usize), usize>::new();
    let kinds = snapshot.cells.iter().map(|(kind, points)| (kind, points.len()));
    kinds.for_each(|kind| *counts.entry(kind).or_default() += 1);
    let of = |(&(kind, points), count): (&(u8, usize), &usize)| match CellShape::of(kind, points) {
        Some(shape) => {
            format!("{count} of dimension {} and degree {}", shape.dimension, shape.degree())
        }
        None => format!("{count} of type {kind} of VTK"),
    };
    counts.iter().map(of).collect()
}
