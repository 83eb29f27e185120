//! `mms eval`: numbers.

use std::borrow::Cow;

use anyhow::{Context as _, anyhow, bail};
use clap::Args;
use mms_codegen::Compiled;
use mms_codegen::compile::constant;
use mms_exact::plane::{self, Beyond, SPACE, nine};
use mms_exact::{Input, evaluated};
use mms_mechanics::extent::{Extent, is_between};
use mms_mechanics::sample::domain;
use mms_mechanics::{Output, Program};
use mms_options::field::{Variant, find_some, open, precision};
use mms_program::interpret::{Interpreter, Number, Point};
use mms_program::precise::Precise;
use mms_program::precision::Precision;
use mms_runtime::math::{Double, Scalar as _};
use mms_spec::foreign::{Foreign, shown};
use mms_spec::quantity::Quantity;
use mms_state::points::Points;
use serde::{Serialize, Serializer};
use serde_json::value::RawValue;

use super::naming::Naming;
use super::{CommandOutcome, print, print_json, say};

/// Evaluate quantities of a field at points.
///
/// Points outside the body and times outside the time window are evaluated too, with a warning on stderr. In --json,
/// outside_body lists the positions of such points, counted from 0, and outside_time is true; both keys are absent if nothing
/// is outside.
#[derive(Args)]
pub struct Eval {
    /// A name that `mms list` prints, or the path of a TOML file.
    field: String,
    /// A reference position X, such as 0.37 or -0.3,0.2; may be repeated.
    #[arg(
        long,
        value_name = "X,Y",
        required_unless_present = "points",
        conflicts_with = "points",
        allow_hyphen_values = true
    )]
    at: Vec<String>,
    /// Evaluate at the points of this file, which contains X, or x and u: CSV with a header, VTK or NumPy, recognised by its
    /// content.
    #[arg(long, value_name = "FILE")]
    points: Option<String>,
    #[command(flatten)]
    naming: Naming,
    /// The time of the evaluation; a static field needs none.
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    time: Option<String>,
    /// The quantities, separated by commas, or `all`. `all` excludes second_piola_kirchhoff, pressure, von_mises and strain:
    /// name them to get them.
    #[arg(long, value_name = "NAME", default_value = "all", value_delimiter = ',')]
    quantity: Vec<String>,
    /// Print all nine components of tensors: plane strain in two dimensions, uniaxial strain in one. F_33 is 1, and the
    /// stress out of the plane is included.
    #[arg(long)]
    all_components: bool,
    /// The reference unit normal N of the boundary, for the quantity `traction`.
    #[arg(long, value_name = "N1,N2", allow_hyphen_values = true)]
    normal: Option<String>,
    /// The face whose outward normal is used for the quantity `traction`, such as x_max or inner.
    #[arg(long, value_name = "NAME", conflicts_with = "normal")]
    face: Option<String>,
    /// Set a parameter to a value; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// The precision of the computation: f32, f64, or `wide`, which has twice the digits of f64.
    #[arg(long, default_value = Precision::F64.name(), value_parser = precision())]
    precision: Precision,
    #[command(flatten)]
    variant: Variant,
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
}

/// A number of the command line.
trait Digits: Number {
    /// The value nearest to a text; not finite where it is too large.
    fn read(text: &str) -> anyhow::Result<Self>;
    /// The nearest double precision number.
    fn near(&self) -> f64;
    /// As few digits as read back as the same number; for a number of twice the digits, as many as
    /// it has.
    fn write(&self) -> String;
}

impl Digits for f32 {
    fn read(text: &str) -> anyhow::Result<Self> {
        Ok(text.parse()?)
    }

    fn near(&self) -> f64 {
        f64::from(*self)
    }

    fn write(&self) -> String {
        format!("{self:?}")
    }
}

impl Digits for f64 {
    fn read(text: &str) -> anyhow::Result<Self> {
        Ok(text.parse()?)
    }

    fn near(&self) -> f64 {
        *self
    }

    fn write(&self) -> String {
        format!("{self:?}")
    }
}

impl Digits for Double {
    fn read(text: &str) -> anyhow::Result<Self> {
        let near: f64 = text.parse()?;
        // Texts such as `+1` or `1.`, which `f64` parses and a formula does not, are read by `f64`.
        Ok(constant(text).map_or(Double::from(near), |exact| Double::from_rational(&exact)))
    }

    fn near(&self) -> f64 {
        self.to_f64()
    }

    fn write(&self) -> String {
        // 104 bits are 31.3 decimal digits.
        Precise::from_parts(self.to_f64(), self.low()).decimal(32).unwrap_or_default()
    }
}

