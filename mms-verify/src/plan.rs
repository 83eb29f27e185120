//! The runs of the rows: each is made once, even if rows share it.

use std::collections::BTreeMap;

use anyhow::Context as _;
use mms_exact::gallery::{self, Entry};
use mms_files::store::digest;
use mms_lab::outcome::{Key, Quantity};
use mms_options::Study;
use mms_runtime::{Division, Method};

use super::matrix::MatrixRow;

/// A run: a level of a row, or of several.
#[derive(Clone, Debug)]
pub struct Job {
    /// The inputs on which the result depends.
    pub key: Key,
    /// The command that makes the same run.
    pub command: String,
    /// The field.
    pub entry: &'static Entry,
    /// Cells, precision, form, parameters and motion.
    pub study: Study,
    /// The method.
    pub method: Method,
    /// The quantity whose errors are measured.
    pub quantity: Quantity,
    /// The approximate work, in some unit.
    pub work: f64,
}

/// The runs of some rows.
#[derive(Debug, Default)]
pub struct RunPlan {
    /// Each once, the longest first.
    pub jobs: Vec<Job>,
    /// The position of the run for each row and level, coarse to fine.
    pub levels: Vec<Vec<usize>>,
}

impl RunPlan {
    /// The runs of rows, in full or quickly.
    ///
    /// # Errors
    /// A row without a meaning.
    pub fn new(rows: &[&MatrixRow], quick: bool, program: &str) -> anyhow::Result<Self> {
        let fields = gallery::fields();
        let dimensions: BTreeMap<_, _> =
            fields.iter().map(|field| (field.name.raw(), field.dimension)).collect();
        let mut jobs: Vec<Job> = Vec::new();
        let mut known = BTreeMap::new();
        let mut levels = Vec::new();
        for row in rows {
            let mut of_row = Vec::new();
            for level in 0..row.levels(quick) {
                let job = job(row, level, program, &dimensions)?;
                let at = *known.entry(job.key.clone()).or_insert(jobs.len());
                if at == jobs.len() {
                    jobs.push(job);
                }
                of_row.push(at);
            }
            levels.push(of_row);
        }
        // The longest first, so that no thread is left with one while the others have nothing to do.
        let mut sequence: Vec<usize> = (0..jobs.len()).collect();
        sequence.sort_by(|&a, &b| jobs[b].work.total_cmp(&jobs[a].work));
        let mut position = vec![0; jobs.len()];
        for (at, &job) in sequence.iter().enumerate() {
            position[job] = at;
        }
        for at in levels.iter_mut().flatten() {
            *at = position[*at];
        }
        let jobs = sequence.iter().map(|&job| jobs[job].clone()).collect();
        Ok(RunPlan { jobs, levels })
    }
}

/// A level of a row.
fn job(
    row: &MatrixRow,
    level: usize,
    program: &str,
    dimensions: &BTreeMap<&str, usize>,
) -> anyhow::Result<Job> {
    let (_, entry) = row.study()?;
    let (arguments, study) = row.level(level)?;
    let dimension = *dimensions.get(entry.name).context("the gallery cannot be read")?;
    let mut method = study.method.method(dimension)?;
    // Several runs are made at the same time.
    method.setup.threads = 1;
    // A run records its momentum, also if displacements are measured.
    let quantity = match row.quantity.clone() {
        Quantity::MeanVelocity(_) => Quantity::Displacement,
        other => other,
    };
    let cells = &study.cells[0];
    let work = work(&study, &method, cells, dimension);
    let Study { set, motion, method: options, .. } = &study;
    let key = Key {
        program: program.to_owned(),
        field: digest([entry.text, entry.material.unwrap_or_default()]),
        run: format!("{method:?}, {cells} cells, {:?}, {set:?}, {motion:?}", options.arithmetic),
        quantity: quantity.name(),
        defect: None,
    };
    let command = format!("mms run {arguments}");
    Ok(Job { key, command, entry, study, method, quantity, work })
}

/// Approximately particles times steps; interpreted fields take longer.
fn work(study: &Study, method: &Method, cells: &Division, dimension: usize) -> f64 {
    const INTERPRETED: f64 = 30.0;
    let per_axis = |division: &Division| match *division {
        Division::Uniform(number) => vec![number; dimension],
        Division::PerAxis(..) => division.numbers(),
    };
    let product = |numbers: Vec<usize>| numbers.into_iter().map(|n| n as f64).product::<f64>();
    let longest = cells.numbers().into_iter().max().unwrap_or(1) as f64;
    let particles = product(per_axis(cells)) * product(per_axis(&method.setup.particles_per_cell));
    let scale = if study.variant() == Default::default() { 1.0 } else { INTERPRETED };
    particles * longest / method.setup.courant * scale
}
