//! A field that a user named, compiled.

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

use anyhow::{Context as _, Error, anyhow, bail, ensure};
use dashu_ratio::RBig;
use mms_codegen::compile::{Failure, compile_unproved};
use mms_codegen::variation::Variation;
use mms_codegen::{Compiled, Options, Selection, compile_with};
use mms_documents::provenance;
use mms_interpreted::Interpretable;
use mms_mechanics::{Program, TooLarge};
use mms_runtime::Division;
use mms_runtime::scene::{Code, Scene};
use mms_spec::foreign::{Foreign, shown};
use mms_spec::own::Own;
use mms_spec::quantity::Quantity;
use mms_spec::suggest::advice;
use mms_spec::twin::Twin;
use mms_spec::{Form, Space};
use mms_symbolic::sorted::SortedMap;
use mms_symbolic::work::Stop;

use crate::provenance::input as provenance_of;
use crate::source::{Compile, Source};

/// A field that a user named, compiled.
#[derive(Clone)]
pub struct Input {
    /// The name.
    pub name: Foreign,
    /// Everything derived from the text, or the part that was selected.
    pub compiled: Arc<Compiled>,
    /// The compiled code, if the program has it and no variant of the field was requested.
    code: Option<Code>,
    source: Arc<Source>,
    options: Options,
}

/// A text that does not compile.
#[derive(Debug)]
pub struct Mistaken {
    subject: &'static str,
    /// Every mistake, at its place.
    pub failure: Failure,
}

impl fmt::Display for Mistaken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n{}", self.subject, self.failure)
    }
}

impl std::error::Error for Mistaken {}

impl Input {
    /// Compiles a field, or the part of it that the options select.
    ///
    /// # Errors
    /// The mistakes of the text, each at its place; a claim that does not hold: [`Mistaken`].
    pub fn new(source: Source, options: &Options) -> anyhow::Result<Input> {
        Self::compiled_as(compile_with, Arc::new(source), options)
    }

    /// Compiles a field without proofs, to be interpreted even where the program has its code.
    ///
    /// # Errors
    /// The mistakes of the text, each at its place.
    pub fn interpreted(source: Source, options: &Options) -> anyhow::Result<Input> {
        let input = Self::compiled_as(compile_unproved, Arc::new(source), options)?;
        Ok(Input { code: None, ..input })
    }

    fn compiled_as(
        compile: Compile,
        source: Arc<Source>,
        options: &Options,
    ) -> anyhow::Result<Input> {
        let compiled = source
            .compile_as(compile, options)
            .map_err(|failure| Mistaken { subject: source.subject(options), failure })?;
        let is_original = options.selection.twin == Twin::Nothing
            && options.selection.window.is_none()
            && options.form == Form::Stable
            && options.variation == Variation::Nothing;
        Ok(Input {
            name: compiled.field.name.clone(),
            compiled: Arc::new(compiled),
            code: source.code().filter(|_| is_original),
            source,
            options: options.clone(),
        })
    }

    /// The field with other defaults of parameters, by `name=value` settings; for emitted code.
    ///
    /// # Errors
    /// A setting that the field refuses.
    pub fn with_defaults(&self, settings: &[String]) -> anyhow::Result<Input> {
        if settings.is_empty() {
            return Ok(self.clone());
        }
        let selection =
            Selection { set: self::settings(settings)?, ..self.options.selection.clone() };
        let options = Options { selection, ..self.options.clone() };
        Self::compiled_as(compile_with, self.source.clone(), &options)
    }

    /// Compiles the field with another selection or variation, without proofs.
    ///
    /// # Errors
    /// The mistakes that the options make.
    pub fn varied(&self, options: &Options) -> Result<Compiled, Failure> {
        self.source.compile(options)
    }

    /// The text, to be compiled in another way.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Returns a copy of the field that `stop` ends: another thread can set it.
    pub fn stopped_by(&self, stop: Stop) -> Input {
        Input { options: Options { stop, ..self.options.clone() }, ..self.clone() }
    }

    /// The options with which it was compiled.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The files from which it was read; none for a field of the gallery.
    pub fn files(&self) -> Vec<PathBuf> {
        let Some(field) = self.source.path() else { return Vec::new() };
        let material = self.compiled.own_material();
        let material = material.map(|(material, _)| field.with_file_name(material));
        [field.clone()].into_iter().chain(material).collect()
    }

    /// The input of a document about the field with some settings.
    pub fn provenance(&self, settings: &[String]) -> provenance::Input {
        provenance_of(self.source.given(), &self.options.selection, settings, &self.compiled)
    }

    /// The compiled field if this program contains it, otherwise the interpreted field, with the parameters of `name=value`
    /// settings. `build` selects the function of the compiled code for the precision `T`.
    pub fn scene<T: Interpretable>(
        &self,
        settings: &[String],
        build: impl Fn(&Code) -> fn(&[T]) -> Option<Scene<T>>,
    ) -> anyhow::Result<Scene<T>> {
        self.scene_with(&self.settings(settings)?, build)
    }

