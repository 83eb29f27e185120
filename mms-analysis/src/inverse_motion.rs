//! The inverse of a motion: X(x, t), the reference position of the point that is at x at a time t.
//!
//! The body is cut into tiles on each of which the motion is proved to be one to one: with Y near the inverse of F in the
//! middle, I - Y F is bounded in interval arithmetic, and is a contraction if each row of it sums to less than 1. A point is
//! searched in every tile whose image may contain it. There the Krawczyk operator (Neumaier, Interval Methods for Systems of
//! Equations, 1990, section 5.2)
//!
//! ```text
//! K(B) = c - Y (x(c) - x) + (I - Y F(B)) (B - c)
//! ```
//!
//! encloses each solution in B. If K(B) and B are disjoint there is none; if K(B) lies within B there is exactly one. Newton's
//! method finds it, and the test uses a box of a few roundings around it. A tile that is decided in neither way is halved. So
//! all X of a point are found, or an error reports that this is not decided.

use mms_codegen::Compiled;
use mms_math::Scalar as _;
use mms_math::coordinates::System;
use mms_mechanics::extent::Extent;
use mms_mechanics::sample::domain;
use mms_mechanics::{Output, Program};
use mms_program::interpret::{Interpreter, Number as _, Point};
use mms_program::interval::Interval;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Rational;
use mms_symbolic::sorted::SortedMap;

/// The largest number of tiles of a body.
const MOST_TILES: usize = 4096;

/// The largest number of tiles that are halved for one point.
const MOST_HALVED: usize = 2000;

/// The slowest contraction that is accepted; tiles with slower ones are halved.
const SLOWEST: f64 = 0.5;

/// The margin of a tile to each side, as a fraction of its edges, so that a solution on its boundary lies within.
const MARGIN: f64 = 0.05;

/// The largest number of steps of Newton's method.
const STEPS: usize = 20;

/// The reason why a point has no known reference position.
#[derive(Clone, Debug, PartialEq)]
pub enum Unplaced {
    /// No point of the body is there at that time.
    Outside,
    /// Two points of the body are there: two of its reference positions.
    Several([Vec<f64>; 2]),
    /// No decision whether a point is there: a place near which one may be.
    Undecided(Vec<f64>),
}

/// The inverse of the motion of a field at one time.
pub struct Inverse<'a> {
    motion: Instant<'a>,
    body: Extent<f64>,
    tiles: Vec<Tile>,
}

/// The motion at one time, in intervals and in double precision.
struct Instant<'a> {
    plan: Vec<bool>,
    bounds: Interpreter<'a, Interval, Output>,
    values: Interpreter<'a, f64, Output>,
}

/// A part of the body.
#[derive(Clone, Debug)]
struct Tile {
    /// The tile without its margin.
    sides: Vec<Interval>,
    /// x of the tile and its margin.
    image: Vec<Interval>,
    /// The contraction; `None` if the motion is not proved to be one to one.
    contraction: Option<Contraction>,
}

/// Y near the inverse of F, and I - Y F over a tile with its margin.
#[derive(Clone, Debug)]
struct Contraction {
    inverse: Vec<f64>,
    rest: Vec<Interval>,
}

/// The result of a search in a tile.
enum TileSolution {
    Nothing,
    One(Vec<f64>),
    Undecided,
}

const POSITION: Output = Output::Quantity(Quantity::Position);
const GRADIENT: Output = Output::Quantity(Quantity::DeformationGradient);

impl<'a> Inverse<'a> {
    /// Inverts the motion of a compiled field, which needs position and deformation gradient, with some parameters set by
    /// index.
    pub fn new(compiled: &'a Compiled, set: &SortedMap<usize, Rational>, time: f64) -> Self {
        let values = compiled.parameters::<f64>(set);
        let (body, _) = domain(&compiled.program, &values);
        let bounds = compiled.parameters::<Interval>(set);
        let mut motion = Instant::new(&compiled.program, &bounds, &values, time);
        let tiles = tiles(&mut motion, &body);
        Inverse { motion, body, tiles }
    }

    /// X of the point that is at x; `rounding` is the largest deviation of each of its coordinates from the intended one.
    ///
    /// # Errors
    /// No point of the body is there, more than one is, or this is not decided.
    pub fn reference(&mut self, x: &[f64], rounding: f64) -> Result<Vec<f64>, Unplaced> {
        let mut open: Vec<Tile> =
            self.tiles.iter().filter(|tile| tile.may_hold(x)).cloned().collect();
        let (mut found, mut halved) = (Vec::<Vec<f64>>::new(), 0);
        while let Some(tile) = open.pop() {
            match tile.solve(&mut self.motion, x) {
                TileSolution::Nothing => {}
                TileSolution::One(reference) => {
                    let near = tile.reach(rounding, x);
                    found.extend(self.in_body(reference, near).filter(|it| is_new(&found, it)));
                }
                TileSolution::Undecided if halved == MOST_HALVED => {
                    return Err(Unplaced::Undecided(middle(&tile.sides)));
                }
                TileSolution::Undecided => {
                    halved += 1;
                    let halves = tile.halves().map(|sides| Tile::new(&mut self.motion, sides));
                    open.extend(halves.into_iter().filter(|half| half.may_hold(x)));
                }
            }
        }
        match found.len() {
            0 => Err(Unplaced::Outside),
            1 => Ok(found.remove(0)),
            _ => Err(Unplaced::Several([found.remove(0), found.remove(0)])),
        }
    }

