//! The meanings of arrays: by their names, by a user's mapping, and by the profile of a code.

use crate::components::parts;
use crate::mapping::mapped;
use crate::meaning::{ArrayPlace, Column, Part, array};
use crate::parts::{S, arrays, part_of, split, stem, two_meanings};
use crate::role::plain;
use crate::wanted::{Need, Wanted};
use crate::{Array, Mistake, Snapshot};

pub use crate::axes::Axes;
pub use crate::mapping::Mapping;
pub use crate::meaning::{Meaning, Values, Why};
pub use crate::parts::all_names;
pub use crate::profile::Profile;
pub use crate::role::{Form, OwnRole, Role};

/// The name of a given pressure.
const GIVEN_PRESSURE: &str = "p";

/// Faces that the name of a traction may end with.
const FACES: [&str; 12] = [
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
    "r_min",
    "r_max",
];

/// The parsed name of an array.
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

/// The names of arrays: the columns of tables without a header, a user's mapping, and the profile of a code.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// The quantities that a user maps.
    pub map: Vec<Mapping>,
    /// The names of the columns of tables without a header; if empty, the names in the header.
    pub columns: Vec<String>,
    /// The profile of the code that wrote the files.
    pub profile: Option<Profile>,
    /// The field's own quantities, whose names take precedence over the names of codes.
    pub own: Vec<OwnRole>,
    /// The letters of components.
    pub axes: Axes,
}

/// The names that codes use, without any from a user.
pub static KNOWN: Names = Names {
    map: Vec::new(),
    columns: Vec::new(),
    profile: None,
    own: Vec::new(),
    axes: Axes::Cartesian,
};

impl Names {
    /// Whether a user maps an array of this name, or a component of it.
    fn is_mapped(&self, name: &str) -> bool {
        let is_it = |column: &String| {
            let bare = column.strip_prefix("cells:").unwrap_or(column);
            let whole = bare.rsplit_once(':').map_or(bare, |(whole, _)| whole);
            // A path in HDF5 may begin with a slash.
            let from_root = |it: &str| it.trim_start_matches('/') == name.trim_start_matches('/');
            let is_part = part_of(name, bare, self.axes).is_some();
            column == name || from_root(bare) || from_root(whole) || is_part
        };
        self.map.iter().flat_map(|mapping| &mapping.columns).any(is_it)
    }

    /// The role of a name: a quantity of the field's own, or the usual meaning in codes.
    fn called(&self, name: &str) -> Option<Role> {
        let own = self.own.iter().find(|own| own.name == name);
        own.map(|own| Role::Own(*own)).or_else(|| Role::called(name))
    }

    /// The two possible meanings of an ambiguous name. `pressure` may be the pressure of the stress, or a given `p`.
    fn two_meanings(&self, name: &str) -> Option<[Role; 2]> {
        let given = self.own.iter().find(|own| own.name == GIVEN_PRESSURE);
        match given.filter(|_| plain(name) == "pressure") {
            Some(given) => Some([Role::Pressure, Role::Own(*given)]),
            None => two_meanings(name, self.axes)
                .filter(|_| self.own.iter().all(|own| own.name != name)),
        }
    }

    /// The position and the coordinate that an array with a name of one letter contains.
    fn coordinate(&self, name: &str) -> Option<(Role, Part)> {
        let ([letter], None) = (name.as_bytes(), name.parse::<u8>().ok()) else { return None };
        let axis = self.axes.of(*letter).filter(|it| *it < 2 || self.axes == Axes::Cartesian)?;
        let role = if letter.is_ascii_uppercase() { Role::Reference } else { Role::Place };
        Some((role, Part::Nth(axis)))
    }

    /// The roles that an array of this name may have.
    fn roles(&self, name: &str) -> Vec<Role> {
        let stem = stem(name, self.axes);
        let mut roles: Vec<Role> = self.two_meanings(name).into_iter().flatten().collect();
        let of_profile = self.profile.iter().flat_map(|it| &it.quantities);
        let is_called = |names: &[String]| {
            names.iter().any(|it| it == name || part_of(name, it, self.axes).is_some())
        };
        roles.extend(of_profile.filter(|(_, names)| is_called(names)).map(|(role, _)| *role));
        roles.extend(self.called(name));
        roles.extend(self.called(stem).filter(|role| role.form() != Form::Scalar));
        match name {
            _ if let Some((role, _)) = self.coordinate(name) => roles.push(role),
            _ if name.starts_with("traction_") => roles.push(Role::Traction),
            _ => {}
        }
        roles
    }
}

