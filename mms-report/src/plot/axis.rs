//! Logarithmic axes: their ranges, the places of their numbers, and how these are written.

use super::drawing::Words;

/// The least and the greatest of positive values, widened by a factor; from 0.1 to 1 if there are none.
pub fn span(values: impl Iterator<Item = f64>, factor: f64) -> (f64, f64) {
    let (least, greatest) = values
        .fold((f64::INFINITY, 0.0_f64), |(least, greatest), v| (least.min(v), greatest.max(v)));
    if greatest > 0.0 { (least / factor, greatest * factor) } else { (0.1, 1.0) }
}

/// The values whose labels do not overlap on an axis of this length in pixels.
pub fn apart(values: impl Iterator<Item = f64>, range: (f64, f64), length: f64) -> Vec<f64> {
    const GAP: f64 = 9.0;
    let place = |value: f64| (value / range.0).ln() / (range.1 / range.0).ln() * length;
    let mut values: Vec<_> = values.collect();
    values.sort_by(f64::total_cmp);
    let mut end = f64::NEG_INFINITY;
    values.retain(|value| {
        let half = label(*value).width() / 2.0;
        let is_free = place(*value) - half > end;
        if is_free {
            end = place(*value) + half + GAP;
        }
        is_free
    });
    values
}

/// The most numbers that an axis carries.
const MOST: usize = 9;

/// The positions of numbers on an axis, and of strokes without numbers.
pub struct Ticks {
    /// The places of numbers: decades, or 1, 2 and 5 times decades if these are fewer than two.
    pub numbers: Vec<f64>,
    /// The places of strokes between decades; empty if these lie close together.
    pub strokes: Vec<f64>,
}

/// The ticks of an axis.
pub fn ticks(range: (f64, f64)) -> Ticks {
    let exponents = range.0.log10().floor() as i32..=range.1.log10().ceil() as i32;
    let inside = |digits: &[u8]| -> Vec<f64> {
        let values = exponents.clone().flat_map(|exponent| {
            digits.iter().map(move |digit| f64::from(*digit) * 10f64.powi(exponent))
        });
        values.filter(|value| (range.0..=range.1).contains(value)).collect()
    };
    let decades = inside(&[1]);
    let strokes =
        if decades.len() <= MOST / 2 { inside(&[2, 3, 4, 5, 6, 7, 8, 9]) } else { Vec::new() };
    let shown = match decades.len() {
        0 | 1 if inside(&[1, 2, 5]).len() > 1 => inside(&[1, 2, 5]),
        // A range between two neighbouring decades.
        0 => inside(&[1, 2, 3, 4, 5, 6, 7, 8, 9]),
        _ => decades,
    };
    let step = shown.len().div_ceil(MOST).max(1);
    Ticks { numbers: shown.into_iter().step_by(step).collect(), strokes }
}

/// About five numbers of few digits along a linear axis.
pub fn steps([from, to]: [f64; 2]) -> Vec<f64> {
    let wanted = (to - from) / 5.0;
    if !wanted.is_normal() || wanted < 0.0 {
        return vec![from];
    }
    let decade = 10f64.powf(wanted.log10().floor());
    let step = [1.0, 2.0, 5.0].map(|it| it * decade).into_iter().find(|it| *it >= wanted);
    let step = step.unwrap_or(10.0 * decade);
    let [first, last] = [(from / step - 1e-9).ceil(), (to / step + 1e-9).floor()];
    // Adding 0 makes -0 a 0.
    (0..=(last - first) as usize).map(|it| (first + it as f64) * step + 0.0).collect()
}

/// A number at an axis: a power of ten, or three digits.
pub fn label(value: f64) -> Words {
    let exponent = value.log10().round();
    let is_power = (value / 10f64.powf(exponent) - 1.0).abs() < 1e-9;
    let power = |exponent: &str| exponent.replace('-', "\u{2212}");
    if is_power && exponent.abs() > 1.0 {
        return Words::plain("10").and(power(&exponent.to_string()), true);
    }
    let text = short(value);
    match text.split_once('e') {
        Some((digits, exponent)) => {
            Words::plain(format!("{digits}\u{d7}10")).and(power(exponent), true)
        }
        None => Words::plain(text),
    }
}

