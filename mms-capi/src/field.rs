//! A field, compiled and interpreted: the complete C interface in safe Rust.

use std::ffi::CString;
use std::mem;
use std::sync::OnceLock;

use mms_codegen::compile::fast_check::FastParameterCheck;
use mms_codegen::compile_with;
use mms_codegen::selection::compiled_quantity;
use mms_codegen::{Compiled, Options};
use mms_mechanics::boundary::Datum;
use mms_mechanics::{Bound, Output};
use mms_program::interpret::{Interpreter, Point};
use mms_spec::Face;
use mms_spec::quantity::Quantity;
use mms_spec::suggest::advice;
use mms_symbolic::expr::Rational;
use mms_symbolic::sorted::SortedMap;

use crate::border::on_own_stack;
use crate::error::{Error, MmsCode};
use crate::evaluator::{BLOCK, Evaluator};
use crate::settings::Settings;
use crate::stop::Stop;

/// The tolerance of the length of a normal.
const UNIT: f64 = 1e-6;

/// A field and the values of its parameters.
#[derive(Debug)]
pub struct Field {
    compiled: Compiled,
    settings: Settings<SortedMap<usize, Rational>>,
    evaluator: Evaluator,
    /// The bounds within which every value is allowed; computed when a parameter is first set.
    quick: OnceLock<Option<FastParameterCheck>>,
    /// The name for C programs, with a NUL at the end.
    pub name: CString,
    /// The title.
    pub title: CString,
    /// The names of the parameters, in the order of the file.
    pub parameters: Vec<CString>,
    /// The names of the faces.
    pub faces: Vec<CString>,
    /// The names of the quantities that the file defines.
    pub own: Vec<CString>,
}

impl Field {
    /// Compiles the field of a text. Messages call it `name`; `material` is the text of its material, unless that ships.
    pub fn compile(
        name: &str,
        text: &str,
        material: Option<&str>,
        stop: &Stop,
    ) -> Result<Self, Error> {
        let made = on_own_stack(|| Field::compile_here(name, text, material, stop));
        // The result of stopped work may look like a mistake, or like a field.
        stop.check().and(made)
    }

    fn compile_here(
        name: &str,
        text: &str,
        material: Option<&str>,
        stop: &Stop,
    ) -> Result<Self, Error> {
        let load = |_: &str| {
            material
                .map(String::from)
                .ok_or_else(|| "the text of the material was not given".into())
        };
        let options = Options { stop: stop.of_compiler(), ..Options::default() };
        let mut compiled = compile_with(name, &format!("{name}.toml"), text, &load, &options)
            .map_err(|failure| Error::new(MmsCode::InvalidField, failure))?;
        // A later request to stop other work must not stop this field.
        compiled.graph = mem::take(&mut compiled.graph).stopped_by(&Default::default());
        let shown = |text: &str| {
            CString::new(text).map_err(|error| {
                Error::new(MmsCode::InvalidField, format!("{text:?} cannot be shown: {error}"))
            })
        };
        let faces = Face::of(&compiled.field.domain.body, compiled.field.space);
        let parameters = compiled.model.parameters.iter();
        let own = compiled.model.own.keys();
        Ok(Field {
            name: shown(name)?,
            title: shown(compiled.field.title.raw())?,
            parameters: parameters.map(|it| shown(&it.name)).collect::<Result<_, _>>()?,
            faces: faces.iter().map(|face| shown(face.name())).collect::<Result<_, _>>()?,
            own: own.map(|own| shown(&own.name)).collect::<Result<_, _>>()?,
            settings: Settings::new(compiled.parameters(&SortedMap::new())),
            evaluator: Evaluator::new(compiled.quantities()),
            quick: OnceLock::new(),
            compiled,
        })
    }

    /// The number of coordinates of a point.
    pub fn dimension(&self) -> usize {
        self.compiled.field.dimension
    }

    /// The quantity of a name.
    fn find(&self, name: &str) -> Result<Quantity, Error> {
        let own: Vec<_> = self.compiled.model.own.keys().copied().collect();
        compiled_quantity(&own, name).map_err(|mistake| Error::new(MmsCode::UnknownName, mistake))
    }

    /// The number of components of a quantity.
    pub fn components(&self, name: &str) -> Result<usize, Error> {
        Ok(self.size(self.find(name)?))
    }

    fn size(&self, quantity: Quantity) -> usize {
        self.compiled.field.space.components(quantity.shape())
    }

