//! A mesh of Gmsh with its views: turns nodes and elements with tags into points and cells.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::LazyLock;

use super::gmsh::{Of, View};
use super::gmsh_order;
use super::series::tell_unread;
use super::tags::Tags;
use super::text::{Numbers, finish};
use crate::wanted::{Need, Wanted};
use crate::{Array, Cells, Mistake, Snapshot, Stored, Time};

/// A type of elements.
pub struct Element {
    /// The type number in Gmsh.
    kind: i64,
    /// The type number in VTK.
    of_vtk: u8,
    dimension: u8,
    pub nodes: usize,
    /// The nodes in the order of VTK, by their positions in Gmsh; empty if the orders are equal.
    order: Cow<'static, [usize]>,
}

const fn same(kind: i64, of_vtk: u8, dimension: u8, nodes: usize) -> Element {
    Element { kind, of_vtk, dimension, nodes, order: Cow::Borrowed(&[]) }
}

const fn other(kind: i64, of_vtk: u8, order: &'static [usize]) -> Element {
    Element { kind, of_vtk, dimension: 3, nodes: order.len(), order: Cow::Borrowed(order) }
}

fn higher(kind: i64, of_vtk: u8, dimension: u8, nodes: usize) -> Element {
    Element { kind, of_vtk, dimension, nodes, order: gmsh_order::order(of_vtk, nodes).into() }
}

/// Types of order 1 to 5. Gmsh has no prisms and pyramids of an order above 2.
static ELEMENTS: LazyLock<Vec<Element>> = LazyLock::new(|| {
    vec![
        same(15, 1, 0, 1),
        same(1, 3, 1, 2),
        same(8, 21, 1, 3),
        same(2, 5, 2, 3),
        same(9, 22, 2, 6),
        same(3, 9, 2, 4),
        same(16, 23, 2, 8),
        same(10, 28, 2, 9),
        same(4, 10, 3, 4),
        same(5, 12, 3, 8),
        same(6, 13, 3, 6),
        same(7, 14, 3, 5),
        other(11, 24, &[0, 1, 2, 3, 4, 5, 6, 7, 9, 8]),
        other(17, 25, &[0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15]),
        other(
            12,
            29,
            &[
                0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21,
                24, 20, 25, 26,
            ],
        ),
        other(18, 26, &[0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11]),
        other(13, 32, &[0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16]),
        other(19, 27, &[0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12]),
        same(26, 68, 1, 4),
        same(27, 68, 1, 5),
        same(28, 68, 1, 6),
        same(21, 69, 2, 10),
        same(23, 69, 2, 15),
        same(25, 69, 2, 21),
        higher(36, 70, 2, 16),
        higher(37, 70, 2, 25),
        higher(38, 70, 2, 36),
        higher(29, 71, 3, 20),
        higher(30, 71, 3, 35),
        higher(31, 71, 3, 56),
        higher(92, 72, 3, 64),
        higher(93, 72, 3, 125),
        higher(94, 72, 3, 216),
    ]
});

/// The element type with this number in Gmsh.
pub fn element(kind: i64) -> Option<&'static Element> {
    ELEMENTS.iter().find(|it| it.kind == kind)
}

/// Nodes and elements by their tags.
#[derive(Default)]
pub struct Mesh {
    pub tags: Vec<u64>,
    pub places: Numbers,
    pub is_binary: bool,
    elements: Vec<u64>,
    dimensions: Vec<u8>,
    /// The cells, whose points are tags until all nodes are read.
    cells: Cells,
}

impl Mesh {
    /// The number of elements.
    pub fn len(&self) -> usize {
        self.elements.len()
    }

    /// Adds an element.
    pub fn add(&mut self, tag: u64, kind: &Element, nodes: &[u64]) {
        let Cells { types, points, ends } = &mut self.cells;
        match &*kind.order {
            [] => points.extend(nodes.iter().map(|it| *it as usize)),
            order => points.extend(order.iter().map(|it| nodes[*it] as usize)),
        }
        types.push(kind.of_vtk);
        ends.push(points.len());
        self.elements.push(tag);
        self.dimensions.push(kind.dimension);
    }

