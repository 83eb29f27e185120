//! The named faces of a body: their places and their normals.

use mms_math::coordinates::{Arithmetic, System};

use crate::model::Body;
use crate::region::{Block, Region};
use mms_spec::Face;
use mms_symbolic::expr::{Expr, Function, Graph, HALF, Rational, Symbol};
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;

pub use crate::region::fixed_coordinate;

/// The radius, among the coordinates of [`positions`].
pub const RADIUS: Symbol = Symbol::Coordinate(0);
/// The angle theta, among the coordinates of [`positions`].
pub const ANGLE: Symbol = Symbol::Coordinate(1);
/// The angle phi, among the coordinates of [`positions`] in a sphere.
pub const POLAR_ANGLE: Symbol = Symbol::Coordinate(2);

/// The arithmetic on formulas, for positions and directions.
pub struct Formulas<'a>(pub &'a mut Graph);

impl Arithmetic for Formulas<'_> {
    type Value = Expr;

    fn number(&mut self, number: i8) -> Expr {
        self.0.number(i32::from(number))
    }

    fn times(&mut self, a: &Expr, b: &Expr) -> Expr {
        self.0.mul(*a, *b)
    }

    fn circular(&mut self, angle: &Expr) -> [Expr; 2] {
        [Function::Cos, Function::Sin].map(|function| self.0.call(function, &[*angle]))
    }
}

/// The three coordinates as symbols.
pub fn coordinates(graph: &mut Graph) -> [Expr; 3] {
    [0, 1, 2].map(|axis| graph.symbol(Symbol::Coordinate(axis)))
}

/// The outward reference unit normal N of a face as a function of X, one component per dimension.
///
/// It is constant on flat faces; on circles, cylinders and spheres it is X/R, or -X/R on the inner one, with R of the
/// first two components on a cylinder; on a cone of a sphere it is the direction in which phi grows.
pub fn normal(graph: &mut Graph, body: &Body, dimension: usize, face: Face) -> Vec<Expr> {
    let (axis, is_upper) = fixed_coordinate(face);
    let sign = if is_upper { 1 } else { -1 };
    let mut normal = match (body, face) {
        (Region::Polygon(vertices), Face::Edge(first, _)) => edge_normal(graph, vertices, first),
        (Region::Block(block), Face::Inner | Face::Outer) => {
            let direction = outward(graph, block.system, dimension);
            direction.into_iter().map(|component| graph.scale(component, sign)).collect()
        }
        (Region::Block(block), Face::ThetaMin | Face::ThetaMax) => {
            let [cosine, sine] = Formulas(graph).circular(block.fixed(face).1);
            vec![graph.scale(sine, -sign), graph.scale(cosine, sign)]
        }
        (Region::Block(block), Face::PhiMin | Face::PhiMax) => {
            let [along, across] = Formulas(graph).circular(block.fixed(face).1);
            let direction = outward(graph, System::Polar, 2).into_iter();
            let plane = direction.map(|component| graph.product_of(&[along, component], sign));
            let plane: Vec<Expr> = plane.collect();
            [plane, vec![graph.scale(across, -sign)]].concat()
        }
        _ => (0..dimension).map(|k| graph.number(if k == axis { sign } else { 0 })).collect(),
    };
    normal.resize(dimension, graph.number(0));
    normal
}

/// The outward unit normal of a face of a block, in the coordinates of [`positions`].
pub fn direction(graph: &mut Graph, body: &Body, face: Face) -> [Expr; 3] {
    let system = match body {
        Region::Block(block) => block.system,
        _ => System::Cartesian,
    };
    let symbols = coordinates(graph);
    let (axis, is_upper) = fixed_coordinate(face);
    let direction = system.basis(&mut Formulas(graph), &symbols)[axis];
    direction.map(|component| graph.scale(component, if is_upper { 1 } else { -1 }))
}

trait Products {
    /// A product times a sign.
    fn product_of(&mut self, factors: &[Expr], sign: i32) -> Expr;
}

impl Products for Graph {
    fn product_of(&mut self, factors: &[Expr], sign: i32) -> Expr {
        let product = self.product(factors.iter().map(|factor| (*factor, Rational::ONE)));
        self.scale(product, sign)
    }
}

/// X/R, in the plane or in space.
fn outward(graph: &mut Graph, system: System, dimension: usize) -> Vec<Expr> {
    let count = if system == System::Spherical { 3 } else { 2.min(dimension) };
    let radius = radius(graph, count);
    let inverse = graph.power(radius, -1);
    let coordinates = coordinates(graph);
    coordinates[..count].iter().map(|coordinate| graph.mul(*coordinate, inverse)).collect()
}