/// Numbers at an axis: all as powers of ten, if all are powers of ten and one has to be written so.
pub fn labels(values: &[f64]) -> Vec<Words> {
    let all: Vec<Words> = values.iter().map(|it| label(*it)).collect();
    let is_power = |value: &f64| (value / 10f64.powf(value.log10().round()) - 1.0).abs() < 1e-9;
    if values.iter().all(is_power) && all.iter().any(|it| it.0.len() > 1) {
        let power =
            |value: &f64| format!("{}", value.log10().round() + 0.0).replace('-', "\u{2212}");
        return values.iter().map(|it| Words::plain("10").and(power(it), true)).collect();
    }
    all
}

/// A unit with raised exponents: `kg/m^3` becomes kg/m³.
pub fn unit(words: Words, unit: &str) -> Words {
    let mut words = words;
    for (at, part) in unit.split('^').enumerate() {
        let end = part.find(|c: char| !(c.is_ascii_digit() || c == '-')).unwrap_or(part.len());
        let (exponent, rest) = if at == 0 { ("", part) } else { part.split_at(end) };
        if !exponent.is_empty() {
            words = words.and(exponent.replace('-', "\u{2212}"), true);
        }
        if !rest.is_empty() {
            words = words.and(rest.replace('*', "\u{b7}"), false);
        }
    }
    words
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

    fn text(words: &Words) -> String {
        let part = |it: &super::super::drawing::Part| match it.is_raised {
            true => format!("^{}", it.text),
            false => it.text.clone(),
        };
        words.0.iter().map(part).collect()
    }

    #[test]
    fn numbers_at_axes_have_three_digits() {
        let found = [0.0625, 1.0 / 3.0, 1.5e-7, 12345.0, 0.0].map(short);
        assert_eq!(found, ["0.0625", "0.333", "1.5e-7", "1.23e4", "0"]);
        let found = [0.0625, 1e-3, 1.5e-7, 12345.0].map(|it| text(&label(it)));
        assert_eq!(found, ["0.0625", "10^\u{2212}3", "1.5\u{d7}10^\u{2212}7", "1.23\u{d7}10^4"]);
        let all = |values: &[f64]| labels(values).iter().map(text).collect::<Vec<_>>();
        assert_eq!(all(&[0.01, 0.1, 1.0]), ["10^\u{2212}2", "10^\u{2212}1", "10^0"]);
        assert_eq!(all(&[0.1, 1.0, 10.0]), ["0.1", "1", "10"]);
        assert_eq!(text(&unit(Words::default(), "kg*m/s^2/K")), "kg\u{b7}m/s^2/K");
    }

    #[test]
    fn an_axis_carries_a_few_numbers() {
        assert_eq!(ticks((0.5, 30.0)).numbers, [1.0, 10.0]);
        assert_eq!(ticks((1.5, 8.0)).numbers, [2.0, 5.0]);
        assert_eq!(ticks((2.5, 4.5)).numbers, [3.0, 4.0]);
        assert_eq!(ticks((2.0, 20.0)).strokes.len(), 9);
        let many = ticks((1e-150, 1e150)).numbers;
        assert!(many.len() <= MOST + 1 && many.len() > 2, "{many:?}");
    }

    #[test]
    fn a_linear_axis_has_round_numbers() {
        let found = |range| steps(range).into_iter().map(short).collect::<Vec<_>>();
        assert_eq!(found([0.0, 1.0]), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
        assert_eq!(found([0.03, 1.9]), ["0.5", "1", "1.5"]);
        assert_eq!(found([-7e5, 2e6]), ["0", "1e6", "2e6"]);
        assert_eq!(found([1.0, 1.0]), ["1"]);
    }

    #[test]
    fn labels_along_an_axis_do_not_touch() {
        let halves = || (0..12).map(|it| 0.5_f64.powi(it));
        assert_eq!(apart(halves(), (1e-4, 2.0), 2000.0).len(), 12);
        assert!(apart(halves(), (1e-4, 2.0), 200.0).len() < 6);
    }
}
