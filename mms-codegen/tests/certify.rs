//! Certificates: honest fields, fields with false claims (see `data/fail/refuted_*`), and random fields whose values must lie
//! within the proved bounds.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use mms_codegen::certify::certificate::{Certificate, certify, wave_speed};
use mms_codegen::certify::claims::ClaimVerdict;
use mms_codegen::certify::computed;
use mms_codegen::certify::ellipticity::Ellipticity;
use mms_codegen::certify::finite::Finite;
use mms_codegen::certify::rates::{Frame, Rates};
use mms_codegen::certify::sign::Sign;
use mms_codegen::{Compiled, Options, compile, compile_with};
use mms_mechanics::Output;
use mms_mechanics::Response;
use mms_mechanics::sample::{domain, samples};
use mms_program::dual::Dual;
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_spec::quantity::Quantity;
use mms_symbolic::sorted::SortedMap;
use proptest::prelude::*;

use crate::sampled::{all_is_tried, is_in_depth, sampled_count};

/// The largest mean number of boxes of a certificate: a box takes about 0.2 ms in two dimensions, and 1 ms in three.
const BOXES: usize = 1000;

/// The honest fields that are not proved to be strongly elliptic.
const UNPROVED: [&str; 6] = [
    "cyclic_shear_3d",
    "plane_strain_transversely_isotropic",
    "sliver_2d",
    "starting_cube_3d",
    "static_bulge_3d",
    "twisted_tube",
];

/// The largest number of cells of the proof about a program, for a field of the gallery.
const MOST_CELLS: usize = 250;

/// The fields of the gallery and some more correct ones, with their certificates.
static HONEST: LazyLock<Vec<(PathBuf, Compiled, Certificate)>> = LazyLock::new(|| {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = ["tests/data/certify", "../fields"].map(|folder| root.join(folder));
    let entries = folders.iter().flat_map(|folder| fs::read_dir(folder).expect("a folder"));
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|file| !file.starts_with(&folders[1]) || is_in_depth(file));
    files.sort();
    let certified = |file: PathBuf| {
        let compiled = compiled(&fs::read_to_string(&file).expect("a readable file"));
        let certificate = certify(&compiled);
        (file, compiled, certificate)
    };
    files.into_iter().map(certified).collect()
});

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
        (Sign::Positive(bounds), Some(rates)) => (*bounds, rates),
        other => panic!("{other:?}"),
    }
}

#[test]
fn honest_fields_are_proved_cheaply_and_sharply() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (mut boxes, mut unproved, mut gallery) = (0, Vec::new(), Vec::new());
    for (file, compiled, certificate) in &*HONEST {
        let shown = file.display();
        assert!(certificate.objections(compiled).is_empty(), "{shown}: {certificate:?}");
        assert_eq!(certificate.finite, Finite::Proved, "{shown}");
        assert!(!matches!(certificate.ellipticity, Ellipticity::Lost(_)), "{shown}");
        if certificate.ellipticity == Ellipticity::Unproved {
            unproved.push(file);
        }
        for (claim, finding) in &certificate.claims {
            assert_eq!(*finding, ClaimVerdict::Proved, "{shown}: {}", claim.face.value.name());
        }
        boxes += certificate.boxes;
        if file.starts_with(root.join("../fields")) {
            gallery.push(excess(compiled, &bounds(certificate).1));
        }
    }
    // Bounds of dP/dF are wide in three dimensions, and for fibres.
    unproved
        .retain(|file| !UNPROVED.iter().any(|name| file.file_stem().is_some_and(|it| it == *name)));
    assert!(unproved.is_empty(), "not proved to be strongly elliptic: {unproved:?}");
    assert!(boxes <= BOXES * HONEST.len(), "{boxes} boxes for {} fields", HONEST.len());
    for (rate, most) in EXCESS.into_iter().enumerate() {
        let logarithms = gallery.iter().map(|excess| excess[rate].ln()).sum::<f64>();
        let mean = (logarithms / gallery.len() as f64).exp();
        assert!(mean <= most, "rate {rate}: {mean} in the mean of {gallery:?}");
    }
}

