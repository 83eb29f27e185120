//! The errors of one snapshot.

use anyhow::{anyhow, bail};
use mms_exact::Exact;
use mms_results::mesh::Mesh;
use mms_results::motion::{Motion, validate_distinct};
use mms_results::names::{
    Axes, Form, Meaning, Names, OwnRole, Role, Values, all_names, everything, recognise, wanted,
};
use mms_results::{ARRAYS, Files, Snapshot, Stored, suggestion};
use mms_spec::own::Own;
use mms_spec::quantity::{Quantity, Shape};
use mms_spec::{FieldSpec, Space};

use super::extent::{self, Covered};
use super::files::{Results, placed, room};
use super::refit::Sample;
use super::snapshot_errors::SnapshotErrors;
use super::units;

/// The type number of a polygon in VTK.
const POLYGON: u8 = 7;

/// The points, cells or faces over which a norm is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Over points with equal weights; for an axisymmetric field weighted by their radii.
    Points,
    /// Over points, with given weights.
    Weighted,
    /// Over the body, by quadrature over cells.
    Cells,
    /// Over the middles of cells.
    Middles,
    /// Over the points of faces, with equal weights.
    Faces,
}

impl Sampling {
    /// Describes the norms, and why they are used.
    pub fn says(self) -> &'static str {
        match self {
            Sampling::Points => {
                "mean (l1), root mean square (l2) and maximum (linf) over points, without weights"
            }
            Sampling::Weighted => {
                "l1, l2 and linf over points, means with the weight of `--weight`"
            }
            Sampling::Cells => {
                "l1, l2 and linf over the body, and the seminorm of H1 where the gradient is known, by quadrature over \
                 cells, since the mesh is known"
            }
            Sampling::Faces => {
                "mean (l1), root mean square (l2) and maximum (linf) over the points of faces, each with its normal; values \
                 there may be more accurate than elsewhere (superconvergence)"
            }
            Sampling::Middles => {
                "l1, l2 and linf over the centres of cells, since each has one value; values there may be more \
                 accurate than elsewhere (superconvergence)"
            }
        }
    }

    /// The name in a document.
    pub fn name(self) -> &'static str {
        match self {
            Sampling::Points => "points",
            Sampling::Weighted => "weighted points",
            Sampling::Cells => "cells",
            Sampling::Middles => "middles of cells",
            Sampling::Faces => "points of faces",
        }
    }
}

/// The points or the cells over which norms are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// The points, with equal weights.
    Points,
    /// The cells, whose shape functions interpolate the values of their points.
    Cells,
}

impl Over {
    /// The value of this name.
    ///
    /// # Errors
    /// Another name.
    pub fn of(name: &str) -> Result<Self, String> {
        match name {
            "points" => Ok(Over::Points),
            "cells" => Ok(Over::Cells),
            _ => Err("expected points or cells".into()),
        }
    }
}

/// An error, and the part of it that rounding of the file alone may make.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measure {
    /// The error.
    pub error: f64,
    /// The largest error that rounding of the file alone may make.
    pub rounding_error: f64,
}

/// The errors of a quantity in one snapshot.
#[derive(Clone, Debug)]
pub struct Errors {
    /// The quantity.
    pub quantity: Quantity,
    /// The sampling of the norms.
    pub sampling: Sampling,
    /// The errors by the names of norms.
    pub norms: Vec<(&'static str, Measure)>,
    /// The power of ten by which the values exceed the exact ones, if they do by one.
    pub unit: Option<i32>,
    /// The precision of the stored values.
    pub stored: Stored,
    /// The largest exact number.
    pub largest: f64,
    /// For errors over cells, the root mean square over points.
    pub at_points: Option<f64>,
    /// The root mean square of the iterative error, if it is known.
    pub iterative: Option<f64>,
    /// The floor from the rounding of a time, and that time.
    pub of_time: [f64; 2],
    /// Whether a solver is given all values.
    pub is_input: bool,
    /// The place X of the largest error, and how far each coordinate may be from what was meant.
    pub largest_at: (Vec<f64>, f64),
}

/// The options for reading snapshots.
pub struct Reading<'a> {
    /// The names of arrays.
    pub names: &'a Names,
    /// The wanted quantities; empty for all.
    pub wanted: &'a [Quantity],
    /// The weights of points.
    pub weight: Option<Role>,
    /// The memory for reading a file, in MB; `None` for all that is free.
    pub memory: Option<u64>,
    /// The files that results are read from.
    pub files: &'a dyn Files,
    /// Whether a part of the body is enough.
    pub is_part: bool,
    /// Whether norms are over points or over cells; `None` for cells if there are any.
    pub over: Option<Over>,
}