/// Numbers in a JSON document, with the digits that they have.
#[derive(Serialize)]
#[serde(transparent)]
struct Numbers(Vec<Box<RawValue>>);

impl Numbers {
    fn new<T: Digits>(values: &[T]) -> Self {
        Numbers(values.iter().map(Self::one).collect())
    }

    fn one<T: Digits>(value: &T) -> Box<RawValue> {
        RawValue::from_string(value.write()).unwrap_or_else(|_| RawValue::NULL.to_owned())
    }
}

/// The names and values at one point, in order.
struct Record(Vec<(&'static str, Numbers)>);

impl Serialize for Record {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, numbers)| (name, numbers)))
    }
}

#[derive(Serialize)]
struct Document<'a> {
    field: &'a Foreign,
    time: Box<RawValue>,
    precision: &'static str,
    form: &'static str,
    points: Vec<Record>,
    #[serde(flatten)]
    outside: Outside,
}

/// The points and times outside the domain of a field's claims and proofs: positions of points outside the body, and whether
/// the time is outside the window. The keys are absent if nothing is outside.
#[derive(Serialize)]
struct Outside {
    #[serde(skip_serializing_if = "Vec::is_empty")]
    outside_body: Vec<usize>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    outside_time: bool,
}

impl Eval {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        let own = open(&self.field)?.own_quantities();
        let quantities = evaluated(&own, &self.quantity)?;
        let mut derived = quantities.clone();
        if self.all_components {
            derived.extend(plane::NEEDED);
        }
        let input = find_some(&self.field, &self.variant, &derived)?;
        let quantities = input.offered(&self.quantity, quantities)?;
        self.validate_normal(&quantities)?;
        match self.precision {
            Precision::F32 => self.evaluate::<f32>(&input, &quantities),
            Precision::F64 => self.evaluate::<f64>(&input, &quantities),
            Precision::Wide => self.evaluate::<Double>(&input, &quantities),
        }
    }

    fn evaluate<T: Digits>(
        &self,
        input: &Input,
        quantities: &[Quantity],
    ) -> anyhow::Result<CommandOutcome> {
        let given = self.time_text(input)?;
        let time = T::read(given).with_context(|| format!("`--time {given}`"))?;
        if !time.near().is_finite() {
            bail!("`--time {given}`: expected a finite number");
        }
        let dimension = input.compiled.field.dimension;
        let parameters = input.compiled.parameters::<T>(&input.settings(&self.set)?);
        let near: Vec<f64> = parameters.iter().map(T::near).collect();
        let (body, _) = domain(&input.compiled.program, &near);
        let points = self.places::<T>(input, &body)?;
        let outside = self.outside(input, &parameters, &points, &time);
        let normals = self.normals(input, quantities, &parameters, &points)?;
        let programs = programs(input, &self.needed(quantities, &input.compiled))?;
        let prepared = programs.iter().map(|(program, outputs)| {
            let mut interpreter = Interpreter::new(&**program, &parameters);
            interpreter.set_time(&time);
            (interpreter.plan(outputs), interpreter)
        });
        let mut prepared: Vec<_> = prepared.collect();
        let mut records = Vec::new();
        for (index, (coordinates, normal)) in points.iter().zip(&normals).enumerate() {
            for (plan, interpreter) in &mut prepared {
                interpreter.set_point(plan, Point { coordinates, normal, gradient: &[] });
            }
            let mut record = Record(vec![("at", Numbers::new(coordinates))]);
            for quantity in quantities {
                let of = |quantity: Quantity| -> anyhow::Result<Vec<T>> {
                    let output = Output::Quantity(quantity);
                    let has = |(_, outputs): &(_, Vec<_>)| outputs.contains(&output);
                    let at =
                        programs.iter().position(has).context("each quantity has a program")?;
                    Ok(prepared[at].1.output(output))
                };
                let components = match self.beyond(*quantity, &input.compiled) {
                    Some(beyond) => all_components(of, *quantity, beyond, dimension)?,
                    None => of(*quantity)?,
                };
                self.ensure_finite(input, *quantity, (index, coordinates), &components)?;
                record.0.push((quantity.name(), Numbers::new(&components)));
            }
            records.push(record);
        }
        if self.json {
            print_json(&Document {
                field: &input.name,
                time: Numbers::one(&time),
                precision: self.precision.name(),
                form: self.variant.form().name(),
                points: records,
                outside,
            })?;
        } else {
            print(&text(&records))?;
        }
        Ok(CommandOutcome::AsExpected)
    }

    /// The components of a tensor beyond the dimension of the field, if they were requested.
    fn beyond(&self, quantity: Quantity, compiled: &Compiled) -> Option<Beyond> {
        let is_asked = self.all_components && compiled.field.space.rows() < SPACE;
        Beyond::of(quantity, &compiled.model.kind).filter(|_| is_asked)
    }

    /// The quantities that are wanted, and those that stresses out of the plane follow from.
    fn needed(&self, quantities: &[Quantity], compiled: &Compiled) -> Vec<Quantity> {
        let mut needed = quantities.to_vec();
        let beyond = quantities.iter().filter_map(|it| self.beyond(*it, compiled));
        if beyond.into_iter().any(Beyond::is_stress) {
            needed.extend(plane::NEEDED);
        }
        needed.sort();
        needed.dedup();
        needed
    }

    /// The time as it is given; 0 in a static field.
    ///
    /// # Errors
    /// None is given, and the field moves.
    fn time_text(&self, input: &Input) -> anyhow::Result<&str> {
        match &self.time {
            Some(time) => Ok(time),
            None if input.is_static() => Ok("0"),
            None => bail!("`{}` moves: give the time with `--time T`", input.name.shown()),
        }
    }

    /// Warns of points outside the body, and of a time outside the window.
    fn outside<T: Digits>(
        &self,
        input: &Input,
        parameters: &[T],
        points: &[Vec<T>],
        time: &T,
    ) -> Outside {
        let near = |values: &[T]| values.iter().map(T::near).collect::<Vec<f64>>();
        let (body, [first, last]) = domain(&input.compiled.program, &near(parameters));
        let is_outside = |(_, point): &(usize, &Vec<T>)| !body.contains(&near(point));
        let points = points.iter().enumerate().filter(is_outside);
        let outside_body: Vec<_> = points.map(|(index, _)| index).collect();
        let outside_time = !input.is_static() && !is_between(first, last, time.near());
        self.warn_of_points(input, &outside_body);
        if outside_time {
            say(format_args!(
                "warning: `--time {}` is outside the time window, {first:?} to {last:?}: nothing is claimed or proved of \
                 `{}` at that time",
                self.time.as_deref().unwrap_or_default(),
                input.name.shown()
            ));
        }
        Outside { outside_body, outside_time }
    }

    /// The requested points.
    fn places<T: Digits>(&self, input: &Input, body: &Extent<f64>) -> anyhow::Result<Vec<Vec<T>>> {
        let dimension = input.compiled.field.dimension;
        let Some(path) = &self.points else {
            return self.at.iter().map(|at| coordinates("--at", at, dimension)).collect();
        };
        let names = self.naming.names(Some(input))?;
        // The body decides between X and x; points outside it are evaluated all the same.
        let points =
            Points::of_file(path, &names, dimension, &|point: &[f64]| body.distance(point))
                .or_else(|_| Points::of_file(path, &names, dimension, &|_: &[f64]| 0.0))?;
        let point = |point: &[f64]| point.iter().map(|it| T::from_f64(*it)).collect();
        Ok(points.reference.chunks(dimension).map(point).collect())
    }

    /// Warns of each point outside the body; once for all points of a file.
    fn warn_of_points(&self, input: &Input, outside: &[usize]) {
        let claims = format!(
            "outside the body: nothing is claimed or proved of `{}` there",
            input.name.shown()
        );
        match (&self.points, outside) {
            (_, []) => {}
            (Some(path), [first, ..]) => say(format_args!(
                "warning: `--points {}`: {} of its points, the first with the number {first}, counted from 0, \
                 lie {claims}",
                shown(path),
                outside.len()
            )),
            (None, _) => outside.iter().for_each(|index| {
                say(format_args!("warning: `--at {}` is {claims}", self.at[*index]));
            }),
        }
    }

    /// Refuses a normal that no quantity takes.
    fn validate_normal(&self, quantities: &[Quantity]) -> anyhow::Result<()> {
        let given = [("--normal", &self.normal), ("--face", &self.face)];
        match given.into_iter().find(|(_, value)| value.is_some()) {
            Some((option, Some(value))) if !quantities.iter().any(|it| it.takes_normal()) => bail!(
                "`{option} {value}`: only tractions and normal fluxes take a normal, and no such quantity is requested; \
                 name it, as in `--quantity traction`, or leave `{option}` out"
            ),
            _ => Ok(()),
        }
    }

    /// The unit normals at the points; without components where none is needed.
    fn normals<T: Digits>(
        &self,
        input: &Input,
        quantities: &[Quantity],
        parameters: &[T],
        points: &[Vec<T>],
    ) -> anyhow::Result<Vec<Vec<T>>> {
        let dimension = input.compiled.field.dimension;
        Ok(match (&self.normal, &self.face) {
            (Some(normal), _) => vec![unit(normal, dimension)?; points.len()],
            (None, Some(name)) => {
                let face = input.compiled.face(name);
                let face = face.map_err(|mistake| anyhow!("`--face {name}`: {mistake}"))?;
                input.compiled.normals(face, parameters, points)
            }
            (None, None) => match quantities.iter().find(|it| it.takes_normal()) {
                Some(quantity) => bail!(
                    "`{}` needs the reference normal of a boundary: give --face or --normal",
                    quantity.name()
                ),
                None => vec![Vec::new(); points.len()],
            },
        })
    }

    fn ensure_finite<T: Digits>(
        &self,
        input: &Input,
        quantity: Quantity,
        (index, at): (usize, &[T]),
        components: &[T],
    ) -> anyhow::Result<()> {
        let odd = components.iter().map(T::near).find(|component| !component.is_finite());
        match odd {
            None => Ok(()),
            Some(odd) => bail!(
                "{} of `{}` is {odd} at X = {}, t = {}: not defined there, or beyond the range of {}",
                quantity.name(),
                input.name.shown(),
                self.at.get(index).cloned().unwrap_or_else(|| written(at)),
                self.time.as_deref().unwrap_or("0"),
                self.precision.name()
            ),
        }
    }
}

