// Evaluates the emitted modules beside it. For a line `QUANTITY TIME COORDINATES..` on stdin it prints the bits of the
// components.

use std::io::{Read as _, stdin};

fn evaluate(quantity: &str, time: f64, at: &[f64]) -> Vec<f64> {
    let bar = bar_1d::prepare(&bar_1d::Parameters::<f64>::default());
    let wave = standing_wave_3d::prepare::<f64>(&standing_wave_3d::Parameters::default());
    let odd = odd_names::prepare(&odd_names::Parameters::<f64>::default());
    let plain = plain::prepare::<f64>(&plain::Parameters::default());
    let (bar_now, wave_now) = (bar.at_time(time), wave.at_time(time));
    let shaft = units_axisymmetric::prepare::<f64>(&units_axisymmetric::Parameters::default());
    let shaft_now = shaft.at_time(time);
    let first = || [at[0]];
    let both = || at.try_into().expect("two coordinates");
    let all = || at.try_into().expect("three coordinates");
    match quantity {
        "bar_body_force" => bar_now.body_force(first()).to_vec(),
        "bar_stress_of_kept" => bar_now.cauchy_stress_at(&bar.at_point(first())).concat(),
        "bar_upper" => bar.upper().to_vec(),
        "bar_material" => bar.material_first_piola_kirchhoff([0.5], [first()]).concat(),
        "wave_body_force" => wave_now.body_force(all()).to_vec(),
        "wave_body_force_of_kept" => wave_now.body_force_at(&wave.at_point(all())).to_vec(),
        "wave_velocity" => wave_now.velocity(all()).to_vec(),
        "odd_displacement" => odd.at_time(time).displacement(first()).to_vec(),
        "shaft_body_force" => shaft_now.body_force(both()).to_vec(),
        "shaft_body_force_of_kept" => shaft_now.body_force_at(&shaft.at_point(both())).to_vec(),
        "shaft_stress" => shaft_now.first_piola_kirchhoff(both()).concat(),
        "plain_displacement" => plain.at_time(time).displacement(first()).to_vec(),
        unknown => panic!("no quantity {unknown}"),
    }
}

fn main() {
    let mut text = String::new();
    stdin().read_to_string(&mut text).expect("readable input");
    for line in text.lines() {
        let mut words = line.split_whitespace();
        let quantity = words.next().expect("a quantity");
        let numbers: Vec<f64> = words.map(|word| word.parse().expect("a number")).collect();
        let bits: Vec<String> = evaluate(quantity, numbers[0], &numbers[1..])
            .iter()
            .map(|value| value.to_bits().to_string())
            .collect();
        println!("{}", bits.join(" "));
    }
}
