//! Mistakes in the tangent of a law and in the order of its components: rates, volumes, strains, Voigt's components.

use super::{Change, Hypothesis, Known, OfTangent, inverse};

/// The mistakes in a tangent alone.
pub fn of_tangent<const D: usize>() -> Vec<Hypothesis<D>> {
    let tangent =
        |name, says, change: OfTangent<D>| Hypothesis::fixed(name, says, Change::Tangent(change));
    let mut all = vec![
        tangent(
            "tangent_volume",
            "without 1/J: the tangent of tau in place of sigma",
            |[at, _], _, rate| at.rate(rate),
        ),
        tangent(
            "tangent_truesdell",
            "the tangent of Truesdell's rate in place of Jaumann's: its stress terms are missing",
            |[at, _], _, rate| {
                let stress = rate * at.tau + at.tau * rate;
                (at.rate(rate) - stress) / at.jacobian()
            },
        ),
        tangent(
            "tangent_cauchy",
            "the tangent of the rate of sigma in place of the rate of tau over J: without sigma tr D",
            |[at, _], _, rate| (at.rate(rate) - at.tau * rate.trace()) / at.jacobian(),
        ),
        tangent("tangent_material", "dS/dE, which was not pushed forward", |[at, _], _, strain| {
            let back = inverse(&at.f);
            let rate = back.transpose() * strain * back;
            back * (at.rate(&rate) - rate * at.tau - at.tau * rate) * back.transpose()
        }),
        tangent(
            "tangent_small_strain",
            "the tangent of small strains, at any F",
            |[_, rest], _, rate| rest.tangent(rate),
        ),
        tangent("tangent_sign", "the tangent with the other sign", |[at, _], _, rate| {
            -at.tangent(rate)
        }),
    ];
    // With one component there is no shear.
    if D > 1 {
        all.push(Hypothesis::factor(
            "tangent_shear_factor",
            "the columns of shear times a factor",
            2.0,
            Change::Tangent(|[at, _], size, rate| {
                let factor = if rate.trace() == 0.0 { size[0] } else { 1.0 };
                at.tangent(rate) * factor
            }),
            |_| {
                vec![
                    Known::new(
                        2.0,
                        "tangent_shear_twice",
                        "with components of the strain tensor in place of engineering shears",
                    ),
                    Known::new(0.5, "tangent_shear_half", "engineering shears halved twice"),
                ]
            },
        ));
    }
    all
}

/// The other common orders of the shear components 12, 13, 23.
pub fn voigt_orders<const D: usize>() -> Vec<Hypothesis<D>> {
    let says = "the shear components are in another order than 12, 13, 23";
    let order = |which: &'static str, order| Hypothesis {
        which: Some(which.into()),
        ..Hypothesis::fixed("voigt_order", says, Change::Order(order))
    };
    if D < 3 {
        return Vec::new();
    }
    vec![
        order("23, 13, 12", [2, 1, 0]),
        order("12, 23, 13", [0, 2, 1]),
        order("13, 12, 23", [1, 0, 2]),
        order("13, 23, 12", [1, 2, 0]),
        order("23, 12, 13", [2, 0, 1]),
    ]
}
