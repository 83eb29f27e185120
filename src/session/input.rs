//! What every command takes: a field, and settings of its parameters.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context as _, Error, anyhow, bail, ensure};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use dashu_ratio::RBig;
use mms_codegen::compile::{Failure, Loader, compile_unproved, own_quantities};
use mms_codegen::selection::{self, quantity};
use mms_codegen::variation::Variation;
use mms_codegen::{Compiled, Options, Selection, compile_with};
use mms_interpreted::Interpretable;
use mms_mechanics::{Program, TooLarge};
use mms_program::precision::Precision;
use mms_runtime::scene::{Code, Scene};
use mms_spec::Form;
use mms_spec::foreign::{Foreign, shown};
use mms_spec::own::Own;
use mms_spec::quantity::Quantity;
use mms_spec::suggest::advice;
use mms_spec::twin::Twin;
use mms_symbolic::sorted::SortedMap;

use crate::gallery::{self, Entry};
use crate::provenance;
use crate::read::{self, Kind};

/// What is wrong where a part of a field does not compile: the file, or the part.
const SELECTED: &str = "the field does not compile as selected";

/// Which motion is taken, and within which limits.
#[derive(Clone, Debug, PartialEq, Args)]
pub struct Motion {
    /// Take another time window: two numbers, or formulas in the parameters, as in '0,length/c'. Everything is of it: claims,
    /// proofs, runs, and what is emitted.
    #[arg(long, value_name = "FROM,TO", value_parser = window, allow_hyphen_values = true)]
    window: Option<Window>,
    /// Take the rigid twin of the field: the same motion, followed by a rotation about the origin and
    /// a translation. MOTION has the keys of [rigid], as in 'rotation = "pi*t", translation = ["t",
    /// "0"]'; without it the motion is a large and accelerated one. Faces that were at rest are then
    /// prescribed, and closed forms left out.
    #[arg(long, value_name = "MOTION", num_args = 0..=1, default_missing_value = "", value_parser = motion)]
    rigid: Option<String>,
    /// How many nodes and operands the expressions of a field may have together; a field that needs
    /// more is refused.
    #[arg(long, value_name = "N", default_value_t = Motion::default().max_nodes)]
    max_nodes: u32,
}

impl Default for Motion {
    fn default() -> Self {
        Motion { window: None, rigid: None, max_nodes: Options::default().max_nodes as u32 }
    }
}

impl Motion {
    /// The arguments that ask for it.
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

    /// Everything of the field, or a part of it.
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

/// How a field is taken.
#[derive(Clone, Debug, Default, PartialEq, Args)]
pub struct Variant {
    #[command(flatten)]
    motion: Motion,
    /// How quantities are computed: `stable` holds each to 64 eps of its largest magnitude, at any
    /// strain; `fast` takes the fewest operations, and loses eps/e where the strain e is small.
    #[arg(long, value_name = "stable|fast", default_value = Form::default().name(), value_parser = Form::from_name)]
    form: Form,
}

impl Variant {
    /// With a motion and a form.
    pub fn new(motion: Motion, form: Form) -> Self {
        Variant { motion, form }
    }

    /// Its form.
    pub fn form(&self) -> Form {
        self.form
    }

    /// Everything of the field, or a part of it.
    pub fn options(&self, selection: Selection) -> Options {
        Options { form: self.form, ..self.motion.options(selection) }
    }
}

/// The keys of a rigid motion, as far as can be told from a distance: an option that may stand
/// without a value takes the name of a field for one.
fn motion(text: &str) -> Result<String, String> {
    if text.is_empty() || text.contains('=') {
        return Ok(text.to_string());
    }
    Err("expected keys such as 'translation = [\"t\", \"0\"]'; without a value, `--rigid` goes behind the field".into())
}

/// A first and a last time.
#[derive(Clone, Debug, PartialEq)]
struct Window([String; 2]);

/// Two formulas, parted by the comma that stands in no parentheses.
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

/// A field that the user named: of the gallery, or of a file.
#[derive(Clone)]
pub struct Input {
    /// Its name.
    pub name: Foreign,
    /// What follows from its text.
    pub compiled: Arc<Compiled>,
    /// Its compiled code, where that is part of this program and the field is taken as it is.
    code: Option<Code>,
    /// What the user named.
    given: String,
    /// How it was compiled.
    options: Options,
}

impl Input {
    /// The field of a gallery name, or of a path to a TOML file.
    pub fn find(field: &str, variant: &Variant) -> anyhow::Result<Input> {
        Self::find_with(field, &variant.options(Selection::default()))
    }

