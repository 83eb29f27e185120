//! States of a run for ParaView: one `.vtu` file each, and a `.pvd` file that says when they were.
//!
//! The XML formats of "VTK File Formats" (Kitware, 2023), particles as vertices, numbers in base64. A file appears under its
//! name when it is whole, and the list is written anew with each state: after any stop of a run, its files can be opened.
//! `.ci/states.py` reads them with meshio.

use std::io::{BufWriter, Write as _};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use mms_files::write::{write_own, write_own_with};
use mms_results::Cells;
use mms_results::names::Axes;
use mms_results::write::{ArrayShape, Column, Mesh, State, vtu};
use mms_runtime::study::Frame;
use mms_spec::foreign;
use mms_state::file::list;

/// Writes states to a folder.
pub struct Writer {
    folder: PathBuf,
    name: String,
    /// The number of states after the initial one.
    frames: usize,
    /// Times and files.
    written: Vec<(f64, String)>,
}

impl Writer {
    /// Into a folder, which is made if it is not there; files begin with `name`. A run that goes on from a `step` has
    /// `written` some before.
    ///
    /// # Errors
    /// A folder that cannot be made or written to, or that lacks those states.
    pub fn new(
        folder: &Path,
        name: &str,
        frames: usize,
        step: usize,
        written: Vec<(f64, String)>,
    ) -> anyhow::Result<Self> {
        let are_there = written.iter().all(|(_, file)| folder.join(file).is_file());
        if step > 0 && (written.is_empty() || !are_there) {
            bail!(
                "`--vtk {}`: it does not hold the states before the checkpoint; name the folder that the run wrote \
                 to, or none",
                foreign::path(folder)
            );
        }
        let wrong = || format!("`--vtk {}`: cannot write there", foreign::path(folder));
        std::fs::create_dir_all(folder).with_context(wrong)?;
        let writer = Self {
            folder: folder.to_owned(),
            name: name.to_owned(),
            frames: frames.max(1),
            written,
        };
        // Said before any work is done.
        writer.write_list().with_context(wrong)?;
        Ok(writer)
    }

    /// The states so far: times and files.
    pub fn written(&self) -> &[(f64, String)] {
        &self.written
    }

    /// Whether the state after a step is one of those that are equally far apart.
    pub fn wants(&self, step: usize, steps: usize) -> bool {
        let passed = |step: usize| step * self.frames / steps;
        step == 0 || passed(step) > passed(step - 1)
    }

    /// Writes a state, and the list.
    ///
    /// # Errors
    /// A file that cannot be written, by its name.
    pub fn write(&mut self, frame: &Frame) -> anyhow::Result<()> {
        let file = format!("{}_{:04}.vtu", self.name, self.written.len());
        let path = self.folder.join(&file);
        write_state(&path, &state(frame), &frame.position, &Cells::default())
            .with_context(|| format!("cannot write `{}`", foreign::path(&path)))?;
        self.written.push((frame.time, file));
        self.write_list()
    }

    /// The file to open.
    pub fn list(&self) -> PathBuf {
        self.folder.join(format!("{}.pvd", self.name))
    }

    fn write_list(&self) -> anyhow::Result<()> {
        let path = self.list();
        write_own(&path, &list(&self.written))
            .with_context(|| format!("cannot write `{}`", foreign::path(&path)))
    }
}

/// Writes one state in a folder that was named.
fn write_state(path: &Path, state: &State, position: &[f64], cells: &Cells) -> anyhow::Result<()> {
    write_own_with(path, |file| {
        let mut file = BufWriter::new(file);
        vtu(state, Mesh { position, cells }, &mut file)?;
        Ok(file.flush()?)
    })
}

/// The columns of a frame.
fn state(frame: &Frame) -> State {
    let count = frame.position.len() / frame.dimension;
    let column = |name: &str, shape, values: &[f64]| Column {
        name: name.to_owned(),
        shape,
        values: values.to_vec(),
    };
    // A body of revolution has all nine components, in the order R, Z, hoop.
    let tensor = |name: &str, meridian: &[f64], around: &[f64]| match around {
        [] => column(name, ArrayShape::Tensor, meridian),
        around => {
            let nine = meridian
                .chunks_exact(4)
                .zip(around)
                .flat_map(|(it, &hoop)| [it[0], it[1], 0.0, it[2], it[3], 0.0, 0.0, 0.0, hoop]);
            column(name, ArrayShape::Nine, &nine.collect::<Vec<_>>())
        }
    };
    let particles: Vec<f64> = (0..count).map(|particle| particle as f64).collect();
    State {
        time: frame.time,
        dimension: frame.dimension,
        axes: Axes::Cartesian,
        facts: Vec::new(),
        columns: vec![
            column("particle", ArrayShape::Whole, &particles),
            column("displacement", ArrayShape::Vector, &frame.displacement),
            column("displacement_error", ArrayShape::Vector, &frame.displacement_error),
            column("velocity", ArrayShape::Vector, &frame.velocity),
            tensor("deformation_gradient", &frame.deformation_gradient, &frame.hoop_stretch),
            tensor("cauchy_stress", &frame.cauchy_stress, &frame.hoop_stress),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_written_as_text() {
        let folder = tempfile::tempdir().unwrap();
        let mut writer = Writer::new(folder.path(), "a&b \"<c>\"", 4, 0, Vec::new()).unwrap();
        writer.written.push((0.5, "a&b \"<c>\"_0000.vtu".to_owned()));
        writer.write_list().unwrap();
        let text = std::fs::read_to_string(writer.list()).unwrap();
        let document = roxmltree::Document::parse(&text).unwrap();
        let state = document.descendants().find(|node| node.has_tag_name("DataSet")).unwrap();
        assert_eq!(state.attribute("file"), Some("a&b \"<c>\"_0000.vtu"));
    }

    #[test]
    fn states_are_equally_far_apart_and_include_the_last() {
        let folder = tempfile::tempdir().unwrap();
        let writer = Writer::new(folder.path(), "run", 4, 0, Vec::new()).unwrap();
        let wanted = |steps| -> Vec<usize> {
            (0..=steps).filter(|&step| writer.wants(step, steps)).collect()
        };
        assert_eq!(wanted(8), vec![0, 2, 4, 6, 8]);
        assert_eq!(wanted(3), vec![0, 1, 2, 3]);
        assert_eq!(wanted(10), vec![0, 3, 5, 8, 10]);
    }
}
