//! Properties that every shape function has: new ones are found here by themselves.

use mms_runtime::shape::{AxisWeights, MAX_NODES, Shape, ShapeVisitor, Stencil};
use mms_runtime::{Matrix, Real, ShapeName, Vector};
use proptest::prelude::*;

const COUNT: usize = 16;

/// The nodes of an axis with their weights and gradients.
fn nodes<T: Real>(weights: &AxisWeights<T>) -> impl Iterator<Item = (f64, f64, f64)> {
    (0..weights.count).map(|k| {
        let node = (weights.first + k as i64) as f64;
        (node, weights.weight[k].to_f64(), weights.weight_gradient[k].to_f64())
    })
}

struct OneAxis {
    position: f64,
    half_width: f64,
}

impl ShapeVisitor for OneAxis {
    type Output = ();

    fn visit<S: Shape>(self) {
        let Self { position, half_width } = self;
        let at = |position: f64| S::axis_weights::<f64>(position, half_width);
        let weights = at(position);
        assert!(weights.count <= MAX_NODES);
        for (node, weight, gradient) in nodes(&weights) {
            assert!((0.0..=1.0).contains(&weight), "weight {weight} of node {node}");
            let far = (position - node).abs() >= 1.0 + half_width;
            assert!(!far || (weight.abs() < 1e-15 && gradient.abs() < 1e-7), "support");
            // Central differences; a kink in between makes them one-sided, of first order.
            let weight_at = |x: f64| {
                nodes(&at(x))
                    .find(|&(other, ..)| other == node)
                    .map_or(0.0, |(_, weight, _)| weight)
            };
            let step = 1e-6;
            let slope = (weight_at(position + step) - weight_at(position - step)) / (2.0 * step);
            let tolerance = 1e-9 + step / half_width;
            assert!((slope - gradient).abs() < tolerance, "{slope} and {gradient} at {position}");
        }
    }
}

struct Tensor<T, const D: usize> {
    position: Vector<T, D>,
    half_width: Vector<T, D>,
}

impl<T: Real, const D: usize> ShapeVisitor for Tensor<T, D> {
    type Output = ();

    /// sum w = 1, sum w x_i = x, sum grad w = 0, sum x_i (x) grad w = I, on a grid with h = 1/4.
    fn visit<S: Shape>(self) {
        let h = T::of(0.25);
        let stride: [usize; D] = std::array::from_fn(|a| COUNT.pow(a as u32));
        let Self { position, half_width } = self;
        let stencil = Stencil::new::<S>(&position, &half_width, h, &[COUNT; D], &stride).unwrap();
        let mut sum = -T::one();
        let mut moment = -position * h;
        let mut gradient = Vector::<T, D>::zeros();
        let mut gradient_moment = -Matrix::<T, D>::identity();
        for (node, w, grad_w) in stencil.nodes() {
            let coordinate = |a: usize| T::of((node / stride[a] % COUNT) as f64) * h;
            let x_i = Vector::<T, D>::from_fn(|a, _| coordinate(a));
            sum += w;
            moment += x_i * w;
            gradient += grad_w;
            gradient_moment += x_i * grad_w.transpose();
        }
        let round_off = 600.0 * T::default_epsilon().to_f64();
        for residual in [sum.abs(), moment.amax(), gradient.amax(), gradient_moment.amax()] {
            assert!(residual.to_f64() < round_off, "{residual:?} at {position} {half_width}");
        }
    }
}

fn check_tensor<T: Real, const D: usize>(
    shape: ShapeName,
    position: [f64; 3],
    half_width: [f64; 3],
) {
    let vector = |values: [f64; 3]| Vector::<T, D>::from_fn(|a, _| T::of(values[a]));
    shape.visit(Tensor { position: vector(position), half_width: vector(half_width) });
}