    /// Moves a point within rounding of the body to its boundary; `None` for points farther away.
    fn in_body(&self, mut point: Vec<f64>, near: f64) -> Option<Vec<f64>> {
        if !self.body.contains(&point) && self.body.distance(&point) > near {
            return None;
        }
        if let Some(bounds) = self.body.box_bounds() {
            point.iter_mut().zip(bounds).for_each(|(x, [a, b])| *x = x.clamp(*a, *b));
        }
        Some(point)
    }
}

/// Whether a solution differs from all solutions of other tiles.
fn is_new(found: &[Vec<f64>], point: &[f64]) -> bool {
    let size = |x: &[f64]| x.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
    let far = |other: &Vec<f64>| {
        other.iter().zip(point).any(|(a, b)| {
            (a - b).abs() > 1e-9 * size(point).max(size(other)).max(f64::MIN_POSITIVE)
        })
    };
    found.iter().all(far)
}

impl<'a> Instant<'a> {
    fn new(program: &'a Program, bounds: &[Interval], values: &[f64], time: f64) -> Self {
        let mut bounds = Interpreter::new(program, bounds);
        bounds.set_time(&Interval::from_f64(time));
        let mut values = Interpreter::new(program, values);
        values.set_time(&time);
        Instant { plan: values.plan(&[POSITION, GRADIENT]), bounds, values }
    }

    /// x and F over a box.
    fn over(&mut self, place: &[Interval]) -> [Vec<Interval>; 2] {
        self.bounds.set_point(&self.plan, Point::at(place));
        [POSITION, GRADIENT].map(|output| within(self.bounds.output(output), place.len()))
    }

    /// x and F at a point.
    fn at(&mut self, place: &[f64]) -> [Vec<f64>; 2] {
        self.values.set_point(&self.plan, Point::at(place));
        [POSITION, GRADIENT].map(|output| within(self.values.output(output), place.len()))
    }
}

/// The entries of x or F in the coordinates of points: F of an axisymmetric field also has a row and a column around the axis.
fn within<T>(entries: Vec<T>, dimension: usize) -> Vec<T> {
    let rows = entries.len().isqrt();
    let is_around = |at: usize| at / rows >= dimension || at % rows >= dimension;
    let is_tensor = entries.len() > 3;
    let kept = entries.into_iter().enumerate().filter(|(at, _)| !is_tensor || !is_around(*at));
    kept.map(|(_, entry)| entry).collect()
}

/// Cuts the body until the motion is one to one on each part, or there are too many parts.
fn tiles(motion: &mut Instant<'_>, body: &Extent<f64>) -> Vec<Tile> {
    let [lower, upper] = match body {
        // A square around the origin, for any part of the turn.
        Extent::Block(block) if block.system == System::Polar && block.bounds.len() == 2 => {
            let outer = block.bounds[0][1];
            [vec![-outer; 2], vec![outer; 2]]
        }
        _ => body.bounding_box(),
    };
    let all = lower.iter().zip(&upper).map(|(a, b)| Interval::new(*a, *b)).collect();
    let (mut open, mut done) = (vec![Tile::new(motion, all)], Vec::new());
    while let Some(tile) = open.pop() {
        if tile.contraction.is_some() || open.len() + done.len() >= MOST_TILES {
            done.push(tile);
            continue;
        }
        let halves = tile.halves().into_iter().filter(|sides| may_meet(body, sides));
        // The largest tiles are cut first.
        halves.for_each(|sides| open.insert(0, Tile::new(motion, sides)));
    }
    done
}

/// Whether a box may contain a point of the body.
fn may_meet(body: &Extent<f64>, sides: &[Interval]) -> bool {
    match body {
        Extent::Block(block) if block.system != System::Cartesian => {
            let among = if block.system == System::Spherical { 3 } else { 2 };
            let [inner, outer] = block.bounds[0];
            let squares = sides[..among].iter().map(|side| side.square());
            let squared = squares.reduce(|sum, square| sum + square);
            squared.is_none_or(|it| it.upper() >= inner * inner && it.lower() <= outer * outer)
        }
        Extent::Block(_) | Extent::Nothing(_) => true,
        Extent::Polygon(_) => {
            let reach = sides.iter().map(|side| side.width().powi(2)).sum::<f64>().sqrt();
            body.distance(&middle(sides)) <= reach
        }
    }
}