/// R = sqrt(X^2 + Y^2), or sqrt(X^2 + Y^2 + Z^2).
fn radius(graph: &mut Graph, count: usize) -> Expr {
    let coordinates = coordinates(graph);
    let squares = coordinates[..count].iter();
    let squares: Vec<_> = squares.map(|it| (graph.power(*it, 2), Rational::ONE)).collect();
    let square = graph.sum(squares);
    graph.power(square, HALF)
}

/// Substitutions for X, Y and Z: their formulas in the coordinates in which the body is a block. The map is empty for a box. On
/// an edge of a polygon the only coordinate is the fraction along the edge, under the symbol of X.
pub fn positions(graph: &mut Graph, body: &Body, face: Option<Face>) -> SortedMap<Symbol, Expr> {
    let symbols = coordinates(graph);
    let place = match (body, face) {
        (Region::Block(Block { system, bounds }), _) if *system != System::Cartesian => {
            let place = system.position(&mut Formulas(graph), &symbols);
            place[..bounds.len()].to_vec()
        }
        (Region::Polygon(vertices), Some(Face::Edge(first, _))) => {
            let (from, along) = edge(graph, vertices, first);
            let way = symbols[0];
            let coordinate = |(from, along): (Expr, Expr)| {
                let moved = graph.mul(along, way);
                graph.add(from, moved)
            };
            from.into_iter().zip(along).map(coordinate).collect()
        }
        _ => return SortedMap::new(),
    };
    (0..place.len()).map(Symbol::Coordinate).zip(place).collect()
}

/// The bounds of the coordinates of [`positions`] on the body or on a face, without those that are constant there.
pub fn ranges(graph: &mut Graph, body: &Body, face: Option<Face>) -> Vec<(Symbol, [Expr; 2])> {
    match (body, face) {
        (Region::Block(block), _) => {
            let constant = face.map(|face| fixed_coordinate(face).0);
            let axes = block.bounds.iter().enumerate();
            axes.filter(|(axis, _)| Some(*axis) != constant)
                .map(|(axis, bounds)| (Symbol::Coordinate(axis), *bounds))
                .collect()
        }
        (Region::Polygon(_), Some(_)) => {
            vec![(Symbol::Coordinate(0), [0, 1].map(|end| graph.number(end)))]
        }
        // The bounds are the extremes of all vertices.
        (Region::Polygon(vertices), None) => {
            (0..2).map(|axis| (Symbol::Coordinate(axis), [vertices[0][axis]; 2])).collect()
        }
        (Region::Nothing(dimension), _) => {
            let ends = [0, 1].map(|end| graph.number(end));
            (0..*dimension).map(|axis| (Symbol::Coordinate(axis), ends)).collect()
        }
    }
}

/// The coordinate of [`positions`] that is constant on a face, and its value.
pub fn constant(body: &Body, face: Face) -> SortedMap<Symbol, Expr> {
    let Region::Block(block) = body else { return SortedMap::new() };
    let (axis, bound) = block.fixed(face);
    SortedMap::from([(Symbol::Coordinate(axis), *bound)])
}

/// The point of a face that corresponds to a point X of the body, as a function of X: the nearest one on a flat face of a box
/// and on the line of an edge; on other faces the one with the same other coordinates.
pub fn projection(graph: &mut Graph, body: &Body, face: Face) -> SortedMap<Symbol, Expr> {
    let symbols = coordinates(graph);
    let point: Vec<Expr> = match (body, face) {
        (Region::Block(block), Face::Inner | Face::Outer) => {
            let (dimension, bound) = (block.bounds.len(), *block.fixed(face).1);
            let direction = outward(graph, block.system, dimension);
            direction.into_iter().map(|component| graph.mul(bound, component)).collect()
        }
        (Region::Block(block), Face::ThetaMin | Face::ThetaMax) => {
            let circular = Formulas(graph).circular(block.fixed(face).1);
            let radius = radius(graph, 2);
            circular.map(|component| graph.mul(radius, component)).to_vec()
        }
        (Region::Block(block), Face::PhiMin | Face::PhiMax) => {
            let [along, across] = Formulas(graph).circular(block.fixed(face).1);
            let radius = radius(graph, 3);
            let direction = outward(graph, System::Polar, 2).into_iter();
            let plane = direction.map(|it| graph.product_of(&[radius, across, it], 1));
            let plane: Vec<Expr> = plane.collect();
            [plane, vec![graph.mul(radius, along)]].concat()
        }
        (Region::Polygon(vertices), Face::Edge(first, _)) => {
            let (from, along) = edge(graph, vertices, first);
            let offsets: Vec<Expr> =
                from.iter().zip(symbols).map(|(from, at)| graph.sub(at, *from)).collect();
            let [way, square] = [&offsets, &along].map(|other| {
                let terms = along.iter().zip(other.iter());
                let terms: Vec<_> =
                    terms.map(|(a, b)| (graph.mul(*a, *b), Rational::ONE)).collect();
                graph.sum(terms)
            });
            let way = graph.div(way, square);
            let moved = along.iter().map(|component| graph.mul(*component, way));
            let moved: Vec<Expr> = moved.collect();
            from.iter().zip(moved).map(|(from, moved)| graph.add(*from, moved)).collect()
        }
        _ => return constant(body, face),
    };
    (0..point.len()).map(Symbol::Coordinate).zip(point).collect()
}