    /// The value of a parameter.
    pub fn parameter(&self, name: &str) -> Result<f64, Error> {
        Ok(self.settings.now()[self.position(name)?])
    }

    /// Sets all parameters, or none if the field does not allow that. Parameters that depend on them and were not set change,
    /// too. Stops reading at the first mistake, so that it reads at most one setting more than there are parameters.
    pub fn set<'a>(
        &self,
        settings: impl IntoIterator<Item = Result<(&'a str, f64), Error>>,
    ) -> Result<(), Error> {
        let refuse = |message| Err(Error::new(MmsCode::InvalidParameter, message));
        let mut new = SortedMap::new();
        for setting in settings {
            let (name, value) = setting?;
            let Ok(exact) = Rational::try_from(value) else {
                return refuse(format!("`{name}` = {value}: expected a finite number"));
            };
            if new.insert(self.position(name)?, exact).is_some() {
                return refuse(format!("`{name}` is set twice"));
            }
        }
        self.settings.change(new, |set| self.accepted(set))
    }

    /// The values of all parameters if some are set and the field allows them.
    fn accepted(&self, set: &SortedMap<usize, Rational>) -> Result<Vec<f64>, Error> {
        let quick = self.quick.get_or_init(|| FastParameterCheck::new(&self.compiled));
        if let Some(all) = quick.as_ref().and_then(|quick| quick.accepted(set)) {
            return Ok(all);
        }
        self.compiled
            .accepts(set)
            .map_err(|failure| Error::new(MmsCode::InvalidParameter, failure))?;
        Ok(self.compiled.parameters(set))
    }

    /// Evaluates a quantity at points of `dimension` coordinates each. `normals` has one for each point if the quantity is the
    /// traction, and is not read otherwise. `put` gets the components of each point in turn, tensors in rows, up to the point
    /// where this fails or is stopped.
    pub fn evaluate(
        &self,
        name: &str,
        time: f64,
        points: &[f64],
        normals: Option<&[f64]>,
        stop: Option<&Stop>,
        mut put: impl FnMut(&[f64]),
    ) -> Result<(), Error> {
        let quantity = self.find(name)?;
        let offered = self.compiled.validate_offered(quantity);
        offered.map_err(|mistake| Error::new(MmsCode::UnknownName, mistake))?;
        let dimension = self.dimension();
        finite("the time", &[time])?;
        let normals = match (quantity.takes_normal(), normals) {
            (true, Some(normals)) => normals,
            (true, None) => {
                let name = quantity.name();
                let message = format!("`{name}` needs the reference unit normal at each point");
                return Err(Error::new(MmsCode::InvalidArgument, message));
            }
            _ => &[],
        };
        let components = self.size(quantity);
        let parameters = self.settings.now();
        self.evaluator.with(&self.compiled.program, quantity, &parameters, |ready| {
            for (block, points) in points.chunks(BLOCK * dimension).enumerate() {
                stop.map_or(Ok(()), Stop::check)?;
                let first = block * BLOCK;
                let normals = match normals {
                    [] => &[][..],
                    normals => &normals[first * dimension..][..points.len()],
                };
                let (count, mistake) = self.sound(first, points, normals);
                let ends = |numbers: &[f64]| numbers.len().min(count * dimension);
                let (points, normals) = (&points[..ends(points)], &normals[..ends(normals)]);
                let values = ready.evaluate(time, dimension, [points, normals], components);
                let undefined = self.undefined(first, quantity, time, points, values);
                let found = undefined.as_ref().map_or(count, |(index, _)| *index);
                put(&values[..found * components]);
                undefined.map(|(_, error)| error).or(mistake).map_or(Ok(()), Err)?;
            }
            Ok(())
        })
    }

    /// The number of points before the first invalid one, or the first with an invalid normal, and its error; `first` is the
    /// index of the first point among all.
    fn sound(&self, first: usize, points: &[f64], normals: &[f64]) -> (usize, Option<Error>) {
        let dimension = self.dimension();
        let count = points.len() / dimension;
        if are_finite(points) && normals.is_empty() {
            return (count, None);
        }
        for (index, coordinates) in points.chunks_exact(dimension).enumerate() {
            let normal = normals.get(index * dimension..(index + 1) * dimension);
            let held = finite(&format!("point {}", first + index), coordinates)
                .and_then(|()| normal.map_or(Ok(()), |normal| unit(first + index, normal)));
            if let Err(mistake) = held {
                return (index, Some(mistake));
            }
        }
        (count, None)
    }

