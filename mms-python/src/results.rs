//! Results of a solver, from arrays or from files, as `mms judge` and `mms diagnose` take them.

use mms_exact::Exact;
use mms_judge::results::Results;
use mms_results::{ARRAYS, Array, Cells, Snapshot, Stored, Time};
use mms_symbolic::work::Stop;
use numpy::PyReadonlyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::array::{Numbers, stretch, written};
use crate::evaluator::Precision;
use crate::mistake::mistake;

/// The results of one mesh at one time: h, the points X, and what the solver computed there, by names or symbols of quantities.
///
/// `Level(1/8, X, u=u, t=0.01)`. X is (..., D) or, for D = 1, (n,); u is like X; a tensor is (..., D, D). `cells` are pairs of a
/// type and an array (m, k) of points; with them norms are taken over cells. A type is a name of meshio's, such as "triangle6", or
/// a number of VTK's. Arrays are copied.
#[pyclass(frozen, module = "manufactured")]
pub struct Level {
    /// h; None if it is to be found from cells or points.
    #[pyo3(get)]
    h: Option<f64>,
    snapshot: Snapshot,
}

#[pymethods]
#[allow(non_snake_case)]
impl Level {
    #[new]
    #[pyo3(signature = (h=None, X=None, u=None, *, t=None, cells=None, **quantities))]
    fn new(
        h: Option<f64>,
        X: Option<&Bound<'_, PyAny>>,
        u: Option<&Bound<'_, PyAny>>,
        t: Option<f64>,
        cells: Option<Vec<(Kind, Bound<'_, PyAny>)>>,
        quantities: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Level> {
        if let Some(h) = h.filter(|h| !(h.is_finite() && *h > 0.0)) {
            return Err(mistake(format!("`h` is {h}: expected a length")));
        }
        if let Some(t) = t.filter(|t| !t.is_finite()) {
            return Err(mistake(format!("`t` is {t}: expected a finite number")));
        }
        let mut given = Vec::new();
        for (name, array) in [("X", X), ("u", u)] {
            given.extend(array.map(|array| (name.to_owned(), array.clone())));
        }
        for (name, array) in quantities.into_iter().flat_map(|it| it.iter()) {
            given.push((name.extract()?, array));
        }
        let mut leading = None;
        let mut snapshot =
            Snapshot { path: "arrays".into(), format: ARRAYS, ..Snapshot::default() };
        snapshot.time = t.map(|value| Time { value, rounding: 0.0 });
        for (name, array) in given {
            let array = of_points(&name, &array, &mut leading)?;
            snapshot.of_points.push(array);
        }
        let rows = leading.map_or(0, |(_, it)| it.iter().product());
        if rows == 0 {
            return Err(mistake("a level has no points: expected arrays with one row for each"));
        }
        if let Some(cells) = cells {
            let of_points = &snapshot.of_points;
            let Some(points) = of_points.iter().find(|it| it.name == "X" || it.name == "x") else {
                return Err(mistake("`cells` are of points: give X, or x and u"));
            };
            snapshot.points = Some(Array { name: String::new(), ..points.clone() });
            snapshot.cells = mesh(&cells, rows)?;
        }
        Ok(Level { h, snapshot })
    }

    /// The time; None of what does not move.
    #[getter]
    fn t(&self) -> Option<f64> {
        self.snapshot.time.map(|it| it.value)
    }

    /// The names of the arrays.
    #[getter]
    fn names(&self) -> Vec<&str> {
        self.snapshot.of_points.iter().map(|it| it.name.as_str()).collect()
    }

    fn __repr__(&self) -> String {
        let h = self.h.map_or(String::new(), |h| format!(" h = {h:?},"));
        format!("<level{h} {} of {} points>", self.names().join(", "), self.snapshot.rows())
    }
}

/// The numbers of an argument, grouped by point. The first argument determines how points are counted.
fn of_points(
    name: &str,
    given: &Bound<'_, PyAny>,
    leading: &mut Option<(String, Vec<usize>)>,
) -> PyResult<Array> {
    let numbers = Numbers::of(name, given)?;
    let shape = numbers.shape();
    let (first, leading) = leading.get_or_insert_with(|| {
        let leading = match (name, shape) {
            ("X" | "x" | "u", [before @ .., _]) if !before.is_empty() => before.to_vec(),
            (_, [first, ..]) => vec![*first],
            (_, []) => Vec::new(),
        };
        (name.to_owned(), leading)
    });
    let Some(own) = shape.strip_prefix(leading.as_slice()) else {
        return Err(mistake(format!(
            "`{name}` has the shape {}, and `{first}` has points along {}: expected a row for each point",
            written(shape),
            written(leading)
        )));
    };
    let components = own.iter().product::<usize>().max(1);
    let (values, stored) = match &numbers {
        Numbers::Single(array) => (all(array), Stored::Single),
        Numbers::Double(array) => (all(array), Stored::Double),
    };
    Ok(Array { name: name.into(), components, values, stored, component_names: Vec::new() })
}

fn all<T: Precision + Into<f64>>(array: &PyReadonlyArrayDyn<'_, T>) -> Vec<f64> {
    use numpy::PyUntypedArrayMethods;
    stretch(array, 1, [0, array.len()]).iter().map(|it| (*it).into()).collect()
}

/// A type of cells.
#[derive(FromPyObject)]
enum Kind {
    /// The number in VTK.
    #[pyo3(transparent)]
    Number(u8),
    /// The name in meshio.
    #[pyo3(transparent)]
    Name(String),
}

impl Kind {
    /// The number in VTK.
    fn number(&self) -> PyResult<u8> {
        let name = match self {
            Kind::Number(number) => return Ok(*number),
            Kind::Name(name) => name,
        };
        let known = KINDS.iter().find(|(it, _)| it == name);
        known.map(|(_, number)| *number).ok_or_else(|| {
            let names = KINDS.map(|(it, _)| it).join(", ");
            mistake(format!("cells of the type `{name}` are not read; expected {names}"))
        })
    }
}

/// The names of types of cells in meshio, and their numbers in VTK.
const KINDS: [(&str, u8); 15] = [
    ("vertex", 1),
    ("line", 3),
    ("triangle", 5),
    ("quad", 9),
    ("tetra", 10),
    ("hexahedron", 12),
    ("wedge", 13),
    ("pyramid", 14),
    ("line3", 21),
    ("triangle6", 22),
    ("quad8", 23),
    ("tetra10", 24),
    ("hexahedron20", 25),
    ("quad9", 28),
    ("hexahedron27", 29),
];

/// The cells of a mesh with this number of points.
fn mesh(given: &[(Kind, Bound<'_, PyAny>)], points: usize) -> PyResult<Cells> {
    let mut cells = Cells::default();
    for (kind, connectivity) in given {
        let kind = kind.number()?;
        let rows: Vec<Vec<usize>> = connectivity.call_method0("tolist")?.extract()?;
        for row in rows {
            if let Some(odd) = row.iter().find(|point| **point >= points) {
                return Err(mistake(format!("a cell has the point {odd}, and there are {points}")));
            }
            cells.points.extend(row);
            cells.types.push(kind);
            cells.ends.push(cells.points.len());
        }
    }
    Ok(cells)
}

/// Results of one mesh: arrays, or the name of files.
#[derive(FromPyObject)]
pub enum Given {
    /// Arrays.
    #[pyo3(transparent)]
    Arrays(Py<Level>),
    /// A path, a folder or a pattern.
    #[pyo3(transparent)]
    Files(std::path::PathBuf),
}

impl Given {
    /// h, where it is given.
    pub fn h(&self) -> Option<f64> {
        match self {
            Given::Arrays(level) => level.get().h,
            Given::Files(_) => None,
        }
    }

    /// The name in messages; `at` is the position of the level.
    pub fn name(&self, at: usize) -> String {
        match self {
            Given::Arrays(_) => format!("level {at}"),
            Given::Files(path) => path.to_string_lossy().into_owned(),
        }
    }

    /// The results; `find` reads the results of files.
    pub fn results(
        &self,
        at: usize,
        find: impl FnOnce(&str) -> anyhow::Result<Results>,
    ) -> anyhow::Result<Results> {
        let name = self.name(at);
        match self {
            Given::Arrays(level) => {
                let snapshot = Snapshot { path: name.clone(), ..level.get().snapshot.clone() };
                Ok(Results { name, snapshots: vec![snapshot] })
            }
            Given::Files(_) => find(&name),
        }
    }
}

/// h of all results, or of none.
pub fn sizes(all: &[Given]) -> PyResult<Vec<f64>> {
    let sizes: Vec<f64> = all.iter().filter_map(Given::h).collect();
    match sizes.len() {
        0 => Ok(sizes),
        known if known == all.len() => Ok(sizes),
        known => Err(mistake(format!(
            "`h` is known of {known} of {} levels: expected all or none",
            all.len()
        ))),
    }
}

/// Refuses arrays of a motion that have no time.
pub fn ensure_timed(all: &[Given], times: &[f64], is_static: bool) -> PyResult<()> {
    let is_timeless = |it: &Given| match it {
        Given::Arrays(level) => level.get().snapshot.time.is_none(),
        Given::Files(_) => false,
    };
    match all.iter().position(is_timeless).filter(|_| times.is_empty() && !is_static) {
        None => Ok(()),
        Some(at) => Err(mistake(format!(
            "level {at} has no time: expected `t=`, as in Level(h, X, u, t=0.01), or `times=`"
        ))),
    }
}

/// The exact solution of a field, for its results.
pub fn exact(opened: &crate::opened::Opened, stop: Stop) -> anyhow::Result<Exact> {
    Exact::new(opened.input.stopped_by(stop), &opened.arguments())
}
