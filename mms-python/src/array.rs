//! Arrays: the shape and the numbers of an argument, and the array that is returned.

use std::borrow::Cow;

use numpy::ndarray::{ArrayD, Axis, Slice};
use numpy::{Element, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;

use crate::evaluator::Precision;
use crate::mistake::mistake;

/// The number of points that are gathered and evaluated before Python is polled for an interrupt.
pub const STRETCH: usize = 1 << 18;

/// Numbers at points, in the precision that they were given in.
pub enum Numbers<'py> {
    /// In single precision.
    Single(PyReadonlyArrayDyn<'py, f32>),
    /// In double precision.
    Double(PyReadonlyArrayDyn<'py, f64>),
}

impl<'py> Numbers<'py> {
    /// Reads an argument. Arrays of other numbers than `float32` and `float64`, and those out of line in memory, are copied.
    pub fn of(name: &str, given: &Bound<'py, PyAny>) -> PyResult<Self> {
        if let Some(numbers) = Self::as_it_is(given)? {
            return Ok(numbers);
        }
        let copied = copied(name, given)?;
        Self::as_it_is(&copied)?.ok_or_else(|| not_real(name, given))
    }

    fn as_it_is(given: &Bound<'py, PyAny>) -> PyResult<Option<Self>> {
        if let Ok(array) = given.cast_exact::<PyArrayDyn<f64>>() {
            return Ok(read(array)?.map(Numbers::Double));
        }
        match given.cast_exact::<PyArrayDyn<f32>>() {
            Ok(array) => Ok(read(array)?.map(Numbers::Single)),
            Err(_) => Ok(None),
        }
    }

    /// The lengths of the axes.
    pub fn shape(&self) -> &[usize] {
        match self {
            Numbers::Single(array) => array.shape(),
            Numbers::Double(array) => array.shape(),
        }
    }
}

/// An array to read, unless it lies in memory in a way that Rust does not read.
fn read<'py, T: Element>(
    array: &Bound<'py, PyArrayDyn<T>>,
) -> PyResult<Option<PyReadonlyArrayDyn<'py, T>>> {
    if !array.is_aligned() {
        return Ok(None);
    }
    Ok(Some(array.try_readonly().map_err(mistake)?))
}

/// The module of NumPy.
fn numpy<'py>(py: Python<'py>) -> PyResult<&'py Bound<'py, PyModule>> {
    static NUMPY: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    let module = NUMPY.get_or_try_init(py, || py.import("numpy").map(Bound::unbind))?;
    Ok(module.bind(py))
}

/// A copy of real numbers: in single precision if they are, and in double precision otherwise.
fn copied<'py>(name: &str, given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let numpy = numpy(given.py())?;
    let array = numpy.call_method1("asarray", (given,))?;
    let masked = numpy.getattr("ma")?.getattr("MaskedArray")?;
    if given.is_instance(&masked)? {
        return Err(PyTypeError::new_err(format!(
            "`{name}` is a masked array, and a field knows no masks: expected an array of numbers, as of `{name}.compressed()`"
        )));
    }
    let dtype = array.getattr("dtype")?;
    let kind: String = dtype.getattr("kind")?.extract()?;
    let size: usize = dtype.getattr("itemsize")?.extract()?;
    let to = match kind.as_str() {
        "f" if size == 4 => "=f4",
        "b" | "i" | "u" | "f" => "=f8",
        _ => return Err(not_real(name, given)),
    };
    let keywords = PyDict::new(given.py());
    keywords.set_item("dtype", to)?;
    keywords.set_item("order", "C")?;
    keywords.set_item("subok", false)?;
    numpy.call_method("array", (array,), Some(&keywords))
}

fn not_real(name: &str, given: &Bound<'_, PyAny>) -> PyErr {
    let found = given.get_type();
    let of = given.getattr("dtype").map(|dtype| format!(" of {dtype}")).unwrap_or_default();
    PyTypeError::new_err(format!("`{name}`: expected an array of real numbers, found {found}{of}"))
}

