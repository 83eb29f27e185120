//! Divisions that are done together, and roots that are divided by.

use mms_math::{Lane, Scalar};

use super::{FORMATS, Format, Random, of};

/// A fraction's worst error in units of the last digit.
const QUOTIENT: f64 = 1.5;

/// Quotients in one format, held in `f64`: without and with fused products, and the careful ones.
fn quotients<const N: usize>(format: usize, above: [f64; N], below: [f64; N]) -> [[f64; N]; 3] {
    let plain = |x: [f64; N]| x.map(Lane::<_, false>);
    let fused = |x: [f64; N]| x.map(Lane::<_, true>);
    let single = |x: [f64; N]| x.map(|x| x as f32);
    match format {
        0 => [
            Lane::quotients(plain(above), plain(below)).map(|x| x.0),
            Lane::quotients(fused(above), fused(below)).map(|x| x.0),
            Scalar::quotients(above, below),
        ],
        _ => {
            let (above, below) = (single(above), single(below));
            let plain = |x: [f32; N]| x.map(Lane::<_, false>);
            let fused = |x: [f32; N]| x.map(Lane::<_, true>);
            [
                Lane::quotients(plain(above), plain(below)).map(|x| x.0.into()),
                Lane::quotients(fused(above), fused(below)).map(|x| x.0.into()),
                Scalar::quotients(above, below).map(f64::from),
            ]
        }
    }
}

/// Holds quotients to their bound where they must be known, and elsewhere to be right or nothing.
fn check<const N: usize>(
    format: &Format,
    index: usize,
    above: [f64; N],
    below: [f64; N],
    must: bool,
) {
    let [plain, fused, careful] = quotients(index, above, below);
    for position in 0..N {
        let (a, b) = (above[position], below[position]);
        assert_eq!(careful[position].to_bits(), (format.round)(a / b).to_bits());
        for value in [plain[position], fused[position]] {
            if value.is_nan() {
                assert!(!must || b == 0.0, "{above:?}/{below:?} at {position} is not a number");
            } else if b == 0.0 || !b.is_finite() {
                assert_eq!(value, a / b, "{above:?}/{below:?} at {position}");
            } else {
                let truth = of(a) / of(b);
                let right = format.is_right(value, &truth, QUOTIENT);
                assert!(right, "{above:?}/{below:?} at {position}: {value:e}");
            }
        }
    }
}

/// Numbers whose products stay within the range of a format, and any numbers.
fn tried<const N: usize>(seed: u64) {
    let mut random = Random(seed);
    for _ in 0..4000 {
        for (index, format) in FORMATS.iter().enumerate() {
            let room = [1000.0, 120.0][index] / (2 * N) as f64;
            let mut usual =
                || (format.round)(random.signed().signum() * random.magnitude(-room, room));
            let (above, below) = ([(); N].map(|()| usual()), [(); N].map(|()| usual()));
            check(format, index, above, below, true);
            let mut any = || (format.round)(random.number());
            let (above, below) = ([(); N].map(|()| any()), [(); N].map(|()| any()));
            if above.iter().chain(&below).all(|x| x.is_finite()) {
                check(format, index, above, below, false);
            }
        }
    }
}

#[test]
fn divisions_done_together_are_right_or_not_a_number() {
    tried::<1>(11);
    tried::<2>(12);
    tried::<3>(13);
    tried::<6>(14);
}

#[test]
fn a_product_that_leaves_the_range_gives_no_number() {
    let below = [1e-200, 1e-200, 1e300];
    let [_, fused, careful] = quotients(0, [1.0; 3], below);
    assert!(fused.iter().all(|value| value.is_nan()), "{fused:?}");
    assert_eq!(careful, below.map(|x| 1.0 / x));
    for zero in [0.0, -0.0] {
        let [_, fused, _] = quotients(0, [1.0, 1.0], [2.0, zero]);
        assert!(fused.iter().all(|value| value.is_nan()), "{fused:?}");
    }
}

#[test]
fn a_zero_keeps_its_sign() {
    let [_, fused, _] = quotients(0, [0.0, -0.0, 0.0], [2.0, 3.0, -4.0]);
    assert_eq!(fused.map(f64::to_bits), [0.0, -0.0, -0.0].map(f64::to_bits));
}

#[test]
fn a_root_and_what_divides_by_it_are_right_or_not_a_number() {
    let mut random = Random(15);
    for _ in 0..20_000 {
        for (index, format) in FORMATS.iter().enumerate() {
            let x = (format.round)(random.number());
            let [root, below] = match index {
                0 => Lane::<_, true>(x).root().map(|x| x.0),
                _ => Lane::<_, true>(x as f32).root().map(|x| x.0.into()),
            };
            if !(x >= format.least && x <= format.most) {
                assert!(root.is_nan(), "the root of {x:e}: {root:e}");
                continue;
            }
            let truth = of(x).sqrt();
            assert!(
                format.is_right(root, &truth, [0.6, 0.7][index]),
                "the root of {x:e}: {root:e}"
            );
            assert!(format.is_right(below, &(of(1.0) / truth), 1.0), "under the root of {x:e}");
        }
    }
    assert_eq!(Lane::<_, false>(4.0).root(), [Lane(2.0), Lane(0.5)]);
    assert_eq!(3.0.over_root(4.0.root()[1]), 1.5);
}
