//! Certificates: honest fields, liars (see `data/fail/refuted_*`), and random fields whose values
//! must lie within what is proved.

use std::fs;
use std::path::{Path, PathBuf};

use mms_codegen::certify::certificate::{Certificate, certify};
use mms_codegen::certify::claims::Finding;
use mms_codegen::certify::finite::Finite;
use mms_codegen::certify::jacobian::Jacobian;
use mms_codegen::certify::rates::Rates;
use mms_codegen::certify::sample::samples;
use mms_codegen::mechanics::Response;
use mms_codegen::program::Output;
use mms_codegen::program::dual::Dual;
use mms_codegen::program::interpret::{Interpreter, Point};
use mms_codegen::program::precise::Precise;
use mms_codegen::quantity::Quantity;
use mms_codegen::{Compiled, compile};
use proptest::prelude::*;

/// What one certificate may take: some 0.2 ms a box in two dimensions, and 1 ms in three.
const BOXES: usize = 2500;

fn honest_fields() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = ["tests/data/certify", "../fields"].map(|folder| root.join(folder));
    let entries = folders.iter().flat_map(|folder| fs::read_dir(folder).expect("a folder"));
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files
}

fn compiled(text: &str) -> Compiled {
    let load = |_: &str| Err("no files here".to_string());
    compile("x", "x.toml", text, &load).unwrap_or_else(|failure| panic!("{failure}"))
}

fn of_file(name: &str) -> (Compiled, Certificate) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/certify");
    let compiled = compiled(&fs::read_to_string(folder.join(name)).expect("a readable file"));
    let certificate = certify(&compiled);
    (compiled, certificate)
}

fn bounds(certificate: &Certificate) -> ([f64; 2], Rates) {
    match (&certificate.jacobian, certificate.rates) {
        (Jacobian::Positive(bounds), Some(rates)) => (*bounds, rates),
        other => panic!("{other:?}"),
    }
}

#[test]
fn honest_fields_are_proved_and_cheaply() {
    for file in honest_fields() {
        let compiled = compiled(&fs::read_to_string(&file).expect("a readable file"));
        let certificate = certify(&compiled);
        let shown = file.display();
        assert!(certificate.objections(&compiled).is_empty(), "{shown}: {certificate:?}");
        assert_eq!(certificate.finite, Finite::Proved, "{shown}");
        for (claim, finding) in &certificate.claims {
            assert_eq!(*finding, Finding::Proved, "{shown}: {}", claim.face.value.name());
        }
        assert!(certificate.boxes <= BOXES, "{shown}: {} boxes", certificate.boxes);
    }
}

#[test]
fn a_determinant_of_a_millionth_is_proved_positive() {
    let (_, certificate) = of_file("sliver_2d.toml");
    let ([lower, _], _) = bounds(&certificate);
    assert!(0.0 < lower && lower <= 1e-6 && lower > 0.7e-6, "{lower:e}");
}

#[test]
fn bounds_are_near_the_largest_values() {
    // F = 1 + a pi cos(pi X) sin(pi c t): the extrema are 1 +- a pi.
    let (_, certificate) = of_file("axis_aligned_1d.toml");
    let ([lower, upper], rates) = bounds(&certificate);
    let strain = 0.05 * std::f64::consts::PI;
    assert!(lower <= 1.0 - strain && 0.8 * (1.0 - strain) < lower, "{lower}");
    assert!(1.0 + strain <= upper && upper < 1.2 * (1.0 + strain), "{upper}");
    let stretch = rates.principal_stretch;
    assert!(1.0 + strain <= stretch && stretch < 1.1 * (1.0 + strain), "{stretch}");
    // c^2 rho0 = (lambda (1 - ln F) + mu (1 + F^2))/F^2 grows as F falls.
    let (lambda, mu, least) = (1e7 * 0.3 / (1.3 * 0.4), 1e7 / 2.6, 1.0 - strain);
    let modulus = (lambda * (1.0 - least.ln()) + mu * (1.0 + least * least)) / (least * least);
    let (speed, fastest) = (rates.reference_wave_speed, (modulus / 1000.0).sqrt());
    assert!(fastest <= speed && speed < 1.1 * fastest, "{speed} {fastest}");
}

#[test]
fn a_rotation_leaves_the_bounds_sharp() {
    // A vortex shears by gamma = R g h', which stretches by gamma/2 + sqrt(1 + gamma^2/4); h' is
    // largest where 48 y^2 = 1 for R = 1 + y.
    let (_, certificate) = of_file("generalized_vortex.toml");
    let ([lower, upper], rates) = bounds(&certificate);
    assert_eq!([lower, upper], [1.0, 1.0]);
    let largest = (0..=4000).map(|k| 0.75 + 0.5 * f64::from(k) / 4000.0).fold(0.0, |most, r| {
        let slope: f64 = 2.0 * (4.0 * r - 3.0) * (4.0 * r - 5.0) * (32.0 * r - 32.0);
        f64::max(most, (r * slope).abs())
    });
    let stretch = largest / 2.0 + (1.0 + largest * largest / 4.0).sqrt();
    let bound = rates.principal_stretch;
    assert!(stretch <= bound && bound < 1.2 * stretch, "{bound} {stretch}");
}

