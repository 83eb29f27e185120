//! Imports point one way: between crates, between the modules of a crate, and, except for small circles, between files.

mod crates;
mod imports;

use std::fs;
use std::path::{Path, PathBuf};

use crates::CRATES;
use imports::Imports;

/// The largest number of files that may import each other.
const LARGEST_CIRCLE: usize = 8;

/// A crate: the crates of this workspace that it may import, and its modules in layers, the lowest first. A module may import
/// modules of its own layer and of lower ones.
struct Crate {
    name: &'static str,
    knows: &'static [&'static str],
    layers: &'static [&'static str],
}

fn folder(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    if name == "mms" { root.into() } else { root.join(name) }
}

#[test]
fn crates_know_what_they_may() {
    for Crate { name, knows, .. } in CRATES {
        let text = fs::read_to_string(folder(name).join("Cargo.toml")).expect("a manifest");
        let manifest: toml::Table = toml::from_str(&text).expect("a manifest");
        let dependencies = manifest.get("dependencies").and_then(|it| it.as_table());
        let names = dependencies.into_iter().flat_map(|it| it.keys());
        let mut known: Vec<&str> =
            names.map(String::as_str).filter(|it| it.starts_with("mms-")).collect();
        known.sort_unstable();
        assert_eq!(known, *knows, "{name}");
    }
}

#[test]
fn every_crate_is_listed() {
    let text = fs::read_to_string(folder("mms").join("Cargo.toml")).expect("a manifest");
    let manifest: toml::Table = toml::from_str(&text).expect("a manifest");
    let members = manifest["workspace"]["members"].as_array().expect("a list");
    let mut members: Vec<&str> = members.iter().filter_map(|member| member.as_str()).collect();
    members.push("mms");
    members.sort_unstable();
    let mut listed: Vec<&str> = CRATES.iter().map(|it| it.name).collect();
    listed.sort_unstable();
    assert_eq!(members, listed);
}

#[test]
fn modules_import_from_lower_layers() {
    for Crate { name, layers, .. } in CRATES {
        let imports = Imports::of(&folder(name).join("src"));
        let find =
            |module: &str| layers.iter().position(|layer| layer.split(' ').any(|it| it == module));
        let layer = |module: &str| {
            find(module)
                .unwrap_or_else(|| panic!("{name}: tests/layers/crates.rs lacks `{module}`"))
        };
        for module in imports.modules() {
            layer(&module);
        }
        for (from, to) in imports.between_modules() {
            assert!(
                layer(&to) <= layer(&from),
                "{name}: `{from}` imports from `{to}`, which is above it"
            );
        }
    }
}

#[test]
fn circles_of_files_are_small() {
    for Crate { name, .. } in CRATES {
        for circle in Imports::of(&folder(name).join("src")).circles() {
            assert!(
                circle.len() <= LARGEST_CIRCLE,
                "{name}: {} files import each other: {circle:?}",
                circle.len()
            );
        }
    }
}

/// The imports are really read, although the other tests find nothing wrong in them.
#[test]
fn imports_are_found() {
    let imports = Imports::of(&folder("mms-codegen").join("src"));
    let pairs = imports.between_modules();
    let has = |from: &str, to: &str| pairs.contains(&(from.into(), to.into()));
    assert!(
        has("driver", "certify") && has("certify", "bounds") && has("compile", "declared"),
        "{pairs:?}"
    );
    assert!(!has("bounds", "certify"), "{pairs:?}");
    assert!(imports.circles().iter().any(|circle| circle.contains(&vec!["selection".into()])));
}

/// Programs that list their modules find no file by themselves.
#[test]
fn no_file_of_tests_is_left_out() {
    for Crate { name, .. } in CRATES {
        let tests = folder(name).join("tests");
        let read = |path: PathBuf| fs::read_to_string(path).unwrap_or_default();
        let manifest = read(folder(name).join("Cargo.toml"));
        if !manifest.contains("autotests = false") {
            continue;
        }
        let entries =
            fs::read_dir(&tests).expect("a folder").map(|it| it.expect("an entry").path());
        let entries: Vec<PathBuf> = entries.collect();
        let files = entries.iter().filter(|path| path.is_file()).cloned();
        let listed: String = files.map(read).chain([manifest]).collect();
        for path in entries {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let is_code = path.extension().is_some_and(|it| it == "rs")
                || ["mod.rs", "main.rs"].iter().any(|file| path.join(file).exists());
            let [module, file, inside] = [
                format!("mod {stem};"),
                format!("\"tests/{stem}.rs\""),
                format!("\"tests/{stem}/main.rs\""),
            ];
            let is_listed = [module, file, inside].iter().any(|place| listed.contains(place));
            assert!(is_listed || !is_code, "{name}: tests/main.rs lacks `{stem}`");
        }
    }
}

/// Whether documentation has an example that would be a program: a block that names no other language.
fn has_example(text: &str) -> bool {
    let lines = text.lines().map(str::trim_start);
    let comments = lines.filter_map(|it| it.strip_prefix("///").or(it.strip_prefix("//!")));
    let mut fences = comments.map(str::trim).filter(|it| it.starts_with("```")).step_by(2);
    fences.any(|opening| ["```", "```rust"].contains(&opening))
}

/// A crate without examples declares this, which saves the time to look for them.
#[test]
fn no_example_in_documentation_is_left_out() {
    for Crate { name, .. } in CRATES {
        let manifest = fs::read_to_string(folder(name).join("Cargo.toml")).expect("a manifest");
        if manifest.contains("doctest = false") {
            let files = format!("{}/src/**/*.rs", folder(name).display());
            for path in glob::glob(&files).expect("a pattern").map(|path| path.expect("a path")) {
                let text = fs::read_to_string(&path).expect("a source file");
                assert!(!has_example(&text), "no test looks at the example in {}", path.display());
            }
        }
    }
    assert!(has_example("/// ```text\n/// x\n/// ```\n/// ```\n/// x\n/// ```"));
}
