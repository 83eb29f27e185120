//! The options of a method, the same in every command that runs one.
//!
//! Precision and form are one value, `Arithmetic`, beside the runtime's `Method`, which contains neither: its numbers are a
//! type parameter, and it runs any given field. Every text of a method, in words, as keys, or in the key of a result or a
//! checkpoint, includes `Arithmetic`. `mms report` leaves out a document that lacks one of the two: an older
//! version wrote it.

use std::fmt;
use std::str::FromStr;

use anyhow::bail;
use clap::Args;
use mms_codegen::certify::certificate::not_computed;
use mms_exact::Input;
use mms_exact::validate_division;
use mms_exact::wave::{fastest_wave, without_bound};
use mms_files::machine::{memory, processors};
use mms_mechanics::sample::domain;
use mms_runtime::{
    Division, Fill, FormulationName, IntegratorName, Method, Setup, ShapeName, Transfer,
};
use mms_spec::Form;

use crate::field::{Motion, Variant};

/// The precision of the solver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Precision {
    /// Single precision.
    F32,
    /// Double precision.
    #[default]
    F64,
}

impl Precision {
    /// The word of the command line.
    pub fn name(self) -> &'static str {
        match self {
            Precision::F32 => "f32",
            Precision::F64 => "f64",
        }
    }
}

/// The arithmetic of a computation: its precision and its form.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Arithmetic {
    /// The precision of the computation.
    #[arg(long, value_enum, default_value_t)]
    pub precision: Precision,
    /// How the field's quantities are computed: stable, or fast, which needs the fewest operations and loses digits at small
    /// strains.
    #[arg(long, value_name = "stable|fast", default_value = Form::default().name(), value_parser = Form::from_name)]
    pub form: Form,
}

impl fmt::Display for Arithmetic {
    /// Writes the arithmetic in words; the default form is left out.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.precision.name())?;
        match self.form {
            Form::Stable => Ok(()),
            other => write!(f, ", {} form", other.name()),
        }
    }
}

/// The help of an option, with its words.
fn listed(what: &str, words: &[&str]) -> String {
    format!("{what}: {}", words.join(", "))
}

/// How to solve.
#[derive(Args, Clone, Debug)]
pub struct MethodOptions {
    /// The shape function.
    #[arg(long, default_value_t = ShapeName::Cpgimp, help = listed("The shape function", ShapeName::NAMES))]
    pub shape: ShapeName,
    /// The time integrator.
    #[arg(
        long,
        default_value_t = IntegratorName::Leapfrog,
        help = listed("The time integrator", IntegratorName::NAMES)
    )]
    pub integrator: IntegratorName,
    /// The formulation: updated, with a grid in space, or total, with a grid in the reference configuration.
    #[arg(long, default_value_t = FormulationName::Updated)]
    pub formulation: FormulationName,
    /// How the velocity of the grid is transferred to particles: flip, pic, apic, or xpic2 to xpic5.
    #[arg(long, default_value_t = Transfer::FLIP)]
    pub transfer: Transfer,
    /// The fraction of flip in the transfer, from 0 to 1; the rest is pic. 1 by default; needs the transfer flip.
    #[arg(long, value_name = "PART", value_parser = part)]
    flip_fraction: Option<f64>,
    /// Particles per cell along each axis, as in 2 or 3x2.
    #[arg(long, value_name = "N[xN..]", default_value = "2")]
    particles_per_cell: Division,
    /// How particles are placed: cartesian, or fitted to the faces of an annulus; by default fitted. In a box both are the
    /// same.
    #[arg(long)]
    fill: Option<Fill>,
    /// Move each particle at random by up to this fraction, from 0 to 1, of half the edges of its domain.
    #[arg(long, value_name = "PART", default_value_t = 0.0, value_parser = part)]
    jitter: f64,
    /// The seed of the random numbers of `--jitter`.
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Shift the grid relative to the body by this fraction of a cell, from 0 to 1: one number for all axes, or one for each.
    /// 0 by default.
    #[arg(long, value_name = "PART[,..]", value_delimiter = ',', value_parser = part)]
    offset: Vec<f64>,
    /// The axes along which the body is periodic: x, y, z; none by default.
    #[arg(long, value_name = "AXIS[,..]", value_delimiter = ',')]
    periodic: Vec<Axis>,
    /// The Courant number: time_step * c0 / shortest edge of a cell. c0 is the fastest wave speed at F = I.
    #[arg(long, default_value_t = 0.4, value_parser = positive)]
    courant: f64,
    /// The time step, in place of the one from the Courant number. It is shortened so that steps fill the time window.
    #[arg(long, value_name = "DT", conflicts_with = "courant", value_parser = positive)]
    time_step: Option<f64>,
    /// Bring a static field to its equilibrium by dynamic relaxation: from rest along a ramp of its loads, with a fictitious
    /// mass and kinetic damping, until the residual at the nodes is below 1e-9 of the forces. Errors are measured at the end.
    #[arg(long, conflicts_with = "end_time")]
    pub relax: bool,
    /// Allow a time step above the stable one, in which a wave may cross a cell.
    #[arg(long)]
    pub allow_unstable: bool,
    /// The time at which the run ends; by default the end of the field's time window.
    #[arg(long = "time", value_name = "T", value_parser = finite)]
    end_time: Option<f64>,
    /// The number of threads of a run; by default one for each processor. Results do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Precision and form.
    #[command(flatten)]
    pub arithmetic: Arithmetic,
}

