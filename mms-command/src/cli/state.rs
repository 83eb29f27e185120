//! `mms state`: exact states for any solver.

use std::path::PathBuf;

use anyhow::{bail, ensure};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{ArgGroup, Args};
use mms_codegen::variation::Variation;
use mms_codegen::{Options, Selection};
use mms_documents::state as documents;
use mms_exact::Exact;
use mms_exact::validate_division;
use mms_exact::{Input, evaluated};
use mms_mechanics::extent::is_between;
use mms_options::field::{Variant, open};
use mms_options::method::finite;
use mms_runtime::Division;
use mms_runtime::scene::usual_cells;
use mms_spec::own::Part;
use mms_spec::quantity::Quantity;
use mms_state::domain::Domain;
use mms_state::file::{Frame, Target};
use mms_state::points::{Given, PER_CELL, Places, Points};
use mms_state::{USUAL, Wanted, WithheldTerm};

use super::naming::Naming;
use super::{CommandOutcome, print, print_json, refuse_overwriting};

/// Write exact states of a field at points and times: to start a solver in the middle of a motion, to feed a solver that
/// reads tables, or to view.
///
/// A state contains X, x, u, v, F, P, sigma, the density and b. At the points of each face it contains the traction P N per
/// reference area, as traction_FACE, which is 0 at all other points. If volumes are known, it contains the present and the
/// reference volume, and the mass, which is density times volume. In an axisymmetric field a point represents a ring; its
/// volume and mass are per radian. `mms judge` reads states as they are. Tables and NumPy files have symbols for names (X, u,
/// F); VTK files have words (reference_position, displacement), and their points are x.
///
/// The file, or FILE.json beside a table, contains the data of the field that a solver needs once: the time window, the
/// extent of the motion, and the claim on each face. In VTK they are field data and in NumPy arrays, called time_window,
/// motion_lower, motion_upper and face_x_min.
#[derive(Args)]
#[command(group = ArgGroup::new("where").required(true))]
pub struct State {
    /// A name that `mms list` prints, or the path of a TOML file.
    field: String,
    /// Take the points of this file, which contains X, or x and u: CSV with a header, VTK or NumPy, recognised by its
    /// content. Cells between the points are written too, and volumes of the undeformed body.
    #[arg(long, value_name = "FILE", group = "where")]
    points: Option<String>,
    /// Take the particles of a grid with this many cells: along the longest edge of the body, or along each axis, as in
    /// 32x16.
    #[arg(long, value_name = "N[xN..]", group = "where")]
    cells: Option<Division>,
    /// The number of particles per cell along each axis, as in 2 or 3x2.
    #[arg(long, value_name = "N[xN..]", default_value_t = PER_CELL, conflicts_with = "points")]
    particles_per_cell: Division,
    #[command(flatten)]
    naming: Naming,
    /// Read the given points as x, and compute their X at each time. Interval arithmetic proves that X exists and is unique;
    /// if two X are at one x, the message names both.
    #[arg(long)]
    at_present: bool,
    /// The times of the states, separated by commas; a static field needs none.
    #[arg(long, value_name = "T,..", value_delimiter = ',', value_parser = finite, allow_hyphen_values = true)]
    time: Vec<f64>,
    /// The quantities to write in addition to X, separated by commas, or `all`. `all` excludes second_piola_kirchhoff,
    /// pressure, von_mises and strain: name them to get them.
    #[arg(long, value_name = "NAME,..", value_delimiter = ',')]
    quantity: Vec<String>,
    /// Write all nine components of tensors: plane strain in two dimensions, uniaxial strain in one. F_33 is 1, and the
    /// stress out of the plane is included.
    #[arg(long)]
    all_components: bool,
    /// Omit a term from the input of the solver, so that its order must drop: body_force (b = 0), stress (P, sigma and other
    /// stresses are 0: a solver that starts from stored stress starts without it), traction (P N = 0 on every face). The
    /// motion is unchanged: u, v and F remain as in the field.
    #[arg(long, value_name = "TERM,..", value_delimiter = ',', value_parser = terms())]
    without: Vec<WithheldTerm>,
    /// Write the affine part of the motion about the middle c of the body, u(c, t) + H(c, t) (X - c). If the material is the
    /// same everywhere, so is the stress, and b is the acceleration alone: the errors of a consistent method are round-off
    /// and the error of its time steps. With --rigid a rigid motion is added.
    #[arg(long)]
    affine: bool,
    /// Set a parameter to a value; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    variant: Variant,
    /// The file to write: .csv, .vtu or .npz, and not a link. A table contains all times. Of .vtu and .npz, one numbered file
    /// is written for each time, and for .vtu a list of them (.pvd).
    #[arg(long, short, value_name = "FILE")]
    output: Target,
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
}

/// Reads a term that a solver is not given.
fn terms() -> impl TypedValueParser<Value = WithheldTerm> {
    let name = |term: WithheldTerm| PossibleValue::new(term.name()).help(term.says());
    let names = PossibleValuesParser::new(WithheldTerm::ALL.map(name));
    names.try_map(|name| WithheldTerm::from_name(&name).ok_or("no term"))
}

