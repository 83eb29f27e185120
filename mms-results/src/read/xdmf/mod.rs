//! XDMF, versions 2 and 3: "XDMF Model and Format" (xdmf.org). The numbers are in the XML, or in files beside it.

mod cells;
mod element;
mod item;
mod pointers;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use roxmltree::Node;

use super::Beside;
use super::numbers::positions;
use super::text::{Style, finish, number, times_of};
use super::xml::{at, child};
use crate::wanted::{Need, Wanted};
use crate::{Array, Cells, Mistake, Snapshot, Stored};
use cells::{alike, mixed};
use item::Heavy;

/// The most snapshots of a file.
const MOST_GRIDS: usize = 10_000;

/// The deepest nesting of grids.
const DEEPEST: usize = 8;

/// A state, and the time of its grid.
type Moment = (Option<(f64, Stored)>, Snapshot);

/// The state of reading a file.
struct Reader<'a, 'b, 'c> {
    root: Node<'b, 'c>,
    wanted: &'a Wanted<'a>,
    beside: Beside<'a>,
    files: RefCell<BTreeMap<String, Rc<Heavy<'a>>>>,
    pointed: RefCell<BTreeMap<&'b str, Vec<Node<'b, 'c>>>>,
    /// Cells that several grids share, by their position in the file.
    cells: RefCell<BTreeMap<usize, Rc<Cells>>>,
    /// The places of points that several grids share, by their position in the file.
    points: RefCell<BTreeMap<usize, Rc<Array>>>,
    grids: RefCell<usize>,
}

/// Reads the grids of a file.
pub fn parse(
    root: Node<'_, '_>,
    wanted: &Wanted<'_>,
    beside: Beside<'_>,
) -> Result<Vec<Snapshot>, Mistake> {
    let reader = Reader {
        root,
        wanted,
        beside,
        files: RefCell::default(),
        pointed: RefCell::default(),
        cells: RefCell::default(),
        points: RefCell::default(),
        grids: RefCell::default(),
    };
    let domains = root.children().filter(|it| is(it, "Domain"));
    let grids: Vec<_> = domains.flat_map(|it| it.children()).filter(|it| is(it, "Grid")).collect();
    let mut found: Vec<Moment> = Vec::new();
    for grid in grids.iter().filter(|it| is_temporal(it)) {
        for moment in reader.moments(*grid)? {
            merge(&mut found, moment)?;
        }
    }
    if found.is_empty() {
        let has_values = |it: &&Node<'_, '_>| it.descendants().any(|it| is(&it, "Attribute"));
        let own: Vec<_> = match grids.iter().filter(has_values).count() {
            0 => grids.iter().take(1).collect(),
            _ => grids.iter().filter(has_values).collect(),
        };
        let own = own.into_iter().map(|it| reader.moment(*it, 0)).collect::<Result<Vec<_>, _>>()?;
        found.extend(joined(own)?);
    }
    if found.is_empty() {
        return Err(at(root, "expected a `<Grid>` in a `<Domain>`"));
    }
    if found.iter().all(|(time, _)| time.is_some()) {
        let value = |it: &Moment| it.0.map_or(0.0, |(value, _)| value);
        found.sort_by(|a, b| value(a).total_cmp(&value(b)));
    }
    let own: Vec<_> = found.iter().filter_map(|(time, _)| *time).collect();
    let mut times = times_of(&own);
    let snapshot =
        |(time, snapshot): Moment| Snapshot { time: time.and_then(|_| times.next()), ..snapshot };
    Ok(found.into_iter().map(snapshot).collect())
}

fn is(node: &Node<'_, '_>, name: &str) -> bool {
    node.tag_name().name() == name
}

/// The value of an attribute, or of the attribute's older name, in lower case.
fn said(node: Node<'_, '_>, names: [&str; 2], default: &str) -> String {
    let found = names.iter().find_map(|it| node.attribute(*it));
    found.unwrap_or(default).trim().to_ascii_lowercase()
}

fn is_temporal(grid: &Node<'_, '_>) -> bool {
    said(*grid, ["GridType"; 2], "") == "collection"
        && said(*grid, ["CollectionType"; 2], "") == "temporal"
}

