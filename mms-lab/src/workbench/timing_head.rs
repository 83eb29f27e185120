// The program that times emitted code. After this text follow the modules, and a `main` that lists the contenders.
#![allow(warnings)]

use std::hint::black_box;
use std::time::Instant;

use mms_math::{Double, Scalar};

/// A contender: how many points it evaluates in a turn, and a turn.
type Turn = (usize, Box<dyn FnMut()>);

/// The number of points that are evaluated one by one in a turn.
const FEW: usize = 256;

struct Input {
    time: f64,
    columns: Vec<Vec<f64>>,
}

impl Input {
    /// Reads the inputs of all modules, with an empty line after each.
    fn read() -> Vec<Self> {
        let text = std::io::read_to_string(std::io::stdin()).expect("input");
        text.split_terminator("\n\n").map(Input::of).collect()
    }

    fn of(text: &str) -> Self {
        let numbers = |line: &str| -> Vec<f64> {
            line.split_whitespace().map(|number| number.parse().expect("a number")).collect()
        };
        let mut lines = text.lines();
        let time = numbers(lines.next().expect("a line"))[0];
        let rows: Vec<Vec<f64>> = lines.map(numbers).collect();
        let columns = (0..rows[0].len()).map(|k| rows.iter().map(|row| row[k]).collect());
        Input { time, columns: columns.collect() }
    }

    fn count(&self) -> usize {
        self.columns[0].len()
    }

    fn columns<T: Scalar, const D: usize>(&self, from: usize) -> [Vec<T>; D] {
        core::array::from_fn(|axis| {
            self.columns[from + axis].iter().map(|number| T::from_f64(*number)).collect()
        })
    }

    fn rows<T: Scalar + Copy, const D: usize>(&self, from: usize) -> [[T; D]; FEW] {
        let columns: [Vec<T>; D] = self.columns(from);
        core::array::from_fn(|index| core::array::from_fn(|axis| columns[axis][index]))
    }
}

/// All columns as slices.
fn slices<T, const N: usize>(columns: &[Vec<T>; N]) -> [&[T]; N] {
    columns.each_ref().map(|column| &column[..])
}

/// A contender that evaluates [`FEW`] points one by one.
fn single(turn: impl FnMut() + 'static) -> Turn {
    (FEW, Box::new(turn))
}

/// A contender that writes its results into columns.
fn batch<T: Scalar + Copy + 'static, const N: usize>(
    count: usize,
    mut evaluate: impl FnMut([&mut [T]; N]) + 'static,
) -> Turn {
    let mut out: [Vec<T>; N] = core::array::from_fn(|_| vec![T::from_f64(0.0); count]);
    let turn = move || {
        evaluate(out.each_mut().map(|column| &mut column[..]));
        black_box(&mut out);
    };
    (count, Box::new(turn))
}

/// Prints the median of the rounds of each contender, in nanoseconds a point.
fn run(mut turns: Vec<Turn>, rounds: usize) {
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
