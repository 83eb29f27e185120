//! The profiles of codes: shipped ones in `profiles/`, and files of users.

use std::path::Path;

use anyhow::bail;
use mms_campaign::profile::read;
use mms_files::read::{self as files, FileKind};
use mms_results::names::{Profile, Role};
use mms_spec::foreign::shown;
use mms_spec::suggest::advice;

/// The file names and texts of the profiles in `profiles/`.
const SHIPPED: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/profiles.rs"));

/// The names and texts of the shipped profiles.
fn shipped() -> impl Iterator<Item = (&'static str, &'static str)> + Clone {
    SHIPPED.iter().filter_map(|(file, text)| Some((file.strip_suffix(".toml")?, *text)))
}

/// The names of the shipped profiles.
pub fn names() -> impl Iterator<Item = &'static str> + Clone {
    shipped().map(|(name, _)| name)
}

/// The profile of a code, by name or by the path of a file.
///
/// # Errors
/// An unknown name, or a mistake in a file, with its place.
pub fn find(given: &str) -> anyhow::Result<Profile> {
    if let Some((name, text)) = shipped().find(|(name, _)| *name == given) {
        return profile(name, &format!("profiles/{name}.toml"), text);
    }
    if !given.ends_with(".toml") {
        let help = advice(given, names(), |all| format!("the profiles are {all}"));
        bail!(
            "`--from {}`: no profile of that name; {help}, and a path ends with .toml",
            shown(given)
        );
    }
    let text = files::text(Path::new(given), FileKind::Profile)?;
    let stem = Path::new(given).file_stem().map_or(given.into(), |it| it.to_string_lossy());
    profile(&stem, given, &text)
}

/// Reads the text of a profile.
fn profile(name: &str, path: &str, text: &str) -> anyhow::Result<Profile> {
    let role = |word: &str| {
        let symbols = || Role::ALL.iter().map(|it| it.symbol()).collect::<Vec<_>>().join(", ");
        Role::from_name(word).ok_or_else(|| format!("a quantity: {}", symbols()))
    };
    let mms_campaign::profile::Profile { points, quantities, orders } = read(path, text, &role)?;
    Ok(Profile { name: name.to_owned(), points, quantities, orders })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shipped_profile_is_right() {
        for name in names() {
            let profile = find(name).unwrap_or_else(|error| panic!("{error:#}"));
            assert!(!profile.quantities.is_empty() || !profile.orders.is_empty(), "{name}");
        }
    }

    #[test]
    fn an_unknown_profile_is_told_with_the_known_ones() {
        let said = find("calculx").unwrap_err().to_string();
        assert!(said.contains("did you mean `calculix`"), "{said}");
        let said = find("nobody").unwrap_err().to_string();
        assert!(said.contains("calculix"), "{said}");
        assert!(find("none.toml").unwrap_err().to_string().contains("none.toml"));
    }
}
