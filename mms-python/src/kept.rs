//! A field at points that stay: what X alone determines is found once for each quantity, and kept for other times.

use std::sync::{Arc, Mutex, PoisonError};

use mms_mechanics::Output;
use mms_program::block::Blockwise;
use mms_program::interpret::Number;
use mms_spec::quantity::Quantity;
use numpy::{PyArrayMethods, PyReadonlyArrayDyn};
use pyo3::prelude::*;

use crate::array::{Numbers, STRETCH, scratch};
use crate::evaluator::{KeptPoints, NonFinite};
use crate::opened::{Evaluated, Opened, OutputRequest, Points};

/// Points, and the values that are kept there.
pub struct Stay {
    /// An array of this library's own, which lies in memory as it is read.
    points: Py<PyAny>,
    single: Known<f32>,
    double: Known<f64>,
}

/// The numbers kept for each output so far.
type Known<T> = Mutex<Vec<(Output, Arc<KeptPoints<T>>)>>;

impl Stay {
    /// A copy of points of a field.
    pub fn new(points: &Points<'_>) -> PyResult<Self> {
        Ok(Stay { points: points.copied()?, single: Mutex::default(), double: Mutex::default() })
    }

    /// The points.
    pub fn points<'py>(&self, py: Python<'py>, opened: &Opened) -> PyResult<Points<'py>> {
        Points::given(self.points.bind(py), opened)
    }

    /// A quantity at the points.
    pub fn quantity<'py>(
        &self,
        py: Python<'py>,
        opened: &Opened,
        quantity: Quantity,
        t: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let points = self.points(py, opened)?;
        opened.with_request(quantity, t, |request| match &points.numbers {
            Numbers::Single(x) => filled(py, opened, request, (&points, x), &self.single),
            Numbers::Double(x) => filled(py, opened, request, (&points, x), &self.double),
        })
    }
}

fn filled<'py, T: Evaluated + Number + Blockwise>(
    py: Python<'py>,
    opened: &Opened,
    request: &OutputRequest<'_>,
    (points, x): (&Points<'py>, &PyReadonlyArrayDyn<'py, T>),
    known: &Known<T>,
) -> PyResult<Bound<'py, PyAny>> {
    let (dimension, layout) = (opened.dimension(), &points.layout);
    let evaluator = T::of(opened).evaluator(&opened.input, request.output)?;
    let x = x.as_slice()?;
    let number = |number: NonFinite| opened.not_finite(request, layout, number);
    let lock = || known.lock().unwrap_or_else(PoisonError::into_inner);
    let find = || lock().iter().find(|(it, _)| *it == request.output).map(|(_, it)| it.clone());
    let kept = match find() {
        Some(kept) => kept,
        None => {
            let kept = Arc::new(py.detach(|| evaluator.keep(dimension, x)).map_err(number)?);
            lock().push((request.output, kept.clone()));
            kept
        }
    };
    let (time, count, components) = (T::near(request.time), layout.count(), evaluator.components());
    let result = scratch::<T>(py, layout.shape(request.own));
    let mut writable = result.readwrite();
    let values = writable.as_slice_mut()?;
    for start in (0..count).step_by(STRETCH) {
        let end = count.min(start + STRETCH);
        let own = &mut values[start * components..end * components];
        let of = (dimension, x, &*kept);
        py.detach(|| evaluator.fill_kept(time, of, start, own)).map_err(number)?;
        if end < count {
            py.check_signals()?;
        }
    }
    drop(writable);
    Ok(result.into_any())
}
