//! `mms demo`: a solver with one broken line, judged and diagnosed, without any file.
//!
//! `solver.rs` is the solver. `broken`, which the build script writes, is the same text with the wrong line of `mistake.rs`. In
//! this command the interpreter computes the exact loads for both; in the folder of `--keep`, the code that `mms emit` writes
//! does (`main.rs`).

mod mistake;
mod problem;
mod solver;

#[expect(dead_code, reason = "the table of the right solver serves both")]
mod broken {
    include!(concat!(env!("OUT_DIR"), "/broken_solver.rs"));
}

use std::cell::RefCell;
use std::error::Error;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::Args;
use mms_codegen::{Options, Selection};
use mms_convergence::{TOLERANCE, Verdict};
use mms_diagnosis::answer::{Diagnosis, DiagnosisFinding};
use mms_diagnosis::changed::Without;
use mms_diagnosis::follow::Unfollowed;
use mms_diagnosis::solver::Solver;
use mms_emit::{Subject, Target};
use mms_exact::{Exact, Input, settings};
use mms_files::shell::quoted;
use mms_files::write::write_own;
use mms_judge::Judgements;
use mms_judge::diagnose::{Reading, diagnosis_of, falls, find, read};
use mms_judge::results::{self, Comparison, measure};
use mms_judge::table::ExpectedOrders;
use mms_options::field::open;
use mms_report::table::TextTable;
use mms_results::Files;
use mms_results::names::Names;
use mms_spec::foreign;
use mms_spec::quantity::Quantity;

use self::problem::Problem;
use super::{CommandOutcome, print, this_command, validate_output};

/// Demonstrate a diagnosis: a small solver with one broken line is judged, diagnosed, repaired and judged again.
///
/// The solver is built in and computes in memory. `--keep` writes its source, its results, and the commands to build, run,
/// judge and diagnose it, so that you can break another line.
#[derive(Args)]
pub struct Demo {
    /// Write the solver, its results and a file of commands to this folder, which must be new or empty.
    #[arg(long, value_name = "DIR")]
    keep: Option<PathBuf>,
}

/// The field.
const FIELD: &str = "sheared_block_2d";

/// The meshes: cells along each side.
const CELLS: [usize; 3] = [4, 8, 12];

/// The end of each run, in seconds; `main.rs` has it too.
const END: f64 = 0.02;

/// The files of the solver.
const SOURCES: [(&str, &str); 4] = [
    ("solver.rs", include_str!("solver.rs")),
    ("problem.rs", include_str!("problem.rs")),
    ("main.rs", include_str!("main.rs")),
    ("commands.sh", include_str!("commands.sh")),
];

/// The exact field, evaluated a point at a time.
struct Evaluated<'a>(RefCell<&'a mut Exact>);

impl Evaluated<'_> {
    fn value<const N: usize>(&self, quantity: Quantity, t: f64, x: [f64; 2]) -> [f64; N] {
        let values = self.0.borrow_mut().values(quantity, t, &x);
        let values = values.expect("quantities of every field");
        values.try_into().expect("the components of a plane field")
    }
}

impl Problem for Evaluated<'_> {
    fn displacement(&self, t: f64, x: [f64; 2]) -> [f64; 2] {
        self.value(Quantity::Displacement, t, x)
    }

    fn velocity(&self, t: f64, x: [f64; 2]) -> [f64; 2] {
        self.value(Quantity::Velocity, t, x)
    }

    fn body_force(&self, t: f64, x: [f64; 2]) -> [f64; 2] {
        self.value(Quantity::BodyForce, t, x)
    }

    fn stress(&self, t: f64, x: [f64; 2]) -> [[f64; 2]; 2] {
        let [xx, xy, yx, yy] = self.value(Quantity::FirstPiolaKirchhoff, t, x);
        [[xx, xy], [yx, yy]]
    }
}

/// The results of a solver, as files in memory.
struct Tables(Vec<(String, String)>);

impl Tables {
    /// Runs a solver on all meshes, and names their results by its folder.
    fn of(folder: &str, run: impl Fn(usize) -> Vec<[[f64; 2]; 2]>) -> Self {
        let table =
            |cells: usize| (format!("{folder}/{cells}.csv"), solver::table(&run(cells), END));
        Tables(CELLS.into_iter().map(table).collect())
    }

