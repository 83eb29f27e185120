//! Finite element functions in checkpoints of dolfin.

use roxmltree::Node;

use super::super::numbers::positions;
use super::super::xml::at;
use super::{Reader, is, said};
use crate::{Array, Mistake, Snapshot};

/// The most components of a function.
const MOST_COMPONENTS: usize = 9;

impl<'b, 'c> Reader<'_, 'b, 'c> {
    /// Reads the values at points, or of cells, of a finite element function in a checkpoint of dolfin: the numbers of the
    /// degrees of freedom in each cell, the values, the start of each cell's degrees of freedom, and the numbers of cells.
    pub fn of_element(
        &self,
        node: Node<'b, 'c>,
        name: &str,
        snapshot: &Snapshot,
    ) -> Result<Array, Mistake> {
        let wrong = |what: String| at(node, format!("`{name}`: {what}"));
        let family = said(node, ["ElementFamily"; 2], "");
        let degree = said(node, ["ElementDegree"; 2], "");
        let is_of_cells = degree == "0";
        if !(is_of_cells || degree == "1" && ["cg", "q"].contains(&&*family)) {
            return Err(wrong(format!(
                "elements {family} of degree {degree} are not read: write the function interpolated to CG of degree 1"
            )));
        }
        let items: Vec<_> = node.children().filter(|it| is(it, "DataItem")).collect();
        let [dofs, values, starts, _] = items[..] else {
            return Err(wrong("expected four `<DataItem>`s".into()));
        };
        let positions_of = |node| positions(self.item(node, name)?.values);
        let (dofs, starts) = (positions_of(dofs)?, positions_of(starts)?);
        let values = self.item(values, name)?;
        let cells: Vec<&[usize]> = snapshot.cells.iter().map(|(_, points)| points).collect();
        let nodes = |cell: &[usize]| if is_of_cells { 1 } else { cell.len().max(1) };
        let rows = if is_of_cells { cells.len() } else { snapshot.rows() };
        let misfit = || wrong("its degrees of freedom do not fit the cells".into());
        let own = |at: usize| dofs.get(*starts.get(at)?..*starts.get(at + 1)?);
        let first = cells.first().zip(own(0));
        let components = first.map_or(0, |(cell, own)| own.len() / nodes(cell));
        if components == 0 || components > MOST_COMPONENTS {
            return Err(misfit());
        }
        self.wanted.reserve(&format!("`{name}`"), rows * components)?;
        let mut found = vec![f64::NAN; rows * components];
        for (cell, points) in cells.iter().enumerate() {
            let (own, nodes) = (own(cell).ok_or_else(misfit)?, nodes(points));
            if own.len() != nodes * components {
                return Err(misfit());
            }
            // All nodes of one component precede those in the next one.
            for (at, dof) in own.iter().enumerate() {
                let row = if is_of_cells { cell } else { points[at % nodes] };
                let value = *values.values.get(*dof).ok_or_else(misfit)?;
                let known = &mut found[row * components + at / nodes];
                if !known.is_nan() && *known != value {
                    return Err(wrong(format!("it has two values at the point {row}")));
                }
                *known = value;
            }
        }
        if found.iter().any(|it| it.is_nan()) {
            return Err(wrong("it has no number at a point or cell".into()));
        }
        Ok(Array { components, values: found, ..values.clone_without_values() })
    }
}
