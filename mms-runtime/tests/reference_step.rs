//! A step of the material point method, a particle and a node at a time. Read it before the solver, which does the same with
//! packs of particles, any weights and any integrator. It shares only the traits of a field with the solver.
//!
//! Linear weights, updated formulation, FLIP, leapfrog, and rollers on all faces of a box, in any dimension. Sulsky, Chen,
//! Schreyer, Comput. Methods Appl. Mech. Eng. 118 (1994) 179, doi 10.1016/0045-7825(94)90112-0, with the stress of the
//! reference volume: V sigma = V0 tau.

use crate::common::{AxisAligned, Last};
use mms_runtime::study::run_level;
use mms_runtime::{
    FormulationName, IntegratorName, ManufacturedField as _, Material as _, Matrix, Method, Setup,
    ShapeName, Solve, Vector,
};

/// A particle: X, x = X + u, v, H = du/dX, m and V0.
struct Particle<const D: usize> {
    reference: Vector<f64, D>,
    position: Vector<f64, D>,
    velocity: Vector<f64, D>,
    gradient: Matrix<f64, D>,
    mass: f64,
    volume: f64,
}

/// A node: m, then sum w m v or v, then the force or the acceleration.
#[derive(Clone)]
struct Node<const D: usize> {
    mass: f64,
    velocity: Vector<f64, D>,
    force: Vector<f64, D>,
}

/// The grid of the unit cube: `cells` along each axis.
struct Grid {
    cells: usize,
}

impl Grid {
    fn size(&self) -> f64 {
        1.0 / self.cells as f64
    }

    /// The places of a node along the axes.
    fn places<const D: usize>(&self, node: usize) -> [usize; D] {
        std::array::from_fn(|axis| node / (self.cells + 1).pow(axis as u32) % (self.cells + 1))
    }

    /// The corners of the cell that contains x: number, weight w and grad w.
    fn corners<const D: usize>(&self, x: &Vector<f64, D>) -> Vec<(usize, f64, Vector<f64, D>)> {
        let h = self.size();
        let first = x.map(|x| (x / h).floor().clamp(0.0, self.cells as f64 - 1.0));
        let corner = |corner: usize| {
            let is_upper = |axis: usize| corner >> axis & 1 == 1;
            let away = |axis: usize| x[axis] / h - first[axis];
            let w = |axis: usize| if is_upper(axis) { away(axis) } else { 1.0 - away(axis) };
            let slope = |axis: usize| if is_upper(axis) { 1.0 / h } else { -1.0 / h };
            let number = (0..D).map(|axis| {
                (first[axis] as usize + usize::from(is_upper(axis)))
                    * (self.cells + 1).pow(axis as u32)
            });
            let others =
                |axis: usize| (0..D).filter(move |other| *other != axis).map(w).product::<f64>();
            let gradient = Vector::from_fn(|axis, _| slope(axis) * others(axis));
            (number.sum(), (0..D).map(w).product(), gradient)
        };
        (0..1 << D).map(corner).collect()
    }

    /// A step from `time` to `time + dt`. Velocities are kicked over `kick`: dt, or dt/2 in the first step.
    fn step<const D: usize>(
        &self,
        field: &AxisAligned,
        particles: &mut [Particle<D>],
        [time, kick, dt]: [f64; 3],
    ) {
        // P2G: m_i = sum w m,  m_i v_i = sum w m v,  f_i = sum w m b - V0 tau grad w
        let empty = Node { mass: 0.0, velocity: Vector::zeros(), force: Vector::zeros() };
        let mut nodes = vec![empty; (self.cells + 1).pow(D as u32)];
        for p in particles.iter() {
            let (x, h) = (&[p.reference], &[p.gradient]);
            let (mut b, mut tau) = ([Vector::zeros()], [Matrix::zeros()]);
            field.body_force(time, x, &mut b);
            field.kirchhoff_stress(time, x, h, &mut tau);
            for (i, w, gradient) in self.corners(&p.position) {
                nodes[i].mass += w * p.mass;
                nodes[i].velocity += p.velocity * (w * p.mass);
                nodes[i].force += b[0] * (w * p.mass) - tau[0] * gradient * p.volume;
            }
        }
        // Grid: a_i = f_i/m_i,  v_i += kick a_i, and no motion through a roller
        for (i, node) in nodes.iter_mut().enumerate().filter(|(_, node)| node.mass > 0.0) {
            node.force /= node.mass;
            node.velocity = node.velocity / node.mass + node.force * kick;
            for (axis, place) in self.places::<D>(i).into_iter().enumerate() {
                if place == 0 || place == self.cells {
                    (node.force[axis], node.velocity[axis]) = (0.0, 0.0);
                }
            }
        }
        // G2P: v += kick sum w a_i,  x += dt sum w v_i,  H += dt L F with L = sum v_i (x) grad w
        for p in particles {
            let mut rate = Matrix::zeros();
            let mut moved = Vector::zeros();
            for (i, w, gradient) in self.corners(&p.position) {
                p.velocity += nodes[i].force * (w * kick);
                moved += nodes[i].velocity * w;
                rate += nodes[i].velocity * gradient.transpose();
            }
            p.position += moved * dt;
            p.gradient += rate * (Matrix::identity() + p.gradient) * dt;
        }
    }
}

