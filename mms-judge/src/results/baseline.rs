//! Compares one level with a saved judgement: errors may change by as little as the constant of a method.

use anyhow::{Context as _, bail};
use mms_convergence::is_near;
use serde::Deserialize;

use crate::measured::Measured;

/// The part of a saved judgement that is read.
#[derive(Debug, Deserialize)]
pub struct Baseline {
    quantities: Vec<Quantity>,
}

#[derive(Debug, Deserialize)]
struct Quantity {
    name: String,
    norms: Vec<Norm>,
}

#[derive(Debug, Deserialize)]
struct Norm {
    norm: String,
    levels: Vec<BaselineLevel>,
}

#[derive(Debug, Deserialize)]
struct BaselineLevel {
    length: f64,
    error: Option<f64>,
}

/// An error, and its saved value.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// The quantity.
    pub quantity: String,
    /// The norm.
    pub norm: String,
    /// h.
    pub length: f64,
    /// The error.
    pub error: f64,
    /// The saved error.
    pub saved: f64,
    /// The error below which it may be round-off alone.
    pub floor: f64,
}

impl Compared {
    /// Whether it is within one percent of its saved value; or both are round-off.
    pub fn is_near(&self) -> bool {
        is_near(self.error, self.saved) || self.error.max(self.saved) <= self.floor
    }
}

/// The largest relative difference of lengths that belong to one mesh.
const SAME: f64 = 1e-6;

impl Baseline {
    /// Reads a judgement, as `mms judge --output` writes it.
    ///
    /// # Errors
    /// A text that is no judgement.
    pub fn read(text: &str) -> anyhow::Result<Self> {
        serde_json::from_str(text).context(
            "not a judgement: expected convergence.json, as `mms judge --output` writes it",
        )
    }

    /// Compares errors with the saved errors of the same meshes.
    ///
    /// # Errors
    /// A mesh or a quantity that the judgement does not have.
    pub fn compare(&self, measured: &Measured) -> anyhow::Result<Vec<Compared>> {
        let mut all = Vec::new();
        for quantity in &measured.quantities {
            let name = quantity.name.raw();
            let saved = self.quantities.iter().find(|it| it.name == name);
            let saved = saved
                .with_context(|| format!("the saved judgement has no {}", quantity.name.shown()))?;
            for norm in &quantity.norms {
                let of = saved.norms.iter().find(|it| it.norm == norm.name.raw());
                let Some(of) = of else {
                    bail!("the saved judgement has no {} of {name}", norm.name.shown())
                };
                let errors = norm.errors.iter().zip(&norm.floors);
                for (run, (error, &floor)) in measured.runs.iter().zip(errors) {
                    let length = run.cell_size;
                    let level = of.levels.iter().find(|it| (it.length / length - 1.0).abs() < SAME);
                    let level = level.and_then(|it| it.error).with_context(|| {
                        let known: Vec<_> =
                            of.levels.iter().map(|it| it.length.to_string()).collect();
                        format!(
                            "the saved judgement has no mesh of h = {length}, only {}",
                            known.join(", ")
                        )
                    })?;
                    let Some(error) = *error else { continue };
                    let (quantity, norm) = (name.to_owned(), norm.name.raw().to_owned());
                    all.push(Compared { quantity, norm, length, error, saved: level, floor });
                }
            }
        }
        Ok(all)
    }
}
