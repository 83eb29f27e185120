//! A figure of the documents of commands.

use std::path::{Path, PathBuf};

use anyhow::{anyhow, bail};
use mms_files::read::{self, FileKind};
use mms_spec::foreign;
use serde_json::Value;

use super::{Entry, KINDS, entry};
use crate::plot::{Figure, Plot};

/// Reads the curves of some files. Curves of several files share a panel if they share its axes, under the names of their
/// methods or files.
///
/// # Errors
/// A file that cannot be read, that is of another kind or version, or that has nothing to draw.
pub fn read(paths: &[PathBuf]) -> anyhow::Result<Figure> {
    let mut titles = Vec::new();
    // The plots over the same axes, each with its file.
    let mut panels: Vec<Vec<(&Path, Plot)>> = Vec::new();
    for path in paths {
        let entry = read_one(path)?;
        let drawn = entry.section.plots().into_iter().filter(|it| !it.is_empty());
        let plots: Vec<Plot> = drawn.collect();
        if plots.is_empty() {
            bail!("`{}`: {}", foreign::path(path), lack(&entry));
        }
        titles.push(entry.section.title());
        for plot in plots {
            let is_alike = |(other, it): &(&Path, Plot)| other != path && it.axes == plot.axes;
            match panels.iter_mut().find(|all| all.iter().any(is_alike)) {
                Some(panel) => panel.push((path, plot)),
                None => panels.push(vec![(path, plot)]),
            }
        }
    }
    let panels = panels.into_iter().map(|it| together(it, paths)).collect();
    Ok(Figure::new(titles.join("; "), panels))
}

/// Plots over the same axes as one: each curve has the name of its method or, without one, of its file.
fn together(mut plots: Vec<(&Path, Plot)>, paths: &[PathBuf]) -> Plot {
    if plots.len() == 1 {
        return plots.swap_remove(0).1;
    }
    let alike = |path: &Path| paths.iter().filter(|it| it.file_stem() == path.file_stem()).count();
    // A head that all plots share says nothing.
    if plots.iter().all(|(_, it)| it.head == plots[0].1.head) {
        plots.iter_mut().for_each(|(_, it)| it.head.clear());
    }
    let named = plots.into_iter().map(|(path, plot)| {
        let whole = path.with_extension("");
        let stem = path.file_stem().map_or(path, Path::new);
        plot.named(&foreign::path(if alike(path) > 1 { &whole } else { stem }))
    });
    let together = named.reduce(|mut all, it| {
        all.add(it);
        all
    });
    together.unwrap_or_default()
}

/// The result in a file.
fn read_one(path: &Path) -> anyhow::Result<Entry> {
    let shown = foreign::path(path);
    let text = read::text(path, FileKind::Result)?;
    let document: Value = serde_json::from_str(&text)
        .map_err(|error| anyhow!("`{shown}`: not JSON: {error}; {}", expected()))?;
    entry(&shown, &document).map_err(|why| anyhow!("`{shown}`: {why}; {}", expected()))
}

/// The documents that have curves.
fn expected() -> String {
    let names: Vec<_> = KINDS.iter().filter(|it| it.has_curves).map(|it| it.name).collect();
    format!("expected a document of `mms {}`", names.join("`, `"))
}

/// The reason why a result has no curves.
fn lack(entry: &Entry) -> String {
    match KINDS.iter().find(|kind| kind.heading == entry.heading) {
        Some(kind) if !kind.has_curves => {
            format!("a document of `mms {}` has no curves; {}", kind.name, expected())
        }
        _ => "no error in it is a positive number, so there is nothing to draw".into(),
    }
}
