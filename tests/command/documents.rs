//! docs/reference/json.md lists the keys of all documents. These tests make documents, and compare them with its tables, key by
//! key and type by type; each key of a table must occur in a document. Each document is read as its type of `mms-documents`,
//! and written again: not a byte may change.

use std::collections::{BTreeMap, BTreeSet};

use mms_documents as types;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::mms::{BAR, Folder};

const PAGE: &str = include_str!("../../docs/reference/json.md");

/// Tables of keys that only some errors have.
const OF_RARE_ERRORS: [&str; 2] = ["pair", "plane"];

/// Keys that occur only if a row of the matrix fails, which a right solver does not show.
const OF_FAILURES: [(&str, &str); 1] = [("verify", "next_command")];

/// Tables that only a program with the feature `defects` fills.
const OF_DEFECTS: [&str; 3] = ["verify-defects", "shown-defect", "shown-row"];

/// Reads a document as a type, and writes it again.
type Again = fn(&str) -> String;

fn again<T: Serialize + DeserializeOwned>(text: &str) -> String {
    let document: T = serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}"));
    serde_json::to_string_pretty(&document).expect("JSON") + "\n"
}

/// The type of each document.
const TYPES: [(&str, Again); 27] = [
    ("list", again::<types::list::List>),
    ("explain", again::<types::explain::Explain>),
    ("show", again::<types::show::Show>),
    ("check", again::<types::check::Check>),
    ("eval", again::<types::eval::Eval>),
    ("state", again::<types::state::State>),
    ("emit", again::<types::emit::Emit>),
    ("emit-all", again::<types::emit::EmitAll>),
    ("accuracy", again::<types::accuracy::Accuracy>),
    ("run", again::<types::run::Run>),
    ("study", again::<types::study::Study>),
    ("studies", again::<types::study::Studies>),
    ("judge", again::<types::judge::Judge>),
    ("judge-baseline", again::<types::judge::JudgeBaseline>),
    ("judge-same", again::<types::judge::JudgeSame>),
    ("judge-explained", again::<types::judge::JudgeExplained>),
    ("diagnose", again::<types::diagnose::Diagnose>),
    ("diagnose-plan", again::<types::diagnose::DiagnosePlan>),
    ("hypotheses", again::<types::diagnose::Hypotheses>),
    ("campaign", again::<types::campaign::Campaign>),
    ("campaign-runs", again::<types::campaign::CampaignRuns>),
    ("campaign-suggest", again::<types::campaign::CampaignSuggest>),
    ("verify", again::<types::verify::Verify>),
    ("verify-list", again::<types::verify::VerifyList>),
    ("verify-defects", again::<types::verify::VerifyDefects>),
    ("tradeoff", again::<types::tradeoff::Tradeoff>),
    ("extremes", again::<types::extremes::Extremes>),
];

/// A key of a table, and the content that the page states for it.
struct Key {
    name: &'static str,
    holds: &'static str,
}

