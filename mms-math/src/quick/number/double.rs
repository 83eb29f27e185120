//! The constants of `f64`.

use core::num::Wrapping;

use super::{Float, Polynomials};
use crate::lane::Lane;
use crate::quick::power;

impl Float for f64 {
    format!(f64, u64, digits: 53, cbrt_shift: 32);

    const LN_2: [Self; 2] = [0.6931471805601177, -1.7239444525614835e-13];
    const PI: [Self; 2] = [core::f64::consts::PI, 1.2246467991473532e-16];
    const LARGEST_ANGLE: Self = 1048576.0;
    const LARGEST_EXPONENT: Self = 708.7;
    const LARGEST_TANH: Self = 22.0;
    const CBRT_OFFSET: Self = 1430186664.0;
    const INVERSE_ROOT: Self::Bits = Wrapping(0x5fe6_eb50_c7b5_37a9);
    const INVERSE_ROOT_SERIES: &'static [Self] = &[0.5, 0.375, 0.3125];
    const POLYNOMIALS: Polynomials<Self> = Polynomials {
        // Minimax on [0, 1/16], relative error 4.1e-18.
        sin_pi: &[
            -5.167712780049959,
            2.550164039873868,
            -0.5992645289642736,
            0.08214586977820784,
            -0.007370028519394825,
            0.0004615624295959488,
        ],
        // Minimax on [0, 1/16], relative error 3.2e-19.
        cos_pi: &[
            -4.934802200544679,
            4.058712126416667,
            -1.3352627688435832,
            0.2353306297940516,
            -0.02580687611329812,
            0.0019293529903058294,
            -0.00010304646075395997,
        ],
        // Minimax on [0, (pi/4)^2], relative error 4.2e-18.
        sin: &[
            -0.1666666666666663,
            0.00833333333332184,
            -0.00019841269829359376,
            2.7557313539151503e-06,
            -2.505073454169314e-08,
            1.5895447585335016e-10,
        ],
        // Minimax on [0, (pi/4)^2], relative error 5.7e-20.
        cos: &[
            0.041666666666666595,
            -0.0013888888888873342,
            2.480158728900169e-05,
            -2.7557314216776206e-07,
            2.08757053399596e-09,
            -1.1358745390447269e-11,
        ],
        // Minimax on [0, (pi/2)^2], relative error 3.3e-19.
        sin_near_zero: &[
            -0.16666666666666666,
            0.008333333333333207,
            -0.00019841269841212473,
            2.755731921156715e-06,
            -2.5052106904060885e-08,
            1.6058940976165527e-10,
            -7.643018493423056e-13,
            2.7214085113391344e-15,
        ],
        // Minimax on [0, (pi/2)^2], absolute error 7.6e-18.
        cos_near_zero: &[
            0.04166666666666583,
            -0.0013888888888829974,
            2.4801587285768033e-05,
            -2.7557317066877284e-07,
            2.087659250282019e-09,
            -1.1463632914691802e-11,
            4.6161067931511184e-14,
        ],
        // Minimax on [-0.347, 0.347], relative error 4.1e-18.
        exp: &[
            0.5000000000000011,
            0.16666666666666433,
            0.04166666666652561,
            0.00833333333347736,
            0.0013888888944950273,
            0.00019841269552460834,
            2.4801491616865667e-05,
            2.755753780573046e-06,
            2.763081429860228e-07,
            2.5017731311021356e-08,
        ],
        // Minimax on [0, 0.347^2], relative error 2.7e-19.
        sinh: &[
            0.16666666666666677,
            0.00833333333332138,
            0.00019841269886843803,
            2.7557243422033795e-06,
            2.5109328381746383e-08,
        ],
        // Minimax on [0, 0.347^2], relative error 3.4e-18.
        cosh: &[
            0.5000000000000012,
            0.0416666666665189,
            0.001388888894627032,
            2.4801490584402944e-05,
            2.763108800713544e-07,
        ],
        // Minimax on [0, 0.1716^2], relative error 1.2e-18.
        ln: &[
            0.6666666666666734,
            0.3999999999941689,
            0.28571428741961874,
            0.2222219861178267,
            0.18183562524546137,
            0.15314092451112046,
            0.147955652395928,
        ],
        // Minimax on [0, 1], relative error 3.9e-17.
        atan: &[
            -0.3333333333333186,
            0.19999999999755202,
            -0.14285714271342623,
            0.11111110678922557,
            -0.09090901237760539,
            0.07692212952239981,
            -0.06665860504577303,
            0.058773084504328596,
            -0.0523923546074776,
            0.04673956421666102,
            -0.040926527870688505,
            0.034068051874514345,
            -0.025827104498958826,
            0.016978336325668513,
            -0.009184779299924424,
            0.0038560919093199933,
            -0.0011641143657781562,
            0.0002230319024242561,
            -2.0259531695072383e-05,
        ],
        // Minimax on [0, 1/4], relative error 9.7e-19.
        asin: &[
            0.1666666666666676,
            0.0749999999997087,
            0.04464285717455508,
            0.03038194271017465,
            0.022372214927340484,
            0.017351612996472143,
            0.013980809744734141,
            0.011398993982172959,
            0.010779825685642983,
            0.0037079226266356615,
            0.02170396926847693,
            -0.02099439009432414,
            0.03262583638822157,
        ],
        // Minimax on [-0.1038, 0.1026], relative error 9.9e-8.
        inverse_cbrt: &[
            1.0000000026695655,
            0.33332886175239695,
            0.222217118790326,
            0.1745207026249604,
            0.14547158885247155,
        ],
    };

    #[inline(always)]
    fn quarter_turns_off<const FUSED: bool>(
        x: Lane<Self, FUSED>,
        n: Lane<Self, FUSED>,
    ) -> [Lane<Self, FUSED>; 2] {
        // Two parts are short, so that 2^20 times them is exact. Where a difference is rounded,
        // its larger term stands first; where it is not, its order does not count.
        if FUSED {
            let part = |index: usize| {
                Lane(
                    [core::f64::consts::FRAC_PI_2, 6.12323399667708e-17, -9.403137205957857e-27]
                        [index],
                )
            };
            let coarse = n.times_from(part(0), x);
            let near = n.times_from(part(1), coarse);
            let rest = n.times_from(part(1), coarse - near);
            [near, n.times_from(part(2), rest)]
        } else {
            let parts = [
                1.5707963267341256,
                6.077100506303966e-11,
                2.0222662487111665e-21,
                8.4784276603689e-32,
            ];
            let [a, b, c, d] = parts.map(|part| n * Lane(part));
            let coarse = x - a;
            let (fine, first) = coarse.sum(-b);
            let (near, second) = fine.sum(-c);
            [near, first + second - d]
        }
    }

    #[inline(always)]
    fn powf<const FUSED: bool>(x: Lane<Self, FUSED>, y: Lane<Self, FUSED>) -> Lane<Self, FUSED> {
        power::of_double(x, y)
    }
}
