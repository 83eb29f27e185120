//! Checks that the units of a file belong to one system.
//!
//! Values are used as written. That is right in any system of units in which products have the size of the product of their
//! factors, such as (m, kg, s, N, Pa) or (mm, tonne, s, N, MPa). So there must be one size for each base dimension from which
//! the sizes of all symbols follow. The logarithms of these sizes solve a linear system with one equation for each symbol, and
//! it must have a solution.
//!
//! The time t belongs to the system too: it is in seconds, unless a symbol of the file is a unit of time, such as `ms`.
//!
//! Derived values are then in units of the same system ([`own`]), for the system determines the size of each unit whose
//! dimension is a product of powers of the parameters' dimensions.

use std::collections::BTreeMap;

use super::dimension::{BASE, Dimension};
use super::known::{self, Size};
use super::parse::{Symbol, Unit};
use crate::diagnostic::Diagnostic;
use dashu_ratio::RBig as Rational;

/// The logarithm of a size: its exponents of 10 and of 60.
const SIZES: usize = 2;

/// The origin of an equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Origin {
    /// The symbol at this position.
    Symbol(usize),
    /// The second as the unit of t, if no symbol is a unit of time.
    Seconds,
}

/// An equation between logarithms of sizes: exponents of the base dimensions, then the right side.
struct Equation {
    dimensions: [Rational; BASE.len()],
    sizes: [Rational; SIZES],
    /// The equations that it is a combination of, with their multiples.
    origin: BTreeMap<Origin, Rational>,
}

impl Equation {
    fn of(symbol: &Symbol, position: usize) -> Self {
        let sizes = [symbol.size.tens, symbol.size.sixties].map(Rational::from);
        let dimensions = symbol.dimension.exponents().clone();
        Equation {
            dimensions,
            sizes,
            origin: BTreeMap::from([(Origin::Symbol(position), Rational::ONE)]),
        }
    }

    /// The unit of t is the second.
    fn seconds() -> Self {
        let dimensions = Dimension::time().exponents().clone();
        let origin = BTreeMap::from([(Origin::Seconds, Rational::ONE)]);
        Equation { dimensions, sizes: [Rational::ZERO; SIZES], origin }
    }

    fn pivot(&self) -> Option<usize> {
        self.dimensions.iter().position(|exponent| !exponent.is_zero())
    }

    /// Subtracts the multiple of another equation that removes its pivot from this one.
    fn eliminate(&mut self, other: &Equation) {
        let Some(pivot) = other.pivot() else { return };
        let factor = &self.dimensions[pivot] / &other.dimensions[pivot];
        let subtract = |a: &mut Rational, b: &Rational| *a = &*a - b * &factor;
        self.dimensions.iter_mut().zip(&other.dimensions).for_each(|(a, b)| subtract(a, b));
        self.sizes.iter_mut().zip(&other.sizes).for_each(|(a, b)| subtract(a, b));
        for (position, multiple) in &other.origin {
            subtract(self.origin.entry(*position).or_insert(Rational::ZERO), multiple);
        }
        self.origin.retain(|_, multiple| !multiple.is_zero());
    }
}

/// Reports the first symbol that does not belong to one system with those before it.
pub fn consistent<'a>(units: impl IntoIterator<Item = &'a Unit>) -> Option<Diagnostic> {
    let mut symbols: Vec<&Symbol> = Vec::new();
    for symbol in units.into_iter().flat_map(|unit| &unit.symbols) {
        if !symbols.iter().any(|known| known.symbol.value == symbol.symbol.value) {
            symbols.push(symbol);
        }
    }
    let mut equations: Vec<Equation> = Vec::new();
    if !symbols.iter().any(|symbol| is_of_time(symbol)) {
        equations.push(Equation::seconds());
    }
    for (position, symbol) in symbols.iter().enumerate() {
        let mut equation = Equation::of(symbol, position);
        for known in &equations {
            equation.eliminate(known);
        }
        if equation.pivot().is_some() {
            equations.push(equation);
        } else if equation.sizes.iter().any(|size| !size.is_zero()) {
            let symbol = |origin: &Origin| match origin {
                Origin::Symbol(position) => Some(symbols[*position]),
                Origin::Seconds => None,
            };
            let involved: Vec<_> = equation.origin.keys().filter_map(symbol).collect();
            return mixture(&involved, equation.origin.contains_key(&Origin::Seconds));
        }
    }
    None
}

