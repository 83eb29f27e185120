//! X and u of points: two of X, x and u determine the third.

use crate::meaning::here;
use crate::names::{Meaning, Role, Values, all_names};
use crate::norm::{largest, range};
use crate::{Mistake, Snapshot, Stored};

/// The number of leading bits that distinguish most digests.
const START: u32 = 20;

/// The points of a snapshot, in the reference configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion<'a> {
    /// X.
    pub reference: Values<'a>,
    /// u, if two of the three are known.
    pub displacement: Option<Values<'a>>,
    /// The source of X.
    pub how: String,
    /// Whether X follows from the exact motion: then x and u do not test a solver.
    pub is_inverse: bool,
}

/// The body in the reference configuration.
pub trait ReferenceBody {
    /// The distance of a point from the body; 0 within it.
    fn distance(&self, point: &[f64]) -> f64;

    /// Whether points, or the cells between them, are known to fill the body.
    fn is_filled(&self, _points: &[f64]) -> bool {
        false
    }
}

impl<F: Fn(&[f64]) -> f64> ReferenceBody for F {
    fn distance(&self, point: &[f64]) -> f64 {
        self(point)
    }
}

/// Finds X of the material at x, whose coordinates have this rounding; `None` if no point of the body is there.
pub type Back<'a> = &'a mut dyn FnMut(&[f64], f64) -> Result<Option<Vec<f64>>, String>;

/// Finds X and u. For points that may be X or x it tries both, and uses the only reading with which they lie in the body. If x
/// is known without u, `back` finds X by the inverse of the exact motion; without `back` points alone are X.
///
/// # Errors
/// Too little for X; points with which both readings lie in the body; an x that contradicts X and u; a point outside the body
/// by more than its rounding.
pub fn resolve<'a>(
    snapshot: &'a Snapshot,
    meanings: &[Meaning],
    dimension: usize,
    body: &dyn ReferenceBody,
    back: Option<Back<'_>>,
) -> Result<Motion<'a>, Mistake> {
    let of = |role: Role| meanings.iter().find(|meaning| meaning.role == role);
    let of_size = |role: Role, size: usize| {
        of(role).map(|meaning| meaning.values(snapshot, size)).transpose()
    };
    let values = |role: Role| of_size(role, dimension);
    let vector = meanings.first().map_or(dimension, |it| it.axes.of_vectors(dimension));
    // A rotating body has another meridian at x: only X identifies its points.
    let turns = vector > dimension;
    let reference = values(Role::Reference)?;
    let is_read = !turns || reference.is_none();
    let mut known = Known {
        snapshot,
        place_name: of(Role::Place).map(|it| it.mapping(snapshot, dimension)).unwrap_or_default(),
        is_called_x: of(Role::Place).is_some_and(|it| it.source == "x"),
        reading: of(Role::Place).and_then(|it| it.reading.clone()),
        reference,
        position: if turns { None } else { values(Role::Position)? },
        place: if is_read { values(Role::Place)? } else { None },
        displacement: of_size(Role::Displacement, vector)?.filter(|it| !it.is_of_cells),
    };
    if turns {
        return known.resolve_with_swirl(body);
    }
    known.validate_rows().map_err(|mistake| mistake.of(&snapshot.path))?;
    known.is_called_x &= known.reference.is_some();
    let given = (known.reference.take(), known.displacement.take());
    let motion = known.motion(given, body, back).map_err(|mistake| mistake.of(&snapshot.path))?;
    known.validate_agreement(&motion)?;
    if !motion.is_inverse {
        validate_inside(snapshot, &motion, body)?;
    }
    Ok(motion)
}

/// The known data of the points.
struct Known<'a> {
    snapshot: &'a Snapshot,
    /// The text that names the places in `--map`.
    place_name: String,
    /// Whether they are called x, and so are not X if X is given.
    is_called_x: bool,
    /// Whether the points are X or x, as a profile states it for points that could be both, and the name of the profile.
    reading: Option<(Role, String)>,
    reference: Option<Values<'a>>,
    position: Option<Values<'a>>,
    place: Option<Values<'a>>,
    displacement: Option<Values<'a>>,
}

/// The largest accepted difference of x and X + u, relative to the sum of their roundings: digits may be cut off instead of
/// rounded.
const ROUNDINGS: f64 = 4.0;

/// The additional accepted difference, relative to x: a solver may add X and u in single precision.
const STEPS: f64 = 1e-6;

/// The number of points at which the inverse is tried.
const TRIED: usize = 64;

