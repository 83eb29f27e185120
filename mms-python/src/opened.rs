//! A field with numbers for its parameters: all its outputs, each prepared at its first use.

use std::borrow::Cow;
use std::sync::{Arc, Mutex, PoisonError};

use dashu_ratio::RBig;
use mms_codegen::Compiled;
use mms_codegen::compile::constant;
use mms_exact::Input;
use mms_mechanics::boundary::Datum;
use mms_mechanics::{Output, Response};
use mms_program::Op;
use mms_program::interpret::Number;
use mms_spec::Face;
use mms_spec::foreign::shown;
use mms_spec::quantity::{Quantity, Shape};
use mms_spec::suggest::advice;
use mms_symbolic::expr::Symbol;
use mms_symbolic::sorted::SortedMap;
use numpy::{PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::array::{Layout, Numbers, STRETCH, scratch, stretch};
use crate::evaluator::{Evaluator, NonFinite, Places, Precision};
use crate::mistake::{failure, mistake};

/// Fewer points than this are evaluated while the GIL is held.
const FEW: usize = 32;

/// A field with numbers for its parameters.
pub struct Opened {
    /// The field.
    pub input: Input,
    /// The parameters that were set, as they were given.
    pub settings: Vec<(String, String)>,
    single: Ready<f32>,
    double: Ready<f64>,
}

/// The outputs in one precision.
pub struct Ready<T: Precision> {
    /// All parameters.
    pub parameters: Vec<T>,
    known: Mutex<Vec<(Output, Arc<Evaluator<T>>)>>,
}

/// A precision whose outputs a field has.
pub trait Evaluated: Precision {
    /// The outputs in this precision.
    fn of(opened: &Opened) -> &Ready<Self>;
}

impl Evaluated for f32 {
    fn of(opened: &Opened) -> &Ready<f32> {
        &opened.single
    }
}

impl Evaluated for f64 {
    fn of(opened: &Opened) -> &Ready<f64> {
        &opened.double
    }
}

/// Points of a field, with their layout in an array.
pub struct Points<'py> {
    /// The coordinates.
    pub numbers: Numbers<'py>,
    /// The layout in the array.
    pub layout: Layout,
}

impl<'py> Points<'py> {
    /// Reads the points of an argument.
    pub fn given(given: &Bound<'py, PyAny>, opened: &Opened) -> PyResult<Self> {
        let numbers = Numbers::of("X", given)?;
        let of = format!("points of `{}`", opened.input.name.shown());
        let layout = Layout::of("X", numbers.shape(), &[opened.dimension()], &of)?;
        Ok(Points { numbers, layout })
    }

    /// A contiguous copy, in row-major order.
    pub fn copied(&self) -> PyResult<Py<PyAny>> {
        match &self.numbers {
            Numbers::Single(array) => copy(array),
            Numbers::Double(array) => copy(array),
        }
    }
}

/// A request: an output, the name and the shape of its result, and the time.
pub struct OutputRequest<'a> {
    /// The output.
    pub output: Output,
    /// The name.
    pub name: &'a str,
    /// The axes of a value.
    pub own: &'a [usize],
    /// The time.
    pub time: f64,
}

/// The arguments of a request.
struct At<'a, 'py, T: Precision> {
    layout: &'a Layout,
    x: Option<&'a PyReadonlyArrayDyn<'py, T>>,
    /// The face whose normals are used.
    face: Option<Face>,
    gradients: Option<&'a PyReadonlyArrayDyn<'py, T>>,
}

impl<T: Evaluated + Number> Ready<T> {
    fn new(compiled: &Compiled, set: &SortedMap<usize, RBig>) -> Self {
        Ready { parameters: compiled.parameters(set), known: Mutex::new(Vec::new()) }
    }

