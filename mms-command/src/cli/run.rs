//! `mms run`: one simulation.

use std::path::PathBuf;

use anyhow::bail;
use clap::Args;
use mms_exact::Input;
use mms_exact::validate_division;
use mms_files::machine::memory;
use mms_files::program::{arguments, identity};
use mms_files::shell::words;
use mms_files::store::digest;
use mms_files::write::is_same;
use mms_files::write::{pretty, write_files};
use mms_options::field::{Motion, find};
use mms_options::method::{MethodOptions, Precision};
use mms_report::UnstartedLevel;
use mms_report::run::Run as Report;
use mms_runtime::scene::usual_cells;
use mms_runtime::study::Watch;
use mms_runtime::{Division, Method};
use mms_spec::foreign;

use super::observers::{Interrupted, Observers};
use super::{CommandOutcome, print, print_json, refuse_overwriting, say, validate_output};
use crate::checkpoint::{CheckpointWriter, Head, StoredCheckpoint};
use crate::history::History;
use crate::provenance;
use crate::session::progress::Progress;
use crate::vtk::Writer;

/// Run one simulation with the built-in solver: errors in u, v, F and P, and the time of each part.
#[derive(Args)]
pub struct Run {
    /// A name that `mms list` prints, or the path of a TOML file.
    field: String,
    /// The number of cells along the longest edge of the body, or along each axis, as in 32 or 32x16. By default 32 in one
    /// dimension, 16 in two and 8 in three.
    #[arg(long, value_name = "N[xN..]")]
    cells: Option<Division>,
    #[command(flatten)]
    method: MethodOptions,
    /// Set a parameter to a value; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    motion: Motion,
    /// Write states for ParaView to this folder: one .vtu file for each state, and FIELD.pvd, the file to open.
    #[arg(long, value_name = "DIR")]
    vtk: Option<PathBuf>,
    /// The number of states to write after the initial one.
    #[arg(long, value_name = "N", default_value_t = 20, requires = "vtk", value_parser = clap::value_parser!(u32).range(1..))]
    frames: u32,
    /// Write a CSV file with a row for every step: errors, J, mass, momentum, energies, the work of the body force, the force
    /// of the faces.
    #[arg(long, value_name = "FILE")]
    history: Option<PathBuf>,
    /// Write checkpoints to this file, at regular steps and if the run is interrupted.
    #[arg(long, value_name = "FILE")]
    checkpoint: Option<PathBuf>,
    /// The number of steps between checkpoints.
    #[arg(long, value_name = "N", default_value_t = 1000, requires = "checkpoint", value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// Continue from a checkpoint of the same run. The results are the same as without the interruption.
    #[arg(long, value_name = "FILE")]
    resume: Option<PathBuf>,
    /// The folder to write run.json to, the document of `--json`.
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
}