/// The time of an argument, if it is given.
pub fn time(given: &Bound<'_, PyAny>) -> PyResult<Option<f64>> {
    given.extract().map_err(|_| {
        let found = given.get_type();
        PyTypeError::new_err(format!(
            "`t`: expected one number, found {found}; call once for each time"
        ))
    })
}

/// The layout of the numbers of points in an array: a fixed number in a row for each point.
pub struct Layout {
    /// The axes before the axes of one point.
    pub leading: Vec<usize>,
    /// Whether the array has no axis for the one coordinate of a point.
    pub is_flat: bool,
}

impl Layout {
    /// The array of an argument whose last axes are `own`; `(n,)` and `()` do for points of one number.
    pub fn of(name: &str, shape: &[usize], own: &[usize], of: &str) -> PyResult<Self> {
        if own.iter().all(|length| *length == 1) && shape.len() < 2 {
            return Ok(Layout { leading: shape.to_vec(), is_flat: true });
        }
        match shape.strip_suffix(own) {
            Some(leading) => Ok(Layout { leading: leading.to_vec(), is_flat: false }),
            None => {
                let axes: Vec<_> = own.iter().map(usize::to_string).collect();
                let flat = if own.iter().all(|it| *it == 1) { " or (n,)" } else { "" };
                let found = written(shape);
                Err(mistake(format!(
                    "`{name}` has the shape {found}: expected (..., {}){flat} for {of}",
                    axes.join(", ")
                )))
            }
        }
    }

    /// The number of points.
    pub fn count(&self) -> usize {
        self.leading.iter().product()
    }

    /// The shape of a result whose last axes are `own`.
    pub fn shape(&self, own: &[usize]) -> Vec<usize> {
        let own = if self.is_flat { &[] } else { own };
        self.leading.iter().chain(own).copied().collect()
    }

    /// The place of a point, as NumPy counts.
    pub fn place(&self, mut index: usize) -> String {
        let mut place = vec![0; self.leading.len()];
        for (at, length) in place.iter_mut().zip(&self.leading).rev() {
            (*at, index) = (index % length, index / length);
        }
        written(&place)
    }
}

/// A tuple as Python writes it.
pub fn written(numbers: &[usize]) -> String {
    let all: Vec<_> = numbers.iter().map(usize::to_string).collect();
    match all.as_slice() {
        [one] => format!("({one},)"),
        all => format!("({})", all.join(", ")),
    }
}

/// The points `start..end` of an array with `numbers` numbers each, one after the other; borrows from the array if it is
/// contiguous.
pub fn stretch<'a, T: Precision>(
    array: &'a PyReadonlyArrayDyn<'_, T>,
    numbers: usize,
    [start, end]: [usize; 2],
) -> Cow<'a, [T]> {
    if start == end {
        return Cow::Borrowed(&[]);
    }
    if array.is_c_contiguous()
        && let Ok(all) = array.as_slice()
    {
        return Cow::Borrowed(&all[start * numbers..end * numbers]);
    }
    let view = array.as_array();
    let Some((_, rest)) = view.shape().split_first() else {
        return Cow::Owned(view.iter().copied().collect());
    };
    // Numbers before the stretch are skipped in whole entries of the first axis.
    let entry: usize = rest.iter().product();
    let (first, passed) = (start * numbers / entry, start * numbers % entry);
    if entry == numbers {
        let own = view.slice_axis(Axis(0), Slice::from(start..end));
        let mut copy = ArrayD::from_elem(own.raw_dim(), T::near(0.0));
        copy.assign(&own);
        return Cow::Owned(copy.into_raw_vec_and_offset().0);
    }
    let view = view.slice_axis(Axis(0), Slice::from(first..));
    let wanted = view.iter().skip(passed).take((end - start) * numbers);
    Cow::Owned(wanted.copied().collect())
}

/// An array of zeros to be filled.
pub fn scratch<T: Element>(py: Python<'_>, shape: Vec<usize>) -> Bound<'_, PyArrayDyn<T>> {
    PyArrayDyn::<T>::zeros(py, shape, false)
}