/// Adds a state; if there is one of the same time and mesh, adds its arrays to that state.
fn merge(found: &mut Vec<Moment>, (time, more): Moment) -> Result<(), Mistake> {
    let is_same = |(other, it): &&mut Moment| {
        *other == time && time.is_some() && it.points == more.points && it.cells == more.cells
    };
    let Some((_, known)) = found.iter_mut().rev().find(is_same) else {
        found.push((time, more));
        return Ok(());
    };
    let names = |it: &Snapshot| -> Vec<String> {
        it.of_points.iter().chain(&it.of_cells).map(|it| it.name.clone()).collect()
    };
    let known_names = names(known);
    if let Some(name) = names(&more).into_iter().find(|it| known_names.contains(it)) {
        return Err(Mistake::new(format!("two arrays are called `{name}` at one time")));
    }
    known.of_points.extend(more.of_points);
    known.of_cells.extend(more.of_cells);
    known.unread.extend(more.unread);
    Ok(())
}

/// The pieces of one mesh, joined; `None` without pieces.
fn joined(pieces: Vec<Moment>) -> Result<Option<Moment>, Mistake> {
    let time = pieces.iter().find_map(|(time, _)| *time);
    let pieces: Vec<_> = pieces.into_iter().map(|(_, it)| it).collect();
    if pieces.is_empty() { Ok(None) } else { Ok(Some((time, Snapshot::join(pieces)?))) }
}

impl<'a, 'b, 'c> Reader<'a, 'b, 'c> {
    /// The states of a collection over time.
    fn moments(&self, collection: Node<'b, 'c>) -> Result<Vec<Moment>, Mistake> {
        let times = child(collection, "Time").map(|it| self.times(it)).transpose()?;
        let mut times = times.into_iter().flatten();
        let mut all = Vec::new();
        for grid in collection.children().filter(|it| is(it, "Grid")) {
            let (time, snapshot) = self.moment(grid, 1)?;
            all.push((time.or(times.next()), snapshot));
        }
        Ok(all)
    }

    /// The state of a grid, or of its joined pieces.
    fn moment(&self, grid: Node<'b, 'c>, depth: usize) -> Result<Moment, Mistake> {
        if depth > DEEPEST {
            return Err(at(grid, format!("grids in more than {DEEPEST} others")));
        }
        let time = match child(grid, "Time") {
            Some(time) => self.times(time)?.first().copied(),
            None => None,
        };
        match said(grid, ["GridType"; 2], "uniform").as_str() {
            "uniform" => Ok((time, self.uniform(grid)?)),
            "collection" | "tree" if !is_temporal(&grid) => {
                let inner = grid.children().filter(|it| is(it, "Grid"));
                let pieces = inner.map(|it| self.moment(it, depth + 1));
                let found = joined(pieces.collect::<Result<_, _>>()?)?;
                let (own, whole) = found.ok_or_else(|| at(grid, "expected a `<Grid>` in it"))?;
                Ok((time.or(own), whole))
            }
            other => Err(at(grid, format!("a grid of type `{other}` is not read here"))),
        }
    }

    /// The times that an element lists.
    fn times(&self, node: Node<'b, 'c>) -> Result<Vec<(f64, Stored)>, Mistake> {
        let kind = said(node, ["TimeType", "Type"], "single");
        if kind == "single" {
            let text = node.attribute("Value").unwrap_or("");
            let value = number(text).filter(|it| it.is_finite());
            let value = value.ok_or_else(|| at(node, format!("`{text}`: expected a time")))?;
            let mut style = Style::default();
            style.see(text);
            return Ok(vec![(value, style.stored())]);
        }
        let item = child(node, "DataItem");
        let item = item.ok_or_else(|| at(node, "expected a `<DataItem>` with its times"))?;
        let array = self.item(item, "time")?;
        if array.values.len() > MOST_GRIDS || array.values.iter().any(|it| !it.is_finite()) {
            return Err(at(item, format!("expected {MOST_GRIDS} times at most, all finite")));
        }
        match (kind.as_str(), &array.values[..]) {
            ("list", all) => Ok(all.iter().map(|it| (*it, array.stored)).collect()),
            ("hyperslab", &[start, step, _]) => {
                let each = (0..MOST_GRIDS).map(|at| start + step * at as f64);
                let finite = each.take_while(|it| it.is_finite());
                Ok(finite.map(|it| (it, Stored::Double)).collect())
            }
            _ => Err(at(
                node,
                format!("times of type `{kind}` are not read: write one for each grid"),
            )),
        }
    }

