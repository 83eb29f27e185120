//! Points sorted into the cells of a lattice, so that neighbours of a place are found quickly.

/// Points in the cells of a lattice.
#[derive(Debug)]
pub struct Lattice<'a> {
    points: &'a [f64],
    size: usize,
    step: f64,
    /// The cell of each point, sorted.
    all: Vec<([i64; 3], usize)>,
    /// The least and the greatest cell along each axis.
    bounds: [[i64; 3]; 2],
}

impl<'a> Lattice<'a> {
    /// Sorts points with `size` coordinates into cells with edges of length `step`.
    pub fn new(points: &'a [f64], size: usize, step: f64) -> Self {
        let mut lattice = Lattice { points, size, step, all: Vec::new(), bounds: [[0; 3]; 2] };
        let cell = |(at, point): (usize, &[f64])| (lattice.cell(point, 0.0), at);
        lattice.all = points.chunks(size).enumerate().map(cell).collect();
        lattice.all.sort_unstable();
        let cells = || lattice.all.iter().map(|(cell, _)| *cell);
        let each = |pick: fn(i64, i64) -> i64| {
            let both = |a: [i64; 3], b: [i64; 3]| [0, 1, 2].map(|axis| pick(a[axis], b[axis]));
            cells().reduce(both).unwrap_or_default()
        };
        lattice.bounds = [each(i64::min), each(i64::max)];
        lattice
    }

    /// The cell of a place moved by `by` along each axis.
    fn cell(&self, place: &[f64], by: f64) -> [i64; 3] {
        let mut cell = [0; 3];
        // Places beyond the range of integers are in the last cell.
        let along = |x: &f64| ((x + by) / self.step).floor() as i64;
        cell.iter_mut().zip(place).for_each(|(to, x)| *to = along(x));
        cell
    }

    /// The points in all cells that intersect the cube around a place with half edge `reach`.
    pub fn near(&self, place: &[f64], reach: f64) -> impl Iterator<Item = usize> {
        let (low, high) = (self.cell(place, -reach), self.cell(place, reach));
        // Cells that differ only along the last axis are adjacent.
        let (last, [least, most]) = (self.size - 1, self.bounds);
        let across = move |axis: usize| match axis < last {
            true => low[axis].max(least[axis])..=high[axis].min(most[axis]),
            false => 0..=0,
        };
        let rows = across(0).flat_map(move |i| across(1).map(move |j| [i, j]));
        rows.flat_map(move |row| {
            let end = |of: [i64; 3]| {
                let mut cell = of;
                cell[..last].copy_from_slice(&row[..last]);
                cell
            };
            let (from, to) = (end(low), end(high));
            let start = self.all.partition_point(|(it, _)| *it < from);
            let own = self.all[start..].iter().take_while(move |(it, _)| *it <= to);
            own.map(|(_, at)| *at)
        })
    }

    /// The points within a distance of a place, each with its distance.
    pub fn within(&self, place: &[f64], reach: f64) -> impl Iterator<Item = (usize, f64)> {
        let distance = move |at: usize| {
            let point = &self.points[at * self.size..][..self.size];
            point.iter().zip(place).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
        };
        let all = self.near(place, reach).map(move |at| (at, distance(at)));
        all.filter(move |(_, distance)| *distance <= reach)
    }

    /// Whether there is a point within a distance of a place.
    pub fn has_within(&self, place: &[f64], reach: f64) -> bool {
        // Most often there is one in the same cell.
        let is_beside = self.step * (self.size as f64).sqrt() <= reach;
        is_beside && self.near(place, 0.0).next().is_some()
            || self.within(place, reach).next().is_some()
    }

    /// The distance to the nearest other point, for one of every `every` points; empty for a single point.
    pub fn distances(&self, every: usize) -> Vec<f64> {
        let count = self.points.len() / self.size;
        let nearest = |at: usize| {
            let point = &self.points[at * self.size..][..self.size];
            let found = |reach: f64| {
                let others = self.within(point, reach).filter(|(other, _)| *other != at);
                others.map(|(_, distance)| distance).reduce(f64::min)
            };
            // Doubles the distance each time; for evenly spread points the first is enough.
            (0..64).find_map(|power| found(1.25 * self.step * f64::from(power).exp2()))
        };
        if count < 2 { Vec::new() } else { (0..count).step_by(every).filter_map(nearest).collect() }
    }
}