/// The tables of the page by their headings.
struct Tables(BTreeMap<&'static str, Vec<Key>>);

impl Tables {
    fn read() -> Self {
        let mut tables = BTreeMap::<_, Vec<Key>>::new();
        let mut heading = "";
        for line in PAGE.lines() {
            if line.starts_with("##") {
                heading = line.trim_start_matches('#').trim();
            }
            let cells: Vec<_> = line.split('|').map(str::trim).collect();
            if let ["", key, holds, ..] = cells[..]
                && let Some(name) = key.strip_prefix('`').and_then(|key| key.strip_suffix('`'))
                && !heading.is_empty()
            {
                tables.entry(heading).or_default().push(Key { name, holds });
            }
        }
        Tables(tables)
    }

    fn table(&self, heading: &str) -> &[Key] {
        self.0
            .get(heading)
            .unwrap_or_else(|| panic!("docs/reference/json.md has no table `{heading}`"))
    }
}

/// Compares documents with the tables, and records the keys that occurred.
struct Reader<'a> {
    tables: &'a Tables,
    met: BTreeSet<(String, &'static str)>,
}

impl Reader<'_> {
    /// Asserts that a value is of one of the types in `holds`.
    fn value(&mut self, value: &Value, holds: &str, place: &str) {
        let holds = holds.strip_prefix("optional ").unwrap_or(holds);
        let Some(kind) = holds.split(" or ").find(|kind| fits(value, kind)) else {
            panic!("{place}: the page says `{holds}`, the document has {value}");
        };
        if let Some(heading) = heading(kind) {
            self.object(value, heading, place);
        } else if let Some(kind) = kind.strip_prefix("list of ") {
            for item in value.as_array().expect("a list") {
                self.value(item, kind, &format!("{place}[]"));
            }
        } else if let Some(kind) = holds.strip_prefix("names to ") {
            for (name, item) in value.as_object().expect("an object") {
                self.value(item, kind, &format!("{place}.{name}"));
            }
        }
    }

    /// Asserts that an object has the keys of a table, in their order, and no others.
    fn object(&mut self, value: &Value, heading: &str, place: &str) {
        let mut own = value.as_object().expect("an object").iter().peekable();
        for key in self.tables.table(heading) {
            match own.next_if(|(name, _)| *name == key.name) {
                Some((name, item)) => {
                    self.met.insert((heading.to_owned(), key.name));
                    self.value(item, key.holds, &format!("{place}.{name}"));
                }
                None => assert!(
                    key.holds.starts_with("optional "),
                    "{place}: the page has `{}` in `{heading}`; the document has {:?} there",
                    key.name,
                    own.peek()
                ),
            }
        }
        assert_eq!(own.next(), None, "{place}: not in the table `{heading}`, or in another order");
    }

    /// Runs a command, and compares its document with a table, its type and its schema.
    fn document(&mut self, folder: &Folder, heading: &str, arguments: &str, code: i32) {
        let run = folder.mms(&format!("{arguments} --json")).exits(code);
        self.object(&run.json(), heading, arguments);
        let (_, again) = TYPES.iter().find(|(name, _)| *name == heading).expect("a type");
        assert_eq!(again(&run.stdout), run.stdout, "{arguments}");
        let schema = folder.mms(&format!("schema --document {heading}")).exits(0).json();
        let schema = jsonschema::validator_for(&schema).expect("a schema");
        let complaint = schema.validate(&run.json()).err().map(|it| it.to_string());
        assert_eq!(complaint, None, "{arguments}");
    }
}

/// The table that a type names, as in `[level](#level)`.
fn heading(kind: &str) -> Option<&str> {
    kind.strip_prefix('[')?.split_once(']').map(|(heading, _)| heading)
}

/// Whether a value is of the outermost type.
fn fits(value: &Value, kind: &str) -> bool {
    match value {
        Value::Null => kind == "null",
        Value::Bool(_) => kind == "boolean",
        Value::Number(_) => kind == "number",
        Value::String(_) => kind == "text",
        Value::Array(_) => kind.starts_with("list of "),
        Value::Object(_) => kind.starts_with("names to ") || heading(kind).is_some(),
    }
}

/// A file with much that `mms check` may find: a refuted claim, an enclosed one, a closed form that differs, and a formula that
/// has no value as it is written.
const FAULTY: &str = r#"
[field]
title = "Faulty"
dimension = 1
[displacement]
u = ["0.1*(1 - X)*cos(t) + exp(2*ln(1 + X)) - (1 + X)^2 + 0*sqrt(X - 2)"]
[material]
model = "neo_hookean"
lambda = 1
mu = 1
density = 1
[domain]
shape = "box"
lower = [0]
upper = [1]
time = [0, 1]
[boundary]
x_min = "fixed"
x_max = "fixed"
[[check]]
quantity = "jacobian"
equals = ["1"]
"#;

/// A body that is a polygon.
const POLYGON: &str = include_str!("../../mms-codegen/tests/data/pass/units_polygon.toml");

/// A solver that copies a table, and fails on a mesh without one.
const CAMPAIGN: &str = r#"
[solver]
run = "cp a.csv {output}/{cells}.csv"
output = "{output}/8.csv"
can = { dimensions = [1], start_moving = true, start_deformed = true, loads = ["traction"] }
[[study]]
field = "bar.toml"
cells = [8, 16]
time = [0.001]
"#;

/// A solver that copies the output of `mms run`.
const PASSES: &str = r#"
[solver]
run = "cp -r states{cells} {output}"
output = "{output}/*/*.pvd"
[[study]]
field = "bar.toml"
cells = [8, 16]
quantity = ["u"]
"#;

