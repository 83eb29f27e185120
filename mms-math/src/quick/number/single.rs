//! The constants of `f32`.

use core::num::Wrapping;

use super::{Float, Polynomials};
use crate::lane::Lane;
use crate::quick::power;

impl Float for f32 {
    format!(f32, u32, digits: 24, cbrt_shift: 9);

    const LN_2: [Self; 2] = [0.693_145_75, 1.428_606_8e-6];
    const PI: [Self; 2] = [core::f32::consts::PI, -8.742278e-8];
    const LARGEST_ANGLE: Self = 131072.0;
    const LARGEST_EXPONENT: Self = 87.6;
    const LARGEST_TANH: Self = 10.0;
    const CBRT_OFFSET: Self = 2773248.0;
    const POLYNOMIALS: Polynomials<Self> = Polynomials {
        // Minimax on [0, 1/16], relative error 4.1e-9.
        sin_pi: &[-5.167709, 2.5497947, -0.5892762],
        // Minimax on [0, 1/16], relative error 4.4e-10.
        cos_pi: &[-4.934802, 4.0586967, -1.334758, 0.22897787],
        // Minimax on [0, (pi/4)^2], relative error 4.0e-9.
        sin: &[-0.16666655, 0.008332189, -0.0001951829],
        // Minimax on [0, (pi/4)^2], relative error 1.2e-10.
        cos: &[0.041666646, -0.001388731, 2.4432326e-05],
        // Minimax on [0, (pi/2)^2], relative error 6.2e-9.
        sin_near_zero: &[-0.1666666, 0.008333069, -0.00019809777, 2.606097e-06],
        // Minimax on [0, (pi/2)^2], absolute error 4.4e-10.
        cos_near_zero: &[0.041666657, -0.0013888585, 2.477018e-05, -2.6209028e-07],
        // Minimax on [0, 1.0625^2], relative error 1.1e-10.
        sin_within_one: &[-0.16666666, 0.008333309, -0.00019834696, 2.6869745e-06],
        // Minimax on [0, 1.0625^2], absolute error 1.9e-9.
        cos_within_one: &[0.041666545, -0.0013883833, 2.4140885e-05],
        // Minimax on [-0.347, 0.347], relative error 3.3e-9.
        exp: &[0.49999994, 0.16666515, 0.041668084, 0.008369379, 0.0013841015],
        // Minimax on [0, 0.347^2], relative error 4.7e-11.
        sinh: &[0.16666667, 0.008333175, 0.00019974101],
        // Minimax on [0, 0.347^2], relative error 9.7e-11.
        cosh: &[0.5, 0.04166646, 0.0013935453],
        // Minimax on [0, 0.1716^2], relative error 8.1e-10.
        ln: &[0.66666776, 0.3997758, 0.2987092],
        // Minimax on [0, 1], relative error 9.2e-9.
        atan: &[
            -0.333333,
            0.1999853,
            -0.1426402,
            0.10950955,
            -0.0839973,
            0.057893336,
            -0.031114845,
            0.010882232,
            -0.0017869236,
        ],
        // Minimax on [0, 1/4], relative error 4.9e-9.
        asin: &[0.16666752, 0.0749531, 0.04546902, 0.024185441, 0.04215731],
        // Minimax on [-0.1038, 0.1026], relative error 4.8e-5.
        inverse_cbrt: &[0.99999833, 0.33472207, 0.22354236],
    };

    #[inline(always)]
    fn quarter_turns_off<const FUSED: bool>(
        x: Lane<Self, FUSED>,
        n: Lane<Self, FUSED>,
    ) -> [Lane<Self, FUSED>; 2] {
        if FUSED {
            let part = |index: usize| {
                Lane([core::f32::consts::FRAC_PI_2, -4.371139e-8, -1.715_124_5e-15][index])
            };
            let coarse = n.times_from(part(0), x);
            let (product, rest) = n.product(part(1));
            let (near, lost) = coarse.sum(-product);
            [near, n.times_from(part(2), lost - rest)]
        } else {
            // Without the fused product six parts would be needed, more than twice the work.
            let parts = [1.5707963267341256, 6.077100506506192e-11];
            let [a, b] = parts.map(|part: f64| f64::from(n.0) * part);
            let reduced = (f64::from(x.0) - a) - b;
            let near = reduced as f32;
            [Lane(near), Lane((reduced - f64::from(near)) as f32)]
        }
    }

    #[inline(always)]
    fn powf<const FUSED: bool>(x: Lane<Self, FUSED>, y: Lane<Self, FUSED>) -> Lane<Self, FUSED> {
        power::of_single(x, y)
    }
}
