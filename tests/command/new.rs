//! `mms new`: a field file that works from the start.

use super::mms::{Folder, numbers};

/// The arguments for each kind of field, with points on its boundary and points inside.
const KINDS: [(&str, &[&str], &[&str]); 4] = [
    ("--dimension 1", &["0", "1"], &["0.1", "0.5", "0.99"]),
    ("--dimension 2", &["0,0.3", "1,0.3", "0.7,0", "0.7,1"], &["0.1,0.2", "0.5,0.5", "0.9,0.8"]),
    (
        "--dimension 3",
        &["0,0.3,0.6", "1,0.3,0.6", "0.3,0,0.6", "0.3,1,0.6", "0.3,0.6,0", "0.3,0.6,1"],
        &["0.1,0.2,0.3", "0.6,0.7,0.8"],
    ),
    (
        "--dimension 2 --shape annulus",
        &["1,0", "0,-1", "0.6,0.8", "2,0", "-1.2,1.6"],
        &["1.5,0", "0.8,1.2", "-1,-1"],
    ),
];

#[test]
fn each_kind_passes_its_check_and_is_shown_and_evaluated() {
    for (arguments, _, inside) in KINDS {
        let folder = Folder::new();
        let run = folder.mms(&format!("new fresh {arguments}")).exits(0);
        run.prints("fresh.toml: written").prints("mms check fresh.toml");
        let check = folder.mms("check fresh.toml --json").exits(0).json();
        let file = &check["files"][0];
        let quantities: Vec<_> =
            file["checks"].as_array().expect("checks").iter().map(|it| &it["quantity"]).collect();
        assert_eq!(quantities, ["jacobian", "div_p"], "{arguments}");
        assert_ne!(file["claims"].as_array().map_or(0, Vec::len), 0, "{arguments}");
        folder.mms("show fresh.toml").exits(0).prints("clamped");
        let at = inside[0];
        folder.mms(&format!("eval fresh.toml --at {at} --time 0.01")).exits(0).prints("body_force");
    }
}

/// The claims are not taken from the file: u vanishes on the whole boundary.
#[test]
fn the_claims_of_each_kind_hold_and_nothing_is_turned_inside_out() {
    for (arguments, boundary, inside) in KINDS {
        let folder = Folder::new();
        folder.mms(&format!("new fresh {arguments}")).exits(0);
        let text = folder.read("fresh.toml");
        let claims = text.lines().filter(|line| line.ends_with("= \"fixed\""));
        assert!(claims.count() >= 2, "{text}");
        let at: Vec<_> = boundary.iter().chain(inside).map(|at| format!("--at {at}")).collect();
        let at = at.join(" ");
        for time in ["0", "0.013", "0.02"] {
            let command = format!("eval fresh.toml {at} --time {time} --quantity u,J --json");
            let document = folder.mms(&command).exits(0).json();
            for (index, point) in document["points"].as_array().expect("points").iter().enumerate()
            {
                let size =
                    numbers(&point["displacement"]).iter().fold(0.0, |a: f64, b| a.max(b.abs()));
                assert_eq!(size < 1e-16, index < boundary.len(), "{arguments}: {point}");
                assert!(
                    (0.5..2.0).contains(&numbers(&point["jacobian"])[0]),
                    "{arguments}: {point}"
                );
            }
        }
    }
}

#[test]
fn the_solver_shows_the_order_that_the_file_states() {
    for (dimension, cells) in [(1, "16,32,64"), (2, "8,16"), (3, "4,8")] {
        let folder = Folder::new();
        let run = folder.mms(&format!("new fresh --dimension {dimension}")).exits(0);
        run.prints("mms study fresh.toml");
        folder.mms(&format!("study fresh.toml --cells {cells}")).exits(0).prints("pass");
    }
}

#[test]
fn the_solver_is_not_promised_for_an_annulus() {
    let folder = Folder::new();
    let run = folder.mms("new ring --dimension 2 --shape annulus").exits(0);
    assert!(!run.stdout.contains("study"), "{run}");
}

#[test]
fn the_file_goes_where_fields_are_kept() {
    let folder = Folder::new();
    folder.mms("new here --dimension 1").exits(0).prints("here.toml: written");
    folder.write("fields/other.toml", "");
    folder.mms("new there --dimension 1").exits(0).prints("mms check fields/there.toml");
    folder.mms("new far --dimension 1 -o a/b").exits(0).prints("mms check a/b/far.toml");
    for path in ["here.toml", "fields/there.toml", "a/b/far.toml"] {
        folder.mms(&format!("check {path}")).exits(0);
    }
}

#[test]
fn the_first_line_names_the_schema_where_there_is_one() {
    let folder = Folder::new();
    folder.write("docs/field.schema.json", "{}");
    folder.mms("new beside --dimension 1 --output drafts").exits(0);
    folder.mms("new below --dimension 1 --output drafts/more").exits(0);
    let text = folder.read("drafts/beside.toml");
    assert!(text.starts_with("#:schema ../docs/field.schema.json\n"), "{text}");
    let text = folder.read("drafts/more/below.toml");
    assert!(text.starts_with("# Editors") && text.contains("mms schema >"), "{text}");
}

#[test]
fn a_file_that_exists_is_left_as_it_is() {
    let folder = Folder::new();
    folder.write("mine.toml", "precious");
    let run = folder.mms("new mine --dimension 1").exits(2);
    run.complains("`mine.toml` exists already").prints_nothing();
    assert_eq!(folder.read("mine.toml"), "precious");
}

#[test]
fn a_name_of_the_gallery_is_noted() {
    let run = Folder::new().mms("new bar_1d --dimension 1").exits(0);
    run.prints("`mms show bar_1d` shows the gallery's own `bar_1d`");
}

#[test]
fn wrong_arguments_exit_2_and_write_nothing() {
    let folder = Folder::new();
    for (arguments, message) in [
        ("new Ring --dimension 1", "try `ring`"),
        ("new ../ring --dimension 1", "`--output`"),
        ("new ring", "--dimension"),
        ("new ring --dimension 4", "4"),
        ("new ring --dimension 3 --shape annulus", "needs `--dimension 2`"),
        ("new ring --dimension 2 --shape sphere", "possible values"),
        ("new ring --dimension 1 --material neo_hokean", "did you mean `neo_hookean`?"),
    ] {
        folder.mms(arguments).exits(2).complains(message).prints_nothing();
    }
    let left = std::fs::read_dir(folder.path(".")).expect("the folder").count();
    assert_eq!(left, 0);
}
