//! Contenders that compute one point after the other.

use crate::{COUNT, Case, Contender, Run, timed};

/// A function that computes b at all points, from parameters, time and coordinates by axis, and writes the components.
pub type Forcing = fn(&[f64], f64, &[Vec<f64>], &mut [Vec<f64>]);

/// A function to time.
pub struct Single {
    contender: &'static str,
    forcing: Forcing,
    parameters: &'static [f64],
    time: f64,
    points: Vec<Vec<f64>>,
    out: Vec<Vec<f64>>,
    seconds: Vec<f64>,
}

impl Single {
    /// Prepares a contender for its first round.
    pub fn contender(contender: &'static str, case: &Case, forcing: Forcing) -> Box<dyn Contender> {
        Box::new(Single {
            contender,
            forcing,
            parameters: case.parameters,
            time: case.time,
            points: case.points.clone(),
            out: vec![vec![0.0; COUNT]; case.points.len()],
            seconds: Vec::new(),
        })
    }
}

impl Contender for Single {
    fn round(&mut self) -> Result<(), Box<dyn std::error::Error>> {
        let all = || (self.forcing)(self.parameters, self.time, &self.points, &mut self.out);
        self.seconds.push(timed(all));
        Ok(())
    }

    fn finish(self: Box<Self>) -> Run {
        Run {
            contender: self.contender,
            precision: "f64",
            mode: "scalar",
            seconds: self.seconds,
            slots: None,
            results: self.out,
        }
    }
}