/// A tensor in space.
fn all_components<T: Digits>(
    of: impl Fn(Quantity) -> anyhow::Result<Vec<T>>,
    quantity: Quantity,
    beyond: Beyond,
    dimension: usize,
) -> anyhow::Result<Vec<T>> {
    let one = || vec![T::from_f64(1.0)];
    let [stress, pressure, jacobian] = match beyond.is_stress() {
        true => plane::NEEDED.map(&of),
        false => [Ok(one()), Ok(one()), Ok(one())],
    };
    let value = beyond.value(&stress?, &pressure?[0], &jacobian?[0]);
    Ok(nine(&of(quantity)?, dimension, &value))
}

/// The programs of some quantities: one of all that the field was compiled with, and one of each that is derived on request.
fn programs<'a>(
    input: &'a Input,
    quantities: &[Quantity],
) -> anyhow::Result<Vec<(Cow<'a, Program>, Vec<Output>)>> {
    let compiled = quantities.iter().filter(|quantity| !quantity.is_on_request());
    let outputs = compiled.map(|quantity| Output::Quantity(*quantity)).collect();
    let mut programs = vec![(Cow::Borrowed(&input.compiled.program), outputs)];
    for quantity in quantities {
        let own = input.on_request(*quantity)?;
        programs.extend(own.map(|it| (Cow::Owned(it), vec![Output::Quantity(*quantity)])));
    }
    Ok(programs)
}

