//! The page around the sections: the verdict first, then the list of results, then each result.

use maud::{DOCTYPE, Markup, PreEscaped, html};
use mms_spec::foreign;

use super::mark::{table, verdict, words};
use super::{Entry, Page, Verdicts, origin};

/// The metadata that a browser needs before it draws.
const META: &str = "<meta charset=\"utf-8\"/>\
    <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\
    <meta name=\"color-scheme\" content=\"light dark\"/>";

/// Colours for light and dark screens and for paper; nothing is loaded from elsewhere.
const STYLE: &str = include_str!("style.css");

/// A document around its body. Empty elements are closed, so that it is XML too; characters that XML or HTML forbids in texts
/// are removed.
pub fn shell(title: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE) "\n"
        html lang="en" xmlns="http://www.w3.org/1999/xhtml" {
            head {
                (PreEscaped(META))
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body { (body) }
        }
    };
    foreign::markup(&page.into_string())
}

/// The whole page.
pub fn page(page: &Page) -> String {
    let verdicts = page.verdicts();
    let body = html! {
        a.skip href="#main" { "Skip to the results" }
        header {
            h1 { (page.title) }
            @if !page.entries.is_empty() { p.summary { (said(&verdicts)) } }
            (contents(page))
        }
        main #main tabindex="-1" {
            @if !page.entries.is_empty() { (summary(page)) }
            @for group in page.entries.chunk_by(|a, b| a.heading == b.heading) {
                section aria-labelledby=(anchor(group[0].heading)) {
                    h2 id=(anchor(group[0].heading)) { (group[0].heading) }
                    @for entry in group { (result(entry)) }
                }
            }
            @if !page.fields.is_empty() {
                section aria-labelledby="fields" {
                    h2 #fields { "Fields" }
                    @for (number, field) in page.fields.iter().enumerate() {
                        (field.html(&format!("field-{}", number + 1)))
                    }
                }
            }
            @if !page.set_aside.is_empty() {
                section aria-labelledby="set-aside" {
                    h2 #set-aside { "Set aside" }
                    p { "Files of the folder that are not on this page." }
                    ul { @for line in &page.set_aside { li { (line) } } }
                }
            }
        }
        footer { p {
            "Made by mms " (env!("CARGO_PKG_VERSION")) ". " code { "l1" } ", " code { "l2" } " and "
            code { "linf" } " are norms over all particles, the largest over time."
        } }
    };
    shell(&page.title, &body)
}

/// The name of the place of a heading.
fn anchor(heading: &str) -> String {
    heading.to_lowercase().replace(' ', "-")
}

fn contents(page: &Page) -> Markup {
    let groups = page.entries.chunk_by(|a, b| a.heading == b.heading).map(|group| group[0].heading);
    let fields = (!page.fields.is_empty()).then_some("Fields");
    let set_aside = (!page.set_aside.is_empty()).then_some("Set aside");
    html! {
        nav aria-label="Contents" {
            ul {
                @for heading in groups.chain(fields).chain(set_aside) {
                    li { a href=(format!("#{}", anchor(heading))) { (heading) } }
                }
            }
        }
    }
}

/// The table of runs and their results.
fn summary(page: &Page) -> Markup {
    let columns = [words("result"), words("kind"), words("verdict")];
    let rows = page.entries.iter().map(|entry| {
        let verdicts = entry.section.verdicts();
        vec![
            html! { a href=(format!("#{}", entry.id)) { (entry.section.title()) } },
            html! { (entry.heading) },
            said(&verdicts),
        ]
    });
    html! {
        section aria-labelledby="summary" {
            h2 #summary { "Summary" }
            (table("Results on this page", &columns, rows))
        }
    }
}

/// Verdicts; a result without one is neither good nor bad.
pub fn said(verdicts: &Verdicts) -> Markup {
    match verdicts.all {
        0 => html! { (verdicts.word) },
        _ => verdict(&verdicts.word, verdicts.are_expected()),
    }
}

fn result(entry: &Entry) -> Markup {
    html! {
        section.result aria-labelledby=(entry.id) {
            h3 id=(entry.id) { (entry.section.title()) }
            p { (said(&entry.section.verdicts())) }
            (entry.section.body(&entry.id))
            (origin(entry))
        }
    }
}
