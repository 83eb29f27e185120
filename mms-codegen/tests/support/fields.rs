//! Fields of any size, to measure the growth of the work: shared by tests and benches.

/// The kind of terms of a displacement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Distinct waves: sin(k X + t).
    Waves,
    /// Distinct powers of all coordinates.
    Polynomial,
}

/// A field whose components have `terms` terms each.
pub fn text(family: Family, dimension: usize, terms: usize) -> String {
    let axes = &["X", "Y", "Z"][..dimension];
    let component = |axis: usize| {
        let terms: Vec<_> = (1..=terms).map(|k| term(family, axes, axis, k)).collect();
        format!("\"({})/{}\"", terms.join(" + "), 1000 * terms.len())
    };
    let components: Vec<_> = (0..dimension).map(component).collect();
    let bounds = |value: &str| vec![value; dimension].join(", ");
    format!(
        "[field]\ntitle = \"x\"\ndimension = {dimension}\n[displacement]\nu = [{}]\n\
         [material]\nmodel = \"neo_hookean\"\nlambda = 1\nmu = 1\ndensity = 1\n[domain]\n\
         shape = \"box\"\nlower = [{}]\nupper = [{}]\ntime = [0, 1]\n",
        components.join(", "),
        bounds("0"),
        bounds("1"),
    )
}

fn term(family: Family, axes: &[&str], axis: usize, k: usize) -> String {
    match family {
        Family::Waves => {
            let phase: Vec<_> = axes.iter().map(|name| format!("{k}*{name}")).collect();
            format!("sin({} + {}*t)", phase.join(" + "), axis + 1)
        }
        Family::Polynomial => {
            let powers: Vec<_> = axes
                .iter()
                .enumerate()
                .map(|(other, name)| {
                    format!("{name}^{}", if other == axis { k } else { other + 1 })
                })
                .collect();
            format!("{k}*t*{}", powers.join("*"))
        }
    }
}