impl Run {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        let input = find(&self.field, &self.method.variant(&self.motion))?;
        let dimension = input.compiled.field.dimension;
        let (method, note) = self.method.method_for(&input, &self.set)?;
        note.iter().for_each(say);
        let cells = self.cells.unwrap_or(Division::Uniform(usual_cells(dimension)));
        validate_division("--cells", &cells, dimension)?;
        self.output.as_deref().map_or(Ok(()), validate_output)?;
        self.validate_way()?;
        self.validate_files(&input)?;
        let progress = Progress::new();
        let provenance = provenance::new("run", &from_the_start(), input.provenance(&self.set));
        let head = Head::new(self.key(&input, &method, cells)?, provenance.command.clone());
        let mut followers = self.followers(&input, cells, head, &progress)?;
        let run = match self.method.arithmetic.precision {
            Precision::F32 => {
                let scene = input.scene(&self.set, |code| code.single)?;
                scene.run(&method, &cells, Watch::Everything, &mut followers)
            }
            Precision::F64 => {
                let scene = input.scene(&self.set, |code| code.double)?;
                scene.run(&method, &cells, Watch::Everything, &mut followers)
            }
        };
        progress.finish();
        let kept = followers.end();
        let run = run.map_err(|reason| UnstartedLevel { cells, reason });
        let report = Report {
            field: input.name.clone(),
            title: input.compiled.field.title.clone(),
            arithmetic: self.method.arithmetic,
            method,
            run,
            provenance,
        };
        let run = match &report.run {
            Ok(run) => run,
            Err(UnstartedLevel { reason, .. }) => {
                say(format_args!("error: `{}` cannot be run: {reason}", input.name.shown()));
                if self.json {
                    print_json(&report.document())?;
                }
                return Ok(CommandOutcome::RunFailed);
            }
        };
        // A failure to write files comes after printing, and loses no printed result.
        let states = followers.list_of_states().map(|list| foreign::path(&list));
        let mut written: Vec<String> = states.into_iter().collect();
        if self.json {
            print_json(&report.document())?;
        } else {
            print(&report.text(run))?;
        }
        if let Some(folder) = &self.output {
            written.extend(write_files(folder, "run", [("json", pretty(&report.document())?)])?);
        }
        if !self.json {
            written.iter().try_for_each(|path| print(&format!("\nwrote {path}")))?;
        }
        kept?;
        Ok(match &run.level.errors {
            Ok(_) => CommandOutcome::AsExpected,
            Err(failure) => {
                say(format_args!("error: {failure}"));
                CommandOutcome::RunFailed
            }
        })
    }

    /// Refuses `--history`, `--checkpoint` and `--resume` for a relaxation, whose steps have no physical meaning.
    fn validate_way(&self) -> anyhow::Result<()> {
        let given = [
            ("--history", &self.history),
            ("--checkpoint", &self.checkpoint),
            ("--resume", &self.resume),
        ];
        match given.into_iter().find(|(_, path)| path.is_some() && self.method.relax) {
            Some((option, _)) => bail!(
                "`{option}`: the steps of a relaxation have no physical meaning; leave it out, `--vtk` shows the end"
            ),
            None => Ok(()),
        }
    }

    /// Refuses to write the history or a checkpoint to a file that the run reads, or both to the same file.
    fn validate_files(&self, input: &Input) -> anyhow::Result<()> {
        let inputs = input.files();
        for (option, path) in [("--history", &self.history), ("--checkpoint", &self.checkpoint)] {
            path.as_deref().map_or(Ok(()), |path| refuse_overwriting(option, path, &inputs))?;
        }
        if let (Some(history), Some(checkpoint)) = (&self.history, &self.checkpoint)
            && is_same(history, checkpoint)
        {
            bail!(
                "`--history` and `--checkpoint` name the same file, `{}`",
                foreign::path(history)
            );
        }
        Ok(())
    }

    /// The observers of the run: its outputs, and the checkpoint that it continues from.
    fn followers<'a>(
        &self,
        input: &Input,
        cells: Division,
        head: Head,
        progress: &'a Progress,
    ) -> anyhow::Result<Observers<'a>> {
        let resumed = self
            .resume
            .as_deref()
            .map(|path| StoredCheckpoint::open(path, memory()))
            .transpose()?;
        if let (Some(path), Some(found)) = (&self.resume, &resumed)
            && found.head.key != head.key
        {
            bail!(
                "`--resume {}`: it is a checkpoint of another run, `{}`, and continues only with its options, in the same \
                 build of this program",
                foreign::path(path),
                found.head.command.shown()
            );
        }
        let before = resumed.as_ref().map(|found| found.head.clone());
        let (step, states, mark) =
            before.map_or_else(Default::default, |head| (head.step, head.states, head.history));
        let name = input.name.raw().trim_start_matches('.');
        let vtk = self.vtk.as_deref();
        let vtk = vtk.map(|folder| Writer::new(folder, name, self.frames as usize, step, states));
        let vtk = vtk.transpose()?;
        let dimension = input.compiled.field.dimension;
        let history = self.history.as_deref().map(|path| match step {
            0 => History::new(path, dimension),
            step => History::from(path, step, mark),
        });
        let history = history.transpose()?;
        let checkpoints = self.checkpoint.as_deref();
        let checkpoints = checkpoints
            .map(|path| CheckpointWriter::new(path, self.every as usize, head))
            .transpose()?;
        let interrupted = Interrupted::listen()?;
        Ok(Observers {
            progress: progress.of(cells),
            vtk,
            history,
            checkpoints,
            resumed,
            interrupted,
        })
    }

    /// The identity of this run: everything that its numbers depend on.
    fn key(&self, input: &Input, method: &Method, cells: Division) -> anyhow::Result<String> {
        let mut method = method.clone();
        (method.setup.threads, method.setup.memory) = (1, None);
        let scene = format!("{method:?}, {cells} cells, {:?}", self.method.arithmetic);
        let field = format!("{:?}, {:?}", self.set, self.motion);
        Ok(digest([identity()?, input.compiled.provenance(), scene, field]))
    }
}

/// The command line without `--resume`: what makes the run again.
fn from_the_start() -> Vec<String> {
    let mut all = words(arguments()).into_iter();
    let mut kept = Vec::new();
    while let Some(word) = all.next() {
        match word.as_str() {
            "--resume" => drop(all.next()),
            resume if resume.starts_with("--resume=") => {}
            _ => kept.push(word),
        }
    }
    kept
}
