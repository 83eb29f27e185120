//! The exact solution at many points.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;

use mms_mechanics::extent::Extent;
use mms_mechanics::sample::domain;
use mms_mechanics::{Output, Response};
use mms_program::block::{Plan, Prepared, Room, Way};
use mms_spec::Face;
use mms_spec::quantity::Quantity;

use super::input::Input;

/// A field with numbers for its parameters.
pub struct Exact {
    input: Input,
    parameters: Vec<f64>,
    /// Its dimension.
    pub dimension: usize,
    /// Its time window.
    pub window: [f64; 2],
    /// Its body.
    pub body: Extent<f64>,
    prepared: BTreeMap<Output, Prepared<f64>>,
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

    /// The edge of a cube (square, length) that each of so many points has of the body.
    pub fn spacing(&self, points: usize) -> f64 {
        (self.body.measure() / points as f64).powf(1.0 / self.dimension as f64)
    }

    /// Its name and its title, for a person.
    pub fn title(&self) -> String {
        format!("{}: {}", self.input.name.shown(), self.input.compiled.field.title.shown())
    }

    /// The numbers of a quantity in a point.
    pub fn components(&self, quantity: Quantity) -> usize {
        quantity.shape().components(self.dimension)
    }

    /// A quantity at points X, whose coordinates stand one after the other.
    ///
    /// # Errors
    /// A quantity on request that is too large to derive.
    pub fn values(
        &mut self,
        quantity: Quantity,
        time: f64,
        points: &[f64],
    ) -> anyhow::Result<Vec<f64>> {
        let components = self.components(quantity);
        self.output(Output::Quantity(quantity), components, time, [points, &[]])
    }

    /// rho0 at points X.
    ///
    /// # Errors
    /// As of [`values`](Self::values).
    pub fn densities(&mut self, points: &[f64]) -> anyhow::Result<Vec<f64>> {
        let time = self.window[0];
        self.output(Output::Response(Response::Density), 1, time, [points, &[]])
    }

    /// The tractions of a face at points X of it.
    ///
    /// # Errors
    /// As of [`values`](Self::values).
    pub fn tractions(&mut self, face: Face, time: f64, points: &[f64]) -> anyhow::Result<Vec<f64>> {
        let dimension = self.dimension;
        let normals =
            self.input.compiled.normals(face, &self.parameters, points.chunks(dimension)).concat();
        self.output(Output::Quantity(Quantity::Traction), dimension, time, [points, &normals])
    }

    fn output(
        &mut self,
        output: Output,
        components: usize,
        time: f64,
        [points, normals]: [&[f64]; 2],
    ) -> anyhow::Result<Vec<f64>> {
        let prepared = match self.prepared.entry(output) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => place.insert(prepared(&self.input, &self.parameters, output)?),
        };
        let dimension = self.dimension;
        let mut values = vec![0.0; points.len() / dimension * components];
        prepared.at_points(&mut Room::default(), time, dimension, [points, normals], &mut values);
        Ok(values)
    }
}

fn prepared(input: &Input, parameters: &[f64], output: Output) -> anyhow::Result<Prepared<f64>> {
    let own = match output {
        Output::Quantity(quantity) => input.on_request(quantity)?,
        _ => None,
    };
    let program = own.as_ref().unwrap_or(&input.compiled.program);
    let plan = Plan::new(program, &[output], Output::is_quantity);
    Ok(Prepared::new(Arc::new(plan), Way::portable(), parameters))
}