impl<'a> Known<'a> {
    fn validate_rows(&self) -> Result<(), Mistake> {
        let all = [&self.reference, &self.position, &self.place, &self.displacement];
        if all.into_iter().flatten().any(|it| it.is_of_cells) {
            return Err(Mistake::new(
                "positions must belong to points, and the named arrays belong to cells",
            ));
        }
        let mut rows = all.into_iter().flatten().map(|it| it.numbers.len() / it.components);
        match rows.next() {
            Some(0) => Err(Mistake::new("no points")),
            Some(first) => match rows.find(|&other| other != first) {
                Some(other) => {
                    Err(Mistake::new(format!("X, x and u are of {first} and of {other} points")))
                }
                None => Ok(()),
            },
            None => Err(Mistake::new(format!(
                "no positions: expected X, or x and u; name them with `--map X=..`; the file has {}",
                all_names(self.snapshot)
            ))),
        }
    }

    /// X and u of a rotating body, whose points are X by default.
    fn resolve_with_swirl(self, body: &dyn ReferenceBody) -> Result<Motion<'a>, Mistake> {
        let (snapshot, path) = (self.snapshot, &self.snapshot.path);
        let found = match (self.reference, self.place) {
            (Some(x), _) => Some((x, "X as given")),
            (None, Some(place)) => {
                Some((place, "points taken as X, for points of the body move along the hoop"))
            }
            (None, None) => None,
        };
        let what = "X is not known: give R and Z, for points of the body move along the hoop";
        let (x, how) = found.ok_or_else(|| Mistake::new(what).of(path))?;
        let motion = motion(x, self.displacement, how);
        validate_inside(snapshot, &motion, body)?;
        Ok(motion)
    }

    /// X and u from the given ones.
    fn motion(
        &self,
        (reference, displacement): (Option<Values<'a>>, Option<Values<'a>>),
        body: &dyn ReferenceBody,
        back: Option<Back<'_>>,
    ) -> Result<Motion<'a>, Mistake> {
        match (reference, &self.position, &self.place, displacement) {
            (Some(x), _, _, Some(u)) => Ok(motion(x, Some(u), "X as given")),
            (Some(x), Some(present), _, None) => {
                let u = difference(present, &x);
                Ok(motion(x, Some(u), "X as given, u = x - X"))
            }
            (Some(x), None, Some(place), None) if is_moved(place, &x) => {
                let u = difference(place, &x);
                Ok(motion(x, Some(u), "X as given, points taken as x, u = x - X"))
            }
            (Some(x), None, _, None) => Ok(motion(x, None, "X as given")),
            (None, Some(present), _, Some(u)) => {
                let x = difference(present, &u);
                Ok(motion(x, Some(u), "X = x - u"))
            }
            (None, None, Some(place), Some(u)) => self.resolve_with_u(place.clone(), u, body),
            (None, Some(present), _, None) => match back {
                Some(back) => self.inverse(
                    present,
                    back,
                    "X computed from x by the inverse of the exact motion",
                ),
                None => Err(Mistake::new(
                    "X is not known: give it, or x and u; name them with `--map X=..`",
                )),
            },
            (None, None, Some(place), None) => match back {
                Some(back) => self.resolve_without_u(place, body, back),
                None => Ok(motion(place.clone(), None, "points taken as X")),
            },
            (None, None, None, _) => Err(Mistake::new(
                "X is not known: give it, or x and u; name them with `--map X=..`",
            )),
        }
    }

    /// X of points at x, by the inverse of the exact motion.
    fn inverse(
        &self,
        present: &Values<'a>,
        back: Back<'_>,
        how: &str,
    ) -> Result<Motion<'a>, Mistake> {
        let mut numbers = Vec::with_capacity(present.numbers.len());
        for (row, x) in present.numbers.chunks_exact(present.components).enumerate() {
            let wrong = |what: String| {
                here(self.snapshot, row, format!("x = {x:?}: {what}; give X, or u beside x"))
            };
            let found = back(x, present.rounding).map_err(wrong)?;
            numbers.extend(found.ok_or_else(|| wrong("no point of the body is there".into()))?);
        }
        let reference = Values { numbers: numbers.into(), ..*present };
        Ok(Motion { is_inverse: true, ..motion(reference, None, how) })
    }

    /// Points that may be X or x, without u.
    fn resolve_without_u(
        &self,
        place: &Values<'a>,
        body: &dyn ReferenceBody,
        back: Back<'_>,
    ) -> Result<Motion<'a>, Mistake> {
        if stray(place, body).is_some() {
            let how = "points taken as x, X by the inverse of the exact motion, since some would lie outside the body if they were X";
            return self.inverse(place, back, how);
        }
        let points = place.numbers.chunks_exact(place.components);
        let step = points.len().div_ceil(TRIED);
        let mut has_moved = false;
        for x in points.step_by(step) {
            let Ok(found) = back(x, place.rounding) else {
                // If X is undecided, a point may be at x, and may have moved.
                has_moved = true;
                continue;
            };
            let Some(reference) = found else {
                let how = "points taken as X, since some would lie where the body has no point if they were x";
                return Ok(motion(place.clone(), None, how));
            };
            let far = reference.iter().zip(x).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            has_moved |= far > ROUNDINGS * place.rounding + STEPS * largest(x);
        }
        match (has_moved, &self.reading) {
            (true, Some((Role::Reference, name))) => Ok(motion(
                place.clone(),
                None,
                &format!("points taken as X, as `--from {name}` says"),
            )),
            (true, Some((_, name))) => {
                let how = format!(
                    "points taken as x, as `--from {name}` says, X by the inverse of the exact motion"
                );
                self.inverse(place, back, &how)
            }
            (true, None) => Err(self.unclear(&span(place))),
            (false, _) => Ok(motion(place.clone(), None, "points taken as X: u is 0")),
        }
    }

    fn unclear(&self, spans: &str) -> Mistake {
        let name = &self.place_name;
        Mistake::new(format!(
            "points (`{name}`) may be X or x, and lie in the body with both readings ({spans}): say which with `--map \
             X={name}` or `--map x={name}`"
        ))
    }

    /// Points that may be X or x, with u.
    fn resolve_with_u(
        &self,
        place: Values<'a>,
        u: Values<'a>,
        body: &dyn ReferenceBody,
    ) -> Result<Motion<'a>, Mistake> {
        let back = difference(&place, &u);
        match (stray(&place, body), stray(&back, body)) {
            (None, Some(_)) => Ok(motion(
                place,
                Some(u),
                "points taken as X, since some would lie outside the body if they were x",
            )),
            (Some(_), None) => Ok(motion(
                back,
                Some(u),
                "points taken as x, X = x - u, since some would lie outside the body if they were X",
            )),
            (None, None) if u.numbers.iter().all(|it| *it == 0.0) => {
                Ok(motion(place, Some(u), "points taken as X: u is 0"))
            }
            (None, None) => {
                match ([&place, &back].map(|it| body.is_filled(&it.numbers)), &self.reading) {
                    ([true, false], _) => {
                        let how =
                            "points taken as X, since they would not fill the body if they were x";
                        Ok(motion(place, Some(u), how))
                    }
                    ([false, true], _) => {
                        let how = "points taken as x, X = x - u, since they would not fill the body if they were X";
                        Ok(motion(back, Some(u), how))
                    }
                    (_, Some((Role::Reference, name))) => {
                        let how = format!("points taken as X, as `--from {name}` says");
                        Ok(motion(place, Some(u), &how))
                    }
                    (_, Some((_, name))) => {
                        let how = format!("points taken as x, as `--from {name}` says, X = x - u");
                        Ok(motion(back, Some(u), &how))
                    }
                    (_, None) => {
                        Err(self.unclear(&format!("X is {}, or {}", span(&place), span(&back))))
                    }
                }
            }
            (Some((at, far)), Some((other, away))) => Err(Mistake::new(format!(
                "points lie outside the body with both readings: point {at} by {far:e} as X, point {other} by {away:e} \
                 as x; is it another field, or another unit?"
            ))),
        }
    }

    /// Refuses an x that is not X + u, and places of another name that are neither X nor x.
    fn validate_agreement(&self, motion: &Motion<'_>) -> Result<(), Mistake> {
        let Some(u) = &motion.displacement else { return Ok(()) };
        if self.position.is_none() && self.place.is_none() {
            return Ok(());
        }
        let reference = &motion.reference;
        let present: Vec<f64> =
            reference.numbers.iter().zip(u.numbers.iter()).map(|(x, u)| x + u).collect();
        let differs = |given: &Values<'_>, from: &[f64]| {
            let rounding = given.rounding + reference.rounding + u.rounding;
            let most = ROUNDINGS * rounding + STEPS * largest(from);
            given.numbers.iter().zip(from).position(|(a, b)| (a - b).abs() > most)
        };
        let of_position = self.position.as_ref().and_then(|it| Some((it, differs(it, &present)?)));
        let of_place = self.place.as_ref().and_then(|it| {
            let of_present = differs(it, &present)?;
            (self.is_called_x || differs(it, &reference.numbers).is_some())
                .then_some((it, of_present))
        });
        let Some((given, at)) = of_position.or(of_place) else { return Ok(()) };
        let row = at / given.components;
        let point =
            |numbers: &'_ [f64]| numbers[row * given.components..][..given.components].to_vec();
        let what = format!(
            "x = {:?} contradicts X + u = {:?}: correct the one that is wrong, or leave it out of the file",
            point(&given.numbers),
            point(&present)
        );
        Err(here(self.snapshot, row, what))
    }
}

