//! The next command to type after a verdict that is no pass: its words, `mms` first.
//!
//! Files and options are taken from the command that has ended, so that the line can be typed as printed.

use std::fmt::Display;

use mms_convergence::Verdict;
use mms_diagnosis::answer::{Diagnosis, DiagnosisFinding, Rung};
use mms_diagnosis::scene::FEWEST_POINTS;

use crate::Judgements;

/// The words of a command.
pub type Words = Vec<String>;

/// Results of a field on meshes, with the options for reading them.
pub struct Meshes {
    /// The field, as the user named it.
    pub field: String,
    /// The files, one for each mesh.
    pub files: Vec<String>,
    /// The options that `mms judge` and `mms diagnose` share.
    pub options: Vec<String>,
    /// The words of the command, if it is `mms judge`.
    pub of_judge: Option<Words>,
}

/// The option of this name with several values; `None` without a value.
pub fn list<T: Display>(name: &str, values: &[T]) -> Option<String> {
    let texts: Vec<String> = values.iter().map(T::to_string).collect();
    (!texts.is_empty()).then(|| format!("--{name}={}", texts.join(",")))
}

/// The option of this name, once for each value.
pub fn each<T: Display>(name: &str, values: &[T]) -> Vec<String> {
    values.iter().map(|value| format!("--{name}={value}")).collect()
}

/// A command of these words.
pub fn command<W: AsRef<str>>(words: impl IntoIterator<Item = W>) -> Words {
    let words = words.into_iter().map(|it| it.as_ref().to_owned());
    std::iter::once("mms".to_owned()).chain(words).collect()
}

impl Meshes {
    /// A command on these results.
    fn asks(&self, name: &str, more: impl IntoIterator<Item = String>) -> Words {
        let head = [name.to_owned(), self.field.clone()];
        let words = head.into_iter().chain(self.files.iter().cloned());
        command(words.chain(self.options.iter().cloned()).chain(more))
    }

    /// The command for the plan of a diagnosis.
    fn plan(&self) -> Words {
        command(["diagnose", &self.field, "--plan"])
    }
}

/// The quantities of results that `mms diagnose` uses.
const DIAGNOSED: [&str; 4] =
    ["displacement", "velocity", "displacement_gradient", "deformation_gradient"];

/// The command after a judgement of results, or of a table if there are no meshes. `is_chosen` if the user chose quantities.
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
            // An error at few points is too small in the mean for a diagnosis.
            if let (Some(own), Some(orders)) = (&meshes.of_judge, judgements.lower_orders()) {
                let order = list("expected-order", &orders);
                return Some(own.iter().cloned().chain(order).collect());
            }
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

/// The command after a diagnosis by a command of these words: judge the fixed code, or the next step of the ladder.
pub fn after_diagnosis(diagnosis: &Diagnosis, meshes: &Meshes, words: &[String]) -> Option<Words> {
    let field = meshes.field.as_str();
    match (diagnosis.finding, diagnosis.rung) {
        (DiagnosisFinding::Nothing, _) => None,
        (DiagnosisFinding::Named, Rung::Results) => Some(meshes.asks("judge", None)),
        (DiagnosisFinding::Named, _) => Some(words.to_vec()),
        (DiagnosisFinding::Unexplained, Rung::Law) => Some(command(["diagnose", field, "--list"])),
        (DiagnosisFinding::Unexplained, Rung::State(_)) => {
            Some(command(["diagnose", field, "--plan", "law"]))
        }
        (DiagnosisFinding::Unexplained, Rung::Step) => {
            Some(command(["diagnose", field, "--plan", "accelerations"]))
        }
        (DiagnosisFinding::Unexplained, Rung::Results) => Some(meshes.plan()),
    }
}