#[test]
fn honest_fields_are_computed_in_both_precisions() {
    for (file, _, certificate) in &*HONEST {
        let shown = file.display();
        let [double, single] = &certificate.computed;
        assert_eq!(double.verdict, computed::ComputedVerdict::Proved, "{shown}");
        assert!(double.cells <= MOST_CELLS, "{shown}: {}", double.cells);
        // A J of 1e-6 is about as large as the rounding of f32.
        if !file.ends_with("sliver_2d.toml") {
            assert_eq!(single.verdict, computed::ComputedVerdict::Proved, "{shown}");
            assert!(single.cells <= MOST_CELLS, "{shown}: {}", single.cells);
        }
    }
}

/// The largest ratio of the bounds of stretch, strain rate and reference wave speed to the values attained on a grid, in the
/// geometric mean over the gallery: in four variables a search may end early.
const EXCESS: [f64; 3] = [1.06, 1.2, 1.2];

/// The ratio of each bound to the attained value; a body at rest has no strain rate.
fn excess(compiled: &Compiled, rates: &Rates) -> [f64; 3] {
    let bounds = [rates.principal_stretch, rates.strain_rate, rates.reference_wave_speed];
    let most = attained(compiled);
    [0, 1, 2].map(|rate| {
        let (bound, most) = (bounds[rate], most[rate]);
        assert!(
            most * (1.0 - 1e-12) <= bound,
            "{}: {bound} is less than {most}",
            compiled.field.title.shown()
        );
        if bound == 0.0 { 1.0 } else { bound / most }
    })
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

/// The bounds include the stretch around the axis, and the shear of the twist.
#[test]
fn bounds_of_an_axisymmetric_field_hold_all_around() {
    let (compiled, certificate) = of_file("solid_shaft.toml");
    let ([lower, upper], rates) = bounds(&certificate);
    let [stretch, rate, speed] = excess(&compiled, &rates);
    assert!(stretch < 1.05 && rate < 1.2 && speed < 1.2, "{stretch} {rate} {speed}");
    // On the axis F has the stretch 1 + 0.02 sin(2 Z) cos(100 t) twice, and turns.
    assert!(lower < 1.0 && upper > 1.02_f64.powi(2), "{lower} {upper}");
    assert!(rates.principal_stretch > 1.02, "{rates:?}");
}

/// A run bounds waves for its own parameters and its own time step, and no further.
#[test]
fn the_speed_of_waves_is_bounded_for_the_parameters_that_are_set() {
    let (compiled, certificate) = of_file("axis_aligned_1d.toml");
    let (_, rates) = bounds(&certificate);
    let speed = |set, frame, speed| wave_speed(&compiled, &set, frame, speed).expect("a bound");
    let defaults = SortedMap::new();
    let reference = speed(defaults.clone(), Frame::Reference, 0.0);
    assert!((reference / rates.reference_wave_speed - 1.0).abs() < 0.1, "{reference} {rates:?}");
    // F^2 dP/dF/rho0 = (lambda (1 - ln F) + mu (1 + F^2))/rho0 grows as F does, or falls, with lambda.
    let (lambda, mu) = (1e7 * 0.3 / (1.3 * 0.4), 1e7 / 2.6);
    let at = |f: f64| ((lambda * (1.0 - f.ln()) + mu * (1.0 + f * f)) / 1000.0).sqrt();
    let strain = 0.05 * std::f64::consts::PI;
    let fastest = at(1.0 - strain).max(at(1.0 + strain));
    let deformed = speed(defaults.clone(), Frame::Deformed, 0.0);
    assert!(fastest <= deformed && deformed < 1.1 * fastest, "{deformed} {fastest}");
    assert!(deformed <= rates.wave_speed * 1.1 && rates.wave_speed < 1.1 * fastest, "{rates:?}");
    // A bound that is enough is not sharpened; another one is.
    let coarse = speed(defaults, Frame::Reference, 2.0 * reference);
    assert!(reference <= coarse && coarse <= 2.0 * reference, "{coarse}");
    // Waves are ten times as fast in a body that is a hundred times as stiff.
    let young = compiled.model.parameters.iter().position(|it| it.name == "young").unwrap();
    let stiff = speed([(young, 1_000_000_000.into())].into(), Frame::Reference, 0.0);
    assert!((stiff / (10.0 * reference) - 1.0).abs() < 1e-6, "{stiff} {reference}");
}

#[test]
fn a_rotation_leaves_the_bounds_sharp() {
    // A vortex shears by gamma = R g h', which stretches by gamma/2 + sqrt(1 + gamma^2/4); h' is largest where 48 y^2 = 1 for
    // R = 1 + y.
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
    #![proptest_config(ProptestConfig { cases: sampled_count(8, 2) as u32, ..ProptestConfig::default() })]
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
        let value = mms_symbolic::expr::Rational::from_parts(value.into(), 1000_u64.into());
        let set = [(0, value)].into();
        let parameters = compiled.parameters::<Precise>(&set);
        let numbers: Vec<_> = parameters.iter().map(|x| Dual::constant(x.to_f64())).collect();
        let mut response = Interpreter::new(&compiled.program, &numbers);
        let mut motion = Interpreter::new(&compiled.program, &numbers);
        for point in samples(&compiled.program, &parameters, 12) {
            let mut interpreter = Interpreter::new(&compiled.program, &parameters);
            interpreter.set_time(&point.time);
            let outputs = [Quantity::Jacobian, Quantity::DeformationGradient].map(Output::Quantity);
            let plan = interpreter.plan(&outputs);
            interpreter.set_point(&plan, Point::at(&point.coordinates));
            let [j, f] = outputs.map(|output| {
                interpreter.output(output).iter().map(Precise::to_f64).collect::<Vec<_>>()
            });
            let x = Output::Quantity(Quantity::Position);
            let plan = interpreter.plan(&[x]);
            interpreter.set_point(&plan, Point::at(&point.coordinates));
            for (x, [least, most]) in interpreter.output(x).iter().zip(&certificate.reach) {
                let x = x.to_f64();
                prop_assert!(*least <= x && x <= *most, "{x} {least} {most}");
            }
            prop_assert!(jacobian[0] <= j[0] && j[0] <= jacobian[1], "{} {jacobian:?}", j[0]);
            // The stretch in any direction, and the speed of any wave.
            let at: Vec<_> =
                point.coordinates.iter().map(|x| Dual::constant(x.to_f64())).collect();
            let now = Dual::variable(point.time.to_f64());
            let (deformation, rate) = moving(&mut motion, &at, now);
            let rate = strain_rate(&deformation, &rate);
            prop_assert!(rate <= rates.strain_rate, "{rate} {rates:?}");
            let (tangent, density) = tangent(&mut response, &at, &f);
            for (m, n) in &angles {
                let (m, n) = ([m.cos(), m.sin()], [n.cos(), n.sin()]);
                let stretched = [f[0] * n[0] + f[1] * n[1], f[2] * n[0] + f[3] * n[1]];
                let stretch = stretched[0].hypot(stretched[1]);
                prop_assert!(stretch <= rates.principal_stretch, "{stretch} {rates:?}");
                let modulus = quadratic(&tangent, &m, &n);
                if let Ellipticity::Strong(least) = certificate.ellipticity {
                    prop_assert!(least > 0.0 && least <= modulus, "{modulus} {least}");
                }
                let speed = (modulus.max(0.0) / density).sqrt();
                prop_assert!(speed <= rates.reference_wave_speed, "{speed} {rates:?}");
                // n in the deformed body is F^T n in the reference configuration.
                let pulled = [f[0] * n[0] + f[2] * n[1], f[1] * n[0] + f[3] * n[1]];
                let speed = (quadratic(&tangent, &m, &pulled).max(0.0) / density).sqrt();
                prop_assert!(speed <= rates.wave_speed, "{speed} {rates:?}");
            }
        }
    }
}