/// The arrays to read from files for these roles, and the mapped ones.
pub fn wanted<'a>(names: &'a Names, wants: &'a dyn Fn(Role) -> bool) -> Wanted<'a> {
    let need = move |name: &str| {
        let roles = names.roles(name);
        match names.is_mapped(name) || roles.iter().any(|role| wants(*role)) {
            true => Need::Must,
            false if roles.is_empty() => Need::No,
            false => Need::Sound,
        }
    };
    Wanted::new(need).named(&names.columns)
}

/// All arrays of files.
pub fn everything(names: &Names) -> Wanted<'_> {
    let need = move |name: &str| match names.is_mapped(name) || !names.roles(name).is_empty() {
        true => Need::Must,
        false => Need::Numbers,
    };
    Wanted::new(need).named(&names.columns)
}

/// Finds the meanings of arrays. Ignores arrays with unknown names, and components of mapped arrays. A user's mapping takes
/// precedence over a profile, and a profile over the names of codes.
///
/// # Errors
/// A name that may mean two quantities, of those that `wants` takes; two arrays that may be the same quantity; a
/// mapping to an array that is not there.
pub fn recognise(
    snapshot: &Snapshot,
    names: &Names,
    wants: &dyn Fn(Role) -> bool,
) -> Result<Vec<Meaning>, Mistake> {
    let mut found = Vec::new();
    for mapping in &names.map {
        found.push(mapped(snapshot, mapping, names.axes)?);
    }
    if let Some(profile) = &names.profile {
        let is_left = |role: Role| wants(role) && names.map.iter().all(|it| it.role != role);
        found.extend(profile.meanings(snapshot, names.axes, &is_left));
    }
    let named: Vec<Role> = found.iter().map(|it: &Meaning| it.role).collect();
    let taken: Vec<ArrayPlace> =
        found.iter().flat_map(|it| it.columns.iter().map(|(_, column)| column.place)).collect();
    let settled: Vec<String> =
        taken.iter().filter_map(|it| group(names, *it, array(snapshot, *it))).collect();
    for (place, array) in arrays(snapshot).filter(|(place, _)| !taken.contains(place)) {
        if group(names, place, array).is_some_and(|it| settled.contains(&it)) {
            continue;
        }
        let is_wanted = |role: Role| wants(role) && !named.contains(&role);
        validate_clear(snapshot, names, (place, array), &named, &is_wanted)
            .map_err(|mistake| mistake.of(&snapshot.path))?;
        let understood = understand(names, place, array).filter(|it| is_wanted(it.role));
        let Some(understood) = understood else { continue };
        let column = |component| Column { place, component };
        let all = || match &names.profile {
            Some(profile) => profile.parts(understood.role, array, names.axes),
            None => parts(array, names.axes),
        };
        let columns: Vec<_> = match understood.part {
            Some(part) => vec![(part, column(0))],
            None => all().into_iter().enumerate().map(|(at, it)| (it, column(at))).collect(),
        };
        add(&mut found, understood, columns, (array, names.axes))
            .map_err(|it| it.of(&snapshot.path))?;
    }
    if let Some(profile) = &names.profile {
        let places = found.iter_mut().filter(|it| it.role == Role::Place);
        places.for_each(|it| it.reading = profile.points.map(|role| (role, profile.name.clone())));
    }
    Ok(found)
}

/// The common name of the components to which an array belongs, if it is a component.
fn group(names: &Names, place: ArrayPlace, array: &Array) -> Option<String> {
    match understand(names, place, array) {
        Some(Understood { part, source, .. }) => part.map(|_| source),
        None => split(&array.name, names.axes)
            .filter(|_| array.components == 1)
            .map(|(base, _)| base.into()),
    }
}

/// The name of an array of points or of cells in `--map`.
fn mapped_name(place: ArrayPlace, name: &str) -> String {
    if matches!(place, ArrayPlace::Cells(_)) { format!("cells:{name}") } else { name.to_owned() }
}