    /// The evaluator of an output, made at its first use.
    pub fn evaluator(&self, input: &Input, output: Output) -> PyResult<Arc<Evaluator<T>>> {
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let find = |all: &[(Output, Arc<Evaluator<T>>)]| {
            all.iter().find(|(it, _)| *it == output).map(|(_, evaluator)| evaluator.clone())
        };
        if let Some(evaluator) = find(&known()) {
            return Ok(evaluator);
        }
        let own = match output {
            Output::Quantity(quantity) => input.on_request(quantity).map_err(mistake)?,
            Output::Face(face, _) => Some(input.compiled.normal(face)),
            _ => None,
        };
        let program = own.as_ref().unwrap_or(&input.compiled.program);
        let components = program.outputs.get(&output).map_or(0, Vec::len);
        let evaluator = Arc::new(Evaluator::new(program, output, components, &self.parameters));
        let mut known = known();
        // Another thread may have been faster.
        Ok(find(&known).unwrap_or_else(|| {
            known.push((output, evaluator.clone()));
            evaluator
        }))
    }
}

impl Opened {
    /// A field with some parameters set: names, with numbers or formulas.
    pub fn new(py: Python<'_>, input: Input, settings: Vec<(String, String)>) -> PyResult<Opened> {
        let set = accepted(py, &input.compiled, &settings)?;
        let (single, double) =
            (Ready::new(&input.compiled, &set), Ready::new(&input.compiled, &set));
        Ok(Opened { input, settings, single, double })
    }

    /// The compiled field.
    pub fn compiled(&self) -> &Compiled {
        &self.input.compiled
    }

    /// The parameters that were set, as the command takes them.
    pub fn arguments(&self) -> Vec<String> {
        self.settings.iter().map(|(name, value)| format!("{name}={value}")).collect()
    }

    /// All parameters, in the order of the file.
    pub fn parameters(&self) -> &[f64] {
        &self.double.parameters
    }

    /// The number of coordinates of a point.
    pub fn dimension(&self) -> usize {
        self.compiled().field.dimension
    }

    /// The axes of a value.
    fn axes(&self, shape: Shape) -> Vec<usize> {
        let space = self.compiled().field.space;
        match shape {
            Shape::Scalar => Vec::new(),
            Shape::Vector => vec![space.vector()],
            Shape::Tensor => vec![space.rows(); 2],
        }
    }

    /// The time, which a field that moves must be given.
    fn time(&self, given: Option<f64>) -> PyResult<f64> {
        match given {
            Some(time) if time.is_finite() => Ok(time),
            Some(time) => Err(mistake(format!("`t` is {time}: expected a finite number"))),
            None if self.input.is_static() => Ok(0.0),
            None => Err(mistake(format!(
                "`{}` moves: give the time, as in t=0.01",
                self.input.name.shown()
            ))),
        }
    }

