/// Columns of numbers, one for each component.
type Columns<T, const COUNT: usize> = [[T; POINTS]; COUNT];

/// A table of the test vectors: the expected results of a function, and the accepted errors.
struct Table {
    rows: Vec<Vec<f64>>,
    accepted: [f64; 2],
}

impl Table {
    /// Reads the next table of this name and size.
    fn read(lines: &mut std::str::Lines<'_>, name: &str, size: [usize; 2]) -> Table {
        let numbers = |line: &str| line.split(' ').flat_map(str::parse).collect::<Vec<f64>>();
        let head = lines.find(|line| line.split(' ').next() == Some(name)).map(numbers);
        if let Some(&[count, width, double, single]) = head.as_deref() {
            let rows: Vec<_> = lines.map(numbers).take(size[0]).collect();
            let is_whole = rows.len() == size[0] && rows.iter().all(|row| row.len() == size[1]);
            if is_whole && size.map(|it| it as f64) == [count, width] {
                return Table { rows, accepted: [double, single] };
            }
        }
        println!(
            "the test vectors have no table {name} of {} x {} numbers: emit them anew",
            size[0], size[1]
        );
        std::process::exit(2);
    }

    /// The number in column `place` of the first row, as a table.
    fn number(&self, place: usize) -> Table {
        Table { rows: vec![vec![self.rows[0][place]]], accepted: self.accepted }
    }

    /// N columns, from `first` on.
    fn columns<T: Real, const N: usize>(&self, first: usize) -> Columns<T, N> {
        core::array::from_fn(|k| core::array::from_fn(|p| T::of(self.rows[p][first + k])))
    }
}

#[derive(Default)]
struct Errors {
    worst: f64,
    failures: usize,
}

impl Errors {
    /// Compares the results of a function with a set of parameters.
    fn check<T: Real, const N: usize, const P: usize>(
        &mut self,
        name: &str,
        table: &Table,
        found: &[[T; P]; N],
    ) {
        let (eps, least, accepted) = match size_of::<T>() {
            4 => (f32::EPSILON.into(), f32::MIN_POSITIVE.into(), table.accepted[1]),
            _ => (f64::EPSILON, f64::MIN_POSITIVE, table.accepted[0]),
        };
        let (mut error, mut magnitude) = (0.0_f64, least);
        for (p, row) in table.rows.iter().enumerate() {
            for (expected, column) in row.iter().zip(found) {
                let found = column[p].to_f64();
                let difference = if found.is_finite() { found - expected } else { f64::INFINITY };
                error = error.max(difference.abs());
                magnitude = f64::max(magnitude, expected.abs());
            }
        }
        let error = error / magnitude / eps;
        self.worst = self.worst.max(error);
        if error > accepted {
            println!("{name}: {error:.3} eps of {} bytes, accepted {accepted}", size_of::<T>());
            self.failures += 1;
        }
    }
}

/// The points of a set of parameters.
struct Points<T> {
    t: [T; POINTS],
    X: Columns<T, DIMENSION>,
    N: Columns<T, DIMENSION>,
    H: Columns<T, { ROWS * ROWS }>,
}

/// The numbers of a point.
fn row<T: Real, const N: usize>(columns: &Columns<T, N>, p: usize) -> [T; N] {
    columns.map(|column| column[p])
}

/// The numbers of a point and of all before it.
fn up_to<T: Real, const N: usize>(columns: &Columns<T, N>, p: usize) -> [&[T]; N] {
    columns.each_ref().map(|column| &column[..=p])
}

/// The results of a function of one point, at each point.
fn one<T: Real, const N: usize>(call: impl Fn(usize) -> [T; N]) -> Columns<T, N> {
    let rows: [_; POINTS] = core::array::from_fn(call);
    core::array::from_fn(|k| rows.each_ref().map(|row| row[k]))
}

/// The last results of a function of many points, called for each point and all points before it.
fn many<T: Real, const N: usize>(call: impl Fn(usize, [&mut [T]; N])) -> Columns<T, N> {
    let mut found = [[T::of(0.0); POINTS]; N];
    (0..POINTS).rev().for_each(|p| call(p, found.each_mut().map(|column| &mut column[..=p])));
    found
}

/// The components of a tensor.
fn flat<T: Real>(rows: [[T; ROWS]; ROWS]) -> [T; ROWS * ROWS] {
    core::array::from_fn(|k| rows[k / ROWS][k % ROWS])
}

/// A tensor of components.
fn square<T: Real>(components: [T; ROWS * ROWS]) -> [[T; ROWS]; ROWS] {
    core::array::from_fn(|i| core::array::from_fn(|j| components[ROWS * i + j]))
}

fn check_all<T: Real>(errors: &mut Errors) {
    let lines = &mut VECTORS.lines();
    let table = Table::read(lines, "defaults", [1, PARAMETERS]);
    let mut parameters = field_::Parameters::<T>::default();
    DEFAULTS;
    for _ in 0..SETS {
        let table = Table::read(lines, "set", [1, PARAMETERS]);
        GIVEN;
        let field = field_::prepare(&parameters);
        let table = Table::read(lines, "at", [POINTS, WIDTH]);
        let at: Points<T> = Points {
            t: table.columns::<T, 1>(0)[0],
            X: table.columns(1),
            N: table.columns(1 + DIMENSION),
            H: table.columns(1 + 2 * DIMENSION),
        };
        let now = at.t.map(|t| field.at_time(t));
        FUNCTIONS;
    }
}

fn main() {
    let mut errors = Errors::default();
    check_all::<f64>(&mut errors);
    check_all::<f32>(&mut errors);
    println!("field_: worst error {:.3} eps", errors.worst);
    std::process::exit(i32::from(errors.failures > 0));
}