/// The findings of a snapshot.
pub struct SnapshotFindings {
    /// Errors of quantities.
    pub errors: Vec<Errors>,
    /// The shortest and the longest of the longest edges of cells, if there are cells.
    pub sizes: Option<[f64; 2]>,
    /// The lowest degree of the cells, if there are cells.
    pub degree: Option<u32>,
    /// The imbalance of cells around inner edges, where it may lower an order.
    pub imbalance: Option<f64>,
    /// The part of the body that is covered, and the size of cells.
    pub covered: Covered,
    /// The type of cells with unknown shape functions, because of which norms are over points.
    pub unknown: Option<u8>,
    /// The source of X.
    pub how: String,
    /// u of some points.
    pub sample: Option<Sample>,
    /// Quantities that cannot be judged, and arrays that contain something else than their name says.
    pub passed_over: Vec<String>,
}

/// Parses the weight of means.
///
/// # Errors
/// A name other than volume or mass.
pub fn weight(text: &str) -> Result<Role, &'static str> {
    let role = Role::from_name(text).filter(|it| matches!(it, Role::Volume | Role::Mass));
    role.ok_or("expected volume or mass; `--map volume=NAME` says which column that is")
}

/// The error for a file with neither X nor x and u: lists its arrays, and the option that names the columns that may be X.
pub fn without_positions(
    whole: &Snapshot,
    dimension: usize,
    outside: &dyn Fn(&[f64]) -> f64,
) -> anyhow::Error {
    let option = suggestion::positions(whole, dimension, outside).map_or_else(
        || "name them with `--map X=..`; no columns lie in the body".into(),
        |it| format!("name them, as with {it}: these lie in the body"),
    );
    anyhow!(
        "{}: no positions found: expected X, or x and u; the file has {}; {option}",
        whole.path,
        all_names(whole)
    )
}

/// The letters of components in files of results of a field.
pub fn axes(field: &FieldSpec) -> Axes {
    match field.space {
        Space::Cartesian(_) => Axes::Cartesian,
        Space::Axisymmetric { swirl } => Axes::Axisymmetric { swirl },
    }
}

/// The field's own quantities, as roles of arrays.
pub fn own_roles(own: &[Own]) -> Vec<OwnRole> {
    let form = |own: &Own| match own.part.shape() {
        Shape::Scalar => Form::Scalar,
        Shape::Vector => Form::Vector,
        Shape::Tensor => Form::Tensor,
    };
    own.iter().map(|it| OwnRole { name: &it.described().name, form: form(it) }).collect()
}

/// The compiler's quantity of a role.
fn quantity(role: Role, exact: &Exact) -> Option<Quantity> {
    exact.input().compiled.quantity(role.name()).ok()
}

/// The numbers of a meaning, in the dimension of the field; for tensors in three dimensions if requested.
pub fn values<'a>(
    meaning: &Meaning,
    snapshot: &'a Snapshot,
    exact: &Exact,
) -> anyhow::Result<Values<'a>> {
    let is_place = matches!(meaning.role, Role::Reference | Role::Place | Role::Normal);
    let rows = match meaning.role.form() {
        Form::Tensor | Form::Symmetric => exact.rows(),
        Form::Vector if !is_place => exact.space().vector(),
        Form::Vector | Form::Scalar | Form::Voigt => exact.dimension,
    };
    meaning.values(snapshot, rows).map_err(placed)
}