/// The unit of the system of `units` that replaces the SI unit `si`: with `mm` and `MPa`, `Pa/m` becomes `MPa/mm`. `None` if
/// the units do not determine its size, or have no name for it. Without units, or with SI units, it stays `si`.
pub fn own(units: &[Unit], si: &str) -> Option<String> {
    let symbols: Vec<&Symbol> = units.iter().flat_map(|unit| &unit.symbols).collect();
    if symbols.iter().all(|symbol| symbol.size == Size::SI) {
        return Some(si.to_owned());
    }
    let mut equations: Vec<Equation> = Vec::new();
    if !symbols.iter().any(|symbol| is_of_time(symbol)) {
        equations.push(Equation::seconds());
    }
    for (position, symbol) in symbols.iter().enumerate() {
        let mut equation = Equation::of(symbol, position);
        equations.iter().for_each(|known| equation.eliminate(known));
        if equation.pivot().is_some() {
            equations.push(equation);
        }
    }
    let mut own = si.to_owned();
    // Replaced from the end, so that earlier places stay valid.
    for symbol in Unit::known(si)?.symbols.iter().rev() {
        let size = size(&equations, &symbol.dimension)?;
        let is_it = |other: &&&Symbol| other.dimension == symbol.dimension && other.size == size;
        let of_file = symbols.iter().find(is_it).map(|it| it.symbol.value.clone());
        let name = of_file.or_else(|| known::name(&symbol.dimension, size))?;
        let text = &symbol.symbol.value;
        let at = own.find(text.as_str())?;
        own.replace_range(at..at + text.len(), &name);
    }
    Some(own)
}

/// The size of the unit of a dimension in a system, if the system determines it.
fn size(equations: &[Equation], dimension: &Dimension) -> Option<Size> {
    let mut wanted = Equation {
        dimensions: dimension.exponents().clone(),
        sizes: [Rational::ZERO; SIZES],
        origin: BTreeMap::new(),
    };
    equations.iter().for_each(|known| wanted.eliminate(known));
    if wanted.pivot().is_some() {
        return None;
    }
    let whole = |size: &Rational| i16::try_from(-size.clone()).ok();
    let [tens, sixties] = &wanted.sizes;
    Some(Size { tens: whole(tens)?, sixties: whole(sixties)? })
}

/// Whether a symbol is a unit of time, or of a power of it.
fn is_of_time(symbol: &Symbol) -> bool {
    let exponents = symbol.dimension.exponents();
    let is_only = |(base, exponent): (&&str, &Rational)| (*base == "s") != exponent.is_zero();
    BASE.iter().zip(exponents).all(is_only)
}

/// The message that these symbols, possibly with seconds, are not of one system. Its place is the only symbol that is not an SI
/// unit, else the last symbol.
fn mixture(involved: &[&Symbol], seconds: bool) -> Option<Diagnostic> {
    let mut foreign = involved.iter().filter(|symbol| symbol.size != Size::SI);
    let odd = match (foreign.next(), foreign.next()) {
        (Some(only), None) => *only,
        _ => *involved.last()?,
    };
    let others: Vec<_> =
        involved.iter().copied().filter(|symbol| symbol.symbol != odd.symbol).collect();
    let plural = if others.is_empty() { "is" } else { "are" };
    let with = if seconds { " with seconds" } else { "" };
    let message = format!("{} {plural} not of one system of units{with}", enumeration(involved));
    let mut diagnostic = Diagnostic::error(odd.symbol.span, message)
        .label(match others.is_empty() {
            true => "not the unit of a pure number".into(),
            false => format!("does not go with {}", enumeration(&others)),
        })
        .help("values are not converted: use one system, such as m, kg, s, N, Pa or mm, tonne, s, N, MPa");
    if seconds {
        let help = "t is in seconds, unless a parameter has a unit of time such as `ms`";
        diagnostic = diagnostic.help(help);
    }
    Some(diagnostic)
}