    /// The same of some quantities alone, which takes less time than all of them: whose values are the same.
    pub fn find_some(
        field: &str,
        variant: &Variant,
        quantities: &[Quantity],
    ) -> anyhow::Result<Input> {
        let compiled = quantities.iter().filter(|quantity| !quantity.is_on_request());
        let selection =
            Selection { quantities: Some(compiled.copied().collect()), ..Selection::default() };
        Self::find_with(field, &variant.options(selection))
    }

    /// A part of the field of a gallery name, or of a path to a TOML file.
    pub fn find_with(field: &str, options: &Options) -> anyhow::Result<Input> {
        let text = Text::find(field)?;
        let compiled = text
            .compile_as(compile_with, options)
            .map_err(|failure| anyhow!("{}\n{failure}", text.what_failed(options)))?;
        Ok(Self::new(field, &text, compiled, options))
    }

    /// A field whose quantities come from the interpreter, whatever was compiled of it; and whether or not it is
    /// what it claims to be.
    #[cfg(feature = "defects")]
    pub fn interpreted(field: &str, variant: &Variant) -> anyhow::Result<Input> {
        let (text, options) = (Text::find(field)?, variant.options(Selection::default()));
        let compiled = text
            .compile(&options)
            .map_err(|failure| anyhow!("{}\n{failure}", text.what_failed(&options)))?;
        Ok(Input { code: None, ..Self::new(field, &text, compiled, &options) })
    }

    fn new(field: &str, text: &Text, compiled: Compiled, options: &Options) -> Input {
        let as_it_is = options.selection.twin == Twin::Nothing
            && options.selection.window.is_none()
            && options.form == Form::Stable
            && options.variation == Variation::Nothing;
        let code = text.entry().and_then(Entry::code).filter(|_| as_it_is);
        Input {
            name: compiled.field.name.clone(),
            compiled: Arc::new(compiled),
            code,
            given: field.to_owned(),
            options: options.clone(),
        }
    }

    /// The same field with other defaults of parameters, for who emits code of it.
    ///
    /// # Errors
    /// Settings that are none.
    pub fn with_defaults(&self, settings: &[String]) -> anyhow::Result<Input> {
        if settings.is_empty() {
            return Ok(self.clone());
        }
        let selection =
            Selection { set: self::settings(settings)?, ..self.options.selection.clone() };
        Self::find_with(&self.given, &Options { selection, ..self.options.clone() })
    }

    /// The files that it was read from; none of the gallery.
    pub fn files(&self) -> Vec<PathBuf> {
        if !is_path(&self.given) {
            return Vec::new();
        }
        let field = Path::new(&self.given);
        let material = self.compiled.own_material();
        let material = material.map(|(material, _)| field.with_file_name(material));
        [field.to_owned()].into_iter().chain(material).collect()
    }

    /// What a result of the field, with some settings, is of.
    pub fn provenance(&self, settings: &[String]) -> provenance::Input {
        provenance::input(&self.given, &self.options.selection, settings, &self.compiled)
    }

    /// The compiled field, where this program has it, and the interpreted one otherwise; with the parameters
    /// of `name=value` settings. `build` takes the code of the precision.
    pub fn scene<T: Interpretable>(
        &self,
        settings: &[String],
        build: impl Fn(&Code) -> fn(&[T]) -> Option<Scene<T>>,
    ) -> anyhow::Result<Scene<T>> {
        self.scene_with(&self.settings(settings)?, build)
    }

