//! States of a run that `mms run --vtk` wrote: particles where they are, coloured by their error.

use std::path::Path;

use anyhow::{Context as _, ensure};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, html};
use mms_files::read::{self, FileKind};
use roxmltree::Document;

use super::picture::{Moment, PaintedShape, Scale, pictures, project};
use super::{Section, Verdicts};

/// The heading above all states.
pub const HEADING: &str = "States of runs";

/// The largest number of states on a page.
const MOMENTS: usize = 6;

/// The largest number of particles in a picture; if there are more, every second, third, ... is drawn.
const PARTICLES: usize = 1000;

/// The least error that has a colour of its own, as a share of the largest.
const LEAST: f64 = 1e-4;

/// The largest number that is drawn: lengths computed from such numbers are finite.
const LARGEST: f64 = 1e150;

/// States of a run.
pub struct States {
    name: String,
    /// The number of states; some are drawn.
    count: usize,
    drawn: Vec<State>,
}

struct State {
    time: f64,
    /// The position of each particle, and its distance from the exact position.
    particles: Vec<([f64; 3], f64)>,
}

impl States {
    /// The states that a list names.
    ///
    /// # Errors
    /// A file that is not as `mms run --vtk` writes it, by its name.
    pub fn read(path: &Path, text: &str) -> anyhow::Result<Self> {
        let list = Document::parse(text).context("not XML")?;
        let named: Option<Vec<_>> = list
            .descendants()
            .filter(|node| node.has_tag_name("DataSet"))
            .map(|node| {
                let time: f64 = node.attribute("timestep")?.parse().ok()?;
                Some((time, node.attribute("file")?)).filter(|_| time.is_finite())
            })
            .collect();
        let named: Vec<(f64, &str)> = named.context("a state without a time or a file")?;
        ensure!(!named.is_empty(), "no states in it");
        let last = named.len() - 1;
        let mut wanted: Vec<_> = (0..MOMENTS).map(|at| at * last / (MOMENTS - 1)).collect();
        wanted.dedup();
        let read = |at: usize| {
            let (time, file) = named[at];
            ensure!(is_beside(file), "`{file}` is no name of a file beside it");
            let path = path.with_file_name(file);
            let particles = particles(&path).with_context(|| file.to_owned())?;
            Ok(State { time, particles })
        };
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let drawn = wanted.into_iter().map(read).collect::<anyhow::Result<_>>()?;
        Ok(Self { name, count: named.len(), drawn })
    }

    /// The number of axes along which the body extends.
    fn dimension(&self) -> usize {
        let is_used = |axis: usize| {
            self.drawn.iter().flat_map(|it| &it.particles).any(|(place, _)| place[axis] != 0.0)
        };
        (1..3).rev().find(|axis| is_used(*axis)).map_or(1, |axis| axis + 1)
    }

    /// The size of dots that hardly touch: the median of the distances to the nearest neighbour in the first state.
    fn spacing(&self, step: usize) -> f64 {
        let first = self.drawn.first().map_or(&[][..], |state| &state.particles);
        let places: Vec<[f64; 3]> = first.iter().step_by(step).map(|it| it.0).collect();
        let distance =
            |a: &[f64; 3], b: &[f64; 3]| (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2]);
        let nearest = |(at, place): (usize, &[f64; 3])| {
            let others = places.iter().enumerate().filter(|(other, _)| *other != at);
            others.map(|(_, other)| distance(place, other)).fold(f64::INFINITY, f64::min)
        };
        let mut nearest: Vec<_> = places.iter().enumerate().map(nearest).collect();
        nearest.sort_by(f64::total_cmp);
        nearest.get(nearest.len() / 2).copied().filter(|it| it.is_finite()).unwrap_or_default()
    }
}

/// Whether a name leads to a file beside this one.
fn is_beside(file: &str) -> bool {
    Path::new(file).file_name().is_some_and(|name| name == file)
}

