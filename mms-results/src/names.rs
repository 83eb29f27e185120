//! What the names of arrays mean: names that codes use, and those that a user maps.

use crate::components::{of_columns, parts};
use crate::meaning::{Column, Part, Place, array};
use crate::role::plain;
use crate::wanted::{Need, Wanted};
use crate::{Array, Mistake, Snapshot};

pub use crate::meaning::{Meaning, Values};
pub use crate::role::{Form, Role};

/// Names that may mean two quantities.
const UNCLEAR: &[(&str, [Role; 2])] = &[
    ("stress", [Role::CauchyStress, Role::FirstPiolaKirchhoff]),
    ("stresses", [Role::CauchyStress, Role::FirstPiolaKirchhoff]),
    ("piola", [Role::FirstPiolaKirchhoff, Role::SecondPiolaKirchhoff]),
];

/// Faces that the name of a traction may end with.
const FACES: [&str; 10] = [
    "x_min",
    "x_max",
    "y_min",
    "y_max",
    "z_min",
    "z_max",
    "inner",
    "outer",
    "theta_min",
    "theta_max",
];

/// What the name of an array says.
struct Understood {
    role: Role,
    part: Option<Part>,
    source: String,
    face: Option<&'static str>,
}

impl Understood {
    fn new(role: Role, part: Option<Part>, source: impl Into<String>) -> Self {
        Understood { role, part, source: source.into(), face: None }
    }
}

/// A quantity and the columns that a user says it is: names, or `name:k` for the component k, counted from 0; `points`
/// are the places of the grid, `cells:name` is an array of cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mapping {
    /// The quantity.
    pub role: Role,
    /// Its columns.
    pub columns: Vec<String>,
}