    /// The children of a grid, including those it includes from elsewhere.
    fn parts(&self, grid: Node<'b, 'c>) -> Result<Vec<Node<'b, 'c>>, Mistake> {
        let mut all = Vec::new();
        for node in grid.children().filter(Node::is_element) {
            if !is(&node, "include") {
                all.push(node);
                continue;
            }
            let pointer = node.attribute("xpointer").unwrap_or("").trim();
            if node.has_attribute("href") {
                return Err(at(node, "parts of other XML files are not read: write one file"));
            }
            let path = pointer.strip_prefix("xpointer(").and_then(|it| it.strip_suffix(')'));
            let found = path.map(|it| self.pointed(node, it)).transpose()?.unwrap_or_default();
            if found.is_empty() {
                return Err(at(node, format!("`{pointer}` points to nothing that is there")));
            }
            all.extend(found);
        }
        Ok(all)
    }

    fn uniform(&self, grid: Node<'b, 'c>) -> Result<Snapshot, Mistake> {
        *self.grids.borrow_mut() += 1;
        if *self.grids.borrow() > MOST_GRIDS {
            return Err(at(grid, format!("more than {MOST_GRIDS} grids")));
        }
        let parts = self.parts(grid)?;
        let one = |name: &str| parts.iter().copied().find(|it| is(it, name));
        let geometry = one("Geometry");
        let geometry = geometry.ok_or_else(|| at(grid, "expected a `<Geometry>` with points"))?;
        let points = self.geometry(geometry)?;
        let cells = one("Topology").map(|it| self.topology(it)).transpose()?.unwrap_or_default();
        cells.validate(points.rows()).map_err(|it| at(grid, it.what))?;
        let numbers = points.values.len() + cells.points.len() + 2 * cells.len();
        self.wanted.reserve("the mesh of a grid", numbers)?;
        let (points, cells) = (Some((*points).clone()), (*cells).clone());
        let mut snapshot = Snapshot { points, cells, ..Snapshot::default() };
        let mut single = [Vec::new(), Vec::new()];
        for node in parts.into_iter().filter(|it| is(it, "Attribute")) {
            self.attribute(node, &mut snapshot, &mut single)?;
        }
        finish(&mut snapshot.of_points.iter_mut().collect::<Vec<_>>(), &single[0]);
        finish(&mut snapshot.of_cells.iter_mut().collect::<Vec<_>>(), &single[1]);
        Ok(snapshot)
    }

