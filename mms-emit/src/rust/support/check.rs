/// Columns of numbers, one for each component.
type Columns<T, const COUNT: usize> = [[T; POINTS]; COUNT];

#[derive(Default)]
struct Errors {
    worst: f64,
    failures: usize,
}

impl Errors {
    /// Compares what a function gives with a set of parameters.
    fn check<T: Real, const N: usize, const P: usize>(
        &mut self,
        name: &str,
        accepted: f64,
        expected: &[[u64; P]; N],
        found: &[[T; P]; N],
    ) {
        let (eps, least) = match size_of::<T>() {
            4 => (f32::EPSILON.into(), f32::MIN_POSITIVE.into()),
            _ => (f64::EPSILON, f64::MIN_POSITIVE),
        };
        let (mut error, mut magnitude) = (0.0_f64, least);
        for (expected, found) in expected.as_flattened().iter().zip(found.as_flattened()) {
            let (expected, found) = (f64::from_bits(*expected), found.to_f64());
            let difference = if found.is_finite() { found - expected } else { f64::INFINITY };
            error = error.max(difference.abs());
            magnitude = f64::max(magnitude, expected.abs());
        }
        let error = error / magnitude / eps;
        self.worst = self.worst.max(error);
        if error > accepted {
            println!("{name}: {error:.3} eps of {} bytes, accepted {accepted}", size_of::<T>());
            self.failures += 1;
        }
    }
}

/// Numbers in the precision that is checked.
fn real<T: Real, const N: usize>(bits: [u64; N]) -> [T; N] {
    bits.map(|bits| T::of(f64::from_bits(bits)))
}

/// The numbers of a point.
fn row<T: Real, const N: usize>(columns: &Columns<T, N>, p: usize) -> [T; N] {
    columns.map(|column| column[p])
}

/// The numbers of a point and of all before it.
fn up_to<T: Real, const N: usize>(columns: &Columns<T, N>, p: usize) -> [&[T]; N] {
    columns.each_ref().map(|column| &column[..=p])
}

/// What a function of one point gives at each.
fn one<T: Real, const N: usize>(call: impl Fn(usize) -> [T; N]) -> Columns<T, N> {
    let rows: [_; POINTS] = core::array::from_fn(call);
    core::array::from_fn(|k| rows.each_ref().map(|row| row[k]))
}

/// What a function of many points gives for the last of them, called for each point and all before it.
fn many<T: Real, const N: usize>(call: impl Fn(usize, [&mut [T]; N])) -> Columns<T, N> {
    let mut found = [[T::of(0.0); POINTS]; N];
    (0..POINTS).rev().for_each(|p| call(p, found.each_mut().map(|column| &mut column[..=p])));
    found
}

/// The components of a tensor.
fn flat<T: Real>(rows: [[T; DIMENSION]; DIMENSION]) -> [T; DIMENSION * DIMENSION] {
    core::array::from_fn(|k| rows[k / DIMENSION][k % DIMENSION])
}

/// A tensor of components.
fn square<T: Real>(components: [T; DIMENSION * DIMENSION]) -> [[T; DIMENSION]; DIMENSION] {
    core::array::from_fn(|i| core::array::from_fn(|j| components[DIMENSION * i + j]))
}

impl Points<u64> {
    /// The same in the precision that is checked.
    fn real<T: Real>(&self) -> Points<T> {
        Points { t: real(self.t), X: self.X.map(real), N: self.N.map(real), H: self.H.map(real) }
    }
}

fn check_all<T: Real>(errors: &mut Errors) {
    DEFAULTS;
    for set in 0..SETS {
        PARAMETERS;
        let field = field_::prepare(&parameters);
        let at: Points<T> = POINTS_OF[set].real();
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
