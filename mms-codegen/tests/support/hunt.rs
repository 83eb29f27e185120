//! Searches for points where a certificate and the evaluated program contradict each other: shared by the tests and by the
//! fuzzer.

use mms_codegen::bounds::chart::Chart;
use mms_codegen::bounds::enclosure::Formulas;
use mms_codegen::bounds::witness::Witness;
use mms_codegen::certify::branches;
use mms_codegen::certify::computed;
use mms_codegen::certify::computed::ComputedVerdict;
use mms_codegen::certify::finite;
use mms_codegen::certify::finite::Finite;
use mms_codegen::certify::motion::ChartMotion;
use mms_codegen::certify::sign::{Positive, Sign};
use mms_codegen::compile::compile_unproved;
use mms_codegen::{Compiled, Options};
use mms_math::Scalar as _;
use mms_mechanics::Output;
use mms_program::interpret::{Interpreter, Number, Point};
use mms_program::precise::Precise;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Graph;

/// The number of points, beside the corners, where a program is evaluated.
const POINTS: usize = 48;

/// The number of bisections towards the half in which u changes more.
const HALVINGS: usize = 44;

/// The number of further bisections, in 77 digits.
const EXACT_HALVINGS: usize = 1200;

/// A step of u that no slope explains, relative to its largest change along the path.
const JUMP: f64 = 1e-3;

/// The result of a hunt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hunt {
    /// The text is no field, or too large a one.
    Refused,
    /// The certificate promises nothing.
    NotCertified,
    /// The promises of the certificate held at every point.
    Held,
}

/// Bytes, followed by zeros.
struct Bytes<'a>(core::slice::Iter<'a, u8>);

impl Bytes<'_> {
    fn next(&mut self) -> usize {
        usize::from(self.0.next().copied().unwrap_or(0))
    }

    fn one_of<'b>(&mut self, choices: &[&'b str]) -> &'b str {
        choices[self.next() % choices.len()]
    }

    fn fraction(&mut self) -> f64 {
        (self.next() * 256 + self.next()) as f64 / 65535.0
    }
}

const NUMBERS: &[&str] = &[
    "1", "2", "3", "1/2", "1/3", "0.7", "5", "10", "1e-3", "1e3", "1e6", "1e-8", "1e8", "1e15",
    "1e16", "1e20", "1e40", "1e154", "1e160", "1e300", "1e-200", "1e-300", "pi", "pi/2", "-1",
];

const FUNCTIONS: &[&str] = &[
    "sin", "cos", "tan", "exp", "ln", "sqrt", "cbrt", "sinh", "cosh", "tanh", "asin", "acos",
    "atan",
];

/// A formula in X, Y, t and a.
fn formula(bytes: &mut Bytes<'_>, names: &[&str], depth: usize) -> String {
    let kind = if depth == 0 { bytes.next() % 4 } else { bytes.next() % 16 };
    let inner = |bytes: &mut Bytes<'_>| formula(bytes, names, depth.saturating_sub(1));
    match kind {
        0 => bytes.one_of(NUMBERS).into(),
        1..=3 => bytes.one_of(names).into(),
        4..=6 => format!("({} {} {})", inner(bytes), bytes.one_of(&["+", "-"]), inner(bytes)),
        7 | 8 => format!("({} * {})", inner(bytes), inner(bytes)),
        9 => format!("({} / {})", inner(bytes), inner(bytes)),
        10 => {
            let base = inner(bytes);
            format!("({base})^({})", bytes.one_of(&["2", "3", "-1", "1/2", "3/2", "-1/3", "7/3"]))
        }
        11 => format!("atan2({}, {})", inner(bytes), inner(bytes)),
        12 => format!("hypot({}, {})", inner(bytes), inner(bytes)),
        _ => format!("{}({})", bytes.one_of(FUNCTIONS), inner(bytes)),
    }
}

