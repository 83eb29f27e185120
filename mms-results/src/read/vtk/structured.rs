//! Points and cells of grids that are defined by their extents: "VTK File Formats" (Kitware), structured datasets.

use super::super::numbers::{NumberType, count};
use super::super::text::number;
use crate::wanted::Wanted;
use crate::{Array, Cells, Mistake, Stored};

/// Types of cells along no axis, one, two and three: a vertex, a line, a quadrilateral, a hexahedron.
const TYPES: [u8; 4] = [1, 3, 9, 12];

/// The corners of a cell by their steps along its axes, in the order of VTK.
const CORNERS: [[usize; 3]; 8] =
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];

/// The least digits of a number that may have been rounded to them.
const MANY: usize = 6;

/// The digits from which on a number counts as exact.
const ALL: usize = 15;

/// The points of a grid along each axis: the number of the first point, and the count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Extent {
    first: [i64; 3],
    counts: [usize; 3],
    points: usize,
    cells: usize,
}

impl Extent {
    /// Parses the first and the last number along each axis; in a grid without points the last precedes the first.
    pub fn parse(text: &str) -> Result<Self, Mistake> {
        let ends: Option<Vec<i64>> =
            text.split_ascii_whitespace().map(|it| it.parse().ok()).collect();
        let ends = ends.and_then(|it| <[i64; 6]>::try_from(it).ok()).ok_or_else(|| {
            Mistake::new(format!(
                "extent `{text}`: expected the first and the last point along three axes"
            ))
        })?;
        let count = |axis: usize| {
            let count = ends[2 * axis + 1].checked_sub(ends[2 * axis])?.checked_add(1)?;
            usize::try_from(count.max(0)).ok()
        };
        let counts = [count(0), count(1), count(2)].map(|it| it.unwrap_or(usize::MAX));
        Extent { first: [ends[0], ends[2], ends[4]], ..Extent::default() }.of(counts)
    }

    /// Sets the number of points along each axis.
    pub fn of(self, counts: [usize; 3]) -> Result<Self, Mistake> {
        let product = |of: [usize; 3]| of.into_iter().try_fold(1_usize, usize::checked_mul);
        let is_empty = counts.contains(&0);
        let points = if is_empty { Some(0) } else { product(counts) };
        let points =
            points.filter(|it| count(*it, 3, NumberType::Float(8)).is_ok()).ok_or_else(|| {
                Mistake::new(format!("a grid of {counts:?} points: no file holds as many"))
            })?;
        let along = |count: usize| if count > 1 { count - 1 } else { count };
        let cells = if is_empty { 0 } else { counts.map(along).iter().product() };
        Ok(Extent { counts, points, cells, ..self })
    }

    /// The number of points.
    pub fn points(&self) -> usize {
        self.points
    }

    /// The number of cells.
    pub fn cells(&self) -> usize {
        self.cells
    }

    /// The number of points along each axis.
    pub fn counts(&self) -> [usize; 3] {
        self.counts
    }

    /// The cells, with as many dimensions as there are axes with more than one point.
    pub fn mesh(&self, wanted: &Wanted<'_>) -> Result<Cells, Mistake> {
        let [x, y, _] = self.counts;
        let strides = [1, x, x.wrapping_mul(y)];
        let axes: Vec<usize> = (0..3).filter(|&axis| self.counts[axis] > 1).collect();
        let dimension = axes.len();
        let corner =
            |at: &[usize; 3]| axes.iter().zip(at).map(|(&axis, by)| by * strides[axis]).sum();
        let corners: Vec<usize> = CORNERS[..1 << dimension].iter().map(corner).collect();
        // Besides its points, a cell has an end, and a type of one byte.
        wanted.reserve("the mesh", self.cells.saturating_mul(corners.len() + 2))?;
        let mut points = Vec::with_capacity(self.cells * corners.len());
        let steps = self.counts.map(|count| if count > 1 { count - 1 } else { count });
        let steps = if self.cells == 0 { [0; 3] } else { steps };
        for k in 0..steps[2] {
            for j in 0..steps[1] {
                let row = k * strides[2] + j * strides[1];
                points.extend(
                    (row..row + steps[0]).flat_map(|at| corners.iter().map(move |it| at + it)),
                );
            }
        }
        let ends = (1..=self.cells).map(|cell| cell * corners.len()).collect();
        Ok(Cells { types: vec![TYPES[dimension]; self.cells], points, ends })
    }

    /// The places of the points: the origin, moved along each axis by `moved` of the axis and the position.
    fn places(
        &self,
        origin: [f64; 3],
        moved: impl Fn(usize, usize) -> [f64; 3],
        stored: Stored,
        wanted: &Wanted<'_>,
    ) -> Result<Array, Mistake> {
        wanted.reserve("the places of the points", 3 * self.points)?;
        let mut values = Vec::with_capacity(3 * self.points);
        let sum = |a: [f64; 3], b: [f64; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
        let [x, y, z] = if self.points == 0 { [0; 3] } else { self.counts };
        for k in 0..z {
            let layer = sum(origin, moved(2, k));
            for j in 0..y {
                let row = sum(layer, moved(1, j));
                (0..x).for_each(|i| values.extend(sum(row, moved(0, i))));
            }
        }
        Ok(Array { name: "Points".into(), components: 3, values, stored, ..Array::default() })
    }

    /// The places of the points from coordinates along each axis.
    pub fn along(&self, axes: &[Array; 3], wanted: &Wanted<'_>) -> Result<Array, Mistake> {
        let stored = axes.iter().map(|it| it.stored).fold(axes[0].stored, Stored::coarser);
        let moved = |axis: usize, at: usize| {
            let mut by = [0.0; 3];
            by[axis] = axes[axis].values[at];
            by
        };
        if axes.iter().zip(self.counts).any(|(it, count)| it.values.len() != count) {
            return Err(Mistake::new(format!(
                "expected as many coordinates along each axis as there are points: {:?}",
                self.counts
            )));
        }
        self.places([0.0; 3], moved, stored, wanted)
    }
}

/// An origin, and the steps from a point to the next along each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// The place of the point with the numbers 0.
    pub origin: [f64; 3],
    /// The distance of neighbours along each axis.
    pub spacing: [f64; 3],
    /// The direction of each axis in columns, row by row.
    pub direction: [f64; 9],
}

