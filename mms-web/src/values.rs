//! Numbers at a point, and the motion of a mesh.

use std::collections::BTreeMap;

use mms_exact::Exact;
use mms_mechanics::extent::Extent;
use mms_spec::quantity::{Quantity, Shape};
use serde::Serialize;

use crate::field::named;
use crate::mistake::Mistake;
use crate::request::FieldText;

/// The largest number of frames, and of cells along a side, that are drawn.
const MOST: usize = 200;

/// All quantities at a point.
#[derive(Serialize)]
pub struct Values {
    values: Vec<Value>,
}

#[derive(Serialize)]
struct Value {
    quantity: String,
    symbol: String,
    unit: String,
    /// The components; a number that is not finite is null.
    components: Vec<f64>,
    /// Rows and columns.
    shape: [usize; 2],
}

fn exact(field: &FieldText, set: &BTreeMap<String, f64>) -> Result<Exact, Mistake> {
    let settings: Vec<_> = set.iter().map(|(name, value)| format!("{name}={value:?}")).collect();
    Ok(Exact::new(field.compiled()?, &settings)?)
}

fn validate_finite(numbers: &[f64]) -> Result<(), Mistake> {
    match numbers.iter().all(|it| it.is_finite()) {
        true => Ok(()),
        false => Err(Mistake::of("expected finite coordinates and a finite time")),
    }
}

/// All quantities of a field at a point X and a time, to the bits of `mms eval`.
pub fn values(
    field: &FieldText,
    at: &[f64],
    time: f64,
    set: &BTreeMap<String, f64>,
) -> Result<Values, Mistake> {
    let mut exact = exact(field, set)?;
    validate_finite(&[at, &[time]].concat())?;
    if at.len() != exact.dimension {
        return Err(Mistake::of(format!(
            "X has {} coordinates; expected {}",
            at.len(),
            exact.dimension
        )));
    }
    let quantities: Vec<_> = exact.input().compiled.quantities().collect();
    let mut values = Vec::new();
    for quantity in quantities.into_iter().filter(|it| !it.takes_normal()) {
        let components = exact.values(quantity, time, at)?;
        let rows = match quantity.shape() {
            Shape::Tensor => exact.rows(),
            _ => components.len(),
        };
        values.push(Value {
            quantity: quantity.name().to_owned(),
            symbol: quantity.symbol().to_owned(),
            unit: exact.input().compiled.unit_of(quantity),
            shape: [rows, components.len() / rows.max(1)],
            components,
        });
    }
    Ok(Values { values })
}

/// The motion of a mesh.
#[derive(Serialize)]
pub struct Motion {
    dimension: usize,
    /// X of each point.
    reference: Vec<Vec<f64>>,
    /// Points of each cell: two, or the four corners of a quadrilateral.
    cells: Vec<Vec<usize>>,
    times: Vec<f64>,
    /// x of each point at each time.
    points: Vec<Vec<Vec<f64>>>,
    /// The colour of each point at each time.
    values: Vec<Vec<f64>>,
    range: [f64; 2],
    unit: String,
    /// The names of quantities that can be shown as colour.
    colors: Vec<String>,
}

