//! Numbers that are hard to write, and programs that are hard to compile.

use std::fs;

use mms_codegen::compile::compile_unproved;
use mms_codegen::{Compiled, Options};
use mms_emit::{Subject, Target};
use mms_spec::quantity::Quantity;

use super::build::{can_build, can_prove, in_turn, ports, prove, quick, scratch, shell, write};
use super::sampled::sampled;

fn field(u: &str, quantity: Quantity) -> Compiled {
    let text = format!(
        "[field]\ntitle = \"x\"\ndimension = 1\n[parameters]\na = {{ value = \"1/3\" }}\n\
         [displacement]\nu = [\"{u}\"]\n[material]\nmodel = \"neo_hookean\"\nlambda = 1\nmu = 1\n\
         density = 1\n[domain]\nshape = \"box\"\nlower = [0]\nupper = [1]\ntime = [0, 1]\n"
    );
    let mut options = Options::default();
    options.selection.quantities = Some([quantity].into());
    compile_unproved("field", "x.toml", &text, &|path| Err(path.into()), &options)
        .unwrap_or_else(|failure| panic!("{failure}"))
}

#[test]
fn numbers_keep_their_digits_in_every_language() {
    let formulas = [
        "X/3*t/7",
        "X*1e-400*t",
        "X*1e-150*(t + 1e-150)",
        "X*(t/1e300 + 0.1)/1e5",
        "X*t*123456789012345678901234567890/1e40",
        "-X*t*2/3*a - 1e-5*X",
        "X*(a*0.1 + 1/3)*t/9007199254740993",
        "0",
    ];
    for (index, u) in formulas.iter().enumerate() {
        let field = field(u, Quantity::Displacement);
        let subject = Subject::new(&field);
        for target in in_turn("digits", index, formulas.len()) {
            prove(target, &subject, &format!("literals/{index}"), quick);
        }
    }
}

#[test]
fn a_thousand_terms_compile_in_every_language() {
    let terms: Vec<String> =
        (1..=1000).map(|k| format!("sin({k}*X + t)/{}", 1000 * k * k)).collect();
    let field = field(&terms.join(" + "), Quantity::Velocity);
    let subject = Subject::new(&field);
    for target in sampled(ports().filter(|target| can_prove(target)), 12) {
        prove(target, &subject, "thousand", quick);
    }
}

/// If no function has a value at any point, the check program still checks the defaults.
#[test]
fn a_field_without_a_value_compiles() {
    let field = field("t*sqrt(X - 10)", Quantity::Velocity);
    let subject = Subject::new(&field);
    assert!(subject.vectors().samples.is_empty());
    for name in sampled(["c", "cpp", "fortran", "rust", "python", "octave"], 3) {
        let target = Target::find(name).expect("a target of that name");
        if can_prove(target) {
            prove(target, &subject, "valueless", quick);
        }
    }
}

#[test]
fn every_check_program_refuses_the_source_of_another_field() {
    for target in ports().filter(|target| can_build(target)) {
        is_refused(target, "X*t/3*1.001");
        // Other languages report themselves that there is no such root.
        if ["c", "cpp", "fortran", "rust"].contains(&target.name) {
            is_refused(target, "X*t/3 + sqrt(X*t - 10)");
        }
    }
}

/// Asserts that a check program names the wrong function if the source is from a field with this u.
fn is_refused(target: &Target, wrong: &str) {
    let [right, wrong] = ["X*t/3", wrong].map(|u| field(u, Quantity::DisplacementGradient));
    let [right, wrong] = [&right, &wrong].map(|field| (target.emit)(&Subject::new(field)));
    let folder = scratch(&format!("wrong/{}", target.name));
    write(&right, &folder);
    for source in wrong.sources() {
        fs::write(folder.join(&source.name), &source.text).expect("a written file");
    }
    let run = shell(&quick(right.verify.expect("a check program")), &folder);
    let out = String::from_utf8_lossy(&run.stdout);
    assert_eq!(run.status.code(), Some(1), "{}: {out}", target.name);
    assert!(out.contains("displacement_gradient"), "{}: {out}", target.name);
}

