//! The expected order of each quantity, by its norm and its sampling.

use anyhow::bail;
use mms_convergence::ExpectedOrder;
use mms_spec::foreign::shown;
use mms_spec::own::Part;
use mms_spec::quantity::Quantity;

use super::level::Sampling;
use super::start::Lowered;
use crate::table::{ExpectedOrders, OF, TIME};

/// The norms of results.
const NORMS: [&str; 4] = ["l1", "l2", "linf", "h1"];

/// Whether the quantity is u, a derivative of u by time, or given. For others theory promises one order less, because they
/// follow from the gradient of u.
fn is_of_motion(quantity: Quantity) -> bool {
    if let Quantity::Own(own) = quantity {
        return matches!(own.part, Part::Value | Part::Rate);
    }
    matches!(
        quantity,
        Quantity::Position
            | Quantity::Displacement
            | Quantity::Velocity
            | Quantity::Acceleration
            | Quantity::BodyForce
            | Quantity::BodyForceDensity
    )
}

impl Sampling {
    /// Whether cells are known, so that theory gives the order of gradients: everywhere one less than u, and at some places, or
    /// after an average over cells, as much as u.
    fn knows_cells(self) -> bool {
        matches!(self, Sampling::Cells | Sampling::Middles)
    }
}

/// The expected orders of a norm in h and in dt. Gradients have one order less than u, or the order of u where they are more
/// accurate than elsewhere; a start may lower the orders of v and a.
pub fn expected(
    (orders, lowered): (&ExpectedOrders, &Lowered),
    (quantity, sampling): (Quantity, Sampling),
    norm: &str,
) -> [ExpectedOrder; 2] {
    let (name, symbol) = (quantity.name(), quantity.symbol());
    let [space, time] = orders.of(name, symbol, norm);
    let is_gradient = !is_of_motion(quantity) && sampling.knows_cells();
    let least = match lowered.of(quantity) {
        _ if orders.given(name, symbol, norm).is_some() => space.order,
        Some(least) => least,
        None if is_gradient => orders.of_gradients(),
        None => space.order,
    };
    let settles = least == space.order || is_gradient;
    [ExpectedOrder { order: least.min(space.order), settles, ..space }, time]
}

/// Renames orders to the names in results: PK1 is `first_piola_kirchhoff`, and H1 is `h1`.
pub fn named(orders: &ExpectedOrders) -> ExpectedOrders {
    let quantity = |name: &str| match Quantity::from_name(name) {
        Some(quantity) if quantity.symbol() != name => quantity.name().to_owned(),
        _ => name.to_owned(),
    };
    let norm = |name: &str| {
        let lower = name.to_lowercase();
        if NORMS.contains(&&*lower) { lower } else { name.to_owned() }
    };
    let name = |name: &str| match name.split_once(OF) {
        Some((of, own)) => format!("{}{OF}{}", quantity(of), norm(own)),
        None => norm(&quantity(name)),
    };
    let named = orders.named.iter().map(|(own, order)| (name(own), *order)).collect();
    ExpectedOrders { named, ..orders.clone() }
}

/// Refuses orders of quantities or norms that are not judged.
pub fn validate_orders(
    quantities: &[(Quantity, Sampling)],
    orders: &ExpectedOrders,
    has_steps: bool,
) -> anyhow::Result<()> {
    let is_quantity =
        |name: &str| quantities.iter().any(|(it, _)| it.name() == name || it.symbol() == name);
    let is_known = |name: &str| match name.split_once(OF) {
        Some((quantity, norm)) => is_quantity(quantity) && NORMS.contains(&norm),
        None => NORMS.contains(&name) || is_quantity(name) || has_steps && name == TIME,
    };
    if let Some((name, _)) = orders.named.iter().find(|(name, _)| !is_known(name)) {
        let known: Vec<_> = quantities.iter().map(|(it, _)| it.symbol()).chain(NORMS).collect();
        bail!(
            "`--expected-order {}=..`: it is not judged; known are {}",
            shown(name),
            known.join(", ")
        );
    }
    Ok(())
}
