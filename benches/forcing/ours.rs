//! The code that this project generates.

use mms_runtime::math::Scalar as _;

use crate::floor::{Counted, Tally};
use crate::{COUNT, Case, Contender, Run, timed};

mms_macros::field!("benches/forcing/fields/a.toml", quantities = [body_force]);
mms_macros::field!("benches/forcing/fields/b.toml", quantities = [body_force]);
mms_macros::field!("benches/forcing/fields/c.toml", quantities = [body_force]);

type Work<T> = Box<dyn FnMut(&[Vec<T>], &mut [Vec<T>])>;

struct Ours<T> {
    mode: &'static str,
    precision: &'static str,
    points: Vec<Vec<T>>,
    out: Vec<Vec<T>>,
    seconds: Vec<f64>,
    work: Work<T>,
    slots: Option<usize>,
}

impl<T: Copy + Into<f64>> Contender for Ours<T> {
    fn round(&mut self) -> Result<(), Box<dyn std::error::Error>> {
        self.seconds.push(timed(|| (self.work)(&self.points, &mut self.out)));
        Ok(())
    }

    fn finish(self: Box<Self>) -> Run {
        let widened = |column: &Vec<T>| column.iter().map(|value| (*value).into()).collect();
        Run {
            contender: "mms",
            precision: self.precision,
            mode: self.mode,
            seconds: self.seconds,
            slots: self.slots,
            results: self.out.iter().map(widened).collect(),
        }
    }
}

/// The operations at a point: for a batch, and for a batch with kept points.
macro_rules! slots {
    ($module:ident, $float:ident, $case:expr) => {{
        let tally = Tally::new(stringify!($float));
        let constant = |value: &f64| Counted::from_f64(*value);
        let parameters = core::array::from_fn(|index| constant(&$case.parameters[index]));
        let field = $module::prepare(&$module::Parameters::from_array(parameters));
        let now = field.at_time(constant(&$case.time));
        let position = core::array::from_fn(|axis| tally.number($case.points[axis][0]));
        now.body_force(position);
        let batch = tally.take();
        let point = field.at_point(position);
        tally.take();
        now.body_force_at(&point);
        [batch, tally.take()]
    }};
}

macro_rules! field {
    ($module:ident, $dimension:literal, $float:ident, $case:expr) => {{
        let parameters = core::array::from_fn(|index| $case.parameters[index] as $float);
        let field: &'static _ =
            Box::leak(Box::new($module::prepare(&$module::Parameters::from_array(parameters))));
        let time = $case.time as $float;
        let points: Vec<Vec<$float>> = $case
            .points
            .iter()
            .map(|column| column.iter().map(|value| *value as $float).collect())
            .collect();
        let kept = field.at_points(core::array::from_fn(|axis| &points[axis][..]));
        let scalar: Work<$float> = Box::new(move |points, out| {
            let at = field.at_time(time);
            for index in 0..COUNT {
                let b = at.body_force(core::array::from_fn(|axis| points[axis][index]));
                for (column, value) in out.iter_mut().zip(b) {
                    column[index] = value;
                }
            }
        });
        let batch: Work<$float> = Box::new(move |points, out| {
            let out: &mut [_; $dimension] = out.try_into().expect("one column for each axis");
            let points = core::array::from_fn(|axis| &points[axis][..]);
            field
                .at_time(time)
                .body_force_batch(points, out.each_mut().map(|column| &mut column[..]));
        });
        let cached: Work<$float> = Box::new(move |_, out| {
            let out: &mut [_; $dimension] = out.try_into().expect("one column for each axis");
            field
                .at_time(time)
                .body_force_batch_at(&kept, out.each_mut().map(|column| &mut column[..]));
        });
        let [slots, slots_kept] = slots!($module, $float, $case);
        let modes =
            [("scalar", scalar, None), ("batch", batch, slots), ("cached", cached, slots_kept)];
        modes.map(|(mode, work, slots)| {
            let contender: Box<dyn Contender> = Box::new(Ours {
                mode,
                precision: stringify!($float),
                points: points.clone(),
                out: vec![vec![0.0; COUNT]; $dimension],
                seconds: Vec::new(),
                work,
                slots,
            });
            contender
        })
    }};
}

/// The contenders scalar, batch and cached, in both precisions.
pub fn contenders(case: &Case) -> Vec<Box<dyn Contender>> {
    let both = match case.name {
        "A" => [field!(a, 1, f64, case), field!(a, 1, f32, case)],
        "B" => [field!(b, 3, f64, case), field!(b, 3, f32, case)],
        _ => [field!(c, 2, f64, case), field!(c, 2, f32, case)],
    };
    both.into_iter().flatten().collect()
}
