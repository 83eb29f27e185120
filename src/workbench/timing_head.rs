// The program that times emitted code. What follows this text: the modules, and a `main` that lists
// the contenders.
#![allow(warnings)]

use mms_math::{Double, Scalar};
use std::hint::black_box;
use std::time::Instant;

/// A contender: how many points it evaluates in a turn, and a turn.
type Turns = Vec<(usize, Box<dyn FnMut()>)>;

struct Input {
    time: f64,
    few: usize,
    columns: Vec<Vec<f64>>,
}

impl Input {
    fn read() -> Self {
        let text = std::io::read_to_string(std::io::stdin()).expect("input");
        let numbers = |line: &str| -> Vec<f64> {
            line.split_whitespace().map(|number| number.parse().expect("a number")).collect()
        };
        let mut lines = text.lines();
        let first = numbers(lines.next().expect("a line"));
        let rows: Vec<Vec<f64>> = lines.map(numbers).collect();
        let columns = (0..rows[0].len()).map(|k| rows.iter().map(|row| row[k]).collect());
        Input { time: first[0], few: first[1] as usize, columns: columns.collect() }
    }

    fn columns<T: Scalar, const D: usize>(&self, from: usize) -> [Vec<T>; D] {
        core::array::from_fn(|axis| {
            self.columns[from + axis].iter().map(|number| T::from_f64(*number)).collect()
        })
    }

    fn rows<T: Scalar + Copy, const D: usize>(&self, from: usize) -> Vec<[T; D]> {
        let columns: [Vec<T>; D] = self.columns(from);
        (0..self.few).map(|index| core::array::from_fn(|axis| columns[axis][index])).collect()
    }
}

macro_rules! batch {
    ($turns:ident, $input:ident, $module:ident, $float:ident, $dimension:literal, $results:literal,
     $function:ident $(, $normals:ident)?) => {{
        let field: $module::Field<$float> = $module::prepare(&$module::Parameters::default());
        let time = $input.time as $float;
        let points: [Vec<$float>; $dimension] = $input.columns(0);
        $(let $normals: [Vec<$float>; $dimension] = $input.columns($dimension);)?
        let count = points[0].len();
        let mut out: [Vec<$float>; $results] = core::array::from_fn(|_| vec![0.0; count]);
        $turns.push((count, Box::new(move || {
            field.at_time(black_box(time)).$function(
                core::array::from_fn(|axis| &points[axis][..])
                $(, core::array::from_fn(|axis| &$normals[axis][..]))?,
                out.each_mut().map(|column| &mut column[..]),
            );
            black_box(&mut out);
        })));
    }};
}

macro_rules! single {
    ($turns:ident, $input:ident, $module:ident, $scalar:ident, $dimension:literal,
     $function:ident, $($normals:ident)?) => {{
        let field: $module::Field<$scalar> = $module::prepare(&$module::Parameters::default());
        let time = <$scalar as Scalar>::from_f64($input.time);
        let points: Vec<[$scalar; $dimension]> = $input.rows(0);
        $(let $normals: Vec<[$scalar; $dimension]> = $input.rows($dimension);)?
        $turns.push((points.len(), Box::new(move || {
            let now = field.at_time(black_box(time));
            for index in 0..points.len() {
                black_box(now.$function(points[index] $(, $normals[index])?));
            }
        })));
    }};
}

/// Prints the median of the rounds of each contender, in nanoseconds a point.
fn run(mut turns: Turns, rounds: usize) {
    let mut times = vec![Vec::new(); turns.len()];
    for _ in 0..=rounds {
        for ((count, turn), times) in turns.iter_mut().zip(&mut times) {
            let start = Instant::now();
            turn();
            times.push(1e9 * start.elapsed().as_secs_f64() / *count as f64);
        }
    }
    for mut times in times {
        // The first round warms up.
        times.remove(0);
        times.sort_by(f64::total_cmp);
        println!("{}", times[times.len() / 2]);
    }
}
