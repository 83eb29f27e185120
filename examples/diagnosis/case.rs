//! One case: a solver with a mistake, and the diagnosis of its results.

use mms_diagnosis::answer::{Diagnosis, DiagnosisFinding};
use mms_diagnosis::changed::{Changed, Without};
use mms_diagnosis::evidence::{ComparisonFrame, DEGREE, Mesh, Snapshot};
use mms_diagnosis::exact::{Exact, Quantity, vectors};
use mms_diagnosis::hypothesis::{Change, Given, Hypothesis, Size, all};
use mms_diagnosis::ordinary::diagnose;
use mms_diagnosis::smooth::{Smooth, size};
use mms_diagnosis::solver::Solver;
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
    /// No mistake of its family is in the list.
    Open,
    /// Two mistakes, both in the list.
    Two,
    /// No mistake.
    Right,
}

impl Case {
    /// The name in the table.
    pub fn name(self) -> &'static str {
        match self {
            Case::Closed => "closed",
            Case::Open => "open",
            Case::Two => "two",
            Case::Right => "right",
        }
    }
}

/// The result of a case.
#[derive(Debug)]
pub struct Outcome {
    /// `right`, `wrong`, `unexplained` or `nothing`.
    pub finding: &'static str,
    /// The field.
    pub field: String,
    /// The name of the mistake.
    pub name: &'static str,
    /// The mistake, its size and the method.
    pub mistake: String,
    /// The first name of the answer.
    pub first: String,
    /// The share of the squared error that the first name explains.
    pub explained: f64,
    /// Whether the hypothesis that explains most is the mistake.
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
type Mistake<'a, const D: usize> = (&'a Hypothesis<D>, Vec<f64>);

/// The results of a run with up to two mistakes, as a user writes them; `None` if the run fails.
fn written<const D: usize>(
    exact: &Exact<'_, D>,
    method: &Method,
    cells: usize,
    mistakes: &[Mistake<'_, D>],
) -> Option<Mesh>
where
    f64: Solve<D>,
{
    let right = Without::default();
    let first = match mistakes.first() {
        Some((hypothesis, size)) => Changed::with(exact, right, hypothesis, size),
        None => Changed::right(exact, right),
    };
    let inner = Exact::new(&first, exact.cell_size, exact.time_step);
    let changed = match mistakes.get(1) {
        Some((hypothesis, size)) => Changed::with(&inner, right, hypothesis, size),
        None => Changed::right(&inner, right),
    };
    let window = [exact.domain.time[0], method.setup.end_time?];
    let mut states = States { window, seen: Vec::new() };
    let field: &dyn ManufacturedField<f64, D> = &changed;
    let cells = Division::Uniform(cells);
    let run = f64::run(field, method, &cells, Watch::Displacement, &mut states).ok()?;
    run.level.errors.ok()?;
    let snapshots =
        states.seen.iter().map(|state| snapshot(exact, state, mistakes.first())).collect();
    Some(Mesh { cell_size: run.level.cell_size, time_step: None, snapshots })
}

/// X and u of a state, with the mistake if it is one of the output.
fn snapshot<const D: usize>(
    exact: &Exact<'_, D>,
    state: &State,
    mistake: Option<&Mistake<'_, D>>,
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
    let values = vec![(Quantity::Displacement, u)];
    Snapshot { time: state.time, reference, values, ..Snapshot::default() }
}

/// Draws a method that a user may have.
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

/// Draws a size of a mistake: its distance from the right size is 0.1 to 3 times the distance of the first tried size.
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

/// The size on a mesh that is `coarser` times as coarse.
fn on_mesh<const D: usize>(size: &[f64], hypothesis: &Hypothesis<D>, coarser: usize) -> Vec<f64> {
    let factor = if hypothesis.is_of_mesh { coarser as f64 } else { 1.0 };
    size.iter().map(|it| it * factor).collect()
}

/// The family of a hypothesis: all members have effects of one kind.
fn family<const D: usize>(hypothesis: &Hypothesis<D>) -> &'static str {
    match hypothesis.name {
        "stress_small_strain" | "material" => "law",
        "deformation_transposed" | "strain_left" => "kinematics",
        "moduli_factor" | "lambda_factor" | "mu_factor" | "moduli_swapped" | "shear_factor"
        | "density_factor" | "mass_factor" => "moduli",
        "force_late" | "output_time" | "start_half_step" => "time",
        "output_factor" | "increment_for_total" => "scale",
        "damping" | "damping_local" | "viscosity" | "artificial_viscosity" => "damping",
        "constant_force" | "coriolis" | "centrifugal" => hypothesis.name,
        name if name.starts_with("stress_") => "measure",
        _ if matches!(hypothesis.change, Change::Force(_)) => "force",
        name => name,
    }
}

