//! The classes of Python, whose methods for quantities `build.rs` writes.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use mms_emit::port::faces::claims;
use mms_exact::gallery::FIELDS;
use mms_exact::{Source, validate_division};
use mms_files::write::write_whole;
use mms_mechanics::extent::halton;
use mms_mechanics::sample::domain;
use mms_runtime::{Division, Setup};
use mms_show::mathml::escape;
use mms_spec::Face;
use mms_spec::quantity::Quantity;
use mms_spec::suggest::did_you_mean;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::{PyAttributeError, PyOSError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyString};

use crate::kept::Stay;
use crate::mistake::mistake;
use crate::open;
use crate::opened::{Opened, Points};
use crate::show::show;

/// A field: a motion, its material, and the loads that make it a solution. `field`, `load` and `loads` open one, and `Field` makes
/// one of formulas.
///
/// Each quantity is a method of X, (..., D) reference positions, and of the time t. For D = 1, X may be (n,), which gives (n,).
/// The aliases u, x, v, a, H, F, J, C, B, E, rho, P, S, p, sigma, b and W are methods too.
#[pyclass(frozen, module = "manufactured")]
pub struct Field {
    /// The field, with numbers for its parameters.
    pub opened: Arc<Opened>,
}

/// The points of a grid: h, X and reference volumes.
type Grid<'py> = (f64, Bound<'py, PyAny>, Bound<'py, PyArray1<f64>>);

/// A field at one time, as `field.at(t)` gives it.
#[pyclass(frozen, module = "manufactured")]
pub struct Now {
    opened: Arc<Opened>,
    /// The time.
    #[pyo3(get)]
    time: f64,
}

/// The material of a field.
#[pyclass(frozen, module = "manufactured")]
pub struct Material {
    opened: Arc<Opened>,
}

/// A field at points, as `field.points(X)` gives it: what X alone determines is found at the first time, and kept for others.
#[pyclass(frozen, module = "manufactured")]
pub struct AtPoints {
    opened: Arc<Opened>,
    stay: Stay,
}

include!(concat!(env!("OUT_DIR"), "/quantities.rs"));

#[pymethods]
#[allow(non_snake_case)]
impl Field {
    /// A field of this displacement, with a formula for each component; the other tables of a field file are keywords:
    /// `Field(["A*sin(pi*X)"], parameters={"A": 0.1}, material={...}, domain={...})`.
    ///
    /// Formulas are strings, numbers or expressions of SymPy. Raises FieldError where the field has mistakes, in the lines of the
    /// file that it makes.
    #[new]
    #[pyo3(signature = (u, **tables))]
    fn new(
        py: Python<'_>,
        u: &Bound<'_, PyAny>,
        tables: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Field> {
        let text = py.import("manufactured._text")?.getattr("text_of")?.call((u,), tables)?;
        opened(py, open::text("text", &text.extract::<String>()?, None), false, None)
    }

    /// The text of the field file. Parameters that were set are not in it.
    #[getter]
    fn text(&self) -> &str {
        self.opened.compiled().sources.texts().next().unwrap_or_default()
    }

    /// Writes the field file and, if its material does not ship with the library, the material file beside it.
    ///
    /// Raises MmsError where parameters are set, since files hold defaults, and OSError where it cannot be written.
    fn save(&self, path: PathBuf) -> PyResult<()> {
        if !self.opened.settings.is_empty() {
            return Err(mistake(format!(
                "a file holds the defaults of parameters, and {} is set: save the field as it was opened",
                self.opened.arguments().join(", ")
            )));
        }
        let written = |path: &Path, text: &str| {
            write_whole(path, text).map_err(|error| PyOSError::new_err(format!("{error:#}")))
        };
        written(&path, self.text())?;
        match self.opened.compiled().own_material() {
            Some((name, text)) => written(&path.with_file_name(name), text),
            None => Ok(()),
        }
    }

    /// The name.
    #[getter]
    fn name(&self) -> &str {
        self.opened.input.name.raw()
    }

    /// The title, a sentence.
    #[getter]
    fn title(&self) -> &str {
        self.opened.compiled().field.title.raw()
    }

    /// D, the number of coordinates of a point.
    #[getter]
    fn dimension(&self) -> usize {
        self.opened.dimension()
    }

    /// The value of each parameter.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let values = PyDict::new(py);
        let names = self.opened.compiled().model.parameters.iter();
        for (parameter, value) in names.zip(self.opened.parameters()) {
            values.set_item(&parameter.name, value)?;
        }
        Ok(values)
    }

    /// The names of the faces of the body, for `traction`.
    #[getter]
    fn faces(&self) -> Vec<&str> {
        let field = &self.opened.compiled().field;
        Face::of(&field.domain.body, field.space).iter().map(|face| face.name()).collect()
    }