/// The field file that bytes encode.
pub fn field(data: &[u8]) -> String {
    let mut bytes = Bytes(data.iter());
    let dimension = 1 + bytes.next() % 2;
    let names = if dimension == 1 { &["X", "X", "t", "a"][..] } else { &["X", "Y", "t", "a"] };
    let size = bytes.one_of(&["0.1", "0.01", "1e-3", "1e-6", "1e-12"]);
    let u: Vec<String> =
        (0..dimension).map(|_| format!("\"{size}*{}\"", formula(&mut bytes, names, 3))).collect();
    let body = match (dimension, bytes.next() % 3) {
        (2, 0) => {
            let end = bytes.one_of(&["2*pi", "pi", "pi/2", "3"]);
            format!("shape = \"annulus\"\ninner = 0.5\nouter = 1\ntheta = [0, \"{end}\"]")
        }
        _ => {
            let lower = bytes.one_of(&["0", "0", "-1", "-0.3", "1", "1e3", "-1e6"]);
            let length = bytes.one_of(&["1", "1", "0.7", "1e-3", "1e15", "1e300"]);
            let list = |bound: &str| vec![format!("\"{bound}\""); dimension].join(", ");
            let upper = format!("{lower} + {length}");
            format!("shape = \"box\"\nlower = [{}]\nupper = [{}]", list(lower), list(&upper))
        }
    };
    let time = bytes.one_of(&["0, 1", "0, 1", "-1, 1", "0, 100", "0, 1e13", "0, 1e300", "1, 2"]);
    let a = bytes.one_of(&[
        "{ value = 0.5 }",
        "{ value = 0.5, range = [0.1, 1] }",
        "{ value = 0, range = [-1, 1] }",
        "{ value = 1e-310 }",
        "{ value = 1e200 }",
    ]);
    let mu = bytes.one_of(&["4e5", "1", "1e-300", "1e300", "1e38"]);
    format!(
        "[field]\ntitle = \"hunted\"\ndimension = {dimension}\n[parameters]\na = {a}\n[displacement]\n\
         u = [{}]\n[material]\nmodel = \"neo_hookean\"\nlambda = {mu}\nmu = {mu}\ndensity = 1000\n\
         [domain]\n{body}\ntime = [{time}]\n",
        u.join(", "),
    )
}

/// The limits of cells and operations of each proof: the searches are those that `mms check` runs, but end earlier.
const CELLS: usize = 48;
const OPERATIONS: usize = 300_000;

/// The proved properties of a field.
struct Promise {
    double: bool,
    single: bool,
    /// Whether the field stays within one branch, and its angles have enough digits to detect a jump.
    smooth: bool,
}

impl Promise {
    fn of(graph: &mut Graph, chart: &Chart, compiled: &Compiled) -> Self {
        let motion = ChartMotion::new(graph, chart, compiled);
        let formulas = Formulas::new(graph, chart, &[motion.jacobian]);
        let none = Promise { double: false, single: false, smooth: false };
        let (Sign::Positive(bounds), _) = Positive::jacobian(chart, &formulas).bound(CELLS) else {
            return none;
        };
        assert!(0.0 < bounds[0] && bounds[0] <= bounds[1], "{bounds:?}");
        let (finite, _) = finite::bound(graph, chart, compiled, &motion, bounds[0], CELLS);
        if finite != Finite::Proved {
            return none;
        }
        let budget = [CELLS, OPERATIONS];
        let (exits, _) = branches::violations(graph, chart, compiled, Some(&motion), budget);
        let known = (motion.jacobian, bounds);
        let computed = computed::bound(graph, chart, compiled, known, OPERATIONS);
        let [double, single] = computed.each_ref().map(|it| it.verdict == ComputedVerdict::Proved);
        let is_fine = computed[0].angles.as_ref().is_none_or(|(digits, _)| *digits > 9.0);
        Promise { double, single, smooth: double && exits.is_empty() && is_fine }
    }
}

/// Proves the properties of a text, and tests the points that bytes encode, the corners, and the path to where u changes most.
/// Panics if a promise is broken.
pub fn hunt(text: &str, data: &[u8]) -> Hunt {
    let options = Options { max_nodes: 20_000, ..Options::default() };
    let load = |_: &str| Err("no files here".to_string());
    let Ok(compiled) = compile_unproved("x", "x.toml", text, &load, &options) else {
        return Hunt::Refused;
    };
    let mut graph = compiled.graph.clone();
    let chart = Chart::new(&mut graph, &compiled.field, &compiled.model, None);
    let promise = Promise::of(&mut graph, &chart, &compiled);
    let defaults = compiled.parameters::<f64>(&Default::default());
    let prey = Prey { text, compiled: &compiled, chart: &chart, defaults };
    let single = compiled.parameters::<f32>(&Default::default());
    let mut points = corners(chart.variables().len());
    let mut bytes = Bytes(data.iter());
    for _ in 0..POINTS {
        points.push(chart.variables().iter().map(|_| bytes.fraction()).collect());
    }
    for point in &points {
        if promise.double {
            prey.is_computed(&prey.defaults, point, "f64");
        }
        if promise.single {
            prey.is_computed(&single, point, "f32");
        }
    }
    if promise.smooth {
        for pair in points.chunks_exact(2).take(16) {
            prey.has_no_jump(&pair[0], &pair[1]);
        }
    }
    if promise.double { Hunt::Held } else { Hunt::NotCertified }
}

fn corners(count: usize) -> Vec<Vec<f64>> {
    let end = |corner: usize| (0..count).map(|axis| (corner >> axis & 1) as f64).collect();
    (0..1 << count).map(end).collect()
}

