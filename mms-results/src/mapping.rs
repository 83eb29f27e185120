//! The columns of a quantity that a user, or the profile of a code, names.

use crate::axes::Axes;
use crate::components::of_columns;
use crate::meaning::{ArrayPlace, Column, Meaning, Part, Why};
use crate::parts::{all_names, arrays, part_of};
use crate::role::{OwnRole, Role};
use crate::{Array, Mistake, Snapshot};

/// A quantity and its columns from a user: names, or `name:k` for the component k, counted from 0; `points` means the places of
/// the grid, `cells:name` an array of cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mapping {
    /// The quantity.
    pub role: Role,
    /// The columns of the quantity.
    pub columns: Vec<String>,
}

impl std::str::FromStr for Mapping {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Mapping::read(text, &[])
    }
}

impl Mapping {
    /// Parses `QUANTITY=COLUMN,..`, for a field with these quantities of its own.
    ///
    /// # Errors
    /// An unknown quantity, or no columns, in one line.
    pub fn read(text: &str, own: &[OwnRole]) -> Result<Self, String> {
        let wrong = || format!("`{text}`: expected QUANTITY=COLUMN,.., as in X=x0,y0");
        let (role, columns) = text.split_once('=').ok_or_else(wrong)?;
        let symbols = || {
            let all = Role::ALL.iter().map(|role| role.symbol());
            all.chain(own.iter().map(|own| own.name)).collect::<Vec<_>>().join(", ")
        };
        let own_role = own.iter().find(|own| own.name == role.trim());
        let known = own_role.map(|own| Role::Own(*own)).or_else(|| Role::from_name(role.trim()));
        let role = known.ok_or_else(|| format!("`{role}`: expected one of {}", symbols()))?;
        let columns: Vec<_> = columns.split(',').map(|it| it.trim().to_owned()).collect();
        if columns.iter().any(String::is_empty) {
            return Err(wrong());
        }
        Ok(Mapping { role, columns })
    }
}

/// The meaning of columns that a user names.
pub(crate) fn mapped(
    snapshot: &Snapshot,
    mapping: &Mapping,
    axes: Axes,
) -> Result<Meaning, Mistake> {
    let Mapping { role, columns: names } = mapping;
    let columns = match components(snapshot, names, axes) {
        Some(columns) => columns,
        None => {
            let columns = names.iter().map(|name| columns(snapshot, name));
            let columns = columns.collect::<Result<Vec<_>, _>>();
            let columns = columns.map_err(|mistake| mistake.of(&snapshot.path))?;
            let columns: Vec<Column> = columns.into_iter().flatten().collect();
            let parts = of_columns(snapshot, &columns, axes).filter(|_| names.len() == 1);
            let parts = parts.unwrap_or_else(|| (0..columns.len()).map(Part::Nth).collect());
            parts.into_iter().zip(columns).collect()
        }
    };
    let why = Why::Map(names.len());
    let (role, source) = (*role, names.join(","));
    Ok(Meaning { role, source, face: None, columns, why, reading: None, axes })
}

/// The arrays whose names are one name and a component, such as `stress_xx` for `stress`, if no array has that name itself.
pub(crate) fn components(
    snapshot: &Snapshot,
    names: &[String],
    axes: Axes,
) -> Option<Vec<(Part, Column)>> {
    let [name] = names else { return None };
    if arrays(snapshot).any(|(_, array)| array.name == *name) {
        return None;
    }
    let part = |(place, array): (ArrayPlace, &Array)| {
        let part = part_of(&array.name, name, axes).filter(|_| array.components == 1)?;
        Some((part, Column { place, component: 0 }))
    };
    let found: Vec<_> = arrays(snapshot).filter_map(part).collect();
    (!found.is_empty()).then_some(found)
}

/// The array of this name, with all its columns.
pub(crate) fn whole<'a>(snapshot: &'a Snapshot, name: &str) -> Option<(&'a Array, Vec<Column>)> {
    let bare = |name: &'_ str| name.trim_start_matches('/').to_owned();
    let is_called = |array: &Array| array.name == name || bare(&array.name) == bare(name);
    let (place, array) = arrays(snapshot).find(|(place, array)| match place {
        ArrayPlace::Grid => name == "points" || array.name == name,
        ArrayPlace::Points(_) => is_called(array),
        ArrayPlace::Cells(_) => {
            is_called(array) || name.strip_prefix("cells:") == Some(&array.name)
        }
    })?;
    let columns = (0..array.components).map(|component| Column { place, component });
    Some((array, columns.collect()))
}

/// The columns of an array, or one of them.
fn columns(snapshot: &Snapshot, name: &str) -> Result<Vec<Column>, Mistake> {
    if let Some((_, columns)) = whole(snapshot, name) {
        return Ok(columns);
    }
    let one = name.rsplit_once(':').and_then(|(name, component)| {
        let (_, columns) = whole(snapshot, name)?;
        columns.get(component.parse::<usize>().ok()?).copied()
    });
    let one = one.ok_or_else(|| {
        Mistake::new(format!("`--map`: no array `{name}`; the file has {}", all_names(snapshot)))
    });
    Ok(vec![one?])
}