/// The particles of a state.
fn particles(path: &Path) -> anyhow::Result<Vec<([f64; 3], f64)>> {
    let bytes = read::bytes(path, FileKind::State).context("cannot read it")?;
    let text = String::from_utf8(bytes).context("not text")?;
    let document = Document::parse(&text).context("not XML")?;
    let [place, error] = ["position", "displacement_error"].map(|name| vectors(&document, name));
    let (place, error) = (place?, error?);
    ensure!(place.len() == error.len(), "not as many errors as particles");
    let norm = |[x, y, z]: [f64; 3]| x.hypot(y).hypot(z);
    Ok(place.into_iter().zip(error.into_iter().map(norm)).collect())
}

/// An array of vectors, preceded by its byte count.
fn vectors(document: &Document, name: &str) -> anyhow::Result<Vec<[f64; 3]>> {
    let array = document.descendants().find(|node| node.attribute("Name") == Some(name));
    let text = array.and_then(|array| array.text()).with_context(|| format!("no `{name}`"))?;
    let bytes = STANDARD.decode(text.trim()).with_context(|| format!("`{name}`: not base64"))?;
    let (count, bytes) = bytes.split_first_chunk::<8>().unwrap_or((&[0; 8], &[]));
    let is_whole = u64::from_le_bytes(*count) == bytes.len() as u64 && bytes.len() % 24 == 0;
    ensure!(is_whole, "`{name}`: incomplete");
    let numbers: Vec<_> =
        bytes.as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
    let is_drawn = |it: &f64| it.abs() <= LARGEST;
    ensure!(numbers.iter().all(is_drawn), "`{name}`: not finite, or too large to be drawn");
    Ok(numbers.as_chunks::<3>().0.to_vec())
}

impl Section for States {
    fn title(&self) -> String {
        format!("{}: {} states", self.name, self.count)
    }

    fn verdicts(&self) -> Verdicts {
        Verdicts { word: "not judged".into(), ..Verdicts::default() }
    }

    fn body(&self, id: &str) -> Markup {
        let errors = || self.drawn.iter().flat_map(|it| it.particles.iter().map(|it| it.1));
        let largest = errors().fold(0.0, f64::max);
        let least = errors().fold(f64::INFINITY, f64::min).max(LEAST * largest);
        // If all errors are equal, or there are none, there is no logarithmic range to divide into colours.
        let range =
            if least < largest { [least, largest] } else { [0.0, largest.max(f64::MIN_POSITIVE)] };
        let scale = Scale { name: "error of u".into(), range, is_logarithmic: least < largest };
        let dimension = self.dimension();
        let count = self.drawn.iter().map(|it| it.particles.len()).max().unwrap_or(0);
        let step = count.div_ceil(PARTICLES).max(1);
        let moments: Vec<_> =
            self.drawn.iter().map(|state| moment(state, dimension, step, &scale)).collect();
        html! {
            figure {
                (pictures(id, &format!("Particles of {}", self.name), &moments, &scale, self.spacing(step), &[]))
                figcaption {
                    "Particles of a run at their positions, coloured by the distance from the exact positions."
                    @if step > 1 { " One of " (step) " is drawn." }
                    @if dimension == 3 { " Seen from X = Y = Z; particles in front hide particles behind." }
                }
            }
        }
    }
}

fn moment(state: &State, dimension: usize, step: usize, scale: &Scale) -> Moment {
    let mut particles: Vec<_> = state.particles.iter().step_by(step).collect();
    if dimension == 3 {
        let depth = |place: &[f64; 3]| place.iter().sum::<f64>();
        particles.sort_by(|(a, _), (b, _)| depth(a).total_cmp(&depth(b)));
    } else {
        // Neighbours of one colour share an element.
        particles.sort_by_key(|(_, error)| scale.step(*error));
    }
    let shape = |(place, error): &([f64; 3], f64)| PaintedShape {
        corners: vec![project(&place[..dimension])],
        step: scale.step(*error),
    };
    let shapes = particles.into_iter().map(shape).collect();
    Moment { time: state.time, shapes, outline: Vec::new() }
}
