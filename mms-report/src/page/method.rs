//! The method of a result.

use maud::{Markup, html};
use mms_documents::study::Method;
use mms_options::method::Arithmetic;
use serde_json::Value;

use super::mark::list;

/// The keys that tell results from each other. Documents of older versions lack some.
const NEEDED: [&str; 4] = ["shape", "integrator", "precision", "form"];

/// The reason why a document is not shown: its method lacks a key that distinguishes it from others.
pub fn lack(document: &Value) -> Option<String> {
    let method = document.get("method")?.as_object()?;
    let key = NEEDED.into_iter().find(|&key| !method.get(key).is_some_and(Value::is_string))?;
    Some(format!(
        "its method does not say its `{key}`, as in older versions; its command makes it again"
    ))
}

/// The name of a method, with its precision and form if they are not the usual ones.
pub fn name(method: &Method) -> String {
    let mut name = [method.shape.as_str(), &method.integrator].join(" ");
    let usual = Arithmetic::default();
    if method.precision != usual.precision.name() {
        name += &format!(", {}", method.precision);
    }
    if method.form != usual.form.name() {
        name += &format!(", {} form", method.form);
    }
    name
}

/// Words of methods, each with what a paper prints.
const WRITTEN: [(&str, &str); 20] = [
    ("cpgimp", "cpGIMP"),
    ("ugimp", "uGIMP"),
    ("cpdi", "CPDI"),
    ("quadratic_bspline", "quadratic B-splines"),
    ("cubic_bspline", "cubic B-splines"),
    ("linear", "linear"),
    ("usf", "USF"),
    ("usl", "USL"),
    ("musl", "MUSL"),
    ("flip", "FLIP"),
    ("pic", "PIC"),
    ("apic", "APIC"),
    ("total", "total Lagrangian"),
    ("updated", "updated Lagrangian"),
    ("f32", "single precision"),
    ("f64", "double precision"),
    ("wide", "extended precision"),
    ("stable", "stable form"),
    ("fast", "fast form"),
    ("leapfrog", "leapfrog"),
];

/// A method as people write it: `cpgimp leapfrog` becomes cpGIMP, leapfrog.
pub fn written(name: &str) -> String {
    let word = |word: &str| {
        let known = WRITTEN.iter().find(|(own, _)| *own == word);
        known.map_or_else(|| word.to_owned(), |(_, written)| (*written).to_owned())
    };
    name.split_whitespace().map(word).collect::<Vec<_>>().join(", ")
}

/// A method as people write it, with its formulation; the transfer, precision and form are left out if they are the usual ones.
pub fn whole(method: &Method) -> String {
    let usual = Arithmetic::default();
    let others = [
        (method.transfer.as_str(), "flip"),
        (&method.precision, usual.precision.name()),
        (&method.form, usual.form.name()),
    ];
    let others = others.iter().filter(|(own, usual)| own != usual).map(|(own, _)| *own);
    let words = [method.formulation.as_str(), &method.shape, &method.integrator];
    written(&words.into_iter().chain(others).collect::<Vec<_>>().join(" "))
}

/// All keys of a method, to be opened.
pub fn method(method: &Method) -> Markup {
    let keys = serde_json::to_value(method).unwrap_or_default();
    html! {
        details {
            summary { "The method" }
            @if let Some(keys) = keys.as_object() { (list(keys)) }
        }
    }
}