impl Tile {
    fn new(motion: &mut Instant<'_>, sides: Vec<Interval>) -> Self {
        let wide: Vec<Interval> = sides.iter().map(|side| widened(*side)).collect();
        let middle: Vec<f64> = middle(&sides);
        let [natural, gradient] = motion.over(&wide);
        let [at_middle, _] = motion.over(&exact(&middle));
        let dimension = sides.len();
        let change = |row: usize| {
            let terms = (0..dimension).map(|axis| {
                gradient[row * dimension + axis] * (wide[axis] - Interval::from_f64(middle[axis]))
            });
            terms.fold(at_middle[row], |sum, term| sum + term)
        };
        let image = natural.iter().enumerate().map(|(row, whole)| whole.meet(change(row)));
        let image = image.collect();
        let [_, slope] = motion.at(&middle);
        let contraction = Contraction::new(&slope, &gradient, dimension);
        Tile { sides, image, contraction }
    }

    fn may_hold(&self, x: &[f64]) -> bool {
        self.image.iter().zip(x).all(|(side, x)| !side.is_defined() || side.contains(*x))
    }

    /// The largest distance of a solution from the intended point.
    fn reach(&self, rounding: f64, x: &[f64]) -> f64 {
        let size = x.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
        let largest = self.contraction.iter().flat_map(|it| &it.inverse);
        let largest = largest.fold(1.0, |most: f64, it| most.max(it.abs()));
        4.0 * x.len() as f64 * largest * (rounding + f64::EPSILON * size)
    }

    /// The two halves of the tile, cut across its widest side.
    fn halves(&self) -> [Vec<Interval>; 2] {
        let width = |axis: &usize| self.sides[*axis].width();
        let widest = (0..self.sides.len()).max_by(|a, b| width(a).total_cmp(&width(b)));
        let widest = widest.unwrap_or(0);
        let side = self.sides[widest];
        [(side.lower(), side.middle()), (side.middle(), side.upper())].map(|(lower, upper)| {
            let mut sides = self.sides.clone();
            sides[widest] = Interval::new(lower, upper);
            sides
        })
    }

    /// The solution in the tile and its margin, if there is one.
    fn solve(&self, motion: &mut Instant<'_>, x: &[f64]) -> TileSolution {
        let Some(contraction) = &self.contraction else { return TileSolution::Undecided };
        let [at_middle, _] = motion.over(&exact(&middle(&self.sides)));
        let step = contraction.step(&at_middle, x);
        let offset = |side: &Interval| *side - Interval::from_f64(side.middle());
        let offsets: Vec<Interval> = self.sides.iter().map(offset).collect();
        let moved = contraction.krawczyk(&step, &offsets);
        let meets = |(side, moved): (&Interval, &Interval)| {
            side.lower() <= moved.upper() && moved.lower() <= side.upper()
        };
        if !offsets.iter().zip(&moved).all(meets) {
            return TileSolution::Nothing;
        }
        let wide: Vec<Interval> = self.sides.iter().map(|side| widened(*side)).collect();
        let start = self.sides.iter().zip(&moved).zip(&wide).map(|((side, moved), wide)| {
            (side.middle() + moved.middle()).clamp(wide.lower(), wide.upper())
        });
        let found = newton(motion, x, start.collect(), &wide);
        match found.and_then(|found| contraction.verify(motion, x, &found, &wide)) {
            Some(found) => TileSolution::One(found),
            None => TileSolution::Undecided,
        }
    }
}

impl Contraction {
    /// The contraction of a tile; `None` if I - Y F is no contraction.
    fn new(slope: &[f64], gradient: &[Interval], dimension: usize) -> Option<Self> {
        let inverse = inverse(slope, dimension)?;
        let entry = |row: usize, column: usize| {
            let terms = (0..dimension).map(|axis| {
                let factor = Interval::from_f64(inverse[row * dimension + axis]);
                factor * gradient[axis * dimension + column]
            });
            let one = Interval::from_f64(if row == column { 1.0 } else { 0.0 });
            terms.fold(one, |sum, term| sum - term)
        };
        let rest: Vec<Interval> =
            (0..dimension * dimension).map(|at| entry(at / dimension, at % dimension)).collect();
        let is_slow = |row: &[Interval]| {
            let sum: f64 = row.iter().map(|entry| entry.farthest()).sum();
            !(row.iter().all(|entry| entry.is_defined()) && sum <= SLOWEST)
        };
        (!rest.chunks(dimension).any(is_slow)).then_some(Contraction { inverse, rest })
    }

