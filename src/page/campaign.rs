//! Campaigns: the verification matrix of somebody else's solver.

use maud::{Markup, html};
use serde::Deserialize;

use super::judge::Judgement;
use super::mark::{count, is_good, numbers, seconds, small, table, verdict, words};
use super::{Section, Verdicts};

/// What `mms campaign` writes.
#[derive(Deserialize)]
pub struct Campaign {
    solver: String,
    solver_version: Option<String>,
    studies: Vec<Study>,
    excluded: Option<Vec<Excluded>>,
}

/// A mistake, and the study that excludes it.
#[derive(Deserialize)]
struct Excluded {
    hypothesis: String,
    by: Option<String>,
}

#[derive(Deserialize)]
struct Study {
    name: String,
    field: String,
    runs: Vec<Run>,
    mistake: Option<String>,
    verdict: Option<String>,
    judgement: Option<Judgement>,
}

#[derive(Deserialize)]
struct Run {
    level: usize,
    cells: usize,
    cell_size: f64,
    time_step: Option<f64>,
    status: String,
    reason: Option<String>,
    last_words: Option<Vec<String>>,
    seconds: Option<f64>,
}

impl Study {
    fn word(&self) -> &str {
        self.verdict.as_deref().unwrap_or("not judged")
    }

    fn is_passed(&self) -> bool {
        self.verdict.as_deref().is_some_and(is_good) && self.runs.iter().all(Run::is_done)
    }

    fn is_whole(&self) -> bool {
        self.judgement.is_some() || self.mistake.is_some() || !self.runs.iter().all(Run::is_done)
    }

    fn done(&self) -> String {
        let done = self.runs.iter().filter(|run| run.is_done()).count();
        format!("{done} of {}", self.runs.len())
    }
}

impl Run {
    fn is_done(&self) -> bool {
        self.status == "done"
    }
}

impl Section for Campaign {
    fn title(&self) -> String {
        let version = self.solver_version.as_ref().map_or(String::new(), |it| format!(" {it}"));
        format!("{}{version}: {} studies", self.solver, self.studies.len())
    }

    fn verdicts(&self) -> Verdicts {
        let judged = || self.studies.iter().filter(|study| study.is_whole());
        Verdicts::several(judged().filter(|it| it.is_passed()).count(), judged().count(), "pass")
    }

    fn body(&self, id: &str) -> Markup {
        let place = |at: usize| format!("{id}-study-{}", at + 1);
        html! {
            (self.matrix(&place))
            @if let Some(all) = &self.excluded { (exclusions(all)) }
            @for (at, study) in self.studies.iter().enumerate() {
                details id=(place(at)) {
                    summary { (study.name) ": " (study.word()) }
                    @if let Some(mistake) = &study.mistake { p.alert { (mistake) } }
                    (runs(study))
                    @if let Some(judgement) = &study.judgement { (judgement.body(&place(at))) }
                }
            }
        }
    }
}

impl Campaign {
    fn matrix(&self, place: &impl Fn(usize) -> String) -> Markup {
        let columns = [
            words("study"),
            words("field"),
            words("runs done"),
            numbers("expected"),
            numbers("observed"),
            words("of"),
            words("verdict"),
        ];
        let rows = self.studies.iter().enumerate().map(|(at, study)| {
            let nothing = || [html! {}, html! {}, html! {}];
            let [expected, observed, of] =
                study.judgement.as_ref().map_or_else(nothing, Judgement::deciding);
            vec![
                html! { a href=(format!("#{}", place(at))) { (study.name) } },
                html! { (study.field) },
                html! { (study.done()) },
                expected,
                observed,
                of,
                verdict(study.word(), study.is_passed()),
            ]
        });
        table("Studies", &columns, rows)
    }
}

/// The mistakes that no study excludes, and which excludes the others.
fn exclusions(all: &[Excluded]) -> Markup {
    let open = all.iter().filter(|it| it.by.is_none()).map(|it| it.hypothesis.as_str());
    let open: Vec<&str> = open.collect();
    let rows = all.iter().filter_map(|it| {
        let by = it.by.as_ref()?;
        Some(vec![html! { (it.hypothesis) }, html! { (by) }])
    });
    html! {
        @if !open.is_empty() { p { "Mistakes that no study excludes: " (open.join(", ")) "." } }
        details {
            summary { "Mistakes that are excluded: " (all.len() - open.len()) " of " (all.len()) }
            (table("Excluded mistakes", &[words("mistake"), words("by")], rows))
        }
    }
}

fn runs(study: &Study) -> Markup {
    let columns = [
        numbers("level"),
        numbers("cells"),
        numbers("h"),
        numbers("dt"),
        numbers("time"),
        words("end"),
    ];
    let rows = study.runs.iter().map(|run| {
        vec![
            count(Some(run.level)),
            count(Some(run.cells)),
            small(Some(run.cell_size)),
            small(run.time_step),
            seconds(run.seconds),
            html! {
                (run.reason.as_ref().unwrap_or(&run.status))
                @for line in run.last_words.iter().flatten() { br; code { (line) } }
            },
        ]
    });
    table(&format!("Runs of {}", study.name), &columns, rows)
}
