//! `mms eval`: numbers.

use anyhow::{Context as _, bail};
use clap::Args;
use mms_codegen::program::Output;
use mms_codegen::program::interpret::{Interpreter, Number, Point};
use mms_codegen::quantity::Quantity;
use mms_runtime::Real;
use serde_json::{Map, Value, json};

use super::input::{Bound, Input, quantities};
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
    /// Set a parameter; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// The precision to compute in.
    #[arg(long, value_enum, default_value_t)]
    precision: Precision,
    #[command(flatten)]
    bound: Bound,
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
        let input = Input::find(&self.field, self.bound)?;
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
        let normal = match &self.normal {
            Some(normal) => coordinates::<T>("--normal", normal, dimension)?,
            None if quantities.contains(&Quantity::Traction) => {
                bail!("`traction` needs the reference normal of a boundary: give --normal")
            }
            None => Vec::new(),
        };
        let squared: f64 = normal.iter().map(|component| component.to_f64().powi(2)).sum();
        if !normal.is_empty() && (squared - 1.0).abs() > 1e-6 {
            bail!("`--normal`: expected a unit vector, found one of length {}", squared.sqrt());
        }
        let parameters = input.compiled.parameters::<T>(&input.settings(&self.set)?);
        if !self.time.is_finite() {
            bail!("`--time {}`: expected a finite number", self.time);
        }
        let mut interpreter = Interpreter::new(&input.compiled.program, &parameters);
        interpreter.set_time(&T::of(self.time));
        let outputs: Vec<_> =
            quantities.iter().map(|quantity| Output::Quantity(*quantity)).collect();
        let plan = interpreter.plan(&outputs);
        let mut results = Vec::new();
        for (coordinates, at) in points.iter().zip(&self.at) {
            interpreter.set_point(&plan, Point { coordinates, normal: &normal, gradient: &[] });
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