proptest! {
    #[test]
    fn one_axis(cell in 4..8i32, offset in 1e-3..0.999f64, half_width in 0.05..0.99f64) {
        for &shape in ShapeName::ALL {
            shape.visit(OneAxis { position: f64::from(cell) + offset, half_width });
        }
    }

    #[test]
    fn unity_and_linear_reproduction(
        position in prop::array::uniform3(4.0..8.0f64),
        half_width in prop::array::uniform3(0.05..0.99f64),
    ) {
        for &shape in ShapeName::ALL {
            check_tensor::<f64, 1>(shape, position, half_width);
            check_tensor::<f64, 2>(shape, position, half_width);
            check_tensor::<f64, 3>(shape, position, half_width);
            check_tensor::<f32, 1>(shape, position, half_width);
            check_tensor::<f32, 2>(shape, position, half_width);
            check_tensor::<f32, 3>(shape, position, half_width);
        }
    }
}

/// A particle on a node, domains that end on nodes, and the default quarter of a cell.
#[test]
fn special_positions() {
    for &shape in ShapeName::ALL {
        for position in [4.0, 4.25, 4.5, 4.75] {
            for half_width in [0.25, 0.5, 0.75] {
                check_tensor::<f64, 3>(shape, [position; 3], [half_width; 3]);
                check_tensor::<f32, 3>(shape, [position; 3], [half_width; 3]);
            }
        }
    }
}

struct OffGrid;

impl ShapeVisitor for OffGrid {
    type Output = ();

    fn visit<S: Shape>(self) {
        for position in [-1.0, -1e-9, 7.1, 8.0, 1e300, f64::NAN, f64::INFINITY] {
            let position = Vector::<f64, 1>::new(position);
            let half_width = Vector::repeat(0.25);
            assert!(Stencil::new::<S>(&position, &half_width, 1.0, &[8], &[1]).is_none());
        }
    }
}

#[test]
fn a_particle_off_the_grid_has_no_stencil() {
    ShapeName::ALL.iter().for_each(|shape| shape.visit(OffGrid));
}

/// The average of the hat over a domain inside one cell is the hat at its middle; over a domain that
/// straddles a node it is 1 - (r^2 + l^2)/(2 l) (Bardenhagen & Kober 2004).
#[test]
fn gimp_weights_of_the_literature() {
    let l = 0.25;
    let weight = |offset: f64| {
        struct At(f64, f64);
        impl ShapeVisitor for At {
            type Output = f64;
            fn visit<S: Shape>(self) -> f64 {
                let weights = S::axis_weights::<f64>(4.0 + self.0, self.1);
                nodes(&weights).find(|&(node, ..)| node == 4.0).map_or(0.0, |(_, weight, _)| weight)
            }
        }
        ShapeName::Cpgimp.visit(At(offset, l))
    };
    for r in [-0.2, 0.0, 0.1, 0.25] {
        assert!((weight(r) - (1.0 - (r * r + l * l) / (2.0 * l))).abs() < 1e-15);
    }
    for r in [-0.7, 0.3, 0.75] {
        assert!((weight(r) - (1.0 - r.abs())).abs() < 1e-15);
    }
    for r in [-1.2f64, 0.8, 1.25] {
        assert!((weight(r) - (1.0 + l - r.abs()).powi(2) / (4.0 * l)).abs() < 1e-15);
    }
}

/// An unlisted file would silently not be compiled.
#[test]
fn every_file_is_listed() {
    let listed = [
        ("shape", mms_runtime::ShapeName::NAMES),
        ("integrator", mms_runtime::IntegratorName::NAMES),
    ];
    for (folder, names) in listed {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(folder);
        for file in std::fs::read_dir(folder).unwrap() {
            let path = file.unwrap().path();
            let stem = path.file_stem().unwrap().to_str().unwrap();
            assert!(stem == "mod" || names.contains(&stem), "{} is not listed", path.display());
        }
    }
}

#[test]
fn names_round_trip_and_unknown_ones_are_explained() {
    for &shape in ShapeName::ALL {
        assert_eq!(shape.to_string().parse(), Ok(shape));
    }
    let unknown = "cubic".parse::<ShapeName>().unwrap_err();
    let text = "unknown shape function `cubic`; known are: linear, ugimp, cpgimp";
    assert!(unknown.to_string().starts_with(text), "{unknown}");
}
