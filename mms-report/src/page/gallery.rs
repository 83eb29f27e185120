//! A page for each field of the gallery, with the studies that its file names; and one that lists them. Nothing on
//! them depends on the machine.

use maud::{Markup, html};
use mms_exact::gallery::Entry;
use mms_spec::{FieldSpec, StudySpec};

use super::mark::{table, words};
use super::{Page, Verdicts, field, frame};
use crate::{Shown as _, Study};

/// Runs the study of a command line, and leaves the machine out of the report; `None` if no level could be started.
pub type RunStudy<'a> = &'a dyn Fn(&[String]) -> anyhow::Result<Option<Study>>;

/// The page of a field.
///
/// # Errors
/// A field that does not compile, or that the solver cannot take.
pub fn page(entry: &Entry, run: RunStudy<'_>) -> anyhow::Result<Page> {
    let field = entry.compile().map_err(|failure| anyhow::anyhow!("{failure}"))?.field;
    let title = format!("{}: {}", field.name.shown(), field.title.shown());
    let mut results = Vec::new();
    for (number, study) in field.studies.iter().enumerate() {
        let report = run(&command(&field, study))?;
        let Some(mut document) = report.map(|report| report.document()) else { continue };
        document.study.levels.iter_mut().for_each(|level| level.seconds = None);
        let document = serde_json::to_value(document)?;
        results.push(
            super::entry(&format!("[[study]] {}", number + 1), &document)
                .map_err(anyhow::Error::msg)?,
        );
    }
    let mut page = Page::new(&title, results, Vec::new());
    if page.fields.is_empty() {
        page.fields.push(field::FieldOnPage::of_gallery(entry)?);
    }
    Ok(page)
}

/// The command that runs a study of a field file.
fn command(field: &FieldSpec, study: &StudySpec) -> Vec<String> {
    let cells = study.cells.iter().map(usize::to_string).collect::<Vec<_>>().join(",");
    let options = [
        ("shape", Some(study.shape.clone())),
        ("integrator", Some(study.integrator.clone())),
        ("formulation", study.formulation.clone()),
        ("transfer", study.transfer.clone()),
        ("courant", study.courant.map(|courant| courant.to_string())),
        ("particles-per-cell", study.particles_per_cell.map(|number| number.to_string())),
        ("fill", study.fill.clone()),
        ("precision", study.precision.clone()),
        ("form", study.form.clone()),
        ("cells", (!cells.is_empty()).then_some(cells)),
    ];
    let given = options.into_iter().filter_map(|(name, value)| Some([format!("--{name}"), value?]));
    let relaxes = field.is_static().then(|| "--relax".to_owned());
    let head = ["study".to_owned(), field.name.raw().to_owned()];
    head.into_iter().chain(given.flatten()).chain(relaxes).collect()
}

/// A field of the gallery, with the contents of its page.
pub struct Listed {
    /// The field.
    pub field: FieldSpec,
    /// The verdicts on its studies.
    pub verdicts: Verdicts,
    /// The body of the field, small and deformed.
    pub thumbnail: Option<Markup>,
}

/// The page that lists all pages, each with its verdicts.
pub fn index(fields: &[Listed]) -> String {
    let columns =
        [words("field"), words("body"), words("dimension"), words("title"), words("studies")];
    let rows = fields.iter().map(|Listed { field, verdicts, thumbnail }| {
        vec![
            html! { a href=(format!("{}.html", field.name.shown())) { (field.name.shown()) } },
            html! { @if let Some(body) = thumbnail { (body) } },
            html! { (field.dimension) },
            html! { (field.title.shown()) },
            frame::said(verdicts),
        ]
    });
    let body = html! {
        header { h1 { "The gallery" } }
        main {
            p { "One page per field: what it shows of the solver, its motion, and its formulas." }
            (table("Fields of the gallery", &columns, rows))
        }
    };
    frame::shell("The gallery", &body)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::Path;

    use super::*;
    use crate::sampled::sampled;
    use mms_exact::gallery::FIELDS;

    const WRITE: &str = "cargo run --release -- report --gallery docs/gallery";

    #[test]
    fn the_pages_are_those_of_the_gallery_with_its_formulas() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/gallery");
        let mut pages: BTreeSet<String> = std::fs::read_dir(&folder)
            .map(|entries| {
                entries.map(|it| it.unwrap().file_name().into_string().unwrap()).collect()
            })
            .unwrap_or_default();
        assert!(pages.remove("index.html"), "{WRITE}");
        let index = std::fs::read_to_string(folder.join("index.html")).unwrap();
        let bodies = index.matches("<svg class=\"thumbnail\"").count();
        assert_eq!(bodies, FIELDS.len(), "{WRITE}");
        let expected: BTreeSet<_> = FIELDS.iter().map(|it| format!("{}.html", it.name)).collect();
        assert_eq!(pages, expected, "{WRITE}");
        for entry in sampled(FIELDS, 7) {
            let page =
                std::fs::read_to_string(folder.join(format!("{}.html", entry.name))).unwrap();
            let shown = field::FieldOnPage::of_gallery(entry).unwrap();
            let formulas = shown.formulas().expect("formulas");
            assert!(page.contains(formulas), "{}: its formulas changed: {WRITE}", entry.name);
        }
    }
}