    /// Removes nodes that repeat one of the first `had` nodes.
    ///
    /// # Errors
    /// A node with two places.
    pub fn unite_nodes(&mut self, had: usize) -> Result<(), String> {
        if had == 0 {
            return Ok(());
        }
        let known = nodes(&self.tags[..had])?;
        let mut next = had;
        for at in had..self.tags.len() {
            let places = &mut self.places.values;
            match known.place(self.tags[at]) {
                Some(first) if places[3 * first..][..3] == places[3 * at..][..3] => {}
                Some(_) => {
                    return Err(format!(
                        "the node {} is there twice, at two places: write each view with its mesh into a file of its own",
                        self.tags[at]
                    ));
                }
                None => {
                    self.tags[next] = self.tags[at];
                    places.copy_within(3 * at..3 * at + 3, 3 * next);
                    next += 1;
                }
            }
        }
        self.tags.truncate(next);
        self.places.values.truncate(3 * next);
        Ok(())
    }

    /// Removes elements that repeat one of the first `had` elements.
    pub fn unite_elements(&mut self, had: usize) -> Result<(), String> {
        if had == 0 {
            return Ok(());
        }
        let known = elements(&self.elements[..had])?;
        let start = |cells: &Cells, at: usize| if at == 0 { 0 } else { cells.ends[at - 1] };
        let (mut next, mut end) = (had, start(&self.cells, had));
        let mut from = end;
        for at in had..self.elements.len() {
            let (to, cells) = (self.cells.ends[at], &mut self.cells);
            match known.place(self.elements[at]) {
                Some(first) => {
                    let own = &cells.points[start(cells, first)..cells.ends[first]];
                    if own != &cells.points[from..to] || cells.types[first] != cells.types[at] {
                        return Err(format!(
                            "the element {} is there twice, with two lists of nodes",
                            self.elements[at]
                        ));
                    }
                }
                None => {
                    cells.points.copy_within(from..to, end);
                    end += to - from;
                    (cells.types[next], cells.ends[next]) = (cells.types[at], end);
                    self.elements[next] = self.elements[at];
                    self.dimensions[next] = self.dimensions[at];
                    next += 1;
                }
            }
            from = to;
        }
        self.cells.points.truncate(end);
        self.cells.types.truncate(next);
        self.cells.ends.truncate(next);
        self.elements.truncate(next);
        self.dimensions.truncate(next);
        Ok(())
    }

    /// Makes the mesh at each time of the views. Omits elements of lower dimension and unconnected nodes if views lack them.
    pub fn snapshots(
        mut self,
        views: Vec<View>,
        mut unread: Vec<(f64, String)>,
        wanted: &Wanted<'_>,
    ) -> Result<Vec<Snapshot>, Mistake> {
        if self.tags.is_empty() {
            let what = "a file of Gmsh without nodes: write the mesh beside the views, as with `PostProcessing.SaveMesh = 1`";
            return Err(Mistake::new(what));
        }
        let nodes = nodes(&self.tags).map_err(Mistake::new)?;
        for point in &mut self.cells.points {
            *point = nodes.place(*point as u64).ok_or_else(|| {
                Mistake::new(format!("an element has the node {point}, which is not there"))
            })?;
        }
        let views = united(views, &mut unread, wanted)?;
        let (of_elements, of_nodes): (Vec<View>, Vec<View>) =
            views.into_iter().partition(|it| it.of == Of::Elements);
        let mut held = Held { wanted, unread };
        let most = self.dimensions.iter().max().copied();
        let is_full: Vec<bool> = self.dimensions.iter().map(|it| Some(*it) == most).collect();
        let mut cells = vec![true; is_full.len()];
        let mut of_cells = Vec::new();
        if !of_elements.is_empty() {
            let tags = elements(&self.elements).map_err(Mistake::new)?;
            (of_cells, cells) =
                held.fitting("element", of_elements, (&self.elements, &tags), &is_full)?;
        }
        self.keep_cells(&cells);
        let mut is_used = vec![self.cells.is_empty(); self.tags.len()];
        self.cells.points.iter().for_each(|it| is_used[*it] = true);
        let (mut of_points, mut points) =
            held.fitting("node", of_nodes, (&self.tags, &nodes), &is_used)?;
        if of_points.is_empty() && !of_cells.is_empty() {
            points = is_used;
        }
        let places = self.keep_points(&points);
        for (views, kept) in [(&mut of_points, &points), (&mut of_cells, &cells)] {
            views.retain(|it| wanted.reads(&it.array.name));
            views.iter_mut().try_for_each(|it| it.arrange(kept, wanted))?;
        }
        let mesh = Snapshot { points: Some(places), cells: self.cells, ..Snapshot::default() };
        let mut found = mesh.at_times(of_points, of_cells, wanted)?;
        tell_unread(&mut found, held.unread);
        Ok(found)
    }