    /// The claim on each face, by names of faces: fixed, free, traction and their like, as the field file has them.
    #[getter]
    fn boundary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let boundary = PyDict::new(py);
        for (face, claim) in claims(&self.opened.compiled().field) {
            boundary.set_item(face.name(), claim.name())?;
        }
        Ok(boundary)
    }

    /// The box around the body in the reference configuration: its lower and its upper corner.
    #[getter]
    fn bounds(&self) -> (Vec<f64>, Vec<f64>) {
        let (body, _) = domain(&self.opened.compiled().program, self.opened.parameters());
        body.bounding_box().into()
    }

    /// The points that fill a grid of so many cells along the longest edge of the body, or of "16x8" along its axes: h, X and the
    /// reference volume of each point. `per_cell` is the number of points in each direction of a cell.
    ///
    /// Raises MmsError where the body cannot be filled so.
    #[pyo3(signature = (cells, per_cell="2"))]
    fn grid<'py>(&self, py: Python<'py>, cells: &str, per_cell: &str) -> PyResult<Grid<'py>> {
        let (opened, division) = (&self.opened, |name: &str, text: &str| {
            let division = text.parse::<Division>();
            division.map_err(|error| mistake(format!("`{name}`: {error}")))
        });
        let (cells, per_cell) = (division("cells", cells)?, division("per_cell", per_cell)?);
        let setup = Setup { particles_per_cell: per_cell, ..Setup::default() };
        let made = py.detach(|| {
            validate_division("cells", &cells, opened.dimension())?;
            let scene = opened.input.scene(&opened.arguments(), |code| code.double)?;
            Ok((scene.cell_size(&cells), scene.layout(&setup, &cells)?))
        });
        let (h, layout) = made.map_err(|error: anyhow::Error| mistake(format!("{error:#}")))?;
        let points = PyArray1::from_vec(py, layout.reference);
        let points = points.reshape([layout.volume.len(), opened.dimension()])?;
        Ok((h, points.into_any(), PyArray1::from_vec(py, layout.volume)))
    }

    /// The first and the last time; None of a static field.
    #[getter]
    fn window(&self) -> Option<(f64, f64)> {
        let (_, [first, last]) = domain(&self.opened.compiled().program, self.opened.parameters());
        (!self.opened.input.is_static()).then_some((first, last))
    }

    /// Points spread evenly over the body (a Halton sequence): (count, D).
    fn sample<'py>(&self, py: Python<'py>, count: usize) -> PyResult<Bound<'py, PyAny>> {
        let dimension = self.opened.dimension();
        let points = py.detach(|| {
            let (body, _) = domain(&self.opened.compiled().program, self.opened.parameters());
            let points = (1..=count).flat_map(|index| body.point(&halton::<f64>(index)));
            points.collect::<Vec<_>>()
        });
        let points = PyArray1::from_vec(py, points);
        Ok(points.reshape([count, dimension])?.into_any())
    }

    /// The names of all quantities, those that the field file defines last.
    #[getter]
    fn quantities(&self) -> Vec<&str> {
        let compiled = self.opened.compiled();
        let own = compiled.model.own.keys().map(|own| Quantity::Own(*own));
        let all = Quantity::evaluated().filter(|it| compiled.offers(*it));
        all.chain(own).map(|it| it.name()).collect()
    }

    /// The material: `material.P(H)` is the stress at displacement gradients of your own.
    #[getter]
    fn material(&self) -> Material {
        Material { opened: self.opened.clone() }
    }

    /// The field at a time: `now = field.at(t); now.F(X), now.sigma(X)`.
    fn at(&self, t: f64) -> Now {
        Now { opened: self.opened.clone(), time: t }
    }

    /// The field at fixed points: `cache = field.points(X); cache.b(t)`. X is copied, and values that depend on X alone are
    /// kept for each quantity that is evaluated.
    fn points(&self, X: &Bound<'_, PyAny>) -> PyResult<AtPoints> {
        let stay = Stay::new(&Points::given(X, &self.opened)?)?;
        Ok(AtPoints { opened: self.opened.clone(), stay })
    }

    /// The field with other values of some parameters: `field.set(amplitude=0.2)`. Parameters that were set before stay set.
    #[pyo3(signature = (**parameters))]
    fn set(&self, py: Python<'_>, parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Field> {
        let new = settings(parameters)?;
        let is_new = |name: &String| new.iter().any(|(other, _)| other == name);
        let mut all = self.opened.settings.clone();
        all.retain(|(name, _)| !is_new(name));
        all.extend(new);
        let opened = Opened::new(py, self.opened.input.clone(), all)?;
        Ok(Field { opened: Arc::new(opened) })
    }

    /// A quantity by its name or alias, also one that the field file defines: `field.evaluate("b", X, t=0.01)`. One that takes a
    /// normal needs the name of a face.
    #[pyo3(signature = (quantity, X, t=None, *, face=None))]
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        quantity: &str,
        X: &Bound<'py, PyAny>,
        t: Option<f64>,
        face: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.opened.named(py, quantity, &Points::given(X, &self.opened)?, t, face)
    }

    /// The traction P N on the reference area of a face, at points X of it: (..., D).
    ///
    /// Raises MmsError where the body has no such face, and where a number is not finite.
    #[pyo3(signature = (face, X, t=None))]
    fn traction<'py>(
        &self,
        py: Python<'py>,
        face: &str,
        X: &Bound<'py, PyAny>,
        t: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let points = Points::given(X, &self.opened)?;
        self.opened.named(py, Quantity::Traction.name(), &points, t, Some(face))
    }

    /// The derivation of some quantities as `mms show` prints it: `print(field.show("b"))`; by default of the displacement and
    /// the body force. `format` is "text", "latex" or "html".
    #[pyo3(signature = (*quantities, format="text"))]
    fn show(&self, py: Python<'_>, quantities: Vec<String>, format: &str) -> PyResult<String> {
        py.detach(|| show(&self.opened, &quantities, format))
    }

    /// The title, the parameters and the derivation, for a notebook.
    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let shown = self.show(py, Vec::new(), "html")?;
        let names = self.opened.compiled().model.parameters.iter();
        let values = names.zip(self.opened.parameters());
        let values: Vec<_> =
            values.map(|(it, value)| escape(&format!("{} = {value:?}", it.name))).collect();
        let title = escape(&self.opened.compiled().field.title.shown());
        Ok(format!("<h3>{title}</h3>\n<p>{}</p>\n{shown}", values.join(", ")))
    }

    /// A quantity that the field file defines, as a method.
    fn __getattr__<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        own(slf.as_any(), &slf.get().opened, name)
    }

    fn __repr__(&self) -> String {
        let set: Vec<_> =
            self.opened.settings.iter().map(|(name, value)| format!(", {name}={value}")).collect();
        format!("<field {}{}>", self.opened.input.name.shown(), set.concat())
    }
}

