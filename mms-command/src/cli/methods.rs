//! Several methods at once: the options of one, some of which take a list.
//!
//! Every combination is a study of its own, with one command and one document. Its name
//! consists of the words in which the combinations differ.

use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{ArgAction, ArgMatches, Args, Command, Error, FromArgMatches};
use mms_options::method::MethodOptions;

/// Every combination of what the options in [`LISTS`] are given, one method at least.
#[derive(Clone, Debug)]
pub struct Methods {
    all: Vec<MethodOptions>,
    given: Given,
}

/// Which of the options that a field chooses were given.
#[derive(Clone, Copy, Debug)]
pub struct Given {
    /// Whether the formulation was.
    pub formulation: bool,
    /// Whether the shape function was.
    pub shape: bool,
}

/// The options that take a list.
const LISTS: [&str; 6] = ["formulation", "shape", "integrator", "transfer", "precision", "form"];

/// The options that the field chooses if they are left out.
const FROM_FIELD: [&str; 2] = ["formulation", "shape"];

impl Methods {
    /// The methods, in the order of the words of each list.
    pub fn each(&self) -> &[MethodOptions] {
        &self.all
    }

    /// Which options were given.
    pub fn given(&self) -> Given {
        self.given
    }
}

impl Args for Methods {
    fn augment_args(command: Command) -> Command {
        LISTS.into_iter().fold(MethodOptions::augment_args(command), |command, name| {
            command.mut_arg(name, |arg| {
                let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
                let is_of_field = FROM_FIELD.contains(&name);
                let usual = if is_of_field {
                    ". By default one that keeps its order on the body"
                } else {
                    ""
                };
                arg.help(format!("{help}{usual}. A list, as in A,B, compares methods"))
                    .hide_default_value(is_of_field)
                    .value_delimiter(',')
                    .action(ArgAction::Append)
            })
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for Methods {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        // Of a list, this takes the first.
        let mut all = vec![MethodOptions::from_arg_matches(matches)?];
        all = vary(all, matches, "formulation", |it, word| it.formulation = word)?;
        all = vary(all, matches, "shape", |it, word| it.shape = word)?;
        all = vary(all, matches, "integrator", |it, word| it.integrator = word)?;
        all = vary(all, matches, "transfer", |it, word| it.transfer = word)?;
        all = vary(all, matches, "precision", |it, word| it.arithmetic.precision = word)?;
        all = vary(all, matches, "form", |it, word| it.arithmetic.form = word)?;
        let is_given = |name| matches.value_source(name) == Some(ValueSource::CommandLine);
        let [formulation, shape] = FROM_FIELD.map(is_given);
        Ok(Self { all, given: Given { formulation, shape } })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// Each method with each word of a list.
fn vary<T: Copy + PartialEq + Send + Sync + 'static>(
    methods: Vec<MethodOptions>,
    matches: &ArgMatches,
    name: &str,
    set: fn(&mut MethodOptions, T),
) -> Result<Vec<MethodOptions>, Error> {
    let words: Vec<T> = matches.get_many(name).into_iter().flatten().copied().collect();
    if (1..words.len()).any(|at| words[..at].contains(&words[at])) {
        let message = format!("`--{name}`: a word is given twice\n");
        return Err(Error::raw(ErrorKind::ValueValidation, message));
    }
    let with = |method: &MethodOptions, word: T| {
        let mut method = method.clone();
        set(&mut method, word);
        method
    };
    Ok(methods.iter().flat_map(|method| words.iter().map(|&word| with(method, word))).collect())
}