    fn keep_cells(&mut self, kept: &[bool]) {
        if kept.iter().all(|it| *it) {
            return;
        }
        let mut cells = Cells::default();
        for ((kind, points), _) in self.cells.iter().zip(kept).filter(|it| *it.1) {
            cells.types.push(kind);
            cells.points.extend(points);
            cells.ends.push(cells.points.len());
        }
        self.cells = cells;
    }

    /// Removes all points except the kept ones, renumbers the cells, and returns the places.
    fn keep_points(&mut self, kept: &[bool]) -> Array {
        let numbers = std::mem::take(&mut self.places);
        let mut places = numbers.into_array("Points", 3);
        if self.is_binary {
            places.stored = Stored::Double;
        }
        if !kept.iter().all(|it| *it) {
            let next = positions(kept);
            self.cells.points.iter_mut().for_each(|it| *it = next[*it]);
            let mut at = 0;
            places.values.retain(|_| {
                at += 1;
                kept[(at - 1) / 3]
            });
        }
        places
    }
}

/// The positions of nodes by their tags.
fn nodes(tags: &[u64]) -> Result<Tags, String> {
    Tags::of(tags).map_err(|tag| format!("the node {tag} is there twice"))
}

/// The positions of elements by their tags.
fn elements(tags: &[u64]) -> Result<Tags, String> {
    Tags::of(tags).map_err(|tag| format!("the element {tag} is there twice"))
}

/// The new position of each kept item.
fn positions(kept: &[bool]) -> Vec<usize> {
    let mut next = 0;
    let position = |kept: &bool| {
        next += usize::from(*kept);
        next.saturating_sub(1)
    };
    kept.iter().map(position).collect()
}

/// Merges the partitions of views. Refuses a view with two steps at one time, which is ambiguous.
fn united(
    views: Vec<View>,
    unread: &mut Vec<(f64, String)>,
    wanted: &Wanted<'_>,
) -> Result<Vec<View>, Mistake> {
    let mut found: BTreeMap<(bool, String, u64), View> = BTreeMap::new();
    for view in views {
        let (name, time) = (view.array.name.clone(), view.time.values[0] + 0.0);
        let Some(known) = found.get_mut(&(view.of == Of::Nodes, name.clone(), time.to_bits()))
        else {
            found.insert((view.of == Of::Nodes, name, time.to_bits()), view);
            continue;
        };
        if known.step == view.step && known.array.components == view.array.components {
            known.tags.extend(view.tags);
            known.array.values.extend(view.array.values);
            known.array.stored = known.array.stored.coarser(view.array.stored);
        } else if wanted.need(&name) == Need::Must {
            return Err(Mistake::new(format!(
                "`{name}` has the steps {} and {} at the time {time}: write a time with each step of the view",
                known.step, view.step
            )));
        } else {
            unread.push((time, name));
        }
    }
    Ok(found.into_values().collect())
}

/// Collects the views that have numbers for all nodes or elements that need them.
struct Held<'a> {
    wanted: &'a Wanted<'a>,
    unread: Vec<(f64, String)>,
}

