//! Compares two modules of one field: from the macro, with parameters, and from the build script, without.
//! `cargo run` evaluates both at some points, and exits 1 if they differ.

use std::process::ExitCode;

mms_macros::field!("fields/spring_1d.toml", quantities = [body_force, displacement]);

/// The module that the build script wrote; not all of its functions are used.
#[allow(dead_code)]
mod frozen {
    include!(concat!(env!("OUT_DIR"), "/spring_1d.rs"));
}

fn main() -> ExitCode {
    let parameters = spring_1d::Parameters::<f64>::default();
    let field = spring_1d::prepare(&parameters);
    let same = frozen::prepare::<f64>(&frozen::Parameters::default());
    println!("     X        u               b, and by how much the other differs");
    let mut worst: f64 = 0.0;
    let (now, then) = (field.at_time(0.013), same.at_time(0.013));
    for step in 0..=4 {
        let x = parameters.length * f64::from(step) / 4.0;
        let ([u], [b]) = (now.displacement([x]), now.body_force([x]));
        let ([v], [c]) = (then.displacement([x]), then.body_force([x]));
        let difference =
            ((u - v) / parameters.amplitude).abs().max(((b - c) / b.abs().max(1.0)).abs());
        worst = worst.max(difference);
        println!("{x:6.2} {u:12.6} {b:15.6} {difference:8.1e}");
    }
    // Constants that were folded exactly may be rounded otherwise.
    if worst < 16.0 * f64::EPSILON { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