/// A bar so short that a wave along it grows.
const SOFT: &str = r#"
[field]
title = "Soft"
dimension = 1
[displacement]
u = ["-t*X/2"]
[material]
model = "saint_venant_kirchhoff"
lambda = 2
mu = 1
density = 1
[domain]
shape = "box"
lower = [0]
upper = [1]
time = [0, 1]
"#;

/// A square with a load.
const LOADED: &str = r#"
[field]
title = "Loaded"
dimension = 2
[displacement]
u = ["0.1*X*Y*t", "0.1*X*t"]
[material]
model = "neo_hookean"
lambda = 1
mu = 2
density = 1
[domain]
shape = "box"
lower = [0, 0]
upper = [1, 1]
time = [0, 1]
[boundary]
x_max = "traction"
y_max = "traction"
"#;

/// Finite elements on irregular meshes, whose velocities may have a range of orders.
const IRREGULAR: &str = concat!(
    "judge travelling_wave_2d --time 0.012 --map X=points ",
    env!("CARGO_MANIFEST_DIR"),
    "/tests/command/data/scikit_fem/wave_P1_irregular_uv_08.vtu ",
    env!("CARGO_MANIFEST_DIR"),
    "/tests/command/data/scikit_fem/wave_P1_irregular_uv_16.vtu",
);

#[test]
fn schemas_of_documents_have_names() {
    let folder = Folder::new();
    let level = folder.mms("schema --document level").exits(0).json();
    assert_eq!(level["$ref"], "#/$defs/level");
    assert_eq!(level["$defs"].as_object().map(|it| it.len()), Some(1));
    folder.mms("schema --document studdy").exits(2).complains("did you mean `study`?");
    folder.mms("schema --document zzzzzz").exits(2).complains("docs/reference/json.md");
    folder.mms("schema --document study --material").exits(2);
}