type Matrix = [[f64; 3]; 3];

fn times(matrix: &Matrix, vector: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| (0..3).map(|k| row[k] * vector[k]).sum())
}

fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// The inverse, by cofactors.
fn inverse(matrix: &Matrix) -> Matrix {
    let cofactor = |i: usize, j: usize| {
        let at = |row: usize, column: usize| matrix[(i + row) % 3][(j + column) % 3];
        at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)
    };
    let determinant: f64 = (0..3).map(|j| matrix[0][j] * cofactor(0, j)).sum();
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| cofactor(j, i) / determinant))
}

/// |F n| for the n that power iteration converges to.
fn stretch(deformation: &Matrix) -> f64 {
    let transposed = [0, 1, 2].map(|i| [0, 1, 2].map(|j| deformation[j][i]));
    let mut direction = [0.6, 0.5, 0.4];
    for _ in 0..30 {
        direction = times(&transposed, times(deformation, direction));
        direction = direction.map(|entry| entry / length(direction));
    }
    length(times(deformation, direction))
}

/// |sym(dF/dt F^-1)|.
fn strain_rate(deformation: &Matrix, rate: &Matrix) -> f64 {
    let inverse = inverse(deformation);
    let entry = |i: usize, j: usize| (0..3).map(|k| rate[i][k] * inverse[k][j]).sum::<f64>();
    let pairs = (0..9).map(|k| (k / 3, k % 3));
    pairs.map(|(i, j)| ((entry(i, j) + entry(j, i)) / 2.0).powi(2)).sum::<f64>().sqrt()
}

