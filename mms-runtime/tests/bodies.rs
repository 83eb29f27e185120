//! Bodies filled with particles: volumes, faces and domains.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use mms_runtime::body::{Filling, bounding_box};
use mms_runtime::{Body, Face, Fill, Matrix, Vector};

fn cuboid<const D: usize>(lower: [f64; 3], upper: [f64; 3]) -> Body<f64, D> {
    let corner = |values: [f64; 3]| Vector::from_fn(|a, _| values[a]);
    Body::Box { lower: corner(lower), upper: corner(upper) }
}

fn annulus(theta: [f64; 2]) -> Body<f64, 2> {
    Body::Annulus { inner: 0.4, outer: 1.1, theta }
}

fn fill<const D: usize>(body: &Body<f64, D>, fill: Fill, spacing: [f64; 3]) -> Filling<D> {
    Filling::new(body, fill, &Vector::from_fn(|a, _| spacing[a])).unwrap()
}

/// The number of pieces of a face, their total area, and the sum of their areas times normals.
fn face<const D: usize>(filling: &Filling<D>, face: Face) -> (usize, f64, Vector<f64, D>) {
    let pieces = filling.pieces.iter().filter(|piece| piece.face == face);
    pieces.fold((0, 0.0, Vector::zeros()), |(count, area, sum), piece| {
        (count + 1, area + piece.area.norm(), sum + piece.area)
    })
}

/// sum A = 0 over a closed surface, and sum x.A = D V: the theorem of Gauss, exact for these pieces.
fn closed_surface<const D: usize>(filling: &Filling<D>, tolerance: f64) {
    let sum: Vector<f64, D> = filling.pieces.iter().map(|piece| piece.area).sum();
    assert!(sum.amax() < tolerance, "{sum}");
    let flux: f64 = filling.pieces.iter().map(|piece| piece.position.dot(&piece.area)).sum();
    let volume: f64 = filling.volume.iter().sum();
    assert!((flux - D as f64 * volume).abs() < 1e-12, "{flux} {volume}");
}

/// Tests that every array has one entry per particle, and a domain the volume of its edges.
fn domains<const D: usize>(filling: &Filling<D>) {
    assert!(!filling.is_empty());
    for length in [filling.len(), filling.volume.len(), filling.half_edges.len()] {
        assert_eq!(length, filling.position.len());
    }
    for (edges, volume) in filling.half_edges.iter().zip(&filling.volume) {
        let product = mms_runtime::tensor::determinant(&(edges * 2.0));
        assert!((product / volume - 1.0).abs() < 1e-12, "{product} {volume}");
    }
    for piece in &filling.pieces {
        assert!(piece.particle < filling.len());
        // The piece is on its particle's domain, outwards of the domain's middle.
        let outward = piece.position - filling.position[piece.particle];
        assert!(outward.dot(&piece.area) > 0.0, "{piece:?}");
    }
}

/// Both fills of a box are equal; the number of particles leaves no gap for any spacing.
fn full_box<const D: usize>() {
    let (lower, upper) = ([-0.3, 0.1, 2.0], [0.7, 0.65, 2.3]);
    let body = cuboid::<D>(lower, upper);
    let spacing = [0.11, 0.1, 0.07]; // 9.1, 5.5 and 4.3 of them
    let filling = fill(&body, Fill::Cartesian, spacing);
    let counts = [9, 6, 4];
    assert_eq!(filling.len(), counts[..D].iter().product::<usize>());
    assert_eq!(filling.position, fill(&body, Fill::Fitted, spacing).position);
    domains(&filling);
    let edges: Vec<f64> = (0..D).map(|a| upper[a] - lower[a]).collect();
    let volume: f64 = edges.iter().product();
    assert!((filling.volume.iter().sum::<f64>() / volume - 1.0).abs() < 1e-12);
    closed_surface(&filling, 1e-12);
    for a in 0..D {
        for (name, side) in [(Face::Min(a), -1.0), (Face::Max(a), 1.0)] {
            let (pieces, area, sum) = face(&filling, name);
            assert_eq!(pieces, filling.len() / counts[a]);
            assert!((area - volume / edges[a]).abs() < 1e-12, "{name}: {area}");
            let mut normal = Vector::<f64, D>::zeros();
            normal[a] = side;
            assert!((sum - normal * area).amax() < 1e-12, "{name}: {sum}");
            let plane = if side < 0.0 { lower[a] } else { upper[a] };
            for piece in filling.pieces.iter().filter(|piece| piece.face == name) {
                assert!((piece.position[a] - plane).abs() < 1e-12, "{piece:?}");
            }
        }
    }
}

