//! `mms emit`: the source text of a field, for another solver.

mod folder;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Arg, Args, Command};
use mms_codegen::selection::{Freeze, Selection};
use mms_documents::emit::{self as documents, EmitAll, EmittedFile};
use mms_emit::{Bundle, Subject, TARGETS, Target};
use mms_exact::gallery::FIELDS;
use mms_exact::{Input, quantities, settings};
use mms_files::program::arguments;
use mms_files::shell::{command, quoted, words};
use mms_files::write::refuse_link;
use mms_options::field::{Variant, open};
use mms_spec::foreign::{self, Foreign};
use mms_spec::own::Own;

use self::folder::{State, compare, write};
use super::{CommandOutcome, print, print_json, say};

/// Write the source code of a field for your solver, in its language: all quantities, or only those that it needs.
///
/// A check program and its test vectors are written as well. The last printed line builds and runs this program; with your
/// own compiler and flags in that line, it proves your build. The target rust-mms-math has no check program: it shares its
/// code with this command.
#[derive(Args)]
pub struct Emit {
    /// A name that `mms list` prints, or the path of a TOML file.
    #[arg(required_unless_present = "all")]
    field: Option<String>,
    /// Write every field of the gallery, each to its own folder below --output.
    #[arg(long, conflicts_with = "field", requires = "output")]
    all: bool,
    /// The language of the source.
    #[arg(long, value_name = "NAME", value_parser = targets())]
    target: Option<&'static Target>,
    /// The folder to write to. Without it the source is printed on stdout, if it is one file. Files are never written through
    /// links.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// The quantities to write, separated by commas. The body, the time window and the claims are always written. By default
    /// all quantities and the material are written.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    quantity: Vec<String>,
    /// Change the default of a parameter to a number, or to a formula in the parameters declared above it. Parameters that
    /// depend on it change too. May be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Make parameters constants with their default values, so that terms that are then 0 disappear: all parameters, or the
    /// named ones.
    #[arg(long, value_name = "NAME,..", num_args = 0.., require_equals = true, value_delimiter = ',')]
    freeze: Option<Vec<String>>,
    #[command(flatten)]
    variant: Variant,
    /// Write nothing: compare the files in the folder with the files that would be written, and exit with 1 if one is missing
    /// or differs by a byte.
    #[arg(long, requires = "output")]
    check: bool,
    /// Print one JSON document. It contains the source unless --output is given.
    #[arg(long)]
    json: bool,
}

/// Parses the names of the compiler's list of targets.
fn targets() -> impl TypedValueParser<Value = &'static Target> {
    Targets
}

/// Parses the name of a target. The error for another word names the target that people mean by it.
#[derive(Clone)]
struct Targets;

/// Words of other languages and programs, and the target that serves them.
const MEANT: [(&str, &str); 14] = [
    ("c++", "cpp"),
    ("cxx", "cpp"),
    ("cuda", "cpp"),
    ("dealii", "cpp"),
    ("dolfinx", "ufl"),
    ("f90", "fortran"),
    ("fenics", "ufl"),
    ("fenicsx", "ufl"),
    ("firedrake", "ufl"),
    ("jax", "numpy"),
    ("jl", "julia"),
    ("py", "python"),
    ("rs", "rust"),
    ("scikit-fem", "numpy"),
];

impl TypedValueParser for Targets {
    type Value = &'static Target;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<Self::Value, clap::Error> {
        let word = value.to_string_lossy().to_lowercase();
        if let Some(found) = Target::find(&word) {
            return Ok(found);
        }
        match MEANT.iter().find(|(other, _)| *other == word) {
            Some((_, name)) => {
                let message =
                    format!("no target `{}`; `--target {name}` serves it\n", foreign::shown(&word));
                Err(clap::Error::raw(ErrorKind::InvalidValue, message).with_cmd(command))
            }
            // The error lists the names, and names the nearest.
            None => {
                let names = PossibleValuesParser::new(self.possible_values().into_iter().flatten());
                names
                    .parse_ref(command, argument, value)
                    .and(Err(clap::Error::new(ErrorKind::InvalidValue)))
            }
        }
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let word = |target: &Target| {
            PossibleValue::new(target.name).help(target.doc).aliases(target.alias)
        };
        Some(Box::new(TARGETS.iter().map(word)))
    }
}