impl Reading<'_> {
    /// Reads the needed content of a named file.
    ///
    /// # Errors
    /// The errors of [`Results::find`].
    pub fn find(&self, given: &str, exact: &Exact) -> anyhow::Result<Results> {
        let (room, advice) = room(self.memory, self.files);
        let wants = |role: Role| self.wants(role, exact);
        let wanted = wanted(self.names, &wants).within(room, advice);
        Results::find(given, &wanted, self.files)
    }

    /// Whether an array of that meaning is needed. `strain` is the small strain by name, or if the material has no other.
    fn wants(&self, role: Role, exact: &Exact) -> bool {
        let is_place =
            matches!(role, Role::Reference | Role::Position | Role::Place | Role::Displacement);
        let is_weight = matches!(role, Role::Volume | Role::Mass);
        if is_place || is_weight {
            return is_place || self.weight == Some(role);
        }
        let role = if role == Role::Normal { Role::Traction } else { role };
        if self.wanted.is_empty() {
            return role != Role::SmallStrain || exact.is_small_strain();
        }
        quantity(role, exact).is_some_and(|it| self.wanted.contains(&it))
    }

    /// Measures the errors of a snapshot at a time.
    ///
    /// # Errors
    /// A snapshot that cannot be measured, and where.
    pub fn measure(
        &self,
        snapshot: &Snapshot,
        time: f64,
        rounding: f64,
        exact: &mut Exact,
    ) -> anyhow::Result<SnapshotFindings> {
        let dimension = exact.dimension;
        let meanings = self.meanings(snapshot, exact)?;
        let motion = extent::motion(snapshot, &meanings, time, (exact, self.is_part))?;
        let cells = &snapshot.cells;
        let is_meridian = exact.space().is_axisymmetric();
        let mesh = Mesh { cells, points: &motion.reference.numbers, dimension, is_meridian };
        let sizes = mesh.sizes();
        let rounding_of_places = motion.reference.rounding;
        let covered = if sizes.is_some() {
            let scope = (&*exact, self.is_part);
            extent::of_cells(&mesh, scope, rounding_of_places, &snapshot.path)?
        } else {
            validate_distinct(snapshot, &motion.reference).map_err(placed)?;
            extent::of_points(mesh.points, exact, rounding_of_places)
        };
        let mut taken = SnapshotErrors {
            snapshot,
            mesh,
            is_mesh: sizes.is_some() && mesh.has_functions() && self.over != Some(Over::Points),
            motion: &motion,
            time,
            rounding,
            exact,
        };
        let mut errors = Vec::new();
        let mut passed_over = Vec::new();
        let weights = self.weights(snapshot, &meanings)?;
        let weights = weights.as_deref();
        if let Some(u) = motion.displacement.as_ref().filter(|_| self.wants_u()) {
            errors.push(taken.errors(Quantity::Displacement, u, weights)?);
        }
        for meaning in meanings.iter().filter(|it| self.is_judged(it, &motion)) {
            if let Some(why) = self.unlike(meaning, snapshot, &motion, taken.exact) {
                passed_over.push(why);
                continue;
            }
            // One quantity after the other: all at once would need as much memory as the file.
            match quantity(meaning.role, taken.exact) {
                Some(quantity) => {
                    let values = values(meaning, snapshot, taken.exact)?;
                    taken.validate_density(meaning, &values)?;
                    errors.push(taken.errors(quantity, &values, weights)?);
                }
                None => passed_over.push(meaning.role.name().into()),
            }
        }
        errors.extend(taken.tractions(&meanings)?);
        if errors.is_empty() && self.wanted.is_empty() {
            let whole = self.whole(snapshot)?;
            let known = recognise(&whole, self.names, &|role| self.wants(role, exact));
            let known = known.map_err(placed)?;
            let option = suggestion::quantity(&whole, dimension, Role::Displacement, &known);
            let option = option.unwrap_or_else(|| "`--map u=..`".into());
            bail!(
                "{}: no quantity found that can be judged: expected u, or x and X, or another one; the file has {}; name \
                 them, as with {option}",
                snapshot.path,
                all_names(&whole)
            );
        }
        let is_missing = |it: &&Quantity| errors.iter().all(|errors| errors.quantity != **it);
        if let Some(missing) = self.wanted.iter().find(is_missing) {
            bail!(
                "{}: no {} that can be judged, which `--quantity` names; name its columns with `--map {}=..`; the file has \
                 {}",
                snapshot.path,
                missing.name(),
                missing.symbol(),
                all_names(snapshot)
            );
        }
        let unknown = match mesh.has_functions() {
            true => mesh.unknown().filter(|_| sizes.is_none()),
            false => Some(POLYGON),
        };
        let degree = mesh.degree();
        let how = motion.how.clone();
        let sample = Sample::of(&motion, time, rounding, exact);
        let is_rate =
            |it: &Errors| matches!(it.quantity, Quantity::Velocity | Quantity::Acceleration);
        let is_asked = degree.is_some() && dimension > 1 && errors.iter().any(is_rate);
        let is_inner = |point: &[f64]| !exact.is_on_face(point, rounding_of_places);
        let imbalance = if is_asked { mesh.imbalance(&is_inner) } else { None };
        Ok(SnapshotFindings {
            errors,
            sizes,
            degree,
            imbalance,
            covered,
            unknown,
            how,
            sample,
            passed_over,
        })
    }

    /// All judged quantities of a snapshot, except tractions.
    ///
    /// # Errors
    /// A snapshot that cannot be read, and where.
    pub fn judged_quantities<'b>(
        &self,
        snapshot: &'b Snapshot,
        exact: &Exact,
    ) -> anyhow::Result<Vec<(Quantity, Values<'b>)>> {
        let meanings = self.meanings(snapshot, exact)?;
        let time = snapshot.time.map_or(exact.window[0], |time| time.value);
        let motion = extent::motion(snapshot, &meanings, time, (exact, self.is_part))?;
        let judged = meanings.iter().filter(|it| {
            self.is_judged(it, &motion) && self.unlike(it, snapshot, &motion, exact).is_none()
        });
        let judged: Vec<&Meaning> = judged.collect();
        let u = motion.displacement.filter(|_| self.wants_u());
        let mut all: Vec<_> = u.map(|u| (Quantity::Displacement, u)).into_iter().collect();
        for meaning in judged {
            let Some(quantity) = quantity(meaning.role, exact) else { continue };
            all.push((quantity, values(meaning, snapshot, exact)?));
        }
        Ok(all)
    }

    fn wants_u(&self) -> bool {
        self.wanted.is_empty() || self.wanted.contains(&Quantity::Displacement)
    }

    /// The reason why an array is not the quantity that its name says; `None` if it may be, or if the user asks for the
    /// quantity or for all nine components.
    pub(super) fn unlike(
        &self,
        meaning: &Meaning,
        snapshot: &Snapshot,
        motion: &Motion<'_>,
        exact: &Exact,
    ) -> Option<String> {
        let points = motion.reference.numbers.len() / motion.reference.components;
        let (rows, own) = (exact.rows(), exact.space());
        let (dimension, in_space) = match meaning.role.form() {
            Form::Tensor | Form::Symmetric => (rows, rows != own.rows()),
            Form::Vector => (own.vector(), false),
            Form::Scalar | Form::Voigt => (exact.dimension, false),
        };
        let is_asked = in_space || self.wanted.iter().any(|it| it.name() == meaning.role.name());
        let why = meaning.mismatch(snapshot, dimension, Some(points));
        why.filter(|_| !is_asked)
    }

    /// The meanings of arrays, including positions.
    ///
    /// # Errors
    /// A name that may mean two quantities, or no positions, with the columns that may be X.
    pub(super) fn meanings(
        &self,
        snapshot: &Snapshot,
        exact: &Exact,
    ) -> anyhow::Result<Vec<Meaning>> {
        let found = recognise(snapshot, self.names, &|role| self.wants(role, exact));
        let found = found.map_err(placed)?;
        let is_place =
            |it: &Meaning| matches!(it.role, Role::Reference | Role::Position | Role::Place);
        if found.iter().any(is_place) {
            units::validate(snapshot, &found, exact)?;
            return Ok(found);
        }
        let outside = |point: &[f64]| exact.body.distance(point);
        Err(without_positions(&self.whole(snapshot)?, exact.dimension, &outside))
    }

    /// Reads the snapshot with all its arrays, including those with unknown names.
    fn whole(&self, snapshot: &Snapshot) -> anyhow::Result<Snapshot> {
        if snapshot.format == ARRAYS {
            return Ok(Snapshot { points: None, ..snapshot.clone() });
        }
        let (room, advice) = room(self.memory, self.files);
        let wanted = everything(self.names).within(room, advice);
        let found = Results::find(&snapshot.path, &wanted, self.files)?;
        let time = snapshot.time.map(|it| it.value);
        let mut found = found.snapshots.into_iter();
        let first = found.next();
        let same = found.find(|it| it.time.map(|it| it.value) == time);
        same.or(first).ok_or_else(|| anyhow!("{}: no results", snapshot.path))
    }

    /// Whether an array of that meaning is judged by itself: u only if it is not judged with the motion of points, x only if
    /// requested, and tractions not here but on faces.
    fn is_judged(&self, meaning: &Meaning, motion: &Motion<'_>) -> bool {
        match meaning.role {
            Role::Displacement => motion.displacement.is_none() && self.wants_u(),
            Role::Reference | Role::Place | Role::Volume | Role::Mass => false,
            Role::Traction | Role::Normal => false,
            Role::Position => !motion.is_inverse && self.wanted.contains(&Quantity::Position),
            _ => true,
        }
    }

    fn weights(
        &self,
        snapshot: &Snapshot,
        meanings: &[Meaning],
    ) -> anyhow::Result<Option<Vec<f64>>> {
        let Some(role) = self.weight else { return Ok(None) };
        let meaning = meanings.iter().find(|it| it.role == role).ok_or_else(|| {
            anyhow!(
                "{}: `--weight {name}`: no such column; name it with `--map {name}=..`",
                snapshot.path,
                name = role.name()
            )
        })?;
        let weights = meaning.values(snapshot, 1).map_err(placed)?;
        if let Some(at) = weights.numbers.iter().position(|it| *it < 0.0) {
            bail!(
                "{}: {} is {}; expected a weight of 0 or more",
                snapshot.place(at),
                role.name(),
                weights.numbers[at]
            );
        }
        Ok(Some(weights.numbers.into_owned()))
    }
}
