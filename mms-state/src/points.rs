//! The points of a state: of a file, of a grid, or the material points at given places.

use std::borrow::Cow;

use anyhow::{bail, ensure};
use mms_analysis::inverse_motion::{Inverse, Unplaced};
use mms_exact::{Exact, TURNS, says};
use mms_files::machine::memory;
use mms_files::results::Disk;
use mms_judge::results::{Results, placed, without_positions};
use mms_results::motion::{ReferenceBody, resolve};
use mms_results::names::{Names, Role, Values, all_names, everything, recognise};
use mms_results::{Array, Cells, Snapshot};
use mms_runtime::scene::{Layout, Scene};
use mms_runtime::{Division, Setup};
use mms_spec::Face;
use mms_spec::foreign::shown;

/// The default number of particles in each direction of a cell.
pub const PER_CELL: Division = Division::Uniform(2);

/// Points of a body.
#[derive(Clone, Debug, Default)]
pub struct Points {
    /// X, point by point.
    pub reference: Vec<f64>,
    /// The rounding of each coordinate.
    pub rounding: f64,
    /// V0, if it is known.
    pub volume: Option<Vec<f64>>,
    /// The cells between the points, if there are any.
    pub cells: Cells,
    /// The source of the points.
    pub how: String,
}

/// Points that are given by their present places x.
#[derive(Debug)]
pub struct Places {
    snapshot: Snapshot,
    present: Values<'static>,
    volume: Option<Vec<f64>>,
}

/// Points or places that a user gave.
pub enum Given {
    /// Points, the same at all times.
    Reference(Points),
    /// Places x, at which other material points are at each time.
    Present(Box<Places>),
}

impl Given {
    /// The points at a time.
    ///
    /// # Errors
    /// A place with no point of the body, with two, or for which this is not decided.
    pub fn at(
        &self,
        exact: &Exact,
        settings: &[String],
        time: f64,
    ) -> anyhow::Result<Cow<'_, Points>> {
        match self {
            Given::Reference(points) => Ok(Cow::Borrowed(points)),
            Given::Present(places) => {
                let input = exact.input();
                ensure!(!exact.has_swirl(), "`--at-present`: {TURNS}; give X");
                let mut inverse = Inverse::new(&input.compiled, &input.settings(settings)?, time);
                Ok(Cow::Owned(places.points(&mut inverse, exact.dimension, time)?))
            }
        }
    }
}

impl Points {
    /// The particles that the solver of this project starts from.
    ///
    /// # Errors
    /// A grid that cannot be filled.
    pub fn of_grid(
        scene: &Scene<f64>,
        cells: &Division,
        per_cell: Division,
    ) -> anyhow::Result<Self> {
        let setup = Setup { particles_per_cell: per_cell, ..Setup::default() };
        let Layout { reference, volume } = scene.layout(&setup, cells)?;
        let how = format!(
            "the particles of a grid of {cells} cells, {per_cell} in each direction of a cell"
        );
        Ok(Points { reference, volume: Some(volume), how, ..Points::default() })
    }

    /// Reads the points of a file; `outside` measures their distance from the body.
    ///
    /// # Errors
    /// A file that cannot be read, or points outside the body, and where.
    pub fn of_file(
        path: &str,
        names: &Names,
        dimension: usize,
        outside: &dyn ReferenceBody,
    ) -> anyhow::Result<Self> {
        let mut snapshot = one(path, names)?;
        let meanings = recognise(&snapshot, names, &is_place).map_err(placed)?;
        if meanings.iter().all(|it| matches!(it.role, Role::Displacement | Role::Volume)) {
            let distance = |point: &[f64]| outside.distance(point);
            return Err(without_positions(&snapshot, dimension, &distance));
        }
        let motion = resolve(&snapshot, &meanings, dimension, outside, None).map_err(placed)?;
        let how = format!("`{}`: {}", shown(path), motion.how);
        let rounding = motion.reference.rounding;
        let reference = motion.reference.numbers.into_owned();
        let volume = volume(&snapshot, names)?;
        let cells = std::mem::take(&mut snapshot.cells);
        Ok(Points { reference, rounding, volume, cells, how })
    }

