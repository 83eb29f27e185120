//! The profile of a code: the names, the order of components and the positions in its files.
//!
//! A profile decides only what the numbers and names in a file leave open. If points lie in the body with one reading alone,
//! they have this reading, and components that a file names keep their names.

use crate::axes::Axes;
use crate::components::{has_names, parts};
use crate::mapping::{components, whole};
use crate::meaning::{Meaning, Part, Why};
use crate::role::{Form, Role};
use crate::{Array, Snapshot};

/// The rows and columns of a symmetric tensor's entries, counted from 0, in the order of an array's components.
pub type ComponentOrder = Vec<(usize, usize)>;

/// The names and orders that a code is known to write.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// The name of the code.
    pub name: String,
    /// The position of points that lie in the body with both readings: X or x.
    pub points: Option<Role>,
    /// The names of arrays, the usual one first.
    pub quantities: Vec<(Role, Vec<String>)>,
    /// The orders of symmetric tensors without component names, each for arrays with as many components.
    pub orders: Vec<ComponentOrder>,
}

impl Profile {
    /// The profile of this project, whose S is the second Piola-Kirchhoff stress.
    pub fn symbols() -> Profile {
        let role = Role::SecondPiolaKirchhoff;
        let quantities = vec![(role, vec![role.symbol().to_owned()])];
        Profile { name: "mms".to_owned(), quantities, ..Profile::default() }
    }

    /// The parts of a quantity in the components of an array: by the names in the file, otherwise by the order for their
    /// number.
    pub(crate) fn parts(&self, role: Role, array: &Array, axes: Axes) -> Vec<Part> {
        let is_open = role.form() == Form::Symmetric && !has_names(array, axes);
        let order = self.orders.iter().find(|it| is_open && it.len() == array.components);
        match order {
            Some(order) => order.iter().map(|&(row, column)| Part::Entry(row, column)).collect(),
            None => parts(array, axes),
        }
    }

    /// The quantities that the profile names, `wants` accepts and the snapshot contains.
    pub(crate) fn meanings(
        &self,
        snapshot: &Snapshot,
        axes: Axes,
        wants: &dyn Fn(Role) -> bool,
    ) -> Vec<Meaning> {
        let mut found = Vec::new();
        for (role, names) in self.quantities.iter().filter(|(role, _)| wants(*role)) {
            let found_here = names.iter().find_map(|name| {
                let one = std::slice::from_ref(name);
                if let Some(columns) = components(snapshot, one, axes) {
                    return Some((name, columns));
                }
                let (array, columns) = whole(snapshot, name)?;
                let parts = self.parts(*role, array, axes);
                Some((name, parts.into_iter().zip(columns).collect()))
            });
            let Some((name, columns)) = found_here else { continue };
            let why = Why::Profile(self.name.clone());
            found.push(Meaning {
                role: *role,
                source: name.clone(),
                face: None,
                columns,
                why,
                reading: None,
                axes,
            });
        }
        found
    }
}
