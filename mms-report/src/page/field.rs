//! The fields of the results: their formulas, and their motion.

use std::path::PathBuf;

use maud::{Markup, PreEscaped, html};
use mms_codegen::{Options, Selection};
use mms_documents::provenance::{Input, Provenance};
use mms_exact::gallery::Entry;
use mms_exact::provenance::twin;
use mms_options::field::open;
use mms_show::{DERIVATION, Document, mathml};

use super::motion::Motion;

/// A field on a page.
pub struct FieldOnPage {
    input: Input,
    /// The content of the field; or the reason why there is none.
    content: Result<Content, String>,
}

struct Content {
    name: String,
    title: String,
    formulas: String,
    motion: Option<Motion>,
    files: Vec<PathBuf>,
}

/// The fields of some results, each once.
pub fn fields<'a>(provenances: impl Iterator<Item = &'a Provenance>) -> Vec<FieldOnPage> {
    let mut inputs: Vec<&Input> = Vec::new();
    for input in provenances.map(|it| &it.input).filter(|input| input.field.is_some()) {
        if !inputs.contains(&input) {
            inputs.push(input);
        }
    }
    inputs
        .into_iter()
        .map(|input| FieldOnPage { input: input.clone(), content: content(input) })
        .collect()
}

fn content(input: &Input) -> Result<Content, String> {
    let field = input.field.as_deref().unwrap_or_default();
    let window = input.window.clone();
    let selection = Selection { twin: twin(input), window, ..Selection::default() };
    let options = Options { selection, ..Options::default() };
    let found = open(field)
        .and_then(|source| mms_exact::Input::new(source, &options))
        .map_err(|error| format!("{error:#}").lines().next().unwrap_or_default().to_owned())?;
    if found.compiled.input_hash() != input.hash {
        return Err("its text has changed since".to_owned());
    }
    let set = found.settings(&input.set).map_err(|error| error.to_string())?;
    let document = Document::new(&found.compiled, &DERIVATION)
        .map_err(|_| "its formulas are too large".to_owned())?;
    Ok(Content {
        name: found.name.shown(),
        title: found.compiled.field.title.shown(),
        formulas: mathml::part(&document, 4),
        motion: Motion::of(&found.compiled, &set),
        files: found.files(),
    })
}

impl FieldOnPage {
    /// A field of the gallery, as it is.
    pub fn of_gallery(entry: &Entry) -> anyhow::Result<Self> {
        let found = mms_exact::Input::new(open(entry.name)?, &Options::default())?;
        let input = found.provenance(&[]);
        Ok(Self { content: content(&input), input })
    }

    /// The files that it was read from.
    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.content.iter().flat_map(|content| &content.files)
    }

    /// The formulas, if they are known.
    #[cfg(test)]
    pub fn formulas(&self) -> Option<&str> {
        self.content.as_ref().ok().map(|content| content.formulas.as_str())
    }

    /// The body of the field, small and deformed.
    pub fn thumbnail(&self) -> Option<Markup> {
        let content = self.content.as_ref().ok()?;
        Some(content.motion.as_ref()?.thumbnail(&content.name))
    }

    /// The section of the field.
    pub fn html(&self, id: &str) -> Markup {
        let given = self.input.field.as_deref().unwrap_or_default();
        let name = self.content.as_ref().map_or(given, |content| &content.name);
        let motion = self.input.rigid.as_ref().map(|keys| match keys.as_str() {
            "" => "the standard rigid motion".to_owned(),
            keys => format!("the rigid motion {keys}"),
        });
        html! {
            section.field aria-labelledby=(id) {
                h3 id=(id) {
                    (name)
                    @if let Ok(content) = &self.content { ": " (content.title) }
                }
                @if motion.is_some() || !self.input.set.is_empty() {
                    p {
                        "Taken with "
                        (self.input.set.iter().cloned().chain(motion).collect::<Vec<_>>().join(", ")) "."
                    }
                }
                @match &self.content {
                    Ok(content) => {
                        @if let Some(motion) = &content.motion { (motion.html(&format!("{id}-motion"), name)) }
                        p { "From u to b; " code { "mms show " (given) } " has every quantity." }
                        div.scroll.formulas role="region" tabindex="0" aria-label=(format!("Formulas of {name}")) {
                            (PreEscaped(&content.formulas))
                        }
                    }
                    Err(reason) => p.alert { "Its formulas are not shown: " (reason) "." }
                }
            }
        }
    }
}
