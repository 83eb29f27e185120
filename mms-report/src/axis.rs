//! Logarithmic axes: their ranges, the places of their numbers, and how these are written.

use maud::{Markup, html};

/// The least and the greatest of positive values, widened by a factor; from 0.1 to 1 if there are none.
pub fn span(values: impl Iterator<Item = f64>, factor: f64) -> (f64, f64) {
    let (least, greatest) = values
        .fold((f64::INFINITY, 0.0_f64), |(least, greatest), v| (least.min(v), greatest.max(v)));
    if greatest > 0.0 { (least / factor, greatest * factor) } else { (0.1, 1.0) }
}

/// The values whose labels do not overlap on an axis.
pub fn apart(values: impl Iterator<Item = f64>, range: (f64, f64)) -> Vec<f64> {
    let room = (range.1 / range.0).ln() / 9.0;
    let mut values: Vec<_> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup_by(|next, kept| (*next / *kept).ln() < room);
    values
}

/// The most numbers that an axis carries.
const MOST: usize = 9;

/// The places of numbers on an axis: decades, or 1, 2 and 5 times decades if these are fewer than two.
pub fn ticks(range: (f64, f64)) -> Vec<f64> {
    let exponents = range.0.log10().floor() as i32..=range.1.log10().ceil() as i32;
    let inside = |digits: &[u8]| -> Vec<f64> {
        let values = exponents.clone().flat_map(|exponent| {
            digits.iter().map(move |digit| f64::from(*digit) * 10f64.powi(exponent))
        });
        values.filter(|value| (range.0..=range.1).contains(value)).collect()
    };
    let decades = inside(&[1]);
    let shown = if decades.len() < 2 { inside(&[1, 2, 5]) } else { decades };
    let step = shown.len().div_ceil(MOST).max(1);
    shown.into_iter().step_by(step).collect()
}

/// A number at an axis: a power of ten, or three digits.
pub fn label(value: f64) -> Markup {
    let exponent = value.log10().round();
    let is_power = (value / 10f64.powf(exponent) - 1.0).abs() < 1e-9;
    html! {
        @if is_power && exponent.abs() > 1.0 {
            "10" tspan.exponent dy="-6" { (exponent) }
        } @else {
            (short(value))
        }
    }
}

/// Three digits of a number.
pub fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    match rounded.abs() {
        0.0 => "0".into(),
        size if (1e-3..1e4).contains(&size) => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_at_axes_have_three_digits() {
        let found = [0.0625, 1.0 / 3.0, 1.5e-7, 12345.0, 0.0].map(short);
        assert_eq!(found, ["0.0625", "0.333", "1.5e-7", "1.23e4", "0"]);
    }

    #[test]
    fn an_axis_carries_a_few_numbers() {
        assert_eq!(ticks((0.5, 30.0)), [1.0, 10.0]);
        assert_eq!(ticks((1.5, 8.0)), [2.0, 5.0]);
        let many = ticks((1e-150, 1e150));
        assert!(many.len() <= MOST + 1 && many.len() > 2, "{many:?}");
    }
}