/// A plane field of a few waves and powers.
fn wave(a: [f64; 4], k: [u8; 4], lambda: f64) -> String {
    format!(
        "[field]\ntitle = \"x\"\ndimension = 2\n[parameters]\n\
         a = {{ value = 0.5, range = [0.25, 1] }}\n[displacement]\n\
         u = [\"a*({}*sin({}*X + t)*Y + {}*X*Y^2)\", \"a*({}*cos({}*Y - t)*X + {}*t*exp(-X))\"]\n\
         [material]\nmodel = \"neo_hookean\"\nlambda = {lambda}\nmu = 1\ndensity = \"1 + X/4\"\n\
         [domain]\nshape = \"box\"\nlower = [0, 0]\nupper = [1, 1]\ntime = [0, \"1 + a\"]\n",
        a[0], k[0], a[1], a[2], k[1], a[3],
    )
}

fn amplitude() -> impl Strategy<Value = f64> {
    (-50..=50_i32).prop_map(|k| f64::from(k) / 1000.0)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, ..ProptestConfig::default() })]
    #[test]
    fn no_value_exceeds_what_is_proved(
        a in [amplitude(), amplitude(), amplitude(), amplitude()],
        k in [1..4_u8, 1..4_u8, 1..4_u8, 1..4_u8],
        lambda in 0.0..3.0_f64,
        value in 250..=1000_u64,
        angles in prop::collection::vec((0.0..3.2_f64, 0.0..3.2_f64), 8),
    ) {
        let compiled = compiled(&wave(a, k, lambda));
        let certificate = certify(&compiled);
        prop_assert_eq!(&certificate.finite, &Finite::Proved);
        let (jacobian, rates) = bounds(&certificate);
        let value = mms_codegen::expr::Rational::from_parts(value.into(), 1000_u64.into());
        let set = [(0, value)].into();
        let parameters = compiled.parameters::<Precise>(&set);
        for point in samples(&compiled, &parameters, 12) {
            let mut interpreter = Interpreter::new(&compiled.program, &parameters);
            interpreter.set_time(&point.time);
            let outputs = [Quantity::Jacobian, Quantity::DeformationGradient].map(Output::Quantity);
            let plan = interpreter.plan(&outputs);
            interpreter.set_point(&plan, Point::at(&point.coordinates));
            let [j, f] = outputs.map(|output| {
                interpreter.output(output).iter().map(Precise::to_f64).collect::<Vec<_>>()
            });
            prop_assert!(jacobian[0] <= j[0] && j[0] <= jacobian[1], "{} {jacobian:?}", j[0]);
            // The stretch of any direction, and the speed of any wave.
            let at: Vec<f64> = point.coordinates.iter().map(Precise::to_f64).collect();
            let tangent = tangent(&compiled, &at, &f);
            for (m, n) in &angles {
                let (m, n) = ([m.cos(), m.sin()], [n.cos(), n.sin()]);
                let stretched = [f[0] * n[0] + f[1] * n[1], f[2] * n[0] + f[3] * n[1]];
                let stretch = stretched[0].hypot(stretched[1]);
                prop_assert!(stretch <= rates.principal_stretch, "{stretch} {rates:?}");
                let mut modulus = 0.0;
                for (entry, component) in tangent.iter().enumerate() {
                    let (row, column) = (entry / 4, entry % 4);
                    let pair = m[row / 2] * n[row % 2] * m[column / 2] * n[column % 2];
                    modulus += component * pair;
                }
                let speed = (modulus.max(0.0) / (1.0 + at[0] / 4.0)).sqrt();
                prop_assert!(speed <= rates.reference_wave_speed, "{speed} {rates:?}");
            }
        }
    }
}

/// dP/dF at a point, in double precision.
fn tangent(compiled: &Compiled, at: &[f64], deformation: &[f64]) -> Vec<f64> {
    let output = Output::Response(Response::FirstPiolaKirchhoff);
    let parameters = [Dual::constant(0.5)];
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    let plan = interpreter.plan(&[output]);
    let at: Vec<_> = at.iter().copied().map(Dual::constant).collect();
    let mut tangent = vec![0.0; 16];
    for column in 0..4 {
        let gradient: Vec<_> = (0..4)
            .map(|k| Dual {
                value: deformation[k] - if k % 3 == 0 { 1.0 } else { 0.0 },
                slope: if k == column { 1.0 } else { 0.0 },
            })
            .collect();
        let point = Point { coordinates: &at, normal: &[], gradient: &gradient };
        interpreter.set_point(&plan, point);
        for (row, component) in interpreter.output(output).iter().enumerate() {
            tangent[row * 4 + column] = component.slope;
        }
    }
    tangent
}
