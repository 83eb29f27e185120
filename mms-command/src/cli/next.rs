//! The next command to type after a verdict that is no pass: its words, `mms` first.
//!
//! Files and options are those of the command that has ended, so that the line can be typed as it stands.

use std::fmt::Display;
use std::path::Path;

use mms_convergence::Verdict;
use mms_diagnosis::answer::{Diagnosis, Finding, Rung};
use mms_diagnosis::scene::FEWEST_POINTS;
use mms_files::program::arguments;
use mms_files::shell;
use mms_harness::judged::Judged;
use mms_harness::plan::Planned;
use mms_harness::work::Outcome;
use mms_judge::Judgements;
use mms_lab::tradeoff::search::{Goal, Trial};
use mms_report::tradeoff::Report as Tradeoff;
use mms_spec::source::Spanned;

/// The words of a command.
pub type Words = Vec<String>;

/// Results of a field on meshes, with the options that say how they are read.
pub struct Meshes {
    /// The field, as it was named.
    pub field: String,
    /// The files, one for each mesh.
    pub files: Vec<String>,
    /// The options that `mms judge` and `mms diagnose` share.
    pub options: Vec<String>,
}

/// The words of the command line of this process.
pub fn typed() -> Words {
    command(shell::words(arguments().into_iter().skip(1)))
}

/// The option of this name with several values; nothing without a value.
pub fn list<T: Display>(name: &str, values: &[T]) -> Option<String> {
    let texts: Vec<String> = values.iter().map(T::to_string).collect();
    (!texts.is_empty()).then(|| format!("--{name}={}", texts.join(",")))
}

/// The option of this name, once for each value.
pub fn each<T: Display>(name: &str, values: &[T]) -> Vec<String> {
    values.iter().map(|value| format!("--{name}={value}")).collect()
}

/// The words of a command with other values of some options: those of the same names go, but of `set` those of the same
/// parameter alone.
pub fn changed(words: &[String], options: &[(&str, String)]) -> Words {
    let replaces = |name: &str, value: Option<&String>| {
        let parameter = |it: &str| it.split_once('=').map(|(name, _)| name.trim().to_owned());
        options.iter().any(|(other, new)| {
            name == *other
                && (name != "set" || value.and_then(|it| parameter(it)) == parameter(new))
        })
    };
    let (mut kept, mut at) = (Vec::new(), 0);
    while let Some(word) = words.get(at) {
        let option = word.strip_prefix("--").map(|it| it.split_once('=').unwrap_or((it, "")));
        at += 1;
        match option {
            Some((name, value)) if word.contains('=') => {
                kept.extend((!replaces(name, Some(&value.to_owned()))).then(|| word.clone()));
            }
            Some((name, _)) if replaces(name, words.get(at)) => at += 1,
            _ => kept.push(word.clone()),
        }
    }
    kept.extend(options.iter().map(|(name, value)| format!("--{name}={value}")));
    kept
}

/// A command of these words.
pub fn command<W: AsRef<str>>(words: impl IntoIterator<Item = W>) -> Words {
    let words = words.into_iter().map(|it| it.as_ref().to_owned());
    std::iter::once("mms".to_owned()).chain(words).collect()
}

impl Meshes {
    /// A command about these results.
    fn asks(&self, name: &str, more: impl IntoIterator<Item = String>) -> Words {
        let head = [name.to_owned(), self.field.clone()];
        let words = head.into_iter().chain(self.files.iter().cloned());
        command(words.chain(self.options.iter().cloned()).chain(more))
    }

    /// The steps of a diagnosis, from the first on.
    fn plan(&self) -> Words {
        command(["diagnose", &self.field, "--plan"])
    }

    /// The words for a study of a campaign whose file lies in the folder `here`.
    fn of_study(judged: &Judged<'_>, files: &[String], here: &Path) -> Self {
        let Planned { study, jobs, .. } = judged.planned;
        let path = |word: &Spanned<String>| match word.value.ends_with(".toml") {
            true => here.join(&word.value).to_string_lossy().into_owned(),
            false => word.value.clone(),
        };
        let done = jobs.iter().zip(&judged.outcomes);
        let done = done.filter(|(_, outcome)| matches!(outcome, Outcome::Finished(_)));
        let h: Vec<f64> = done.map(|(job, _)| judged.planned.size(job)).collect();
        let texts = |all: &[Spanned<String>]| -> Vec<String> {
            all.iter().map(|it| it.value.clone()).collect()
        };
        // Results without a time are of the end.
        let times = match (study.time.as_slice(), judged.planned.input.is_static()) {
            ([], false) => vec![judged.planned.window[1]],
            (times, _) => times.to_vec(),
        };
        let options = [
            list("h", &h).into_iter().collect(),
            list("time", &times).into_iter().collect(),
            each("set", &study.set),
            each("map", &texts(&study.map)),
            list("columns", &texts(&study.columns)).into_iter().collect(),
            each("from", study.from.as_ref().map(path).as_slice()),
            each("max-memory", study.max_memory.as_slice()),
        ];
        Meshes { field: path(&study.field), files: files.to_vec(), options: options.concat() }
    }
}