#[test]
fn boxes_are_full() {
    full_box::<1>();
    full_box::<2>();
    full_box::<3>();
}

/// Rings divided by rays have exact volumes and exact arcs.
#[test]
fn fitted_annuli_are_full() {
    for theta in [[0.0, FRAC_PI_2], [0.3, 1.1], [-2.0, 2.5], [0.0, TAU], [1.0, 1.0 + TAU]] {
        let turn = theta[1] - theta[0];
        let filling = fill(&annulus(theta), Fill::Fitted, [0.05, 0.06, 0.0]);
        domains(&filling);
        let volume = turn / 2.0 * (1.1 * 1.1 - 0.4 * 0.4);
        assert!((filling.volume.iter().sum::<f64>() / volume - 1.0).abs() < 1e-12);
        let is_ring = turn > TAU - 1e-9;
        let faces = [
            (Face::Inner, 0.4 * turn),
            (Face::Outer, 1.1 * turn),
            (Face::ThetaMin, if is_ring { 0.0 } else { 0.7 }),
            (Face::ThetaMax, if is_ring { 0.0 } else { 0.7 }),
        ];
        for (name, length) in faces {
            let (_, area, _) = face(&filling, name);
            assert!((area - length).abs() < 1e-12, "{name}: {area}");
        }
        // An arc's length times the normal at its middle, instead of the chord: longer by turn^2/24 of one piece.
        let rays = face(&filling, Face::Outer).0 as f64;
        closed_surface(&filling, 1.1 * turn * (turn / rays).powi(2) / 20.0);
        let outward = |piece: &&mms_runtime::body::Piece<2>| match piece.face {
            Face::Inner => -piece.position,
            Face::Outer => piece.position,
            Face::ThetaMin => Vector::<f64, 2>::new(theta[0].sin(), -theta[0].cos()),
            _ => Vector::<f64, 2>::new(-theta[1].sin(), theta[1].cos()),
        };
        for piece in &filling.pieces {
            let normal = outward(&piece).normalize();
            assert!((piece.area.normalize() - normal).amax() < 1e-12, "{piece:?}");
        }
    }
}

fn cylinder(inner: f64, theta: [f64; 2]) -> Body<f64, 3> {
    Body::Cylinder { inner, outer: 1.1, theta, z: [-0.3, 0.5] }
}

fn sphere(inner: f64, theta: [f64; 2], phi: [f64; 2]) -> Body<f64, 3> {
    Body::Sphere { inner, outer: 1.1, theta, phi }
}

/// An L, and a triangle whose vertices run clockwise.
fn polygons() -> [(Body<f64, 2>, f64, Vec<f64>); 2] {
    let named = |vertices: &[[f64; 2]]| Body::Polygon {
        vertices: vertices.to_vec(),
        names: ["a", "b", "c", "d", "e", "f"][..vertices.len()].to_vec(),
    };
    let angle = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let triangle = [[0.0, 0.0], [0.3, 0.9], [1.2, 0.0]];
    [
        (named(&angle), 3.0, vec![2.0, 1.0, 1.0, 1.0, 1.0, 2.0]),
        (named(&triangle), 0.54, vec![0.9f64.sqrt(), 1.62f64.sqrt(), 1.2]),
    ]
}

/// The volume and the areas of all faces, against closed forms.
fn measures<const D: usize>(body: &Body<f64, D>, volume: f64, areas: &[(Face, f64)]) {
    let filling = fill(body, Fill::Fitted, [0.11, 0.12, 0.13]);
    domains(&filling);
    let sum: f64 = filling.volume.iter().sum();
    assert!((sum / volume - 1.0).abs() < 1e-12, "{body:?}: {sum}, not {volume}");
    let names: Vec<Face> = areas.iter().map(|(name, _)| *name).collect();
    assert_eq!(mms_runtime::body::faces(body), names);
    for (name, exact) in areas {
        let (_, area, _) = face(&filling, *name);
        assert!((area / exact - 1.0).abs() < 1e-12, "{body:?}, {name}: {area}, not {exact}");
    }
}