/// Two particles along each edge of a cell, with the exact initial state.
fn particles<const D: usize>(field: &AxisAligned, grid: &Grid) -> Vec<Particle<D>> {
    let (along, spacing) = (2 * grid.cells, grid.size() / 2.0);
    let particle = |number: usize| {
        let place = |axis: usize| number / along.pow(axis as u32) % along;
        let x = [Vector::from_fn(|axis, _| (place(axis) as f64 + 0.5) * spacing)];
        let (mut u, mut v, mut h) = ([Vector::zeros()], [Vector::zeros()], [Matrix::zeros()]);
        field.displacement(0.0, &x, &mut u);
        field.velocity(0.0, &x, &mut v);
        field.displacement_gradient(0.0, &x, &mut h);
        let volume = spacing.powi(D as i32);
        let (reference, position) = (x[0], x[0] + u[0]);
        Particle { reference, position, velocity: v[0], gradient: h[0], mass: volume, volume }
    };
    (0..along.pow(D as u32)).map(particle).collect()
}

/// Tests that after a fifth of a period the solver has the particles of the plain steps.
fn hold<const D: usize>(cells: usize)
where
    f64: Solve<D>,
{
    let (field, grid) = (AxisAligned { amplitude: 0.1, lower: 0.0 }, Grid { cells });
    let setup = Setup { end_time: Some(0.2), ..Setup::default() };
    let (shape, integrator) = (ShapeName::Linear, IntegratorName::Leapfrog);
    let method = Method { shape, integrator, formulation: FormulationName::Updated, setup };
    let mut last = Last::default();
    let level = run_level::<f64, D>(&field, &method, &cells.into(), &mut last).unwrap();
    let frame = last.0.expect("the last state");

    let mut plain = particles::<D>(&field, &grid);
    for step in 0..level.steps {
        let dt = level.time_step;
        let kick = if step == 0 { dt / 2.0 } else { dt };
        grid.step(&field, &mut plain, [step as f64 * dt, kick, dt]);
    }
    assert_eq!(frame.position.len(), D * plain.len());
    for p in &plain {
        let is_it =
            |(x, d): &(&[f64], &[f64])| (0..D).all(|a| (x[a] - d[a] - p.reference[a]).abs() < 1e-9);
        let pairs = frame.position.chunks(D).zip(frame.displacement.chunks(D));
        let at = pairs.clone().position(|pair| is_it(&pair)).expect("a particle with that X");
        let near =
            |found: f64, plain: f64| assert!((found - plain).abs() < 1e-12, "{found} {plain}");
        for a in 0..D {
            near(frame.position[D * at + a], p.position[a]);
            near(frame.velocity[D * at + a], p.velocity[a]);
            for b in 0..D {
                let f = p.gradient[(a, b)] + f64::from(u8::from(a == b));
                near(frame.deformation_gradient[D * (D * at + a) + b], f);
            }
        }
    }
}

#[test]
fn the_solver_does_what_plain_steps_do() {
    hold::<1>(16);
    hold::<2>(6);
    hold::<3>(4);
}
