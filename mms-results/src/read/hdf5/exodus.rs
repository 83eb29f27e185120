//! Exodus II: "EXODUS II: A Finite Element Data Model" (Sandia report SAND92-2137), in netCDF or in HDF5.

use std::collections::BTreeSet;

use super::{File, by_time};
use crate::{Array, Cells, Mistake, Snapshot};

/// The most blocks of elements that are searched.
const MOST_BLOCKS: usize = 10_000;

/// Kinds of elements: the letters of their names, and for each number of nodes the type in VTK.
type Elements = (&'static [&'static str], &'static [(usize, u8)]);
const ELEMENTS: &[Elements] = &[
    (&["SPHERE", "CIRCLE", "NODE", "POINT"], &[(1, 1)]),
    (&["EDGE", "BAR", "BEAM", "TRUSS", "LINE", "ROD"], &[(2, 3), (3, 21)]),
    (&["TRI", "TRIANGLE", "TRISHELL"], &[(3, 5), (6, 22)]),
    (&["QUAD", "SHELL"], &[(4, 9), (8, 23), (9, 28)]),
    (&["TET", "TETRA"], &[(4, 10), (10, 24)]),
    (&["PYRAMID", "PYR"], &[(5, 14)]),
    (&["WEDGE"], &[(6, 13)]),
    (&["HEX"], &[(8, 12), (20, 25), (27, 29)]),
];

/// The order in VTK of the nodes of a hexahedron from the twelfth on. Exodus lists the nodes between the two faces before those
/// on the upper face, and the middle before the nodes on the faces.
const HEX: [usize; 15] = [16, 17, 18, 19, 12, 13, 14, 15, 23, 24, 25, 26, 21, 22, 20];

/// Whether a file is in Exodus format.
pub fn is_exodus(file: &File<'_>) -> bool {
    file.numbers("", "api_version").is_some() && file.store.attribute("", "title").is_some()
}

/// Reads a file; its mesh is the reference mesh, at all of its times.
pub fn parse(file: &File<'_>) -> Result<Vec<Snapshot>, Mistake> {
    let points = coordinates(file)?;
    let (cells, blocks) = cells(file, points.rows())?;
    let times = match file.store.set("time_whole") {
        Some(set) => file.times(&set)?,
        None => Vec::new(),
    };
    let nodes = points.rows();
    let mut whole = Snapshot { points: Some(points), cells, ..Snapshot::default() };
    let of_points = variables(file, "name_nod_var", &mut whole.unread, |at| {
        let own = file.store.set(&format!("vals_nod_var{}", at + 1));
        match own.or_else(|| file.store.set("vals_nod_var")) {
            Some(set) if set.shape.len() == 3 => {
                let array = file.array(&set, "vals_nod_var")?;
                Ok(Some(one_of_all(&array, at, nodes, &set.shape)?))
            }
            Some(set) => file.array(&set, "").map(Some),
            None => Ok(None),
        }
    })?;
    let of_cells = variables(file, "name_elem_var", &mut whole.unread, |at| {
        let mut parts = Vec::new();
        for (block, rows) in blocks.iter().filter(|(_, rows)| *rows > 0) {
            let set = file.store.set(&format!("vals_elem_var{}eb{block}", at + 1));
            // An array that some elements lack is left out.
            let Some(set) = set else { return Ok(None) };
            parts.push((file.array(&set, "")?, *rows));
        }
        joined(parts, times.len())
    })?;
    whole.unread.extend(file.words("name_glo_var")?);
    let (cells, mut all) = (whole.cells.len(), file.repeated(whole, &times)?);
    for (array, rows, is_of_cells) in of_points
        .into_iter()
        .map(|it| (it, nodes, false))
        .chain(of_cells.into_iter().map(|it| (it, cells, true)))
    {
        if array.values.len() != rows.saturating_mul(times.len()) {
            let what = format!(
                "`{}`: {} numbers, and expected one for each of {rows} nodes or elements at {} times",
                array.name,
                array.values.len(),
                times.len()
            );
            return Err(Mistake::new(what));
        }
        for (snapshot, part) in all.iter_mut().zip(by_time(&array, 1, times.len())) {
            let arrays = if is_of_cells { &mut snapshot.of_cells } else { &mut snapshot.of_points };
            arrays.push(part);
        }
    }
    Ok(all)
}

/// The reference positions of the nodes.
fn coordinates(file: &File<'_>) -> Result<Array, Mistake> {
    let axes: Vec<_> =
        ["coordx", "coordy", "coordz"].iter().filter_map(|it| file.store.set(it)).collect();
    let mut columns = Vec::new();
    for set in &axes {
        columns.push(file.array(set, "")?);
    }
    if columns.is_empty() {
        let all = file.at("coord")?;
        let rows = all.values.len() / all.rows().max(1);
        let parts = all.values.chunks(rows.max(1));
        columns.extend(parts.map(|it| Array { values: it.to_vec(), ..all.clone_without_values() }));
    }
    let rows = columns.first().map_or(0, |it| it.values.len());
    if columns.iter().any(|it| it.values.len() != rows) {
        return Err(Mistake::new("its coordinates have different numbers of nodes"));
    }
    let stored = columns.iter().map(|it| it.stored).reduce(|a, b| a.coarser(b));
    Ok(Array {
        name: "reference_position".into(),
        components: columns.len().max(1),
        values: (0..rows).flat_map(|row| columns.iter().map(move |it| it.values[row])).collect(),
        stored: stored.ok_or_else(|| Mistake::new("a file of Exodus without coordinates"))?,
        ..Array::default()
    })
}