struct Prey<'a> {
    text: &'a str,
    compiled: &'a Compiled,
    chart: &'a Chart,
    /// The values of the parameters, without those that have a range.
    defaults: Vec<f64>,
}

impl Prey<'_> {
    /// Every quantity at fractions of the way through the box.
    fn values<T: Number>(&self, defaults: &[T], fractions: &[f64], quantity: Quantity) -> Vec<T> {
        let witness = Witness::at(self.chart, fractions).0;
        let number = |x: &f64| T::from_f64(*x);
        let mut parameters = defaults.to_vec();
        for (index, value) in &witness.parameters {
            parameters[*index] = number(value);
        }
        let mut interpreter = Interpreter::new(&self.compiled.program, &parameters);
        interpreter.set_time(&number(&witness.time));
        let coordinates: Vec<T> = witness.coordinates.iter().map(number).collect();
        let output = Output::Quantity(quantity);
        let plan = interpreter.plan(&[output]);
        let normal = vec![T::from_f64(1.0); coordinates.len()];
        interpreter
            .set_point(&plan, Point { coordinates: &coordinates, normal: &normal, gradient: &[] });
        interpreter.output(output)
    }

    fn is_computed<T: Number + Into<f64>>(
        &self,
        defaults: &[T],
        fractions: &[f64],
        precision: &str,
    ) {
        for quantity in Quantity::ALL {
            let values: Vec<f64> =
                self.values(defaults, fractions, *quantity).into_iter().map(Into::into).collect();
            let well = |value: &f64| {
                value.is_finite() && (*quantity != Quantity::Jacobian || *value > 0.0)
            };
            let shown = || {
                let (name, text) = (quantity.name(), self.text);
                let place = Witness::at(self.chart, fractions).0;
                format!("{precision}: {name} is {values:?} at {place:?} of\n{text}")
            };
            assert!(values.iter().all(well), "{}", shown());
        }
    }

    /// Bisects the path between two points towards the half on which u changes more. A step that remains in 77 digits is a
    /// jump.
    fn has_no_jump(&self, from: &[f64], to: &[f64]) {
        let u = |at: &[f64]| self.values(&self.defaults, at, Quantity::Displacement);
        let (from, to, [largest, step]) = closing_in(from, to, HALVINGS, |a, b| (a + b) / 2.0, u);
        if step <= JUMP * largest || step == 0.0 {
            return;
        }
        let [first, last] = [&from, &to].map(|at| at.iter().map(|x| Precise::from_f64(*x)));
        let half = Precise::from_f64(0.5);
        let middle = |a: &Precise, b: &Precise| (a.clone() + b.clone()) * half.clone();
        let [first, last] = [first.collect::<Vec<_>>(), last.collect()];
        // Relative to the first end, since a large u would lose its changes in doubles.
        let start = self.exact(&first);
        let exact = |at: &[Precise]| {
            let changes = self.exact(at).into_iter().zip(&start);
            changes.map(|(u, start)| (u - start.clone()).to_f64()).collect()
        };
        let (_, _, [_, left]) = closing_in(&first, &last, EXACT_HALVINGS, middle, exact);
        let place = Witness::at(self.chart, &from).0;
        assert!(left <= step / 2.0, "u jumps by {left} at {place:?} of\n{}", self.text);
    }

    /// u in 77 digits.
    fn exact(&self, fractions: &[Precise]) -> Vec<Precise> {
        let spot = self.chart.points().point(&self.chart.place(fractions));
        let mut interpreter = Interpreter::new(&self.compiled.program, &spot.parameters);
        let output = Output::Quantity(Quantity::Displacement);
        interpreter.set_time(&spot.time);
        let plan = interpreter.plan(&[output]);
        interpreter.set_point(&plan, Point::at(&spot.coordinates));
        interpreter.output(output)
    }
}

/// The ends of the remaining path, the largest change seen, and the change on the remaining path.
fn closing_in<T: Clone>(
    from: &[T],
    to: &[T],
    halvings: usize,
    middle: impl Fn(&T, &T) -> T,
    u: impl Fn(&[T]) -> Vec<f64>,
) -> (Vec<T>, Vec<T>, [f64; 2]) {
    let apart =
        |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let (mut from, mut to) = (from.to_vec(), to.to_vec());
    let (mut first, mut last) = (u(&from), u(&to));
    let mut largest = apart(&first, &last);
    for _ in 0..halvings {
        let between: Vec<T> = from.iter().zip(&to).map(|(a, b)| middle(a, b)).collect();
        let value = u(&between);
        let [left, right] = [apart(&first, &value), apart(&value, &last)];
        largest = largest.max(left).max(right);
        match left > right {
            true => (to, last) = (between, value),
            false => (from, first) = (between, value),
        }
    }
    let step = apart(&first, &last);
    (from, to, [largest, step])
}
