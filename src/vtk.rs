//! States of a run for ParaView: one `.vtu` file each, and a `.pvd` file that says when they were.
//!
//! The XML formats of "VTK File Formats" (Kitware, 2023), particles as vertices, numbers in base64. A file appears
//! under its name when it is whole, and the list is written anew with each state: so whatever stops a run, what is
//! there can be opened. `.ci/states.py` reads them with meshio.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use mms_runtime::study::Frame;
use mms_spec::foreign;

use crate::report::write_own;

/// The number of a vertex among the types of cells.
const VERTEX: u8 = 1;

/// Writes states to a folder.
pub struct Writer {
    folder: PathBuf,
    name: String,
    /// How many states after the initial one.
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
        write_own(&path, &document(frame))
            .with_context(|| format!("cannot write `{}`", foreign::path(&path)))?;
        self.written.push((frame.time, file));
        self.write_list()
    }

    /// The file to open.
    pub fn list(&self) -> PathBuf {
        self.folder.join(format!("{}.pvd", self.name))
    }

    fn write_list(&self) -> anyhow::Result<()> {
        let mut text = head("Collection");
        text += "<Collection>\n";
        for (time, file) in &self.written {
            let file = attribute(file);
            let _ = writeln!(text, r#"<DataSet timestep="{time:e}" file="{file}"/>"#);
        }
        text += "</Collection>\n</VTKFile>\n";
        let path = self.list();
        write_own(&path, &text).with_context(|| format!("cannot write `{}`", foreign::path(&path)))
    }
}

/// The text as the value of an attribute.
fn attribute(text: &str) -> String {
    foreign::markup(text).replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

fn head(kind: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
    )
}

/// A state as a grid of vertices.
fn document(frame: &Frame) -> String {
    let Frame { dimension, .. } = *frame;
    let count = frame.position.len() / dimension;
    let vector = |name: &str, values: &[f64]| numbers(name, &padded(values, dimension, [1, 3]), 3);
    let tensor =
        |name: &str, values: &[f64]| numbers(name, &padded(values, dimension, [dimension, 9]), 9);
    let whole = |name: &str, values: &mut dyn Iterator<Item = u64>| {
        let bytes: Vec<u8> = values.flat_map(u64::to_le_bytes).collect();
        array("UInt64", name, 1, &bytes)
    };
    let mut text = head("UnstructuredGrid");
    text += "<UnstructuredGrid>\n";
    let _ = writeln!(
        text,
        "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" \
         format=\"ascii\">{:e}</DataArray>\n</FieldData>",
        frame.time
    );
    let _ = writeln!(text, r#"<Piece NumberOfPoints="{count}" NumberOfCells="{count}">"#);
    text += "<PointData>\n";
    text += &whole("particle", &mut (0..count as u64));
    text += &vector("displacement", &frame.displacement);
    text += &vector("displacement_error", &frame.displacement_error);
    text += &vector("velocity", &frame.velocity);
    text += &tensor("deformation_gradient", &frame.deformation_gradient);
    text += &tensor("cauchy_stress", &frame.cauchy_stress);
    text += "</PointData>\n<Points>\n";
    text += &vector("position", &frame.position);
    text += "</Points>\n<Cells>\n";
    text += &whole("connectivity", &mut (0..count as u64));
    text += &whole("offsets", &mut (1..=count as u64));
    text += &array("UInt8", "types", 1, &vec![VERTEX; count]);
    text += "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    text
}

/// Tensors of `rows` rows of `dimension` components each, with what is missing of the `size` that they have in three
/// dimensions: 0.
fn padded(values: &[f64], dimension: usize, [rows, size]: [usize; 2]) -> Vec<f64> {
    let mut all = Vec::new();
    for tensor in values.chunks(dimension * rows) {
        let start = all.len();
        all.resize(start + size, 0.0);
        for (row, components) in tensor.chunks(dimension).enumerate() {
            all[start + 3 * row..][..dimension].copy_from_slice(components);
        }
    }
    all
}

fn numbers(name: &str, values: &[f64], components: usize) -> String {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    array("Float64", name, components, &bytes)
}

/// A named array of numbers: how many bytes, and these.
fn array(kind: &str, name: &str, components: usize, bytes: &[u8]) -> String {
    let mut all = (bytes.len() as u64).to_le_bytes().to_vec();
    all.extend_from_slice(bytes);
    let text = STANDARD.encode(all);
    format!(
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
         format=\"binary\">{text}</DataArray>\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_components_are_zero() {
        assert_eq!(padded(&[1.0, 2.0], 1, [1, 3]), [1.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
        let lonely = padded(&[1.0, 2.0], 1, [1, 9]);
        assert_eq!(
            (lonely.len(), lonely[0], lonely[9], lonely.iter().sum::<f64>()),
            (18, 1.0, 2.0, 3.0)
        );
        assert_eq!(
            padded(&[1.0, 2.0, 3.0, 4.0], 2, [2, 9]),
            [1.0, 2.0, 0.0, 3.0, 4.0, 0.0, 0.0, 0.0, 0.0]
        );
    }

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
