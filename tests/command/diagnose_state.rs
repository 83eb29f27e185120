//! `mms diagnose` of accelerations and of residuals at an exact state: if they are right, nothing is reported, on any mesh.

use std::fmt::Write as _;

use super::mms::{Folder, Run};
use crate::sampled::sampled;

/// One field in `SHARE` is tried.
const SHARE: usize = 14;

/// Cells along an edge of the square that is diagnosed.
const CELLS: usize = 20;

/// The fields of the gallery that move or may move, each with a time within its window.
const FIELDS: [(&str, f64); 28] = [
    ("axis_aligned_1d", 0.01),
    ("axis_aligned_2d", 0.01),
    ("axis_aligned_3d", 0.01),
    ("bar_1d", 0.01),
    ("conformal_sector_2d", 0.01),
    ("cyclic_shear_3d", 0.01),
    ("expanding_ring", 0.01),
    ("generalized_vortex", 0.3),
    ("generalized_vortex_third", 0.3),
    ("graded_bar", 0.01),
    ("nearly_incompressible_2d", 0.001),
    ("periodic_bar", 0.01),
    ("plane_strain_gent", 0.01),
    ("plane_strain_linear_elastic", 0.01),
    ("plane_strain_mooney_rivlin", 0.01),
    ("plane_strain_neo_hookean_isochoric", 0.01),
    ("plane_strain_saint_venant_kirchhoff", 0.01),
    ("plane_strain_transversely_isotropic", 0.01),
    ("quiet_boundary_2d", 0.01),
    ("self_weight_column", 0.01),
    ("sheared_block_2d", 0.01),
    ("starting_bar", 0.01),
    ("starting_cube_3d", 0.01),
    ("starting_square_2d", 0.01),
    ("static_bulge_3d", 0.01),
    ("travelling_wave_2d", 0.01),
    ("twisted_column", 0.01),
    ("uniform_stretch", 0.03),
];

#[test]
fn exact_accelerations_are_nothing() {
    let folder = Folder::new();
    for (field, time) in sampled(FIELDS, SHARE) {
        for cells in [4, 8] {
            let state =
                format!("state {field} --cells {cells} --time {time} --quantity a -o a.csv");
            folder.mms(&state).exits(0);
            let found = folder.mms(&format!("diagnose {field} a.csv --json")).exits(0).json();
            assert_eq!(found["finding"], "nothing", "{field}, {cells}");
            let error = found["error"].as_f64().expect("an error");
            assert!(error < 1e-7, "{field}, {cells}: {error}");
        }
    }
}

/// The state of the sheared block at the nodes of a grid: X, and the tractions of its upper face and of its right face.
struct Block {
    folder: Folder,
    nodes: Vec<[f64; 2]>,
    columns: Vec<(String, Vec<f64>)>,
}

/// The time of its state.
const TIME: &str = "--time 0.01";

impl Block {
    fn new() -> Self {
        let folder = Folder::new();
        let of = |k: usize| k as f64 / CELLS as f64;
        let side = CELLS + 1;
        let nodes: Vec<_> = (0..side * side).map(|at| [of(at / side), of(at % side)]).collect();
        let mut points = "X,Y\n".to_owned();
        nodes.iter().for_each(|[x, y]| writeln!(points, "{x},{y}").expect("a string"));
        folder.write("points.csv", &points);
        let mut columns: Vec<(String, Vec<f64>)> = Vec::new();
        for quantity in ["", "--quantity a"] {
            let state = format!("--points points.csv {TIME} {quantity} -o s.csv");
            folder.mms(&format!("state sheared_block_2d {state}")).exits(0);
            let text = folder.read("s.csv");
            let mut lines = text.lines();
            let names = lines.next().expect("a header").split(',');
            let before = columns.len();
            columns.extend(names.map(|it| (it.to_owned(), Vec::new())));
            for line in lines {
                let numbers = line.split(',').map(|it| it.parse().expect("a number"));
                columns[before..].iter_mut().zip(numbers).for_each(|((_, to), it)| to.push(it));
            }
        }
        Block { folder, nodes, columns }
    }

    fn column(&self, name: &str) -> &[f64] {
        let found = self.columns.iter().find(|(it, _)| it == name);
        &found.unwrap_or_else(|| panic!("no {name}")).1
    }

    /// The length along an axis that belongs to a node: half an edge at an end.
    fn part(along: f64) -> f64 {
        let is_end = along == 0.0 || along == 1.0;
        if is_end { 0.5 / CELLS as f64 } else { 1.0 / CELLS as f64 }
    }

    /// The forces of the tractions of a face at the nodes, summed as hat functions do to second order.
    fn forces(&self, face: &str) -> Vec<[f64; 2]> {
        let across = usize::from(face.starts_with('y'));
        let place = f64::from(face.ends_with("max"));
        let [x, y] = ["x", "y"].map(|axis| self.column(&format!("traction_{face}_{axis}")));
        let force = |(at, node): (usize, &[f64; 2])| match node[across] == place {
            true => [x[at], y[at]].map(|it| it * Self::part(node[1 - across])),
            false => [0.0; 2],
        };
        self.nodes.iter().enumerate().map(force).collect()
    }