impl State {
    pub fn run(mut self) -> anyhow::Result<CommandOutcome> {
        let variation = if self.affine { Variation::Affine } else { Variation::Nothing };
        let options = Options { variation, ..self.variant.options(Selection::default()) };
        let input = Input::new(open(&self.field)?, &options)?;
        let read: Vec<PathBuf> =
            input.files().into_iter().chain(self.points.iter().map(PathBuf::from)).collect();
        refuse_overwriting("--output", self.output.path(), &read)?;
        let quantities = match self.quantity.as_slice() {
            [] => {
                let own = input.own_quantities().into_iter();
                let given = own.filter(|own| own.part == Part::Value).map(Quantity::Own);
                USUAL.into_iter().chain(given).collect()
            }
            names => evaluated(&input.own_quantities(), names)?,
        };
        let quantities = input.offered(&self.quantity, quantities)?;
        if self.time.is_empty() {
            ensure!(
                input.is_static(),
                "`{}` moves: give the times with `--time T,..`",
                input.name.shown()
            );
            self.time.push(0.0);
        }
        let mut exact = Exact::new(input, &self.set)?.in_space_if(self.all_components);
        self.validate_times(&exact)?;
        let domain = Domain::of(&mut exact)?;
        let frames = self.frames(&mut exact, &quantities, &domain)?;
        let written = self.output.write(&frames, &domain)?;
        self.tell(&exact, &domain, &frames, &written)?;
        Ok(CommandOutcome::AsExpected)
    }

    fn validate_times(&self, exact: &Exact) -> anyhow::Result<()> {
        let [first, last] = exact.window;
        let is_outside =
            |time: &&f64| !exact.input().is_static() && !is_between(first, last, **time);
        match self.time.iter().find(is_outside) {
            Some(time) => bail!(
                "`--time {time}`: outside the time window of `{}`, {first:?} to {last:?}: nothing is claimed or proved at \
                 that time",
                exact.input().name.shown()
            ),
            None => self.validate_single(),
        }
    }

    /// Refuses a time that is given twice: a motion has one state at a time.
    fn validate_single(&self) -> anyhow::Result<()> {
        let is_twice = |(at, time): &(usize, &f64)| self.time[..*at].contains(time);
        match self.time.iter().enumerate().find(is_twice) {
            Some((_, time)) => bail!("`--time`: {time} is given twice; name each time once"),
            None => Ok(()),
        }
    }

    /// The states at all times.
    fn frames(
        &self,
        exact: &mut Exact,
        quantities: &[Quantity],
        domain: &Domain,
    ) -> anyhow::Result<Vec<Frame>> {
        let names = self.output.names();
        let wanted = Wanted { quantities, without: &self.without, names, domain };
        let given = self.given(exact)?;
        let mut frames = Vec::new();
        for &time in &self.time {
            let points = given.at(exact, &self.set, time)?;
            wanted.validate_memory(exact, &points, self.time.len())?;
            if !self.quantity.is_empty() {
                validate_faces(quantities, &points, exact)?;
            }
            frames.push(Frame::new(&wanted, exact, &points, time)?);
        }
        Ok(frames)
    }

    fn given(&self, exact: &Exact) -> anyhow::Result<Given> {
        let dimension = exact.dimension;
        let names = self.naming.names(Some(exact.input()))?;
        match (&self.points, &self.cells) {
            (Some(path), _) if self.at_present => {
                Ok(Given::Present(Box::new(Places::of_file(path, &names, dimension)?)))
            }
            (Some(path), _) => {
                let outside = |point: &[f64]| exact.body.distance(point);
                Ok(Given::Reference(Points::of_file(path, &names, dimension, &outside)?))
            }
            (None, _) if self.at_present || self.naming.given().is_some() => {
                let option = self.naming.given().filter(|_| !self.at_present);
                let option = option.unwrap_or("--at-present");
                bail!("`{option}`: it is about points of a file; name one with `--points FILE`")
            }
            (None, cells) => {
                let cells = cells.unwrap_or(Division::Uniform(usual_cells(dimension)));
                validate_division("--cells", &cells, dimension)?;
                validate_division("--particles-per-cell", &self.particles_per_cell, dimension)?;
                let scene = exact.input().scene(&self.set, |code| code.double)?;
                let points = Points::of_grid(&scene, &cells, self.particles_per_cell);
                Ok(Given::Reference(points?))
            }
        }
    }

    fn tell(
        &self,
        exact: &Exact,
        domain: &Domain,
        frames: &[Frame],
        written: &[String],
    ) -> anyhow::Result<()> {
        let input = exact.input();
        let first = &frames[0].state;
        let names: Vec<&str> = first.columns.iter().map(|it| it.name.as_str()).collect();
        let count = first.points();
        let points = if count == 1 { "1 point".to_owned() } else { format!("{count} points") };
        if self.json {
            return print_json(&documents::State {
                field: input.name.raw().to_owned(),
                files: written.to_vec(),
                source: frames[0].how.to_string(),
                points: count,
                times: self.time.clone(),
                columns: names.into_iter().map(str::to_owned).collect(),
                without: self.without.iter().map(|it| it.name().to_owned()).collect(),
                affine: self.affine,
                domain: domain.document(),
            });
        }
        let title = format!("{}: {}", input.name.shown(), input.compiled.field.title.shown());
        let times: Vec<_> = self.time.iter().map(|time| format!("{time:?}")).collect();
        let left_out = self.without.iter().map(|term| format!("\n0 here: {}", term.name()));
        print(&format!(
            "{title}\nX: {}\n{}\n{points} at t = {}: {}{}\nwrote {}",
            frames[0].how,
            domain.text(),
            times.join(", "),
            names.join(", "),
            left_out.collect::<String>(),
            written.join(", ")
        ))
    }
}

/// Refuses tractions that are requested by name if no point has one.
fn validate_faces(quantities: &[Quantity], points: &Points, exact: &Exact) -> anyhow::Result<()> {
    let wanted = quantities.iter().find(|quantity| quantity.takes_normal());
    ensure!(
        wanted.is_none() || !points.faces(exact).is_empty(),
        "`--quantity {}`: no point lies on a face of the body; give points that do",
        wanted.map_or("", |quantity| quantity.name())
    );
    Ok(())
}
