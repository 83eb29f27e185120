//! The documents of `mms campaign`.

use serde::{Deserialize, Serialize};

use crate::judge::Judge;
use crate::provenance::Provenance;

/// The document of `mms campaign FILE`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Campaign {
    /// The name of the solver.
    pub solver: String,
    /// The version of the solver; null if the file has none.
    pub solver_version: Option<String>,
    /// The requested studies.
    pub studies: Vec<CampaignStudy>,
    /// The mistakes that all passing studies exclude together; null if nothing is known.
    pub excluded: Option<Vec<ExcludedTogether>>,
    /// The number of studies that pass.
    pub passed: usize,
    /// The words of the command to type next, `mms` first; missing if all studies pass.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next_command: Option<Vec<String>>,
    /// How the document was made.
    pub provenance: Provenance,
}

/// A mistake, on any face, and the study that excludes it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExcludedTogether {
    /// The name of the mistake, on any face.
    pub hypothesis: String,
    /// The first study that excludes it; null if none does.
    pub by: Option<String>,
}

/// A study of a campaign.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CampaignStudy {
    /// The name of the study; `STUDY@NAME=VALUE,..` for a step of parameters.
    pub name: String,
    /// The name in the file, which all steps share.
    pub study: String,
    /// The parameters, as `name=value`.
    pub set: Vec<String>,
    /// The name of the field.
    pub field: String,
    /// The requested runs.
    pub runs: Vec<CampaignRun>,
    /// The reason why its results cannot be judged.
    pub mistake: Option<String>,
    /// The verdict; null if nothing was judged.
    pub verdict: Option<String>,
    /// With `--canary`, the result of the same study with -b in place of b: `fails`, as it must; `passes`, so that the study
    /// measures nothing; or `open`, if it does not pass with b either. Null without the option, and for a field without a body
    /// force.
    pub canary: Option<String>,
    /// The judgement of the results.
    pub judgement: Option<Judge>,
}

/// A run of the solver.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CampaignRun {
    /// The number of the level, from 1 on.
    pub level: usize,
    /// The number of cells along the longest edge of the body.
    pub cells: usize,
    /// The edge h of a cell.
    pub cell_size: f64,
    /// The time step dt; null if the field is static.
    pub time_step: Option<f64>,
    /// The number of steps; null if the field is static.
    pub steps: Option<u64>,
    /// `done`, `failed` or `interrupted`.
    pub status: String,
    /// The reason why the run failed.
    pub reason: Option<String>,
    /// The last lines that a failed run printed.
    pub last_words: Option<Vec<String>>,
    /// The folder of the run, below the store.
    pub folder: Option<String>,
    /// The seconds on the clock.
    pub seconds: Option<f64>,
    /// The names of processes that the run left behind, which were ended; null if the run is not done.
    pub left_behind: Option<Vec<String>>,
}

/// The document of `mms campaign FILE --dry-run`, and of `--list`, which lists the runs that are not done.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CampaignRuns {
    /// The runs.
    pub runs: Vec<ListedRun>,
}

/// A run that is planned.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ListedRun {
    /// `STUDY/LEVEL`.
    pub name: String,
    /// The number of the level, from 1 on.
    pub level: usize,
    /// The number of cells along the longest edge of the body.
    pub cells: usize,
    /// The edge h of a cell.
    pub cell_size: f64,
    /// The time step dt; null if the field is static.
    pub time_step: Option<f64>,
    /// The number of steps; null if the field is static.
    pub steps: Option<u64>,
    /// True if the store has the run.
    pub done: bool,
    /// The words of the solver's command; with `--list` the words of the `mms` command.
    pub command: Vec<String>,
}

/// The document of `mms campaign FILE --suggest`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CampaignSuggest {
    /// The proposed fields, the cheapest one first.
    pub fields: Vec<ProposedField>,
    /// A field that tests the time integrator alone.
    pub affine: Option<AffineMotion>,
    /// Terms that no proposed field shows.
    pub unseen: Vec<UnseenTerm>,
}

/// A field that is proposed.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ProposedField {
    /// The name of the field.
    pub field: String,
    /// The cells of each level, from coarse to fine.
    pub cells: Vec<usize>,
    /// The terms that no cheaper field of the list shows.
    pub shows: Vec<String>,
}

/// A field that linear shape functions represent exactly.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AffineMotion {
    /// The name of the field.
    pub field: String,
    /// The time steps, from long to short.
    pub time_steps: Vec<f64>,
    /// True if an integrator of constant acceleration is exact.
    pub exact_in_time: bool,
}

/// A term that no proposed field shows.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UnseenTerm {
    /// The name of the term.
    pub term: String,
    /// The part of the solver that stays untested.
    pub means: String,
    /// A field that shows the term.
    pub shown_by: Option<String>,
    /// The keys of `can` that the field needs.
    pub needs: Option<Vec<String>>,
}