    /// The field for a solver, compiled or interpreted, with parameters that are set by position.
    pub fn scene_with<T: Interpretable>(
        &self,
        set: &SortedMap<usize, RBig>,
        build: impl Fn(&Code) -> fn(&[T]) -> Option<Scene<T>>,
    ) -> anyhow::Result<Scene<T>> {
        match self.code {
            Some(code) => build(&code)(&self.compiled.parameters::<T>(set))
                .context("the gallery is out of step with its field files: build again"),
            None => {
                self.validate_rings()?;
                Ok(mms_interpreted::scene(self.compiled.clone(), set)?)
            }
        }
    }

    /// The program of a quantity on request; `None` for a quantity that the field was compiled with.
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

    /// Refuses settings with which a compilation finds a contradiction in the field, such as J <= 0 somewhere.
    ///
    /// # Errors
    /// Settings that contradict the field, or that it does not have.
    pub fn validate_settings(&self, settings: &[String]) -> anyhow::Result<()> {
        if self.settings(settings)?.is_empty() {
            return Ok(());
        }
        let selection = Selection {
            quantities: Some([Quantity::Jacobian].into()),
            set: self::settings(settings)?,
            ..self.options.selection.clone()
        };
        let options = Options { selection, ..self.options.clone() };
        let compiled = self.source.compile_as(compile_with, &options);
        compiled.map(drop).map_err(|failure| not_allowed(settings, &failure))
    }
}

/// The error of settings that the field refuses, at its place in the field file.
fn not_allowed(settings: &[String], failure: &Failure) -> Error {
    let settings: Vec<_> = settings.iter().map(|setting| given(setting)).collect();
    anyhow!("{}: not what the field file allows\n{failure}", settings.join(" "))
}

/// The setting of a parameter, as the user gave it.
fn given(setting: &str) -> String {
    format!("`--set {}`", shown(setting))
}

/// New defaults of parameters: names, and numbers or formulas.
pub fn settings(settings: &[String]) -> anyhow::Result<Vec<(String, String)>> {
    let pair = |setting: &String| match setting.split_once('=') {
        Some((name, value)) => Ok((name.trim().to_string(), value.trim().to_string())),
        None => bail!("{}: expected name=value", given(setting)),
    };
    settings.iter().map(pair).collect()
}

impl Input {
    /// The quantities that the field offers among these names: `all` leaves out quantities that it does not offer.
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
            self.compiled.validate_offered(quantity).map_err(Error::msg)?;
        }
        quantities.retain(|it| self.compiled.offers(*it));
        Ok(quantities)
    }

    /// Refuses a static field for a solver that follows a motion.
    ///
    /// # Errors
    /// The field is static.
    pub fn validate_moving(&self) -> anyhow::Result<()> {
        self.validate_rings()?;
        self.validate_body("a solver has nothing to fill with particles")?;
        ensure!(
            !self.is_static(),
            "`{}` is static: the explicit solver computes motions; `mms run` and `mms study` compute an equilibrium with \
             `--relax`; `mms emit` and `mms state` give your solver what it needs, and `mms judge` and `mms diagnose` \
             take its results",
            self.name.shown()
        );
        Ok(())
    }

    /// Refuses a field that moves for a solver that goes to an equilibrium.
    ///
    /// # Errors
    /// The field moves.
    pub fn validate_static(&self) -> anyhow::Result<()> {
        self.validate_rings()?;
        ensure!(
            self.is_static(),
            "`--relax`: `{}` moves, and is in equilibrium only by chance; leave `--relax` out to follow it, or give a \
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
    /// The field has no body.
    pub fn validate_body(&self, why: &str) -> anyhow::Result<()> {
        validate_body(&self.compiled, why)
    }

    /// Refuses an axisymmetric field with a swirl, which the solver has no particles for.
    ///
    /// # Errors
    /// The field has a swirl.
    fn validate_rings(&self) -> anyhow::Result<()> {
        ensure!(
            self.compiled.field.space != (Space::Axisymmetric { swirl: true }),
            "`{}` has a swirl, and the built-in solver moves rings only along R and Z; `mms check`, `mms eval`, `mms \
             show`, `mms accuracy`, `mms emit`, `mms judge` and `mms state --points` take this field",
            self.name.shown()
        );
        Ok(())
    }

    /// Whether nothing moves: the field has no time.
    pub fn is_static(&self) -> bool {
        self.compiled.model.domain.is_static
    }
}

/// Refuses a compiled field without a body; `why` says what needs one.
///
/// # Errors
/// The field has no body.
pub fn validate_body(compiled: &Compiled, why: &str) -> anyhow::Result<()> {
    ensure!(
        !compiled.field.domain.body.is_nothing(),
        "`{}` has no body (`shape = \"none\"`): {why}; `mms eval`, `mms emit` and `mms show` work without one",
        compiled.field.name.shown()
    );
    Ok(())
}

/// Refuses an option with more or fewer numbers than the field has axes.
pub fn validate_division(option: &str, numbers: &Division, dimension: usize) -> anyhow::Result<()> {
    match *numbers {
        Division::PerAxis(each, given) if given != dimension => bail!(
            "`{option} {numbers}`: {given} numbers for {dimension} dimension(s); expected one for each, or one for \
             all, as in `{option} {}`",
            each[0]
        ),
        _ => Ok(()),
    }
}