/// Draws a case, and diagnoses it; `None` if it does not count.
pub fn drawn<const D: usize>(
    field: &str,
    manufactured: &dyn ManufacturedField<f64, D>,
    case: Case,
    random: &mut fastrand::Rng,
) -> Option<Outcome>
where
    f64: Solve<D>,
{
    let cells = [[32, 64], [16, 24], [6, 8]][D - 1][random.usize(..2)];
    let mut method = method(case, random);
    let scout = Exact::new(manufactured, 1.0, 1.0);
    let [lower, upper] = bounding_box(&scout.domain.body).ok()?;
    let cell_size = (upper - lower).max() / cells as f64;
    let time_step = method.setup.courant * cell_size / scout.wave_speed();
    let exact = Exact::new(manufactured, cell_size, time_step);
    let [start, stop] = exact.domain.time;
    method.setup.end_time = Some(start + (stop - start) * (0.2 + 0.8 * random.f64()));
    let mut hypotheses = all(&exact);
    let count = match case {
        Case::Right => 0,
        Case::Closed | Case::Open => 1,
        Case::Two => 2,
    };
    let truths: Vec<usize> = (0..count).map(|_| random.usize(..hypotheses.len())).collect();
    let sizes: Vec<Vec<f64>> = truths.iter().map(|it| sized(&hypotheses[*it], random)).collect();
    let has_two = random.bool();
    let pairs = || truths.iter().map(|it| &hypotheses[*it]).zip(&sizes);
    if !pairs().all(|(hypothesis, size)| hypothesis.allows(size))
        || !are_apart(&hypotheses, &truths)
    {
        return None;
    }
    let levels = if has_two { vec![cells / 2, cells] } else { vec![cells] };
    let on = |level: usize| {
        let mistakes = pairs().map(|(it, size)| (it, on_mesh(size, it, cells / level)));
        written(&exact, &method, level, &mistakes.collect::<Vec<_>>())
    };
    let meshes: Vec<Mesh> = levels.iter().map(|level| on(*level)).collect::<Option<_>>()?;
    let right = written(&exact, &method, cells, &[])?;
    let points = meshes.iter().flat_map(|mesh| &mesh.snapshots).map(|it| it.reference.len() / D);
    let smooth = Smooth::new(&exact.domain.body, points.min()?, DEGREE).ok()?;
    let snapshots: Vec<&Snapshot> = meshes.last()?.snapshots.iter().collect();
    let frame = ComparisonFrame::new(&exact, &snapshots, smooth);
    let error = |mesh: &Mesh| Some(size(&frame.sight(mesh)?.errors_of(&exact)?.coefficients));
    if case != Case::Right && error(meshes.last()?)? <= 3.0 * error(&right)? {
        return None;
    }
    let titles: Vec<String> = pairs().map(|(it, _)| it.title()).collect();
    let name = truths.first().map_or("none", |it| hypotheses[*it].name);
    if case == Case::Open {
        let family = family(&hypotheses[truths[0]]);
        hypotheses.retain(|it| self::family(it) != family);
    }
    let answer = diagnose(&exact, &frame, &meshes, &hypotheses, &Solver::default()).ok()?;
    let of = format!("{} {} {}", method.shape, method.formulation, method.integrator);
    let told = |(title, size): (&String, &Vec<f64>)| {
        let size: Vec<String> = size.iter().map(|it| format!("{it:.3e}")).collect();
        format!("{title} {}", size.join(", ")).trim_end().to_owned()
    };
    let told: Vec<String> = titles.iter().zip(&sizes).map(told).collect();
    let mistake = if told.is_empty() { of } else { format!("{} ({of})", told.join(" and ")) };
    Some(outcome(&answer, &hypotheses, case, &titles, Told { field, name, mistake }))
}

/// The texts that describe a case.
struct Told<'a> {
    field: &'a str,
    name: &'static str,
    mistake: String,
}

/// Whether two mistakes are of different families, and both of computed quantities; true for fewer than two.
fn are_apart<const D: usize>(hypotheses: &[Hypothesis<D>], truths: &[usize]) -> bool {
    let [first, second] = truths else { return true };
    let [first, second] = [first, second].map(|it| &hypotheses[*it]);
    let is_computed = |it: &Hypothesis<D>| !matches!(it.change, Change::Output(_));
    family(first) != family(second) && is_computed(first) && is_computed(second)
}

fn outcome<const D: usize>(
    answer: &Diagnosis,
    hypotheses: &[Hypothesis<D>],
    case: Case,
    truths: &[String],
    told: Told<'_>,
) -> Outcome {
    let is_truth = |index: usize| case != Case::Open && truths.contains(&hypotheses[index].title());
    let best = answer.ranked.first();
    let in_class = best.is_some_and(|best| {
        let class = best.equivalent_here.iter().chain(&best.equivalent_always);
        let of = |title: &String| answer.ranked.iter().find(|it| it.title() == *title);
        is_truth(best.hypothesis) || class.filter_map(of).any(|it| is_truth(it.hypothesis))
    });
    let most = answer.ranked.iter().max_by(|a, b| a.explained.total_cmp(&b.explained));
    Outcome {
        finding: match (answer.finding, in_class) {
            (DiagnosisFinding::Nothing, _) => "nothing",
            (DiagnosisFinding::Unexplained, _) => "unexplained",
            (DiagnosisFinding::Named, true) => "right",
            (DiagnosisFinding::Named, false) => "wrong",
        },
        field: told.field.into(),
        name: told.name,
        mistake: told.mistake,
        first: best.map_or(String::new(), |it| format!("{} {:.3?}", it.title(), it.factor)),
        explained: best.map_or(0.0, |it| it.explained),
        is_right_by_share: most.is_some_and(|it| is_truth(it.hypothesis)),
    }
}
