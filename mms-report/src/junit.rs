//! A campaign as JUnit XML: each study is a case of a test, and so is each of its canaries.

use maud::{Markup, PreEscaped, html};
use mms_convergence::Verdict;
use mms_harness::judged::JudgedStudy;
use mms_harness::report::{Canary, Report};
use mms_harness::work::{Finished, RunOutcome};
use mms_spec::foreign::markup;

/// The outcome of a case.
enum Case {
    Passed,
    /// The verdict and its reasons.
    Failure(String, String),
    /// The failures of the runs, with their last words.
    Error(String, String),
    Skipped(&'static str),
}

/// The XML document of a campaign.
pub fn document(report: &Report<'_>) -> String {
    let studies = report.studies.iter().map(|it| (it, it.planned.study.name.clone(), case(it)));
    let canaries = report.canaries.iter().flatten().map(|it| {
        let name = &it.planned.study.name;
        (it, format!("{name} with -b"), canary(report.canary(name)))
    });
    let all: Vec<_> = studies.chain(canaries).collect();
    let count = |is: fn(&Case) -> bool| all.iter().filter(|(_, _, case)| is(case)).count();
    let failures = count(|it| matches!(it, Case::Failure(..)));
    let errors = count(|it| matches!(it, Case::Error(..)));
    let skipped = count(|it| matches!(it, Case::Skipped(_)));
    let time: f64 = all.iter().map(|(judged, _, _)| seconds(judged)).sum();
    let name = markup(&report.plan.campaign.solver.name);
    let body = html! {
        testsuites {
            testsuite name=(name) tests=(all.len()) failures=(failures) errors=(errors) skipped=(skipped)
                time=(format!("{time:.3}")) {
                @for (judged, name, case) in &all {
                    testcase name=(markup(name)) classname=(markup(judged.planned.input.name.raw()))
                        time=(format!("{:.3}", seconds(judged))) { (element(case)) }
                }
            }
        }
    };
    let head = PreEscaped("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    html! { (head) (body) }.into_string()
}

/// The seconds that the runs of a study took.
fn seconds(judged: &JudgedStudy<'_>) -> f64 {
    let of = |it: &RunOutcome| match it {
        RunOutcome::Finished(Finished { seconds, .. }) => *seconds,
        _ => 0.0,
    };
    judged.outcomes.iter().map(of).sum()
}

fn case(judged: &JudgedStudy<'_>) -> Case {
    let failed = judged.planned.jobs.iter().zip(&judged.outcomes).find_map(|(job, outcome)| {
        let RunOutcome::Failed { reason, last_words, folder } = outcome else { return None };
        Some(Case::Error(
            format!("{}: {reason}", job.name),
            format!("{}\nits whole output is in {folder}", last_words.join("\n")),
        ))
    });
    if let Some(case) = failed {
        return case;
    }
    match (&judged.judgements, &judged.mistake) {
        (Some(judgements), _) if judgements.verdict().is_good() => Case::Passed,
        (Some(judgements), _) => {
            let (at, verdict) = judgements.decided();
            let says = judgements
                .each()
                .nth(at)
                .map(|(quantity, it)| judgements.sentences(quantity, it, true));
            let says = says.unwrap_or_default();
            let first = says.first().cloned().unwrap_or_else(|| verdict.to_string());
            let kind = if verdict == Verdict::NoEvidence { Case::Error } else { Case::Failure };
            kind(first, says.join("\n"))
        }
        (None, Some(mistake)) => {
            Case::Error("its results cannot be judged".into(), mistake.clone())
        }
        (None, None) => Case::Skipped("not all of its levels were run"),
    }
}

fn canary(found: Option<Canary>) -> Case {
    match found {
        Some(Canary::Fails) => Case::Passed,
        Some(Canary::Passes) => Case::Failure(
            "it passes with a wrong b".into(),
            "With -b in place of b the study passes, so it measures nothing: the solver does not use the b that it is given."
                .into(),
        ),
        Some(Canary::Open) | None => Case::Skipped("the study itself does not pass"),
    }
}

fn element(case: &Case) -> Markup {
    html! {
        @match case {
            Case::Passed => {},
            Case::Failure(message, text) => failure message=(markup(message)) { (markup(text)) },
            Case::Error(message, text) => error message=(markup(message)) { (markup(text)) },
            Case::Skipped(message) => skipped message=(message) {},
        }
    }
}