fn motion<'a>(reference: Values<'a>, displacement: Option<Values<'a>>, how: &str) -> Motion<'a> {
    Motion { reference, displacement, how: how.into(), is_inverse: false }
}

/// The range of each coordinate, in words.
fn span(places: &Values<'_>) -> String {
    let range = |axis: usize| {
        let own = places.numbers.iter().skip(axis).step_by(places.components);
        let [least, most] = range(own);
        format!("{least:.4} to {most:.4}")
    };
    (0..places.components).map(range).collect::<Vec<_>>().join(" by ")
}

/// One position less another, with the roundings of both.
pub(crate) fn difference<'a>(a: &Values<'a>, b: &Values<'_>) -> Values<'a> {
    let numbers = a.numbers.iter().zip(b.numbers.iter()).map(|(a, b)| a - b).collect();
    let stored = Stored::coarser(a.stored, b.stored);
    Values { numbers, rounding: a.rounding + b.rounding, stored, ..*a }
}

/// Whether points differ from X by more than rounding.
fn is_moved(place: &Values<'_>, reference: &Values<'_>) -> bool {
    let most = place.rounding + reference.rounding;
    place.numbers.iter().zip(reference.numbers.iter()).any(|(a, b)| (a - b).abs() > 2.0 * most)
}

/// The first point outside the body by more than its rounding, and its distance.
fn stray(reference: &Values<'_>, body: &dyn ReferenceBody) -> Option<(usize, f64)> {
    let points = reference.numbers.chunks(reference.components).enumerate();
    // Each coordinate may be off by its rounding, and so may the bound of the body.
    let most = 4.0 * reference.rounding;
    points.map(|(at, point)| (at, body.distance(point))).find(|(_, distance)| *distance > most)
}