    /// Y (x(c) - x).
    fn step(&self, at_middle: &[Interval], x: &[f64]) -> Vec<Interval> {
        let rest: Vec<Interval> =
            at_middle.iter().zip(x).map(|(at, x)| *at - Interval::from_f64(*x)).collect();
        let rows = self.inverse.chunks(x.len());
        rows.map(|row| {
            let terms = row.iter().zip(&rest).map(|(y, rest)| Interval::from_f64(*y) * *rest);
            terms.fold(Interval::from_f64(0.0), |sum, term| sum + term)
        })
        .collect()
    }

    /// K(B) - c = -Y (x(c) - x) + (I - Y F) (B - c).
    fn krawczyk(&self, step: &[Interval], offsets: &[Interval]) -> Vec<Interval> {
        let rows = self.rest.chunks(step.len()).zip(step);
        rows.map(|(row, step)| {
            let terms = row.iter().zip(offsets).map(|(rest, offset)| *rest * *offset);
            terms.fold(-*step, |sum, term| sum + term)
        })
        .collect()
    }

    /// The middle of an enclosure of the only solution near a place, if it is proved to lie within the tile.
    fn verify(
        &self,
        motion: &mut Instant<'_>,
        x: &[f64],
        place: &[f64],
        wide: &[Interval],
    ) -> Option<Vec<f64>> {
        let [at_place, _] = motion.over(&exact(place));
        let step = self.step(&at_place, x);
        // A contraction by 1/2 maps a box of four steps into one of three.
        let radius = step.iter().fold(0.0, |most: f64, it| most.max(it.farthest()));
        let offset = Interval::new(-4.0 * radius, 4.0 * radius);
        let sides = place.iter().map(|it| Interval::from_f64(*it) + offset);
        let is_in_tile = wide.iter().zip(sides).all(|(wide, side)| wide.encloses(side));
        let moved = self.krawczyk(&step, &vec![offset; place.len()]);
        let is_proved = moved.iter().all(|it| it.is_defined() && offset.encloses(*it));
        let enclosed = place.iter().zip(&moved).map(|(place, moved)| place + moved.middle());
        (is_in_tile && is_proved).then(|| enclosed.collect())
    }
}

/// Newton's method, within a box.
fn newton(
    motion: &mut Instant<'_>,
    x: &[f64],
    mut place: Vec<f64>,
    wide: &[Interval],
) -> Option<Vec<f64>> {
    let dimension = x.len();
    for _ in 0..STEPS {
        let [at, slope] = motion.at(&place);
        let inverse = inverse(&slope, dimension)?;
        let mut largest = 0.0_f64;
        for axis in 0..dimension {
            let row = &inverse[axis * dimension..][..dimension];
            let step: f64 = row.iter().zip(at.iter().zip(x)).map(|(y, (at, x))| y * (at - x)).sum();
            let to = (place[axis] - step).clamp(wide[axis].lower(), wide[axis].upper());
            largest = largest.max((to - place[axis]).abs() / wide[axis].width());
            place[axis] = to;
        }
        if largest.is_nan() {
            return None;
        }
        if largest < 1e-15 {
            break;
        }
    }
    Some(place)
}

/// The inverse of a square matrix by Gauss-Jordan elimination with pivots; `None` if it is singular.
fn inverse(matrix: &[f64], size: usize) -> Option<Vec<f64>> {
    let mut left = matrix.to_vec();
    let mut right = vec![0.0; size * size];
    (0..size).for_each(|k| right[k * size + k] = 1.0);
    for k in 0..size {
        let magnitude = |row: &usize| left[row * size + k].abs();
        let pivot = (k..size).max_by(|a, b| magnitude(a).total_cmp(&magnitude(b)))?;
        for matrix in [&mut left, &mut right] {
            (0..size).for_each(|column| matrix.swap(k * size + column, pivot * size + column));
        }
        let scale = 1.0 / left[k * size + k];
        if !scale.is_finite() {
            return None;
        }
        for matrix in [&mut left, &mut right] {
            matrix[k * size..][..size].iter_mut().for_each(|entry| *entry *= scale);
        }
        for row in (0..size).filter(|row| *row != k) {
            let factor = left[row * size + k];
            for matrix in [&mut left, &mut right] {
                (0..size).for_each(|column| {
                    matrix[row * size + column] -= factor * matrix[k * size + column];
                });
            }
        }
    }
    right.iter().all(|it| it.is_finite()).then_some(right)
}

fn widened(side: Interval) -> Interval {
    let margin = MARGIN * side.width();
    Interval::new(side.lower() - margin, side.upper() + margin)
}

fn middle(sides: &[Interval]) -> Vec<f64> {
    sides.iter().map(|side| side.middle()).collect()
}

fn exact(place: &[f64]) -> Vec<Interval> {
    place.iter().map(|it| Interval::from_f64(*it)).collect()
}