/// A point of a file, as it would be given.
fn written<T: Digits>(at: &[T]) -> String {
    at.iter().map(T::write).collect::<Vec<_>>().join(",")
}

/// A unit vector.
fn unit<T: Digits>(normal: &str, dimension: usize) -> anyhow::Result<Vec<T>> {
    let components = coordinates::<T>("--normal", normal, dimension)?;
    let squared: f64 = components.iter().map(|component| component.near().powi(2)).sum();
    if (squared - 1.0).abs() > 1e-6 {
        bail!("`--normal`: expected a unit vector, found one of length {}", squared.sqrt());
    }
    Ok(components)
}

fn coordinates<T: Digits>(option: &str, text: &str, dimension: usize) -> anyhow::Result<Vec<T>> {
    let components = text
        .split(',')
        .map(|component| {
            let value = T::read(component.trim())
                .with_context(|| format!("`{option} {text}`: `{component}` is not a number"))?;
            if !value.near().is_finite() {
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

fn text(points: &[Record]) -> String {
    let names = points.iter().flat_map(|point| &point.0).map(|(name, _)| name.len());
    let width = names.max().unwrap_or(0);
    let mut text = String::new();
    for (index, point) in points.iter().enumerate() {
        if index > 0 {
            text.push('\n');
        }
        for (name, numbers) in &point.0 {
            let numbers: Vec<_> = numbers.0.iter().map(|number| number.get()).collect();
            text.push_str(&format!("{name:width$}  {}\n", numbers.join("  ")));
        }
    }
    text
}
