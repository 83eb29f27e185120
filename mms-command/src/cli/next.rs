//! The next command to type after a search and a campaign; `mms_judge::next` has those after a judgement and a diagnosis.

use std::path::{Path, PathBuf};

use mms_campaign::supervisor::{STDERR, STDOUT};
use mms_files::program::arguments;
use mms_files::shell;
use mms_harness::judged::JudgedStudy;
use mms_harness::plan::PlannedStudy;
use mms_harness::work::RunOutcome;
use mms_judge::next::{Meshes, Words, after_judgement, command, each, list};
use mms_lab::tradeoff::search::{Goal, Trial};
use mms_report::tradeoff::Report as Tradeoff;
use mms_spec::source::Spanned;

/// The words of the command line of this process.
pub fn typed() -> Words {
    command(shell::words(arguments().into_iter().skip(1)))
}

/// The words of a command with other values of some options: old options of the same names are removed, but an old `set` only
/// if it sets the same parameter.
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

/// The results of a study of a campaign whose file lies in the folder `here`.
fn of_study(judged: &JudgedStudy<'_>, files: &[String], here: &Path) -> Meshes {
    let PlannedStudy { study, jobs, .. } = judged.planned;
    let path = |word: &Spanned<String>| match word.value.ends_with(".toml") {
        true => here.join(&word.value).to_string_lossy().into_owned(),
        false => word.value.clone(),
    };
    let done = jobs.iter().zip(&judged.outcomes);
    let done = done.filter(|(_, outcome)| matches!(outcome, RunOutcome::Finished(_)));
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
    Meshes {
        field: path(&study.field),
        files: files.to_vec(),
        options: options.concat(),
        of_judge: None,
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
    let (name, value) = match report.problem.goal {
        Goal::Error(_) => ("target-linf", front.last()?.error.clone().ok()?),
        Goal::Cost(_) => ("budget-seconds", report.cost(front.first()?, report.problem.cost)),
    };
    // Two digits, rounded up.
    let unit = 10f64.powf(value.log10().floor() - 1.0);
    Some(changed(words, &[(name, format!("{:.1e}", (value / unit).ceil() * unit))]))
}

/// The last output of the first failed run of a campaign; empty, if the run printed nothing.
fn log_of(studies: &[JudgedStudy<'_>], store: &Path) -> Option<Words> {
    let folders = studies.iter().flat_map(|it| &it.outcomes).filter_map(|outcome| match outcome {
        RunOutcome::Failed { folder, .. } => Some(store.join(folder)),
        _ => None,
    });
    let logs = folders.flat_map(|it| [STDERR, STDOUT].map(|name| it.join(name)));
    let is_said = |path: &PathBuf| path.metadata().is_ok_and(|it| it.len() > 0);
    let log = logs.into_iter().find(is_said)?.to_string_lossy().into_owned();
    Some(["tail", "-n", "50", &log].map(str::to_owned).to_vec())
}

/// Sets the next command of each judgement of a campaign, and returns the next command of the campaign, whose command so far has
/// these words: it prints the log of a failed run in this store, shows the command of a run that printed nothing, or diagnoses.
pub fn after_campaign(
    studies: &mut [JudgedStudy<'_>],
    here: &Path,
    store: &Path,
    words: &[String],
) -> Option<Words> {
    for study in studies.iter_mut() {
        let Some(judgements) = &study.judgements else { continue };
        let meshes = of_study(study, judgements.files(), here);
        let is_chosen = !study.planned.study.quantity.is_empty();
        let next = after_judgement(judgements, Some(&meshes), is_chosen);
        study.judgements.iter_mut().for_each(|it| it.next.clone_from(&next));
    }
    let has_failed = |it: &&JudgedStudy<'_>| {
        let failed = |it: &RunOutcome| matches!(it, RunOutcome::Failed { .. });
        it.mistake.is_some() || it.outcomes.iter().any(failed)
    };
    if let Some(log) = log_of(studies, store) {
        return Some(log);
    }
    if let Some(study) = studies.iter().find(has_failed) {
        let only = format!("--only={}", study.planned.study.name);
        let words = words.iter().cloned();
        return Some(words.chain([only, "--dry-run".to_owned()]).collect());
    }
    studies.iter().find_map(|it| it.judgements.as_ref()?.next.clone())
}
