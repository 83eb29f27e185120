//! `mms eval`: numbers.

use anyhow::{Context as _, bail};
use clap::Args;
use mms_codegen::Compiled;
use mms_codegen::mechanics::boundary::Datum;
use mms_codegen::program::Output;
use mms_codegen::program::interpret::{Interpreter, Number, Point};
use mms_codegen::quantity::Quantity;
use mms_codegen::spec::Face;
use mms_codegen::suggest::did_you_mean;
use mms_runtime::Real;
use serde_json::{Map, Value, json};

use super::input::{Input, Variant, quantities};
use super::{Outcome, print, print_json};

/// Evaluate quantities of a field at points.
#[derive(Args)]
pub struct Eval {
    /// A gallery name, or a path to a TOML file.
    field: String,
    /// A reference position, such as 0.37 or -0.3,0.2; may be repeated.
    #[arg(long, value_name = "X,Y", required = true, allow_hyphen_values = true)]
    at: Vec<String>,
    /// The time.
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    time: f64,
    /// Quantities, separated by commas, or `all`.
    #[arg(long, value_name = "NAME", default_value = "all", value_delimiter = ',')]
    quantity: Vec<String>,
    /// The reference unit normal of the boundary, for the quantity `traction`.
    #[arg(long, value_name = "N1,N2", allow_hyphen_values = true)]
    normal: Option<String>,
    /// The face whose outward normal to take, such as x_max or inner, for the quantity `traction`.
    #[arg(long, value_name = "NAME", conflicts_with = "normal")]
    face: Option<String>,
    /// Set a parameter; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// The precision to compute in.
    #[arg(long, value_enum, default_value_t)]
    precision: Precision,
    #[command(flatten)]
    variant: Variant,
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
}

/// The precision of a computation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Precision {
    /// Single.
    F32,
    /// Double.
    #[default]
    F64,
}

impl Precision {
    /// The word of the command line.
    pub fn name(self) -> &'static str {
        match self {
            Precision::F32 => "f32",
            Precision::F64 => "f64",
        }
    }
}

impl Eval {
    pub fn run(self) -> anyhow::Result<Outcome> {
        let input = Input::find(&self.field, &self.variant)?;
        let quantities = quantities(&self.quantity)?;
        match self.precision {
            Precision::F32 => self.evaluate::<f32>(&input, &quantities),
            Precision::F64 => self.evaluate::<f64>(&input, &quantities),
        }
    }

    fn evaluate<T: Real + Number>(
        &self,
        input: &Input,
        quantities: &[Quantity],
    ) -> anyhow::Result<Outcome> {
        let dimension = input.compiled.field.dimension;
        let points = self
            .at
            .iter()
            .map(|at| coordinates::<T>("--at", at, dimension))
            .collect::<anyhow::Result<Vec<_>>>()?;
        let parameters = input.compiled.parameters::<T>(&input.settings(&self.set)?);
        let normals = match (&self.normal, &self.face) {
            (Some(normal), _) => vec![unit(normal, dimension)?; points.len()],
            (None, Some(face)) => normals(&input.compiled, face, &parameters, &points)?,
            (None, None) if quantities.contains(&Quantity::Traction) => {
                bail!(
                    "`traction` needs the reference normal of a boundary: give --face or --normal"
                )
            }
            (None, None) => vec![Vec::new(); points.len()],
        };
        if !self.time.is_finite() {
            bail!("`--time {}`: expected a finite number", self.time);
        }
        let mut interpreter = Interpreter::new(&input.compiled.program, &parameters);
        interpreter.set_time(&T::of(self.time));
        let outputs: Vec<_> =
            quantities.iter().map(|quantity| Output::Quantity(*quantity)).collect();
        let plan = interpreter.plan(&outputs);
        let mut results = Vec::new();
        for ((coordinates, at), normal) in points.iter().zip(&self.at).zip(&normals) {
            interpreter.set_point(&plan, Point { coordinates, normal, gradient: &[] });
            let mut values = Map::new();
            values.insert("at".into(), numbers(coordinates));
            for quantity in quantities {
                let components = interpreter.output(Output::Quantity(*quantity));
                if let Some(odd) = components.iter().find(|component| !component.is_finite()) {
                    bail!(
                        "{} of `{}` is {} at X = {at}, t = {}: not defined there, or beyond the range of {}",
                        quantity.name(),
                        input.name,
                        odd.to_f64(),
                        self.time,
                        self.precision.name()
                    );
                }
                values.insert(quantity.name().into(), numbers(&components));
            }
            results.push(values);
        }
        if self.json {
            print_json(&json!({ "field": input.name, "time": self.time, "points": results }))?;
        } else {
            print(&text(&results))?;
        }
        Ok(Outcome::AsExpected)
    }
}