/// Moves a mesh over the body, with a quantity as colour: the Frobenius norm of a vector or tensor.
pub fn motion(
    field: &FieldText,
    color: &str,
    frames: usize,
    cells: usize,
) -> Result<Motion, Mistake> {
    let mut exact = exact(field, &BTreeMap::new())?;
    let color = named(exact.input(), &[color.to_owned()])?[0];
    if color.takes_normal() {
        return Err(Mistake::of("a traction needs a normal, and cannot be shown as a colour"));
    }
    let (frames, sides) = (frames.clamp(1, MOST), cells.clamp(1, MOST));
    let Mesh { points: reference, cells } = mesh(&exact.body, exact.dimension, sides);
    let flat = reference.concat();
    let [first, last] = exact.window;
    let steps = if exact.input().is_static() { 1 } else { frames };
    let time = |step: usize| first + (last - first) * step as f64 / (steps - 1).max(1) as f64;
    let times: Vec<f64> = (0..steps).map(time).collect();
    let dimension = exact.dimension;
    let (mut points, mut values) = (Vec::new(), Vec::new());
    for time in &times {
        let positions = exact.values(Quantity::Position, *time, &flat)?;
        let width = positions.len() / reference.len();
        points.push(positions.chunks(width).map(|it| it[..dimension].to_vec()).collect());
        let numbers = exact.values(color, *time, &flat)?;
        let size = |it: &[f64]| match it {
            [one] => *one,
            several => several.iter().map(|it| it * it).sum::<f64>().sqrt(),
        };
        values.push(numbers.chunks(numbers.len() / reference.len()).map(size).collect());
    }
    let all = || values.iter().flat_map(|it: &Vec<f64>| it).filter(|it| it.is_finite());
    let range = [
        all().copied().fold(f64::INFINITY, f64::min),
        all().copied().fold(f64::NEG_INFINITY, f64::max),
    ];
    let compiled = &exact.input().compiled;
    let colors = compiled.quantities().filter(|it| !it.takes_normal());
    Ok(Motion {
        dimension,
        unit: compiled.unit_of(color),
        colors: colors.map(|it| it.name().to_owned()).collect(),
        reference,
        cells,
        times,
        points,
        values,
        range,
    })
}

/// Points X, and cells by the positions of their points.
#[derive(Default)]
struct Mesh {
    points: Vec<Vec<f64>>,
    cells: Vec<Vec<usize>>,
}

impl Mesh {
    /// Adds a lattice of quadrilaterals, `sides` along each side. `point` takes two fractions; a cell is kept if `keeps`
    /// accepts the fractions of its middle.
    fn add_lattice(
        &mut self,
        sides: usize,
        point: impl Fn(f64, f64) -> Vec<f64>,
        keeps: impl Fn(f64, f64) -> bool,
    ) {
        let start = self.points.len();
        let fraction = |step: f64| step / sides as f64;
        let all = |count: usize| (0..count).flat_map(move |b| (0..count).map(move |a| (a, b)));
        let points = all(sides + 1).map(|(a, b)| point(fraction(a as f64), fraction(b as f64)));
        self.points.extend(points);
        let kept =
            all(sides).filter(|(a, b)| keeps(fraction(*a as f64 + 0.5), fraction(*b as f64 + 0.5)));
        let corner = |a: usize, b: usize| start + b * (sides + 1) + a;
        self.cells.extend(kept.map(|(a, b)| {
            vec![corner(a, b), corner(a + 1, b), corner(a + 1, b + 1), corner(a, b + 1)]
        }));
    }
}

/// The axis of a solid across which two of its sides lie, after the axes along them.
const SIDES: [[usize; 3]; 3] = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];

/// A mesh over a body: of a solid, the quadrilaterals of its six sides; of a polygon, the cells of a lattice whose middles lie in
/// it.
fn mesh(body: &Extent<f64>, dimension: usize, sides: usize) -> Mesh {
    let mut mesh = Mesh::default();
    match (dimension, body) {
        (1, _) => {
            mesh.points = (0..=sides).map(|it| body.point(&[it as f64 / sides as f64])).collect();
            mesh.cells = (0..sides).map(|it| vec![it, it + 1]).collect();
        }
        (2, Extent::Polygon(_)) => {
            let [lower, upper] = body.bounding_box();
            let along = |axis: usize, part: f64| lower[axis] + (upper[axis] - lower[axis]) * part;
            let point = |a, b| vec![along(0, a), along(1, b)];
            mesh.add_lattice(sides, point, |a, b| body.contains(&point(a, b)));
        }
        (2, _) => mesh.add_lattice(sides, |a, b| body.point(&[a, b]), |_, _| true),
        _ => {
            for ([first, second, across], held) in
                SIDES.iter().flat_map(|it| [(it, 0.0), (it, 1.0)])
            {
                let point = |a, b| {
                    let mut at = [0.0; 3];
                    (at[*first], at[*second], at[*across]) = (a, b, held);
                    body.point(&at)
                };
                mesh.add_lattice(sides, point, |_, _| true);
            }
        }
    }
    mesh
}
