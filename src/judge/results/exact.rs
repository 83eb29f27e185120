//! The exact solution at many points, and how far points are outside the body.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::Arc;

use mms_mechanics::Output;
use mms_mechanics::extent::Extent;
use mms_mechanics::sample::domain;
use mms_program::block::{Plan, Prepared, Room, Way};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Symbol;

use crate::session::input::Input;

/// A field with numbers for its parameters.
pub struct Exact {
    input: Input,
    parameters: Vec<f64>,
    /// Its dimension.
    pub dimension: usize,
    /// Its time window.
    pub window: [f64; 2],
    body: Extent<f64>,
    prepared: BTreeMap<Quantity, Prepared<f64>>,
}

impl Exact {
    /// Of a field with `name=value` settings.
    ///
    /// # Errors
    /// Settings that it does not have.
    pub fn new(input: Input, settings: &[String]) -> anyhow::Result<Exact> {
        input.hold(settings)?;
        let parameters = input.compiled.parameters::<f64>(&input.settings(settings)?);
        let (body, window) = domain(&input.compiled.program, &parameters);
        let dimension = input.compiled.field.dimension;
        Ok(Exact { input, parameters, dimension, window, body, prepared: BTreeMap::new() })
    }

    /// The field.
    pub fn input(&self) -> &Input {
        &self.input
    }

    /// The numbers of a quantity in a point.
    pub fn components(&self, quantity: Quantity) -> usize {
        quantity.shape().components(self.dimension)
    }

    /// A quantity at points X, whose coordinates stand one after the other.
    pub fn values(&mut self, quantity: Quantity, time: f64, points: &[f64]) -> Vec<f64> {
        let (dimension, components) = (self.dimension, self.components(quantity));
        let (program, parameters) = (&self.input.compiled.program, &self.parameters);
        let prepared = self.prepared.entry(quantity).or_insert_with(|| {
            let plan = Plan::new(program, &[Output::Quantity(quantity)], Output::is_quantity);
            Prepared::new(Arc::new(plan), Way::portable(), parameters)
        });
        let count = points.len() / dimension;
        let mut values = vec![0.0; count * components];
        prepared.run(
            &mut Room::default(),
            time,
            count,
            &mut |start, inputs| {
                for (symbol, column) in inputs.columns() {
                    if let Symbol::Coordinate(axis) = symbol {
                        let coordinates =
                            points[start * dimension..].iter().skip(axis).step_by(dimension);
                        column.iter_mut().zip(coordinates).for_each(|(to, x)| *to = *x);
                    }
                }
            },
            &mut |start, outputs| {
                let room = &mut values[start * components..][..outputs.count() * components];
                for (index, component) in outputs.components(0).enumerate() {
                    component.write(room.iter_mut().skip(index).step_by(components));
                }
            },
        );
        values
    }

    /// The measure of the body: a length, an area, a volume.
    pub fn measure(&self) -> f64 {
        match &self.body {
            Extent::Box([lower, upper]) => lower.iter().zip(upper).map(|(a, b)| b - a).product(),
            Extent::Annulus([inner, outer], [first, last]) => {
                (last - first) / 2.0 * (outer * outer - inner * inner)
            }
        }
    }

    /// How far a point is outside the body; 0 within it.
    pub fn outside(&self, point: &[f64]) -> f64 {
        match (&self.body, point) {
            (Extent::Box([lower, upper]), _) => {
                let beyond =
                    point.iter().zip(lower.iter().zip(upper)).map(|(x, (a, b))| beyond(*x, *a, *b));
                beyond.map(|it| it * it).sum::<f64>().sqrt()
            }
            (Extent::Annulus([inner, outer], [first, last]), [x, y]) => {
                let radius = x.hypot(*y);
                let turned = (y.atan2(*x) - first).rem_euclid(TAU);
                let past = (turned - (last - first)).max(0.0);
                // Behind the last angle, or before the first one.
                let angle = past.min(TAU - turned).min(TAU / 4.0);
                let aside = if past > 0.0 { radius * angle.sin() } else { 0.0 };
                beyond(radius, *inner, *outer).hypot(aside)
            }
            (Extent::Annulus(..), _) => f64::INFINITY,
        }
    }
}

fn beyond(value: f64, lower: f64, upper: f64) -> f64 {
    (lower - value).max(value - upper).max(0.0)
}
