//! The ladder of a diagnosis: the input of a solver that each step needs, and the mistakes that it detects.

use clap::ValueEnum;
use mms_diagnosis::list::Listed;
use mms_documents::diagnose::{DiagnosePlan, DiagnoseStep};
use mms_spec::foreign::Foreign;

use super::shown::Shown;
use super::table::TextTable;

/// A step of the ladder; each step assumes that the one before passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum DiagnosisStep {
    /// F and a stress, without a solver.
    Law,
    /// Residuals at nodes, at an exact state.
    Residual,
    /// Accelerations at an exact state.
    Accelerations,
    /// Results of meshes.
    Results,
}

impl DiagnosisStep {
    /// The name on the command line.
    fn name(self) -> &'static str {
        match self {
            DiagnosisStep::Law => "law",
            DiagnosisStep::Residual => "residual",
            DiagnosisStep::Accelerations => "accelerations",
            DiagnosisStep::Results => "results",
        }
    }

    /// The input that the step needs.
    fn needs(self) -> &'static str {
        match self {
            DiagnosisStep::Law => {
                "a table of F and of P, S, sigma or tau, as your law computes them: ten rows or more, with shear; no mesh, \
                 and no solver"
            }
            DiagnosisStep::Residual => {
                "the exact u at your nodes (`mms state FIELD --points NODES --time T`), given to your code; the residual that it \
                 finds there, one value for each node"
            }
            DiagnosisStep::Accelerations => {
                "the same state; the accelerations that your code finds there, with the cells or a column `volume`"
            }
            DiagnosisStep::Results => {
                "u at one time or more, of two meshes, with v or F if your code writes them"
            }
        }
    }

    /// The cost of the step.
    fn costs(self) -> &'static str {
        match self {
            DiagnosisStep::Law => "no run",
            DiagnosisStep::Residual | DiagnosisStep::Accelerations => {
                "no step in time, and no solve for residuals: a finer mesh costs next to nothing, and shows smaller mistakes"
            }
            DiagnosisStep::Results => "runs of your code, and seconds of the built-in solver",
        }
    }

    /// The command for a field.
    fn command(self, field: &str) -> String {
        let rest = match self {
            DiagnosisStep::Law => "law.csv --quantity stress",
            DiagnosisStep::Residual => "residual.vtu --residual nodal --time T",
            DiagnosisStep::Accelerations => "accelerations.vtu --time T",
            DiagnosisStep::Results => "coarse.vtu fine.vtu",
        };
        format!("mms diagnose {field} {rest}")
    }

    /// Whether the step detects a hypothesis.
    fn shows(self, hypothesis: &Listed) -> bool {
        let word = match self {
            DiagnosisStep::Law => "law",
            DiagnosisStep::Residual | DiagnosisStep::Accelerations => "exact state",
            DiagnosisStep::Results => "results",
        };
        hypothesis.size_of.is_none() && hypothesis.shown_by.split(", ").any(|it| it == word)
    }
}

/// The steps that are possible with a code.
pub struct DiagnosisPlan<'a> {
    /// The field.
    pub field: &'a Foreign,
    /// The steps.
    pub steps: Vec<DiagnosisStep>,
    /// All hypotheses about the field.
    pub hypotheses: Vec<Listed>,
}

impl<'a> DiagnosisPlan<'a> {
    /// The steps in the order of the ladder; all of them if none is given.
    pub fn new(field: &'a Foreign, asked: &[DiagnosisStep], hypotheses: Vec<Listed>) -> Self {
        let all = DiagnosisStep::value_variants().iter().copied();
        let steps = all.filter(|it| asked.is_empty() || asked.contains(it)).collect();
        DiagnosisPlan { field, steps, hypotheses }
    }

    /// The names of the hypotheses that a step detects, each once.
    fn seen(&self, step: DiagnosisStep) -> Vec<&str> {
        let shown = self.hypotheses.iter().filter(|it| step.shows(it));
        let mut names: Vec<&str> = shown.map(|it| it.title.as_str()).collect();
        names.dedup();
        names
    }
}

impl Shown for DiagnosisPlan<'_> {
    type Document = DiagnosePlan;

    fn text(&self) -> String {
        let field = self.field.shown();
        let each = self.steps.iter().enumerate().map(|(at, step)| {
            format!(
                "{}. {}\n   needs: {}\n   costs: {}\n   run: {}\n   sees: {}",
                at + 1,
                step.name(),
                step.needs(),
                step.costs(),
                step.command(&field),
                self.seen(*step).join(", ")
            )
        });
        let head = "Begin with the first step; each step checks what the next one assumes.";
        std::iter::once(head.to_owned()).chain(each).collect::<Vec<_>>().join("\n\n")
    }

    fn tables(&self) -> Vec<TextTable> {
        let field = self.field.shown();
        let caption = format!("steps of a diagnosis with {field}");
        let mut table = TextTable::new(caption, ["step", "needs", "costs", "run", "sees"]);
        for step in &self.steps {
            table.add_row([
                step.name().to_owned(),
                step.needs().to_owned(),
                step.costs().to_owned(),
                step.command(&field),
                self.seen(*step).join(", "),
            ]);
        }
        vec![table]
    }

    fn document(&self) -> DiagnosePlan {
        let field = self.field.shown();
        let step = |step: &DiagnosisStep| DiagnoseStep {
            step: step.name().to_owned(),
            needs: step.needs().to_owned(),
            costs: step.costs().to_owned(),
            command: step.command(&field),
            sees: self.seen(*step).into_iter().map(str::to_owned).collect(),
        };
        DiagnosePlan {
            field: self.field.raw().to_owned(),
            steps: self.steps.iter().map(step).collect(),
        }
    }
}