/// Symbols for a sentence: `a`, `b` and `c`.
fn enumeration(symbols: &[&Symbol]) -> String {
    let names: Vec<_> = symbols.iter().map(|symbol| format!("`{}`", symbol.symbol.value)).collect();
    match names.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        _ => names.concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::{Sources, Spanned};

    fn mixed(units: &[&str]) -> Option<String> {
        let mut sources = Sources::default();
        let mut diagnostics = Vec::new();
        let units: Vec<_> = units
            .iter()
            .map(|text| {
                let raw = format!("\"{text}\"");
                let id = sources.add("x.toml", raw.as_str());
                let span = sources.span(id, 0, raw.len());
                let text = Spanned { value: text.to_string(), span };
                Unit::parse(&sources, &text, &mut diagnostics).expect("a unit")
            })
            .collect();
        consistent(&units).map(|diagnostic| diagnostic.message)
    }

    #[test]
    fn consistent_systems_pass() {
        for units in [
            &["m", "kg", "s", "N", "Pa", "kg/m^3", "J", "W", "Hz", "rad/s"][..],
            &["mm", "tonne/mm^3", "MPa", "s", "N", "mJ"],
            &["mm", "kg", "ms", "GPa", "kN", "kg/mm^3"],
            &["cm", "g", "s"],
            &["km", "h", "km/h"],
            &["1", "rad"],
        ] {
            assert_eq!(mixed(units), None, "{units:?}");
        }
    }

    #[test]
    fn mixtures_name_the_units_that_clash() {
        for (units, names) in [
            (&["mm", "m"][..], "`mm` and `m`"),
            (&["mm", "kg/m^3"], "`mm` and `m`"),
            (&["kg/m^3", "m", "MPa", "s"], "`kg`, `m`, `MPa` and `s`"),
            (&["m", "Pa", "N"], ""),
            (&["mm", "Pa", "N"], "`mm`, `Pa` and `N`"),
            (&["km", "s", "km/h"], "`s` and `h`"),
            (&["kg/m^3", "m", "MPa"], "`kg`, `m` and `MPa` are not of one system of units with"),
            (&["rad", "mrad"], "`mrad`"),
        ] {
            let message = mixed(units).unwrap_or_default();
            assert!(message.contains(names), "{units:?}: {message}");
            assert_eq!(message.is_empty(), names.is_empty(), "{units:?}: {message}");
        }
    }

    #[test]
    fn quantities_have_the_units_of_their_system() {
        let own = |units: &[&str], si: &str| {
            let units: Vec<Unit> =
                units.iter().map(|it| Unit::known(it).expect("a unit")).collect();
            own(&units, si)
        };
        let tonnes = ["mm", "t/mm^3", "MPa", "1"];
        for (si, expected) in [
            ("m", "mm"),
            ("kg/m^3", "t/mm^3"),
            ("Pa", "MPa"),
            ("Pa/m", "MPa/mm"),
            ("m/s^2", "mm/s^2"),
            ("N/m^3", "N/mm^3"),
            ("s", "s"),
            ("1", "1"),
        ] {
            assert_eq!(own(&tonnes, si).as_deref(), Some(expected), "{si}");
        }
        // kg mm/ms^2 = kN, kN/mm^2 = GPa
        let milliseconds = ["mm", "kg", "ms"];
        let of = |si| own(&milliseconds, si);
        assert_eq!(
            [of("Pa"), of("N/m^3"), of("m/s")].map(Option::unwrap),
            ["GPa", "kN/mm^3", "mm/ms"]
        );
        // MPa and s do not determine lengths.
        assert_eq!(own(&["MPa"], "Pa").as_deref(), Some("MPa"));
        assert_eq!(own(&["MPa"], "m"), None);
        for units in [&[][..], &["m", "Pa", "1"], &["rad"]] {
            assert_eq!(own(units, "kg/m^3").as_deref(), Some("kg/m^3"), "{units:?}");
        }
        // g/(cm s^2) is 0.1 Pa.
        assert_eq!(own(&["cm", "g"], "Pa").as_deref(), Some("dPa"));
    }

    /// A kilopascal is no product of powers of metres and newtons alone.
    #[test]
    fn a_ratio_of_units_must_fit_as_well() {
        let message = mixed(&["Pa/kPa"]).expect("a mixture");
        assert_eq!(message, "`Pa` and `kPa` are not of one system of units");
    }
}
