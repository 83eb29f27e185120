//! Names of columns and of units, as people write them.

use mms_judge::names::Column;
use mms_judge::results::unit;
use mms_spec::units::Unit;

#[test]
fn norms_are_told_by_their_names() {
    let of = |name: &str| match Column::named(name) {
        Column::Error { quantity, norm } => (quantity, norm),
        other => panic!("{name}: {other:?}"),
    };
    for (name, quantity, norm) in [
        ("l2", "", "l2"),
        ("L2", "", "l2"),
        ("RMS error", "", "l2"),
        ("L_inf", "", "linf"),
        ("max", "", "linf"),
        ("mean", "", "l1"),
        ("H1", "", "h1"),
        ("u_l2", "u", "l2"),
        ("L2(velocity)", "velocity", "l2"),
        ("err_sigma_xx_max", "sigma_xx", "linf"),
        ("Kirchhoff stress", "Kirchhoff stress", "Kirchhoff stress"),
        ("e", "e", "e"),
        ("max_l2", "max_l2", "max_l2"),
    ] {
        assert_eq!(of(name), (quantity.into(), norm.into()), "{name}");
    }
}

#[test]
fn what_is_no_error_is_told_too() {
    assert_eq!(Column::named("h"), Column::CellSize);
    assert_eq!(Column::named("cell_size"), Column::CellSize);
    assert_eq!(Column::named("DT"), Column::TimeStep);
    assert_eq!(Column::named("round_off"), Column::Floor);
    for name in [
        "order_l2",
        "L2 rate",
        "H1_eoc",
        "cells",
        "number of cells",
        "# elements",
        "particles",
        "total dofs",
        "N",
        "seconds",
        "time",
        "solve time (s)",
        "CPU [s]",
        "Newton iterations",
        "failure",
        "",
        "Unnamed: 0",
        "#",
    ] {
        assert_eq!(Column::named(name), Column::Other, "{name}");
    }
}

#[test]
fn powers_need_no_mark() {
    for (text, marked) in [("N/mm2", "N/mm^2"), ("kg/m3", "kg/m^3"), ("m/s2", "m/s^2"), ("-", "1")]
    {
        let dimension = |text| unit(text).map(|it| it.dimension);
        assert_eq!(dimension(text), Unit::known(marked).map(|it| it.dimension), "{text}");
    }
    assert!(unit("Average").is_none());
}