    /// The same, with parameters that are set by position.
    pub fn scene_with<T: Interpretable>(
        &self,
        set: &SortedMap<usize, RBig>,
        build: impl Fn(&Code) -> fn(&[T]) -> Option<Scene<T>>,
    ) -> anyhow::Result<Scene<T>> {
        match self.code {
            Some(code) => build(&code)(&self.compiled.parameters::<T>(set))
                .context("the gallery is out of step with its field files: build again"),
            None => Ok(mms_interpreted::scene(self.compiled.clone(), set)),
        }
    }

    /// The program of a quantity on request; none of one that the field was compiled with.
    ///
    /// # Errors
    /// One that is too large.
    pub fn on_request(&self, quantity: Quantity) -> anyhow::Result<Option<Program>> {
        if !quantity.is_on_request() {
            return Ok(None);
        }
        let program = self.compiled.on_request(quantity);
        program.map(Some).map_err(|TooLarge(what)| {
            anyhow!(
                "{} of `{}`: the {what} is too large; allow more nodes, with `--max-nodes`",
                quantity.name(),
                self.name.shown()
            )
        })
    }

    /// The parameters that `name=value` settings set, by position.
    pub fn settings(&self, settings: &[String]) -> anyhow::Result<SortedMap<usize, RBig>> {
        let parameters = &self.compiled.model.parameters;
        let mut set = SortedMap::new();
        for setting in settings {
            let given = given(setting);
            let (name, value) =
                setting.split_once('=').with_context(|| format!("{given}: expected name=value"))?;
            let name = name.trim();
            let index = parameters.iter().position(|parameter| parameter.name == name);
            let index = index.with_context(|| {
                let names = parameters.iter().map(|parameter| parameter.name.as_str());
                let advice = advice(name, names, |all| format!("the field has {all}"));
                format!("{given}: no parameter `{}`; {advice}", shown(name))
            })?;
            let value = mms_codegen::compile::constant(value.trim())
                .map_err(|failure| anyhow!("{given}: not a number\n{failure}"))?;
            if set.insert(index, value).is_some() {
                bail!("{given}: `{name}` is set twice");
            }
        }
        if !set.is_empty() {
            self.compiled.accepts(&set).map_err(|failure| not_allowed(settings, &failure))?;
        }
        Ok(set)
    }

    /// Refuses settings with which the field contradicts itself, as with J <= 0 somewhere, as far as a compilation with
    /// them sees that.
    ///
    /// # Errors
    /// Such settings, and those that are none.
    pub fn hold(&self, settings: &[String]) -> anyhow::Result<()> {
        if self.settings(settings)?.is_empty() {
            return Ok(());
        }
        let selection = Selection {
            quantities: Some([Quantity::Jacobian].into()),
            set: self::settings(settings)?,
            ..self.options.selection.clone()
        };
        let options = Options { selection, ..self.options.clone() };
        let compiled = Text::find(&self.given)?.compile_as(compile_with, &options);
        compiled.map(drop).map_err(|failure| not_allowed(settings, &failure))
    }
}

/// What is wrong with settings, at its place in the field file.
fn not_allowed(settings: &[String], failure: &Failure) -> Error {
    let settings: Vec<_> = settings.iter().map(|setting| given(setting)).collect();
    anyhow!("{}: not what the field file allows\n{failure}", settings.join(" "))
}

/// How a parameter was set.
fn given(setting: &str) -> String {
    format!("`--set {}`", shown(setting))
}

/// Whether the user named a file, and not a field of the gallery.
fn is_path(field: &str) -> bool {
    field.ends_with(".toml")
}

/// The field of the gallery of that name.
fn entry(field: &str) -> anyhow::Result<&'static Entry> {
    if let Some(entry) = gallery::find(field) {
        return Ok(entry);
    }
    let names = gallery::FIELDS.iter().map(|entry| entry.name);
    let advice = advice(field, names, |all| {
        format!("it holds {all}; a file of your own is given by its path, ending in .toml")
    });
    bail!("no field `{}` in the gallery; {advice}", shown(field))
}

