//! Interval arithmetic: no value of an expression in a box lies outside the bounds of the box.

use std::f64::consts::{FRAC_PI_2, PI};

use mms_math::Scalar as _;
use mms_program::interval::Interval;
use mms_program::precise::Precise;
use mms_symbolic::expr::Graph;
use proptest::prelude::*;

use crate::sampled::sampled_count;

use super::evaluation::{place, values};
use super::recipe::{SpaceTimePoint, any_recipe, built, evaluate};

/// A box by its centre and half widths, from a point to all of space.
fn boxes() -> impl Strategy<Value = [(f64, f64); 3]> {
    let width = prop_oneof![Just(0.0), 1e-12..1e-3, 1e-3..1.0, 1.0..100.0, 1e3..1e300];
    let side = (prop_oneof![-4.0..4.0, -1e3..1e3], width);
    [side.clone(), side.clone(), side]
}

fn around(sides: &[(f64, f64); 3], share: f64) -> SpaceTimePoint<Interval> {
    let [x, y, time] =
        sides.map(|(centre, half)| Interval::new(centre - half * share, centre + half * share));
    SpaceTimePoint { coordinates: [x, y], time }
}

/// Whether a value lies within bounds, compared exactly.
fn lies_within(value: &Precise, bounds: Interval) -> bool {
    let error = value.clone().magnitude() * Precise::from_f64(1e-60) + Precise::from_f64(1e-60);
    let above = !bounds.lower().is_finite()
        || Precise::from_f64(bounds.lower()).at_most(&(value.clone() + error.clone()));
    let below = !bounds.upper().is_finite()
        || (value.clone() - error).at_most(&Precise::from_f64(bounds.upper()));
    above && below
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(sampled_count(256, 3) as u32))]

    #[test]
    fn no_value_is_outside_the_bounds(
        recipe in any_recipe(),
        sides in boxes(),
        shares in prop::collection::vec([-1.0..=1.0, -1.0..=1.0, -1.0..=1.0_f64], 4),
    ) {
        let mut graph = Graph::default();
        let root = built(&mut graph, &recipe)?;
        let whole = around(&sides, 1.0);
        let of_program = values(&graph, &[root], &whole).remove(0);
        let of_recipe = evaluate(&recipe, &whole, &mut |_| ());
        for shares in shares {
            let at = [0, 1, 2].map(|axis| {
                let (centre, half): (f64, f64) = sides[axis];
                let point = centre + half * shares[axis];
                point.clamp(centre - half, centre + half)
            });
            let at = place(at[0], at[1], at[2]);
            let mut lost = false;
            let written = evaluate(&recipe, &at, &mut |value: &Precise| {
                // A value that is nearly 0 by cancellation has no digits left to compare.
                let magnitude = value.to_f64().abs();
                lost |= value.is_defined() && !(1e-10..1e10).contains(&magnitude);
            });
            if lost {
                continue;
            }
            if written.is_defined() {
                prop_assert!(lies_within(&written, of_recipe), "{:e} {of_recipe:?}", written.to_f64());
                prop_assert!(lies_within(&written, of_program), "{:e} {of_program:?}", written.to_f64());
            } else {
                prop_assert!(!of_recipe.is_defined(), "undefined at {at:?}, but {of_recipe:?}");
            }
        }
    }

    #[test]
    fn a_smaller_box_has_no_wider_bounds(
        recipe in any_recipe(),
        sides in boxes(),
        share in 0.0..1.0_f64,
    ) {
        let (whole, part) = (around(&sides, 1.0), around(&sides, share));
        let of_whole = evaluate(&recipe, &whole, &mut |_| ());
        let of_part = evaluate(&recipe, &part, &mut |_| ());
        // A part that lies outside a domain has no value to bound.
        if of_part.is_defined() {
            prop_assert!(of_whole.encloses(of_part), "{of_part:?} is not in {of_whole:?}");
        } else {
            prop_assert!(!of_whole.is_defined());
        }
    }

    #[test]
    fn the_bounds_of_a_point_are_near_its_value(recipe in any_recipe(), x in -2.0..2.0_f64) {
        let sides = [(x, 0.0), (0.375, 0.0), (-0.5, 0.0)];
        let mut widest = 0.0_f64;
        let mut largest = 1.0_f64;
        let bounds = evaluate(&recipe, &around(&sides, 1.0), &mut |bounds: &Interval| {
            let far = bounds.lower().abs().max(bounds.upper().abs());
            largest = largest.max(far);
            // Near 0 the effect of rounding errors on a division or a root has no bound, and neither has their effect on an arc
            // sine near its ends.
            let near = bounds.lower().abs().min(bounds.upper().abs());
            let ends = [0.0, FRAC_PI_2, PI];
            if bounds.contains(0.0) || ends.iter().any(|end| (near - end).abs() < 1e-3) {
                largest = f64::INFINITY;
            }
            widest = widest.max(bounds.width());
        });
        // About 80 operations on moderate numbers, few of which amplify the incoming errors.
        prop_assert!(!bounds.is_defined() || largest > 10.0 || widest < 1e-9, "{bounds:?}");
    }
}

#[test]
fn a_square_is_no_product_of_strangers() {
    let mut graph = Graph::default();
    let x = graph.symbol(super::recipe::X);
    let square = graph.power(x, 2);
    let whole = around(&[(0.0, 2.0), (0.0, 0.0), (0.0, 0.0)], 1.0);
    assert_eq!(values(&graph, &[square], &whole), [Interval::new(0.0, 4.0)]);
}
