//! Evaluation at many points: the values are the same as one by one, at any place in a batch, in any storage, and where the
//! quick functions do not apply.

use mms_gallery::{
    axis_aligned_3d, bar_1d, cyclic_shear_3d, generalized_vortex, quiet_boundary_2d, twisted_column,
};
use mms_runtime::math::batch::Blocked;

// With numbers for its parameters, its angle is proved to be at most 1.
mms_macros::field!(
    "fields/generalized_vortex.toml",
    freeze = [middle, half_width, young, rho0, angle],
    quantities = [displacement, body_force],
    name = frozen_vortex
);

/// The number of double-precision values in a block.
const BLOCK: usize = f64::BLOCK;

/// Counts around a whole number of blocks, so that the last block is full, short, or absent.
fn counts<T: Blocked>() -> [usize; 7] {
    [0, 1, 7, T::BLOCK - 1, T::BLOCK, T::BLOCK + 1, 3 * T::BLOCK + 5]
}

/// Numbers spread evenly over an interval, by the fractional parts of multiples of an irrational
/// number.
fn spread(count: usize, step: f64, [from, to]: [f64; 2]) -> Vec<f64> {
    (1..=count).map(|index| from + (to - from) * (index as f64 * step).fract()).collect()
}

/// The largest difference in eps of the largest value.
fn distance<T: Copy + Into<f64>>(found: &[Vec<T>], expected: &[Vec<T>], eps: f64) -> f64 {
    let pairs = || found.iter().flatten().zip(expected.iter().flatten());
    let scale = pairs().map(|(_, expected)| (*expected).into().abs()).fold(0.0, f64::max);
    let error = pairs().map(|(a, b)| ((*a).into() - (*b).into()).abs()).fold(0.0, f64::max);
    assert!(!error.is_nan());
    if error == 0.0 { 0.0 } else { error / scale / eps }
}

/// Compares the three ways to evaluate a quantity at many points with the evaluation at one point.
macro_rules! agree {
    ($module:ident, $float:ident, $count:expr, $columns:expr, $time:expr, $(
        $quantity:ident $batch:ident $aos:ident $cached:ident
        |$result:ident| $flat:expr, $components:literal;
    )*) => {{
        let field = $module::prepare(&$module::Parameters::<$float>::default());
        let columns: Vec<Vec<$float>> = $columns
            .iter()
            .map(|column| column.iter().map(|value| *value as $float).collect())
            .collect();
        let slices = core::array::from_fn(|axis| &columns[axis][..]);
        let point = |index: usize| core::array::from_fn(|axis| columns[axis][index]);
        let points: Vec<_> = (0..$count).map(point).collect();
        let kept = field.at_points(slices);
        assert_eq!((kept.len(), kept.is_empty()), ($count, $count == 0));
        let at = field.at_time($time as $float);
        $({
            let mut expected = vec![Vec::new(); $components];
            for point in &points {
                let $result = at.$quantity(*point);
                for (column, value) in expected.iter_mut().zip($flat) {
                    column.push(value);
                }
            }
            let zero: [Vec<$float>; $components] = core::array::from_fn(|_| vec![0.0; $count]);
            let [mut whole, mut cached] = [zero.clone(), zero];
            at.$batch(slices, whole.each_mut().map(|column| &mut column[..]));
            at.$cached(&kept, cached.each_mut().map(|column| &mut column[..]));
            let mut rows = vec![[0.0; $components]; $count];
            at.$aos(&points, &mut rows);
            for (index, row) in rows.iter().enumerate() {
                let column = whole.each_ref().map(|column| column[index]);
                assert_eq!(row.map(<$float>::to_bits), column.map(<$float>::to_bits));
                // A point alone has the same bits as in a batch.
                let mut alone = [[0.0; $components]];
                at.$aos(&points[index..=index], &mut alone);
                assert_eq!(alone[0].map(<$float>::to_bits), column.map(<$float>::to_bits));
            }
            let eps = f64::from(<$float>::EPSILON);
            for found in [&whole, &cached] {
                let eps = distance(found, &expected, eps);
                assert!(eps <= 16.0, "{} of {}: {eps} eps", stringify!($quantity), stringify!($module));
            }
        })*
    }};
}

macro_rules! in_both_precisions {
    ($module:ident, $columns:expr, $time:expr, $($rest:tt)*) => {
        for count in counts::<f64>() {
            agree!($module, f64, count, $columns(count), $time, $($rest)*);
        }
        for count in counts::<f32>() {
            agree!($module, f32, count, $columns(count), $time, $($rest)*);
        }
    };
}

