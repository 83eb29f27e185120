//! The rows: the extreme, the expectation, and the reason.

use anyhow::ensure;
use mms_analysis::accuracy::regime;
use serde::Deserialize;

use super::verdict::Diagnosis;
use crate::rows::{Named, read};

/// The rows, in their order.
const ROWS: &str = include_str!("rows.toml");

/// A number for each dimension of the body, 1 to 3.
pub type PerDimension = [usize; 3];

/// A row as it is written.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExtremeSetting {
    /// `group/mode`.
    pub name: String,
    /// The field is put in this regime of `mms accuracy`.
    pub regime: Option<String>,
    /// The material has this ratio of lambda to mu.
    pub lambda_over_mu: Option<String>,
    /// Cells along the longest edge, instead of the default of `mms run`.
    pub cells: Option<PerDimension>,
    /// Particles per cell along each axis.
    pub particles: Option<PerDimension>,
    /// The Courant number.
    pub courant: Option<f64>,
    /// The number of steps in the time window; with `--quick`, and without.
    pub steps: Option<[usize; 2]>,
    /// The number of steps of the Courant number after which the run ends.
    pub end: Option<usize>,
    /// Whether steps above the stable one are allowed.
    #[serde(default)]
    pub allow_unstable: bool,
    /// Whether the row runs in single precision.
    #[serde(default)]
    pub single: bool,
    /// The largest l2, relative to the l2 of the field as declared on the grid of `mms run`, scaled with h^2 if the grid is
    /// coarser; both over the largest displacement. Without it the row has to stop.
    pub l2: Option<f64>,
    /// The diagnoses with which the row may stop.
    #[serde(default)]
    pub stops: Vec<Diagnosis>,
    /// The reason.
    pub theory: String,
}

impl ExtremeSetting {
    /// Whether the row's steps may be above the stable one, if that is `allowed` for the method's own: a row that has a Courant
    /// number decides itself.
    pub fn allows_unstable(&self, allowed: bool) -> bool {
        self.allow_unstable || allowed && self.courant.is_none()
    }
}

impl Named for ExtremeSetting {
    fn name(&self) -> &str {
        &self.name
    }

    fn validate(&self) -> anyhow::Result<()> {
        if let Some(name) = &self.regime {
            ensure!(regime::find(name).is_some(), "no regime `{name}`");
        }
        ensure!(self.regime.is_none() || self.lambda_over_mu.is_none(), "two changes of the field");
        ensure!(self.l2.is_some() || !self.stops.is_empty(), "nothing is expected");
        ensure!(self.steps.is_none() || self.courant.is_none(), "steps and a Courant number");
        ensure!(!self.theory.is_empty(), "no theory");
        Ok(())
    }
}

/// The rows.
///
/// # Errors
/// A row without a meaning; a test reads them all.
pub fn rows() -> anyhow::Result<Vec<ExtremeSetting>> {
    read(ROWS)
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_row_means_something() {
        let rows = super::rows().unwrap();
        assert!(rows.len() > 20);
    }
}
