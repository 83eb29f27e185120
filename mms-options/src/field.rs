//! The field that a user names, its variant, and how it is opened.

use std::path::Path;

use anyhow::bail;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
#[cfg(not(feature = "gallery"))]
use mms_bar as linked;
use mms_codegen::{Options, Selection};
use mms_exact::gallery::{self, Entry};
use mms_exact::{Input, Source};
use mms_files::read::{self, FileKind};
#[cfg(feature = "gallery")]
use mms_gallery as linked;
use mms_program::precision::Precision;
use mms_spec::Form;
use mms_spec::foreign::shown;
use mms_spec::quantity::Quantity;
use mms_spec::suggest::advice;
use mms_spec::twin::Twin;

/// The selected motion, and its limits.
#[derive(Clone, Debug, PartialEq, Args)]
pub struct Motion {
    /// Replace the time window of the field: two numbers, or formulas in the parameters, as in '0,length/c'. Claims, proofs,
    /// runs and emitted code then refer to this window.
    #[arg(long, value_name = "FROM,TO", value_parser = window, allow_hyphen_values = true)]
    window: Option<Window>,
    /// Use the rigid twin of the field: the same motion, followed by a rotation about the origin and a translation. MOTION
    /// has the keys of [rigid], as in 'rotation = "pi*t", translation = ["t", "0"]'; the default is a large, accelerated
    /// rigid motion. Faces that were at rest become prescribed, and closed forms are left out.
    #[arg(long, value_name = "MOTION", num_args = 0..=1, default_missing_value = "", value_parser = motion)]
    rigid: Option<String>,
    /// The most nodes, and the most operands, that all expressions of a field may have together; a field that needs more is
    /// refused.
    #[arg(long, value_name = "N", default_value_t = Motion::default().max_nodes)]
    max_nodes: u32,
}

impl Default for Motion {
    fn default() -> Self {
        Motion { window: None, rigid: None, max_nodes: Options::default().max_nodes as u32 }
    }
}

impl Motion {
    /// The arguments of the command line that select the motion.
    pub fn arguments(&self) -> Vec<String> {
        let mut arguments = Vec::new();
        if self.max_nodes != Motion::default().max_nodes {
            arguments.push(format!("--max-nodes={}", self.max_nodes));
        }
        if let Some(Window([from, to])) = &self.window {
            arguments.push(format!("--window={from},{to}"));
        }
        match self.rigid.as_deref() {
            None => {}
            Some("") => arguments.push("--rigid".into()),
            Some(motion) => arguments.push(format!("--rigid={motion}")),
        }
        arguments
    }

    /// The options that compile this variant of a field, or the selected part of it.
    pub fn options(&self, selection: Selection) -> Options {
        let twin = match self.rigid.as_deref() {
            None => Twin::Nothing,
            Some("") => Twin::Standard,
            Some(motion) => Twin::Given(motion.into()),
        };
        let window = self.window.as_ref().map(|Window(window)| window.clone());
        let selection = Selection { twin, window, ..selection };
        Options { selection, max_nodes: self.max_nodes as usize, ..Options::default() }
    }
}

/// The variant of a field.
#[derive(Clone, Debug, Default, PartialEq, Args)]
pub struct Variant {
    #[command(flatten)]
    motion: Motion,
    /// How quantities are computed: `stable` keeps the error of each within 64 eps of its largest magnitude, at any strain;
    /// `fast` needs the fewest operations, and loses eps/e where the strain e is small.
    #[arg(long, value_name = "stable|fast", default_value = Form::default().name(), value_parser = Form::from_name)]
    form: Form,
}

impl Variant {
    /// The variant with a motion and a form.
    pub fn new(motion: Motion, form: Form) -> Self {
        Variant { motion, form }
    }

    /// The arguments of the command line that select the variant.
    pub fn arguments(&self) -> Vec<String> {
        let mut arguments = self.motion.arguments();
        if self.form != Form::default() {
            arguments.push(format!("--form={}", self.form.name()));
        }
        arguments
    }

    /// The form.
    pub fn form(&self) -> Form {
        self.form
    }

