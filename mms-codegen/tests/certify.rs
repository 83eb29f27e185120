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
fn terms() {
    for term in ["ln(1 + X^2*Y)", "cbrt(1 + X*Y)", "(1 + X)^(3/2)", "hypot(X, Y)", "cosh(X/4)^(k1*half)", "atan2(Y, X)", "asin(X/4)*acos(Y/4)", "atan(X*Y)", "tan(X/4)", "sinh(Y/3)", "tanh(t)*X", "cos(t)^2*X", "exp(-t/k1)*X"] {
        let text = format!("[field]\ntitle = \"x\"\ndimension = 2\n[parameters]\nk1 = {{ value = 2 }}\nhalf = {{ value = \"1/2\" }}\n[displacement]\nu = [\"0.01*{term}\", 0]\n[material]\nmodel = \"neo_hookean\"\nlambda = 1\nmu = 1\ndensity = 1\n[domain]\nshape = \"box\"\nlower = [0.1, 0.1]\nupper = [1, 1]\ntime = [0.25, 1]\n");
        let compiled = compile("x", "x.toml", &text, &|_| Err("none".into())).unwrap();
        let certificate = certify(&compiled);
        println!("TERM {term} {:?} {:?}", certificate.jacobian, certificate.finite);
    }
}