impl Emit {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        let Some(target) = self.target else {
            let names: Vec<_> = TARGETS.iter().map(|target| target.name).collect();
            bail!("name the language with `--target`: {}", names.join(", "));
        };
        let own = match &self.field {
            Some(field) => open(field)?.own_quantities(),
            None => Vec::new(),
        };
        let options = self.variant.options(self.selection(&own)?);
        let emitted = |field: &str| {
            let input = Input::new(open(field)?, &options)?;
            input.offered(&self.quantity, Vec::new())?;
            let subject = Subject::new(&input.compiled);
            let bundle = (target.emit)(&subject);
            if bundle.verify.is_some() && !subject.has_values() {
                bail!(
                    "`{}` has no point in its domain where all of these quantities have a value: a check program would \
                     compare nothing; shrink [domain], or ask for others with --quantity",
                    input.name.shown()
                );
            }
            Ok::<_, anyhow::Error>((input.name, bundle))
        };
        let names = match &self.field {
            Some(field) => vec![field.as_str()],
            None => FIELDS.iter().map(|entry| entry.name).collect(),
        };
        let mut documents = Vec::new();
        let mut outcome = CommandOutcome::AsExpected;
        for name in names {
            let (name, bundle) = emitted(name)?;
            let folder = self.output.as_ref().map(|it| self.folder(it, name.raw())).transpose()?;
            let delivered = match folder {
                None => self.printed(target, &bundle)?,
                Some(folder) if self.check => compared(&folder, &bundle)?,
                Some(folder) => written(&folder, &bundle)?,
            };
            if delivered.is_stale() {
                outcome = CommandOutcome::Refuted;
            }
            if self.json {
                documents.push(delivered.document(&name, target, &bundle));
            } else {
                delivered.show()?;
            }
        }
        match (self.json, self.all) {
            (true, true) => {
                print_json(&EmitAll { target: target.name.to_owned(), fields: documents })?
            }
            (true, false) => print_json(&documents[0])?,
            (false, _) => {}
        }
        if outcome == CommandOutcome::Refuted {
            say(format_args!("write them anew: {}", command_without_check()));
        }
        Ok(outcome)
    }

    /// The folder for the files of a field. Refuses a link below the named folder, since it leads to a place that the user did
    /// not name.
    fn folder(&self, named: &Path, field: &str) -> anyhow::Result<PathBuf> {
        if !self.all {
            return Ok(named.to_owned());
        }
        let folder = named.join(field);
        let cannot = || format!("cannot write to `{}`", foreign::path(&folder));
        refuse_link(&folder, "folder").with_context(cannot)?;
        Ok(folder)
    }

    /// The text for stdout: the one file that a solver needs.
    fn printed(&self, target: &Target, bundle: &Bundle) -> anyhow::Result<Delivered> {
        if bundle.sources().len() > 1 && !self.json {
            let names: Vec<_> = bundle.files.iter().map(|file| file.name.as_str()).collect();
            bail!(
                "`--target {}` makes {}: give the folder for them, as in `-o forcing`",
                target.name,
                names.join(", ")
            );
        }
        let texts = bundle.files.iter().map(|file| file.text.clone());
        Ok(Delivered { texts: Some(texts.collect()), ..Delivered::default() })
    }

    fn selection(&self, own: &[Own]) -> anyhow::Result<Selection> {
        let everything = self.quantity.iter().all(|name| name.trim() == "all");
        let wanted = if everything { None } else { Some(quantities(own, &self.quantity)?) };
        let set = settings(&self.set)?;
        let freeze = match &self.freeze {
            None => Freeze::Nothing,
            Some(names) if names.is_empty() => Freeze::Everything,
            Some(names) => Freeze::Only(names.iter().map(|name| name.trim().into()).collect()),
        };
        Ok(Selection {
            quantities: wanted.map(|wanted| wanted.into_iter().collect()),
            set,
            freeze,
            ..Selection::default()
        })
    }
}

/// The paths of the written files of a bundle, or their comparison with the files of a folder.
#[derive(Default)]
struct Delivered {
    texts: Option<Vec<String>>,
    paths: Vec<Foreign>,
    states: Option<Vec<State>>,
    /// The line that checks them, from where the command was run.
    verify: Option<String>,
}

fn written(folder: &Path, bundle: &Bundle) -> anyhow::Result<Delivered> {
    let paths = bundle.files.iter().map(|file| write(folder, file)).collect::<Result<_, _>>()?;
    let verify = bundle.verify.as_ref();
    let verify = verify.map(|line| format!("cd {} && {line}", quoted(&folder.to_string_lossy())));
    Ok(Delivered { paths, verify, ..Delivered::default() })
}

fn compared(folder: &Path, bundle: &Bundle) -> anyhow::Result<Delivered> {
    let found = bundle.files.iter().map(|file| compare(folder, file));
    let (paths, states) = found.collect::<Result<Vec<_>, _>>()?.into_iter().unzip();
    Ok(Delivered { paths, states: Some(states), ..Delivered::default() })
}

impl Delivered {
    fn is_stale(&self) -> bool {
        self.states.iter().flatten().any(|state| *state != State::Current)
    }

    fn show(&self) -> anyhow::Result<()> {
        if let Some(texts) = &self.texts {
            return print(&texts[0]);
        }
        match &self.states {
            None => {
                let paths = self.paths.iter().map(Foreign::shown);
                print(&paths.collect::<Vec<_>>().join("\n"))?;
            }
            Some(states) => {
                let found = self.paths.iter().zip(states);
                for (path, state) in found.filter(|(_, state)| **state != State::Current) {
                    print(&format!("{}: {}", path.shown(), state.name()))?;
                }
            }
        }
        if let Some(line) = &self.verify {
            say(format_args!("to check the build: {line}"));
        }
        Ok(())
    }

    /// The first file under keys of its own: for some targets it is the only one.
    fn document(&self, field: &Foreign, target: &Target, bundle: &Bundle) -> documents::Emit {
        let file = |(index, file): (usize, &mms_emit::File)| EmittedFile {
            file: file.name.clone(),
            path: self.paths.get(index).map(|path| path.raw().to_owned()),
            text: self.texts.as_ref().map(|texts| texts[index].clone()),
            state: self.states.as_ref().map(|states| states[index].name().to_owned()),
        };
        let files: Vec<_> = bundle.files.iter().enumerate().map(file).collect();
        documents::Emit {
            field: field.raw().to_owned(),
            target: target.name.to_owned(),
            file: files[0].file.clone(),
            path: files[0].path.clone(),
            text: files[0].text.clone(),
            verify: self.verify.as_ref().or(bundle.verify.as_ref()).cloned(),
            files,
        }
    }
}

/// The command line of this process, such that it writes what it has compared.
fn command_without_check() -> String {
    command(words(arguments().into_iter().skip(1)).into_iter().filter(|word| word != "--check"))
}