/// Reads a number within some bounds; `expected` says which.
fn number(
    text: &str,
    expected: &'static str,
    holds: impl Fn(f64) -> bool,
) -> Result<f64, &'static str> {
    text.trim().parse().ok().filter(|&value| holds(value)).ok_or(expected)
}

/// Reads a number that is neither infinite nor NaN.
pub fn finite(text: &str) -> Result<f64, &'static str> {
    number(text, "expected a finite number", f64::is_finite)
}

/// Reads a number above 0.
pub fn positive(text: &str) -> Result<f64, &'static str> {
    number(text, "expected a positive number", |value| value > 0.0 && value.is_finite())
}

/// Reads a length above 0, as a number or as a fraction.
pub fn length(text: &str) -> Result<f64, &'static str> {
    match text.split_once('/') {
        Some((above, below)) => positive(&(positive(above)? / positive(below)?).to_string()),
        None => positive(text),
    }
}

/// Reads a part of a whole.
fn part(text: &str) -> Result<f64, &'static str> {
    number(text, "expected a number from 0 to 1", |value| (0.0..=1.0).contains(&value))
}

/// The name of an axis.
#[derive(Clone, Copy, Debug)]
struct Axis(usize);

impl FromStr for Axis {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let axis = ["x", "y", "z"].iter().position(|&name| name == text);
        axis.map(Axis).ok_or("expected x, y or z")
    }
}

impl MethodOptions {
    /// The variant of the field, with a motion on top.
    pub fn variant(&self, motion: &Motion) -> Variant {
        Variant::new(motion.clone(), self.arithmetic.form)
    }

    /// The method for a field with some parameters set, its time step limited to the stable one; with a note if no stable time
    /// step is known.
    ///
    /// # Errors
    /// A method that the field does not allow.
    pub fn method_for(
        &self,
        input: &Input,
        settings: &[String],
    ) -> anyhow::Result<(Method, Option<String>)> {
        match self.relax {
            true => input.validate_static()?,
            false => input.validate_moving()?,
        }
        input.validate_settings(settings)?;
        let mut method = self.method(input.compiled.field.dimension)?;
        self.validate_end(input, settings)?;
        self.validate_precision(input, settings)?;
        method.setup.memory = Some(memory());
        if self.allow_unstable {
            return Ok((method, None));
        }
        method.setup.fastest_wave = fastest_wave(input, &input.settings(settings)?, &method);
        let note = method.setup.fastest_wave.is_none().then(|| without_bound(input));
        Ok((method, note))
    }

    /// Refuses single precision if it cannot compute the field. If double precision cannot, that is an error of the file.
    fn validate_precision(&self, input: &Input, settings: &[String]) -> anyhow::Result<()> {
        if self.arithmetic.precision == Precision::F64 {
            return Ok(());
        }
        let set = input.settings(settings)?;
        match not_computed(&input.compiled, &set, mms_program::precision::Precision::F32) {
            Some(found) => {
                bail!("{}: {}; run it with `--precision f64`", found.message, found.label)
            }
            None => Ok(()),
        }
    }

    /// Refuses an end that is not behind the beginning.
    fn validate_end(&self, input: &Input, settings: &[String]) -> anyhow::Result<()> {
        let Some(end) = self.end_time else { return Ok(()) };
        let parameters = input.compiled.parameters::<f64>(&input.settings(settings)?);
        let (_, [start, usual]) = domain(&input.compiled.program, &parameters);
        if end <= start {
            bail!(
                "`--time {end}`: `{}` begins at {start}; expected a later time, as in `--time {usual:.3e}`",
                input.name.shown()
            );
        }
        Ok(())
    }

    /// The method, or the option that contradicts another one or the dimension of the body.
    pub fn method(&self, dimension: usize) -> anyhow::Result<Method> {
        let transfer = match (self.transfer, self.flip_fraction) {
            (transfer, None) => transfer,
            (Transfer::Flip { .. }, Some(fraction)) => Transfer::Flip { fraction },
            (other, Some(_)) => {
                bail!(
                    "`--flip-fraction` is a part of flip, and the transfer is {other}: leave one out"
                )
            }
        };
        let offset = match *self.offset.as_slice() {
            [] => [0.0; 3],
            [one] => [one; 3],
            ref all if all.len() == dimension => {
                std::array::from_fn(|axis| all.get(axis).copied().unwrap_or(0.0))
            }
            ref all => bail!("`--offset`: {} numbers for {dimension} dimension(s)", all.len()),
        };
        let mut periodic = [false; 3];
        for Axis(axis) in &self.periodic {
            if *axis >= dimension {
                bail!("`--periodic`: a body of {dimension} dimension(s) has no such axis");
            }
            periodic[*axis] = true;
        }
        validate_division("--particles-per-cell", &self.particles_per_cell, dimension)?;
        let setup = Setup {
            transfer,
            particles_per_cell: self.particles_per_cell,
            fill: self.fill,
            jitter: self.jitter,
            seed: self.seed,
            offset,
            periodic,
            courant: self.courant,
            time_step: self.time_step,
            parts: 1,
            fastest_wave: None,
            end_time: self.end_time,
            relax: self.relax,
            threads: self.threads.map_or_else(processors, usize::from),
            memory: None,
        };
        let Self { shape, integrator, formulation, .. } = *self;
        let method = Method { shape, integrator, formulation, setup };
        method.validate()?;
        Ok(method)
    }
}
