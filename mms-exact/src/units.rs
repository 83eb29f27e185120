//! The units of lengths, times and quantities of a field, as its results state them.

use mms_codegen::Compiled;
use mms_documents::Names;
use mms_spec::units::Unit;

/// The units of h, dt and the quantities of these names; `None` if no parameter states a unit. A unit that does not follow from
/// the units of the parameters is left out.
pub fn units<'a>(
    compiled: &Compiled,
    quantities: impl IntoIterator<Item = &'a str>,
) -> Option<Names<String>> {
    if compiled.model.parameters.iter().all(|it| it.unit.is_none()) {
        return None;
    }
    let lengths = [("h", compiled.unit("m")), ("dt", compiled.unit("s"))];
    let quantities = quantities
        .into_iter()
        .filter_map(|name| Some((name, compiled.unit_of(compiled.quantity(name).ok()?))));
    let all = lengths.into_iter().chain(quantities);
    Some(all.filter(|(_, unit)| Unit::known(unit).is_some()).collect())
}
