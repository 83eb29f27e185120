//! `mms new`: a field file to start from.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow, bail};
use clap::Args;
use clap::builder::{ArgPredicate, PossibleValue, PossibleValuesParser, TypedValueParser};
use mms_codegen::Options;
use mms_exact::template::{self, Body, Template};
use mms_exact::{Input, gallery};
use mms_files::write;
use mms_options::field::open;
use mms_spec::foreign::{self, shown};
use mms_spec::{field_name, section};

use super::{CommandOutcome, print};

/// Where fields are kept, in this project and in others.
const FIELDS: &str = "fields";

/// The committed JSON Schema, seen from a folder beside `docs`.
const SCHEMA: &str = "../docs/field.schema.json";

/// Write a new field file that passes `mms check`, with comments that explain every section.
///
/// The displacement is a sine wave, the claims and closed forms are true, and the built-in solver converges with order 2.
/// Existing files are never overwritten.
#[derive(Args)]
pub struct New {
    /// The name of the field and of its file: lower-case letters, digits and underscores, a letter first.
    name: String,
    /// The number of space dimensions: 1, 2 or 3.
    #[arg(long, value_name = "D", value_parser = clap::value_parser!(u8).range(1..=3), required_unless_present = "from_axisymmetric", default_value_if("from_axisymmetric", ArgPredicate::IsPresent, "3"))]
    dimension: u8,
    /// Revolve an axisymmetric field, a gallery name or the path of a TOML file, and write the field in three dimensions, for
    /// codes without R and Z. Its body excludes the axis; closed forms and studies are left out.
    #[arg(long, value_name = "FIELD", conflicts_with_all = ["dimension", "shape", "material", "undeformed"])]
    from_axisymmetric: Option<String>,
    /// The shape of the body; an annulus needs `--dimension 2`.
    #[arg(long, value_name = "SHAPE", value_parser = bodies(), default_value = "box")]
    shape: Body,
    /// A shipped material; see `mms list`.
    #[arg(long, value_name = "NAME", default_value = "neo_hookean")]
    material: String,
    /// Start the motion with u = v = 0 and an acceleration that is not 0, as production codes can. By default the body is
    /// deformed at the start.
    #[arg(long)]
    undeformed: bool,
    /// The folder to write to; by default the folder `fields` if it exists, else the current folder.
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Reads the shape of a body.
fn bodies() -> impl TypedValueParser<Value = Body> {
    let names = Body::ALL.map(|it| PossibleValue::new(it.name()).help(it.doc()));
    PossibleValuesParser::new(names).try_map(|name| Body::of(&name).ok_or("no such shape"))
}

impl New {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        field_name::validate(&self.name).map_err(|mistake| anyhow!(mistake))?;
        let dimension = usize::from(self.dimension);
        if self.shape == Body::Annulus && dimension != 2 {
            bail!("`--shape annulus` is 2-dimensional: it needs `--dimension 2`");
        }
        let folder = self.folder();
        let section = self.from_axisymmetric.as_deref();
        let section = section.map(|field| in_space(field, &folder)).transpose()?;
        let material = template::material(&self.material)?;
        let path = folder.join(format!("{}.toml", self.name));
        let shown = foreign::path(&path);
        // First, since `..` leads nowhere from a folder that is not there.
        fs::create_dir_all(&folder)
            .with_context(|| format!("cannot make the folder `{}`", foreign::path(&folder)))?;
        let template = Template {
            name: &self.name,
            path: &shown,
            dimension,
            body: self.shape,
            material: &material,
            is_undeformed: self.undeformed,
            schema: folder.join(SCHEMA).is_file().then_some(SCHEMA),
        };
        write_new(&path, &section.unwrap_or_else(|| template.text()))?;
        print(&self.next_steps(&shown))?;
        Ok(CommandOutcome::AsExpected)
    }

    fn folder(&self) -> PathBuf {
        match &self.output {
            Some(folder) => folder.clone(),
            None if Path::new(FIELDS).is_dir() => FIELDS.into(),
            None => PathBuf::new(),
        }
    }

    fn next_steps(&self, path: &str) -> String {
        let mut lines = vec![
            format!("{path}: written; next"),
            format!("  mms check {path}   # mistakes, claims and closed forms"),
            format!("  mms show {path}    # every formula that follows from it"),
        ];
        if self.shape == Body::Box && self.from_axisymmetric.is_none() {
            lines.push(format!("  mms study {path}   # the order of the solver on it"));
        }
        if gallery::find(&self.name).is_some() {
            lines.push(format!(
                "note: `mms show {0}` shows the gallery's own `{0}`; name this one by its path",
                self.name
            ));
        }
        lines.join("\n")
    }
}

/// The text of the field of three dimensions that a named axisymmetric field generates by revolution, for a file in a folder.
fn in_space(field: &str, folder: &Path) -> anyhow::Result<String> {
    let input = Input::new(open(field)?, &Options::default())?;
    let spec = &input.compiled.field;
    let refuse = |why: &str| {
        anyhow!(
            "`--from-axisymmetric {}`: {why}; expected an axisymmetric field without that",
            shown(field)
        )
    };
    let model = spec.material.model.value.raw();
    let model = match model.ends_with(".toml") {
        true if !field.ends_with(".toml") => {
            return Err(refuse("its material is a file, and the field is named without its path"));
        }
        true => seen_from(folder, Path::new(field).parent().unwrap_or(Path::new("")), model)?,
        false => model.to_owned(),
    };
    section::in_space(spec, &model).map_err(refuse)
}

/// A path from the folder `other`, as a path from `folder`: the same if both are one folder, otherwise absolute.
fn seen_from(folder: &Path, other: &Path, path: &str) -> anyhow::Result<String> {
    let whole = |it: &Path| std::path::absolute(it).map(|it| it.components().collect::<PathBuf>());
    // The empty path is the working folder.
    let [folder, other] = [folder, other].map(|it| whole(&Path::new(".").join(it)));
    let (folder, other) = (folder?, other?);
    match folder == other {
        true => Ok(path.to_owned()),
        false => Ok(whole(&other.join(path))?.to_string_lossy().into_owned()),
    }
}

/// Writes a file that must not be there yet.
fn write_new(path: &Path, text: &str) -> anyhow::Result<()> {
    let shown = foreign::path(path);
    match write::write_new(path, text) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            bail!(
                "`{shown}` exists already, and was not changed; choose another name or `--output`"
            )
        }
        Err(error) => Err(error).with_context(|| format!("cannot write `{shown}`")),
    }
}