    fn names(&self) -> Vec<String> {
        self.0.iter().map(|(name, _)| name.clone()).collect()
    }
}

impl Files for Tables {
    fn paths(&self, given: &str) -> Result<Vec<PathBuf>, Box<dyn Error + Send + Sync>> {
        Ok(vec![given.into()])
    }

    fn bytes(&self, path: &Path, _: u64) -> Result<Vec<u8>, String> {
        let found = self.0.iter().find(|(name, _)| Path::new(name) == path);
        found.map(|(_, text)| text.clone().into_bytes()).ok_or("no such table".into())
    }

    fn memory(&self) -> u64 {
        mms_files::machine::memory()
    }
}

impl Demo {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        self.keep.as_deref().map_or(Ok(()), validate_new)?;
        let mut exact = Exact::new(Input::new(open(FIELD)?, &Options::default())?, &[])?;
        let (right, broken) = {
            let problem = Evaluated(RefCell::new(&mut exact));
            (
                Tables::of("right", |cells| solver::solve(&problem, cells, END)),
                Tables::of("broken", |cells| broken::solve(&problem, cells, END)),
            )
        };
        let judged = [judge(&right, &mut exact)?, judge(&broken, &mut exact)?];
        let diagnosis = diagnose(&broken, &mut exact)?;
        print(&story(&exact, &judged, &diagnosis)?)?;
        match &self.keep {
            None => print("\nnext: mms demo --keep demo")?,
            Some(folder) => {
                keep(folder, &[right, broken])?;
                let [solver, commands] = ["solver.rs", "commands.sh"].map(|name| folder.join(name));
                print(&format!(
                    "\nBreak another line of {}, and run: sh {}",
                    foreign::path(&solver),
                    quoted(&commands.to_string_lossy())
                ))?;
            }
        }
        let is_shown = judged[0].verdict() == Verdict::Pass
            && judged[1].verdict() == Verdict::Fail
            && diagnosis.finding == DiagnosisFinding::Named;
        Ok(if is_shown { CommandOutcome::AsExpected } else { CommandOutcome::Refuted })
    }
}

/// Judges results, as `mms judge` does.
fn judge(tables: &Tables, exact: &mut Exact) -> anyhow::Result<Judgements> {
    let names = Names::default();
    let reading = results::Reading {
        files: tables,
        names: &names,
        wanted: &[],
        weight: None,
        memory: None,
        is_part: false,
        over: None,
    };
    let all =
        tables.names().iter().map(|it| reading.find(it, exact)).collect::<anyhow::Result<_>>()?;
    let orders = ExpectedOrders::new(&[], TOLERANCE);
    let comparison = Comparison {
        sizes: &[],
        times: &[],
        orders: &orders,
        has_steps: false,
        tighter: None,
        follow: &Unfollowed,
    };
    let measurement = measure(all, &reading, exact, comparison)?;
    let provenance = this_command("demo", exact.input().provenance(&[]));
    Judgements::of_results(exact, &tables.names(), measurement, None, provenance, &Unfollowed)
}

/// Diagnoses results, as `mms diagnose` does.
fn diagnose(tables: &Tables, exact: &mut Exact) -> anyhow::Result<Diagnosis> {
    let names = Names::default();
    let all = tables
        .names()
        .iter()
        .map(|it| find(it, &names, None, tables))
        .collect::<anyhow::Result<Vec<_>>>()?;
    let reading = Reading {
        files: tables,
        right: &[],
        names: &names,
        times: &[],
        rest: None,
        sizes: &[],
        time_steps: &[],
        law: None,
        wanted: &[],
        residual_sign: 1.0,
        is_nodal: false,
    };
    let evidence = read(&all, &reading, exact)?;
    let falls = falls(all, &[], &reading, &ExpectedOrders::new(&[], TOLERANCE), exact)?;
    let solver = Solver {
        without: Without::default(),
        like: None,
        falls,
        is_compared_with_right_run: false,
    };
    Ok(diagnosis_of(exact, &exact.scene()?, &evidence, &solver, &Unfollowed)?.0)
}