    /// Reads an array of points or of cells.
    fn attribute(
        &self,
        node: Node<'b, 'c>,
        snapshot: &mut Snapshot,
        single: &mut [Vec<bool>; 2],
    ) -> Result<(), Mistake> {
        let name = node.attribute("Name").unwrap_or("");
        let need = self.wanted.need(name);
        let of_element = said(node, ["ItemType"; 2], "") == "finiteelementfunction";
        let rows = [snapshot.rows(), snapshot.cells.len()];
        let place = match said(node, ["Center"; 2], "node").as_str() {
            "node" => Some(0),
            "cell" => Some(1),
            _ if of_element => Some(usize::from(said(node, ["ElementDegree"; 2], "") == "0")),
            _ => None,
        };
        let (Some(place), true) = (place, matches!(need, Need::Must | Need::Numbers)) else {
            if place.is_none() && need == Need::Must {
                return Err(at(node, format!("`{name}`: expected values of nodes or of cells")));
            }
            snapshot.unread.push(name.to_owned());
            return Ok(());
        };
        let mut items = node.children().filter(|it| is(it, "DataItem"));
        let first = items.next();
        let first = first.ok_or_else(|| at(node, format!("`{name}`: expected a `<DataItem>`")))?;
        let mut array = match of_element {
            true => self.of_element(node, name, snapshot)?,
            false => self.item(first, name)?,
        };
        let rows = rows[place];
        if rows == 0 || array.values.is_empty() || !array.values.len().is_multiple_of(rows) {
            let what = format!(
                "`{name}`: {} numbers, and expected as many for each of {rows} points or cells",
                array.values.len()
            );
            return Err(at(node, what));
        }
        array.components = array.values.len() / rows;
        if said(node, ["AttributeType", "Type"], "") == "tensor6" && array.components == 6 {
            self.wanted.reserve(&format!("`{name}`"), 9 * rows)?;
            // The upper half of a symmetric matrix, row by row.
            let whole = |it: &[f64]| [0, 1, 2, 1, 3, 4, 2, 4, 5].map(|at| it[at]);
            array.values = array.values.chunks_exact(6).flat_map(whole).collect();
            array.components = 9;
        }
        single[place].push(first.attribute("Precision") == Some("4"));
        if place == 0 { &mut snapshot.of_points } else { &mut snapshot.of_cells }.push(array);
        Ok(())
    }

    /// The places of points.
    fn geometry(&self, node: Node<'b, 'c>) -> Result<Rc<Array>, Mistake> {
        let key = node.range().start;
        if let Some(known) = self.points.borrow().get(&key) {
            return Ok(known.clone());
        }
        let items: Vec<_> = node.children().filter(|it| is(it, "DataItem")).collect();
        let kind = said(node, ["GeometryType", "Type"], "xyz");
        let axes = match kind.as_str() {
            "xyz" | "x_y_z" => 3,
            "xy" | "x_y" => 2,
            other => {
                let what = format!("a geometry `{other}` is not read: write XY, XYZ or X_Y_Z");
                return Err(at(node, what));
            }
        };
        let expected = if kind.contains('_') { axes } else { 1 };
        if items.len() != expected {
            return Err(at(
                node,
                format!("expected {expected} `<DataItem>`s, found {}", items.len()),
            ));
        }
        let mut arrays: Vec<Array> =
            items.iter().map(|it| self.item(*it, "points")).collect::<Result<_, _>>()?;
        let single = items.iter().map(|it| it.attribute("Precision") == Some("4"));
        finish(&mut arrays.iter_mut().collect::<Vec<_>>(), &single.collect::<Vec<_>>());
        let rows = arrays[0].values.len();
        if arrays.iter().any(|it| it.values.len() != rows)
            || expected == 1 && !rows.is_multiple_of(axes)
        {
            return Err(at(node, "its coordinates do not make points"));
        }
        let values = match expected {
            1 => std::mem::take(&mut arrays[0].values),
            _ => (0..rows).flat_map(|row| arrays.iter().map(move |it| it.values[row])).collect(),
        };
        let points =
            Rc::new(Array { components: axes, values, ..arrays[0].clone_without_values() });
        self.points.borrow_mut().insert(key, points.clone());
        Ok(points)
    }

    /// The cells between points; none if points have no connections.
    fn topology(&self, node: Node<'b, 'c>) -> Result<Rc<Cells>, Mistake> {
        let key = node.range().start;
        if let Some(known) = self.cells.borrow().get(&key) {
            return Ok(known.clone());
        }
        let kind = said(node, ["TopologyType", "Type"], "");
        let Some(item) = child(node, "DataItem") else {
            return match kind.as_str() {
                "polyvertex" => Ok(Rc::default()),
                other => Err(at(
                    node,
                    format!("a topology `{other}` without a list of points is not read"),
                )),
            };
        };
        let all = self.item(item, "topology")?.values;
        let all = positions(all).map_err(|mistake| at(node, mistake.what))?;
        let cells = match kind.as_str() {
            "mixed" => mixed(&all),
            name => alike(name, node, &all),
        };
        let cells = Rc::new(cells.map_err(|mistake| at(node, mistake.what))?);
        self.cells.borrow_mut().insert(key, cells.clone());
        Ok(cells)
    }
}