#[test]
fn round_bodies_in_space_are_full() {
    for inner in [0.0, 0.4] {
        let ring = (1.1f64 * 1.1 - inner * inner) / 2.0;
        let hollow = |area: f64| (inner > 0.0).then_some((Face::Inner, area));
        let ends = |area: f64| [(Face::Min(2), area), (Face::Max(2), area)];
        let outside = |area: f64| [(Face::Outer, area)];
        let of = |parts: &[&[(Face, f64)]]| parts.concat();
        let whole = of(&[
            hollow(inner * TAU * 0.8).as_slice(),
            &outside(1.1 * TAU * 0.8),
            &ends(ring * TAU),
        ]);
        measures(&cylinder(inner, [0.0, TAU]), ring * TAU * 0.8, &whole);
        let rays = [Face::ThetaMin, Face::ThetaMax].map(|face| (face, (1.1 - inner) * 0.8));
        let sector = of(&[
            hollow(inner * 1.9 * 0.8).as_slice(),
            &outside(1.1 * 1.9 * 0.8),
            &rays,
            &ends(ring * 1.9),
        ]);
        measures(&cylinder(inner, [0.2, 2.1]), ring * 1.9 * 0.8, &sector);
        let ball = (1.1f64.powi(3) - inner.powi(3)) / 3.0;
        let whole =
            of(&[hollow(inner * inner * 2.0 * TAU).as_slice(), &outside(1.1 * 1.1 * 2.0 * TAU)]);
        measures(&sphere(inner, [0.0, TAU], [0.0, PI]), ball * 2.0 * TAU, &whole);
        // Between two cones, and between two half planes.
        let [up, down] = [0.5f64, 2.0];
        let height = up.cos() - down.cos();
        let part = of(&[
            hollow(inner * inner * 1.9 * height).as_slice(),
            &outside(1.1 * 1.1 * 1.9 * height),
            &[Face::ThetaMin, Face::ThetaMax].map(|face| (face, ring * (down - up))),
            &[(Face::PhiMin, ring * 1.9 * up.sin()), (Face::PhiMax, ring * 1.9 * down.sin())],
        ]);
        measures(&sphere(inner, [0.2, 2.1], [up, down]), ball * 1.9 * height, &part);
    }
}

#[test]
fn polygons_are_full() {
    for (body, area, lengths) in polygons() {
        let faces = mms_runtime::body::faces(&body);
        let lengths: Vec<_> = faces.into_iter().zip(lengths).collect();
        measures(&body, area, &lengths);
        closed_surface(&fill(&body, Fill::Fitted, [0.09; 3]), 1e-12);
    }
}

/// The orders of integrals over particles and pieces, on three meshes each: the trace of the second moment of volume, the
/// difference between the flux of X^3 through the faces and its divergence, and the sum of all areas, which should be 0.
fn orders<const D: usize>(body: &Body<f64, D>, second_moment: f64) {
    let errors = |spacing: f64| {
        let filling = fill(body, Fill::Fitted, [spacing; 3]);
        let moment: f64 =
            filling.position.iter().zip(&filling.volume).map(|(x, v)| v * x.norm_squared()).sum();
        let inside: f64 =
            filling.position.iter().zip(&filling.volume).map(|(x, v)| v * 3.0 * x[0] * x[0]).sum();
        let flux: f64 =
            filling.pieces.iter().map(|piece| piece.area[0] * piece.position[0].powi(3)).sum();
        let open: Vector<f64, D> = filling.pieces.iter().map(|piece| piece.area).sum();
        [(moment - second_moment).abs() / second_moment, (flux - inside).abs(), open.norm()]
    };
    let meshes = [0.08, 0.04, 0.02].map(errors);
    for what in 0..3 {
        let [coarse, _, fine] = meshes.map(|errors| errors[what]);
        // Numbers of parts are rounded, so that a mesh is not exactly twice as fine; the order is computed over both steps.
        let order = (coarse / fine).log2() / 2.0;
        assert!(fine < 1e-13 || (1.7..2.6).contains(&order), "{what}: {order}, {meshes:?}");
    }
}

#[test]
fn fitted_fills_integrate_with_second_order() {
    // For a cylinder between R and r: (R^4 - r^4)/4 theta h + (R^2 - r^2)/2 theta (b^3 - a^3)/3.
    let tube = |inner: f64, turn: f64| {
        (1.1f64.powi(4) - inner.powi(4)) / 4.0 * turn * 0.8
            + (1.1f64.powi(2) - inner.powi(2)) / 2.0 * turn * (0.125 + 0.027) / 3.0
    };
    orders(&cylinder(0.4, [0.2, 2.1]), tube(0.4, 1.9));
    orders(&cylinder(0.0, [0.0, TAU]), tube(0.0, TAU));
    // For a sphere: (R^5 - r^5)/5 times its solid angle.
    let shell = |inner: f64, angle: f64| (1.1f64.powi(5) - inner.powi(5)) / 5.0 * angle;
    orders(&sphere(0.4, [0.2, 2.1], [0.5, 2.0]), shell(0.4, 1.9 * (0.5f64.cos() - 2f64.cos())));
    orders(&sphere(0.0, [0.0, TAU], [0.0, PI]), shell(0.0, 2.0 * TAU));
    // For the L: two boxes; for the triangle a, b, c: A/6 (a.a + b.b + c.c + a.b + b.c + c.a).
    let [(angle, ..), (triangle, ..)] = polygons();
    orders(&angle, 2.0 * (4.0 / 3.0 + 1.0 / 3.0) + (1.0 / 3.0 + 7.0 / 3.0));
    orders(&triangle, 0.54 / 6.0 * (0.9 + 1.44 + 0.36));
}