/// The text of a field that the user named, to be compiled in one way or more.
pub struct Text {
    name: Foreign,
    path: Foreign,
    text: String,
    origin: Origin,
}

/// Where a text is from, and so a material of its own.
enum Origin {
    Gallery(&'static Entry),
    Folder(PathBuf),
}

/// One of the ways to compile.
type Compile = fn(&str, &str, &str, Loader<'_>, &Options) -> Result<Compiled, Failure>;

impl Text {
    /// The text of a gallery name, or of a path to a TOML file.
    pub fn find(field: &str) -> anyhow::Result<Self> {
        if is_path(field) {
            return Self::read(Path::new(field));
        }
        let entry = entry(field)?;
        let [name, path] = [entry.name, entry.path].map(Foreign::from);
        Ok(Text { name, path, text: entry.text.into(), origin: Origin::Gallery(entry) })
    }

    fn read(path: &Path) -> anyhow::Result<Self> {
        let text = read::text(path, Kind::Field)?;
        let folder = path.parent().unwrap_or(Path::new(".")).to_path_buf();
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into();
        let path = path.to_string_lossy().into();
        Ok(Text { name, path, text, origin: Origin::Folder(folder) })
    }

    /// The name of the field.
    pub fn name(&self) -> &Foreign {
        &self.name
    }

    fn entry(&self) -> Option<&'static Entry> {
        match self.origin {
            Origin::Gallery(entry) => Some(entry),
            Origin::Folder(_) => None,
        }
    }

    /// Derives what follows from it, whether or not it is what it claims to be.
    pub fn compile(&self, options: &Options) -> Result<Compiled, Failure> {
        self.compile_as(compile_unproved, options)
    }

    fn compile_as(&self, compile: Compile, options: &Options) -> Result<Compiled, Failure> {
        let load = |material: &str| self.load(material);
        compile(self.name.raw(), self.path.raw(), &self.text, &load, options)
    }

    /// The quantities that the field defines.
    pub fn own_quantities(&self) -> Vec<Own> {
        let load = |material: &str| self.load(material);
        own_quantities(self.name.raw(), self.path.raw(), &self.text, &load)
    }

    /// The text of the material of the field's own.
    fn load(&self, material: &str) -> Result<String, String> {
        match &self.origin {
            Origin::Gallery(entry) => entry.own_material(),
            Origin::Folder(folder) => {
                let read = read::text(&folder.join(material), Kind::Field);
                read.map_err(|error| error.root_cause().to_string())
            }
        }
    }

    /// What is to blame: all of the field, or what was selected of it.
    fn what_failed(&self, options: &Options) -> &'static str {
        // Which quantities are wanted makes no mistake.
        let selection = Selection { quantities: None, ..options.selection.clone() };
        match self.origin {
            _ if selection != Selection::default() => SELECTED,
            Origin::Gallery(_) => "the field of the gallery does not compile",
            Origin::Folder(_) => "the field file has mistakes",
        }
    }
}

/// New defaults of parameters: names, and numbers or formulas.
pub fn settings(settings: &[String]) -> anyhow::Result<Vec<(String, String)>> {
    let pair = |setting: &String| match setting.split_once('=') {
        Some((name, value)) => Ok((name.trim().to_string(), value.trim().to_string())),
        None => bail!("{}: expected name=value", given(setting)),
    };
    settings.iter().map(pair).collect()
}

/// Reads one of all precisions; a solver has two of them, of its own.
pub fn precision() -> impl TypedValueParser<Value = Precision> {
    let names = PossibleValuesParser::new(Precision::ALL.map(Precision::name));
    names.try_map(|name| Precision::from_name(&name).ok_or("no precision"))
}

/// The quantities of some names or aliases that a field with these of its own is compiled with, each once; `all` stands for those of a point and a
/// time.
pub fn quantities(own: &[Own], names: &[String]) -> anyhow::Result<Vec<Quantity>> {
    named(own, names, quantity)
}

