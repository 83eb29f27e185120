//! One case: a solver with a mistake, and what is said of its results.

use mms_diagnosis::answer::{Diagnosis, Finding};
use mms_diagnosis::changed::{Changed, Without};
use mms_diagnosis::evidence::{Frame, Mesh, Snapshot};
use mms_diagnosis::exact::{Exact, Quantity, vectors};
use mms_diagnosis::hypothesis::{Change, Given, Hypothesis, Size, all};
use mms_diagnosis::ordinary::diagnose;
use mms_diagnosis::smooth::{Smooth, size};
use mms_runtime::body::bounding_box;
use mms_runtime::study::{Frame as State, Observer, Solve, Watch};
use mms_runtime::{
    Division, FormulationName, IntegratorName, ManufacturedField, Method, Setup, ShapeName,
    Transfer,
};

/// A set of cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// The mistake is in the list.
    Closed,
    /// Its family is not.
    Open,
    /// There is none.
    Right,
}

impl Case {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Case::Closed => "closed",
            Case::Open => "open",
            Case::Right => "right",
        }
    }
}

/// How a case ended.
#[derive(Debug)]
pub struct Outcome {
    /// `right`, `wrong`, `unexplained` or `nothing`.
    pub finding: &'static str,
    /// The field.
    pub field: String,
    /// The mistake, its size and the method.
    pub mistake: String,
    /// What stands first.
    pub first: String,
    /// The share of the squared error that it explains.
    pub explained: f64,
    /// Whether what explains most is the mistake.
    pub is_right_by_share: bool,
}

/// The states of a run at two times.
struct States {
    window: [f64; 2],
    seen: Vec<State>,
}

impl Observer for States {
    fn step(&mut self, _: usize, _: usize) {}

    fn wants(&self, step: usize, steps: usize) -> bool {
        step == steps / 2 || step == steps
    }

    fn see(&mut self, state: &State) -> Result<(), String> {
        if state.time > self.window[0] {
            self.seen.push(state.clone());
        }
        Ok(())
    }
}

/// A mistake with its size.
type Mistake<'a, const D: usize> = Option<(&'a Hypothesis<D>, &'a [f64])>;

/// What a user writes of a run.
fn written<const D: usize>(
    exact: &Exact<'_, D>,
    method: &Method,
    cells: usize,
    mistake: Mistake<'_, D>,
) -> Option<Mesh>
where
    f64: Solve<D>,
{
    let changed = match mistake {
        Some((hypothesis, size)) => Changed::with(exact, Without::default(), hypothesis, size),
        None => Changed::right(exact, Without::default()),
    };
    let window = [exact.domain.time[0], method.setup.end_time?];
    let mut states = States { window, seen: Vec::new() };
    let field: &dyn ManufacturedField<f64, D> = &changed;
    let cells = Division::Uniform(cells);
    let run = f64::run(field, method, &cells, Watch::Displacement, &mut states).ok()?;
    run.level.errors.ok()?;
    let snapshots = states.seen.iter().map(|state| snapshot(exact, state, mistake)).collect();
    Some(Mesh { cell_size: run.level.cell_size, snapshots })
}

/// X and u of a state, with what is written wrongly.
fn snapshot<const D: usize>(
    exact: &Exact<'_, D>,
    state: &State,
    mistake: Mistake<'_, D>,
) -> Snapshot {
    let pairs = state.position.iter().zip(&state.displacement);
    let reference: Vec<f64> = pairs.map(|(x, u)| x - u).collect();
    let mut u = state.displacement.clone();
    if let Some((Hypothesis { change: Change::Output(change), .. }, size)) = mistake {
        let points = vectors(&reference);
        let given = Given { exact, size, time: state.time, reference: &points, gradient: &[] };
        let wrong = change(&given, Quantity::Displacement);
        let right = exact.values(Quantity::Displacement, state.time, &points);
        u.iter_mut().zip(wrong).zip(right).for_each(|((u, wrong), right)| *u += wrong - right);
    }
    Snapshot { time: state.time, reference, values: vec![(Quantity::Displacement, u)] }
}

/// A method that a user may have.
fn method(case: Case, random: &mut fastrand::Rng) -> Method {
    let shapes = [
        ShapeName::Linear,
        ShapeName::QuadraticBspline,
        ShapeName::CubicBspline,
        ShapeName::Ugimp,
        ShapeName::Cpgimp,
    ];
    let shape = shapes[random.usize(..shapes.len())];
    let integrators = [IntegratorName::Leapfrog, IntegratorName::Usl, IntegratorName::Musl];
    let is_updated = random.bool() || shape == ShapeName::Cpgimp;
    let setup = Setup {
        transfer: if random.u8(0..3) == 0 { Transfer::Apic } else { Transfer::FLIP },
        jitter: if random.u8(0..4) == 0 { 0.3 } else { 0.0 },
        offset: if random.u8(0..3) == 0 { [0.4; 3] } else { [0.0; 3] },
        seed: random.u64(..),
        courant: if random.bool() { 0.4 } else { 0.2 },
        ..Setup::default()
    };
    Method {
        shape,
        integrator: integrators[if case == Case::Right { 0 } else { random.usize(..3) }],
        formulation: if is_updated { FormulationName::Updated } else { FormulationName::Total },
        setup,
    }
}