/// A Cartesian fill in space and of a polygon: ragged, without faces, and exact in the limit.
#[test]
fn cartesian_fills_converge() {
    let error = |spacing: f64| {
        let ball = fill(&sphere(0.4, [0.0, TAU], [0.0, PI]), Fill::Cartesian, [spacing; 3]);
        assert!(ball.pieces.is_empty());
        let volume = 4.0 / 3.0 * PI * (1.1f64.powi(3) - 0.4f64.powi(3));
        (ball.volume.iter().sum::<f64>() / volume - 1.0).abs()
    };
    assert!(error(0.1) < 0.05 && error(0.02) < 0.005, "{} {}", error(0.1), error(0.02));
    let [(angle, ..), _] = polygons();
    let filled = fill(&angle, Fill::Cartesian, [0.1; 3]);
    assert!((filled.volume.iter().sum::<f64>() - 3.0).abs() < 1e-12, "cells fit the L");
}

/// The sum of areas of a ring's pieces is zero; of a sector's pieces, up to O(h^2).
#[test]
fn the_surface_of_a_sector_closes_with_second_order() {
    let gap = |spacing: f64| {
        let filling = fill(&annulus([0.3, 1.7]), Fill::Fitted, [spacing; 3]);
        filling.pieces.iter().map(|piece| piece.area).sum::<Vector<f64, 2>>().norm()
    };
    let order = (gap(0.07) / gap(0.035)).log2();
    assert!((order - 2.0).abs() < 0.05, "{order}");
    let ring = fill(&annulus([0.0, TAU]), Fill::Fitted, [0.07; 3]);
    closed_surface(&ring, 1e-13);
}

/// A Cartesian fill is ragged: it has no faces, and its volume is exact only in the limit, with a random share of each cell on
/// the rim: the relative error is about h^1.5, and at most the rim's cells.
#[test]
fn a_cartesian_annulus_converges() {
    let theta = [0.2, 2.0];
    let volume = 0.9 * (1.1 * 1.1 - 0.4 * 0.4);
    let rim = 1.8 * 1.5 + 1.4;
    for spacing in [0.1, 0.03, 0.01, 0.003] {
        let filling = fill(&annulus(theta), Fill::Cartesian, [spacing; 3]);
        domains(&filling);
        assert!(filling.pieces.is_empty());
        let error = (filling.volume.iter().sum::<f64>() - volume).abs();
        assert!(error < 0.5 * rim * spacing, "{spacing}: {error}");
        let spread = 2.0 * (rim / spacing).sqrt() * spacing.powi(2);
        assert!(error < spread, "{spacing}: {error}, not {spread}");
        for x in &filling.position {
            assert!((0.4..1.1).contains(&x.norm()), "{x}");
            assert!((0.2..2.0).contains(&x[1].atan2(x[0])), "{x}");
        }
    }
}

/// Particles move within their domains, at most half an edge times the fraction; all other data are unchanged.
fn jitters<const D: usize>(body: &Body<f64, D>) {
    let still = fill(body, Fill::Fitted, [0.07; 3]);
    let moved = |fraction: f64, seed: u64| {
        let mut filling = still.clone();
        filling.jitter(fraction, seed);
        filling
    };
    for fraction in [0.2, 1.0] {
        let filling = moved(fraction, 7);
        assert_eq!(filling.position, moved(fraction, 7).position);
        assert_ne!(filling.position, moved(fraction, 8).position);
        assert_eq!((&filling.volume, &filling.pieces), (&still.volume, &still.pieces));
        assert_eq!(filling.half_edges, still.half_edges);
        let mut farthest = 0.0_f64;
        let mut mean = Vector::<f64, D>::zeros();
        for (p, edges) in still.half_edges.iter().enumerate() {
            let shift = filling.position[p] - still.position[p];
            let inside: Vector<f64, D> = edges.try_inverse().unwrap() * shift;
            farthest = farthest.max(inside.amax());
            mean += inside / still.len() as f64;
        }
        assert!(farthest <= fraction * (1.0 + 1e-9), "{farthest}");
        assert!(farthest > 0.9 * fraction, "uses its range: {farthest}");
        // Five standard deviations of a mean of uniform numbers.
        let deviation = fraction / (3.0 * still.len() as f64).sqrt();
        assert!(mean.amax() < 5.0 * deviation, "{mean}");
    }
    assert_eq!(moved(0.0, 7).position, still.position);
}