#[test]
fn many_points_of_a_bar() {
    in_both_precisions!(bar_1d, |count| [spread(count, 0.618, [0.0, 1.0])], 0.0123,
        displacement displacement_batch displacement_batch_aos displacement_batch_at |u| u, 1;
        jacobian jacobian_batch jacobian_batch_aos jacobian_batch_at |j| [j], 1;
        body_force body_force_batch body_force_batch_aos body_force_batch_at |b| b, 1;
    );
}

#[test]
fn many_points_of_waves() {
    let place = |count| [0.819, 0.671, 0.549].map(|step| spread(count, step, [0.0, 1.0]));
    in_both_precisions!(axis_aligned_3d, place, 0.017,
        velocity velocity_batch velocity_batch_aos velocity_batch_at |v| v, 3;
        first_piola_kirchhoff first_piola_kirchhoff_batch first_piola_kirchhoff_batch_aos
            first_piola_kirchhoff_batch_at |p| p.into_iter().flatten(), 9;
        body_force body_force_batch body_force_batch_aos body_force_batch_at |b| b, 3;
    );
}

/// Points of a ring.
fn ring(count: usize) -> [Vec<f64>; 2] {
    let (radius, angle) = (spread(count, 0.754, [0.76, 1.24]), spread(count, 0.569, [0.0, 6.0]));
    [f64::cos, f64::sin].map(|f| radius.iter().zip(&angle).map(|(r, a)| r * f(*a)).collect())
}

#[test]
fn many_points_of_a_vortex() {
    in_both_precisions!(frozen_vortex, ring, 0.35,
        displacement displacement_batch displacement_batch_aos displacement_batch_at |u| u, 2;
    );
    in_both_precisions!(generalized_vortex, ring, 0.35,
        displacement displacement_batch displacement_batch_aos displacement_batch_at |u| u, 2;
        cauchy_stress cauchy_stress_batch cauchy_stress_batch_aos cauchy_stress_batch_at
            |sigma| sigma.into_iter().flatten(), 4;
        body_force body_force_batch body_force_batch_aos body_force_batch_at |b| b, 2;
    );
}

#[test]
fn many_points_of_a_twist() {
    let place = |count| [0.819, 0.671, 0.549].map(|step| spread(count, step, [0.1, 0.9]));
    in_both_precisions!(twisted_column, place, 0.01,
        strain_energy strain_energy_batch strain_energy_batch_aos strain_energy_batch_at |w| [w], 1;
        body_force body_force_batch body_force_batch_aos body_force_batch_at |b| b, 3;
    );
}

/// Many values that depend on X are sums and products of few, which are computed anew at every time.
#[test]
fn many_points_of_polynomials() {
    let plane = |count| [0.819, 0.671].map(|step| spread(count, step, [0.0, 1.0]));
    in_both_precisions!(quiet_boundary_2d, plane, 0.01,
        displacement_gradient displacement_gradient_batch displacement_gradient_batch_aos
            displacement_gradient_batch_at |h| h.into_iter().flatten(), 4;
        body_force body_force_batch body_force_batch_aos body_force_batch_at |b| b, 2;
    );
    let space = |count| [0.819, 0.671, 0.549].map(|step| spread(count, step, [0.0, 1.0]));
    in_both_precisions!(cyclic_shear_3d, space, 0.01,
        body_force body_force_batch body_force_batch_aos body_force_batch_at |b| b, 3;
    );
}

/// Values that take a few sums and products of the others are computed and not stored.
#[test]
fn few_numbers_are_kept_of_many_points() {
    assert_eq!(quiet_boundary_2d::Point::<f64>::BYTES, 8 * 76);
    assert_eq!(quiet_boundary_2d::Points::<f64>::BYTES, 8 * 31);
    // X, Y, (R - 1)^2, h and one number more.
    assert_eq!(frozen_vortex::Points::<f64>::BYTES, 8 * 5);
}

#[test]
fn tractions_take_a_normal_at_every_point() {
    let field = axis_aligned_3d::prepare(&axis_aligned_3d::Parameters::<f64>::default());
    let at = field.at_time(0.017);
    let count = BLOCK + 3;
    let columns = [0.819, 0.671, 0.549].map(|step| spread(count, step, [0.0, 1.0]));
    let normals = [0.234, 0.876, 0.345].map(|step| spread(count, step, [-1.0, 1.0]));
    let rows = |columns: &[Vec<f64>; 3]| -> Vec<[f64; 3]> {
        (0..count).map(|index| columns.each_ref().map(|column| column[index])).collect()
    };
    let (points, directions) = (rows(&columns), rows(&normals));
    let slices = |columns: &'static [Vec<f64>; 3]| columns.each_ref().map(|column| &column[..]);
    let (columns, normals) = (Box::leak(Box::new(columns)), Box::leak(Box::new(normals)));
    let mut whole: [Vec<f64>; 3] = core::array::from_fn(|_| vec![0.0; count]);
    let mut cached = whole.clone();
    let kept = field.at_points(slices(columns));
    at.traction_batch(slices(columns), slices(normals), whole.each_mut().map(|c| &mut c[..]));
    at.traction_batch_at(&kept, slices(normals), cached.each_mut().map(|c| &mut c[..]));
    let mut beside = vec![[0.0; 3]; count];
    at.traction_batch_aos(&points, &directions, &mut beside);
    assert_eq!(beside, rows(&whole));
    let expected: [Vec<f64>; 3] = core::array::from_fn(|row| {
        let pairs = points.iter().zip(&directions);
        pairs.map(|(point, normal)| at.traction(*point, *normal)[row]).collect()
    });
    assert!(distance(&whole, &expected, f64::EPSILON) <= 16.0);
    assert!(distance(&cached, &expected, f64::EPSILON) <= 16.0);
}

