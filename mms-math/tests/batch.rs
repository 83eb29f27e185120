//! Functions at many points.

use mms_math::Real;
use mms_math::batch::{Function, Kernel, Points, Stand, run};

/// 1/x.
struct Inverse;

impl<S: Real> Function<S, 1, 1> for Inverse {
    #[inline(always)]
    fn at(&self, [x]: [S; 1]) -> [S; 1] {
        [S::from_f64(1.0) / x]
    }
}

impl Kernel<f64, 1, 1> for Inverse {
    #[inline(always)]
    fn drive<S: Stand<f64>>(&self, points: &mut impl Points<S, 1, 1>) {
        points.each(self);
    }
}

#[test]
fn infinities_and_what_is_not_a_number_are_written_as_they_are() {
    for count in [1, 64, 100, 128, 130] {
        let mut points: Vec<f64> = (1..=count).map(|k| 0.7 * k as f64).collect();
        points[count / 2] = 0.0;
        points[count / 3] = -0.0;
        points[count - 1] = f64::NAN;
        let mut found = vec![0.0; count];
        run(&Inverse, &[&points[..]], &mut [&mut found[..]]);
        for (found, point) in found.iter().zip(&points) {
            assert_eq!(found.to_bits(), (1.0 / point).to_bits(), "1/{point} of {count}");
        }
    }
}