/// A size of a mistake: its distance from the right one is 0.1 to 3 times the first that is tried.
fn sized<const D: usize>(hypothesis: &Hypothesis<D>, random: &mut fastrand::Rng) -> Vec<f64> {
    let Size::Any { right, first, .. } = &hypothesis.size else { return Vec::new() };
    let sign = if random.bool() { 1.0 } else { -1.0 };
    let factor = sign * 10f64.powf(1.5 * random.f64() - 1.0);
    // A vector is drawn by its parts.
    let is_vector = first.len() > 1;
    let part = |(right, first): (&f64, &f64)| {
        right + (first - right) * factor * if is_vector { random.f64() } else { 1.0 }
    };
    right.iter().zip(first).map(part).collect()
}

/// Hypotheses with effects of one kind, which stand for each other.
fn family<const D: usize>(hypothesis: &Hypothesis<D>) -> &'static str {
    match hypothesis.name {
        "stress_small_strain" | "material" => "law",
        "deformation_transposed" | "strain_left" => "kinematics",
        "moduli_factor" | "lambda_factor" | "mu_factor" | "moduli_swapped" | "shear_factor"
        | "density_factor" => "moduli",
        "force_late" | "output_time" | "start_half_step" => "time",
        "output_factor" | "increment_for_total" => "scale",
        "damping" | "constant_force" => hypothesis.name,
        name if name.starts_with("stress_") => "measure",
        _ if matches!(hypothesis.change, Change::Force(_)) => "force",
        name => name,
    }
}

/// Draws a case, and diagnoses it; `None` where it does not count.
pub fn drawn<const D: usize>(
    name: &str,
    field: &dyn ManufacturedField<f64, D>,
    case: Case,
    random: &mut fastrand::Rng,
) -> Option<Outcome>
where
    f64: Solve<D>,
{
    let cells = [[32, 64], [16, 24], [6, 8]][D - 1][random.usize(..2)];
    let mut method = method(case, random);
    let scout = Exact::new(field, 1.0, 1.0);
    let [lower, upper] = bounding_box(&scout.domain.body).ok()?;
    let cell_size = (upper - lower).max() / cells as f64;
    let mut speed = vec![0.0];
    field.wave_speed(&scout.places()[..1], &mut speed);
    let exact = Exact::new(field, cell_size, method.setup.courant * cell_size / speed[0]);
    let [start, stop] = exact.domain.time;
    method.setup.end_time = Some(start + (stop - start) * (0.2 + 0.8 * random.f64()));
    let mut hypotheses = all(&exact);
    let truth = random.usize(..hypotheses.len());
    let size_of = sized(&hypotheses[truth], random);
    let has_two = random.bool();
    if !hypotheses[truth].allows(&size_of) {
        return None;
    }
    let mistake = (case != Case::Right).then_some((&hypotheses[truth], size_of.as_slice()));
    let levels = if has_two { vec![cells / 2, cells] } else { vec![cells] };
    let meshes = levels.iter().map(|&cells| written(&exact, &method, cells, mistake));
    let meshes: Vec<Mesh> = meshes.collect::<Option<_>>()?;
    let right = written(&exact, &method, cells, None)?;
    let points = meshes.iter().flat_map(|mesh| &mesh.snapshots).map(|it| it.reference.len() / D);
    let smooth = Smooth::new(&exact.domain.body, points.min()?).ok()?;
    let snapshots: Vec<&Snapshot> = meshes.last()?.snapshots.iter().collect();
    let frame = Frame::new(&exact, &snapshots, smooth);
    let error = |mesh: &Mesh| Some(size(&frame.errors_of(&exact, mesh)?.coefficients));
    if case != Case::Right && error(meshes.last()?)? <= 3.0 * error(&right)? {
        return None;
    }
    let title = hypotheses[truth].title();
    if case == Case::Open {
        let family = family(&hypotheses[truth]);
        hypotheses.retain(|it| self::family(it) != family);
    }
    let answer = diagnose(&exact, &frame, &meshes, &hypotheses).ok()?;
    let size_of: Vec<String> = size_of.iter().map(|it| format!("{it:.3e}")).collect();
    let of = format!("{} {} {}", method.shape, method.formulation, method.integrator);
    let mistake = match case {
        Case::Right => of,
        _ => format!("{title} {} ({of})", size_of.join(", ")),
    };
    Some(outcome(&answer, &hypotheses, case, &title, (name, mistake)))
}

fn outcome<const D: usize>(
    answer: &Diagnosis,
    hypotheses: &[Hypothesis<D>],
    case: Case,
    truth: &str,
    (field, mistake): (&str, String),
) -> Outcome {
    let is_truth = |index: usize| case == Case::Closed && hypotheses[index].title() == truth;
    let best = answer.ranked.first();
    let in_class = best.is_some_and(|best| {
        let class = best.equivalent_here.iter().chain(&best.equivalent_always);
        let of = |title: &String| answer.ranked.iter().find(|it| it.title() == *title);
        is_truth(best.hypothesis) || class.filter_map(of).any(|it| is_truth(it.hypothesis))
    });
    let most = answer.ranked.iter().max_by(|a, b| a.explained.total_cmp(&b.explained));
    Outcome {
        finding: match (answer.finding, in_class) {
            (Finding::Nothing, _) => "nothing",
            (Finding::Unexplained, _) => "unexplained",
            (Finding::Named, true) => "right",
            (Finding::Named, false) => "wrong",
        },
        field: field.into(),
        mistake,
        first: best.map_or(String::new(), |it| format!("{} {:.3?}", it.title(), it.factor)),
        explained: best.map_or(0.0, |it| it.explained),
        is_right_by_share: most.is_some_and(|it| is_truth(it.hypothesis)),
    }
}