    /// A quantity at points.
    pub fn quantity<'py>(
        &self,
        py: Python<'py>,
        quantity: Quantity,
        points: &Points<'py>,
        t: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.held(py, quantity, None, points, t)
    }

    /// A quantity by its name; at points of a face if it takes a normal.
    pub fn named<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        points: &Points<'py>,
        t: Option<f64>,
        face: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let quantity = self.compiled().quantity(name).map_err(mistake)?;
        let (name, known) = (quantity.name(), |face| self.compiled().face(face));
        let face = match (quantity.takes_normal(), face) {
            (false, None) => None,
            (true, Some(face)) => {
                Some(known(face).map_err(|it| mistake(format!("`{face}`: {it}")))?)
            }
            (true, None) => {
                return Err(mistake(format!(
                    "`{name}` takes a normal: name a face, as in face=\"x_max\""
                )));
            }
            (false, Some(_)) => {
                return Err(mistake(format!("`{name}` is of no face: leave `face` out")));
            }
        };
        self.held(py, quantity, face, points, t)
    }

    fn held<'py>(
        &self,
        py: Python<'py>,
        quantity: Quantity,
        face: Option<Face>,
        points: &Points<'py>,
        t: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.with_request(quantity, t, |request| match &points.numbers {
            Numbers::Single(x) => self.filled(py, request, At::points(&points.layout, x, face)),
            Numbers::Double(x) => self.filled(py, request, At::points(&points.layout, x, face)),
        })
    }

    /// Runs `work` with the request for a quantity at a time.
    pub fn with_request<R>(
        &self,
        quantity: Quantity,
        t: Option<f64>,
        work: impl FnOnce(&OutputRequest<'_>) -> PyResult<R>,
    ) -> PyResult<R> {
        self.compiled().validate_offered(quantity).map_err(mistake)?;
        let own = self.axes(quantity.shape());
        let (output, time) = (Output::Quantity(quantity), self.time(t)?);
        work(&OutputRequest { output, name: quantity.name(), own: &own, time })
    }

    /// The first Piola-Kirchhoff stress of the material at displacement gradients and, if the material depends on X or t, at
    /// these.
    pub fn stress<'py>(
        &self,
        py: Python<'py>,
        gradients: &Bound<'py, PyAny>,
        x: Option<&Bound<'py, PyAny>>,
        t: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let output = Output::Response(Response::FirstPiolaKirchhoff);
        let time = self.time(t.or(Some(0.0)))?;
        for (symbol, name, is_given) in
            [(Symbol::Coordinate(0), "X", x.is_some()), (Symbol::Time, "t", t.is_some())]
        {
            ensure_given(self, output, symbol, name, is_given)?;
        }
        let own = self.axes(Shape::Tensor);
        let of = format!("displacement gradients of `{}`", self.input.name.shown());
        let numbers = Numbers::of("H", gradients)?;
        let layout = Layout::of("H", numbers.shape(), &own, &of)?;
        let request = OutputRequest { output, name: "P", own: &own, time };
        let x = x.map(|x| Points::given(x, self)).transpose()?;
        if x.as_ref().is_some_and(|x| x.layout.leading != layout.leading) {
            return Err(mistake("`X` and `H` are of different points: expected one X for each H"));
        }
        let at = (&layout, x.map(|x| x.numbers));
        match (&numbers, at) {
            (Numbers::Double(h), (layout, None)) => {
                self.filled(py, &request, At { layout, x: None, face: None, gradients: Some(h) })
            }
            (Numbers::Single(h), (layout, None)) => {
                self.filled(py, &request, At { layout, x: None, face: None, gradients: Some(h) })
            }
            (Numbers::Double(h), (layout, Some(Numbers::Double(x)))) => self.filled(
                py,
                &request,
                At { layout, x: Some(&x), face: None, gradients: Some(h) },
            ),
            (Numbers::Single(h), (layout, Some(Numbers::Single(x)))) => self.filled(
                py,
                &request,
                At { layout, x: Some(&x), face: None, gradients: Some(h) },
            ),
            _ => Err(mistake("`X` and `H` have different precisions: expected one dtype for both")),
        }
    }

    fn filled<'py, T: Evaluated + Number>(
        &self,
        py: Python<'py>,
        request: &OutputRequest<'_>,
        at: At<'_, 'py, T>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (dimension, rows) = (self.dimension(), self.compiled().field.space.rows());
        let (ready, layout) = (T::of(self), at.layout);
        let evaluator = ready.evaluator(&self.input, request.output)?;
        let normal = match at.face {
            Some(face) => Some(ready.evaluator(&self.input, Output::Face(face, Datum::Normal))?),
            None => None,
        };
        let (time, count) = (T::near(request.time), layout.count());
        let result = scratch::<T>(py, layout.shape(request.own));
        let mut writable = result.readwrite();
        let values = writable.as_slice_mut()?;
        for start in (0..count).step_by(STRETCH) {
            let ends = [start, count.min(start + STRETCH)];
            let points = at.x.map_or(Cow::default(), |x| stretch(x, dimension, ends));
            let gradients =
                at.gradients.map_or(Cow::default(), |it| stretch(it, rows * rows, ends));
            let places = Places {
                count: ends[1] - start,
                dimension,
                points: &points,
                normals: &[],
                gradients: &gradients,
                rows,
            };
            let components = evaluator.components();
            let own = &mut values[start * components..ends[1] * components];
            let mut fill = || {
                let mut normals = Vec::new();
                if let Some(normal) = &normal {
                    normals.resize(points.len(), T::near(0.0));
                    normal.fill(time, places, &mut normals)?;
                }
                evaluator.fill(time, Places { normals: &normals, ..places }, own)
            };
            // Releasing and acquiring the GIL takes as long as a few points.
            let filled = if count < FEW { fill() } else { py.detach(fill) };
            filled.map_err(|number| {
                self.not_finite(
                    request,
                    layout,
                    NonFinite { index: start + number.index, ..number },
                )
            })?;
            if ends[1] < count {
                py.check_signals()?;
            }
        }
        drop(writable);
        Ok(result.into_any())
    }

    /// The exception for an input or a result that is not finite.
    pub fn not_finite(
        &self,
        request: &OutputRequest<'_>,
        layout: &Layout,
        number: NonFinite,
    ) -> PyErr {
        let place = layout.place(number.index);
        mistake(match number.is_input {
            true => format!(
                "the point at {place} has a number that is not finite: expected finite numbers"
            ),
            false => format!(
                "{} of `{}` is not finite at the point at {place}, t = {:?}: not defined there, or beyond the range of the \
                 precision",
                request.name,
                self.input.name.shown(),
                request.time
            ),
        })
    }
}

