//! The exact solution at many points.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::LazyLock;

use anyhow::ensure;
use dashu_ratio::RBig;
use mms_analysis::inverse_motion::{Inverse, Unplaced};
use mms_interpreted::AtPoints;
use mms_mechanics::extent::Extent;
use mms_mechanics::invariant::InvariantKind;
use mms_mechanics::sample::domain;
use mms_mechanics::{Output, Response};
use mms_runtime::scene::Scene;
use mms_spec::quantity::{Quantity, Shape};
use mms_spec::{Claim, Face, Space};
use mms_symbolic::sorted::SortedMap;

use crate::Input;
use crate::plane::{Beyond, NEEDED, SPACE, nine};

/// The part of the time window by which two equal times may differ, because sums of time steps round.
pub const SAME: f64 = 1e-9;

/// The largest distance of a point beyond the body, as a part of the distance between points.
const BEYOND: f64 = 1.0 / 32.0;

/// A field with numbers for its parameters.
pub struct Exact {
    input: Input,
    /// Parameters that were set, by position.
    set_parameters: SortedMap<usize, RBig>,
    parameters: Vec<f64>,
    /// The coordinates of a point.
    pub dimension: usize,
    /// The time window of the field.
    pub window: [f64; 2],
    /// The body of the field.
    pub body: Extent<f64>,
    /// The number of rows of tensors: one per coordinate of the field, or three.
    tensors: usize,
    prepared: BTreeMap<Output, AtPoints>,
}

impl Exact {
    /// The solution of a field with `name=value` settings.
    ///
    /// # Errors
    /// Settings that it does not have.
    pub fn new(input: Input, settings: &[String]) -> anyhow::Result<Exact> {
        input.validate_settings(settings)?;
        input.validate_body("there is nothing that states and results could fill")?;
        let set = input.settings(settings)?;
        let parameters = input.compiled.parameters::<f64>(&set);
        let (body, window) = domain(&input.compiled.program, &parameters);
        let dimension = input.compiled.field.dimension;
        let (tensors, prepared) = (input.compiled.field.space.rows(), BTreeMap::new());
        Ok(Exact {
            input,
            set_parameters: set,
            parameters,
            dimension,
            window,
            body,
            tensors,
            prepared,
        })
    }

    /// The parameters that are set, by position.
    pub fn set_parameters(&self) -> &SortedMap<usize, RBig> {
        &self.set_parameters
    }

    /// The values of all parameters, in the order of the file.
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// The field with another value of the parameter at a position, over the same body and time window; `None` if the value is
    /// not finite.
    pub fn with_parameter(&self, at: usize, value: f64) -> Option<Exact> {
        let mut set = self.set_parameters.clone();
        set.insert(at, RBig::try_from(value).ok()?);
        let parameters = self.input.compiled.parameters::<f64>(&set);
        Some(Exact { set_parameters: set, parameters, ..self.unprepared() })
    }

    /// The field, with nothing prepared.
    pub fn unprepared(&self) -> Exact {
        Exact {
            input: self.input.clone(),
            set_parameters: self.set_parameters.clone(),
            parameters: self.parameters.clone(),
            body: self.body.clone(),
            prepared: BTreeMap::new(),
            ..*self
        }
    }

    /// The field for the solver.
    ///
    /// # Errors
    /// A field that is out of step with its file.
    pub fn scene(&self) -> anyhow::Result<Scene<f64>> {
        self.input.scene_with(&self.set_parameters, |code| code.double)
    }

    /// The solution, whose tensors have all nine components if `is_asked`.
    pub fn in_space_if(self, is_asked: bool) -> Self {
        let tensors = if is_asked { SPACE } else { self.tensors };
        Exact { tensors, ..self }
    }

    /// Rows of tensors.
    pub fn rows(&self) -> usize {
        self.tensors
    }

    /// The coordinates that the field is written in.
    pub fn space(&self) -> Space {
        self.input.compiled.field.space
    }

    /// Whether points also move along the hoop, and leave their meridian.
    pub fn has_swirl(&self) -> bool {
        self.space() == Space::Axisymmetric { swirl: true }
    }

    /// The factor by which each point counts in a mean over the body: its radius, if points represent rings. `None` if all
    /// count alike.
    pub fn radii(&self, points: &[f64]) -> Option<Vec<f64>> {
        let is_ring = self.space().is_axisymmetric();
        is_ring.then(|| points.chunks(self.dimension).map(|point| point[0]).collect())
    }

    /// The field.
    pub fn input(&self) -> &Input {
        &self.input
    }

    /// The edge of the cube (square, length) that each of `points` points has of the body.
    pub fn spacing(&self, points: usize) -> f64 {
        (self.body.measure() / points as f64).powf(1.0 / self.dimension as f64)
    }