fn validate_inside(
    snapshot: &Snapshot,
    motion: &Motion<'_>,
    body: &dyn ReferenceBody,
) -> Result<(), Mistake> {
    let reference = &motion.reference;
    let Some((at, distance)) = stray(reference, body) else { return Ok(()) };
    let point = &reference.numbers[at * reference.components..][..reference.components];
    let what = format!("X = {point:?} lies outside the body by {distance:e} ({})", motion.how);
    Err(here(snapshot, at, what))
}

/// The points whose digest another point has too: all coincident points, and a few thousand others of ten million. Sorting
/// digests of 32 bits takes a small part of the time of sorting points.
fn suspects(reference: &Values<'_>) -> Vec<usize> {
    let digests = || reference.numbers.chunks_exact(reference.components).map(digest);
    let mut sorted: Vec<u32> = digests().collect();
    sorted.sort_unstable();
    let pairs = sorted.windows(2).filter(|pair| pair[0] == pair[1]);
    let mut twice: Vec<u32> = pairs.map(|pair| pair[0]).collect();
    drop(sorted);
    twice.dedup();
    // Most other digests differ from these in their first bits, so a table of these bits excludes them without a search.
    let mut starts = vec![0_u64; 1 << (START - 6)];
    let bit = |digest: u32| {
        let start = digest >> (32 - START);
        ((start / 64) as usize, 1_u64 << (start % 64))
    };
    for (word, mask) in twice.iter().map(|&it| bit(it)) {
        starts[word] |= mask;
    }
    let is_twice = |(_, digest): &(usize, u32)| {
        let (word, mask) = bit(*digest);
        starts[word] & mask != 0 && twice.binary_search(digest).is_ok()
    };
    digests().enumerate().filter(is_twice).map(|(at, _)| at).collect()
}

/// A digest that is equal for equal points, and most likely differs for others.
fn digest(point: &[f64]) -> u32 {
    // -0 becomes 0.
    let bits = point.iter().map(|x| (x + 0.0).to_bits());
    let mixed = bits.fold(0, |digest: u64, bits| {
        let mixed = (digest ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        mixed ^ (mixed >> 32)
    });
    mixed as u32
}

/// Refuses two points in one place.
///
/// # Errors
/// The second point, with the first.
pub fn validate_distinct(snapshot: &Snapshot, reference: &Values<'_>) -> Result<(), Mistake> {
    let point = |at: usize| &reference.numbers[at * reference.components..][..reference.components];
    let mut order = suspects(reference);
    let compare = |&a: &usize, &b: &usize| {
        point(a).partial_cmp(point(b)).unwrap_or(std::cmp::Ordering::Equal)
    };
    order.sort_by(compare);
    match order.windows(2).find(|pair| point(pair[0]) == point(pair[1])) {
        None => Ok(()),
        Some(pair) => {
            let (first, second) = (pair[0].min(pair[1]), pair[0].max(pair[1]));
            let what = format!(
                "X = {:?} is where another point is: {}; is a time missing, or written twice?",
                point(second),
                snapshot.place(first)
            );
            Err(here(snapshot, second, what))
        }
    }
}
