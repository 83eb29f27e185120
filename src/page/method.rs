//! The method of a result.

use maud::{Markup, html};
use serde::Deserialize;
use serde_json::{Map, Value};

use super::mark::list;
use crate::session::method::Arithmetic;

/// What a document has under `method`.
#[derive(Deserialize)]
#[serde(try_from = "Map<String, Value>")]
pub struct Method(Map<String, Value>);

/// Results that differ in these alone would else be taken for each other. Documents of older versions lack some.
const NEEDED: [&str; 4] = ["shape", "integrator", "precision", "form"];

impl TryFrom<Map<String, Value>> for Method {
    type Error = String;

    fn try_from(keys: Map<String, Value>) -> Result<Self, String> {
        match NEEDED.into_iter().find(|&key| !keys.get(key).is_some_and(Value::is_string)) {
            Some(key) => Err(format!(
                "its method does not say its `{key}`, as those of older versions; its command makes it again"
            )),
            None => Ok(Self(keys)),
        }
    }
}

impl Method {
    fn word(&self, key: &str) -> &str {
        self.0.get(key).and_then(Value::as_str).unwrap_or_default()
    }

    /// Its name; of how numbers were computed, what is not as usual.
    pub fn name(&self) -> String {
        let mut name = [self.word("shape"), self.word("integrator")].join(" ");
        let usual = Arithmetic::default();
        if self.word("precision") != usual.precision.name() {
            name += &format!(", {}", self.word("precision"));
        }
        if self.word("form") != usual.form.name() {
            name += &format!(", {} form", self.word("form"));
        }
        name
    }

    /// Whether its runs go to an equilibrium.
    pub fn relaxes(&self) -> bool {
        self.0.get("relax").and_then(Value::as_bool).unwrap_or_default()
    }

    /// All of it, to be opened.
    pub fn html(&self) -> Markup {
        html! {
            details {
                summary { "The method" }
                (list(&self.0))
            }
        }
    }
}