#[test]
fn check_programs_refuse_a_batch_without_its_last_point() {
    let loops = [
        (
            "cpp",
            "for (std::size_t i = 0; i < n; i++)",
            "for (std::size_t i = 0; i + (n > 3) < n; i++)",
        ),
        ("rust", "for i in 0..count {", "for i in 0..count - usize::from(count > 3) {"),
        ("fortran", "do i = 1, n", "do i = 1, merge(n - 1, n, n > 3)"),
    ];
    let field = field("X*t/3", Quantity::DisplacementGradient);
    for (name, right, wrong) in loops {
        let target = Target::find(name).expect("a target of that name");
        if !can_build(target) {
            continue;
        }
        let output = (target.emit)(&Subject::new(&field));
        let folder = scratch(&format!("last/{name}"));
        write(&output, &folder);
        for file in &output.files {
            let text = file.text.replace(right, wrong);
            fs::write(folder.join(&file.name), text).expect("a written file");
        }
        let run = shell(&quick(output.verify.expect("a check program")), &folder);
        let out = String::from_utf8_lossy(&run.stdout);
        assert_eq!(run.status.code(), Some(1), "{name}: {out}");
        assert!(out.contains("displacement_gradient"), "{name}: {out}");
    }
}

#[test]
fn test_vectors_are_one_text_in_every_language_and_keep_their_bits() {
    let field = field("X*t/3 + a*X^2*1e-300", Quantity::DisplacementGradient);
    let subject = Subject::new(&field);
    let texts: Vec<String> = ports()
        .map(|target| {
            let file = (target.emit)(&subject).files.pop().expect("a file");
            assert!(file.name.ends_with("_vectors.txt"), "{}: {}", target.name, file.name);
            file.text
        })
        .collect();
    assert!(texts.iter().all(|text| *text == texts[0]));
    let vectors = subject.vectors();
    let mut lines = texts[0].lines().filter(|line| !line.starts_with('#'));
    let mut table = |name: &str, rows: &[Vec<f64>]| {
        let head = lines.next().expect("a table");
        let start = format!("{name} {} {} ", rows.len(), rows[0].len());
        assert!(head.starts_with(&start), "`{head}` is no `{start}`");
        for row in rows {
            let words = lines.next().expect("a row").split(' ').map(|it| it.parse::<f64>());
            let bits: Vec<u64> = words.map(|it| it.expect("a number").to_bits()).collect();
            assert_eq!(bits, row.iter().map(|it| it.to_bits()).collect::<Vec<_>>(), "{name}");
        }
    };
    table("defaults", std::slice::from_ref(&vectors.defaults));
    let points = vectors.samples.len() / vectors.sets.len();
    for (set, values) in vectors.sets.iter().enumerate() {
        let of_set = points * set..points * (set + 1);
        let samples = vectors.samples[of_set].iter();
        table("set", std::slice::from_ref(values));
        table("at", &samples.map(|it| it.numbers()).collect::<Vec<_>>());
        for (name, expected) in vectors.names.iter().zip(&vectors.expected) {
            // The ends of the body and of the time window are no values at points.
            let rows = expected.len() / vectors.sets.len();
            assert!([1, points].contains(&rows), "{name}");
            table(name, &expected[rows * set..rows * (set + 1)]);
        }
    }
    assert_eq!(lines.next(), None);
}

/// A check program that read only a part of the test vectors would pass without having seen the rest.
#[test]
fn every_check_program_refuses_test_vectors_that_are_not_whole() {
    let field = field("X*t/3", Quantity::DisplacementGradient);
    let subject = Subject::new(&field);
    for target in sampled(ports().filter(|target| can_build(target)), 3) {
        let bundle = (target.emit)(&subject);
        let folder = scratch(&format!("cut/{}", target.name));
        write(&bundle, &folder);
        let vectors = bundle.files.last().expect("test vectors");
        let last = vectors.text.rfind("\nset ").expect("more than one set");
        let [in_a_table, before_a_set] =
            [vectors.text.len() - 1 - vectors.text.len() / 50, last + 1];
        let line = quick(bundle.verify.expect("a check program"));
        for end in [in_a_table, before_a_set] {
            fs::write(folder.join(&vectors.name), &vectors.text[..end]).expect("a written file");
            let run = shell(&line, &folder);
            let [out, err] = [&run.stdout, &run.stderr].map(|text| String::from_utf8_lossy(text));
            assert!(!run.status.success(), "{}: {out}{err}", target.name);
            assert!(!out.contains("worst error"), "{}: {out}", target.name);
        }
    }
}