/// A unit vector.
fn unit<T: Real>(normal: &str, dimension: usize) -> anyhow::Result<Vec<T>> {
    let components = coordinates::<T>("--normal", normal, dimension)?;
    let squared: f64 = components.iter().map(|component| component.to_f64().powi(2)).sum();
    if (squared - 1.0).abs() > 1e-6 {
        bail!("`--normal`: expected a unit vector, found one of length {}", squared.sqrt());
    }
    Ok(components)
}

/// The outward normals of a face at points of it.
fn normals<T: Real + Number>(
    compiled: &Compiled,
    face: &str,
    parameters: &[T],
    points: &[Vec<T>],
) -> anyhow::Result<Vec<Vec<T>>> {
    let faces = Face::of(&compiled.field.domain.body, compiled.field.dimension);
    let names = || faces.iter().map(|face| face.name());
    let Some(face) = faces.iter().find(|known| known.name() == face) else {
        match did_you_mean(face, names()) {
            Some(near) => bail!("`--face {face}`: no such face; did you mean `{near}`?"),
            None => {
                bail!("`--face {face}`: this body has {}", names().collect::<Vec<_>>().join(", "))
            }
        }
    };
    let program = compiled.normal(*face);
    let output = Output::Face(*face, Datum::Normal);
    let mut interpreter = Interpreter::new(&program, parameters);
    let plan = interpreter.plan(&[output]);
    let normals = points.iter().map(|point| {
        interpreter.set_point(&plan, Point::at(point));
        interpreter.output(output)
    });
    Ok(normals.collect())
}

fn coordinates<T: Real>(option: &str, text: &str, dimension: usize) -> anyhow::Result<Vec<T>> {
    let components = text
        .split(',')
        .map(|component| {
            let value: f64 = component
                .trim()
                .parse()
                .with_context(|| format!("`{option} {text}`: `{component}` is not a number"))?;
            let value = T::of(value);
            if !value.is_finite() {
                bail!("`{option} {text}`: `{component}` is not a finite number");
            }
            Ok(value)
        })
        .collect::<anyhow::Result<Vec<T>>>()?;
    if components.len() != dimension {
        bail!(
            "`{option} {text}`: expected {dimension} component(s) for a field of dimension {dimension}, found {}",
            components.len()
        );
    }
    Ok(components)
}

/// The shortest digits that read back as the same numbers in their own precision.
fn numbers<T: Real>(values: &[T]) -> Value {
    let number = |value: &T| value.to_string().parse::<f64>().map_or(Value::Null, Value::from);
    values.iter().map(number).collect()
}

fn text(points: &[Map<String, Value>]) -> String {
    let width = points.iter().flat_map(|point| point.keys()).map(String::len).max().unwrap_or(0);
    let mut text = String::new();
    for (index, point) in points.iter().enumerate() {
        if index > 0 {
            text.push('\n');
        }
        for (name, values) in point {
            let values: Vec<_> =
                values.as_array().into_iter().flatten().map(Value::to_string).collect();
            text.push_str(&format!("{name:width$}  {}\n", values.join("  ")));
        }
    }
    text
}
