//! The functions of the nodes of a cell: polynomials that are 1 at one node and 0 at the others.

use super::{Form, Local};

/// The form in which shape functions are evaluated.
#[derive(Debug)]
pub(super) enum Functions {
    /// Products along the axes.
    Products(Products),
    /// The functions of a hexahedron, of which the upper four are one.
    Pyramid(Products),
    /// The coefficients of monomials.
    Solved(Solved),
    /// No functions: the values between the points are not known.
    None,
}

impl Functions {
    /// The values of the functions at a place, or their derivatives by a coordinate.
    pub fn at(&self, at: Local, by: Option<usize>) -> Vec<f64> {
        match self {
            Functions::Products(products) => products.at(at, by),
            Functions::Pyramid(products) => {
                let mut all = products.at(at, by);
                let upper = all.split_off(4).iter().sum();
                all.push(upper);
                all
            }
            Functions::Solved(solved) => solved.at(at, by),
            Functions::None => Vec::new(),
        }
    }
}

/// A linear function of the place, which is a barycentric coordinate, and the degree of its polynomials.
#[derive(Debug)]
struct Factor {
    constant: f64,
    slopes: Local,
    degree: usize,
}

/// Functions that are products of polynomials of barycentric coordinates, for evenly spaced nodes (P. Silvester, Int. J. Engng
/// Sci. 7, 1969, 849-861). An axis of a square has two such coordinates, a triangle three.
#[derive(Debug)]
pub(super) struct Products {
    factors: Vec<Factor>,
    /// The degree of each factor's polynomial, node by node.
    nodes: Vec<Vec<usize>>,
}

impl Products {
    /// The functions of nodes in a cell of a form, with a degree along each axis.
    pub fn new(form: Form, dimension: usize, degrees: [u32; 3], nodes: &[Local]) -> Self {
        let groups: &[&[usize]] = match (form, dimension) {
            (Form::Simplex, 2) => &[&[0, 1][..]],
            (Form::Simplex, 3) => &[&[0, 1, 2][..]],
            (Form::Wedge, _) => &[&[0, 1][..], &[2]],
            (_, dimension) => &[&[0][..], &[1], &[2]][..dimension],
        };
        let mut factors = Vec::new();
        for group in groups {
            let degree = degrees[group[0]] as usize;
            let slope = |of: &[usize], by: f64| {
                let mut slopes = [0.0; 3];
                of.iter().for_each(|&axis| slopes[axis] = by);
                slopes
            };
            factors.push(Factor { constant: 1.0, slopes: slope(group, -1.0), degree });
            let along =
                |&axis: &usize| Factor { constant: 0.0, slopes: slope(&[axis], 1.0), degree };
            factors.extend(group.iter().map(along));
        }
        let of_node = |at: &Local| {
            let each = factors.iter().map(|it| (it.degree as f64 * it.value(*at)).round() as usize);
            each.collect()
        };
        Products { nodes: nodes.iter().map(of_node).collect(), factors }
    }

    fn at(&self, at: Local, by: Option<usize>) -> Vec<f64> {
        let tables: Vec<Vec<[f64; 2]>> = self.factors.iter().map(|it| it.polynomials(at)).collect();
        let product = |node: &Vec<usize>, but: usize| -> f64 {
            let each = node.iter().zip(&tables).enumerate();
            each.map(|(at, (&own, table))| if at == but { 1.0 } else { table[own][0] }).product()
        };
        let slope = |node: &Vec<usize>, axis: usize| -> f64 {
            let each = self.factors.iter().zip(node.iter().zip(&tables)).enumerate();
            each.filter(|(_, (factor, _))| factor.slopes[axis] != 0.0)
                .map(|(at, (factor, (&own, table)))| {
                    factor.slopes[axis] * table[own][1] * product(node, at)
                })
                .sum()
        };
        let function = |node| match by {
            None => product(node, usize::MAX),
            Some(axis) => slope(node, axis),
        };
        self.nodes.iter().map(function).collect()
    }
}

impl Factor {
    fn value(&self, at: Local) -> f64 {
        let along = self.slopes.iter().zip(at).map(|(slope, x)| slope * x);
        self.constant + along.sum::<f64>()
    }

    /// The polynomials of each degree up to the factor's degree that are 0 at the earlier steps, and their slopes.
    fn polynomials(&self, at: Local) -> Vec<[f64; 2]> {
        let n = self.degree as f64;
        let scaled = n * self.value(at);
        let mut all = vec![[1.0, 0.0]];
        for step in 0..self.degree {
            let [value, slope] = all[step];
            let (by, of) = (scaled - step as f64, (step + 1) as f64);
            all.push([value * by / of, (slope * by + n * value) / of]);
        }
        all
    }
}

/// Functions by the coefficients of monomials.
#[derive(Debug)]
pub(super) struct Solved {
    monomials: Vec<[u32; 3]>,
    /// The coefficients of each node.
    coefficients: Vec<Vec<f64>>,
}

impl Solved {
    /// The functions of nodes, with as many monomials as nodes.
    pub fn new(nodes: &[Local], monomials: Vec<[u32; 3]>) -> Self {
        Solved { coefficients: solve(nodes, &monomials), monomials }
    }

    fn at(&self, at: Local, by: Option<usize>) -> Vec<f64> {
        let monomial = |it: &[u32; 3]| match by {
            None => value(*it, at),
            Some(axis) => derivative(*it, at, axis),
        };
        let monomials: Vec<f64> = self.monomials.iter().map(monomial).collect();
        let sum = |of: &Vec<f64>| of.iter().zip(&monomials).map(|(c, m)| c * m).sum();
        self.coefficients.iter().map(sum).collect()
    }
}

pub(super) fn value(exponents: [u32; 3], at: Local) -> f64 {
    (0..3).map(|axis| at[axis].powi(exponents[axis] as i32)).product()
}

fn derivative(mut exponents: [u32; 3], at: Local, axis: usize) -> f64 {
    match exponents[axis] {
        0 => 0.0,
        power => {
            exponents[axis] -= 1;
            f64::from(power) * value(exponents, at)
        }
    }
}

/// The coefficients of the polynomials that are 1 at one node and 0 at the others, by elimination.
fn solve(nodes: &[Local], monomials: &[[u32; 3]]) -> Vec<Vec<f64>> {
    let count = nodes.len();
    let unit = |row: usize| (0..count).map(move |column| f64::from(row == column));
    let mut rows: Vec<Vec<f64>> = nodes
        .iter()
        .enumerate()
        .map(|(row, &node)| monomials.iter().map(|&it| value(it, node)).chain(unit(row)).collect())
        .collect();
    for column in 0..count {
        let largest =
            |a: &usize, b: &usize| rows[*a][column].abs().total_cmp(&rows[*b][column].abs());
        let pivot = (column..count).max_by(largest).unwrap_or(column);
        rows.swap(column, pivot);
        let by = rows[column][column];
        rows[column].iter_mut().for_each(|it| *it /= by);
        let pivot = rows[column].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(row, _)| *row != column) {
            let factor = row[column];
            row.iter_mut().zip(&pivot).for_each(|(it, pivot)| *it -= factor * pivot);
        }
    }
    (0..count).map(|node| rows.iter().map(|row| row[count + node]).collect()).collect()
}