#[pymethods]
#[allow(non_snake_case)]
impl Now {
    /// The traction P N on the reference area of a face, at points X of it: (..., D).
    fn traction<'py>(
        &self,
        py: Python<'py>,
        face: &str,
        X: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let points = Points::given(X, &self.opened)?;
        self.opened.named(py, Quantity::Traction.name(), &points, Some(self.time), Some(face))
    }

    /// A quantity by its name or alias at X, also one that the field file defines; see `evaluate` of a field.
    #[pyo3(signature = (quantity, X, *, face=None))]
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        quantity: &str,
        X: &Bound<'py, PyAny>,
        face: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let points = Points::given(X, &self.opened)?;
        self.opened.named(py, quantity, &points, Some(self.time), face)
    }

    /// A quantity that the field file defines, as a method.
    fn __getattr__<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        own(slf.as_any(), &slf.get().opened, name)
    }

    fn __repr__(&self) -> String {
        format!("<field {} at t = {:?}>", self.opened.input.name.shown(), self.time)
    }
}

#[pymethods]
impl AtPoints {
    /// The traction P N on the reference area of a face that all points are on: (..., D).
    #[pyo3(signature = (face, t=None))]
    fn traction<'py>(
        &self,
        py: Python<'py>,
        face: &str,
        t: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let points = self.stay.points(py, &self.opened)?;
        self.opened.named(py, Quantity::Traction.name(), &points, t, Some(face))
    }

    /// A quantity by its name or alias at t, also one that the field file defines; see `evaluate` of a field.
    #[pyo3(signature = (quantity, t=None, *, face=None))]
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        quantity: &str,
        t: Option<f64>,
        face: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.opened.named(py, quantity, &self.stay.points(py, &self.opened)?, t, face)
    }

    /// A quantity that the field file defines, as a method.
    fn __getattr__<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        own(slf.as_any(), &slf.get().opened, name)
    }

    fn __repr__(&self) -> String {
        format!("<field {} at points>", self.opened.input.name.shown())
    }
}

#[pymethods]
#[allow(non_snake_case)]
impl Material {
    /// The first Piola-Kirchhoff stress P at displacement gradients H, (..., D, D); for D = 1 also (n,).
    ///
    /// X, (..., D), and t are needed where the material depends on them. Returns the shape of H.
    #[pyo3(signature = (H, X=None, t=None))]
    fn P<'py>(
        &self,
        py: Python<'py>,
        H: &Bound<'py, PyAny>,
        X: Option<&Bound<'py, PyAny>>,
        t: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.opened.stress(py, H, X, t)
    }

    fn __repr__(&self) -> String {
        format!("<material of {}>", self.opened.input.name.shown())
    }
}