impl Default for Lattice {
    fn default() -> Self {
        let direction = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        Lattice { origin: [0.0; 3], spacing: [1.0; 3], direction }
    }
}

impl Lattice {
    /// The places of the points of an extent.
    pub fn places(&self, extent: &Extent, wanted: &Wanted<'_>) -> Result<Array, Mistake> {
        let moved = |axis: usize, at: usize| {
            let number = (extent.first[axis] as f64 + at as f64) * self.spacing[axis];
            [0, 1, 2].map(|row| match self.direction[3 * row + axis] {
                0.0 => 0.0,
                along => along * number,
            })
        };
        extent.places(self.origin, moved, self.stored(extent), wanted)
    }

    /// The precision of the places: steps of few digits are exact, and others may have been rounded to their digits, as by
    /// programs that write six.
    fn stored(&self, extent: &Extent) -> Stored {
        let numbers = self.origin.iter().chain(&self.spacing);
        let most = numbers.map(|it| digits(*it)).max().unwrap_or(0);
        if !(MANY..ALL).contains(&most) {
            return Stored::Double;
        }
        let written = Stored::Digits(most as u32);
        let off = |axis: usize| {
            let ends = [0, extent.counts[axis].saturating_sub(1)];
            let number = |at: usize| (extent.first[axis] as f64 + at as f64).abs();
            let steps = ends.map(number).into_iter().fold(0.0, f64::max);
            written.rounding(self.origin[axis]) + steps * written.rounding(self.spacing[axis])
        };
        let off = (0..3).map(off).fold(0.0, f64::max);
        // At least half a unit in the last place of this size.
        Stored::Fixed((-(2.0 * off).log10()).floor().max(0.0) as u32)
    }
}

/// The number of significant digits of a number; binary fractions with few digits are exact.
fn digits(value: f64) -> usize {
    const FEW: f64 = (1_u32 << 20) as f64;
    if (value * FEW).fract() == 0.0 {
        return 0;
    }
    let written = format!("{value:e}");
    let mantissa = written.split('e').next().unwrap_or("");
    mantissa.bytes().filter(u8::is_ascii_digit).count()
}

/// Parses `N` finite numbers.
pub fn numbers<const N: usize>(text: &str) -> Result<[f64; N], Mistake> {
    let all: Option<Vec<f64>> = text
        .split_ascii_whitespace()
        .map(|it| number(it).filter(|value| value.is_finite()))
        .collect();
    all.and_then(|it| it.try_into().ok())
        .ok_or_else(|| Mistake::new(format!("`{text}`: expected {N} finite numbers")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_are_of_the_axes_along_which_they_extend() {
        let wanted = crate::names::everything(&crate::names::KNOWN);
        let extent = |text: &str| Extent::parse(text).unwrap();
        for (text, kind, points, cells) in [
            ("0 2 0 3 0 4", 12, 60, 24),
            ("1 3 -1 2 5 5", 9, 12, 6),
            ("0 2 7 7 0 4", 9, 15, 8),
            ("0 0 0 0 0 4", 3, 5, 4),
            ("3 3 0 0 0 0", 1, 1, 1),
            ("0 -1 0 -1 0 -1", 0, 0, 0),
            ("0 3 0 -1 0 3", 0, 0, 0),
        ] {
            let found = extent(text);
            let mesh = found.mesh(&wanted).unwrap();
            assert_eq!(
                (found.points(), found.cells(), mesh.len()),
                (points, cells, cells),
                "{text}"
            );
            assert!(mesh.types.iter().all(|it| *it == kind), "{text}");
            assert!(mesh.validate(points).is_ok(), "{text}");
            let largest = mesh.points.iter().max().map_or(0, |it| it + 1);
            assert_eq!(largest, points, "{text}");
        }
        assert_eq!(extent("0 1 2 2 0 1").mesh(&wanted).unwrap().points, [0, 1, 3, 2]);
        for text in ["", "0 1 0 1 0", "0 1 0 1 0 x", "0 4294967295 0 4294967295 0 4294967295"] {
            assert!(Extent::parse(text).is_err(), "{text}");
        }
        assert!(Extent::parse(&format!("{} {} 0 1 0 1", i64::MIN, i64::MAX)).is_err());
    }

    #[test]
    fn steps_are_as_exact_as_their_digits() {
        let stored = |spacing: f64, origin: f64| {
            let lattice =
                Lattice { origin: [origin, 0.0, 0.0], spacing: [spacing; 3], ..Lattice::default() };
            lattice.stored(&Extent::parse("0 3 0 0 0 0").unwrap())
        };
        assert_eq!(stored(0.1, 0.0), Stored::Double);
        assert_eq!(stored(1.0 / 3.0, 0.0), Stored::Double);
        assert_eq!(stored(1.0 / 1024.0, 0.5), Stored::Double);
        // Three steps, each off by half a unit.
        assert_eq!(stored(0.333333, 0.0), Stored::Fixed(5));
        assert_eq!(stored(0.333333, 0.5), Stored::Fixed(5));
    }
}
