//! Interpreted fields have the bits of compiled code.

use std::fmt::Debug;
use std::sync::Arc;

use mms_exact::gallery::{Entry, FIELDS};
use mms_interpreted::{Interpretable, scene};
use mms_mechanics::sample::samples;
use mms_runtime::axisymmetric::{hoop_strain, kirchhoff_stress, strain_energy};
use mms_runtime::column::PACK;
use mms_runtime::column::{Matrices, Pack as _};
use mms_runtime::scene::{Code, Scene};
use mms_runtime::{ManufacturedField, Matrix, Real, Vector};
use mms_symbolic::sorted::SortedMap;

use crate::sampled::sampled;

/// Less than one block, exactly one, and more, in either precision.
const COUNTS: [usize; 5] = [1, 9, 64, 70, 260];

/// Compares to the bit: the shortest text that reads back as a number is unique to it.
fn same<V: Debug>(what: &str, compiled: &[V], interpreted: &[V]) {
    for (point, (compiled, interpreted)) in compiled.iter().zip(interpreted).enumerate() {
        let [compiled, interpreted] = [compiled, interpreted].map(|it| format!("{it:?}"));
        assert_eq!(compiled, interpreted, "{what}, point {point}");
    }
}

type Field<T, const D: usize> = dyn ManufacturedField<T, D>;
type Evaluate<'a, T, const D: usize> = dyn Fn(&Field<T, D>, &mut [Matrix<T, D>]) + 'a;
type Build<T> = fn(&[T]) -> Option<Scene<T>>;

/// A displacement gradient of some strain at a point.
fn gradient<T: Real, const D: usize>(point: &Vector<T, D>) -> Matrix<T, D> {
    Matrix::from_fn(|i, j| T::of(0.1) * (point[i] - T::of(0.3) * point[j]) + T::of(0.05))
}

fn agree<T: Real, const D: usize>(
    name: &str,
    [compiled, interpreted]: [&Field<T, D>; 2],
    time: T,
    points: &[Vector<T, D>],
) {
    let what = |quantity: &str| format!("{quantity} of {name} at {} points", points.len());
    let [zero, none] = [Vector::<T, D>::zeros(); 2].map(|it| vec![it; points.len()]);
    for (quantity, evaluate) in [
        ("u", Field::<T, D>::displacement as fn(&Field<T, D>, T, &[_], &mut [_])),
        ("v", Field::<T, D>::velocity),
        ("a", Field::<T, D>::acceleration),
        ("b", Field::<T, D>::body_force),
    ] {
        let [mut first, mut second] = [zero.clone(), none.clone()];
        evaluate(compiled, time, points, &mut first);
        evaluate(interpreted, time, points, &mut second);
        same(&what(quantity), &first, &second);
    }
    let both = |evaluate: &Evaluate<'_, T, D>| {
        [compiled, interpreted].map(|field| {
            let mut found = vec![Matrix::zeros(); points.len()];
            evaluate(field, &mut found);
            found
        })
    };
    let [first, second] = both(&|field, out| field.displacement_gradient(time, points, out));
    same(&what("H"), &first, &second);
    let gradients: Vec<_> = points.iter().map(gradient).collect();
    let [first, second] = both(&|field, out| field.kirchhoff_stress(time, points, &gradients, out));
    same(&what("tau"), &first, &second);
    let scalars = |evaluate: &dyn Fn(&Field<T, D>, &mut [T])| {
        [compiled, interpreted].map(|field| {
            let mut found = vec![T::zero(); points.len()];
            evaluate(field, &mut found);
            found
        })
    };
    let [first, second] = scalars(&|field, out| field.density(points, out));
    same(&what("rho0"), &first, &second);
    let [first, second] = scalars(&|field, out| field.wave_speed(points, out));
    same(&what("c0"), &first, &second);
    let [first, second] =
        scalars(&|field, out| assert!(field.strain_energy(time, points, &gradients, out)));
    same(&what("W"), &first, &second);
    stress_of_packs(&what("tau of packs"), [compiled, interpreted], time, points);
    axisymmetric(
        &what("hoop strains, stresses and energies"),
        [compiled, interpreted],
        time,
        points,
    );
}