/// An angle of 1e9 is beyond the range of the quick sine. Its block is computed again, one by one.
#[test]
fn where_the_quick_functions_do_not_know_the_careful_ones_do() {
    let field = axis_aligned_3d::prepare(&axis_aligned_3d::Parameters::<f64>::default());
    let at = field.at_time(0.017);
    let mut points = vec![[0.25, 0.5, 0.75]; 2 * BLOCK];
    points[5] = [1e17 / 3.0, 1e200, 0.1];
    let mut out = vec![[0.0; 3]; points.len()];
    at.body_force_batch_aos(&points, &mut out);
    let careful = at.body_force(points[5]);
    assert!(careful.iter().all(|component| component.is_finite()));
    assert_eq!(out[5], careful);
    assert_eq!(out[6], at.body_force(points[6]));
}

/// An angle that is proved to be small is not reduced, and is as exact. Outside of the range of the proof, the careful
/// functions are used.
#[test]
fn an_angle_that_is_proved_small_may_be_large_elsewhere() {
    let frozen = frozen_vortex::prepare::<f64>(&frozen_vortex::Parameters::default());
    let free = generalized_vortex::prepare(&generalized_vortex::Parameters::<f64>::default());
    let (frozen, free) = (frozen.at_time(0.35), free.at_time(0.35));
    let mut points: Vec<_> = {
        let [x, y] = ring(3 * BLOCK);
        x.into_iter().zip(y).map(|(x, y)| [x, y]).collect()
    };
    // The first and the last block have points that turn by 8 rad and by 67.
    points[5] = [1.2, -0.9];
    points[2 * BLOCK + 9] = [0.1, 0.2];
    let mut rows = [vec![[0.0; 2]; points.len()], vec![[0.0; 2]; points.len()]];
    let [displacement, force] = &mut rows;
    frozen.displacement_batch_aos(&points, displacement);
    frozen.body_force_batch_aos(&points, force);
    for (index, point) in points.iter().enumerate() {
        for (found, expected) in [
            (displacement[index], free.displacement(*point)),
            (force[index], free.body_force(*point)),
        ] {
            let size = expected[0].hypot(expected[1]);
            for (found, expected) in found.iter().zip(expected) {
                let error = (found - expected).abs();
                assert!(error <= 1e-13 * size, "{point:?}: {found}, {expected}");
            }
        }
    }
}

/// An undefined value is NaN: J < 0 has no logarithm.
#[test]
fn what_is_undefined_is_not_a_number_in_a_batch_too() {
    let parameters = bar_1d::Parameters { amplitude: -2.0, ..bar_1d::Parameters::<f64>::default() };
    let field = bar_1d::prepare(&parameters);
    let at = field.at_time(0.0);
    let mut energy = [[0.0]; 2];
    at.strain_energy_batch_aos(&[[0.0], [0.9]], &mut energy);
    assert!(at.strain_energy([0.0]).is_nan() && energy[0][0].is_nan());
    assert_eq!(energy[1][0], at.strain_energy([0.9]));
}

#[test]
#[should_panic(expected = "the slices of a batch have different lengths")]
fn slices_of_different_lengths_are_refused() {
    let field = generalized_vortex::prepare(&generalized_vortex::Parameters::<f64>::default());
    let [mut first, mut second] = [[0.0; 3]; 2];
    field.at_time(0.1).body_force_batch([&[1.0; 3], &[0.0; 2]], [&mut first, &mut second]);
}

#[test]
#[should_panic(expected = "a batch has 3 points, and other room for its results")]
fn too_little_room_is_refused() {
    let field = bar_1d::prepare(&bar_1d::Parameters::<f64>::default());
    field.at_time(0.1).body_force_batch([&[0.5; 3]], [&mut [0.0; 2]]);
}