/// The greatest m_i N_J A_iJkL m_k N_L that alternating updates of m and N find.
fn modulus(tangent: &[f64], dimension: usize) -> f64 {
    let size = dimension * dimension;
    let mut greatest = 0.0_f64;
    for (start, other) in (0..size).map(|k| (k / dimension, k % dimension)) {
        let unit = |at: usize| (0..dimension).map(|k| if k == at { 1.0 } else { 0.1 }).collect();
        let mut vectors: [Vec<f64>; 2] = [unit(start), unit(other)];
        for turn in 0..16 {
            let mut image = vec![0.0; dimension];
            for (at, entry) in tangent.iter().enumerate() {
                let [[i, j], [k, l]] =
                    [at / size, at % size].map(|pair| [pair / dimension, pair % dimension]);
                let [m, n] = &vectors;
                match turn % 2 {
                    0 => image[i] += entry * n[j] * m[k] * n[l],
                    _ => image[j] += entry * m[i] * m[k] * n[l],
                }
            }
            let size = image.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
            if size > 0.0 {
                vectors[turn % 2] = image.iter().map(|entry| entry / size).collect();
            }
        }
        greatest = greatest.max(quadratic(tangent, &vectors[0], &vectors[1]));
    }
    greatest
}

/// m_i N_J A_iJkL m_k N_L.
fn quadratic(tangent: &[f64], m: &[f64], n: &[f64]) -> f64 {
    let dimension = m.len();
    let size = dimension * dimension;
    let pair = |at: usize| m[at / dimension] * n[at % dimension];
    tangent.iter().enumerate().map(|(at, entry)| entry * pair(at / size) * pair(at % size)).sum()
}

/// F and dF/dt in space at a point and a time.
fn moving(
    interpreter: &mut Interpreter<'_, Dual<f64>, Output>,
    at: &[Dual<f64>],
    time: Dual<f64>,
) -> (Matrix, Matrix) {
    let output = Output::Quantity(Quantity::DeformationGradient);
    let plan = interpreter.plan(&[output]);
    interpreter.set_time(&time);
    interpreter.set_point(&plan, Point::at(at));
    let mut deformation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut rate = [[0.0; 3]; 3];
    let entries = interpreter.output(output);
    let rows = entries.len().isqrt();
    for (k, entry) in entries.iter().enumerate() {
        let (row, column) = (k / rows, k % rows);
        (deformation[row][column], rate[row][column]) = (entry.value, entry.slope);
    }
    (deformation, rate)
}