    /// The indices of the points on each face that has points.
    pub fn faces(&self, exact: &Exact) -> Vec<(Face, Vec<usize>)> {
        exact.faces(&self.reference, self.rounding)
    }
}

impl Places {
    /// Reads the points of a file as places x, under any of the names of positions.
    ///
    /// # Errors
    /// A file that cannot be read, and where.
    pub fn of_file(path: &str, names: &Names, dimension: usize) -> anyhow::Result<Self> {
        let snapshot = one(path, names)?;
        let meanings = recognise(&snapshot, names, &is_place).map_err(placed)?;
        let named = |role| meanings.iter().find(move |it| it.role == role);
        let roles = [Role::Position, Role::Place, Role::Reference];
        let Some(found) = roles.into_iter().find_map(named) else {
            bail!(
                "`{}`: no positions found: expected x; the file has {}; name them with `--map x=..`",
                shown(path),
                all_names(&snapshot)
            )
        };
        let present = found.values(&snapshot, dimension).map_err(placed)?;
        ensure!(
            !present.is_of_cells,
            "`{}`: positions are of points, and these are of cells",
            shown(path)
        );
        let present = present.into_owned();
        Ok(Places { present, volume: volume(&snapshot, names)?, snapshot })
    }

    /// The points at these places at a time.
    ///
    /// # Errors
    /// A place with no point of the body, with two, or for which this is not decided.
    pub fn points(
        &self,
        inverse: &mut Inverse<'_>,
        dimension: usize,
        time: f64,
    ) -> anyhow::Result<Points> {
        let Places { snapshot, present, volume } = self;
        let mut reference = Vec::with_capacity(present.numbers.len());
        for (at, x) in present.numbers.chunks(dimension).enumerate() {
            match inverse.reference(x, present.rounding) {
                Ok(found) => reference.extend(found),
                Err(why) => bail!("{}: {}", snapshot.place(at), unplaced(x, time, &why)),
            }
        }
        Ok(Points {
            reference,
            rounding: present.rounding,
            volume: volume.clone(),
            cells: snapshot.cells.clone(),
            how: format!("`{}`: what is at these x", shown(&snapshot.path)),
        })
    }
}

fn unplaced(x: &[f64], time: f64, why: &Unplaced) -> String {
    let advice = match why {
        Unplaced::Outside => "is it a reference position? then leave out `--at-present`",
        Unplaced::Several(_) | Unplaced::Undecided(_) => "give X",
    };
    format!("x = {x:?}, t = {time:?}: {}; {advice}", says(why))
}

/// Reads a file with one result.
fn one(path: &str, names: &Names) -> anyhow::Result<Snapshot> {
    let wanted = everything(names).within(memory(), "name a file of fewer points");
    let mut found = Results::find(path, &wanted, &Disk)?.snapshots;
    ensure!(
        found.len() == 1,
        "`{}`: results at {} times; expected points, which are the same at all times: name a file of one time",
        shown(path),
        found.len()
    );
    Ok(found.remove(0))
}

fn is_place(role: Role) -> bool {
    matches!(
        role,
        Role::Reference | Role::Position | Role::Place | Role::Displacement | Role::Volume
    )
}

/// V0: the array of that name, or, for points at X, the volume.
fn volume(snapshot: &Snapshot, names: &Names) -> anyhow::Result<Option<Vec<f64>>> {
    let is_named = |array: &&Array| array.name == "reference_volume" && array.components == 1;
    let own = snapshot.of_points.iter().find(is_named).map(|array| array.values.clone());
    let found = match own {
        Some(values) => Some(values),
        None => {
            let meanings =
                recognise(snapshot, names, &|role| role == Role::Volume).map_err(placed)?;
            let meaning = meanings.iter().find(|it| it.role == Role::Volume);
            let values = meaning.map(|it| it.values(snapshot, 1)).transpose().map_err(placed)?;
            values.filter(|it| !it.is_of_cells).map(|it| it.numbers.into_owned())
        }
    };
    let is_odd = |value: &f64| !(value.is_finite() && *value > 0.0);
    if let Some(at) = found.iter().flatten().position(is_odd) {
        let value = found.iter().flatten().nth(at).copied().unwrap_or(f64::NAN);
        bail!("{}: the volume is {value}; expected a positive number", snapshot.place(at));
    }
    Ok(found)
}
