//! Texts with placeholders, such as `--cells {cells}`.

use std::fmt;

macro_rules! placeholders {
    ($($variant:ident $name:literal $is_path:literal $doc:literal,)*) => {
        /// A value in a template that differs between runs.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Placeholder {
            $(#[doc = $doc] $variant,)*
        }

        impl Placeholder {
            /// All placeholders.
            pub const ALL: &[Placeholder] = &[$(Placeholder::$variant),*];

            /// The word between the braces.
            pub fn name(self) -> &'static str {
                match self { $(Placeholder::$variant => $name,)* }
            }

            /// Whether it is a time, or concerns time steps.
            pub fn is_time(self) -> bool {
                use Placeholder::{End, Start, Steps, TimeStep};
                matches!(self, TimeStep | Steps | Start | End)
            }

            /// Whether it is a path, which does not identify a run.
            pub fn is_path(self) -> bool {
                match self { $(Placeholder::$variant => $is_path,)* }
            }
        }
    };
}

placeholders! {
    Name "name" false "The name of the study.",
    Field "field" false "The name of its field.",
    Level "level" false "The level, from 1 on.",
    Cells "cells" false "How many cells there are along the longest edge of the body.",
    ParticlesPerCell "particles_per_cell" false "Particles in each direction of a cell, as `2` or `3x2`.",
    CellSize "cell_size" false "h, the longest edge of a cell.",
    TimeStep "time_step" false "dt.",
    Steps "steps" false "How many time steps lead from the start to the end.",
    Start "start" false "The first time.",
    End "end" false "The last time.",
    ForceFactor "force_factor" false "The factor of b: 1, or -1 in runs of `--canary`.",
    Output "output" true "The folder for the results of the run.",
    Emitted "emitted" true "The folder with the source of the field.",
    State "state" true "The file with the exact state at the start.",
    Here "here" true "The folder of the campaign file.",
}

/// A text with placeholders.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Template(Vec<Piece>);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Piece {
    Text(String),
    Value(Placeholder),
    Parameter(String),
}

/// The prefix of a placeholder for the value of a parameter.
pub const PARAMETER: &str = "set.";

/// The reasons why a text is no template.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wrong {
    /// There is no placeholder of this name.
    Unknown(String),
    /// A brace without its counterpart.
    Unpaired(char),
    /// A quote that is not closed, or a backslash at the end.
    Unclosed,
    /// The text has no word.
    Empty,
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Wrong::Unknown(name) => write!(f, "unknown placeholder `{{{name}}}`"),
            Wrong::Unpaired(brace) => {
                write!(f, "a lone `{brace}`; write `{brace}{brace}` for the character")
            }
            Wrong::Unclosed => f.write_str("a quote is not closed, or a backslash ends it"),
            Wrong::Empty => f.write_str("it has no word"),
        }
    }
}

impl Template {
    /// Parses `{name}` as a placeholder, `{set.name}` as the value of a parameter, and `{{` and `}}` as braces.
    ///
    /// # Errors
    /// An unknown name, or a single brace.
    pub fn new(text: &str) -> Result<Self, Wrong> {
        let (mut pieces, mut plain, mut rest) = (Vec::new(), String::new(), text);
        while let Some(at) = rest.find(['{', '}']) {
            let (before, behind) = rest.split_at(at);
            plain += before;
            rest = match behind.as_bytes() {
                [b'{', b'{', ..] | [b'}', b'}', ..] => {
                    plain += &behind[..1];
                    &behind[2..]
                }
                [b'{', ..] => {
                    let (name, rest) = behind[1..].split_once('}').ok_or(Wrong::Unpaired('{'))?;
                    let found = Placeholder::ALL.iter().find(|it| it.name() == name);
                    let parameter = name.strip_prefix(PARAMETER).filter(|it| !it.is_empty());
                    pieces.push(Piece::Text(std::mem::take(&mut plain)));
                    pieces.push(match (found, parameter) {
                        (Some(found), _) => Piece::Value(*found),
                        (None, Some(parameter)) => Piece::Parameter(parameter.to_owned()),
                        (None, None) => return Err(Wrong::Unknown(name.to_owned())),
                    });
                    rest
                }
                _ => return Err(Wrong::Unpaired('}')),
            };
        }
        pieces.push(Piece::Text(plain + rest));
        Ok(Template(pieces))
    }

    /// Splits a command line into words, as POSIX does, before placeholders are filled.
    ///
    /// # Errors
    /// A quote that is not closed, no word, or an unknown placeholder.
    pub fn words(text: &str) -> Result<Vec<Self>, Wrong> {
        match shlex::split(text) {
            None => Err(Wrong::Unclosed),
            Some(words) if words.is_empty() => Err(Wrong::Empty),
            Some(words) => words.iter().map(|word| Self::new(word)).collect(),
        }
    }

    /// The placeholders in the template.
    pub fn placeholders(&self) -> impl Iterator<Item = Placeholder> {
        self.0.iter().filter_map(|piece| match piece {
            Piece::Text(_) | Piece::Parameter(_) => None,
            Piece::Value(placeholder) => Some(*placeholder),
        })
    }

    /// The parameters in the template.
    pub fn parameters(&self) -> impl Iterator<Item = &str> {
        self.0.iter().filter_map(|piece| match piece {
            Piece::Parameter(name) => Some(name.as_str()),
            Piece::Text(_) | Piece::Value(_) => None,
        })
    }

    /// Fills the template with values of placeholders and of parameters.
    pub fn fill(
        &self,
        value: impl Fn(Placeholder) -> String,
        parameter: impl Fn(&str) -> String,
    ) -> String {
        let text = |piece: &Piece| match piece {
            Piece::Text(text) => text.clone(),
            Piece::Value(placeholder) => value(*placeholder),
            Piece::Parameter(name) => parameter(name),
        };
        self.0.iter().map(text).collect()
    }
}