    /// X of the point that is at x at a time, by the inverse of the motion: `None` if no point of the body is there. A point
    /// may be beyond the body by a small part of the distance between `points` points, and is then moved to its boundary.
    pub fn inverse(
        &self,
        time: f64,
        points: usize,
    ) -> impl FnMut(&[f64], f64) -> Result<Option<Vec<f64>>, String> + '_ {
        let near = self.spacing(points.max(1)) * BEYOND;
        let mut inverse = None;
        move |x, rounding| {
            if self.has_swirl() {
                return Err(TURNS.into());
            }
            let inverse: &mut Inverse<'_> = inverse.get_or_insert_with(|| {
                Inverse::new(&self.input.compiled, &self.set_parameters, time)
            });
            match inverse.reference(x, rounding.max(near)) {
                Ok(found) => Ok(Some(found)),
                Err(Unplaced::Outside) => Ok(None),
                Err(why) => Err(says(&why)),
            }
        }
    }

    /// The name and the title of the field, for a person.
    pub fn title(&self) -> String {
        format!("{}: {}", self.input.name.shown(), self.input.compiled.field.title.shown())
    }

    /// Whether the material is of small strain, with one stress and one configuration.
    pub fn is_small_strain(&self) -> bool {
        self.input.compiled.model.kind == InvariantKind::SmallStrain
    }

    /// The number of components of a quantity at a point.
    pub fn components(&self, quantity: Quantity) -> usize {
        match quantity.shape() {
            Shape::Tensor => self.tensors * self.tensors,
            shape => self.input.compiled.field.space.components(shape),
        }
    }

    /// A quantity at points X, whose coordinates follow one after the other.
    ///
    /// # Errors
    /// A quantity on request that is too large to derive.
    pub fn values(
        &mut self,
        quantity: Quantity,
        time: f64,
        points: &[f64],
    ) -> anyhow::Result<Vec<f64>> {
        let own = self.values_in_dimension(quantity, time, points)?;
        match Beyond::of(quantity, &self.input.compiled.model.kind)
            .filter(|_| self.tensors > self.space().rows())
        {
            Some(beyond) => self.with_all_components(&own, beyond, time, points),
            None => Ok(own),
        }
    }

    /// A quantity with the components that the field has, at points X.
    ///
    /// # Errors
    /// The errors of [`values`](Self::values).
    pub fn values_in_dimension(
        &mut self,
        quantity: Quantity,
        time: f64,
        points: &[f64],
    ) -> anyhow::Result<Vec<f64>> {
        let components = self.input.compiled.field.space.components(quantity.shape());
        self.output(Output::Quantity(quantity), components, time, [points, &[]])
    }

    /// Tensors with the components beyond the dimension of the field.
    fn with_all_components(
        &mut self,
        own: &[f64],
        beyond: Beyond,
        time: f64,
        points: &[f64],
    ) -> anyhow::Result<Vec<f64>> {
        let (dimension, count) = (self.dimension, points.len() / self.dimension);
        let size = dimension * dimension;
        let of = match beyond.is_stress() {
            true => NEEDED.map(|it| self.values_in_dimension(it, time, points)),
            false => [Ok(vec![0.0; count * size]), Ok(vec![0.0; count]), Ok(vec![0.0; count])],
        };
        let [stress, pressure, jacobian] = of;
        let (stress, pressure, jacobian) = (stress?, pressure?, jacobian?);
        let point = |at: usize| {
            let value = beyond.value(&stress[at * size..][..size], &pressure[at], &jacobian[at]);
            nine(&own[at * size..][..size], dimension, &value)
        };
        Ok((0..count).flat_map(point).collect())
    }

    /// rho0 at points X.
    ///
    /// # Errors
    /// The errors of [`values`](Self::values).
    pub fn densities(&mut self, points: &[f64]) -> anyhow::Result<Vec<f64>> {
        let time = self.window[0];
        self.output(Output::Response(Response::Density), 1, time, [points, &[]])
    }

    /// A quantity that takes a normal, on a face at points X of it.
    ///
    /// # Errors
    /// The errors of [`values`](Self::values).
    pub fn on_face(
        &mut self,
        quantity: Quantity,
        face: Face,
        time: f64,
        points: &[f64],
    ) -> anyhow::Result<Vec<f64>> {
        let normals = self.normals(face, points);
        self.by_normals(quantity, &normals, time, points)
    }

    /// Whether nothing has happened yet at some times: they are the first one, and not all times are alike.
    ///
    /// # Errors
    /// The errors of [`values`](Self::values).
    pub fn is_start(&mut self, times: &[f64]) -> anyhow::Result<bool> {
        let [first, last] = self.window;
        if times.iter().any(|time| (time - first).abs() > SAME * (last - first)) {
            return Ok(false);
        }
        let along = [0.125, 0.5, 0.75];
        let places: Vec<f64> = along.iter().flat_map(|&it| self.body.point(&[it; 3])).collect();
        let mut at = |time| self.values(Quantity::Displacement, time, &places);
        let begun = first + 0.375 * (last - first);
        Ok(at(first)? != at(begun)? || at(first)? != at(last)?)
    }

    /// The outward unit normals of a face at points X of it.
    pub fn normals(&self, face: Face, points: &[f64]) -> Vec<f64> {
        let points = points.chunks(self.dimension);
        self.input.compiled.normals(face, &self.parameters, points).concat()
    }

    /// A quantity that takes a normal at points X, by the unit normals there.
    ///
    /// # Errors
    /// The errors of [`values`](Self::values).
    pub fn by_normals(
        &mut self,
        quantity: Quantity,
        normals: &[f64],
        time: f64,
        points: &[f64],
    ) -> anyhow::Result<Vec<f64>> {
        let components = self.input.compiled.field.space.components(quantity.shape());
        self.output(Output::Quantity(quantity), components, time, [points, normals])
    }

    /// The points on each face that has any, by position; `rounding` is the largest error of a coordinate.
    pub fn faces(&self, points: &[f64], rounding: f64) -> Vec<(Face, Vec<usize>)> {
        let (dimension, near) = (self.dimension, near(points, rounding));
        let on = |face: &Face| -> Vec<usize> {
            let points = points.chunks(dimension).enumerate();
            let is_on = |point: &[f64]| self.body.distance_to(*face, point) <= near;
            points.filter(|(_, point)| is_on(point)).map(|(at, _)| at).collect()
        };
        let field = &self.input.compiled.field;
        let faces = Face::of(&field.domain.body, field.space).into_iter();
        faces.map(|face| (face, on(&face))).filter(|(_, points)| !points.is_empty()).collect()
    }

    /// The distances of a point to the faces.
    pub fn distances_to_faces(&self, point: &[f64]) -> Vec<(Face, f64)> {
        let field = &self.input.compiled.field;
        let faces = Face::of(&field.domain.body, field.space).into_iter();
        let distances = faces.map(|face| (face, self.body.distance_to(face, point)));
        distances.filter(|it| it.1.is_finite()).collect()
    }

    /// The largest distance to a face of a point that lies on it; how far each coordinate may be from what was meant.
    pub fn rounding_of_faces(&self, point: &[f64], rounding: f64) -> f64 {
        near(point, rounding)
    }

    /// The part of the neighbourhood of each point that lies in the body: half of it on a face, a quarter on an edge.
    pub fn neighbourhoods(&self, points: &[f64], rounding: f64) -> Vec<f64> {
        let mut parts = vec![1.0; points.len() / self.dimension];
        let rows = self.faces(points, rounding).into_iter().flat_map(|(_, rows)| rows);
        rows.for_each(|row| parts[row] /= 2.0);
        parts
    }

    /// Whether a point lies on a face; `rounding` is the largest error of a coordinate.
    pub fn is_on_face(&self, point: &[f64], rounding: f64) -> bool {
        let near = near(point, rounding);
        let field = &self.input.compiled.field;
        let faces = Face::of(&field.domain.body, field.space);
        faces.into_iter().any(|face| self.body.distance_to(face, point) <= near)
    }

    /// Whether all points lie on faces with one of these claims; `rounding` is the largest error of a coordinate.
    pub fn are_on(&self, claims: &[Claim], points: &[f64], rounding: f64) -> bool {
        let near = near(points, rounding);
        let boundary = self.input.compiled.field.boundary.iter();
        let faces = boundary.filter(|it| claims.contains(&it.claim.value)).map(|it| it.face.value);
        let faces: Vec<Face> = faces.collect();
        let is_on =
            |point: &[f64]| faces.iter().any(|it| self.body.distance_to(*it, point) <= near);
        points.chunks(self.dimension).all(is_on)
    }

    fn output(
        &mut self,
        output: Output,
        components: usize,
        time: f64,
        places: [&[f64]; 2],
    ) -> anyhow::Result<Vec<f64>> {
        ensure!(!self.input.options().stop.is_asked(), "stopped on request");
        let prepared = match self.prepared.entry(output) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => place.insert(prepared(&self.input, &self.parameters, output)?),
        };
        Ok(prepared.values(components, time, self.dimension, places, *THREADS))
    }
}