/// Adds an array to the meanings found, or to the components of one of them.
///
/// # Errors
/// Two arrays for one quantity, or for one component of it.
fn add(
    found: &mut Vec<Meaning>,
    understood: Understood,
    columns: Vec<(Part, Column)>,
    (array, axes): (&Array, Axes),
) -> Result<(), Mistake> {
    let Understood { role, part, source, face } = understood;
    let Some(known) = found.iter_mut().find(|it| it.role == role && it.face == face) else {
        let why = Why::Name;
        found.push(Meaning { role, source, face, columns, why, reading: None, axes });
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
        "both `{}` and `{other}` may be {role}: say which with `--map {symbol}={}` or `--map {symbol}={}`",
        known.source,
        known.columns.first().map_or(String::new(), |(_, it)| mapped_name(it.place, &known.source)),
        columns.first().map_or(String::new(), |(_, it)| mapped_name(it.place, &source))
    )))
}

/// Refuses a name that may mean two quantities, one of which is wanted.
///
/// # Errors
/// A name that neither the file nor the user resolves.
fn validate_clear(
    snapshot: &Snapshot,
    names: &Names,
    (place, array): (ArrayPlace, &Array),
    named: &[Role],
    wants: &dyn Fn(Role) -> bool,
) -> Result<(), Mistake> {
    let Some([a, b]) = names.two_meanings(&array.name) else { return Ok(()) };
    let stem = stem(&array.name, names.axes);
    if stem == S {
        // If a file has another name for a stress, S means the textbook's S.
        let is_stress = |role: &Role| {
            matches!(role, Role::CauchyStress | Role::FirstPiolaKirchhoff | Role::KirchhoffStress)
        };
        let called =
            arrays(snapshot).filter_map(|(_, it)| Role::called(self::stem(&it.name, names.axes)));
        if called.chain(named.iter().copied()).any(|it| is_stress(&it)) {
            return Ok(());
        }
    }
    if !(wants(a) || wants(b)) {
        return Ok(());
    }
    let mapped = mapped_name(place, stem);
    // The symbol of a pressure is the name of a given pressure.
    let word = |role: Role| match role {
        Role::Pressure => role.name(),
        _ => role.symbol(),
    };
    let said = |role: Role| format!("`--map {}={mapped}`", word(role));
    let what = format!(
        "`{}` ({}) may be {} or {}: say which with {} or {}, or the code that wrote it with `--from`",
        array.name,
        array.described(),
        a.name(),
        b.name(),
        said(a),
        said(b)
    );
    Err(Mistake::new(what))
}

/// The quantity of an array, its part, and the name in the file.
fn understand(names: &Names, place: ArrayPlace, array: &Array) -> Option<Understood> {
    let name = array.name.as_str();
    match (place, name) {
        // The solver of this project writes x under this name.
        (ArrayPlace::Grid, "position") => return Some(Understood::new(Role::Position, None, name)),
        (ArrayPlace::Grid, "reference_position") => {
            return Some(Understood::new(Role::Reference, None, name));
        }
        (ArrayPlace::Grid, _) => return Some(Understood::new(Role::Place, None, "points")),
        // Coordinates in separate columns.
        _ if array.components == 1
            && let Some((role, part)) = names.coordinate(name) =>
        {
            let source = if role == Role::Reference { "X" } else { "x" };
            return Some(Understood::new(role, Some(part), source));
        }
        _ => {}
    }
    if let Some(role) = names.called(name) {
        return Some(Understood::new(role, None, name));
    }
    if let Some(found) = on_face(array, names.axes) {
        return Some(found);
    }
    let (base, part) = split(name, names.axes).filter(|_| array.components == 1)?;
    let role = names.called(base).filter(|role| role.form() != Form::Scalar)?;
    // x0 may be the first coordinate, or the initial x.
    let is_coordinate = base.len() == 1 && matches!(role, Role::Place | Role::Reference);
    (!is_coordinate || name.len() > 2).then(|| Understood::new(role, Some(part), base))
}

/// The traction of a face, such as `traction_x_max`, or a component of it, such as `traction_x_max_y`.
fn on_face(array: &Array, axes: Axes) -> Option<Understood> {
    let rest = array.name.strip_prefix("traction_")?;
    let found = FACES.into_iter().find_map(|face| Some((face, rest.strip_prefix(face)?)));
    let (face, end) = found?;
    let part = match end {
        "" => None,
        _ => {
            let one = end.strip_prefix('_').filter(|_| array.components == 1)?;
            Some(part_of(one, "", axes).filter(|it| matches!(it, Part::Nth(_)))?)
        }
    };
    Some(Understood {
        face: Some(face),
        ..Understood::new(Role::Traction, part, format!("traction_{face}"))
    })
}