    /// The options that compile this variant of a field, or the selected part of it.
    pub fn options(&self, selection: Selection) -> Options {
        Options { form: self.form, ..self.motion.options(selection) }
    }
}

/// Checks that a text may be a rigid motion. `--rigid` may have no value, and would otherwise read the field's name after it as
/// its value.
fn motion(text: &str) -> Result<String, String> {
    if text.is_empty() || text.contains('=') {
        return Ok(text.to_string());
    }
    Err("expected keys such as 'translation = [\"t\", \"0\"]'; without a value, `--rigid` must follow the field".into())
}

/// A first and a last time.
#[derive(Clone, Debug, PartialEq)]
struct Window([String; 2]);

/// Reads two formulas, separated by the comma outside of parentheses.
fn window(text: &str) -> Result<Window, String> {
    let mut depth = 0;
    let commas = text.char_indices().filter(|(_, char)| {
        depth += i32::from(*char == '(') - i32::from(*char == ')');
        *char == ',' && depth == 0
    });
    match commas.map(|(at, _)| at).collect::<Vec<_>>()[..] {
        [comma] => Ok(Window([&text[..comma], &text[comma + 1..]].map(|part| part.trim().into()))),
        _ => Err("expected the first and the last time, as in 0,0.02".into()),
    }
}

/// Opens the field of a gallery name, or of a path to a TOML file.
///
/// # Errors
/// A name that the gallery lacks, a file that cannot be read.
pub fn open(field: &str) -> anyhow::Result<Source> {
    if !field.ends_with(".toml") {
        return entry(field).map(|entry| Source::shipped(entry, linked::find(entry.name)));
    }
    file(Path::new(field))
}

/// Opens a field file.
///
/// # Errors
/// A file that cannot be read.
pub fn file(path: &Path) -> anyhow::Result<Source> {
    let text = read::text(path, FileKind::Field)?;
    let folder = path.parent().unwrap_or(Path::new(".")).to_path_buf();
    Ok(Source::file(path.to_path_buf(), text, move |material| {
        let text = read::text(&folder.join(material), FileKind::Field);
        text.map_err(|error| error.root_cause().to_string())
    }))
}

/// Opens and compiles the field of a gallery name, or of a path to a TOML file.
///
/// # Errors
/// A field that cannot be opened, or does not compile.
pub fn find(field: &str, variant: &Variant) -> anyhow::Result<Input> {
    Input::new(open(field)?, &variant.options(Selection::default()))
}

/// Opens a field and compiles it without proofs, to be interpreted.
///
/// # Errors
/// The errors of [`find`].
pub fn interpreted(field: &str, variant: &Variant) -> anyhow::Result<Input> {
    Input::interpreted(open(field)?, &variant.options(Selection::default()))
}

/// Opens a field and compiles some quantities of it, which takes less time than all: their values are the same.
///
/// # Errors
/// The errors of [`find`].
pub fn find_some(field: &str, variant: &Variant, quantities: &[Quantity]) -> anyhow::Result<Input> {
    let compiled = quantities.iter().filter(|quantity| !quantity.is_on_request());
    let selection =
        Selection { quantities: Some(compiled.copied().collect()), ..Selection::default() };
    Input::new(open(field)?, &variant.options(selection))
}

/// The field of the gallery of that name.
fn entry(field: &str) -> anyhow::Result<&'static Entry> {
    if let Some(entry) = gallery::find(field) {
        return Ok(entry);
    }
    if Path::new(field).extension().is_some_and(|it| it != "toml") {
        bail!(
            "`{}` is in the place of the field, but is not a field: name one first, as in bar_1d or ./mine.toml",
            shown(field)
        );
    }
    let names = gallery::FIELDS.iter().map(|entry| entry.name);
    let advice = advice(field, names, |all| {
        format!("it holds {all}; a file of your own is given by its path, ending in .toml")
    });
    bail!("no field `{}` in the gallery; {advice}", shown(field))
}

/// Reads the name of any precision. The option of the solver accepts only two, and has a type of its own.
pub fn precision() -> impl TypedValueParser<Value = Precision> {
    let names = PossibleValuesParser::new(Precision::ALL.map(Precision::name));
    names.try_map(|name| Precision::from_name(&name).ok_or("no precision"))
}