/// The greatest stretch, strain rate and wave speed on a grid over body and time window, in double
/// precision.
fn attained(compiled: &Compiled) -> [f64; 3] {
    let parameters = compiled.parameters::<f64>(&Default::default());
    let (extent, [from, to]) = domain(&compiled.program, &parameters);
    let variables = extent.dimension() + 1;
    let steps: usize = [0, 0, 33, 13, 7][variables];
    let constants: Vec<_> = parameters.iter().copied().map(Dual::constant).collect();
    let mut motion = Interpreter::new(&compiled.program, &constants);
    let mut response = Interpreter::new(&compiled.program, &constants);
    let dimension = compiled.field.space.rows();
    let mut greatest = [0.0_f64; 3];
    for point in 0..steps.pow(variables as u32) {
        let fraction = |axis: u32| (point / steps.pow(axis) % steps) as f64 / (steps - 1) as f64;
        let fractions: Vec<f64> = (0..variables as u32).map(fraction).collect();
        let at: Vec<_> = extent.point(&fractions).into_iter().map(Dual::constant).collect();
        let time = Dual::variable(from + (to - from) * fractions[variables - 1]);
        let (deformation, rate) = moving(&mut motion, &at, time);
        let entries = deformation[..dimension].iter().flat_map(|row| &row[..dimension]);
        let entries: Vec<f64> = entries.copied().collect();
        let (tangent, density) = tangent(&mut response, &at, &entries);
        let speed = (modulus(&tangent, dimension) / density).sqrt();
        let here = [stretch(&deformation), strain_rate(&deformation, &rate), speed];
        greatest = [0, 1, 2].map(|k| greatest[k].max(here[k]));
    }
    greatest
}

/// dP/dF and rho0 at a point, in double precision.
fn tangent(
    interpreter: &mut Interpreter<'_, Dual<f64>, Output>,
    at: &[Dual<f64>],
    deformation: &[f64],
) -> (Vec<f64>, f64) {
    let outputs = [Response::FirstPiolaKirchhoff, Response::Density].map(Output::Response);
    let plan = interpreter.plan(&outputs);
    let (size, order) = (deformation.len(), deformation.len().isqrt());
    let mut tangent = vec![0.0; size * size];
    for column in 0..size {
        let gradient: Vec<_> = (0..size)
            .map(|k| Dual {
                value: deformation[k] - if k % (order + 1) == 0 { 1.0 } else { 0.0 },
                slope: if k == column { 1.0 } else { 0.0 },
            })
            .collect();
        interpreter.set_point(&plan, Point { coordinates: at, normal: &[], gradient: &gradient });
        for (row, component) in interpreter.output(outputs[0]).iter().enumerate() {
            tangent[row * size + column] = component.slope;
        }
    }
    (tangent, interpreter.output(outputs[1])[0].value)
}

/// A field that needs a larger graph is refused: omitted expressions are not 0, and prove nothing.
#[test]
fn a_graph_that_is_full_proves_nothing() {
    let text = |end: &str| {
        format!(
            "[field]\ntitle = \"x\"\ndimension = 1\n[let]\nw = \"sin(pi*X) + X*cos(X){end}\"\n\
             [displacement]\nu = [\"w*cos(pi*t)/20\"]\n[material]\nmodel = \"neo_hookean\"\nlambda = 0\n\
             mu = 1\ndensity = 1\n[domain]\nshape = \"box\"\nlower = [0]\nupper = [1]\ntime = [0, 2]\n\
             [boundary]\nx_min = \"fixed\"\nx_max = \"fixed\"\n"
        )
    };
    let judged = |text: &str, max_nodes: usize| {
        let options = Options { max_nodes, ..Options::default() };
        let load = |_: &str| Err("no files here".to_string());
        let compiled = compile_with("x", "x.toml", text, &load, &options);
        compiled.map(|compiled| certify(&compiled)).map_err(|failure| failure.to_string())
    };
    let (liar, honest) = (text(""), text(" - X*cos(1)"));
    let whole = judged(&honest, 100_000).expect("an ample graph");
    let [mut full, mut proved] = [0; 2];
    let step = if all_is_tried() { 100 } else { 300 };
    for max_nodes in (100..6000).step_by(step) {
        let refusal = judged(&liar, max_nodes).expect_err("x_max moves");
        assert!(refusal.contains("too large") || refusal.contains("no `fixed` face"), "{refusal}");
        match judged(&honest, max_nodes) {
            Ok(certificate) => {
                let proofs =
                    certificate.claims.iter().all(|(_, finding)| *finding == ClaimVerdict::Proved);
                assert!(proofs, "{max_nodes}: {certificate:?}");
                assert_eq!(certificate.jacobian, whole.jacobian);
                proved += 1;
            }
            Err(refusal) => {
                assert!(refusal.contains("too large"), "{max_nodes}: {refusal}");
                full += 1;
            }
        }
    }
    assert!(full > 3 && proved > 3, "{full} {proved}");
}