impl Input {
    /// The quantities that the field offers, of those of some names: `all` leaves out what it does not offer.
    ///
    /// # Errors
    /// A quantity by name that the field does not offer.
    pub fn offered(
        &self,
        names: &[String],
        mut quantities: Vec<Quantity>,
    ) -> anyhow::Result<Vec<Quantity>> {
        for name in names {
            let Ok(quantity) = self.compiled.quantity(name.trim()) else { continue };
            self.compiled.hold_offered(quantity).map_err(Error::msg)?;
        }
        quantities.retain(|it| self.compiled.offers(*it));
        Ok(quantities)
    }

    /// Refuses a static field for a solver that follows a motion.
    ///
    /// # Errors
    /// The field is static.
    pub fn hold_moving(&self) -> anyhow::Result<()> {
        self.hold_body("a solver has nothing to fill with particles")?;
        ensure!(
            !self.is_static(),
            "`{}` is static: the explicit solver of this project follows motions, and goes to an equilibrium where `mms run` \
             and `mms study` are given `--relax`; `mms emit` and `mms state` give your solver what it needs, and `mms judge` \
             and `mms diagnose` take its results",
            self.name.shown()
        );
        Ok(())
    }

    /// Refuses a field that moves for a solver that goes to an equilibrium.
    ///
    /// # Errors
    /// The field moves.
    pub fn hold_static(&self) -> anyhow::Result<()> {
        ensure!(
            self.is_static(),
            "`--relax`: `{}` moves, and has an equilibrium at no time but by chance; leave `--relax` out to follow it, or give a \
             field without `time` under [domain]",
            self.name.shown()
        );
        Ok(())
    }

    /// The quantities that the field defines.
    pub fn own_quantities(&self) -> Vec<Own> {
        self.compiled.model.own.keys().copied().collect()
    }

    /// Refuses a field without a body; `why` says what needs one.
    ///
    /// # Errors
    /// There is none.
    pub fn hold_body(&self, why: &str) -> anyhow::Result<()> {
        hold_body(&self.compiled, why)
    }

    /// Whether nothing moves: the field has no time.
    pub fn is_static(&self) -> bool {
        self.compiled.model.domain.is_static
    }
}

/// Refuses a compiled field without a body; `why` says what needs one.
///
/// # Errors
/// There is none.
pub fn hold_body(compiled: &Compiled, why: &str) -> anyhow::Result<()> {
    ensure!(
        !compiled.field.domain.body.is_nothing(),
        "`{}` has no body (`shape = \"none\"`): {why}; `mms eval`, `mms emit` and `mms show` work without one",
        compiled.field.name.shown()
    );
    Ok(())
}

/// The same, those on request as well, which `all` leaves out.
pub fn evaluated(own: &[Own], names: &[String]) -> anyhow::Result<Vec<Quantity>> {
    named(own, names, selection::evaluated)
}

fn named(
    own: &[Own],
    names: &[String],
    known: fn(&[Own], &str) -> Result<Quantity, String>,
) -> anyhow::Result<Vec<Quantity>> {
    let mut quantities = Vec::new();
    for name in names.iter().map(|name| name.trim()) {
        if name == "all" {
            let own = own.iter().map(|own| Quantity::Own(*own));
            quantities.extend(Quantity::pointwise().chain(own.filter(|it| !it.takes_normal())));
            continue;
        }
        quantities.push(known(own, name).map_err(Error::msg)?);
    }
    let mut seen = Vec::new();
    quantities.retain(|quantity| {
        let new = !seen.contains(quantity);
        seen.push(*quantity);
        new
    });
    Ok(quantities)
}

/// Reads a field file and derives what follows from it, whether or not it is what it claims to be:
/// an error if it cannot be read, a failure if it is wrong.
pub fn read(path: &Path, options: &Options) -> anyhow::Result<Result<Compiled, Failure>> {
    Ok(Text::read(path)?.compile(options))
}