/// The elements of all blocks; and for each block its number and the number of its elements.
fn cells(file: &File<'_>, nodes: usize) -> Result<(Cells, Vec<(usize, usize)>), Mistake> {
    let (mut cells, mut blocks) = (Cells::default(), Vec::new());
    let declared = file.store.set("eb_prop1").and_then(|it| it.shape.first().copied());
    for block in 1..=declared.unwrap_or(MOST_BLOCKS).min(MOST_BLOCKS) {
        let path = format!("connect{block}");
        let Some(set) = file.store.set(&path) else {
            // A block without elements has no array; this shows only if the number of blocks is known.
            match declared {
                Some(_) => continue,
                None => break,
            }
        };
        let size = set.shape.get(1).copied().unwrap_or(1).max(1);
        let name = file.word(&path, "elem_type").unwrap_or_default().to_ascii_uppercase();
        let kind = kind(&name, size).ok_or_else(|| {
            Mistake::new(format!(
                "`{path}`: elements `{name}` of {size} nodes are not read: write the mesh with elements of degree 1 or 2"
            ))
        })?;
        let points = file.positions(&path)?;
        file.wanted.reserve(&format!("`{path}`"), 2 * (points.len() / size))?;
        for element in points.chunks_exact(size) {
            for at in 0..size {
                let from = if size >= 20 && at >= 12 { HEX[at - 12] } else { at };
                let node = element[from].checked_sub(1).filter(|it| *it < nodes);
                cells.points.push(node.ok_or_else(|| {
                    let found = element[from];
                    Mistake::new(format!(
                        "`{path}`: expected a node from 1 to {nodes}, found {found}"
                    ))
                })?);
            }
            cells.types.push(kind);
            cells.ends.push(cells.points.len());
        }
        blocks.push((block, points.len() / size));
    }
    Ok((cells, blocks))
}

/// The type in VTK of an element, by its name and its number of nodes.
fn kind(name: &str, size: usize) -> Option<u8> {
    let letters = name.trim_end_matches(|it: char| it.is_ascii_digit());
    let (_, kinds) = ELEMENTS.iter().find(|(names, _)| names.contains(&letters))?;
    kinds.iter().find(|(nodes, _)| *nodes == size).map(|(_, kind)| *kind)
}

/// Reads the variables named in this array, by their positions there.
fn variables(
    file: &File<'_>,
    names: &str,
    unread: &mut Vec<String>,
    read: impl Fn(usize) -> Result<Option<Array>, Mistake>,
) -> Result<Vec<Array>, Mistake> {
    let (mut all, mut seen) = (Vec::new(), BTreeSet::new());
    for (at, name) in file.words(names)?.into_iter().enumerate() {
        if !seen.insert(name.clone()) {
            return Err(Mistake::new(format!("two variables are called `{name}`")));
        }
        let found = if file.wanted.reads(&name) { read(at)? } else { None };
        match found {
            Some(array) => all.push(Array { name, components: 1, ..array }),
            None => unread.push(name),
        }
    }
    Ok(all)
}

/// One variable of an array over times, variables and nodes.
fn one_of_all(all: &Array, at: usize, nodes: usize, shape: &[usize]) -> Result<Array, Mistake> {
    if shape[2] != nodes || at >= shape[1] {
        return Err(Mistake::new("`vals_nod_var` does not fit the nodes and the names"));
    }
    let times = all.values.chunks_exact(shape[1].saturating_mul(nodes).max(1));
    let own = times.flat_map(|it| &it[at * nodes..][..nodes]).copied().collect();
    Ok(Array { values: own, ..all.clone_without_values() })
}

/// Joins the numbers of blocks, each with all times, into numbers of the mesh at one time after the other.
fn joined(parts: Vec<(Array, usize)>, times: usize) -> Result<Option<Array>, Mistake> {
    let Some((first, _)) = parts.first() else { return Ok(None) };
    let mut whole = first.clone_without_values();
    for time in 0..times {
        for (part, rows) in &parts {
            let own =
                time.checked_mul(*rows).and_then(|start| part.values.get(start..)?.get(..*rows));
            whole.values.extend(own.ok_or_else(|| {
                Mistake::new("an array of elements has fewer numbers than elements and times")
            })?);
            whole.stored = whole.stored.coarser(part.stored);
        }
    }
    Ok(Some(whole))
}