/// The sentence of a verdict.
fn verdict(judgements: &Judgements) -> anyhow::Result<String> {
    let (at, _) = judgements.decided();
    let (quantity, judged) = judgements.each().nth(at).context("no quantity was judged")?;
    judgements.sentences(quantity, judged, false).into_iter().next().context("no verdict")
}

/// The errors of both solvers, mesh by mesh.
fn table(judged: &[Judgements; 2]) -> anyhow::Result<String> {
    let [right, broken] = judged.each_ref().map(|it| {
        let norm = it.measured.quantities[0].norms.iter().find(|norm| norm.name.raw() == "l2");
        norm.map(|norm| it.levels(norm)).context("no l2 norm of the displacement")
    });
    let header = ["cells", "right: l2 error of u", "order", "broken: l2 error of u", "order"];
    let mut table = TextTable::new(FIELD.to_owned(), header).right_from(0);
    for ((cells, right), broken) in CELLS.into_iter().zip(right?).zip(broken?) {
        let order = |it: Option<f64>| it.map_or("-".into(), |it| format!("{it:.2}"));
        let error = |it: f64| format!("{it:.2e}");
        table.add_row([
            cells.to_string(),
            error(right.0.error()),
            order(right.1),
            error(broken.0.error()),
            order(broken.1),
        ]);
    }
    Ok(table.to_string())
}

/// The event, in words.
fn story(exact: &Exact, judged: &[Judgements; 2], diagnosis: &Diagnosis) -> anyhow::Result<String> {
    let before = include_str!("solver.rs").split(mistake::RIGHT).next().unwrap_or_default();
    let line = before.split('\n').count();
    let best = diagnosis.ranked.first().context("no hypothesis was tried")?;
    let [right, broken] = judged;
    Ok(format!(
        "{}\n\
         A finite-element solver of one page gets the loads of this exact motion u, and computes u on {} cells a side.\n\
         Then one of its lines is broken, solver.rs:{line}:\n\n    \
             {}    // P N, N along x\n    \
             {}    // P^T N\n\n\
         {}\n\n\
         right   {}\n\
         broken  {}\n\n\
         Diagnosis of the broken solver, from its results alone:\n    \
             {}: {}, {}, explains {:.1} % of the error\n\n\
         The line repaired:\n    {}",
        exact.title(),
        CELLS.map(|it| it.to_string()).join(", "),
        mistake::RIGHT,
        mistake::WRONG,
        table(judged)?,
        verdict(right)?,
        verdict(broken)?,
        diagnosis.finding.name(),
        best.title(),
        best.says,
        100.0 * best.explained,
        verdict(right)?,
    ))
}

/// Refuses a folder that holds something.
fn validate_new(folder: &Path) -> anyhow::Result<()> {
    validate_output(folder)?;
    let is_empty = |folder: &Path| folder.read_dir().is_ok_and(|mut it| it.next().is_none());
    if folder.exists() && !is_empty(folder) {
        bail!("`--keep {}`: the folder is not empty; name a new one", foreign::path(folder));
    }
    Ok(())
}

/// Writes the solver, what it needs, and the results.
fn keep(folder: &Path, results: &[Tables]) -> anyhow::Result<()> {
    let quantities = [
        Quantity::Displacement,
        Quantity::Velocity,
        Quantity::BodyForce,
        Quantity::FirstPiolaKirchhoff,
    ];
    let selection = Selection {
        quantities: Some(quantities.into()),
        set: settings(&[])?,
        ..Selection::default()
    };
    let input = Input::new(open(FIELD)?, &Options::from(selection))?;
    let target = Target::find("rust").context("no target for Rust")?;
    let emitted = (target.emit)(&Subject::new(&input.compiled));
    let forcing = emitted.files.iter().take(1).map(|it| (it.name.as_str(), it.text.as_str()));
    let tables =
        results.iter().flat_map(|it| &it.0).map(|(name, text)| (name.as_str(), text.as_str()));
    for (name, text) in SOURCES.into_iter().chain(forcing).chain(tables) {
        let path = folder.join(name);
        let parent = path.parent().unwrap_or(folder);
        std::fs::create_dir_all(parent)
            .with_context(|| format!("cannot make the folder `{}`", foreign::path(parent)))?;
        write_own(&path, text)
            .with_context(|| format!("cannot write `{}`", foreign::path(&path)))?;
    }
    Ok(())
}
