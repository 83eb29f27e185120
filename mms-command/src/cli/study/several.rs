//! The methods of one study: each in turn, and the command to type after those that do not pass.

use mms_judge::{Follow as Search, next as judged};
use mms_lab::trial::Progress as Follow;
use mms_report::{Study as Report, method};
use mms_runtime::study::Refinement;

use super::cause::{Ended, Named};
use super::{Case, Study};
use crate::cli::next;
use crate::provenance::Provenance;

impl Study {
    /// The study of each case.
    pub(super) fn reports(
        &self,
        cases: &[Case],
        words: &[String],
        provenance: &Provenance,
        (progress, search): (&dyn Follow, &dyn Search),
    ) -> anyhow::Result<Vec<Report>> {
        let mut reports = Vec::new();
        let mut studied: Vec<Named> = cases.iter().map(Case::named).collect();
        // Without the numbers that all methods share.
        for name in ["precision", "form"] {
            let value = |of: &Named| of.iter().find(|it| it.0 == name).cloned();
            if studied.iter().all(|it| value(it) == value(&studied[0])) {
                studied.iter_mut().for_each(|it| it.retain(|it| it.0 != name));
            }
        }
        for (case, own) in cases.iter().zip(&studied) {
            if cases.len() > 1 {
                progress.say(&method::line(&case.method, case.options.arithmetic));
            }
            let mut report = self.report(case, provenance.clone(), (progress, search))?;
            self.explain(&mut report, case, (&studied, own), words)?;
            reports.push(report);
        }
        self.prefer_passed(&mut reports, &studied, words);
        Ok(reports)
    }

    /// Leads on from the most accurate of several methods that pass, if others do not.
    fn prefer_passed(&self, reports: &mut [Report], studied: &[Named], words: &[String]) {
        let finest = |report: &Report| {
            let run = report.levels.last().and_then(|it| it.as_ref().ok());
            run.and_then(|it| it.level.errors.as_ref().ok()).map_or(f64::INFINITY, |it| it.l2)
        };
        let passed = reports.iter().zip(studied).filter(|(report, _)| report.verdict.is_good());
        let best = passed.min_by(|a, b| finest(a.0).total_cmp(&finest(b.0)));
        let Some((_, method)) = best else { return };
        let has_exclusions =
            !self.excluded && self.periods.is_empty() && self.refine != Refinement::Time;
        let next = match has_exclusions {
            true => next::changed(&self.own(words), method)
                .into_iter()
                .chain(["--excluded".to_owned()])
                .collect(),
            false => {
                let set = self.set.iter().map(|it| format!("--set={it}"));
                judged::command(["check".to_owned(), self.field.clone()].into_iter().chain(set))
            }
        };
        let failed = reports.iter_mut().filter(|it| it.next.is_some());
        failed.for_each(|it| it.next = Some(next.clone()));
    }

    /// The words of the command, `mms study` first.
    fn own(&self, words: &[String]) -> Vec<String> {
        match words {
            [] | [_] => judged::command(["study", &self.field]),
            [_, own @ ..] => judged::command(own),
        }
    }

    /// Says why a study does not pass, and what to type next.
    fn explain(
        &self,
        report: &mut Report,
        case: &Case,
        (studied, own): (&[Named], &Named),
        words: &[String],
    ) -> anyhow::Result<()> {
        if report.verdict.is_good() || !report.is_started() {
            return Ok(());
        }
        let words = self.own(words);
        let ended = Ended {
            field: &self.field,
            input: &case.input,
            variant: case.options.variant(&self.motion),
            set: &self.set,
            method: &report.method,
            studied,
            own,
            refinement: self.refine,
            levels: &report.levels,
            expected: report.expected,
            verdict: report.verdict,
            words: &words,
        };
        let (causes, next) = ended.explained()?;
        (report.causes, report.next) = (causes, Some(next));
        Ok(())
    }
}
