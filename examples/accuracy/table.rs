//! The table of errors, as a page of Markdown.

use mms_analysis::accuracy::{Accuracy, Request};
use mms_program::precision::Precision;
use mms_spec::Form;

use crate::sample::{columns, files, measured, regimes, stem, worst};

/// The text above the table.
const HEAD: &str = "\
# Accuracy

The errors of generated code against arbitrary precision: for every field of the gallery and
every regime, the largest |error| over points and components over the largest |value| of that
quantity, in eps of the precision (f32: 2^-23, f64: 2^-52, wide: 2^-104). Each entry shows the
quantity with the largest error, by its symbol. The command below writes this page in half an hour on
two processors; its argument is the number of points and times. A test measures every row again at fewer:

```console
$ cargo run --release --example accuracy -- POINTS > docs/accuracy.md
```

`mms accuracy FIELD` shows the errors of each quantity, with the median and the other quantiles of
|error|/|value|, and the cost of the code.

| regime | the field is evaluated |
|---|---|
| `declared` | as its file declares it |
| `displacement_1e-4` ... | with a displacement of 1e-4 ... of its size |
| `jacobian_1e-3`, `jacobian_1e-6`, `jacobian_1e3` | with an amplitude that lowers, or raises, J to that number |
| `lambda_mu_1e8`, `lambda_mu_0` | with that lambda/mu in its material |
| `moduli_1e-9`, `moduli_1e9`; `lengths_1e-9`, `lengths_1e9` | with parameters of that size, in their unit |
| `origin_1e6` | 1e6 of its sizes off the origin: u(X - s, t) |
| `time_1e6` | 1e6 time windows later |
| `subnormal_inputs`, `largest_inputs` | at a coordinate or a time that is subnormal, or the last finite number |
| `subnormal_amplitude`, `largest_amplitude` | with an amplitude that is subnormal, or the last finite number |

If no parameter of a field scales its displacement, the regimes multiply it by a factor. If J is near 0, an
error of eps in X changes quantities divided by J by eps/J: no evaluation in that precision does
better. `lost` counts components that are not finite although the true value is within range; if the true
value is beyond the range, nothing is lost. Magnitudes below the least normal number count as that number.

The stable form promises 64 eps as declared, and at displacements down to 1e-12 of the size. A test
checks the page for it, with the one exception below; in single and double precision also 1e6 time
windows later. Apart from J near 0 or far from 1, and inputs and amplitudes at the ends of the range, the
stable form exceeds 64 eps in these cases:

| regime | what is lost | why |
|---|---|---|
| `displacement_1e-4` and below of `self_weight_column` | eps/e^2 of u, eps/e of H and the stress at a strain e | u is a logarithm times a length that grows with 1/e, less X: the terms of first order cancel in rounded numbers |
| `time_1e6` | 1e6 eps in twice the digits | single and double precision reduce t to its part of a period with twice their digits; `wide` has no more digits |
| `lengths_1e9`, `moduli_1e-9` in single precision | as their rows show | squares of lengths, or modulus times area, near the end of the range |

";

fn cell(accuracy: &Accuracy, regime: &str, column: (Precision, Form)) -> String {
    let Some((row, lost)) = worst(accuracy, regime, column) else { return "-".into() };
    let eps = row.errors.max_scaled_eps;
    let number = if eps < 1000.0 { format!("{eps:.1}") } else { format!("{eps:.1e}") };
    let symbol = row.quantity.symbol();
    match lost {
        0 => format!("{number} {symbol}"),
        lost => format!("{number} {symbol}, {lost} lost"),
    }
}

/// The whole page; calls `progress` with the name of each field before measuring it.
pub fn page(points: usize, mut progress: impl FnMut(&str)) -> String {
    let mut text = HEAD.replace("POINTS", &points.to_string());
    let names = columns().map(|(precision, form)| format!("{} {}", precision.name(), form.name()));
    let names: Vec<String> = names.collect();
    text += &format!("| field | regime | {} |\n", names.join(" | "));
    text += &format!("|---|---|{}\n", "---|".repeat(names.len()));
    let mut left_out = String::new();
    for path in files() {
        let field = stem(&path);
        progress(&field);
        let accuracy = measured(&path, &Request { points, ..Request::default() });
        for regime in regimes(&accuracy) {
            let cells: Vec<String> =
                columns().map(|column| cell(&accuracy, &regime, column)).collect();
            text += &format!("| {field} | {regime} | {} |\n", cells.join(" | "));
        }
        for it in &accuracy.left_out {
            let precision = it.precision.map_or(String::new(), |it| format!(" in {}", it.name()));
            left_out += &format!("* {field}, {}{precision}: {}\n", it.regime.shown(), it.reason);
        }
    }
    format!("{text}\nLeft out:\n\n{left_out}")
}
