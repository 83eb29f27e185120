//! Profiles of codes.

use mms_campaign::profile::*;

fn read(text: &str) -> Result<Profile<String>, String> {
    let role = |name: &str| match name {
        "u" | "sigma" | "X" | "x" => Ok(name.to_owned()),
        _ => Err("one of u, sigma".to_owned()),
    };
    mms_campaign::profile::read("code.toml", text, &role).map_err(|it| it.to_string())
}

#[test]
fn names_orders_and_positions_are_read() {
    let text = "source = 'a manual'\npoints = 'x'\norders = ['11,22,33,12']\n[quantities]\nu = ['U', 'disp']\nsigma = 'S'";
    let profile = read(text).unwrap();
    assert_eq!(profile.points.as_deref(), Some("x"));
    assert_eq!(profile.orders, [[(0, 0), (1, 1), (2, 2), (0, 1)]]);
    let names = |role: &str| {
        let found = profile.quantities.iter().find(|(it, _)| it == role);
        found.map_or(Vec::new(), |(_, names)| names.clone())
    };
    assert_eq!(names("u"), ["U", "disp"]);
    assert_eq!(names("sigma"), ["S"]);
}

#[test]
fn every_mistake_is_told_at_its_place() {
    let text = "points = 'Y'\norders = ['1,2']\nname = 1\n[quantities]\nw = 'W'\nu = 3";
    let said = read(text).unwrap_err();
    for part in [
        "the profile has",
        "missing key `source`",
        "code.toml:1:10",
        "code.toml:2:11",
        "code.toml:3:1",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    for part in ["code.toml:5:1", "expected one of u, sigma", "code.toml:6:5"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(read("source = ").unwrap_err().contains("code.toml:1"));
}