#[test]
fn documents_have_the_keys_of_the_page() {
    let tables = Tables::read();
    let mut reader = Reader { tables: &tables, met: BTreeSet::new() };
    let folder = Folder::with_bar("bar.toml");
    folder.write("faulty.toml", FAULTY);
    folder.write(
        "sign.toml",
        // A wrong sign, and a parameter with the name of a quantity.
        &BAR.replace("+ young/rho0*(1 + F^-2)*A)", "- young/rho0*(1 + F^-2)*A)")
            .replace("young", "E"),
    );
    folder.write("loaded.toml", LOADED);
    folder.write("soft.toml", SOFT);
    folder.write("errors.csv", "h,l1,l2,linf\n8,1,1352,3\n4,2,352,\n2,3,96,4\n1,4,28,5\n");
    folder.write("steps.csv", "h,dt,l2\n1,0.4,16\n1,0.2,4\n1,0.1,1\n");
    for name in ["a.csv", "b.csv", "c.csv"] {
        folder.write(name, "X,u\n0.25,0.01\n0.75,0.02\n");
    }
    folder.write("law.csv", "F,P\n1.1,3e5\n1.2,6e5\n0.9,-3e5\n");
    folder.write("broken.toml", "[field]\ntitle = 1\n");
    folder.write("polygon.toml", POLYGON);
    folder.write("campaign.toml", CAMPAIGN);
    folder.write("passes.toml", PASSES);
    for (heading, arguments, code) in [
        ("list", "list", 0),
        ("explain", "explain eps", 0),
        ("show", "show bar.toml", 0),
        ("show", "show plane_strain_transversely_isotropic --quantity u", 0),
        ("check", "check bar.toml faulty.toml loaded.toml sign.toml soft.toml broken.toml", 2),
        ("eval", "eval bar.toml --at 0.5 --at 7 --time 99", 0),
        ("emit", "emit bar.toml --target c --quantity u", 0),
        ("emit", "emit bar.toml --target c --quantity u -o emitted --check", 1),
        ("emit-all", "emit --all --target julia --quantity u --check -o emitted", 1),
        ("accuracy", "accuracy bar.toml --quantity u --points 2", 0),
        ("accuracy", "accuracy axis_aligned_1d --quantity u --regime jacobian_1e3 --points 2", 1),
        ("run", "run bar.toml --cells 4", 0),
        ("run", "run heated_square_2d --cells 4", 0),
        ("run", "run bar.toml --cells 8 --courant 3 --allow-unstable", 3),
        ("study", "study bar.toml --cells 4,8,16 --fit --excluded", 0),
        ("study", "study bar.toml --cells 8 --refine time --levels 2", 1),
        ("study", "study bar.toml --cells 8,16 --periods 1", 0),
        ("judge", "judge --errors errors.csv", 1),
        ("judge", "judge --errors steps.csv", 0),
        (
            "judge",
            "judge bar.toml a.csv b.csv c.csv --h 4,2,1 --time 0.001 --tighter b.csv --output judged",
            1,
        ),
        (
            "judge-baseline",
            "judge bar.toml a.csv --h 4 --time 0.001 --baseline judged/convergence.json",
            0,
        ),
        ("judge-same", "judge --same a.csv b.csv", 0),
        ("diagnose", "diagnose bar.toml law.csv --quantity stress", 1),
        ("run", "run bar.toml --cells 8 --vtk states8", 0),
        ("run", "run bar.toml --cells 16 --vtk states16", 0),
        ("judge", "judge bar.toml states8 states16 --quantity u", 0),
        ("judge-explained", "judge bar.toml states8 --explain", 0),
        ("judge", IRREGULAR, 0),
        ("diagnose", "diagnose bar.toml states16 --like shape=linear", 0),
        ("diagnose", "diagnose bar.toml states8 states16 --expected-order 3", 1),
        ("state", "state bar.toml --cells 8 --time 0.01 --set amplitude=0.15 -o other.csv", 0),
        ("diagnose", "diagnose bar.toml other.csv", 1),
        ("hypotheses", "diagnose bar.toml --list", 0),
        ("diagnose-plan", "diagnose bar.toml --plan law,residual", 0),
        ("state", "state bar.toml --cells 4 --time 0.01 --without stress -o state.vtu", 0),
        ("state", "state generalized_vortex --cells 2 --time 0.5 -o state.npz", 0),
        ("state", "state twisted_tube --cells 2 --time 0.01 -o tube.vtu", 0),
        ("state", "state lame_sphere --cells 2 --time 0.01 -o sphere.vtu", 0),
        ("state", "state axisymmetric_rod --cells 2 --time 0.001 -o rod.vtu", 0),
        ("state", "state polygon.toml --cells 2 --time 0.01 -o polygon.vtu", 0),
        ("campaign-runs", "campaign campaign.toml --dry-run", 0),
        ("campaign", "campaign campaign.toml", 3),
        ("campaign-runs", "campaign campaign.toml --list", 0),
        ("campaign", "campaign passes.toml", 0),
        ("campaign-suggest", "campaign campaign.toml --suggest", 0),
        (
            "studies",
            "study bar.toml --cells 8,16 --formulation total --shape linear,ugimp --excluded",
            0,
        ),
        ("studies", "study bar.toml --cells 8,16,32 --integrator leapfrog,usl", 1),
        ("verify", "verify --quick --row startup/usl", 0),
        ("verify-list", "verify --list", 0),
        ("tradeoff", "tradeoff bar.toml --target-linf 5e-2 --cost memory", 0),
        ("tradeoff", "tradeoff bar.toml --target-linf 1e-9 --most-work 1e5", 1),
        ("extremes", "extremes bar.toml --quick --row units/soft --row stability", 0),
    ] {
        reader.document(&folder, heading, arguments, code);
    }
    #[cfg(feature = "defects")]
    reader.document(
        &folder,
        "verify-defects",
        "verify --quick --defects=force_late --row time/force_level",
        0,
    );
    let mut missing = Vec::new();
    for (heading, keys) in &tables.0 {
        let is_possible = (cfg!(feature = "defects") || !OF_DEFECTS.contains(heading))
            && !OF_RARE_ERRORS.contains(heading);
        for key in keys.iter().filter(|_| is_possible) {
            let is_met = reader.met.contains(&(heading.to_string(), key.name));
            if !is_met && !OF_FAILURES.contains(&(*heading, key.name)) {
                missing.push(format!("`{}` of the table `{heading}`", key.name));
            }
        }
    }
    assert!(missing.is_empty(), "no document has {}", missing.join(", "));
}
