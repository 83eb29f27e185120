//! `mms list`, and the command line itself.

use std::path::Path;

use mms_codegen::materials::MATERIALS;
use mms_exact::gallery::FIELDS;
use mms_runtime::{FormulationName, IntegratorName, ShapeName, Transfer};
use mms_spec::Form;
use mms_spec::PRECISIONS;
use serde_json::{Map, Value, json};

use super::mms::Folder;

#[test]
fn list_names_every_field_material_and_method() {
    let run = Folder::new().mms("list").exits(0);
    let fields = FIELDS.iter().map(|entry| entry.name);
    let materials = MATERIALS.iter().map(|(stem, _)| *stem);
    let methods = ShapeName::NAMES.iter().chain(IntegratorName::NAMES).copied();
    for name in fields.chain(materials).chain(methods) {
        run.prints(name);
    }
}

#[test]
fn list_as_a_document_has_the_same_names() {
    let document = Folder::new().mms("list --json").exits(0).json();
    let fields = document["fields"].as_array().expect("fields").iter();
    let fields: Vec<_> = fields.map(|field| field["name"].as_str().expect("a name")).collect();
    assert_eq!(fields, FIELDS.iter().map(|entry| entry.name).collect::<Vec<_>>());
    assert_eq!(document["shapes"], json!(ShapeName::NAMES));
    assert_eq!(document["integrators"], json!(IntegratorName::NAMES));
    assert_eq!(document["formulations"], json!(FormulationName::NAMES));
    assert_eq!(document["transfers"], json!(Transfer::NAMES));
    assert_eq!(document["precisions"], json!(PRECISIONS));
    assert_eq!(document["forms"], json!(Form::ALL.map(Form::name)));
    let materials: Vec<_> = MATERIALS.iter().map(|(stem, _)| *stem).collect();
    assert_eq!(document["materials"], json!(materials));
}

#[test]
fn list_tells_what_each_field_claims_and_is_checked_by() {
    let document = Folder::new().mms("list --json").exits(0).json();
    let fields = document["fields"].as_array().expect("fields");
    for (listed, entry) in fields.iter().zip(FIELDS) {
        let field = entry.compile().expect("the gallery compiles").field;
        let boundary = field.boundary.iter();
        let boundary: Map<_, _> = boundary
            .map(|it| (it.face.value.name().into(), it.claim.value.name().into()))
            .collect();
        assert_eq!(listed["boundary"], Value::Object(boundary), "{}", entry.name);
        assert_eq!(listed["body"], field.domain.body.name(), "{}", entry.name);
        let checks: Vec<_> = field.checks.iter().map(|it| it.quantity.value.name()).collect();
        assert_eq!(listed["checks"], json!(checks), "{}", entry.name);
        let studies = listed["studies"].as_array().expect("studies");
        assert_eq!(studies.len(), field.studies.len(), "{}", entry.name);
        for (listed, study) in studies.iter().zip(&field.studies) {
            assert_eq!(listed["order"], json!(study.order), "{}", entry.name);
            assert_eq!(listed["form"], json!(study.form), "{}", entry.name);
        }
    }
}

/// The words of a line, without the blanks that align its columns.
fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

/// The fields that ship are derived by hand; an added field need not be listed.
#[test]
fn the_page_shows_the_gallery_as_it_is_listed() {
    let page = include_str!("../../docs/guide/gallery.md");
    let (_, block) = page.split_once("$ mms list\n").expect("the command");
    let (shown, _) = block.split_once("```").expect("the end of its block");
    let shown: Vec<_> = shown.lines().map(words).collect();
    let is_shown = |name: &str| shown.iter().any(|line| line.first() == Some(&name));
    for entry in FIELDS {
        let by_hand = format!("{}/tests/hand/{}.rs", env!("CARGO_MANIFEST_DIR"), entry.name);
        assert!(is_shown(entry.name) || !Path::new(&by_hand).exists(), "no {}", entry.name);
    }
    let listed = Folder::new().mms("list").exits(0).stdout;
    let mut rest = listed.lines().map(words);
    for line in &shown {
        assert!(
            rest.any(|listed| listed == *line),
            "the page shows {line:?}, and `mms list` does not:\n{listed}"
        );
    }
}

#[test]
fn bad_usage_exits_2_and_prints_nothing() {
    for arguments in [
        "nonsense",
        "--nonsense",
        "list extra",
        "show",
        "check",
        "study",
        "eval",
        "accuracy",
        "new",
        "schema extra",
    ] {
        Folder::new().mms(arguments).exits(2).complains("error:").prints_nothing();
    }
}