/// A quantity that the field file defines, as a method of a field, at a time or at points.
fn own<'py>(of: &Bound<'py, PyAny>, opened: &Opened, name: &str) -> PyResult<Bound<'py, PyAny>> {
    let Ok(quantity) = opened.compiled().quantity(name) else {
        let known: Vec<String> = of.get_type().dir()?.extract()?;
        let known = known.iter().map(String::as_str).filter(|it| !it.starts_with('_'));
        let advice = match did_you_mean(name, known) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("`{}` defines no such quantity", opened.input.name.shown()),
        };
        return Err(PyAttributeError::new_err(format!("a field has no `{name}`; {advice}")));
    };
    let partial = of.py().import("functools")?.getattr("partial")?;
    partial.call1((of.getattr("evaluate")?, quantity.name()))
}

/// Parameters as they were given: a number is read by its digits, as on the command line, and a text as a formula.
fn settings(parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<(String, String)>> {
    let Some(parameters) = parameters else { return Ok(Vec::new()) };
    let setting = |(name, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let name: String = name.extract()?;
        if value.is_instance_of::<PyBool>() {
            return Err(PyTypeError::new_err(format!(
                "`{name}`: expected a number, found a truth value"
            )));
        }
        let text = match value.cast::<PyString>() {
            Ok(text) => text.to_string(),
            // A float of NumPy is one of Python too, and is written in other words.
            Err(_) if value.is_instance_of::<PyFloat>() => {
                PyFloat::new(value.py(), value.extract()?).repr()?.to_string()
            }
            Err(_) => value.str()?.to_string(),
        };
        Ok((name, text))
    };
    parameters.iter().map(setting).collect()
}

/// Opens a field of the gallery: `field("bar_1d", amplitude=0.1)`.
///
/// A number is taken by its digits, as on the command line: 0.1 is 1/10. A string is a formula, such as "1/3". Raises FieldError
/// where the field does not allow a value.
#[pyfunction]
#[pyo3(signature = (name, /, **parameters))]
fn field(py: Python<'_>, name: &str, parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Field> {
    opened(py, open::shipped(name)?, true, parameters)
}

/// Opens a field file: `load("mine.toml", amplitude=0.1)`. A material file that it names is read beside it.
///
/// Raises FieldError where it has mistakes, each with its line and column, and OSError where it cannot be read.
#[pyfunction]
#[pyo3(signature = (path, /, **parameters))]
fn load(py: Python<'_>, path: PathBuf, parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Field> {
    opened(py, open::file(&path)?, false, parameters)
}

/// Opens the text of a field file: `loads(text, amplitude=0.1)`. A material of its own follows as a second text.
///
/// Raises FieldError where it has mistakes, each with its line and column.
#[pyfunction]
#[pyo3(signature = (text, material=None, /, **parameters))]
fn loads(
    py: Python<'_>,
    text: &str,
    material: Option<String>,
    parameters: Option<&Bound<'_, PyDict>>,
) -> PyResult<Field> {
    opened(py, open::text("text", text, material), false, parameters)
}

fn opened(
    py: Python<'_>,
    source: Source,
    is_shipped: bool,
    parameters: Option<&Bound<'_, PyDict>>,
) -> PyResult<Field> {
    let settings = settings(parameters)?;
    let input = open::compile(py, source, is_shipped)?;
    Ok(Field { opened: Arc::new(Opened::new(py, input, settings)?) })
}

/// The names of the fields that ship with the library.
#[pyfunction]
fn gallery() -> Vec<&'static str> {
    FIELDS.iter().map(|entry| entry.name).collect()
}

/// Adds the classes and functions to the module.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    for class in [py.get_type::<Field>(), py.get_type::<Now>(), py.get_type::<AtPoints>()] {
        for quantity in Quantity::evaluated().filter(|it| !it.takes_normal()) {
            let (name, symbol) = (quantity.name(), quantity.symbol());
            // `p` may be a given field of the file, which `__getattr__` finds.
            if name != symbol && Quantity::reserves(symbol) {
                class.setattr(symbol, class.getattr(name)?)?;
            }
        }
        module.add(class.name()?.extract::<String>()?.as_str(), class)?;
    }
    module.add_class::<Material>()?;
    module.add_function(wrap_pyfunction!(field, module)?)?;
    module.add_function(wrap_pyfunction!(load, module)?)?;
    module.add_function(wrap_pyfunction!(loads, module)?)?;
    module.add_function(wrap_pyfunction!(self::gallery, module)?)
}
