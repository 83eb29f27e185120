//! Names of quantities, as users give them.

use anyhow::Error;
use mms_codegen::selection::{self, compiled_quantity};
use mms_spec::own::Own;
use mms_spec::quantity::Quantity;

/// The compiled quantities with these names or aliases, each once, of a field with its `own` quantities; `all` means all
/// quantities of a point and a time.
pub fn quantities(own: &[Own], names: &[String]) -> anyhow::Result<Vec<Quantity>> {
    named(own, names, compiled_quantity)
}

/// The quantities of some names or aliases, with those on request, which `all` leaves out.
pub fn evaluated(own: &[Own], names: &[String]) -> anyhow::Result<Vec<Quantity>> {
    named(own, names, selection::any_quantity)
}

fn named(
    own: &[Own],
    names: &[String],
    known: fn(&[Own], &str) -> Result<Quantity, String>,
) -> anyhow::Result<Vec<Quantity>> {
    let mut quantities = Vec::new();
    for name in names.iter().map(|name| name.trim()) {
        if name == "all" {
            let own = own.iter().map(|own| Quantity::Own(*own));
            quantities.extend(Quantity::pointwise().chain(own.filter(|it| !it.takes_normal())));
            continue;
        }
        quantities.push(known(own, name).map_err(Error::msg)?);
    }
    let mut seen = Vec::new();
    quantities.retain(|quantity| {
        let new = !seen.contains(quantity);
        seen.push(*quantity);
        new
    });
    Ok(quantities)
}
