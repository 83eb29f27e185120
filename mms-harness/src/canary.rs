//! Canaries: the runs of a campaign with a wrong b. A study that passes with it measures nothing.

use std::path::Path;

use anyhow::bail;
use mms_campaign::Campaign;
use mms_campaign::template::{Placeholder, Template};
use mms_exact::{Input, Open};
use mms_spec::quantity::Quantity;

use crate::only::Only;
use crate::plan::{CampaignPlan, PlannedStudy, templates};

/// Plans the runs of a file with -b in the data of each run. Leaves out studies of fields without a body force.
///
/// # Errors
/// The errors of [`CampaignPlan::new`]; a solver that does not get b from the campaign.
pub fn plan(
    path: &Path,
    campaign: Campaign,
    only: &[Only],
    open: Open<'_>,
) -> anyhow::Result<CampaignPlan> {
    let mut plan = CampaignPlan::with(path, campaign, only, open, true)?;
    plan.studies.retain(|it| has_force(&it.input));
    validate_force(&plan)?;
    Ok(plan)
}

/// Whether a field has a body force other than 0.
fn has_force(input: &Input) -> bool {
    let force = input.compiled.derivation.quantities.get(&Quantity::BodyForce);
    force.is_some_and(|it| it.iter().any(|part| !input.compiled.graph.is_zero(*part)))
}

/// Refuses a solver that does not get b from the campaign, because its runs cannot get another b.
fn validate_force(plan: &CampaignPlan) -> anyhow::Result<()> {
    let mut words = templates(&plan.campaign).flat_map(Template::placeholders);
    let names_factor = words.any(|it| it == Placeholder::ForceFactor);
    let is_static = |it: &PlannedStudy| it.input.is_static();
    let has_state = plan.campaign.solver.state().is_some() && plan.studies.iter().all(is_static);
    if plan.target.is_some() || names_factor || has_state {
        return Ok(());
    }
    bail!(
        "`--canary`: the solver does not get b from the campaign, so no run can be given a wrong one; let `run` name \
         {{force_factor}} and multiply b by it (it is 1, and -1 for a canary), or take b from {{emitted}}"
    )
}