#[test]
fn instructions_are_limited_by_words_that_are_known() {
    let with = |word: &str| {
        let arguments = ["eval", "bar_1d", "--at", "0.3", "--time", "0.01"];
        Folder::new().run_with(&arguments, |command| command.env("MMS_INSTRUCTIONS", word))
    };
    let [baseline, avx2, avx512] = ["baseline", "avx2", "avx512"].map(|word| with(word).exits(0));
    assert_eq!([&avx2.stdout, &avx512.stdout], [&baseline.stdout; 2]);
    with("sse2")
        .exits(2)
        .complains("`MMS_INSTRUCTIONS=sse2`: expected one of baseline, avx2, avx512")
        .prints_nothing();
}

#[test]
fn help_and_version_exit_0() {
    let help = Folder::new().mms("--help").exits(0);
    for command in ["list", "show", "check", "eval", "accuracy", "study", "new", "schema"] {
        help.prints(command);
    }
    Folder::new().mms("--version").exits(0).prints(env!("CARGO_PKG_VERSION"));
}

#[test]
fn words_of_the_output_are_explained() {
    let folder = Folder::new();
    folder.mms("explain CPGIMP").exits(0).prints("cpGIMP: Contiguous-particle GIMP.");
    folder.mms("explain dead load").exits(0).prints("dead load: A traction per reference area");
    folder.mms("explain usl musl").exits(0).prints("USL: Update stress last.").prints("MUSL: ");
    folder.mms("explain").exits(0).prints("APIC, asymptotic, body force");
    folder.mms("explain verdict").exits(0).prints("Judging (docs/guide/judging.md) explains them.");
    folder.mms("explain flipp").exits(2).complains("did you mean `flip`?");
}

#[test]
fn a_language_is_asked_for_and_known_by_other_words() {
    let folder = Folder::new();
    folder.mms("emit bar_1d").exits(2).complains("name the language with `--target`: ");
    for (word, target) in [("c++", "cpp"), ("FEniCS", "ufl"), ("f90", "fortran")] {
        let run = folder.mms(&format!("emit bar_1d --target {word}")).exits(2);
        run.complains(&format!("`--target {target}` serves it"));
    }
    folder.mms("emit bar_1d --target juila").exits(2).complains("'julia'");
}

#[test]
fn fields_of_the_gallery_are_checked_by_name() {
    let folder = Folder::new();
    folder.mms("check bar_1d").exits(0);
    folder.mms("check bar1d").exits(2).complains("did you mean `bar_1d`?");
}

/// The commands in an order in which the examples of each find the files of those before it. The other commands take long:
/// a separate test shows that their examples are understood.
const QUICK: [&str; 15] = [
    "new", "check", "show", "eval", "list", "schema", "emit", "state", "judge", "diagnose",
    "campaign", "report", "run", "study", "explain",
];

#[test]
fn the_help_of_a_command_begins_with_two_examples_that_work() {
    let folder = Folder::new();
    folder.write("errors.csv", "h,l2\n0.1,1e-2\n0.05,2.5e-3\n0.025,6.25e-4\n");
    folder.write(
        "campaign.toml",
        "[solver]\nrun = \"cp {here}/coarse.csv {output}/u.csv\"\noutput = \"{output}/u.csv\"\n\n\
         [[study]]\nfield = \"bar_1d\"\ncells = [8, 16]\n",
    );
    for command in QUICK {
        let help = folder.mms(&format!("{command} --help")).exits(0);
        let (head, _) = help.stdout.split_once("Usage:").expect("a usage");
        let lines: Vec<&str> =
            head.lines().filter_map(|line| line.strip_prefix("  mms ")).collect();
        assert_eq!(lines.len(), 2, "{help}");
        assert_eq!(help.stdout.lines().nth(2), Some("Examples:"), "{help}");
        for line in lines {
            let run = folder.types(&format!("mms {line}"));
            assert_eq!(run.code, 0, "{run}");
        }
    }
}

/// `gimp` is two shape functions, and the first file is in the place of the field.
#[test]
fn words_that_people_mean_otherwise_get_a_hint() {
    let folder = Folder::new();
    let gimp = folder.mms("study bar_1d --shape gimp").exits(2);
    gimp.complains("did you mean `ugimp` or `cpgimp`?");
    let forgotten = folder.mms("judge a.csv b.csv").exits(2);
    forgotten
        .complains("`a.csv` is in the place of the field")
        .complains("as in bar_1d or ./mine.toml");
}

#[test]
fn each_field_says_how_it_starts() {
    let document = Folder::new().mms("list --json").exits(0).json();
    for field in document["fields"].as_array().expect("fields") {
        assert!(field["starts"].is_string(), "{field}");
    }
    for term in ["canary", "rest", "swirl", "interval", "surface impedance", "not asymptotic"] {
        Folder::new().mms(&format!("explain {term}")).exits(0).prints(&format!("{term}: "));
    }
}