impl Held<'_> {
    /// Selects the views with numbers for all that need them, and converts their tags; returns also the common part.
    ///
    /// # Errors
    /// A view that must be read, and does not fit.
    fn fitting(
        &mut self,
        what: &str,
        views: Vec<View>,
        (tags, known): (&[u64], &Tags),
        needed: &[bool],
    ) -> Result<(Vec<View>, Vec<bool>), Mistake> {
        let count = needed.iter().filter(|it| **it).count();
        let (mut found, mut times) = (Vec::new(), vec![0; tags.len()]);
        for mut view in views {
            let name = view.array.name.clone();
            let misfit = match view.places(known) {
                Err(tag) => Some(format!(
                    "`{name}` has no or two numbers for the {what} {}, or it is not there",
                    tag as i64
                )),
                Ok(()) if view.tags.iter().filter(|it| needed[**it as usize]).count() < count => {
                    let mut lacks = needed.to_vec();
                    view.tags.iter().for_each(|it| lacks[*it as usize] = false);
                    let first = lacks.iter().position(|it| *it).map_or(0, |it| tags[it]);
                    Some(format!(
                        "`{name}` has no number for the {what} {first}: write the view for all of them"
                    ))
                }
                Ok(()) => None,
            };
            match misfit {
                Some(misfit) if self.wanted.need(&name) == Need::Must => {
                    return Err(Mistake::new(misfit));
                }
                Some(_) => self.unread.push((view.time.values[0], name)),
                None => {
                    view.tags.iter().for_each(|it| times[*it as usize] += 1);
                    found.push(view);
                }
            }
        }
        let kept = times.iter().zip(needed).map(|(times, needed)| *needed || *times == found.len());
        let kept = kept.collect();
        Ok((found, kept))
    }
}

impl View {
    /// Converts tags to positions.
    ///
    /// # Errors
    /// An unknown tag, or one that occurs twice.
    fn places(&mut self, known: &Tags) -> Result<(), u64> {
        let mut places = Vec::with_capacity(self.tags.len());
        for tag in &self.tags {
            places.push(known.place(*tag).ok_or(*tag)? as u64);
        }
        Tags::of(&places).map_err(|place| {
            let at = places.iter().position(|it| *it == place).unwrap_or(0);
            self.tags[at]
        })?;
        self.tags = places;
        Ok(())
    }

    /// Sorts the numbers in the order of the kept items.
    fn arrange(&mut self, kept: &[bool], wanted: &Wanted<'_>) -> Result<(), Mistake> {
        let is_in_order = self.tags.iter().enumerate().all(|(at, place)| at as u64 == *place);
        if is_in_order && self.tags.len() == kept.len() && kept.iter().all(|it| *it) {
            return Ok(());
        }
        let (next, size) = (positions(kept), self.array.components);
        let count = kept.iter().filter(|it| **it).count();
        wanted.reserve(&format!("`{}`", self.array.name), count * size)?;
        let mut values = vec![0.0; count * size];
        for (place, row) in self.tags.iter().zip(self.array.values.chunks_exact(size)) {
            let place = *place as usize;
            if kept[place] {
                values[next[place] * size..][..size].copy_from_slice(row);
            }
        }
        self.array.values = values;
        Ok(())
    }
}

impl Snapshot {
    /// Makes the mesh at each time of these views. A single time of 0 counts as no time: files without times contain it.
    fn at_times(
        mut self,
        mut of_points: Vec<View>,
        mut of_cells: Vec<View>,
        wanted: &Wanted<'_>,
    ) -> Result<Vec<Snapshot>, Mistake> {
        let views = of_points.iter_mut().chain(&mut of_cells);
        let arrays = views.flat_map(|it| [&mut it.array, &mut it.time]);
        let mut arrays: Vec<&mut Array> = self.points.iter_mut().chain(arrays).collect();
        let single = vec![false; arrays.len()];
        finish(&mut arrays, &single);
        let mut times: Vec<(f64, Stored)> = Vec::new();
        for time in of_points.iter().chain(&of_cells).map(|it| &it.time) {
            times.push((time.values[0] + 0.0, time.stored));
        }
        times.sort_by(|a, b| a.0.total_cmp(&b.0));
        times.dedup_by_key(|it| it.0);
        if times.is_empty() {
            return Ok(vec![self]);
        }
        let numbers = self.points.as_ref().map_or(0, |it| it.values.len());
        let is_known = times.len() > 1 || times[0].0 != 0.0;
        let mut found = Vec::new();
        for (value, stored) in &times {
            wanted.reserve("the mesh", numbers + self.cells.points.len())?;
            let time = Time { value: *value, rounding: stored.rounding(*value) };
            found.push(Snapshot { time: is_known.then_some(time), ..self.clone() });
        }
        let at = |view: &View| times.iter().position(|it| it.0 == view.time.values[0]).unwrap_or(0);
        of_points.into_iter().for_each(|it| found[at(&it)].of_points.push(it.array));
        of_cells.into_iter().for_each(|it| found[at(&it)].of_cells.push(it.array));
        Ok(found)
    }
}