/// The hoop strains of axisymmetric fields, and their materials at other strains.
fn axisymmetric<T: Real, const D: usize>(
    what: &str,
    fields: [&Field<T, D>; 2],
    time: T,
    points: &[Vector<T, D>],
) {
    let [own, found] = [0, 1].map(|k| {
        let field = fields[k];
        let own = hoop_strain(field, time, points);
        let strains: Vec<T> = own.iter().map(|&h| h + T::of(0.02)).collect();
        let gradients: Vec<_> = points.iter().map(gradient).collect();
        let mut stress = vec![Matrix::zeros(); points.len()];
        let mut hoop_stress = strains.clone();
        let stresses = (&mut stress[..], &mut hoop_stress[..]);
        kirchhoff_stress(field, time, points, (&gradients, &strains), stresses);
        let mut energy = vec![T::zero(); points.len()];
        assert!(strain_energy(field, time, points, (&gradients, &strains), &mut energy));
        (own, stress, hoop_stress, energy)
    });
    same(what, &[own], &[found]);
}

fn stress_of_packs<T: Real, const D: usize>(
    what: &str,
    fields: [&Field<T, D>; 2],
    time: T,
    points: &[Vector<T, D>],
) {
    let packs = points.as_chunks::<PACK>().0;
    let of_pack = |pack: &[Vector<T, D>; PACK]| {
        let mut gradients = Matrices::zeros();
        pack.iter().enumerate().for_each(|(k, point)| gradients.set(k, &gradient(point)));
        gradients
    };
    let gradients: Vec<_> = packs.iter().map(of_pack).collect();
    let [first, second] = fields.map(|field| {
        let mut stress = vec![Matrices::zeros(); packs.len()];
        field.kirchhoff_stress_of_packs(time, packs, &gradients, &mut stress);
        stress
    });
    same(what, &first, &second);
}

fn hold<T: Interpretable>(entry: &Entry, of: fn(&Code) -> Build<T>) {
    let code = mms_gallery::find(entry.name).expect("the field is compiled");
    let compiled = Arc::new(entry.compile().expect("a field of the gallery"));
    let parameters = compiled.parameters::<T>(&SortedMap::new());
    let all = samples(&compiled.program, &parameters, COUNTS[COUNTS.len() - 1]);
    let time = all[0].time;
    let interpreted = scene::<T>(compiled, &SortedMap::new()).expect("a field without a swirl");
    let Some(compiled) = of(&code)(&parameters) else { panic!("as many parameters") };
    macro_rules! dimension {
        ($compiled:expr, $interpreted:expr) => {{
            assert_eq!($compiled.domain(), $interpreted.domain());
            for count in COUNTS {
                let points =
                    all[..count].iter().map(|it| Vector::from_column_slice(&it.coordinates));
                let points: Vec<_> = points.collect();
                agree(entry.name, [&**$compiled, &**$interpreted], time, &points);
            }
        }};
    }
    match (&compiled, &interpreted) {
        (Scene::Line(compiled), Scene::Line(interpreted)) => dimension!(compiled, interpreted),
        (Scene::Plane(compiled), Scene::Plane(interpreted)) => dimension!(compiled, interpreted),
        (Scene::Space(compiled), Scene::Space(interpreted)) => dimension!(compiled, interpreted),
        _ => panic!("{} has two dimensions", entry.name),
    }
}

/// One field in `SHARE` is tried.
const SHARE: usize = 4;

/// All values that a solver requests from compiled fields, in both precisions.
#[test]
fn interpreted_fields_have_the_bits_of_compiled_ones() {
    for entry in sampled(FIELDS, SHARE) {
        hold::<f64>(entry, |code| code.double);
        hold::<f32>(entry, |code| code.single);
    }
}