/// The number of threads that run at the same time here. In a container the system reads it from files, too slowly for each point.
static THREADS: LazyLock<usize> =
    LazyLock::new(|| std::thread::available_parallelism().map_or(1, usize::from));

/// The reason why X of a point is not known.
pub fn says(why: &Unplaced) -> String {
    match why {
        Unplaced::Outside => "no point of the body is there at that time".into(),
        Unplaced::Several([one, other]) => format!(
            "two points of the body are there, X = {one:?} and X = {other:?}: the motion passes through itself"
        ),
        Unplaced::Undecided(near) => format!(
            "it is not decided whether a point near X = {near:?} is there, for bounds of the motion are too wide"
        ),
    }
}

/// The reason why x of a field with a swirl does not determine X.
pub const TURNS: &str =
    "points of the body move along the hoop, and R and Z of x do not tell which of them is there";

/// The largest distance from a face of points that are on it.
fn near(points: &[f64], rounding: f64) -> f64 {
    let size = points.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
    4.0 * rounding + 8.0 * f64::EPSILON * size
}

fn prepared(input: &Input, parameters: &[f64], output: Output) -> anyhow::Result<AtPoints> {
    let own = match output {
        Output::Quantity(quantity) => input.on_request(quantity)?,
        _ => None,
    };
    let program = own.as_ref().unwrap_or(&input.compiled.program);
    Ok(AtPoints::new(program, output, parameters))
}
