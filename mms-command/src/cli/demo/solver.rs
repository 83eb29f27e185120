// A solver to play with: a square block of 1 m on a fixed base, with given loads on its other three sides. Bilinear finite
// elements in the reference configuration, lumped mass, leapfrog in time, a neo-Hookean material.

use super::problem::Problem;

const DENSITY: f64 = 1000.0;
const LAMBDA: f64 = 1e6 * 0.3 / (1.3 * 0.4);
const MU: f64 = 1e6 / 2.6;

/// The first Piola-Kirchhoff stress P of a deformation gradient F.
fn law(f: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let j = f[0][0] * f[1][1] - f[0][1] * f[1][0];
    let c = [[f[1][1] / j, -f[1][0] / j], [-f[0][1] / j, f[0][0] / j]]; // F^-T
    let p = |i: usize, k: usize| MU * (f[i][k] - c[i][k]) + LAMBDA * j.ln() * c[i][k];
    [[p(0, 0), p(0, 1)], [p(1, 0), p(1, 1)]]
}

/// X and u of all nodes at the time `end`, on a mesh of `cells` cells along each side.
pub fn solve(problem: &impl Problem, cells: usize, end: f64) -> Vec<[[f64; 2]; 2]> {
    let (h, row) = (1.0 / cells as f64, cells + 1);
    let steps = (end * (2.0 * (LAMBDA + 2.0 * MU) / DENSITY).sqrt() / (0.5 * h)).ceil() as usize;
    let dt = end / steps as f64;
    let gauss = [0.5 - 0.75f64.sqrt() / 3.0, 0.5 + 0.75f64.sqrt() / 3.0];
    let places: Vec<_> =
        (0..row * row).map(|i| [(i % row) as f64 * h, (i / row) as f64 * h]).collect();
    let mut u: Vec<_> = places.iter().map(|&x| problem.displacement(0.0, x)).collect();
    let mut v: Vec<_> = places.iter().map(|&x| problem.velocity(0.0, x)).collect();
    for step in 0..steps {
        let t = step as f64 * dt;
        let mut force = vec![[0.0; 2]; row * row];
        let mut mass = vec![0.0; row * row];
        // The cells, at two by two points of Gauss: rho0 b and P against the gradients g of the weights w.
        for first in (0..cells * row).filter(|first| first % row < cells) {
            let nodes = [first, first + 1, first + row, first + row + 1];
            for point in 0..4 {
                let (r, s) = (gauss[point % 2], gauss[point / 2]);
                let x = [places[first][0] + r * h, places[first][1] + s * h];
                let w = [(1.0 - r) * (1.0 - s), r * (1.0 - s), (1.0 - r) * s, r * s];
                let g = [[s - 1.0, r - 1.0], [1.0 - s, -r], [-s, 1.0 - r], [s, r]];
                let mut f = [[1.0, 0.0], [0.0, 1.0]];
                for n in 0..4 {
                    for i in 0..2 {
                        f[i][0] += u[nodes[n]][i] * g[n][0] / h;
                        f[i][1] += u[nodes[n]][i] * g[n][1] / h;
                    }
                }
                let (p, b) = (law(f), problem.body_force(t, x));
                for n in 0..4 {
                    mass[nodes[n]] += DENSITY * w[n] * h * h / 4.0;
                    for i in 0..2 {
                        let inner = (p[i][0] * g[n][0] + p[i][1] * g[n][1]) / h;
                        force[nodes[n]][i] += (DENSITY * w[n] * b[i] - inner) * h * h / 4.0;
                    }
                }
            }
        }
        // The loaded sides: P N, where N is an axis or against it.
        for (edge, s) in (0..cells).flat_map(|edge| gauss.map(|s| (edge, s))) {
            let along = (edge as f64 + s) * h;
            let p = [[0.0, along], [1.0, along], [along, 1.0]].map(|x| problem.stress(t, x));
            let x_min = [-p[0][0][0], -p[0][1][0]];
            let x_max = [p[1][0][0], p[1][1][0]];
            let y_max = [p[2][0][1], p[2][1][1]];
            let (left, right, top) = (edge * row, edge * row + cells, cells * row + edge);
            for (node, next, load) in [(left, row, x_min), (right, row, x_max), (top, 1, y_max)] {
                for i in 0..2 {
                    force[node][i] += load[i] * (1.0 - s) * h / 2.0;
                    force[node + next][i] += load[i] * s * h / 2.0;
                }
            }
        }
        // All nodes above the base.
        let kick = if step == 0 { dt / 2.0 } else { dt };
        for node in row..row * row {
            for i in 0..2 {
                v[node][i] += kick * force[node][i] / mass[node];
                u[node][i] += dt * v[node][i];
            }
        }
    }
    places.into_iter().zip(u).map(|(x, u)| [x, u]).collect()
}

/// The results as a table, for `mms judge` and `mms diagnose`.
pub fn table(nodes: &[[[f64; 2]; 2]], time: f64) -> String {
    let row =
        |[x, u]: &[[f64; 2]; 2]| format!("{:e},{:e},{:e},{:e},{time:e}\n", x[0], x[1], u[0], u[1]);
    "X,Y,ux,uy,t\n".to_owned() + &nodes.iter().map(row).collect::<String>()
}