    /// The first point of a block where a value is not finite, and its error.
    fn undefined(
        &self,
        first: usize,
        quantity: Quantity,
        time: f64,
        points: &[f64],
        values: &[f64],
    ) -> Option<(usize, Error)> {
        if are_finite(values) {
            return None;
        }
        let place = values.iter().position(|value| !value.is_finite())?;
        let dimension = self.dimension();
        let index = place / self.size(quantity);
        let message = format!(
            "{} of `{}` is {} at point {}, X = {:?}, t = {time:?}: not defined there, or beyond the range of a double",
            quantity.name(),
            self.compiled.field.name.shown(),
            values[place],
            first + index,
            &points[index * dimension..][..dimension],
        );
        Some((index, Error::new(MmsCode::NotFinite, message)))
    }

    /// Computes the outward reference unit normals of a face at points of it: `put` gets each in turn.
    pub fn normals(
        &self,
        face: &str,
        points: &[f64],
        mut put: impl FnMut(&[f64]),
    ) -> Result<(), Error> {
        let known = self.compiled.face(face).map_err(|mistake| {
            Error::new(MmsCode::UnknownName, format!("no face `{face}`: {mistake}"))
        })?;
        let program = self.compiled.normal(known);
        let output = Output::Face(known, Datum::Normal);
        let mut interpreter = Interpreter::new(&program, &self.settings.now());
        let plan = interpreter.plan(&[output]);
        for (index, point) in points.chunks_exact(self.dimension()).enumerate() {
            finite(&format!("point {index}"), point)?;
            interpreter.set_point(&plan, Point::at(point));
            let normal = interpreter.output(output);
            if normal.iter().any(|component| !component.is_finite()) {
                let message =
                    format!("point {index} is not on a face `{face}`, which has no normal there");
                return Err(Error::new(MmsCode::NotFinite, message));
            }
            put(&normal);
        }
        Ok(())
    }

    /// A bound of the body or of the time window.
    pub fn bound(&self, name: &str) -> Result<Vec<f64>, Error> {
        let named = |bound: Bound| match bound {
            Bound::Time => "time",
            Bound::Z => "z",
            bound => bound.name(),
        };
        let program = &self.compiled.program;
        let there = |bound: &Bound| {
            *bound != Bound::Space && program.outputs.contains_key(&Output::Bound(*bound))
        };
        let known = Bound::ALL.into_iter().filter(there).map(|bound| (named(bound), bound));
        let known: Vec<_> = known.collect();
        let Some((_, bound)) = known.iter().find(|(known, _)| *known == name) else {
            let names = known.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
            let message = format!("no bound `{name}`: this body has {names}");
            return Err(Error::new(MmsCode::UnknownName, message));
        };
        Ok(Interpreter::new(program, &self.settings.now()).output(Output::Bound(*bound)))
    }

    fn position(&self, name: &str) -> Result<usize, Error> {
        let parameters = &self.compiled.model.parameters;
        let names = || parameters.iter().map(|parameter| parameter.name.as_str());
        names().position(|known| known == name).ok_or_else(|| {
            let advice = advice(name, names(), |all| format!("the field has {all}"));
            Error::new(MmsCode::UnknownName, format!("no parameter `{name}`; {advice}"))
        })
    }
}

/// Whether all numbers are finite, without a branch for each.
fn are_finite(numbers: &[f64]) -> bool {
    numbers.iter().fold(true, |all, number| all & number.is_finite())
}

fn finite(what: &str, numbers: &[f64]) -> Result<(), Error> {
    match numbers.iter().find(|number| !number.is_finite()) {
        None => Ok(()),
        Some(odd) => {
            let message = format!("{what} has {odd}: expected finite numbers");
            Err(Error::new(MmsCode::InvalidArgument, message))
        }
    }
}

/// Refuses a normal that is not a unit vector.
fn unit(index: usize, normal: &[f64]) -> Result<(), Error> {
    let squared: f64 = normal.iter().map(|component| component * component).sum();
    if (squared - 1.0).abs() <= UNIT {
        return Ok(());
    }
    let message = format!(
        "the normal at point {index} has the length {}: expected a unit vector",
        squared.sqrt()
    );
    Err(Error::new(MmsCode::InvalidArgument, message))
}