/// The quantities of results that `mms diagnose` looks at.
const DIAGNOSED: [&str; 4] =
    ["displacement", "velocity", "displacement_gradient", "deformation_gradient"];

/// After a judgement of results, or of a table if there are no meshes. `is_chosen` says that quantities were asked for.
pub fn after_judgement(
    judgements: &Judgements,
    meshes: Option<&Meshes>,
    is_chosen: bool,
) -> Option<Words> {
    let verdict = judgements.verdict();
    let Some(meshes) = meshes else {
        return match verdict {
            Verdict::Fail => Some(command(["diagnose", "--list"])),
            Verdict::NotAsymptotic => Some(command(["explain", "asymptotic"])),
            Verdict::NoEvidence | Verdict::Exact | Verdict::Pass => None,
        };
    };
    match verdict {
        Verdict::Exact | Verdict::Pass => None,
        Verdict::NoEvidence => Some(meshes.asks("judge", ["--explain".to_owned()])),
        Verdict::Fail | Verdict::NotAsymptotic => {
            let samplings = judgements.samplings();
            let is_at_points = |name: &&str| {
                samplings.is_some_and(|all| {
                    all.0.iter().any(|(of, how)| of == *name && how != "middles of cells")
                })
            };
            let seen: Vec<&str> = DIAGNOSED.into_iter().filter(is_at_points).collect();
            Some(match seen.is_empty() || judgements.points() < FEWEST_POINTS {
                true => meshes.plan(),
                false => meshes.asks("diagnose", list("quantity", &seen).filter(|_| is_chosen)),
            })
        }
    }
}

/// After a diagnosis by a command of these words: once the mistake is fixed, or if nothing explains the error.
pub fn after_diagnosis(diagnosis: &Diagnosis, meshes: &Meshes, words: &[String]) -> Option<Words> {
    let field = meshes.field.as_str();
    match (diagnosis.finding, diagnosis.rung) {
        (Finding::Nothing, _) => None,
        (Finding::Named, Rung::Results) => Some(meshes.asks("judge", None)),
        (Finding::Named, _) => Some(words.to_vec()),
        (Finding::Unexplained, Rung::Law) => Some(command(["diagnose", field, "--list"])),
        (Finding::Unexplained, Rung::State(_)) => {
            Some(command(["diagnose", field, "--plan", "law"]))
        }
        (Finding::Unexplained, Rung::Step) => {
            Some(command(["diagnose", field, "--plan", "accelerations"]))
        }
        (Finding::Unexplained, Rung::Results) => Some(meshes.plan()),
    }
}

/// After a search by a command of these words: the run of the choice, or the same search for the least error, or the least cost, that
/// a run has.
pub fn after_search(
    report: &Tradeoff<'_>,
    run: impl Fn(&Trial) -> Words,
    words: &[String],
) -> Option<Words> {
    if let Some(choice) = report.choice() {
        return Some(run(choice));
    }
    let front = report.front();
    let (name, value) = match report.plan.goal {
        Goal::Error(_) => ("target-linf", front.last()?.error.clone().ok()?),
        Goal::Cost(_) => ("budget-seconds", report.cost(front.first()?, report.plan.cost)),
    };
    // Two digits, rounded up.
    let unit = 10f64.powf(value.log10().floor() - 1.0);
    Some(changed(words, &[(name, format!("{:.1e}", (value / unit).ceil() * unit))]))
}

/// Gives each judgement of a campaign its own, and returns that of the campaign, whose command so far has these words: a
/// diagnosis, or the commands of runs that failed.
pub fn after_campaign(studies: &mut [Judged<'_>], here: &Path, words: &[String]) -> Option<Words> {
    for study in studies.iter_mut() {
        let Some(judgements) = &study.judgements else { continue };
        let meshes = Meshes::of_study(study, judgements.files(), here);
        let is_chosen = !study.planned.study.quantity.is_empty();
        let next = after_judgement(judgements, Some(&meshes), is_chosen);
        study.judgements.iter_mut().for_each(|it| it.next.clone_from(&next));
    }
    let has_failed = |it: &&Judged<'_>| {
        let failed = |it: &Outcome| matches!(it, Outcome::Failed { .. });
        it.mistake.is_some() || it.outcomes.iter().any(failed)
    };
    if let Some(study) = studies.iter().find(has_failed) {
        let only = format!("--only={}", study.planned.study.name);
        let words = words.iter().cloned();
        return Some(words.chain([only, "--dry-run".to_owned()]).collect());
    }
    studies.iter().find_map(|it| it.judgements.as_ref()?.next.clone())
}