/// Refuses a call without X or t if the output depends on it.
fn ensure_given(
    opened: &Opened,
    output: Output,
    symbol: Symbol,
    name: &str,
    is_given: bool,
) -> PyResult<()> {
    let program = &opened.compiled().program;
    let needed = program.needed(&[output]);
    let is_it = |read: Symbol| match (read, symbol) {
        (Symbol::Coordinate(_), Symbol::Coordinate(_)) => true,
        (read, symbol) => read == symbol,
    };
    let mut read = program.instrs.iter().zip(needed).filter(|(_, needed)| *needed);
    match is_given || !read.any(|(instr, _)| matches!(instr.op, Op::Input(it) if is_it(it))) {
        true => Ok(()),
        false => Err(mistake(format!(
            "the material of `{}` depends on {name}: give `{name}` too",
            opened.input.name.shown()
        ))),
    }
}

/// The exact values of parameters, by position, if the field allows them.
fn accepted(
    py: Python<'_>,
    compiled: &Compiled,
    settings: &[(String, String)],
) -> PyResult<SortedMap<usize, RBig>> {
    let names = || compiled.model.parameters.iter().map(|parameter| parameter.name.as_str());
    let mut set = SortedMap::new();
    for (name, value) in settings {
        let index = names().position(|known| known == name).ok_or_else(|| {
            let advice = advice(name, names(), |all| format!("the field has {all}"));
            mistake(format!("no parameter `{}`; {advice}", shown(name)))
        })?;
        let value = constant(value).map_err(|found| {
            failure(py, &format!("`{name}={}`: not a number\n{found}", shown(value)), &found)
        })?;
        set.insert(index, value);
    }
    if !set.is_empty() {
        compiled.accepts(&set).map_err(|found| {
            let given: Vec<_> =
                settings.iter().map(|(name, value)| format!("{name}={value}")).collect();
            let given = shown(&given.join(", "));
            failure(py, &format!("`{given}`: not what the field file allows\n{found}"), &found)
        })?;
    }
    Ok(set)
}

impl<'a, 'py, T: Precision> At<'a, 'py, T> {
    fn points(layout: &'a Layout, x: &'a PyReadonlyArrayDyn<'py, T>, face: Option<Face>) -> Self {
        At { layout, x: Some(x), face, gradients: None }
    }
}

/// A contiguous copy, in row-major order.
fn copy<T: Evaluated>(array: &PyReadonlyArrayDyn<'_, T>) -> PyResult<Py<PyAny>> {
    let copy = scratch::<T>(array.py(), array.shape().to_vec());
    array.copy_to(&copy)?;
    Ok(copy.into_any().unbind())
}
