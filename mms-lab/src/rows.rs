//! Tables that are data: rows in TOML, each with a name of its own.

use anyhow::{Context as _, ensure};
use serde::Deserialize;
use serde::de::DeserializeOwned;

/// A row of such a table.
pub trait Named: DeserializeOwned {
    /// `group/mode`.
    fn name(&self) -> &str;

    /// The part of the name before the slash.
    fn group(&self) -> &str {
        self.name().split('/').next().unwrap_or_default()
    }

    /// Refuses a row without a meaning.
    ///
    /// # Errors
    /// The mistake.
    fn validate(&self) -> anyhow::Result<()>;
}

/// The rows of a text, in its order.
///
/// # Errors
/// A row without a meaning, by its name, or one that is there twice.
pub fn read<R: Named>(text: &str) -> anyhow::Result<Vec<R>> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Rows<R> {
        row: Vec<R>,
    }
    let Rows { row: rows } = toml::from_str::<Rows<R>>(text)?;
    for (at, row) in rows.iter().enumerate() {
        let name = row.name();
        ensure!(name.split('/').count() == 2, "`{name}`: the name has to be group/mode");
        ensure!(rows[..at].iter().all(|other| other.name() != name), "`{name}` twice");
        row.validate().with_context(|| format!("row `{name}`"))?;
    }
    Ok(rows)
}