impl std::str::FromStr for Mapping {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}`: expected QUANTITY=COLUMN,.., as in X=x0,y0");
        let (role, columns) = text.split_once('=').ok_or_else(wrong)?;
        let symbols = || Role::ALL.iter().map(|role| role.symbol()).collect::<Vec<_>>().join(", ");
        let known = Role::from_name(role.trim());
        let role = known.ok_or_else(|| format!("`{role}`: expected one of {}", symbols()))?;
        let columns: Vec<_> = columns.split(',').map(|it| it.trim().to_owned()).collect();
        if columns.iter().any(String::is_empty) {
            return Err(wrong());
        }
        Ok(Mapping { role, columns })
    }
}

/// The arrays to read of files in which these roles are looked for, and those of `map`.
pub fn wanted<'a>(map: &'a [Mapping], wants: &'a dyn Fn(Role) -> bool) -> Wanted<'a> {
    Wanted::new(move |name| {
        let roles = meant(name);
        match is_mapped_by(map, name) || roles.iter().any(|role| wants(*role)) {
            true => Need::Must,
            false if roles.is_empty() => Need::No,
            false => Need::Sound,
        }
    })
}

/// Reads all that files hold.
pub fn everything(map: &[Mapping]) -> Wanted<'_> {
    Wanted::new(move |name| match is_mapped_by(map, name) || !meant(name).is_empty() {
        true => Need::Must,
        false => Need::Numbers,
    })
}

/// Whether a user maps an array of this name, or a component of it.
fn is_mapped_by(map: &[Mapping], name: &str) -> bool {
    let stem = stem(name);
    let is_it = |column: &String| {
        let bare = column.strip_prefix("cells:").unwrap_or(column);
        let whole = bare.rsplit_once(':').map_or(bare, |(whole, _)| whole);
        column == name || [bare, whole].contains(&name) || bare == stem
    };
    map.iter().flat_map(|mapping| &mapping.columns).any(is_it)
}

/// The roles that an array of this name may have.
fn meant(name: &str) -> Vec<Role> {
    let stem = stem(name);
    let unclear = UNCLEAR.iter().filter(|(word, _)| *word == plain(stem));
    let mut roles: Vec<Role> = unclear.flat_map(|(_, roles)| *roles).collect();
    roles.extend(Role::called(name));
    roles.extend(Role::called(stem).filter(|role| role.form() != Form::Scalar));
    match name {
        "X" | "Y" | "Z" => roles.push(Role::Reference),
        "x" | "y" | "z" => roles.push(Role::Place),
        _ if name.starts_with("traction_") => roles.push(Role::Traction),
        _ => {}
    }
    roles
}

/// A name without what says which component it is.
fn stem(name: &str) -> &str {
    split(name).map_or(name, |(base, _)| base)
}

/// Says what arrays of a snapshot mean; those with names that are not known are left out, and those that have a part of
/// their name in common with what is mapped.
///
/// # Errors
/// A name that may mean two quantities, of those that `wants` takes; two arrays that may be the same quantity; a
/// mapping to an array that is not there.
pub fn recognise(
    snapshot: &Snapshot,
    map: &[Mapping],
    wants: &dyn Fn(Role) -> bool,
) -> Result<Vec<Meaning>, Mistake> {
    let mut found: Vec<Meaning> = Vec::new();
    for mapping in map {
        found.push(mapped(snapshot, mapping)?);
    }
    let is_mapped = |role: Role| map.iter().any(|mapping| mapping.role == role);
    let taken: Vec<Place> =
        found.iter().flat_map(|it| it.columns.iter().map(|(_, column)| column.place)).collect();
    let settled: Vec<String> =
        taken.iter().filter_map(|it| group(*it, array(snapshot, *it))).collect();
    for (place, array) in arrays(snapshot).filter(|(place, _)| !taken.contains(place)) {
        if group(place, array).is_some_and(|it| settled.contains(&it)) {
            continue;
        }
        hold_clear(&array.name, &|role| wants(role) && !is_mapped(role))
            .map_err(|mistake| mistake.of(&snapshot.path))?;
        let Some(understood) = understand(place, array) else { continue };
        if is_mapped(understood.role) || !wants(understood.role) {
            continue;
        }
        let column = |component| Column { place, component };
        let columns: Vec<_> = match understood.part {
            Some(part) => vec![(part, column(0))],
            None => parts(array).into_iter().enumerate().map(|(at, it)| (it, column(at))).collect(),
        };
        add(&mut found, understood, columns, array).map_err(|it| it.of(&snapshot.path))?;
    }
    Ok(found)
}

/// The name of all components of which an array is one, if it is.
fn group(place: Place, array: &Array) -> Option<String> {
    match understand(place, array) {
        Some(Understood { part, source, .. }) => part.map(|_| source),
        None => split(&array.name).filter(|_| array.components == 1).map(|(base, _)| base.into()),
    }
}

/// Adds an array to what was found, or to the components of what it is one of.
///
/// # Errors
/// Two arrays for one quantity, or for one component of it.
fn add(
    found: &mut Vec<Meaning>,
    understood: Understood,
    columns: Vec<(Part, Column)>,
    array: &Array,
) -> Result<(), Mistake> {
    let Understood { role, part, source, face } = understood;
    let Some(known) = found.iter_mut().find(|it| it.role == role && it.face == face) else {
        found.push(Meaning { role, source, face, columns, mapped: 0 });
        return Ok(());
    };
    let is_component = part.is_some() && known.source == source;
    if is_component && !known.columns.iter().any(|(it, _)| Some(*it) == part) {
        known.columns.extend(columns);
        return Ok(());
    }
    let (role, symbol) = (role.name(), role.symbol());
    let other = if known.source == source { &array.name } else { &source };
    Err(Mistake::new(format!(
        "both `{}` and `{other}` may be {role}: say which with `--map {symbol}=NAME`; an array of cells is `cells:NAME`",
        known.source
    )))
}

/// All arrays, with the places of points first.
fn arrays(snapshot: &Snapshot) -> impl Iterator<Item = (Place, &Array)> + Clone {
    let grid = snapshot.points.iter().map(|array| (Place::Grid, array));
    let points =
        snapshot.of_points.iter().enumerate().map(|(at, array)| (Place::Points(at), array));
    let cells = snapshot.of_cells.iter().enumerate().map(|(at, array)| (Place::Cells(at), array));
    grid.chain(points).chain(cells)
}

/// How many names a message lists.
const MOST_LISTED: usize = 30;

/// The names of all arrays.
pub fn all_names(snapshot: &Snapshot) -> String {
    let names = arrays(snapshot).map(|(_, array)| &array.name).chain(&snapshot.unread);
    let listed: Vec<_> = names.clone().take(MOST_LISTED).map(|it| format!("`{it}`")).collect();
    match names.count() {
        0 => "no arrays".into(),
        count if count > listed.len() => {
            format!("{} and {} others", listed.join(", "), count - listed.len())
        }
        _ => listed.join(", "),
    }
}

fn hold_clear(name: &str, wants: &dyn Fn(Role) -> bool) -> Result<(), Mistake> {
    let stem = stem(name);
    let plain = plain(stem);
    let meant = UNCLEAR.iter().find(|(word, _)| *word == plain);
    match meant {
        Some((_, [a, b])) if wants(*a) || wants(*b) => Err(Mistake::new(format!(
            "`{name}` may be {} or {}: say which with `--map {}={stem}` or `--map {}={stem}`",
            a.name(),
            b.name(),
            a.symbol(),
            b.symbol()
        ))),
        _ => Ok(()),
    }
}

/// What an array is, which part of it, and under which name.
fn understand(place: Place, array: &Array) -> Option<Understood> {
    let name = array.name.as_str();
    match (place, name) {
        // So the project's own runs call x.
        (Place::Grid, "position") => return Some(Understood::new(Role::Position, None, name)),
        (Place::Grid, "reference_position") => {
            return Some(Understood::new(Role::Reference, None, name));
        }
        (Place::Grid, _) => return Some(Understood::new(Role::Place, None, "points")),
        // Coordinates in columns of their own.
        (_, "X" | "Y" | "Z") if array.components == 1 => {
            return Some(Understood::new(Role::Reference, Some(Part::Nth(letter(name)?)), "X"));
        }
        (_, "x" | "y" | "z") if array.components == 1 => {
            return Some(Understood::new(Role::Place, Some(Part::Nth(letter(name)?)), "x"));
        }
        _ => {}
    }
    if let Some(role) = Role::called(name) {
        return Some(Understood::new(role, None, name));
    }
    if let Some(found) = on_face(array) {
        return Some(found);
    }
    let (base, part) = split(name).filter(|_| array.components == 1)?;
    let role = Role::called(base).filter(|role| role.form() != Form::Scalar)?;
    // x0 may be the first coordinate, or where x was.
    let is_coordinate = base.len() == 1 && matches!(role, Role::Place | Role::Reference);
    (!is_coordinate || name.len() > 2).then(|| Understood::new(role, Some(part), base))
}

/// The traction of a face, as `traction_x_max`, or a component of it, as `traction_x_max_y`.
fn on_face(array: &Array) -> Option<Understood> {
    let rest = array.name.strip_prefix("traction_")?;
    let found = FACES.into_iter().find_map(|face| Some((face, rest.strip_prefix(face)?)));
    let (face, end) = found?;
    let part = match end {
        "" => None,
        _ => Some(Part::Nth(letter(end.strip_prefix('_').filter(|_| array.components == 1)?)?)),
    };
    Some(Understood {
        face: Some(face),
        ..Understood::new(Role::Traction, part, format!("traction_{face}"))
    })
}

fn letter(text: &str) -> Option<usize> {
    ["x", "y", "z"].iter().position(|it| text.eq_ignore_ascii_case(it))
}

/// A name without what says which component it is.
fn split(name: &str) -> Option<(&str, Part)> {
    let name = name.strip_suffix([']', ')']).unwrap_or(name);
    let axis = |byte: u8| match byte {
        b'x' | b'X' => Some(0),
        b'y' | b'Y' => Some(1),
        b'z' | b'Z' => Some(2),
        b'0'..=b'9' => Some(usize::from(byte - b'0')),
        _ => None,
    };
    let (before, last) = name.split_at_checked(name.len().checked_sub(1)?)?;
    let last = axis(last.bytes().next()?)?;
    let base = |text: &'_ str| -> usize {
        text.trim_end_matches(['_', ':', '.', '[', '(', '-', ' ']).len()
    };
    let of_entry =
        before.split_at_checked(before.len().saturating_sub(1)).and_then(|(rest, first)| {
            let first = axis(first.bytes().next()?)?;
            Some((&rest[..base(rest)], Part::Entry(first, last)))
        });
    let found = of_entry.filter(|(base, _)| has_entries(base));
    let found = found.unwrap_or((&before[..base(before)], Part::Nth(last)));
    (!found.0.is_empty()).then_some(found)
}

/// Whether this may be the name of a matrix.
fn has_entries(name: &str) -> bool {
    let is_matrix = |role: &Role| !matches!(role.form(), Form::Scalar | Form::Vector);
    Role::called(name).as_ref().is_some_and(is_matrix)
        || UNCLEAR.iter().any(|(word, _)| *word == plain(name))
}

/// What a user says a quantity is.
fn mapped(snapshot: &Snapshot, mapping: &Mapping) -> Result<Meaning, Mistake> {
    let Mapping { role, columns: names } = mapping;
    let columns = match components(snapshot, names) {
        Some(columns) => columns,
        None => {
            let columns = names.iter().map(|name| columns(snapshot, name));
            let columns = columns.collect::<Result<Vec<_>, _>>();
            let columns = columns.map_err(|mistake| mistake.of(&snapshot.path))?;
            let columns: Vec<Column> = columns.into_iter().flatten().collect();
            let parts = of_columns(snapshot, &columns).filter(|_| names.len() == 1);
            let parts = parts.unwrap_or_else(|| (0..columns.len()).map(Part::Nth).collect());
            parts.into_iter().zip(columns).collect()
        }
    };
    let mapped = names.len();
    Ok(Meaning { role: *role, source: names.join(","), face: None, columns, mapped })
}

/// The arrays whose names are one name and a component, as `stress_xx` is of `stress`, if no array has that name itself.
fn components(snapshot: &Snapshot, names: &[String]) -> Option<Vec<(Part, Column)>> {
    let [name] = names else { return None };
    if arrays(snapshot).any(|(_, array)| array.name == *name) {
        return None;
    }
    let part = |(place, array): (Place, &Array)| {
        let (base, part) = split(&array.name).filter(|_| array.components == 1)?;
        (base == name).then_some((part, Column { place, component: 0 }))
    };
    let found: Vec<_> = arrays(snapshot).filter_map(part).collect();
    (!found.is_empty()).then_some(found)
}

/// The columns of an array, or one of them.
fn columns(snapshot: &Snapshot, name: &str) -> Result<Vec<Column>, Mistake> {
    let named = |wanted: &str| {
        arrays(snapshot).find(|(place, array)| match place {
            Place::Grid => wanted == "points" || wanted == array.name,
            Place::Points(_) => wanted == array.name,
            Place::Cells(_) => {
                wanted == array.name || wanted.strip_prefix("cells:") == Some(&array.name)
            }
        })
    };
    let all = |(place, array): (Place, &Array)| {
        (0..array.components).map(|component| Column { place, component }).collect()
    };
    if let Some(found) = named(name) {
        return Ok(all(found));
    }
    let one = name.rsplit_once(':').and_then(|(name, component)| {
        let (found, component) = (named(name)?, component.parse().ok()?);
        (component < found.1.components).then_some(Column { place: found.0, component })
    });
    let one = one.ok_or_else(|| {
        Mistake::new(format!("`--map`: no array `{name}`; the file has {}", all_names(snapshot)))
    });
    Ok(vec![one?])
}
