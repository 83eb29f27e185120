//! The period of a motion: derived from formulas, and compared with the motion.

use mms_analysis::period::{NoPeriod, period};
use mms_codegen::{Compiled, compile};
use mms_mechanics::Output;
use mms_program::interpret::{Interpreter, Point};
use mms_spec::quantity::Quantity;
use mms_symbolic::sorted::SortedMap;

/// A bar of length 1 with this displacement.
fn bar(u: &str) -> Compiled {
    let text = format!(
        r#"
[field]
title = "bar"
dimension = 1
[parameters]
w = {{ value = 3 }}
phase = {{ value = 0.4 }}
[displacement]
u = ["{u}"]
[material]
model = "neo_hookean"
lambda = 0
mu = 1
density = 1
[domain]
shape = "box"
lower = [0]
upper = [1]
time = [0, 1]
"#
    );
    compile("bar", "bar.toml", &text, &|_| Err("none".into()))
        .unwrap_or_else(|failure| panic!("{failure}"))
}

fn period_of(u: &str) -> Result<f64, NoPeriod> {
    period(&bar(u), &SortedMap::new())
}

const TURN: f64 = std::f64::consts::TAU;

#[test]
fn it_is_a_turn_over_the_common_rate() {
    for (u, rate) in [
        ("X*cos(w*t)/9", 3.0),
        ("X*cos(phase - w*t)/9", 3.0),
        ("sin(X - w*t)/9", 3.0),
        ("X*(cos(2*w*t) + sin(3*w*t + phase))/99", 3.0),
        ("X*(cos(w*t/2) + sin(w*t/3))/99", 0.5),
        ("X*cos(2*w*t)/9", 6.0),
        // A function of periodic arguments is periodic, too.
        ("X*sin(X*cos(w*t))*exp(sin(2*w*t))/99", 3.0),
    ] {
        let found = period_of(u).unwrap_or_else(|why| panic!("{u}: {why}"));
        assert!((found * rate / TURN - 1.0).abs() < 1e-14, "{u}: {found}");
        let compiled = bar(u);
        let mut interpreter =
            Interpreter::new(&compiled.program, &compiled.parameters::<f64>(&SortedMap::new()));
        let output = Output::Quantity(Quantity::Displacement);
        let plan = interpreter.plan(&[output]);
        let mut at = |time: f64| {
            interpreter.set_time(&time);
            interpreter.set_point(&plan, Point::at(&[0.7]));
            interpreter.output(output)[0]
        };
        for time in [0.0, 0.3, 1.1] {
            assert!((at(time + found) - at(time)).abs() < 1e-15, "{u}");
        }
    }
}

#[test]
fn parameters_that_are_set_count() {
    let set = SortedMap::from([(0, "5".parse().expect("a number"))]);
    let found = period(&bar("X*cos(w*t)/9"), &set).expect("a period");
    assert!((found * 5.0 / TURN - 1.0).abs() < 1e-14);
    let none = SortedMap::from([(0, "0".parse().expect("a number"))]);
    assert_eq!(period(&bar("X*cos(w*t)/9"), &none), Err(NoPeriod::OutOfRange));
}

#[test]
fn what_does_not_repeat_itself_has_none() {
    for (u, why) in [
        ("X/9", NoPeriod::AtRest),
        ("X*t/9", NoPeriod::Unsteady),
        ("X*exp(-t)/9", NoPeriod::Unsteady),
        ("X*t*cos(w*t)/9", NoPeriod::Unsteady),
        ("X*cos(w*t^2)/9", NoPeriod::Unsteady),
        // Every X has its own period.
        ("cos(w*X*t)/9", NoPeriod::Unsteady),
        ("X*(cos(t) + cos(sqrt(2)*t))/99", NoPeriod::Incommensurate),
        ("X*(cos(w*t) + cos(2*t))/99", NoPeriod::Incommensurate),
    ] {
        assert_eq!(period_of(u), Err(why), "{u}");
    }
}
