//! Orders that a start lowers. Finite elements that start with exact values at their nodes differ from the projection about
//! which their errors oscillate. The difference in u is of order k + 1, but it is rough where cells have neighbours of another
//! shape or where k is 2. It excites waves as long as a cell, which lower the order of v by one and the order of a by two.

use mms_exact::Exact;
use mms_spec::quantity::Quantity;

use super::MeasuredMesh;
use crate::measured::Objection;
use crate::table::ExpectedOrders;

/// The first displacements and velocities of a solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// The exact values at its nodes.
    Interpolation,
    /// The elliptic (Ritz) projection of the exact motion, so that no order is lowered.
    Projection,
}

impl Start {
    /// The start of this name.
    ///
    /// # Errors
    /// There is no such start.
    pub fn of(name: &str) -> Result<Self, String> {
        match name {
            "interpolation" => Ok(Start::Interpolation),
            "projection" => Ok(Start::Projection),
            _ => Err("expected interpolation or projection".into()),
        }
    }
}

/// The least orders of velocities and of accelerations; `None` where they are not lowered.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lowered {
    velocity: Option<f64>,
    acceleration: Option<f64>,
    why: &'static str,
}

/// The largest imbalance of cells that may be round-off of their corners.
const BALANCED: f64 = 0.01;

/// The least power of h by which imbalance falls, if cells are the image of regular ones under a smooth map.
const SMOOTH: f64 = 0.5;

/// The largest curvature that rounding alone makes in an affine function, relative to the largest value.
const ROUNDING: f64 = 1e-9;

impl Lowered {
    /// Finds the lowered orders from the option for the start, the field, and the meshes with their h.
    ///
    /// # Errors
    /// The errors of [`Exact::values`].
    pub fn new(
        orders: &ExpectedOrders,
        (levels, sizes): (&[MeasuredMesh], &[f64]),
        exact: &mut Exact,
    ) -> anyhow::Result<Self> {
        let degree = levels.iter().filter_map(|it| it.found.degree).min();
        let is_irregular = are_irregular(levels, sizes);
        let why = match (orders.start, degree) {
            (Some(Start::Projection), _) | (None, None) => return Ok(Self::default()),
            (Some(Start::Interpolation), _) => "as `--start` says",
            (None, Some(_)) if is_irregular => "on irregular meshes",
            (None, Some(2..)) => "and cells of degree 2",
            (None, Some(_)) => return Ok(Self::default()),
        };
        let order = degree.map_or(orders.usual, |degree| f64::from(degree + 1));
        let is_regular = degree.is_some() && !is_irregular;
        let [of_displacement, of_velocity] =
            [bends(Quantity::Displacement, exact)?, bends(Quantity::Velocity, exact)?];
        Ok(match (of_displacement, of_velocity) {
            (true, _) => {
                let acceleration = if is_regular { order - 2.0 } else { 0.0 };
                Self { velocity: Some(order - 1.0), acceleration: Some(acceleration), why }
            }
            (false, true) => Self { velocity: None, acceleration: Some(order - 1.0), why },
            (false, false) => Self::default(),
        })
    }

    /// The least order of a quantity.
    pub fn of(&self, quantity: Quantity) -> Option<f64> {
        match quantity {
            Quantity::Velocity => self.velocity,
            Quantity::Acceleration => self.acceleration,
            _ => None,
        }
    }

    /// Whether errors of a quantity need not fall with h.
    pub fn is_blind_to(&self, quantity: Quantity, orders: &ExpectedOrders) -> bool {
        self.of(quantity).is_some_and(|least| least <= 0.0)
            && orders.given(quantity.name(), quantity.symbol(), "l2").is_none()
    }

    /// Explains the expected order of a quantity whose order is lowered.
    pub fn note(&self, quantity: Quantity, orders: &ExpectedOrders) -> Option<String> {
        let (least, symbol) = (self.of(quantity)?, quantity.symbol());
        if orders.given(quantity.name(), symbol, "l2").is_some() {
            return None;
        }
        let start = format!("after a start from exact values at nodes, {}", self.why);
        let other = format!(
            "use `--start projection` for another start, or `--expected-order {symbol}=..` for another order"
        );
        Some(match least <= 0.0 {
            true => format!("{symbol}: its error need not fall {start}: it is not judged; {other}"),
            false => format!("expected order of {symbol}: from {least} on, {start}; {other}"),
        })
    }
}

/// Whether cells around edges stay out of balance on finer meshes.
fn are_irregular(levels: &[MeasuredMesh], sizes: &[f64]) -> bool {
    let imbalance = |at: usize| levels[at].found.imbalance.unwrap_or(0.0);
    let by_size = |a: &usize, b: &usize| sizes[*a].total_cmp(&sizes[*b]);
    let all = || 0..levels.len();
    let (Some(coarsest), Some(finest)) = (all().max_by(by_size), all().min_by(by_size)) else {
        return false;
    };
    let smooth = imbalance(coarsest) * (sizes[finest] / sizes[coarsest]).powf(SMOOTH);
    imbalance(finest) > BALANCED && (coarsest == finest || imbalance(finest) > smooth)
}

/// Whether a vector of the exact motion is not affine in X at the start.
fn bends(quantity: Quantity, exact: &mut Exact) -> anyhow::Result<bool> {
    let components = exact.components(quantity);
    let middle = exact.body.point(&[0.45; 3]);
    let mut places = Vec::new();
    for along in [[0.1, 0.3, 0.2], [0.7, 0.2, 0.4], [0.3, 0.8, 0.9], [0.6, 0.5, 0.1]] {
        let there = exact.body.point(&along);
        for part in [0.0, 0.125, 0.25] {
            places.extend(middle.iter().zip(&there).map(|(a, b)| b + part * (a - b)));
        }
    }
    let values = exact.values(quantity, exact.window[0], &places)?;
    let largest = values.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
    Ok(values.chunks(3 * components).any(|three| {
        (0..components).any(|it| {
            let bend = three[it] - 2.0 * three[components + it] + three[2 * components + it];
            bend.abs() > ROUNDING * largest
        })
    }))
}

/// The objection to results if no quantity is left to judge.
pub fn objection() -> Objection {
    let why = "after this start a right error need not fall: judge u as well";
    Objection { why: why.into(), is_to_all: true }
}
