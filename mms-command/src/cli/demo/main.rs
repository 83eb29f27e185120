// Runs the solver on a mesh, and prints the results: `./demo CELLS > CELLS.csv`

mod problem;
mod solver;

mod sheared_block_2d {
    include!("sheared_block_2d.rs");
}

/// The field, as `mms emit sheared_block_2d --target rust` writes it.
struct Emitted(sheared_block_2d::Field<f64>);

impl problem::Problem for Emitted {
    fn displacement(&self, t: f64, x: [f64; 2]) -> [f64; 2] {
        self.0.at_time(t).displacement(x)
    }
    fn velocity(&self, t: f64, x: [f64; 2]) -> [f64; 2] {
        self.0.at_time(t).velocity(x)
    }
    fn body_force(&self, t: f64, x: [f64; 2]) -> [f64; 2] {
        self.0.at_time(t).body_force(x)
    }
    fn stress(&self, t: f64, x: [f64; 2]) -> [[f64; 2]; 2] {
        self.0.at_time(t).first_piola_kirchhoff(x)
    }
}

/// The end of the run, in seconds.
const END: f64 = 0.02;

fn main() {
    let cells = std::env::args().nth(1).and_then(|it| it.parse().ok());
    let cells = cells.expect("expected a number of cells, as in `./demo 8`");
    let problem = Emitted(sheared_block_2d::prepare(&Default::default()));
    print!("{}", solver::table(&solver::solve(&problem, cells, END), END));
}