    /// Diagnoses vectors at nodes, with their volumes or without.
    fn diagnose(&self, name: &str, values: &[[f64; 2]], has_volumes: bool, options: &str) -> Run {
        let mut text = format!("X,Y,{name}1,{name}2{}\n", if has_volumes { ",volume" } else { "" });
        for ([x, y], [a, b]) in self.nodes.iter().zip(values) {
            write!(text, "{x},{y},{a:e},{b:e}").expect("a string");
            if has_volumes {
                write!(text, ",{}", Self::part(*x) * Self::part(*y)).expect("a string");
            }
            text += "\n";
        }
        self.folder.write("v.csv", &text);
        self.folder.mms(&format!("diagnose sheared_block_2d v.csv {options}"))
    }
}

#[test]
fn residuals_at_nodes_name_what_is_missing() {
    let block = Block::new();
    let nodal = &format!("--residual nodal {TIME}");
    let zero = vec![[0.0; 2]; block.nodes.len()];
    block.diagnose("r", &zero, false, nodal).exits(0).prints("nothing");
    let top = block.forces("y_max");
    let run = block.diagnose("r", &top, false, nodal).exits(1);
    run.prints("named: traction_missing on y_max (mistake)");
    // Half of all loads.
    let faces = ["x_min", "x_max", "y_max"].map(|face| block.forces(face));
    let half: Vec<_> = (0..zero.len())
        .map(|at| [0, 1].map(|i| faces.iter().map(|it| it[at][i]).sum::<f64>() / 2.0))
        .collect();
    let run = block.diagnose("r", &half, false, nodal).exits(1);
    run.prints("named: traction_factor [all faces] (mistake)");
    // Each cell with points of its own, as in discontinuous output.
    let side = CELLS + 1;
    let mut text = "X,Y,r1,r2\n".to_owned();
    for cell in 0..CELLS * CELLS {
        let first = cell % CELLS + side * (cell / CELLS);
        for at in [first, first + 1, first + side + 1, first + side] {
            let ([x, y], [a, b]) = (block.nodes[at], top[at]);
            writeln!(text, "{x},{y},{a:e},{b:e}").expect("a string");
        }
    }
    block.folder.write("twice.csv", &text);
    let run = block.folder.mms(&format!("diagnose sheared_block_2d twice.csv {nodal}")).exits(1);
    run.prints("named: traction_missing on y_max (mistake)");
    // The second row is of a node that two cells share.
    let (at, zero) = text.match_indices("0e0,0e0").nth(1).expect("a second row");
    text.replace_range(at..at + zero.len(), "1e3,0e0");
    block.folder.write("other.csv", &text);
    let run = block.folder.mms(&format!("diagnose sheared_block_2d other.csv {nodal}")).exits(2);
    run.complains("have other values; write one value for each node");
}

/// Accelerations of a lumped mass whose upper face has no load: by volumes that are given, or that follow from the grid.
#[test]
fn accelerations_take_the_volumes_of_their_nodes() {
    let block = Block::new();
    let density = 1000.0;
    let [x, y] = ["a_x", "a_y"].map(|name| block.column(name));
    let top = block.forces("y_max");
    let wrong: Vec<_> = (0..top.len())
        .map(|at| {
            let mass = density * block.nodes[at].map(Block::part).iter().product::<f64>();
            [x[at] - top[at][0] / mass, y[at] - top[at][1] / mass]
        })
        .collect();
    for has_volumes in [true, false] {
        let run = block.diagnose("a", &wrong, has_volumes, TIME).exits(1);
        run.prints("named: traction_missing on y_max (mistake)");
    }
    // If points are unevenly spaced, the volumes cannot be found.
    let mut uneven = block;
    uneven.nodes.iter_mut().for_each(|node| node[0] = node[0].powi(2));
    let run = uneven.diagnose("a", &wrong, false, TIME).exits(2);
    run.complains("the points are not evenly spaced").complains("`--map volume=..`");
}

/// A code without residuals begins with its accelerations.
#[test]
fn a_plan_says_what_each_step_needs_and_sees() {
    let folder = Folder::new();
    let run = folder.mms("diagnose sheared_block_2d --plan accelerations,law").exits(0);
    run.prints("1. law").prints("run: mms diagnose sheared_block_2d law.csv --quantity stress");
    run.prints("2. accelerations").prints("a finer mesh costs next to nothing");
    assert!(!run.stdout.contains("residual.vtu"), "{}", run.stdout);
    let all = folder.mms("diagnose sheared_block_2d --plan --json").exits(0).json();
    let steps = all["steps"].as_array().expect("steps");
    let sees = |at: usize, name: &str| {
        steps[at]["sees"].as_array().expect("names").iter().any(|it| it == name)
    };
    assert_eq!(steps.len(), 4);
    assert!(sees(0, "stress_transposed") && !sees(0, "force_factor"));
    assert!(sees(1, "traction_factor on y_max") && !sees(1, "start_at_rest"));
    assert!(sees(3, "start_at_rest") && !sees(3, "voigt_order"));
    folder.mms("diagnose sheared_block_2d --plan law s.csv").exits(2);
}
