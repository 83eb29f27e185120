//! Campaigns: the verification matrix of a user's solver.

use maud::{Markup, html};
use mms_documents::campaign::{Campaign, CampaignRun, CampaignStudy, ExcludedTogether};

use mms_documents::judge::Judge;

use super::judge::deciding;
use super::mark::{count, is_good, numbers, seconds, small, table, verdict, words};
use super::{Section, Verdicts};
use crate::plot::Plot;

fn word(study: &CampaignStudy) -> &str {
    study.verdict.as_deref().unwrap_or("not judged")
}

fn is_done(run: &CampaignRun) -> bool {
    run.status == "done"
}

fn is_passed(study: &CampaignStudy) -> bool {
    study.verdict.as_deref().is_some_and(is_good) && study.runs.iter().all(is_done)
}

fn is_whole(study: &CampaignStudy) -> bool {
    study.judgement.is_some() || study.mistake.is_some() || !study.runs.iter().all(is_done)
}

fn done(study: &CampaignStudy) -> String {
    let done = study.runs.iter().filter(|run| is_done(run)).count();
    format!("{done} of {}", study.runs.len())
}

impl Section for Campaign {
    fn title(&self) -> String {
        let version = self.solver_version.as_ref().map_or(String::new(), |it| format!(" {it}"));
        format!("{}{version}: {} studies", self.solver, self.studies.len())
    }

    fn verdicts(&self) -> Verdicts {
        let judged = || self.studies.iter().filter(|study| is_whole(study));
        Verdicts::several(judged().filter(|it| is_passed(it)).count(), judged().count(), "pass")
    }

    fn plots(&self) -> Vec<Plot> {
        let judged = |it: &CampaignStudy| Some((it.name.clone(), it.judgement.clone()?));
        let plots = |(name, judgement): (String, Judge)| {
            judgement.plots().into_iter().map(move |plot| Plot { head: name.clone(), ..plot })
        };
        self.studies.iter().filter_map(judged).flat_map(plots).collect()
    }

    fn body(&self, id: &str) -> Markup {
        let place = |at: usize| format!("{id}-study-{}", at + 1);
        html! {
            (matrix(self, &place))
            @if let Some(all) = &self.excluded { (exclusions(all)) }
            @for (at, study) in self.studies.iter().enumerate() {
                details id=(place(at)) {
                    summary { (study.name) ": " (word(study)) }
                    @if let Some(mistake) = &study.mistake { p.alert { (mistake) } }
                    (runs(study))
                    @if let Some(judgement) = &study.judgement { (judgement.body(&place(at))) }
                }
            }
        }
    }
}

fn matrix(campaign: &Campaign, place: &impl Fn(usize) -> String) -> Markup {
    let columns = [
        words("study"),
        words("field"),
        words("runs done"),
        numbers("expected"),
        numbers("observed"),
        words("of"),
        words("verdict"),
    ];
    let rows = campaign.studies.iter().enumerate().map(|(at, study)| {
        let nothing = || [html! {}, html! {}, html! {}];
        let [expected, observed, of] = study.judgement.as_ref().map_or_else(nothing, deciding);
        vec![
            html! { a href=(format!("#{}", place(at))) { (study.name) } },
            html! { (study.field) },
            html! { (done(study)) },
            expected,
            observed,
            of,
            verdict(word(study), is_passed(study)),
        ]
    });
    table("Studies", &columns, rows)
}

/// The mistakes that no study excludes, and for the others the studies that exclude them.
fn exclusions(all: &[ExcludedTogether]) -> Markup {
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

fn runs(study: &CampaignStudy) -> Markup {
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