/// The first vertex of an edge, and the vector from it to the second.
fn edge(graph: &mut Graph, vertices: &[[Expr; 2]], first: usize) -> (Vec<Expr>, Vec<Expr>) {
    let (from, to) = (vertices[first], vertices[(first + 1) % vertices.len()]);
    let along = (0..2).map(|axis| graph.sub(to[axis], from[axis])).collect();
    (from.to_vec(), along)
}

/// The vector along an edge, turned to the right, or to the left if the area of the polygon is negative.
fn edge_normal(graph: &mut Graph, vertices: &[[Expr; 2]], first: usize) -> Vec<Expr> {
    let (_, along) = edge(graph, vertices, first);
    let squares: Vec<_> = along.iter().map(|it| (graph.power(*it, 2), Rational::ONE)).collect();
    let square = graph.sum(squares);
    let length = graph.power(square, HALF);
    let mut terms = Vec::new();
    for (at, [x, y]) in vertices.iter().enumerate() {
        let [next_x, next_y] = vertices[(at + 1) % vertices.len()];
        terms.push((graph.mul(*x, next_y), Rational::ONE));
        terms.push((graph.mul(next_x, *y), Rational::NEG_ONE));
    }
    let area = graph.sum(terms);
    let square = graph.power(area, 2);
    let magnitude = graph.power(square, HALF);
    let sign = graph.div(area, magnitude);
    let scale = graph.div(sign, length);
    let back = graph.scale(along[0], -1);
    vec![graph.mul(along[1], scale), graph.mul(back, scale)]
}

/// The faces that a body has with these values of its parameters: there is no face at a radius of 0, at the ends of a whole
/// turn, or at an angle along the axis. `declared` are the faces of its shape.
pub fn existing_faces(
    graph: &mut Graph,
    body: &Body,
    declared: Vec<Face>,
    parameters: &SortedMap<Symbol, Expr>,
) -> Vec<Face> {
    let Region::Block(Block { system, bounds }) = body else { return declared };
    if *system == System::Cartesian {
        return declared;
    }
    let pi = graph.pi();
    let mut is_zero = |terms: Vec<(Expr, Rational)>| {
        let rest = graph.sum(terms);
        let rest = substitute(graph, &[rest], parameters)[0];
        graph.is_zero(rest)
    };
    let one = Rational::ONE;
    let [first, last] = bounds[1];
    let is_disc = is_zero(vec![(bounds[0][0], one.clone())]);
    let turn = vec![(last, one.clone()), (first, Rational::NEG_ONE), (pi, Rational::from(-2))];
    let is_whole = is_zero(turn);
    let [is_up, is_down] = match (system, bounds.get(2)) {
        (System::Spherical, Some([up, down])) => [
            is_zero(vec![(*up, one.clone())]),
            is_zero(vec![(*down, one), (pi, Rational::NEG_ONE)]),
        ],
        _ => [false; 2],
    };
    let exists = |face: &Face| match face {
        Face::Inner => !is_disc,
        Face::ThetaMin | Face::ThetaMax => !is_whole,
        Face::PhiMin => !is_up,
        Face::PhiMax => !is_down,
        Face::Outer | Face::Min(_) | Face::Max(_) | Face::Edge(..) => true,
        Face::RadialMin | Face::RadialMax | Face::AxialMin | Face::AxialMax => true,
    };
    declared.into_iter().filter(exists).collect()
}
