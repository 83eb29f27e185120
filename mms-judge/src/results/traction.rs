//! The errors of tractions at points of faces, by their normals.

use anyhow::{anyhow, bail, ensure};
use mms_results::Stored;
use mms_results::names::{Meaning, Role, Values};
use mms_spec::Face;
use mms_spec::quantity::Quantity;

use super::files::placed;
use super::level::{Errors, Sampling};
use super::snapshot_errors::{SnapshotErrors, Solution};

/// The largest difference between the length of a normal and 1.
const UNIT: f64 = 1e-3;

/// Points of faces with their normals and computed tractions.
#[derive(Default)]
struct Loaded {
    places: Vec<f64>,
    normals: Vec<f64>,
    tractions: Vec<f64>,
    rounding: f64,
    stored: Option<Stored>,
}

impl Loaded {
    /// Adds rows of values, each with its normal.
    fn add(&mut self, places: &[f64], values: &Values<'_>, rows: &[usize], normals: &[f64]) {
        let (size, dimension) =
            (values.components, places.len() * values.components / values.numbers.len());
        for &row in rows {
            self.places.extend(&places[row * dimension..][..dimension]);
            self.tractions.extend(&values.numbers[row * size..][..size]);
        }
        self.normals.extend(normals);
        self.rounding = self.rounding.max(values.rounding);
        let coarser = |it: Stored| {
            if it.rounding(1.0) > values.stored.rounding(1.0) { it } else { values.stored }
        };
        self.stored = Some(self.stored.map_or(values.stored, coarser));
    }
}

impl SnapshotErrors<'_> {
    /// The errors of tractions, if there are any: tractions of a named face at its points; others by the normals beside them,
    /// or at the points that lie on one face alone.
    ///
    /// # Errors
    /// A face that the body does not have, or without points; normals that are not unit vectors.
    pub fn tractions(&mut self, meanings: &[Meaning]) -> anyhow::Result<Option<Errors>> {
        let mut loaded = Loaded::default();
        for meaning in meanings.iter().filter(|it| it.role == Role::Traction) {
            let values = self.of_points(meaning, self.exact.space().vector())?;
            let normal = meanings.iter().find(|it| it.role == Role::Normal);
            match (meaning.face, normal) {
                (Some(face), _) => self.of_face(face, &values, &mut loaded)?,
                (None, Some(normal)) => {
                    let normals = self.of_points(normal, self.mesh.dimension)?;
                    self.of_normals(&values, &normals, &mut loaded)?;
                }
                (None, None) => self.of_faces(&values, &mut loaded)?,
            }
        }
        let Loaded { places, normals, tractions, rounding, stored } = loaded;
        let Some(stored) = stored else { return Ok(None) };
        let (components, dimension) = (self.exact.space().vector(), self.mesh.dimension);
        let values =
            Values { numbers: tractions.into(), components, rounding, stored, is_of_cells: false };
        let solution: Solution<'_> = &|exact, time, first, places| {
            exact.by_normals(Quantity::Traction, &normals[first * dimension..], time, places)
        };
        let radii = self.exact.radii(&places);
        let compared =
            self.compared(Quantity::Traction, (&values, radii.as_deref()), &places, solution)?;
        let values = (&values, places.as_slice());
        self.over_points(Quantity::Traction, values, Sampling::Faces, &compared).map(Some)
    }

    /// A vector with `components` components at each point.
    fn of_points(&self, meaning: &Meaning, components: usize) -> anyhow::Result<Values<'_>> {
        let values = meaning.values(self.snapshot, components).map_err(placed)?;
        let rows = values.numbers.len() / components;
        let points = self.mesh.points.len() / self.mesh.dimension;
        ensure!(
            !values.is_of_cells && rows == points,
            "{}: `{}`: expected a vector for each point",
            self.snapshot.path,
            meaning.source
        );
        Ok(values)
    }

    fn of_face(&self, name: &str, values: &Values<'_>, loaded: &mut Loaded) -> anyhow::Result<()> {
        let faces = self.exact.faces(self.mesh.points, self.motion.reference.rounding);
        let found = faces.into_iter().find(|(face, _)| face.name() == name);
        let (face, rows) = found.ok_or_else(|| {
            anyhow!("{}: `traction_{name}`: no point lies on such a face", self.snapshot.path)
        })?;
        self.add_face(face, &rows, values, loaded);
        Ok(())
    }

    fn add_face(&self, face: Face, rows: &[usize], values: &Values<'_>, loaded: &mut Loaded) {
        let (points, size) = (self.mesh.points, self.mesh.dimension);
        let places: Vec<f64> =
            rows.iter().flat_map(|row| &points[row * size..][..size]).copied().collect();
        loaded.add(points, values, rows, &self.exact.normals(face, &places));
    }

    /// Adds tractions at points where the normal is not 0.
    fn of_normals(
        &self,
        values: &Values<'_>,
        normals: &Values<'_>,
        loaded: &mut Loaded,
    ) -> anyhow::Result<()> {
        let mut rows = Vec::new();
        let mut units = Vec::new();
        for (row, normal) in normals.numbers.chunks(normals.components).enumerate() {
            let length = normal.iter().map(|it| it * it).sum::<f64>().sqrt();
            if length == 0.0 {
                continue;
            }
            if (length - 1.0).abs() > UNIT {
                bail!(
                    "{}: the normal has a length of {length}; expected a unit normal, or 0 where no face is",
                    self.snapshot.place(row)
                );
            }
            rows.push(row);
            units.extend(normal.iter().map(|it| it / length));
        }
        ensure!(!rows.is_empty(), "{}: all normals are 0", self.snapshot.path);
        loaded.add(self.mesh.points, values, &rows, &units);
        Ok(())
    }

    /// Adds tractions at points of one face alone, because points of two faces have two tractions.
    fn of_faces(&self, values: &Values<'_>, loaded: &mut Loaded) -> anyhow::Result<()> {
        let faces = self.exact.faces(self.mesh.points, self.motion.reference.rounding);
        let mut count = vec![0; self.mesh.points.len() / self.mesh.dimension];
        faces.iter().flat_map(|(_, rows)| rows).for_each(|&row| count[row] += 1);
        for (face, rows) in faces {
            let alone: Vec<usize> = rows.into_iter().filter(|&row| count[row] == 1).collect();
            self.add_face(face, &alone, values, loaded);
        }
        ensure!(
            !loaded.places.is_empty(),
            "{}: `traction`: no point lies on one face alone; name the face, as in `traction_x_max`, or give unit normals N",
            self.snapshot.path
        );
        Ok(())
    }
}
