//! Certificates.

use std::fs;
use std::path::Path;

use mms_codegen::certify::certificate::certify;
use mms_codegen::compile;

#[test]
fn probe() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files: Vec<_> = ["tests/data/certify", "tests/data/pass", "../fields", "../examples/fields"]
        .iter()
        .flat_map(|folder| fs::read_dir(root.join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|it| it == "toml"))
        .collect();
    files.sort();
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        let start = std::time::Instant::now();
        let Ok(compiled) = compile("x", "x.toml", &text, &|_| Err("none".into())) else {
            println!("{} does not compile", file.display());
            continue;
        };
        let compiled_in = start.elapsed();
        let start = std::time::Instant::now();
        let found = mms_codegen::certify::certificate::contradictions(&compiled);
        let quick = start.elapsed();
        let start = std::time::Instant::now();
        let certificate = certify(&compiled);
        println!("{} compile {compiled_in:?} quick {quick:?} full {:?} {} boxes, {} contradictions", file.display(), start.elapsed(), certificate.boxes, found.len());
        println!("   {:?} {:?}\n   {:?}", certificate.jacobian, certificate.finite, certificate.rates);
        for (claim, finding) in &certificate.claims {
            println!("   {} {} {finding:?}", claim.face.value.name(), claim.claim.value.name());
        }
    }
}

#[test]
fn functions() {
    use mms_codegen::program::interval::Interval;
    use mms_math::Scalar as _;
    let x = Interval::new(0.6, 0.61);
    println!("{:?} {:?} {:?} {:?} {:?} {:?} {:?}", x.tan(), x.asin(), x.acos(), x.atan(), x.cbrt(), x.sinh(), x.tanh());
    println!("{:?} {:?} {:?}", x.powf(Interval::new(1.0, 1.0)), x.atan2(x), x.cosh());
}