#[test]
fn jitter_stays_in_the_domains_and_repeats_itself() {
    jitters(&cuboid::<1>([0.0; 3], [10.0; 3]));
    jitters(&cuboid::<2>([0.0; 3], [1.0; 3]));
    jitters(&cuboid::<3>([0.0; 3], [0.7; 3]));
    jitters(&annulus([0.3, 1.9]));
}

/// The box around a sector is determined by its corners, and by the points where it crosses an axis.
#[test]
fn boxes_around_sectors() {
    let around = |theta: [f64; 2]| bounding_box(&annulus(theta)).unwrap();
    let close = |theta: [f64; 2], expected: [f64; 4]| {
        let [lower, upper] = around(theta);
        let found = [lower[0], lower[1], upper[0], upper[1]];
        let apart = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-12, "{theta:?}: {found:?}, not {expected:?}");
    };
    close([0.0, TAU], [-1.1, -1.1, 1.1, 1.1]);
    close([0.5, 0.5 + TAU], [-1.1, -1.1, 1.1, 1.1]);
    close([0.0, FRAC_PI_2], [0.0, 0.0, 1.1, 1.1]);
    close([FRAC_PI_2, PI], [-1.1, 0.0, 0.0, 1.1]);
    close([PI / 3.0, 2.0 * PI / 3.0], [-0.55, 0.4 * 0.75_f64.sqrt(), 0.55, 1.1]);
    close(
        [-PI / 4.0, PI / 4.0],
        [0.4 * 0.5_f64.sqrt(), -1.1 * 0.5_f64.sqrt(), 1.1, 1.1 * 0.5_f64.sqrt()],
    );
    close([-0.75 * PI, 0.75 * PI], [-1.1 * 0.5_f64.sqrt(), -1.1, 1.1, 1.1]);
    close(
        [0.1, 0.2],
        [0.4 * 0.2_f64.cos(), 0.4 * 0.1_f64.sin(), 1.1 * 0.1_f64.cos(), 1.1 * 0.2_f64.sin()],
    );
    // Round-off moves no corner off an axis.
    assert_eq!(around([0.0, FRAC_PI_2])[0], Vector::<f64, 2>::zeros());
    // Every particle of a sector is inside.
    for theta in [[0.3, 2.9], [-3.0, 0.2], [2.0, 5.0]] {
        let [lower, upper] = around(theta);
        for x in &fill(&annulus(theta), Fill::Fitted, [0.05; 3]).position {
            assert!(x.inf(&lower) == lower && x.sup(&upper) == upper, "{theta:?}: {x}");
        }
    }
}

/// A rotation of a sector turns its fill.
#[test]
fn fitted_fills_turn_with_their_sector() {
    let [one, other] =
        [0.0, 0.8].map(|by| fill(&annulus([0.1 + by, 1.3 + by]), Fill::Fitted, [0.1, 0.08, 0.0]));
    let (sine, cosine) = 0.8_f64.sin_cos();
    let turn = Matrix::<f64, 2>::new(cosine, -sine, sine, cosine);
    assert_eq!(one.len(), other.len());
    for p in 0..one.len() {
        assert!((turn * one.position[p] - other.position[p]).amax() < 1e-14);
        assert!((turn * one.half_edges[p] - other.half_edges[p]).amax() < 1e-14);
    }
}

/// The number of particles per cell along each axis, in cells that are not cubes.
#[test]
fn particles_per_cell_along_each_axis() {
    use mms_runtime::{Division, Method, Setup, Solve};
    let field = crate::common::wave::Wave::on_box([1.0, 0.5]);
    let particles_per_cell: Division = "3x1".parse().unwrap();
    let setup = Setup { particles_per_cell, ..Setup::default() };
    let cells: Division = "4x8".parse().unwrap();
    let method = Method { setup, ..Method::default() };
    let solver = <f64 as Solve<2>>::solver(&field, &method, &cells).unwrap();
    let particles = solver.present().particles;
    assert_eq!(particles.len(), 12 * 8);
    assert_eq!(solver.grid().lattice.cell_size, Vector::<f64, 2>::new(0.25, 0.0625));
    let mut columns: Vec<f64> = particles.reference_position.iter().map(|x| x[0]).collect();
    columns.sort_by(f64::total_cmp);
    columns.dedup();
    assert_eq!(columns.len(), 12);
}
